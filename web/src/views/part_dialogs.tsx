// One part with its sources and history.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { ask, asProblem } from '../lib/api';
import { loadPart, numberOf, partPath, provenanceWord, uncertaintyText } from '../lib/catalogue';
import { fieldKind, fieldName, short } from '../lib/format';
import { edit, requirements } from '../lib/requirements';
import type { Family, Part } from '../lib/types';
import { toShown, unitOf } from '../lib/units';
import { familyWord } from '../lib/words';
import { Lines } from '../plots/lines';
import { Chip, Dialog, Notice } from '../ui/controls';
import { number, Table } from '../ui/table';
import { PartHistory } from './history';
import { Address, OrderableChip, PartDetails } from './part_details';
import { PartDocuments } from './part_documents';
import { PartForm } from './part_form';
import { Protocols } from './protocols';

export function PartDialog(props: {
  id: string;
  meta: Family;
  known: Part[];
  onClose: (changed: boolean) => void;
  onCopied: (id: string) => void;
}) {
  const { id, meta } = props;
  const loaded = useSignal<{ part: Part; etag: string } | null>(null);
  const problem = useSignal('');
  const mode = useSignal<'show' | 'edit' | 'copy'>('show');
  const changed = useSignal(false);
  const load = () =>
    loadPart(id).then(
      (answer) => (loaded.value = answer),
      (error) => (problem.value = asProblem(error).message),
    );
  useEffect(() => void load(), [id]);
  const reload = () => {
    changed.value = true;
    void load();
  };
  const now = loaded.value;
  if (now && mode.value !== 'show') {
    return (
      <PartForm
        meta={meta}
        known={props.known}
        part={now.part}
        etag={mode.value === 'edit' ? now.etag : undefined}
        onClose={(saved) => props.onClose(saved)}
      />
    );
  }
  const remove = async () => {
    if (!confirm(`Remove ${now!.part.manufacturer} ${now!.part.part_number} from the catalogue?`))
      return;
    try {
      await ask('DELETE', partPath(id), { headers: { 'If-Match': now!.etag } });
      props.onClose(true);
    } catch (error) {
      problem.value = asProblem(error).message;
      void load();
    }
  };
  return (
    <Dialog
      wide
      title={now ? `${now.part.manufacturer} ${now.part.part_number}` : id}
      onClose={() => props.onClose(changed.value)}
    >
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {now && (
        <>
          <div class="toolbar">
            <Chip>{familyWord(now.part.family)}</Chip>
            <Chip kind={now.part.origin === 'seed' ? '' : 'good'}>
              {now.part.origin === 'seed' ? 'supplied' : 'own'}
            </Chip>
            <OrderableChip part={now.part} />
            <code>{id}</code>
            <span class="toolbar-group">
              <Wish part={now.part} />
              <button type="button" onClick={() => (mode.value = 'edit')}>
                Edit
              </button>
              <button type="button" onClick={() => (mode.value = 'copy')}>
                Copy
              </button>
              <button type="button" class="bad" onClick={() => void remove()}>
                Remove
              </button>
            </span>
          </div>
          {now.part.notes && <p class="notes">{now.part.notes}</p>}
          <PartDetails part={now.part} />
          <PartDocuments part={now.part} onChanged={reload} />
          <FieldTable part={now.part} meta={meta} />
          {now.part.curve && <Curve part={now.part} />}
          <Protocols id={id} />
          <PartHistory id={id} />
        </>
      )}
    </Dialog>
  );
}

// Leaves the part out of the requirements, or asks for it.
function Wish({ part }: { part: Part }) {
  const { exclude = [], require = {}, own = [] } = requirements.value;
  const isOwn = own.includes(part.id);
  const isOut = exclude.includes(part.id);
  const isAsked = require[part.family]?.includes(part.id) ?? false;
  const without = (ids: string[]) => ids.filter((id) => id !== part.id);
  const orNone = (ids: string[]) => (ids.length ? ids : undefined);
  const asked = require[part.family] ?? [];
  return (
    <>
      <button
        type="button"
        aria-pressed={isOut}
        data-tip="The next searches do without this part"
        onClick={() => edit(['exclude'], orNone(isOut ? without(exclude) : [...exclude, part.id]))}
      >
        Leave out
      </button>
      <button
        type="button"
        aria-pressed={isAsked}
        data-tip={`The next searches take no other ${familyWord(part.family)} than those required; a design may do without one`}
        onClick={() =>
          edit(['require', part.family], orNone(isAsked ? without(asked) : [...asked, part.id]))
        }
      >
        Require
      </button>
      <button
        type="button"
        aria-pressed={isOwn}
        data-tip="It is at hand: the next searches count it as free"
        onClick={() => edit(['own'], orNone(isOwn ? without(own) : [...own, part.id]))}
      >
        I have it
      </button>
    </>
  );
}

function FieldTable({ part, meta }: { part: Part; meta: Family }) {
  const fields = [...meta.texts, ...meta.numbers].filter((field) => part[field.name] !== undefined);
  const rows = fields.map((field) => ({
    ...fieldName(field.name),
    name: field.name,
    meaning: field.meaning,
  }));
  return (
    <Table
      label="Numbers and sources"
      class="sources"
      heads={['what', number('value'), 'from', 'source']}
    >
      {rows.map((row) => {
        const value = numberOf(part, row.name);
        const from = part.provenance[row.name];
        return (
          <tr key={row.name}>
            <th scope="row" data-tip={row.meaning}>
              {row.label}
            </th>
            <td class="num">
              {value === null
                ? String(part[row.name])
                : `${short(toShown(fieldKind(row.name), value), 6)} ${row.unit}`}
            </td>
            <td>
              <span class={`from ${from?.kind ?? ''}`}>
                {from ? provenanceWord[from.kind] : '–'}
              </span>{' '}
              <small>{uncertaintyText(from?.uncertainty)}</small>
            </td>
            <td class="source">{from ? <Address text={from.source} /> : '–'}</td>
          </tr>
        );
      })}
    </Table>
  );
}

function Curve({ part }: { part: Part }) {
  const curve = part.curve!;
  const from = part.provenance.free_air;
  return (
    <Lines
      title={`Delivery${from ? `, ${provenanceWord[from.kind]} ${uncertaintyText(from.uncertainty)}`.trimEnd() : ''}`}
      x={curve.map((p) => toShown('pressure', p.pressure_kpa_gauge))}
      xUnit={unitOf('pressure')}
      xLabel={`outlet pressure, ${unitOf('pressure')}`}
      yLabel="free air, L/min"
      height={180}
      yFromZero
      lines={[
        {
          label: 'free air',
          values: curve.map((p) => p.free_air_l_per_min),
          colour: '--c1',
          points: true,
        },
      ]}
    />
  );
}
