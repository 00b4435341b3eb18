// What the revised model changes in the ranking, and what the nominal designs miss with it.
import {
  objectiveUnit,
  requirementName,
  requirementNumber,
  requirementUnit,
  sense,
} from '../lib/amounts';
import { change, significant } from '../lib/format';
import type { Answer } from '../lib/types';
import { Panel } from '../ui/controls';

type Nominal = NonNullable<Answer['against_nominal']>;
type Dropped = Nominal['dropped'][number];

function whyDropped(why: Dropped['why'], groups: { name: string }[]): string {
  if (why === null) return 'others are better now';
  if (typeof why === 'string') return why;
  const { requirement, required, achieved } = why;
  const unit = requirementUnit(requirement);
  return `misses ${requirementName(requirement, groups)}: ${requirementNumber(requirement, achieved)} instead of ${requirementNumber(requirement, required)} ${unit}`;
}

export function AgainstNominal({ answer }: { answer: Answer }) {
  const { designs, dropped } = answer.against_nominal!;
  const fresh = designs.filter((d) => d.nominal_rank === null).length;
  const was =
    dropped.find((d) => d.nominal_rank === 1)?.objective ??
    designs.find((d) => d.nominal_rank === 1)?.nominal?.objective;
  return (
    <div class="changes" role="status">
      <p>
        Against the nominal model: {fresh} new, {dropped.length} no longer listed.{' '}
        {was !== undefined &&
          answer.designs[0] &&
          `Best ${significant(was, 4)} → ${significant(answer.designs[0].objective, 4)} ${objectiveUnit(answer.requirements)} (${change(answer.designs[0].objective / was - 1)}).`}
      </p>
      <DroppedList answer={answer} summary="No longer listed" />
    </div>
  );
}

function DroppedList({ answer, summary }: { answer: Answer; summary: string }) {
  const { dropped } = answer.against_nominal!;
  if (dropped.length === 0) return null;
  return (
    <details>
      <summary>{summary}</summary>
      <ul class="history">
        {dropped.map((d) => (
          <li key={d.nominal_rank}>
            nominal #{d.nominal_rank}, {significant(d.objective, 4)}{' '}
            {objectiveUnit(answer.requirements)}: {whyDropped(d.why, answer.requirements.actuators)}
          </li>
        ))}
      </ul>
    </details>
  );
}

// What is missed most, by how many designs and how nearly it is met.
interface Missed {
  what: string;
  count: number;
  nearest: string;
}

function missedBy(dropped: Dropped[], groups: { name: string }[]): Missed[] {
  const kinds = new Map<string, Dropped[]>();
  for (const one of dropped) {
    if (one.why === null) continue;
    const key = typeof one.why === 'string' ? one.why : one.why.requirement;
    kinds.set(key, [...(kinds.get(key) ?? []), one]);
  }
  return [...kinds]
    .map(([key, ones]) => {
      const misses = ones.map((one) => one.why).filter((why) => typeof why === 'object');
      const [first] = misses;
      if (!first) return { what: key, count: ones.length, nearest: '' };
      const { requirement, required } = first;
      const least = sense(requirement) === '≥';
      const achieved = misses.map((why) => why!.achieved);
      const nearest = least ? Math.max(...achieved) : Math.min(...achieved);
      const text = (n: number) => requirementNumber(requirement, n);
      return {
        what: `${requirementName(requirement, groups)} ${sense(requirement)} ${text(required)} ${requirementUnit(requirement)} is missed`,
        count: ones.length,
        nearest: `, the nearest reaches ${text(nearest)} ${requirementUnit(requirement)}`,
      };
    })
    .sort((a, b) => b.count - a.count);
}

// Where the revised model leaves no design: what stands in the way of those that the nominal model
// would list.
export function NothingLeft({ answer }: { answer: Answer }) {
  const { status, dropped } = answer.against_nominal!;
  const isProved = answer.status === 'infeasible';
  const model = answer.model ? `${answer.model.name}, version ${answer.model.version},` : 'it';
  const missed = missedBy(dropped, answer.requirements.actuators);
  return (
    <Panel title={isProved ? 'What no design meets with this model' : 'What the model changes'}>
      <p>
        {isProved
          ? `With ${model} no combination of parts meets everything. `
          : `With ${model} no design was found in the time given. `}
        {dropped.length > 0
          ? `The nominal model lists ${dropped.length}; with the effects that were measured:`
          : status === 'infeasible'
            ? 'It is not the model: without its effects nothing meets these requirements, either.'
            : 'Without its effects none was found in the time given, either.'}
      </p>
      {missed.length > 0 && (
        <ul class="reasons">
          {missed.map(({ what, count, nearest }) => (
            <li key={what}>
              <b>{what}</b> in {count === dropped.length ? `all ${count}` : count}
              {nearest}
            </li>
          ))}
        </ul>
      )}
      <DroppedList answer={answer} summary="Each of them" />
    </Panel>
  );
}
