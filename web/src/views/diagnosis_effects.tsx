// The effects that a diagnosis established, and the declared numbers as they were fitted.
import { fieldName, significant } from '../lib/format';
import { type Diagnosis, effectName, type Estimate } from '../lib/measurement';
import { Panel } from '../ui/controls';

const interval = (e: Estimate): string =>
  e.ci95 ? `${significant(e.ci95[0])} … ${significant(e.ci95[1])}` : '–';

function Row({ name, value }: { name: string; value: Estimate | string }) {
  const { label, unit } = fieldName(name);
  return (
    <tr>
      <td>
        {label} <small class="muted">{unit}</small>
      </td>
      {typeof value === 'string' ? (
        <td class="num" colSpan={2}>
          {value}
        </td>
      ) : (
        <>
          <td class="num">{significant(value.value)}</td>
          <td class="num">
            {value.identified === false ? 'not fixed by the data' : interval(value)}
          </td>
        </>
      )}
    </tr>
  );
}

export const EstimateTable = (props: {
  name: string;
  of: string;
  rows: [string, Estimate | string][];
}) => (
  <div class="scroll" tabIndex={0} role="region" aria-label={`Fitted: ${props.name}`}>
    <table>
      <thead>
        <tr>
          <th scope="col">{props.of}</th>
          <th scope="col" class="num">
            value
          </th>
          <th scope="col" class="num">
            95 % interval
          </th>
        </tr>
      </thead>
      <tbody>
        {props.rows.map(([name, value]) => (
          <Row key={name} name={name} value={value} />
        ))}
      </tbody>
    </table>
  </div>
);

export function Effects({ d }: { d: Diagnosis }) {
  const fitted = Object.entries(d.fitted).map(([name, value]): [string, Estimate] => [
    value.unit === '1' ? name : `${name}_${value.unit}`,
    value,
  ]);
  return (
    <Panel title="What the model gets">
      {d.effects.length === 0 && (
        <p>
          {d.verdict === 'tie'
            ? 'Nothing yet: the tie has to be decided first.'
            : d.verdict === 'adequate'
              ? 'No effect: the base model is enough.'
              : 'No effect was established.'}
        </p>
      )}
      {d.effects.map((effect) => (
        <div key={effect.id}>
          <h3>
            {effectName(effect.id)} <code>{effect.id}</code>
          </h3>
          <EstimateTable name={effect.id} of="parameter" rows={Object.entries(effect.parameters)} />
        </div>
      ))}
      {fitted.length > 0 && (
        <>
          <h3>Declared numbers, re-fitted</h3>
          <EstimateTable name="declared numbers" of="declared number" rows={fitted} />
        </>
      )}
    </Panel>
  );
}
