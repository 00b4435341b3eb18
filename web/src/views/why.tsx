// Why the first design is first: what it is made of, what holds it back, how far the next ones are,
// what each requirement costs, and how sure it is.
import { useSignal } from '@preact/signals';

import {
  leastMargin,
  objectiveName,
  objectiveUnit,
  requirementName,
  requirementNumber,
  requirementUnit,
  supplyWord,
} from '../lib/amounts';
import { asProblem } from '../lib/api';
import { change, duration, percent, significant } from '../lib/format';
import { explain, type Explanation, foundNothing } from '../lib/explained';
import { ended } from '../lib/jobs';
import { link } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { familyWord } from '../lib/words';
import { Notice, Panel } from '../ui/controls';
import { Bar, CancelButton } from '../ui/job';
import { ShareBar } from '../ui/share_bar';
import { extra, number, Table } from '../ui/table';
import { partsInShort } from './ranked_table';
import { kindsAsked } from '../lib/vacuum';

export function Why({
  answer,
  id,
  explanation,
}: {
  answer: Answer;
  id: string;
  explanation: Explanation | null;
}) {
  const first = answer.designs[0]!;
  const next = answer.designs[1];
  const isFront = answer.front !== undefined;
  return (
    <Panel
      title={isFront ? 'The front' : `Why #1 is first`}
      aside={<Explain answer={answer} id={id} explanation={explanation} />}
    >
      {explanation && <Explaining explanation={explanation} />}
      <div class={answer.prices ? 'plots even' : ''}>
        {!isFront && (
          <ul class="reasons">
            <li>
              It has the least {objectiveName(answer.requirements)} of all combinations
              {answer.guarantee ? ' that are guaranteed' : ''}
              {answer.status === 'optimal' ? '' : ' found'}:{' '}
              <b>
                {answer.price_basis === 'lower_bound' && objectiveUnit(answer.requirements) === '€'
                  ? `≥ ${significant(first.totals.cost_eur_min ?? null, 4)}`
                  : significant(first.objective, 4)}{' '}
                {objectiveUnit(answer.requirements)}
              </b>
              {sharesOf(first)}
            </li>
            {answer.price_basis === 'lower_bound' && (
              <li>
                Unknown prices count as 0
                {first.totals.cost_eur === null && (
                  <>
                    : of its parts those with a price cost{' '}
                    <b>{significant(first.totals.cost_eur_min ?? null, 4)} €</b>
                  </>
                )}
                .
              </li>
            )}
            <li>{tightest(first, answer)}</li>
            {next && (
              <li>
                <a href={link(['designs', id, '2'])}>#2</a> {distance(next, first)}: other parts are{' '}
                {partsInShort(next, first) || 'none, but their number'}. {toBeFirst(next, answer)}
              </li>
            )}
            <li>{otherSupplies(answer, id)}</li>
            {first.robustness && (
              <li>
                Within the tolerances of its parts it meets everything in{' '}
                <b>{percent(first.robustness.probability, 0)}</b> of {answer.robust?.draws} draws
                and is the best of the list in {percent(first.robustness.share_rank_1, 0)}
                {surest(answer, id)}.
              </li>
            )}
          </ul>
        )}
        {isFront && (
          <p>
            {first.robustness
              ? `Each design was drawn ${answer.robust?.draws} times within the tolerances of its parts; see the column probability.`
              : 'Each design of the front is the best for some trade between the amounts.'}
          </p>
        )}
        {answer.prices && answer.prices.length > 0 && <Prices answer={answer} />}
      </div>
    </Panel>
  );
}

function sharesOf(design: Design): string {
  const byFamily = new Map<string, number>();
  for (const { family, mass_kg } of design.parts)
    byFamily.set(family, (byFamily.get(family) ?? 0) + mass_kg);
  const most = [...byFamily].sort((a, b) => b[1] - a[1]).slice(0, 3);
  return `. Of its mass, ${most.map(([family, kg]) => `${familyWord(family)} ${percent(kg / design.totals.mass_kg, 0)}`).join(', ')}.`;
}

function tightest(design: Design, answer: Answer) {
  const least = leastMargin(design);
  const margin = design.margins.find((m) => m.relative_margin === least)!;
  const name = requirementName(margin.requirement, answer.requirements.actuators);
  return (
    <>
      {margin.binding ? 'It is held back by ' : 'No requirement binds; the tightest is '}
      <b>{name}</b>, {percent(least)} to spare.
    </>
  );
}

function distance(design: Design, first: Design): string {
  const share = design.objective / first.objective - 1;
  return Math.abs(share) < 1e-6 ? 'is equal to it' : `comes ${change(share)} behind`;
}

// What a part would have to do less of for its design to be first.
function reduced({ requirements }: Answer): string {
  const minimize = requirements.objective?.minimize ?? 'mass_kg';
  const verbs = { mass_kg: 'weigh', volume_l: 'take up', cost_eur: 'cost', energy_wh: 'draw' };
  return typeof minimize === 'string' ? verbs[minimize] : 'count';
}

function toBeFirst(design: Design, answer: Answer): string {
  const flip = design.to_be_first;
  if (!flip) return '';
  const part = [...flip.parts].sort((a, b) => a.reduction_share - b.reduction_share)[0];
  const requirement = flip.requirements[0];
  const ways = [
    part &&
      part.reduction_share > 5e-4 &&
      `its ${familyWord(part.family)} would have to ${reduced(answer)} ${percent(part.reduction_share)} less`,
    requirement &&
      `${requirementName(requirement.requirement, answer.requirements.actuators)} would have to be ${requirementNumber(requirement.requirement, requirement.tightened)} ${requirementUnit(requirement.requirement)}`,
  ].filter(Boolean);
  return ways.length ? `To be first, ${ways.join(', or ')}.` : '';
}

