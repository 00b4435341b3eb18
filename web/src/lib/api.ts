// Talks to the service. What it refuses is thrown as a Problem.

export interface FieldError {
  pointer: string;
  detail: string;
}

export class Problem extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly errors: FieldError[] = [],
  ) {
    super(message);
  }
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
    return new Problem(response.status, detail, errors);
  } catch {
    return new Problem(response.status, `the service answered ${response.status}`);
  }
}

export async function ask<T>(
  method: string,
  path: string,
  options: { body?: unknown; text?: string; headers?: Record<string, string>; signal?: AbortSignal } = {},
): Promise<Answered<T>> {
  const headers: Record<string, string> = { ...options.headers };
  let body: string | undefined = options.text;
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
  if (!response.ok) throw await problemOf(response);
  const text = response.status === 204 ? '' : await response.text();
  const isJson = (response.headers.get('Content-Type') ?? '').includes('json');
  return { body: (isJson && text ? JSON.parse(text) : text) as T, status: response.status, headers: response.headers };
}

export const get = async <T>(path: string): Promise<T> => (await ask<T>('GET', path)).body;
export const post = async <T>(path: string, body: unknown, signal?: AbortSignal): Promise<T> =>
  (await ask<T>('POST', path, { body, signal })).body;

export function asProblem(error: unknown): Problem {
  if (error instanceof Problem) return error;
  return new Problem(0, error instanceof Error ? error.message : String(error));
}
