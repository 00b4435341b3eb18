// Parts of one family with the source on every number.
import {
  estimatedShare,
  numberOf,
  provenanceWord,
  sheetOf,
  uncertaintyText,
} from '../lib/catalogue';
import { columnName, fieldKind, percent, short } from '../lib/format';
import { link, route, setQuery } from '../lib/route';
import type { Family, Part } from '../lib/types';
import { toShown } from '../lib/units';
import { type Head, LongTable, number, SortHead } from '../ui/table';
import { ColumnChoice, leftOut } from './part_columns';
import { PickBox, SheetLink } from './part_tray';

export function PartTable({ meta, rows }: { meta: Family; rows: Part[] }) {
  const sort = route.value.query.get('sort') ?? '';
  const by = sort.replace('-', '');
  const held = meta.numbers.filter((field) =>
    rows.some((part) => numberOf(part, field.name) !== null),
  );
  const without = leftOut();
  const isShown = (field: { name: string }) => !without.includes(field.name);
  const [texts, numbers] = [meta.texts.filter(isShown), held.filter(isShown)];
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
  const columns = [...meta.texts, ...held].map((field) => field.name);
  return (
    <>
      <ColumnChoice columns={columns} />
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
            {head('documented', { text: 'sheet' }, 'the first document of the part')}
            {head(
              estimatedShare,
              number('estimated'),
              "how much of the part's numbers and texts is estimated",
            )}
            {texts.map((field) =>
              head(field.name, { text: field.name.replaceAll('_', ' ') }, field.meaning),
            )}
            {numbers.map((field) => {
              const { label, unit } = columnName(field.name);
              return head(
                field.name,
                number(label, unit),
                `${field.meaning}${unit && `, ${unit}`}`,
              );
            })}
          </>
        }
        row={(part, i) => (
          <tr key={part.id} aria-rowindex={i + 2}>
            <th scope="row">
              <PickBox id={part.id} name={part.part_number} />
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
            <td>
              <SheetLink link={sheetOf(part)} />
            </td>
            <EstimatedCell share={numberOf(part, estimatedShare)} />
            {texts.map((field) => (
              <td key={field.name}>{String(part[field.name] ?? '–')}</td>
            ))}
            {numbers.map((field) => (
              <NumberCell key={field.name} part={part} field={field.name} />
            ))}
          </tr>
        )}
      />
    </>
  );
}

// A bar as long as the share.
function EstimatedCell({ share }: { share: number | null }) {
  if (share === null) return <td class="num muted">–</td>;
  return (
    <td class="num estimated-share" style={{ '--share': `${100 * share}%` }}>
      {percent(share, 0)}
    </td>
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
