// The address after "#" is the state that can be shared: a path and a query.
import { computed, signal } from '@preact/signals';

export interface Route {
  path: string[];
  query: URLSearchParams;
}

function parse(hash: string): Route {
  const [path = '', query = ''] = hash.replace(/^#\/?/, '').split('?', 2);
  return {
    path: path.split('/').filter(Boolean).map(decodeURIComponent),
    query: new URLSearchParams(query),
  };
}

export const route = signal<Route>(parse(location.hash));
export const view = computed(() => route.value.path[0] ?? 'requirements');

addEventListener('hashchange', () => {
  route.value = parse(location.hash);
});

export function link(path: string[], query: Record<string, string | undefined> = {}): string {
  const params = new URLSearchParams();
  for (const [name, value] of Object.entries(query)) if (value) params.set(name, value);
  const text = params.toString();
  return `#/${path.map(encodeURIComponent).join('/')}${text ? `?${text}` : ''}`;
}

export function go(path: string[], query: Record<string, string | undefined> = {}): void {
  location.hash = link(path, query);
}

// Goes on from an address that shows nothing of its own: "back" skips it.
export function redirect(path: string[]): void {
  location.replace(link(path));
}

// Browsers refuse many changes of the address in a row, as while something is dragged.
const addressPeriodMs = 200;
let written = 0;
let later = 0;

function writeAddress(): void {
  clearTimeout(later);
  const wait = written + addressPeriodMs - performance.now();
  if (wait > 0) {
    later = window.setTimeout(writeAddress, wait);
    return;
  }
  const { path, query } = route.peek();
  if (parse(location.hash).path.join('/') !== path.join('/')) return; // another view was gone to
  written = performance.now();
  history.replaceState(null, '', link(path, Object.fromEntries(query)));
}

// Changes names of the query in place; an empty value removes its name. No entry in the history.
export function setQuery(patch: Record<string, string | undefined>): void {
  const { path, query } = route.peek();
  const next = new URLSearchParams(query);
  for (const [name, value] of Object.entries(patch)) {
    if (value) next.set(name, value);
    else next.delete(name);
  }
  if (next.toString() === query.toString()) return;
  route.value = { path, query: next };
  writeAddress();
}
