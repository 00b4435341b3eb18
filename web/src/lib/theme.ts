// Light or dark: the system's choice unless the user made one.
import { effect, signal } from '@preact/signals';

export type Theme = 'system' | 'light' | 'dark';
const saved = localStorage.getItem('theme');
export const theme = signal<Theme>(saved === 'light' || saved === 'dark' ? saved : 'system');

// Grows with every change of colours, so that canvases paint themselves again.
export const palette = signal(0);

effect(() => {
  const chosen = theme.value;
  localStorage.setItem('theme', chosen);
  if (chosen === 'system') delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = chosen;
  palette.value = palette.peek() + 1;
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
  palette.value = palette.peek() + 1;
});

const probe = document.createElement('span');
probe.hidden = true;

const known = new Map<string, string>();
effect(() => {
  void palette.value;
  known.clear();
});

// The colour that a custom property of the style sheet stands for now, as canvases need it.
export function colour(name: string): string {
  const found = known.get(name);
  if (found) return found;
  if (!probe.isConnected) document.body.append(probe);
  probe.style.color = `var(${name})`;
  const value = getComputedStyle(probe).color;
  known.set(name, value);
  return value;
}

export const seriesColours = ['--c1', '--c2', '--c3', '--c4', '--c5', '--c6'] as const;
