// Why a design is not the first, and what becomes of it with other parts.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, type Problem } from '../lib/api';
import { loadFamily } from '../lib/catalogue';
import { compareWith, type Evaluation, exchanged, placeOf } from '../lib/evaluation';
import { fieldName, pressuresInUnit } from '../lib/format';
import type { Answer, Design, PartRow } from '../lib/types';
import { Notice, Panel, TextField } from '../ui/controls';

// What is typed comes to rest before it is asked about.
const restMs = 300;

export function Exchange({ answer, design }: { answer: Answer; design: Design }) {
  const ids = useSignal<Record<string, string>>({});
  const options = useSignal<Record<string, string[]>>({});
  const found = useSignal<Evaluation | null>(null);
  const problem = useSignal<Problem | null>(null);
  const first = answer.designs[0]!;
  const isChanged = Object.keys(ids.value).length > 0;

  useEffect(() => {
    ids.value = {};
    for (const family of new Set(design.parts.map((row) => row.family)))
      void loadFamily(family).then((parts) => {
        options.value = { ...options.value, [family]: parts.map((part) => part.id) };
      });
  }, [design]);

  useEffect(() => {
    if (!isChanged && design.rank === first.rank) {
      found.value = problem.value = null;
      return;
    }
    let isOld = false;
    const ask = async () => {
      try {
        const given = await exchanged(design, answer.requirements, ids.value);
        const answered = await compareWith(first, given, answer.requirements);
        if (isOld) return;
        found.value = answered;
        problem.value = null;
      } catch (error) {
        if (isOld) return;
        found.value = null;
        problem.value = asProblem(error);
      }
    };
    const timer = setTimeout(() => void ask(), isChanged ? restMs : 0);
    return () => {
      isOld = true;
      clearTimeout(timer);
    };
  }, [design, ids.value]);

  const set = (row: PartRow, id: string) => {
    const { [placeOf(row)]: _, ...others } = ids.value;
    ids.value = id === row.id ? others : { ...others, [placeOf(row)]: id };
  };
  return (
    <Panel
      title={design.rank === first.rank ? 'Another part' : 'Why it is not first, and another part'}
      aside={
        isChanged && (
          <button type="button" class="quiet small" onClick={() => (ids.value = {})}>
            As designed
          </button>
        )
      }
    >
      <div class="exchange">
        <div class="fields">
          {design.parts.map((row) => (
            <TextField
              key={placeOf(row)}
              label={`${fieldName(row.family).label}${row.group === null ? '' : ` for ${row.group}`}`}
              value={ids.value[placeOf(row)] ?? row.id}
              options={options.value[row.family]}
              onChange={(id) => set(row, id.trim())}
            />
          ))}
        </div>
        <div role="status">
          {problem.value && <Notice kind="bad">{problem.value.sentence}</Notice>}
          {found.value && <Verdict found={found.value} isChanged={isChanged} />}
          {!found.value && !problem.value && (
            <p class="hint">
              It is the first of its list. Exchange a part, and see what it then misses or costs.
            </p>
          )}
        </div>
      </div>
    </Panel>
  );
}

function Verdict(props: { found: Evaluation; isChanged: boolean }) {
  const { works, margins, why_not_first } = props.found;
  const missed = (margins ?? []).filter((margin) => margin.relative_margin < -1e-9);
  return (
    <>
      {props.isChanged && (
        <Notice kind={works && missed.length === 0 ? 'good' : 'warn'}>
          {works && missed.length === 0
            ? 'With these parts, at the settings of the design, it meets every requirement.'
            : 'With these parts, at the settings of the design, it does not meet every requirement.'}
        </Notice>
      )}
      <ul class="words">
        {(why_not_first?.words ?? ['Why it is not first is not known: time ran out.']).map(
          (sentence) => (
            <li key={sentence}>{pressuresInUnit(sentence)}</li>
          ),
        )}
      </ul>
    </>
  );
}
