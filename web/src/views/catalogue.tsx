// The catalogue: families, filters with counts, a table that shows where each number comes from.
import { computed, signal, useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem } from '../lib/api';
import { families, familyCounts, loadFamilies, loadFamily, numberOf, provenanceWord, revision } from '../lib/catalogue';
import { columnName, fieldName, short } from '../lib/format';
import { go, link, route, setQuery } from '../lib/route';
import type { Family, Part } from '../lib/types';
import { Notice, Panel } from '../ui/controls';
import { useWindow } from '../ui/window';
import { ImportDialog } from './part_import';
import { PartDialog, RevisionsDialog } from './part_dialogs';
import { PartForm } from './part_form';

const rowHeight = 32;
const parts = signal<{ family: string; list: Part[] }>({ family: '', list: [] });
const problem = signal('');

export async function reload(family: string): Promise<void> {
  try {
    await loadFamilies();
    parts.value = { family, list: await loadFamily(family) };
    problem.value = '';
  } catch (error) {
    problem.value = asProblem(error).message;
  }
}

// Filters in the address: "n=mass_kg:0:1~…" ranges, "t=port:M5~…" values.
interface Filters {
  numbers: Record<string, [number, number]>;
  texts: Record<string, string[]>;
}

const filters = computed<Filters>(() => {
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

const bound = (value: number): string => (Number.isFinite(value) ? String(value) : '');

function setFilters(next: Filters): void {
  const numbers = Object.entries(next.numbers).filter(([, [a, b]]) => Number.isFinite(a) || Number.isFinite(b));
  setQuery({
    n: numbers.map(([field, [a, b]]) => `${field}:${bound(a)}:${bound(b)}`).join('~'),
    t: Object.entries(next.texts).flatMap(([field, values]) => values.map((v) => `${field}:${v}`)).join('~'),
  });
}

// Whether a part passes all filters but that of one field, which is being counted.
function passes(part: Part, chosen: Filters, but = ''): boolean {
  for (const [field, [low, high]] of Object.entries(chosen.numbers)) {
    const value = numberOf(part, field);
    if (field !== but && (value === null || value < low || value > high)) return false;
  }
  for (const [field, values] of Object.entries(chosen.texts)) {
    if (field !== but && values.length > 0 && !values.includes(String(part[field] ?? ''))) return false;
  }
  return true;
}

export function CatalogueView() {
  const [, asked] = route.value.path;
  const family = asked ?? 'valve';
  const dialog = useSignal<'add' | 'import' | 'history' | null>(null);
  useEffect(() => void reload(family), [family]);
  const meta = families.value.find((f) => f.name === family);
  const list = parts.value.family === family ? parts.value.list : [];
  const shown = list.filter((part) => passes(part, filters.value));
  const opened = route.value.query.get('part');
  const closePart = () => setQuery({ part: undefined });
  return (
    <div class="catalogue">
      <Panel first title="Catalogue" class="families" aside={revision.value && <span class="muted">revision {revision.value.number}</span>}>
        <ul>
          {families.value.map((f) => (
            <li key={f.name}>
              <a href={link(['catalogue', f.name])} aria-current={f.name === family ? 'true' : undefined}>
                {f.name} <span class="muted">{familyCounts.value[f.name] ?? 0}</span>
              </a>
            </li>
          ))}
        </ul>
        {meta && <Facets meta={meta} list={list} />}
      </Panel>
      <Panel
        title={`${family}: ${shown.length === list.length ? `${list.length} parts` : `${shown.length} of ${list.length} parts`}`}
        aside={
          <>
            <button type="button" class="primary" onClick={() => (dialog.value = 'add')}>Add a part</button>
            <button type="button" onClick={() => (dialog.value = 'import')}>Import CSV</button>
            <a class="button like" href={`/v1/parts/export?family=${family}`} download={`${family}.csv`}>Export CSV</a>
            <button type="button" onClick={() => (dialog.value = 'history')}>History</button>
          </>
        }
      >
        {problem.value && <Notice kind="bad">{problem.value}</Notice>}
        {asked && families.value.length > 0 && !meta && <Notice kind="bad">There is no family {asked}.</Notice>}
        {meta && <PartTable meta={meta} rows={shown} />}
        <p class="hint">
          <span class="from datasheet">data sheet</span> <span class="from third_party">third party</span>{' '}
          <span class="from derived">derived</span> <span class="from estimated">~ estimated</span> — the source is on each number.
        </p>
      </Panel>
      {dialog.value === 'add' && meta && (
        <PartForm meta={meta} known={list} onClose={(saved) => { dialog.value = null; if (saved) void reload(family); }} />
      )}
      {dialog.value === 'import' && <ImportDialog family={family} onClose={(done) => { dialog.value = null; if (done) void reload(family); }} />}
      {dialog.value === 'history' && <RevisionsDialog onClose={(changed) => { dialog.value = null; if (changed) void reload(family); }} />}
      {opened && meta && (
        <PartDialog
          key={opened} id={opened} meta={meta} known={list} onClose={(changed) => { closePart(); if (changed) void reload(family); }}
          onCopied={(id) => go(['catalogue', family], { part: id })}
        />
      )}
    </div>
  );
}

function Facets({ meta, list }: { meta: Family; list: Part[] }) {
  const chosen = filters.value;
  const texts = ['manufacturer', ...meta.texts.map((t) => t.name), 'origin'];
  const numbers = meta.numbers.filter((field) => list.some((part) => numberOf(part, field.name) !== null));
  const toggle = (field: string, value: string, on: boolean) => {
    const now = chosen.texts[field] ?? [];
    setFilters({ ...chosen, texts: { ...chosen.texts, [field]: on ? [...now, value] : now.filter((v) => v !== value) } });
  };
  const setBound = (field: string, end: 0 | 1, text: string) => {
    const range: [number, number] = [...(chosen.numbers[field] ?? [-Infinity, Infinity])];
    const number = Number(text.replace(',', '.'));
    range[end] = text.trim() === '' || !Number.isFinite(number) ? (end ? Infinity : -Infinity) : number;
    setFilters({ ...chosen, numbers: { ...chosen.numbers, [field]: range } });
  };
  const any = Object.values(chosen.texts).some((v) => v.length) || Object.keys(chosen.numbers).length > 0;
  return (
    <details class="facets" open={innerWidth > 1000}>
      <summary>Filters</summary>
      {any && <button type="button" class="small" onClick={() => setFilters({ numbers: {}, texts: {} })}>Clear all</button>}
      {numbers.map((field) => {
        const { label, unit } = fieldName(field.name);
        const values = list.map((p) => numberOf(p, field.name)).filter((v): v is number => v !== null);
        const range = chosen.numbers[field.name];
        return (
          <div key={field.name} class="facet" role="group" aria-label={`${label} ${unit}`}>
            <p class="facet-name" data-tip={field.meaning}>{label} <small>{unit}</small></p>
            <span class="range">
              <input
                type="text" inputMode="decimal" aria-label={`${label}, at least`} value={range ? bound(range[0]) : ''}
                placeholder={short(Math.min(...values), 3)} onChange={(e) => setBound(field.name, 0, e.currentTarget.value)}
              />
              …
              <input
                type="text" inputMode="decimal" aria-label={`${label}, at most`} value={range ? bound(range[1]) : ''}
                placeholder={short(Math.max(...values), 3)} onChange={(e) => setBound(field.name, 1, e.currentTarget.value)}
              />
            </span>
          </div>
        );
      })}
      {texts.map((field) => {
        const counts = new Map<string, number>();
        for (const part of list) {
          const value = String(part[field] ?? '');
          if (value) counts.set(value, (counts.get(value) ?? 0) + (passes(part, chosen, field) ? 1 : 0));
        }
        if (counts.size < 2 && !chosen.texts[field]?.length) return null;
        return (
          <div key={field} class="facet" role="group" aria-label={field}>
            <p class="facet-name">{field.replaceAll('_', ' ')}</p>
            {[...counts].sort((a, b) => b[1] - a[1] || a[0].localeCompare(b[0])).map(([value, count]) => (
              <label key={value} class="check">
                <input type="checkbox" checked={chosen.texts[field]?.includes(value) ?? false} onChange={(e) => toggle(field, value, e.currentTarget.checked)} />
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

function PartTable({ meta, rows }: { meta: Family; rows: Part[] }) {
  const sort = route.value.query.get('sort') ?? '';
  const by = sort.replace('-', '');
  const numbers = meta.numbers.filter((field) => rows.some((part) => numberOf(part, field.name) !== null));
  const order = sort.startsWith('-') ? -1 : 1;
  const sorted = by === '' ? rows : [...rows].sort((a, b) => {
    const [u, v] = [a[by], b[by]] as [number | string | undefined, number | string | undefined];
    if (u === undefined || v === undefined) return u === undefined ? (v === undefined ? 0 : 1) : -1;
    return order * (u < v ? -1 : u > v ? 1 : 0);
  });
  const sight = useWindow(rowHeight, sorted.length, 36);
  const head = (name: string, label: string, unit: string, numeric: boolean, tip?: string) => (
    <th key={name} scope="col" class={numeric ? 'num' : ''} aria-sort={sort === name ? 'ascending' : sort === `-${name}` ? 'descending' : 'none'}>
      <button type="button" data-tip={tip} onClick={() => setQuery({ sort: sort === name ? `-${name}` : name })}>
        {label} {unit && <small>{unit}</small>}
        <i>{sort === name ? '▲' : sort === `-${name}` ? '▼' : ''}</i>
      </button>
    </th>
  );
  return (
    <div class="scroll parts" tabIndex={0} role="region" aria-label="Parts" onScroll={sight.onScroll}>
      <table aria-rowcount={sorted.length + 1}>
        <thead>
          <tr>
            {head('part_number', 'part', '', false)}
            {head('manufacturer', 'maker', '', false)}
            {meta.texts.map((field) => head(field.name, field.name.replaceAll('_', ' '), '', false, field.meaning))}
            {numbers.map((field) => {
              const { label, unit } = columnName(field.name);
              return head(field.name, label, unit, true, `${field.meaning}${unit && `, ${unit}`}`);
            })}
          </tr>
        </thead>
        <tbody>
          {sight.above > 0 && <tr aria-hidden="true" class="spacer" style={{ height: `${sight.above}px` }} />}
          {sorted.slice(sight.start, sight.end).map((part, i) => (
            <tr key={part.id} aria-rowindex={sight.start + i + 2}>
              <th scope="row">
                <a href={link(['catalogue', meta.name], { ...Object.fromEntries(route.value.query), part: part.id })}>{part.part_number}</a>
                {part.origin !== 'seed' && <span class="chip good own">own</span>}
              </th>
              <td>{part.manufacturer}</td>
              {meta.texts.map((field) => <td key={field.name}>{String(part[field.name] ?? '–')}</td>)}
              {numbers.map((field) => <NumberCell key={field.name} part={part} field={field.name} />)}
            </tr>
          ))}
          {sight.below > 0 && <tr aria-hidden="true" class="spacer" style={{ height: `${sight.below}px` }} />}
        </tbody>
      </table>
    </div>
  );
}

function NumberCell({ part, field }: { part: Part; field: string }) {
  const value = numberOf(part, field);
  if (value === null) return <td class="num muted">–</td>;
  const from = part.provenance[field];
  return (
    <td class="num">
      <span class={`from ${from?.kind ?? ''}`} data-tip={from ? `${provenanceWord[from.kind]}: ${from.source}` : undefined}>
        {from?.kind === 'estimated' && '~ '}
        {short(value, 4)}
      </span>
    </td>
  );
}
