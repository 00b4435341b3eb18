// When the actuators of a group are filled within a period.
import { useState } from 'preact/hooks';
import { edit, errorAt, warningAt } from '../lib/requirements';
import type { Group } from '../lib/types';
import { TextField } from '../ui/controls';
import { RequirementField } from './requirement_field';

// One number for all, or one for each actuator; what is neither goes to the service as it is.
function phaseOf(text: string): Group['phase'] {
  const parts = text.split(/[\s,;]+/).filter((part) => part !== '');
  if (parts.length === 0) return undefined;
  const numbers = parts.map(Number);
  if (numbers.some((number) => Number.isNaN(number))) return text;
  return numbers.length === 1 ? numbers[0] : numbers;
}

const phaseText = (phase: Group['phase']): string =>
  phase === undefined ? '' : Array.isArray(phase) ? phase.join(', ') : String(phase);

export function GaitFields({ group, index }: { group: Group; index: number }) {
  const at = `/actuators/${index}/phase`;
  const error =
    errorAt(at) ?? [...Array(group.count).keys()].map((i) => errorAt(`${at}/${i}`)).find(Boolean);
  const [typed, type] = useState('');
  // As it was typed, as long as that is what the document holds.
  const same = JSON.stringify(phaseOf(typed)) === JSON.stringify(group.phase);
  const used =
    group.phase !== undefined ||
    group.inflate_fraction !== undefined ||
    group.strokes_per_period !== undefined;
  const warning = group.phase !== undefined ? warningAt('/duty/simultaneous') : undefined;
  return (
    <details class="gait" open={used}>
      <summary>Gait: when in the period</summary>
      <p class="muted">
        A phase of 0.25 begins a quarter of the period later. One number for all actuators, or one
        for each, as in “0, 0.25, 0.5, 0.75”.
      </p>
      <div class="fields">
        <TextField
          label="Phase"
          value={same ? typed : phaseText(group.phase)}
          error={error}
          pointer={at}
          onChange={(text) => {
            type(text);
            edit(['actuators', index, 'phase'], phaseOf(text));
          }}
        />
        <RequirementField
          label="Share of a stroke that inflates"
          path={['actuators', index, 'inflate_fraction']}
          usual={0.5}
          range={[0.01, 0.99]}
        />
        <RequirementField
          label="Strokes per period"
          path={['actuators', index, 'strokes_per_period']}
          usual={1}
          range={[1, 100]}
        />
      </div>
      {warning && <p class="muted">“Groups act”, under Duty, {warning}.</p>}
    </details>
  );
}