// The first design of each other kind of supply that was asked for.
function otherSupplies(answer: Answer, id: string) {
  const first = answer.designs[0]!;
  const asked = kindsAsked(answer.requirements);
  const others = asked.filter((kind) => kind !== first.configuration);
  const found = others.flatMap(
    (kind) => answer.designs.find((d) => d.configuration === kind) ?? [],
  );
  const none = others.filter((kind) => !found.some((d) => d.configuration === kind));
  return (
    <>
      {others.length === 0 && 'No other kind of supply was asked for.'}
      {found.map((d) => (
        <span key={d.rank}>
          Best {supplyWord(d)}: <a href={link(['designs', id, String(d.rank)])}>#{d.rank}</a>,{' '}
          {change(d.objective / first.objective - 1)}.{' '}
        </span>
      ))}
      {none.length > 0 &&
        `No ${none.map((configuration) => supplyWord({ configuration })).join(' and no ')} supply is among the best ${answer.designs.length}.`}
    </>
  );
}

function surest(answer: Answer, id: string) {
  const first = answer.designs[0]!;
  const best = answer.designs.reduce((a, b) =>
    (b.robustness?.probability ?? 0) > (a.robustness?.probability ?? 0) ? b : a,
  );
  if (best === first) return '; no design listed is surer';
  return (
    <>
      ; the surest listed is <a href={link(['designs', id, String(best.rank)])}>#{best.rank}</a>{' '}
      with {percent(best.robustness!.probability, 0)}
    </>
  );
}

// Asks for what the answer does not say: prices, what #2 to #4 lack, draws within tolerances.
function Explain(props: { answer: Answer; id: string; explanation: Explanation | null }) {
  const { answer, id, explanation } = props;
  const problem = useSignal('');
  const busy = useSignal(false);
  const isSure = answer.robust !== undefined || answer.guarantee !== undefined;
  const wasStopped = explanation?.watched.job?.status === 'cancelled';
  if (isSure && (answer.prices || answer.front) && !wasStopped) return null;
  if (explanation && isUnderWay(explanation)) return <CancelButton self={explanation.self} />;
  const run = async () => {
    busy.value = true;
    problem.value = '';
    try {
      await explain(id, answer);
    } catch (error) {
      problem.value = asProblem(error).message;
    }
    busy.value = false;
  };
  return (
    <>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      <button type="button" disabled={busy.value} onClick={() => void run()}>
        {answer.front
          ? 'How sure is it?'
          : answer.guarantee
            ? 'What do requirements cost?'
            : 'What do requirements cost, how sure is it?'}
      </button>
    </>
  );
}

export const isUnderWay = ({ watched }: Explanation): boolean =>
  watched.job === null ? watched.problem === null : !ended(watched.job.status);

// How far that is, and what came in its way. The list stays as it is meanwhile.
function Explaining({ explanation }: { explanation: Explanation }) {
  const { watched, fit } = explanation;
  const { job, problem } = watched;
  if (problem) return <Notice kind="bad">{problem.message}</Notice>;
  if (isUnderWay(explanation)) {
    const seconds = job?.progress?.seconds;
    return (
      <>
        <p role="status">
          {job?.status === 'queued'
            ? 'Waiting for its turn: what the requirements cost and how sure the designs are.'
            : 'Working out what the requirements cost and how sure the designs are.'}
          {seconds !== undefined && <span class="muted"> {duration(seconds)}</span>}
        </p>
        <Bar label="How far prices and draws are" share={null} />
      </>
    );
  }
  if (foundNothing(job?.result))
    return (
      <Notice kind={job?.status === 'failed' ? 'bad' : 'warn'}>
        {job?.detail ?? 'It was stopped before prices and draws were worked out.'}
      </Notice>
    );
  if (job?.status === 'cancelled')
    return (
      <Notice kind="warn">
        It was stopped: chances are of the {job.result?.robust?.draws ?? 0} draws until then
        {job.result?.prices?.some((row) => row.status === 'cancelled') &&
          ', and not all prices are worked out'}
        .
      </Notice>
    );
  return fit === 'same' ? null : (
    <Notice kind="warn">
      The catalogue or the time left was another one when this was worked out, and so was the list:
      prices are those of its first design, and designs that are not on it have no probability.
    </Notice>
  );
}

function Prices({ answer }: { answer: Answer }) {
  const most = Math.max(1e-9, ...answer.prices!.map((row) => row.saving_share ?? 0));
  const rows = [...answer.prices!].sort((a, b) => (b.saving ?? 0) - (a.saving ?? 0));
  return (
    <Table
      label="Prices of requirements"
      class="prices"
      heads={[
        'a tenth looser',
        number('asked'),
        extra(number('then')),
        number('saves', objectiveUnit(answer.requirements)),
        'of the best',
      ]}
    >
      {rows.map((row) => (
        <tr key={row.requirement}>
          <th scope="row">
            {requirementName(row.requirement, answer.requirements.actuators)}{' '}
            <small class="muted">{requirementUnit(row.requirement)}</small>
          </th>
          <td class="num">{requirementNumber(row.requirement, row.required)}</td>
          <td class="num extra">{requirementNumber(row.requirement, row.loosened)}</td>
          <td class="num">{isNothing(row.saving) ? '0' : significant(row.saving)}</td>
          <td>
            <ShareBar share={(row.saving_share ?? 0) / most} mark="least">
              {isNothing(row.saving) ? 'nothing' : percent(row.saving_share)}
              {row.status !== 'optimal' && <small class="muted"> not proved</small>}
            </ShareBar>
          </td>
        </tr>
      ))}
    </Table>
  );
}

const isNothing = (saving: number | null): boolean => saving !== null && Math.abs(saving) < 1e-9;
