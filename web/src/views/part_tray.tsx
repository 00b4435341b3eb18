// The compare tray: parts picked from the lists of any family, seen side by side.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem } from '../lib/api';
import { type Comparison, loadComparison, sheetOf } from '../lib/catalogue';
import { columnName, fieldKind, short } from '../lib/format';
import { route, setQuery } from '../lib/route';
import { toShown } from '../lib/units';
import { Dialog, Notice } from '../ui/controls';
import { number, Table } from '../ui/table';

export const pickedMost = 8;

// In the address, so that a comparison can be shared.
export const picked = (): string[] =>
  (route.value.query.get('pick') ?? '').split('~').filter(Boolean);

const setPicked = (ids: string[]) => setQuery({ pick: ids.join('~') });

export function PickBox({ id, name }: { id: string; name: string }) {
  const now = picked();
  const isPicked = now.includes(id);
  return (
    <input
      type="checkbox"
      aria-label={`Compare ${name}`}
      data-tip="Into the compare tray"
      checked={isPicked}
      disabled={!isPicked && now.length >= pickedMost}
      onChange={() => setPicked(isPicked ? now.filter((one) => one !== id) : [...now, id])}
    />
  );
}

export function Tray() {
  const ids = picked();
  const isOpen = useSignal(false);
  if (ids.length === 0) return null;
  return (
    <section class="tray" aria-label="Compare tray">
      {ids.map((id) => (
        <span key={id} class="chip">
          {id}{' '}
          <button
            type="button"
            class="quiet"
            aria-label={`Take ${id} out`}
            onClick={() => setPicked(ids.filter((one) => one !== id))}
          >
            ✕
          </button>
        </span>
      ))}
      <button
        type="button"
        class="primary"
        disabled={ids.length < 2}
        data-tip={ids.length < 2 ? 'Pick another part' : undefined}
        onClick={() => (isOpen.value = true)}
      >
        Compare {ids.length}
      </button>
      <button type="button" onClick={() => setPicked([])}>
        Empty
      </button>
      {isOpen.value && <CompareDialog ids={ids} onClose={() => (isOpen.value = false)} />}
    </section>
  );
}

function CompareDialog({ ids, onClose }: { ids: string[]; onClose: () => void }) {
  const loaded = useSignal<Comparison | null>(null);
  const problem = useSignal('');
  const onlyDifferent = useSignal(false);
  useEffect(() => {
    loadComparison(ids).then(
      (answer) => (loaded.value = answer),
      (error) => (problem.value = asProblem(error).message),
    );
  }, []);
  const now = loaded.value;
  const rows = now?.fields.filter((row) => row.differs || !onlyDifferent.value) ?? [];
  return (
    <Dialog wide title={`${ids.length} parts side by side`} onClose={onClose}>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {now && (
        <>
          <label class="check">
            <input
              type="checkbox"
              checked={onlyDifferent.value}
              onChange={(event) => (onlyDifferent.value = event.currentTarget.checked)}
            />
            <span>Only what differs</span>
          </label>
          <Table
            label="Comparison"
            class="side-by-side"
            heads={['what', ...now.parts.map((part) => number(part.part_number))]}
          >
            {rows.map((row) => (
              <CompareRow key={row.field} row={row} />
            ))}
            <tr>
              <th scope="row">data sheet</th>
              {now.parts.map((part) => (
                <td key={part.id} class="num">
                  <SheetLink link={sheetOf(part)} />
                </td>
              ))}
            </tr>
          </Table>
          <p class="hint">
            <b class="differs">≠</b> differs · <span class="from estimated">~ estimated</span>
          </p>
        </>
      )}
    </Dialog>
  );
}

export function SheetLink({ link }: { link: string | undefined }) {
  if (!link) return <span class="muted">–</span>;
  return (
    <a href={link} target="_blank" rel="noopener noreferrer" data-tip={link}>
      sheet ↗
    </a>
  );
}

function CompareRow({ row }: { row: Comparison['fields'][number] }) {
  const { label, unit } = columnName(row.field);
  return (
    <tr class={row.differs ? 'differs' : ''}>
      <th scope="row">
        {row.differs ? <span aria-label="differs">≠ </span> : ''}
        {label} {unit && <small>{unit}</small>}
      </th>
      {row.values.map((value, i) => (
        <td key={i} class="num">
          <span class={`from ${row.provenance[i] ?? ''}`}>
            {row.provenance[i] === 'estimated' && '~ '}
            {textOf(row.field, value)}
          </span>
        </td>
      ))}
    </tr>
  );
}

function textOf(field: string, value: unknown): string {
  if (value === null) return '–';
  if (typeof value === 'number') return short(toShown(fieldKind(field), value), 4);
  if (Array.isArray(value)) return `${value.length} points`; // of a curve
  return String(value);
}
