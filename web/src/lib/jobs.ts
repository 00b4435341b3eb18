// Design jobs: started, followed, cancelled, and their answers once fetched.
import { signal } from '@preact/signals';

import { ask, asProblem, get, post, type Problem } from './api';
import type { Answer, Job, JobStatus, Progress, Requirements } from './types';

export interface Watched<Result = Answer> {
  job: Job<Result> | null;
  trace: Progress[]; // reports so far
  problem: Problem | null;
}

export const ended = (status: JobStatus): boolean => status !== 'queued' && status !== 'running';

// By the job's address, "/v1/designs/ID".
export const watched = signal<Record<string, Watched>>({});

function put(self: string, patch: Partial<Watched>): void {
  const old = watched.peek()[self] ?? { job: null, trace: [], problem: null };
  watched.value = { ...watched.peek(), [self]: { ...old, ...patch } };
}

const following = new Set<string>();

async function fetchJob(self: string): Promise<void> {
  const job = await get<Job>(self);
  put(self, { job, problem: null });
}

// Loads a job and follows it to its end.
export async function follow(self: string): Promise<void> {
  const known = watched.peek()[self]?.job;
  if (following.has(self) || (known && ended(known.status))) return;
  following.add(self);
  try {
    await fetchJob(self);
    while (!ended(watched.peek()[self]!.job!.status)) {
      await untilNews(self);
      await fetchJob(self);
    }
  } catch (error) {
    put(self, { problem: asProblem(error) });
  } finally {
    following.delete(self);
  }
}

// The event stream to its end; where there is none, a second.
function untilNews(self: string): Promise<void> {
  return new Promise((resolve) => {
    const events = new EventSource(`${self}/events`);
    const done = () => {
      events.close();
      resolve();
    };
    events.addEventListener('progress', (event) => {
      const { status, progress } = JSON.parse((event as MessageEvent).data);
      const now = watched.peek()[self];
      if (!now?.job) return;
      put(self, {
        job: { ...now.job, status, progress: progress ?? now.job.progress },
        trace: progress ? [...now.trace, progress] : now.trace,
      });
    });
    events.addEventListener('end', done);
    events.addEventListener('error', () => setTimeout(done, 1000));
  });
}

export async function start(requirements: Requirements): Promise<string> {
  const accepted = await post<{ id: string }>('/v1/designs', requirements);
  return accepted.id;
}

export async function cancel(self: string): Promise<void> {
  await ask('DELETE', self);
}

export const jobList = signal<Job[] | null>(null);

export async function refreshJobs(): Promise<void> {
  jobList.value = (await get<{ jobs: Job[] }>('/v1/designs')).jobs;
}

// Jobs of this visit that were looked at, newest first; what the page compares with.
export const previousJob = signal<string | null>(null);
