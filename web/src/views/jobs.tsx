// Searches and diagnoses that the service knows, the newest first.
import type { ComponentChildren } from 'preact';
import { useEffect } from 'preact/hooks';

import { duration, significant } from '../lib/format';
import { diagnosisList, jobList, refreshDiagnoses, refreshJobs } from '../lib/jobs';
import { link } from '../lib/route';
import type { JobStatus } from '../lib/types';
import { Chip, Panel } from '../ui/controls';

const periodMs = 2000;

const kinds: Record<JobStatus, string> = {
  queued: 'warn',
  running: 'warn',
  done: 'good',
  cancelled: 'warn',
  failed: 'bad',
};

interface Row {
  id: string;
  name: string;
  status: JobStatus;
  href: string;
  more: ComponentChildren[];
}

export function JobsView() {
  useEffect(() => {
    const refresh = () =>
      void Promise.all([refreshJobs(), refreshDiagnoses()]).catch(() => undefined);
    refresh();
    const timer = setInterval(refresh, periodMs);
    return () => clearInterval(timer);
  }, []);
  return (
    <>
      <Panel first title="Searches">
        <Jobs
          label="Searches"
          heads={['best', 'took']}
          rows={jobList.value?.map((job) => ({
            ...job,
            href: link(['designs', job.id]),
            more: [
              significant(job.progress?.best ?? null, 4),
              job.progress ? duration(job.progress.seconds) : '–',
            ],
          }))}
        >
          None yet. <a href={link(['requirements'])}>Write the requirements</a> and start one.
        </Jobs>
      </Panel>
      <Panel title="Diagnoses">
        <Jobs
          label="Diagnoses"
          heads={['took']}
          rows={diagnosisList.value?.map((job) => ({
            ...job,
            href: link(['measured'], { job: job.id }),
            more: [job.progress ? duration(job.progress.seconds) : '–'],
          }))}
        >
          None yet. <a href={link(['measured'])}>Drop a measurement</a> to start one.
        </Jobs>
      </Panel>
    </>
  );
}

function Jobs(props: {
  label: string;
  heads: string[];
  rows: Row[] | undefined;
  children: ComponentChildren; // what to say of none
}) {
  if (!props.rows) return <p role="status">Loading…</p>;
  if (props.rows.length === 0) return <p>{props.children}</p>;
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={props.label}>
      <table>
        <thead>
          <tr>
            <th scope="col">name</th>
            <th scope="col">status</th>
            {props.heads.map((head) => (
              <th key={head} scope="col" class="num">
                {head}
              </th>
            ))}
            <th scope="col">id</th>
          </tr>
        </thead>
        <tbody>
          {props.rows.map((row) => (
            <tr key={row.id}>
              <th scope="row">
                <a href={row.href}>{row.name || 'unnamed'}</a>
              </th>
              <td>
                <Chip kind={kinds[row.status]}>{row.status}</Chip>
              </td>
              {row.more.map((cell, i) => (
                <td key={i} class="num">
                  {cell}
                </td>
              ))}
              <td>
                <code>{row.id}</code>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
