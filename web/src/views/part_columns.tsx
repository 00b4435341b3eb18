// Which columns the list of parts shows, kept in the address.
import { columnName } from '../lib/format';
import { route, setQuery } from '../lib/route';
import { Check } from '../ui/controls';

// Names of the columns that are left out.
export const leftOut = (): string[] =>
  (route.value.query.get('without') ?? '').split('~').filter(Boolean);

export function ColumnChoice({ columns }: { columns: string[] }) {
  const without = leftOut();
  const set = (names: string[]) => setQuery({ without: names.join('~') });
  const shown = columns.filter((name) => !without.includes(name)).length;
  return (
    <details class="columns">
      <summary>
        Columns{' '}
        <span class="muted">
          {shown} of {columns.length}
        </span>
      </summary>
      <div class="column-list">
        {columns.map((name) => (
          <Check
            key={name}
            label={
              <>
                <span class="only-heard">Column </span>
                {columnName(name).label}
              </>
            }
            checked={!without.includes(name)}
            onChange={(on) => set(on ? without.filter((one) => one !== name) : [...without, name])}
          />
        ))}
      </div>
      <button type="button" class="small" onClick={() => set([])}>
        All
      </button>{' '}
      <button type="button" class="small" onClick={() => set(columns)}>
        None
      </button>
    </details>
  );
}
