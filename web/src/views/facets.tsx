// Filters of the catalogue: ranges of numbers and values of texts, with counts.
import { computed } from '@preact/signals';

import { derivedTexts, estimatedShare, numberOf } from '../lib/catalogue';
import { fieldKind, fieldName, short } from '../lib/format';
import { route, setQuery } from '../lib/route';
import type { Family, Part } from '../lib/types';
import { readTyped } from '../lib/typed';
import { fromShown, toShown } from '../lib/units';

// Filters in the address: "n=mass_kg:0:1~…" ranges, "t=port:M5~…" values.
interface Filters {
  numbers: Record<string, [number, number]>;
  texts: Record<string, string[]>;
}

export const filters = computed<Filters>(() => {
  const query = route.value.query;
  const found: Filters = { numbers: {}, texts: {} };
  for (const item of (query.get('n') ?? '').split('~').filter(Boolean)) {
    const [field = '', low, high] = item.split(':');
    found.numbers[field] = [low ? Number(low) : -Infinity, high ? Number(high) : Infinity];
  }
  for (const item of (query.get('t') ?? '').split('~').filter(Boolean)) {
    const cut = item.indexOf(':');
    (found.texts[item.slice(0, cut)] ??= []).push(item.slice(cut + 1));
  }
  return found;
});

const bound = (value: number): string =>
  Number.isFinite(value) ? String(Number(value.toPrecision(7))) : '';

function setFilters(next: Filters): void {
  const numbers = Object.entries(next.numbers).filter(
    ([, [a, b]]) => Number.isFinite(a) || Number.isFinite(b),
  );
  setQuery({
    n: numbers.map(([field, [a, b]]) => `${field}:${bound(a)}:${bound(b)}`).join('~'),
    t: Object.entries(next.texts)
      .flatMap(([field, values]) => values.map((v) => `${field}:${v}`))
      .join('~'),
  });
}

// Whether a part passes all filters but that of one field, which is being counted.
export function passes(part: Part, chosen: Filters, but = ''): boolean {
  for (const [field, [low, high]] of Object.entries(chosen.numbers)) {
    const value = numberOf(part, field);
    if (field !== but && (value === null || value < low || value > high)) return false;
  }
  for (const [field, values] of Object.entries(chosen.texts)) {
    if (field !== but && values.length > 0 && !values.includes(String(part[field] ?? '')))
      return false;
  }
  return true;
}

