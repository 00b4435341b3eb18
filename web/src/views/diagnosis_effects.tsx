// The effects that a diagnosis established, and the declared numbers as they were fitted.
import { beside, fieldKind, fieldName, pressuresInUnit, significant } from '../lib/format';
import { effectName, effectNames } from '../lib/effect_words';
import {
  type Diagnosis,
  type Estimate,
  type FittedEffect,
  type FittedNumber,
  type Specimen,
  type WrongNumber,
} from '../lib/measurement';
import { type Kind, toShown } from '../lib/units';
import { Panel } from '../ui/controls';
import { number, Table } from '../ui/table';

// To the digits that the width of the interval leaves.
function inDigits(kind: Kind, e: Estimate): { value: string; interval: string } {
  const [low, high] = e.ci95?.map((end) => toShown(kind, end)) ?? [];
  const width = low === undefined ? 0 : Math.abs(high! - low);
  const isPlain = width > 1e-7 && width < 1e7;
  const text = (value: number) => (isPlain ? beside(10 * width, value) : significant(value));
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

// Declared numbers that are wrong, and what would be named were they right.
function WrongNumbers({ numbers }: { numbers: WrongNumber[] }) {
  return (
    <>
      <h3>Declared numbers that are wrong</h3>
      <Table
        label="Wrong numbers"
        heads={['number', number('declared'), number('fitted'), 'otherwise one would name']}
      >
        {numbers.map((n) => {
          const field = n.unit === '1' ? n.name : `${n.name}_${n.unit}`;
          const { label, unit } = fieldName(field);
          const kind = fieldKind(field);
          const piece = n.specimen ?? n.chamber;
          return (
            <tr key={n.name + (piece ?? '')}>
              <td>
                {label} {piece && `of ${piece} `}
                <small class="muted">{unit}</small>
              </td>
              <td class="num">{significant(toShown(kind, n.declared))}</td>
              <td class="num">{significant(toShown(kind, n.fitted))}</td>
              <td>{n.instead_of.length > 0 ? effectNames(n.instead_of) : 'nothing'}</td>
            </tr>
          );
        })}
      </Table>
    </>
  );
}

const named = (numbers: Record<string, FittedNumber>): [string, FittedNumber][] =>
  Object.entries(numbers).map(([name, value]) => [
    value.unit === '1' ? name : `${name}_${value.unit}`,
    value,
  ]);

// Each piece of the actuator with the numbers of its own.
function Specimens({ d, specimens }: { d: Diagnosis; specimens: Specimen[] }) {
  const spread = Object.entries(d.specimen_spread ?? {}).map(
    ([name, share]) => `${fieldName(name).label} ${significant(100 * share, 2)} %`,
  );
  return (
    <>
      <h3>Specimens</h3>
      {specimens.map(({ name, runs, fitted, words }) => {
        const rows = named(fitted);
        const title = `${name ?? 'without a name'} (${runs.join(', ')})`;
        return rows.length > 0 ? (
          <EstimateTable key={name} name={title} of={title} rows={rows} />
        ) : (
          <p key={name}>
            {title}: {words}.
          </p>
        );
      })}
      {spread.length > 0 && (
        <p class="muted">Standard deviation between the specimens: {spread.join(', ')}.</p>
      )}
    </>
  );
}

const sentence = (words: string): string =>
  `${words.charAt(0).toUpperCase()}${pressuresInUnit(words.slice(1))}.`;

// `of`: the set of a tie that it stands in.
function OneEffect({ effect, of }: { effect: FittedEffect; of?: string }) {
  return (
    <>
      <h3>
        {effectName(effect.id)} <code>{effect.id}</code>
        {effect.chamber && ` of ${effect.chamber}`}
      </h3>
      {effect.words && <p>{sentence(effect.words)}</p>}
      <EstimateTable
        name={of ? `${effect.id} in ${of}` : effect.id}
        of="parameter"
        rows={Object.entries(effect.parameters)}
      />
    </>
  );
}

export function Effects({ d }: { d: Diagnosis }) {
  const fitted = named(d.fitted).filter(([, value]) => value.specimen === undefined);
  const numbers = d.numbers ?? [];
  return (
    <Panel title="What is added to the model">
      {numbers.map((n) => n.words && <p key={n.words}>{sentence(n.words)}</p>)}
      {numbers.length > 0 && <WrongNumbers numbers={numbers} />}
      {d.effects.length === 0 && numbers.length === 0 && (
        <p>
          {d.verdict === 'tie'
            ? 'Nothing yet: the tie has to be decided first.'
            : d.verdict === 'adequate'
              ? 'No effect: the base model is enough.'
              : 'No effect was established.'}
        </p>
      )}
      {d.effects.map((effect) => (
        <OneEffect key={effect.id + (effect.chamber ?? '')} effect={effect} />
      ))}
      {d.tied_sets?.map(({ effects, numbers }, i) => (
        <details key={i} open={i === 0}>
          <summary>As good as any: {effectNames(d.tied[i]!, d.tied_laws[i])}</summary>
          {numbers.map((n) => n.words && <p key={n.words}>{sentence(n.words)}</p>)}
          {effects.map((effect) => (
            <OneEffect
              key={effect.id + (effect.chamber ?? '')}
              effect={effect}
              of={`set ${i + 1}`}
            />
          ))}
        </details>
      ))}
      {fitted.length > 0 && (
        <>
          <h3>Declared numbers, re-fitted</h3>
          <EstimateTable name="declared numbers" of="declared number" rows={fitted} />
        </>
      )}
      {d.specimens && <Specimens d={d} specimens={d.specimens} />}
    </Panel>
  );
}
