// Parts of one family with the source on every number.
import { numberOf, provenanceWord } from '../lib/catalogue';
import { columnName, short } from '../lib/format';
import { link, route, setQuery } from '../lib/route';
import type { Family, Part } from '../lib/types';
import { useWindow } from '../ui/window';

const rowHeight = 32;

export function PartTable({ meta, rows }: { meta: Family; rows: Part[] }) {
  const sort = route.value.query.get('sort') ?? '';
  const by = sort.replace('-', '');
  const numbers = meta.numbers.filter((field) =>
    rows.some((part) => numberOf(part, field.name) !== null),
  );
  const order = sort.startsWith('-') ? -1 : 1;
  const sorted =
    by === ''
      ? rows
      : [...rows].sort((a, b) => {
          const [u, v] = [a[by], b[by]] as [
            number | string | undefined,
            number | string | undefined,
          ];
          if (u === undefined || v === undefined)
            return u === undefined ? (v === undefined ? 0 : 1) : -1;
          return order * (u < v ? -1 : u > v ? 1 : 0);
        });
  const sight = useWindow(rowHeight, sorted.length, 36);
  const head = (name: string, label: string, unit: string, numeric: boolean, tip?: string) => (
    <th
      key={name}
      scope="col"
      class={numeric ? 'num' : ''}
      aria-sort={sort === name ? 'ascending' : sort === `-${name}` ? 'descending' : 'none'}
    >
      <button
        type="button"
        data-tip={tip}
        onClick={() => setQuery({ sort: sort === name ? `-${name}` : name })}
      >
        {label} {unit && <small>{unit}</small>}
        <i>{sort === name ? '▲' : sort === `-${name}` ? '▼' : ''}</i>
      </button>
    </th>
  );
  return (
    <div
      class="scroll parts"
      tabIndex={0}
      role="region"
      aria-label="Parts"
      onScroll={sight.onScroll}
    >
      <table aria-rowcount={sorted.length + 1}>
        <thead>
          <tr>
            {head('part_number', 'part', '', false)}
            {head('manufacturer', 'maker', '', false)}
            {meta.texts.map((field) =>
              head(field.name, field.name.replaceAll('_', ' '), '', false, field.meaning),
            )}
            {numbers.map((field) => {
              const { label, unit } = columnName(field.name);
              return head(field.name, label, unit, true, `${field.meaning}${unit && `, ${unit}`}`);
            })}
          </tr>
        </thead>
        <tbody>
          {sight.above > 0 && (
            <tr aria-hidden="true" class="spacer" style={{ height: `${sight.above}px` }} />
          )}
          {sorted.slice(sight.start, sight.end).map((part, i) => (
            <tr key={part.id} aria-rowindex={sight.start + i + 2}>
              <th scope="row">
                <a
                  href={link(['catalogue', meta.name], {
                    ...Object.fromEntries(route.value.query),
                    part: part.id,
                  })}
                >
                  {part.part_number}
                </a>
                {part.origin !== 'seed' && <span class="chip good own">own</span>}
              </th>
              <td>{part.manufacturer}</td>
              {meta.texts.map((field) => (
                <td key={field.name}>{String(part[field.name] ?? '–')}</td>
              ))}
              {numbers.map((field) => (
                <NumberCell key={field.name} part={part} field={field.name} />
              ))}
            </tr>
          ))}
          {sight.below > 0 && (
            <tr aria-hidden="true" class="spacer" style={{ height: `${sight.below}px` }} />
          )}
        </tbody>
      </table>
    </div>
  );
}

function NumberCell({ part, field }: { part: Part; field: string }) {
  const value = numberOf(part, field);
  if (value === null) return <td class="num muted">–</td>;
  const from = part.provenance[field];
  return (
    <td class="num">
      <span
        class={`from ${from?.kind ?? ''}`}
        data-tip={from ? `${provenanceWord[from.kind]}: ${from.source}` : undefined}
      >
        {from?.kind === 'estimated' && '~ '}
        {short(value, 4)}
      </span>
    </td>
  );
}