export function Facets({ meta, list }: { meta: Family; list: Part[] }) {
  const chosen = filters.value;
  const texts = [
    'manufacturer',
    'series',
    ...meta.texts.map((t) => t.name),
    'orderable',
    ...derivedTexts,
    'origin',
  ];
  const estimated = {
    name: estimatedShare,
    meaning: "how much of the part's numbers and texts is estimated, 0 to 1",
  };
  const numbers = [...meta.numbers, estimated].filter((field) =>
    list.some((part) => numberOf(part, field.name) !== null),
  );
  const toggle = (field: string, value: string, on: boolean) => {
    const now = chosen.texts[field] ?? [];
    setFilters({
      ...chosen,
      texts: { ...chosen.texts, [field]: on ? [...now, value] : now.filter((v) => v !== value) },
    });
  };
  // What cannot be read is marked and filters nothing.
  const setBound = (field: string, end: 0 | 1, input: HTMLInputElement) => {
    const range: [number, number] = [...(chosen.numbers[field] ?? [-Infinity, Infinity])];
    const number = readTyped(input.value);
    const isEmpty = input.value.trim() === '';
    input.ariaInvalid = isEmpty || typeof number === 'number' ? null : 'true';
    if (!isEmpty && typeof number !== 'number') return;
    range[end] =
      typeof number === 'number' ? fromShown(fieldKind(field), number) : end ? Infinity : -Infinity;
    setFilters({ ...chosen, numbers: { ...chosen.numbers, [field]: range } });
  };
  const any =
    Object.values(chosen.texts).some((v) => v.length) || Object.keys(chosen.numbers).length > 0;
  return (
    <details class="facets" open={innerWidth > 1000}>
      <summary>Filters</summary>
      {any && (
        <button type="button" class="small" onClick={() => setFilters({ numbers: {}, texts: {} })}>
          Clear all
        </button>
      )}
      {numbers.map((field) => {
        const { label, unit } = fieldName(field.name);
        const inUnit = (value: number) => toShown(fieldKind(field.name), value);
        const values = list
          .map((p) => numberOf(p, field.name))
          .filter((v): v is number => v !== null);
        const range = chosen.numbers[field.name];
        return (
          <div key={field.name} class="facet" role="group" aria-label={`${label} ${unit}`}>
            <p class="facet-name" data-tip={field.meaning}>
              {label} <small>{unit}</small>
            </p>
            <Histogram
              values={list
                .filter((part) => passes(part, chosen, field.name))
                .map((part) => numberOf(part, field.name))
                .filter((v) => v !== null)}
              low={Math.min(...values)}
              high={Math.max(...values)}
              range={range}
              inUnit={inUnit}
              onPick={(from, to) =>
                setFilters({
                  ...chosen,
                  numbers: { ...chosen.numbers, [field.name]: [from, to] },
                })
              }
            />
            <span class="range">
              <input
                type="text"
                inputMode="decimal"
                aria-label={`${label}, at least`}
                value={range ? bound(inUnit(range[0])) : ''}
                placeholder={short(inUnit(Math.min(...values)), 3)}
                onChange={(e) => setBound(field.name, 0, e.currentTarget)}
              />
              …
              <input
                type="text"
                inputMode="decimal"
                aria-label={`${label}, at most`}
                value={range ? bound(inUnit(range[1])) : ''}
                placeholder={short(inUnit(Math.max(...values)), 3)}
                onChange={(e) => setBound(field.name, 1, e.currentTarget)}
              />
            </span>
          </div>
        );
      })}
      {texts.map((field) => {
        const counts = new Map<string, number>();
        for (const part of list) {
          const value = String(part[field] ?? '');
          if (value)
            counts.set(value, (counts.get(value) ?? 0) + (passes(part, chosen, field) ? 1 : 0));
        }
        if (counts.size < 2 && !chosen.texts[field]?.length) return null;
        return (
          <div key={field} class="facet" role="group" aria-label={field}>
            <p class="facet-name">{field.replaceAll('_', ' ')}</p>
            {[...counts]
              .sort((a, b) => b[1] - a[1] || a[0].localeCompare(b[0]))
              .map(([value, count]) => (
                <label key={value} class="check">
                  <input
                    type="checkbox"
                    checked={chosen.texts[field]?.includes(value) ?? false}
                    onChange={(e) => toggle(field, value, e.currentTarget.checked)}
                  />
                  <span>{value}</span>
                  <span class="muted">{count}</span>
                </label>
              ))}
          </div>
        );
      })}
    </details>
  );
}

const bins = 16;

// How many parts have which values, by bins; logarithmic where values span decades. A bin is a
// filter by pointer; the fields below are the same by keyboard.
function Histogram(props: {
  values: number[];
  low: number;
  high: number;
  range?: [number, number];
  inUnit: (value: number) => number;
  onPick: (from: number, to: number) => void;
}) {
  const { values, low, high, range, inUnit } = props;
  if (!(high > low)) return null;
  const isLog = low > 0 && high / low > 30;
  const to = (v: number) => (isLog ? Math.log(v) : v);
  const from = (v: number) => (isLog ? Math.exp(v) : v);
  const width = (to(high) - to(low)) / bins;
  const edge = (i: number) =>
    i === 0 ? low : i === bins ? high : Number(from(to(low) + i * width).toPrecision(3));
  const counts = Array.from({ length: bins }, () => 0);
  for (const v of values) ++counts[Math.min(bins - 1, Math.floor((to(v) - to(low)) / width))]!;
  const most = Math.max(1, ...counts);
  const isIn = (i: number) => !range || (edge(i + 1) > range[0] && edge(i) < range[1]);
  return (
    <svg class="histogram" viewBox={`0 0 ${bins * 10} 26`} preserveAspectRatio="none" aria-hidden>
      {counts.map((n, i) => (
        <g
          key={i}
          data-tip={`${n} of ${short(inUnit(edge(i)), 3)} … ${short(inUnit(edge(i + 1)), 3)}`}
          onClick={() => props.onPick(edge(i), edge(i + 1))}
        >
          <rect class="back" x={i * 10} y={0} width={10} height={26} />
          <rect
            class={isIn(i) ? 'in' : ''}
            x={i * 10 + 0.5}
            width={9}
            y={26 - (n ? 3 + (23 * n) / most : 0)}
            height={n ? 3 + (23 * n) / most : 0}
          />
        </g>
      ))}
    </svg>
  );
}
