// Searches and diagnoses that the service knows, the newest first.
import { useSignal } from '@preact/signals';
import { type ComponentChildren, Fragment } from 'preact';
import { useEffect } from 'preact/hooks';

import { objectiveName, objectiveUnit } from '../lib/amounts';
import { asProblem } from '../lib/api';
import { duration, moment, significant } from '../lib/format';
import { diagnosisList, ended, jobList, refreshDiagnoses, refreshJobs } from '../lib/jobs';
import { link } from '../lib/route';
import { refreshSweeps, sweepList } from '../lib/sweeps';
import type { Job, Progress } from '../lib/types';
import { noteText, statusWord, type Word, verdictWord } from '../lib/words';
import { Chip, Notice, Panel } from '../ui/controls';
import { AgainButton } from '../ui/job';
import { extra, heard, number, Table } from '../ui/table';

const periodMs = 2000;

export function JobsView() {
  const problem = useSignal('');
  useEffect(() => {
    const refresh = () =>
      void Promise.all([refreshJobs(), refreshDiagnoses(), refreshSweeps()]).then(
        () => (problem.value = ''),
        (error) => (problem.value = asProblem(error).message),
      );
    refresh();
    const timer = setInterval(refresh, periodMs);
    return () => clearInterval(timer);
  }, []);
  return (
    <>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      <Panel first title="Searches">
        <Jobs
          label="Searches"
          jobs={jobList.value}
          found="best"
          words={statusWord}
          href={(id) => link(['designs', id])}
          none={
            <>
              None yet. <a href={link(['requirements'])}>Write the requirements</a> and start one.
            </>
          }
        >
          {({ progress }) =>
            progress && progress.best !== null
              ? `${significant(progress.best, 4)} ${objectiveUnit(progress)}`
              : '–'
          }
        </Jobs>
      </Panel>
      <Sweeps />
      <Panel title="Diagnoses">
        <Jobs
          label="Diagnoses"
          jobs={diagnosisList.value}
          words={verdictWord}
          href={(id) => link(['measured'], { job: id })}
          none={
            <>
              None yet. <a href={link(['measured'])}>Drop a measurement</a> to start one.
            </>
          }
        />
      </Panel>
    </>
  );
}

function Sweeps() {
  const sweeps = sweepList.value ?? [];
  if (sweeps.length === 0) return null;
  return (
    <Panel title="Sweeps">
      <Table
        label="Sweeps"
        heads={['name', 'result', number('searches'), number('ended'), 'started']}
      >
        {sweeps.map((sweep) => {
          const all = Object.values(sweep.jobs).reduce((sum, count) => sum + count, 0);
          const word = statusWords[sweep.status]!;
          return (
            <tr key={sweep.id}>
              <th scope="row">
                <a href={link(['sweep', sweep.id])}>{sweep.name || 'unnamed'}</a>
              </th>
              <td>
                <Chip kind={word.kind}>{word.text}</Chip>
              </td>
              <td class="num">{all}</td>
              <td class="num">{all - sweep.jobs.queued - sweep.jobs.running}</td>
              <td class="nowrap">{moment(sweep.submitted_at)}</td>
            </tr>
          );
        })}
      </Table>
    </Panel>
  );
}

const statusWords: Record<string, Word> = {
  queued: { text: 'queued', kind: 'warn' },
  running: { text: 'running', kind: 'warn' },
  done: { text: 'done', kind: 'good' },
  cancelled: { text: 'cancelled', kind: 'warn' },
  failed: { text: 'failed', kind: 'bad' },
};

const times = (count: number): string => (count === 1 ? 'once' : `${count} times`);

// What a reader should know of a job beside its outcome.
function remarkOn(job: Job<unknown, unknown>): string {
  if (job.detail) return `${job.detail} (attempts: ${job.attempts})`;
  if (job.crashes === 0 || ended(job.status)) return '';
  return `Its computation ended the service ${times(job.crashes)}, by ${job.last_crash}; it runs alone.`;
}

// "least mass", or a weighted sum or a front of several.
function rankedBy(progress: Progress | null): string {
  if (!progress) return '–';
  return progress.objective?.pareto ? 'Pareto front' : `least ${objectiveName(progress)}`;
}

function Jobs<Report extends { seconds: number; outcome?: string }>(props: {
  label: string;
  jobs: Job<unknown, Report>[] | null;
  found?: string; // what the children say of a job
  words: Record<string, Word>; // of what it found in the end
  href: (id: string) => string;
  none: ComponentChildren;
  children?: (job: Job<unknown, Report>) => ComponentChildren;
}) {
  if (!props.jobs) return <p role="status">Loading…</p>;
  if (props.jobs.length === 0) return <p>{props.none}</p>;
  return (
    <Table
      label={props.label}
      heads={[
        'name',
        'result',
        ...(props.found ? ['ranked by', number(props.found)] : []),
        number('took'),
        'started',
        extra(number('catalogue revision')),
        extra({ text: 'id' }),
        heard('do it again'),
      ]}
    >
      {props.jobs.map((job) => {
        const outcome = ended(job.status) ? job.progress?.outcome : undefined;
        const word = (outcome && props.words[outcome]) || statusWords[job.status]!;
        const remark = remarkOn(job);
        const note = noteText((job.progress as Progress | null)?.note);
        return (
          <Fragment key={job.id}>
            <tr>
              <th scope="row">
                <a href={props.href(job.id)}>{job.name || 'unnamed'}</a>
                {note && <small class="job-note">{note}</small>}
              </th>
              <td>
                <Chip kind={word.kind}>{word.text}</Chip>
              </td>
              {props.children && <td>{rankedBy(job.progress as Progress | null)}</td>}
              {props.children && <td class="num">{props.children(job)}</td>}
              <td class="num">{job.progress ? duration(job.progress.seconds) : '–'}</td>
              <td class="nowrap">{moment(job.submitted_at)}</td>
              <td class="num extra">{job.catalogue_revision.number}</td>
              <td class="extra">
                <code>{job.id}</code>
              </td>
              <td>
                {(job.status === 'failed' || job.status === 'cancelled') && (
                  <AgainButton self={job.links.self} name={job.name || 'unnamed'} />
                )}
              </td>
            </tr>
            {remark && (
              <tr>
                <td class="muted" colSpan={props.found ? 9 : 7}>
                  {remark}
                </td>
              </tr>
            )}
          </Fragment>
        );
      })}
    </Table>
  );
}
