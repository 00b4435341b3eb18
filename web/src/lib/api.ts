// Talks to the service. What it refuses is thrown as a Problem.
import { signal } from '@preact/signals';

export interface FieldError {
  pointer: string;
  detail: string;
}

export class Problem extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly errors: FieldError[] = [],
    readonly body: Record<string, unknown> = {}, // the whole problem document
  ) {
    super(message);
  }
  // With what is wrong where.
  get sentence(): string {
    return [this.message, ...this.errors.map((e) => `${e.pointer} ${e.detail}`)].join('; ');
  }
}

// A service that others can reach asks for a token; it is kept as long as the window is open.
const kept = 'plenum-token';
export const wantsToken = signal<'' | 'none' | 'refused' | 'change'>('');
export const hasToken = (): boolean => sessionStorage.getItem(kept) !== null;

export function takeToken(token: string): void {
  sessionStorage.setItem(kept, token);
  location.reload();
}

function withToken(headers: Record<string, string>): Record<string, string> {
  const token = sessionStorage.getItem(kept);
  return token ? { ...headers, Authorization: `Bearer ${token}` } : headers;
}

export interface Answered<T> {
  body: T;
  status: number;
  headers: Headers;
}

async function problemOf(response: Response): Promise<Problem> {
  try {
    const body = await response.json();
    const errors: FieldError[] = body.errors ?? [];
    const detail = body.detail ?? body.title ?? response.statusText;
    return new Problem(response.status, detail, errors, body);
  } catch {
    return new Problem(response.status, `the service answered ${response.status}`);
  }
}

export async function ask<T>(
  method: string,
  path: string,
  options: {
    body?: unknown;
    text?: string | Blob;
    headers?: Record<string, string>;
    signal?: AbortSignal;
  } = {},
): Promise<Answered<T>> {
  const headers = withToken({ ...options.headers });
  let body: string | Blob | undefined = options.text;
  if (options.body !== undefined) {
    headers['Content-Type'] = 'application/json';
    body = JSON.stringify(options.body);
  }
  let response: Response;
  try {
    response = await fetch(path, { method, headers, body, signal: options.signal });
  } catch (error) {
    if (options.signal?.aborted) throw error;
    throw new Problem(0, 'the service does not answer; is plenum serve still running?');
  }
  if (response.status === 401) wantsToken.value = hasToken() ? 'refused' : 'none';
  if (!response.ok) throw await problemOf(response);
  return { body: await bodyOf<T>(response), status: response.status, headers: response.headers };
}

async function bodyOf<T>(response: Response): Promise<T> {
  const type = response.headers.get('Content-Type') ?? '';
  if (type === 'application/octet-stream') return (await response.blob()) as T;
  const text = response.status === 204 ? '' : await response.text();
  return (type.includes('json') && text ? JSON.parse(text) : text) as T;
}

export const get = async <T>(path: string): Promise<T> => (await ask<T>('GET', path)).body;
// The document at an address, or null where it is larger than that.
export async function getAtMost<T>(path: string, bytesMax: number): Promise<T | null> {
  const response = await fetch(path, { headers: withToken({}) });
  if (!response.ok) throw await problemOf(response);
  if (Number(response.headers.get('Content-Length')) <= bytesMax) return response.json();
  void response.body?.cancel();
  return null;
}
// A file that the service keeps, under the name that it says.
export async function getFile(path: string): Promise<{ name: string; content: Blob }> {
  const response = await fetch(path, { headers: withToken({}) });
  if (!response.ok) throw await problemOf(response);
  const said = response.headers.get('Content-Disposition') ?? '';
  const name = /filename\*=UTF-8''(\S+)/.exec(said)?.[1];
  return { name: decodeURIComponent(name ?? 'document'), content: await response.blob() };
}
export const post = async <T>(path: string, body: unknown, signal?: AbortSignal): Promise<T> =>
  (await ask<T>('POST', path, { body, signal })).body;

// The server-sent events at an address, until `take` says that it has enough or they end.
export async function events(
  path: string,
  take: (event: string, data: string) => boolean,
): Promise<void> {
  const response = await fetch(path, { headers: withToken({ Accept: 'text/event-stream' }) });
  if (!response.ok || !response.body) throw await problemOf(response);
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = '';
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    const blocks = (text + value).split('\n\n');
    text = blocks.pop()!;
    for (const block of blocks) {
      const field = (name: string) => new RegExp(`^${name}: (.*)$`, 'm').exec(block)?.[1];
      const event = field('event');
      if (!event || take(event, field('data') ?? '')) continue;
      void reader.cancel();
      return;
    }
  }
}

export function asProblem(error: unknown): Problem {
  if (error instanceof Problem) return error;
  return new Problem(0, error instanceof Error ? error.message : String(error));
}
