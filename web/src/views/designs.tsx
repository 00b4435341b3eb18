// The answer of one job: while it runs its progress, then the ranked list.
import { useEffect } from 'preact/hooks';

import { type Explanation, useExplained } from '../lib/explained';
import { ended, pathOf, useJob, jobList, previousJob, refreshJobs } from '../lib/jobs';
import { usePreviousList } from '../lib/previous_list';
import { load } from '../lib/requirements';
import { go, link, redirect, route } from '../lib/route';
import type { Answer } from '../lib/types';
import { proofInWords, statusWord } from '../lib/words';
import { Chip, Notice, Panel } from '../ui/controls';
import { saveFile } from '../ui/files';
import { AgainButton, RankAgainButton } from '../ui/job';
import { NothingLeft } from './against_nominal';
import { ComparePanel } from './compare';
import { Conflicts } from './conflicts';
import { DataSheet } from './data_sheet';
import { DesignPage } from './design';
import { Guarantee } from './guarantee';
import { Bests } from './kinds';
import { ListChangesPanel } from './list_changes';
import { MovedOn } from './moved_on';
import { ProgressPanel } from './progress';
import { Ranked } from './ranked';
import { Remarks } from './remarks';
import { isUnderWay, Why } from './why';

function useNewestJob(id: string | undefined) {
  useEffect(() => {
    if (id) {
      previousJob.value = id;
      return;
    }
    void refreshJobs().then(
      () => {
        const newest = previousJob.value ?? jobList.value?.[0]?.id;
        if (newest && route.value.path[0] === 'designs' && !route.value.path[1])
          redirect(['designs', newest]);
      },
      () => undefined,
    );
  }, [id]);
}

export function DesignsView() {
  const [, id, rank, page] = route.value.path;
  useNewestJob(id);
  const now = useJob(id ? pathOf(id) : null);
  const { answer, saved, explanation } = useExplained(id ?? '', now?.job?.result ?? null);
  if (!id) {
    return (
      <Panel first title="Designs">
        <p>
          No search yet. <a href={link(['requirements'])}>Write the requirements</a> and start one.
        </p>
      </Panel>
    );
  }
  if (!now?.job) {
    return now?.problem ? (
      <Panel first title="Designs">
        <Notice kind="bad">{now.problem.message}</Notice>
        <p>
          <a href={link(['jobs'])}>All searches</a>
        </p>
      </Panel>
    ) : (
      <p class="loading" role="status">
        Loading…
      </p>
    );
  }
  if (!ended(now.job.status)) {
    return (
      <>
        <h1 class="lone">{now.job.name || 'Designs'}</h1>
        <ProgressPanel watched={now} self={pathOf(id)} />
      </>
    );
  }
  if (!answer) {
    return (
      <Panel first title={now.job.name || 'Designs'}>
        <Notice kind={now.job.status === 'failed' ? 'bad' : 'warn'}>
          {now.job.detail ?? 'The search was cancelled before it began.'}
        </Notice>
        <AgainButton self={pathOf(id)} name={now.job.name || 'unnamed'} />
      </Panel>
    );
  }
  if (rank === 'compare') return <ComparePanel answer={answer} id={id} />;
  if (rank && page === 'sheet')
    return <DataSheet answer={answer} job={now.job} rank={Number(rank)} key={`${id}/${rank}`} />;
  if (rank) return <DesignPage answer={answer} id={id} rank={Number(rank)} key={`${id}/${rank}`} />;
  return <List answer={answer} saved={saved!} id={id} explanation={explanation} key={id} />;
}

// The list that it is compared with: the one chosen, or that of before the catalogue changed.
function useSince(id: string, answer: Answer) {
  const previous = usePreviousList(id, answer);
  const chosen = route.value.query.get('with') ?? previous;
  const since = chosen === 'none' ? null : chosen;
  return { id: since, answer: useJob(since ? pathOf(since) : null)?.job?.result ?? undefined };
}

function List(props: {
  answer: Answer;
  saved: Answer;
  id: string;
  explanation: Explanation | null;
}) {
  const { answer, id, explanation } = props;
  const since = useSince(id, answer);
  const isEmpty = answer.designs.length === 0;
  return (
    <>
      <Headline answer={answer} saved={props.saved} id={id} />
      {since.id && since.answer && (
        <ListChangesPanel answer={answer} other={since.answer} id={id} otherId={since.id} />
      )}
      {isEmpty && answer.against_nominal && <NothingLeft answer={answer} />}
      {answer.conflicts && <Conflicts answer={answer} />}
      {!isEmpty && (
        <>
          <Guarantee answer={answer} />
          <Why answer={answer} id={id} explanation={explanation} />
          <Ranked
            answer={answer}
            id={id}
            since={since}
            awaited={
              explanation && isUnderWay(explanation) && !answer.robust ? ['probability'] : []
            }
          />
        </>
      )}
      {!isEmpty && <Bests answer={answer} id={id} />}
      <Remarks of={answer} />
    </>
  );
}

function Headline({ answer, saved, id }: { answer: Answer; saved: Answer; id: string }) {
  const word = statusWord[answer.status];
  const measured = answer.best_on_measured_flow;
  return (
    <div class="headline">
      <div class="toolbar">
        <h1>{answer.name || 'Designs'}</h1>
        <Chip kind={word.kind}>{word.text}</Chip>
        {answer.requirements.model && answer.requirements.model !== 'nominal' && (
          <Chip>model {answer.requirements.model}</Chip>
        )}
        <span class="toolbar-group">
          <button
            type="button"
            onClick={() => {
              load(answer.asked ?? answer.requirements);
              go(['requirements']);
            }}
          >
            Edit requirements
          </button>
          <RankAgainButton
            answer={answer}
            label="Rank again"
            tip="The same requirements with the catalogue as it is now"
          />
          <button
            type="button"
            onClick={() =>
              saveFile(`${answer.name || id}-designs.json`, `${JSON.stringify(saved, null, 2)}\n`)
            }
          >
            Save JSON
          </button>
        </span>
      </div>
      <p class="proof">
        {proofInWords(answer)}{' '}
        {answer.catalogue_revision && (
          <span class="muted">Catalogue revision {answer.catalogue_revision.number}.</span>
        )}{' '}
        {measured !== null && measured > 1 && (
          <span>
            Best on measured flow data:{' '}
            <a href={link(['designs', id, String(measured)])}>#{measured}</a>.
          </span>
        )}
        {measured === null && answer.designs.length > 0 && (
          <span class="muted">Every design listed has a flow number that is an estimate.</span>
        )}
      </p>
      {(answer.hints ?? []).map(({ configuration, words }) => (
        <p key={configuration} class="hint">
          Not asked for: {words}.
        </p>
      ))}
      <MovedOn answer={answer} />
    </div>
  );
}
