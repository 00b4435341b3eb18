// What an answer says of its requirements: numbers that look like another unit, texts and shapes as
// they were understood, notes.
import { placeInWords } from '../lib/amounts';
import { pressuresInUnit, short } from '../lib/format';
import type { Answer } from '../lib/types';
import type { Understood } from '../lib/understood';
import { noteText } from '../lib/words';
import { Notice, Panel } from '../ui/controls';

export function Remarks({ of }: { of: Answer }) {
  const { understood = [], warnings = [], notes = [], requirements } = of;
  const place = (pointer: string) => placeInWords(pointer, requirements.actuators);
  if (!understood.length && !warnings.length && !notes.length) return null;
  return (
    <Panel title="As the requirements were understood">
      {warnings.map((warning) => (
        <Notice key={warning.pointer} kind="warn">
          {place(warning.pointer)} {pressuresInUnit(warning.detail)}
        </Notice>
      ))}
      <ul>
        {understood.map((row) => (
          <li key={row.pointer + row.name}>
            {place(row.pointer)}: {inWords(row)}
          </li>
        ))}
        {notes.map((note) => (
          <li key={note.pointer}>
            Note{note.pointer && ` on ${place(note.pointer)}`}: {noteText(note.note)}
          </li>
        ))}
      </ul>
    </Panel>
  );
}

const inWords = (row: Understood): string =>
  row.name
    ? `${row.name.replace(/_ml$/, '').replaceAll('_', ' ')} ${short(row.value)} ${row.unit} (${row.formula})`
    : `“${String(row.given)}” is ${short(row.value)} ${row.unit}${row.condition ? ` at ${row.condition}` : ''}`;
