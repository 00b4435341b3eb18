// Parts of one family with the source on every number.
import { numberOf, provenanceWord, uncertaintyText } from '../lib/catalogue';
import { columnName, fieldKind, short } from '../lib/format';
import { link, route, setQuery } from '../lib/route';
import type { Family, Part } from '../lib/types';
import { toShown } from '../lib/units';
import { type Head, LongTable, number, SortHead } from '../ui/table';

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
  const head = (name: string, head: Head, tip?: string) => (
    <SortHead
      key={name}
      name={name}
      head={head}
      sort={sort}
      tip={tip}
      onSort={(next) => setQuery({ sort: next })}
    />
  );
  return (
    <LongTable
      label="Parts"
      class="parts"
      rowHeight={32}
      inSight={36}
      rows={sorted}
      head={
        <>
          {head('part_number', { text: 'part' })}
          {head('manufacturer', { text: 'maker' })}
          {meta.texts.map((field) =>
            head(field.name, { text: field.name.replaceAll('_', ' ') }, field.meaning),
          )}
          {numbers.map((field) => {
            const { label, unit } = columnName(field.name);
            return head(field.name, number(label, unit), `${field.meaning}${unit && `, ${unit}`}`);
          })}
        </>
      }
      row={(part, i) => (
        <tr key={part.id} aria-rowindex={i + 2}>
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
      )}
    />
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
        data-tip={
          from
            ? `${provenanceWord[from.kind]}: ${from.source} ${uncertaintyText(from.uncertainty)}`.trim()
            : undefined
        }
      >
        {from?.kind === 'estimated' && '~ '}
        {short(toShown(fieldKind(field), value), 4)}
      </span>
    </td>
  );
}
