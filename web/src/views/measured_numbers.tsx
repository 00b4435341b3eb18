// Numbers of parts that a diagnosis measured, and the button that writes them into the catalogue.
import { useSignal } from '@preact/signals';

import { ask, asProblem } from '../lib/api';
import { fieldName, significant, uncertainty } from '../lib/format';
import {
  type Diagnosis,
  type Measurement,
  type MeasuredNumber,
  partLimitS,
} from '../lib/measurement';
import { setQuery } from '../lib/route';
import { Notice, NumberField, Panel } from '../ui/controls';
import { number, Table } from '../ui/table';

const nameOf = (row: MeasuredNumber): string => {
  const name = fieldName(row.field).label || row.number.replace(/_/g, ' ');
  return row.pressure_kpa_gauge === undefined
    ? name
    : `${name} at ${significant(row.pressure_kpa_gauge)} kPa`;
};

// With all readings: an answer names long lists by their hash only.
const isWhole = (data: Measurement | null | undefined): data is Measurement =>
  !!data && data.runs.every((run) => Array.isArray(run.t_s));

export function MeasuredNumbers({ d, data }: { d: Diagnosis; data: Measurement | null }) {
  const problem = useSignal('');
  const busy = useSignal(false);
  const piece = useSignal(d.saved_part?.specimen ?? '');
  const limitS = useSignal<number | null>(data?.time_limit_s ?? partLimitS);
  const rows = d.measured ?? [];
  const parts = [...new Set(rows.map((row) => row.part))];
  const refused = d.measured_refused ?? [];
  const recording = isWhole(data) ? data : isWhole(d.measurement) ? d.measurement : null;
  const contradicted = d.saved_part?.numbers.some((n) => n.contradiction && !n.written) ?? false;
  // The service fits the recording anew: what is written is what its answer says.
  const save = async (part: string, anyway: boolean) => {
    problem.value = '';
    busy.value = true;
    try {
      const { body } = await ask<{ id: string }>('POST', '/v1/diagnoses', {
        body: {
          ...recording,
          save_part: part,
          save_part_anyway: anyway,
          ...(piece.value.trim() && { save_part_specimen: piece.value.trim() }),
          ...(limitS.value !== null && { time_limit_s: limitS.value }),
        },
      });
      setQuery({ job: body.id });
    } catch (error) {
      problem.value = asProblem(error).sentence;
    } finally {
      busy.value = false;
    }
  };
  return (
    <Panel title="Measured numbers of parts">
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      <Table
        label="Measured numbers of parts"
        heads={[
          'number',
          'part',
          number('declared'),
          number('measured'),
          number('95 % interval'),
          number('uncertainty'),
          'remark',
        ]}
      >
        {rows.map((row) => (
          <tr key={`${row.part} ${nameOf(row)}`}>
            <th scope="row">{nameOf(row)}</th>
            <td>{row.part}</td>
            <td class="num">{significant(row.declared)}</td>
            <td class="num">{significant(row.fitted)}</td>
            <td class="num">{row.interval_95.map((bound) => significant(bound)).join(' to ')}</td>
            <td class="num">{uncertainty(row.uncertainty)}</td>
            <td>{row.refused ?? ''}</td>
          </tr>
        ))}
      </Table>
      {d.bottles?.map((bottle) => (
        <p key={bottle.specimen}>
          {bottle.specimen ?? 'The unnamed bottle'}, {significant(bottle.rest_volume_ml)} mL:{' '}
          {bottle.numbers.filter((one) => one.agrees).length} of {bottle.numbers.length} numbers
          agree.
        </p>
      ))}
      {refused.map((reason) => (
        <Notice key={reason} kind="warn">
          Not for the catalogue: {reason}.
        </Notice>
      ))}
      {d.saved_part && <Saved d={d} />}
      {refused.length === 0 && recording && (contradicted || !d.saved_part?.revision) && (
        <div class="toolbar">
          <label>
            Piece, where you have several{' '}
            <input
              type="text"
              maxLength={64}
              value={piece.value}
              onInput={(event) => (piece.value = event.currentTarget.value)}
            />
          </label>
          <NumberField
            label="Time limit"
            unit="s"
            value={limitS.value}
            optional
            range={[0.01, 3600]}
            onChange={(seconds) => (limitS.value = seconds)}
            onText={() => undefined}
          />
          {parts.map((part) => (
            <button
              key={part}
              type="button"
              class="primary"
              disabled={busy.value}
              onClick={() => void save(part, contradicted)}
            >
              {contradicted ? `Write into ${part} anyway` : `Write into ${part}`}
            </button>
          ))}
        </div>
      )}
    </Panel>
  );
}

function Saved({ d }: { d: Diagnosis }) {
  const saved = d.saved_part!;
  return (
    <>
      {saved.revision && (
        <p role="status">
          Written into {saved.part}
          {saved.specimen && `, its piece ${saved.specimen}`}: revision {saved.revision.number} of
          the catalogue, which its history can undo.
          {saved.numbers.some((n) => n.written && n.combined) &&
            ' Combined with the measurements before.'}
          {saved.numbers.some((n) => n.written && n.pieces > 1) &&
            ` The part is now the mean of ${saved.numbers.find((n) => n.written && n.pieces > 1)!.pieces} pieces, as uncertain as they differ.`}
        </p>
      )}
      {saved.numbers
        .filter((n) => n.warning)
        .map((n) => (
          <p key={n.field}>
            {fieldName(n.field).label || n.field}: {n.warning}.
          </p>
        ))}
      {saved.refused.map((reason) => (
        <Notice key={reason} kind="warn">
          Not written into {saved.part}: {reason}.
        </Notice>
      ))}
    </>
  );
}
