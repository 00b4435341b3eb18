// Jobs, designs and diagnoses: started, followed, cancelled, and their answers once fetched.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { ask, asProblem, events, get, post, type Problem } from './api';
import type { Diagnosis } from './measurement';
import type { Answer, Doing, Job, JobStatus, Progress, Requirements } from './types';
import { inNumbers, withSides } from './understood';

export interface Watched<Result = Answer, Report = Progress> {
  job: Job<Result, Report> | null;
  trace: Report[]; // reports so far
  problem: Problem | null;
}

export const ended = (status: JobStatus): boolean => status !== 'queued' && status !== 'running';

// By the job's address, "/v1/designs/ID".
const watched = signal<Record<string, Watched<unknown, unknown>>>({});

function put(self: string, patch: Partial<Watched<unknown, unknown>>): void {
  const old = watched.peek()[self] ?? { job: null, trace: [], problem: null };
  watched.value = { ...watched.peek(), [self]: { ...old, ...patch } };
}

const following = new Set<string>();
const retryMs = 2000;
const later = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

// Loads a job and follows it to its end, also over times when the service does not answer, as long
// as the address names it.
async function follow(self: string): Promise<void> {
  const known = watched.peek()[self]?.job;
  if (following.has(self) || (known && ended(known.status))) return;
  following.add(self);
  const id = self.split('/').pop()!;
  do {
    try {
      for (;;) {
        const job = await get<Job<unknown, unknown>>(self);
        put(self, { job: withNumbers(job), problem: null });
        if (ended(job.status)) break;
        await untilNews(self);
      }
    } catch (error) {
      put(self, { problem: asProblem(error) });
      await later(retryMs);
    }
  } while (watched.peek()[self]!.problem?.status === 0 && location.hash.includes(id));
  following.delete(self);
}

// Designs are read with their requirements in numbers, whatever they were written in.
export function withNumbers<Result, Report>(job: Job<Result, Report>): Job<Result, Report> {
  const answer = job.result as Answer | null | undefined;
  if (answer?.schema !== 'designs/1') return job;
  const { requirements, understood = [] } = answer;
  return {
    ...job,
    result: {
      ...answer,
      requirements: withSides(inNumbers(requirements, understood)),
      asked: requirements,
    } as Result,
  };
}

// The event stream to its end; where there is none, a while.
async function untilNews(self: string): Promise<void> {
  try {
    await events(`${self}/events`, (event, data) => {
      const now = watched.peek()[self];
      if (event !== 'progress' || !now?.job) return event !== 'end';
      const { status, progress } = JSON.parse(data);
      put(self, {
        job: { ...now.job, status, progress: progress ?? now.job.progress },
        trace: progress ? [...now.trace, progress] : now.trace,
      });
      return true;
    });
  } catch {
    await later(retryMs / 2);
  }
}

export async function start(requirements: Requirements): Promise<string> {
  const accepted = await post<{ id: string }>('/v1/designs', requirements);
  return accepted.id;
}

export async function cancel(self: string): Promise<void> {
  await ask('DELETE', self);
}

// Does a job again that failed or was cancelled, and follows it.
export async function again(self: string): Promise<void> {
  await ask('POST', `${self}/again`);
  put(self, { job: null, trace: [], problem: null });
  void follow(self);
}

export const jobList = signal<Job[] | null>(null);

export async function refreshJobs(): Promise<void> {
  jobList.value = (await get<{ jobs: Job[] }>('/v1/designs')).jobs;
}

export type Diagnosing = Job<Diagnosis, Doing>;
export const diagnosisList = signal<Diagnosing[] | null>(null);

export async function refreshDiagnoses(): Promise<void> {
  diagnosisList.value = (await get<{ jobs: Diagnosing[] }>('/v1/diagnoses')).jobs;
}

// Jobs of this visit that were looked at, newest first; what the page compares with.
export const previousJob = signal<string | null>(null);

export const pathOf = (id: string): string => `/v1/designs/${id}`;
export const diagnosisPath = (id: string): string => `/v1/diagnoses/${id}`;

// The job at an address, loaded and followed.
export function useJob<Result = Answer, Report = Progress>(
  self: string | null,
): Watched<Result, Report> | undefined {
  useEffect(() => {
    if (self) void follow(self);
  }, [self]);
  return self ? (watched.value[self] as Watched<Result, Report> | undefined) : undefined;
}
