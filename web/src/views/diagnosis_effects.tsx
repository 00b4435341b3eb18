// The effects that a diagnosis established, and the declared numbers as they were fitted.
import { digitsApart, fieldKind, fieldName, significant } from '../lib/format';
import { type Diagnosis, effectName, type Estimate } from '../lib/measurement';
import { type Kind, toShown } from '../lib/units';
import { Panel } from '../ui/controls';
import { number, Table } from '../ui/table';

// With digits enough to tell the ends apart.
function inDigits(kind: Kind, e: Estimate): { value: string; interval: string } {
  const [low, high] = e.ci95?.map((end) => toShown(kind, end)) ?? [];
  const digits = low === undefined ? 3 : Math.min(6, digitsApart(low, high!) - 1);
  const text = (value: number) => significant(value, Math.max(3, digits));
  return {
    value: text(toShown(kind, e.value)),
    interval: low === undefined ? '–' : `${text(low)} … ${text(high!)}`,
  };
}

function Row({ name, value }: { name: string; value: Estimate | string }) {
  const { label, unit } = fieldName(name);
  const text = typeof value === 'string' ? null : inDigits(fieldKind(name), value);
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
          <td class="num">{text!.value}</td>
          <td class="num">
            {value.identified === false ? 'not fixed by the data' : text!.interval}
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
  <Table
    label={`Fitted: ${props.name}`}
    heads={[props.of, number('value'), number('95 % interval')]}
  >
    {props.rows.map(([name, value]) => (
      <Row key={name} name={name} value={value} />
    ))}
  </Table>
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
