// The catalogue: families, filters with counts, a table that shows where each number comes from.
import { signal, useSignal } from '@preact/signals';
import { Fragment } from 'preact';
import { useEffect, useRef } from 'preact/hooks';

import { asProblem } from '../lib/api';
import { families, familyCounts, loadFamilies, loadFamily, revision } from '../lib/catalogue';
import { go, link, route, setQuery } from '../lib/route';
import type { Part } from '../lib/types';
import { counted, familyWord } from '../lib/words';
import { Notice, Panel } from '../ui/controls';
import { ExportButton } from '../ui/files';
import { Added } from './added_part';
import { CheckDialog } from './catalogue_check';
import { SeedDialog } from './catalogue_update';
import { Facets, filters, passes } from './facets';
import { RevisionsDialog } from './history';
import { ImportDialog } from './part_import';
import { PartDialog } from './part_dialogs';
import { PartForm } from './part_form';
import { PartTable } from './part_table';
import { Tray } from './part_tray';

const parts = signal<{ family: string; list: Part[] }>({ family: '', list: [] });

const problem = signal('');

let loads = 0;

// Only the newest of several at once is shown.
export async function reload(family: string): Promise<void> {
  const mine = ++loads;
  const words = route.peek().query.get('q') ?? '';
  try {
    await loadFamilies(words);
    const list = await loadFamily(family, words);
    if (mine !== loads) return;
    parts.value = { family, list };
    problem.value = '';
  } catch (error) {
    if (mine === loads) problem.value = asProblem(error).message;
  }
}

// What is asked for now, and where else it is found.
function keptQuery(): Record<string, string | undefined> {
  const { query } = route.value;
  return { q: query.get('q') ?? undefined, pick: query.get('pick') ?? undefined };
}

function Search() {
  const later = useRef(0);
  const words = route.value.query.get('q') ?? '';
  const typed = useSignal(words);
  useEffect(() => {
    if (typed.peek().trim() !== words) typed.value = words;
  }, [words]);
  const ask = (text: string) => {
    typed.value = text;
    clearTimeout(later.current);
    later.current = window.setTimeout(() => setQuery({ q: text.trim() }), 200);
  };
  return (
    <input
      type="search"
      class="search"
      aria-label="Find parts"
      placeholder="Maker, number, notes …"
      maxLength={200}
      value={typed.value}
      onInput={(event) => ask(event.currentTarget.value)}
    />
  );
}

function Elsewhere({ family }: { family: string }) {
  const others = Object.entries(familyCounts.value).filter(([name]) => name !== family);
  return (
    <Notice kind="info">
      No {familyWord(family)} has these words
      {others.length > 0 ? ', but ' : '.'}
      {others.map(([name, count], i) => (
        <Fragment key={name}>
          {i > 0 && ', '}
          <a href={link(['catalogue', name], keptQuery())}>
            {count} {familyWord(name)}
          </a>
        </Fragment>
      ))}
    </Notice>
  );
}

export function CatalogueView() {
  const [, asked] = route.value.path;
  const family = asked ?? 'valve';
  const dialog = useSignal<'add' | 'import' | 'check' | 'history' | 'update' | null>(null);
  const words = route.value.query.get('q') ?? '';
  useEffect(() => void reload(family), [family, words]);
  const meta = families.value.find((f) => f.name === family);
  const list = parts.value.family === family ? parts.value.list : [];
  const shown = list.filter((part) => passes(part, filters.value));
  const opened = route.value.query.get('part');
  const closePart = () => setQuery({ part: undefined, protocol: undefined });
  return (
    <div class="catalogue">
      <Panel
        first
        title="Catalogue"
        class="families"
        aside={revision.value && <span class="muted">revision {revision.value.number}</span>}
      >
        <Search />
        <ul>
          {families.value.map((f) => (
            <li key={f.name}>
              <a
                href={link(['catalogue', f.name], keptQuery())}
                aria-current={f.name === family ? 'true' : undefined}
              >
                {familyWord(f.name)} <span class="muted">{familyCounts.value[f.name] ?? 0}</span>
              </a>
            </li>
          ))}
        </ul>
        {meta && <Facets meta={meta} list={list} />}
      </Panel>
      <Panel
        title={`${familyWord(family)}: ${`${shown.length === list.length ? '' : `${shown.length} of `}${counted(list.length, 'part')}`}`}
        aside={
          <>
            <button type="button" class="primary" onClick={() => (dialog.value = 'add')}>
              Add a part
            </button>
            <button type="button" onClick={() => (dialog.value = 'import')}>
              Import a table
            </button>
            <ExportButton family={family} label="Export CSV" />
            <button type="button" onClick={() => (dialog.value = 'check')}>
              Check
            </button>
            <button type="button" onClick={() => (dialog.value = 'history')}>
              History
            </button>
            <button
              type="button"
              data-tip="What the catalogue of the installed program has newer"
              onClick={() => (dialog.value = 'update')}
            >
              Update
            </button>
          </>
        }
      >
        {problem.value && <Notice kind="bad">{problem.value}</Notice>}
        <Added />
        {asked && families.value.length > 0 && !meta && (
          <Notice kind="bad">There is no family {asked}.</Notice>
        )}
        {words && parts.value.family === family && list.length === 0 && (
          <Elsewhere family={family} />
        )}
        {meta && <PartTable meta={meta} rows={shown} />}
        <p class="hint">
          <span class="from datasheet">data sheet</span>{' '}
          <span class="from third_party">third party</span>{' '}
          <span class="from derived">derived</span> <span class="from estimated">~ estimated</span>{' '}
          — the source is on each number.
        </p>
      </Panel>
      <Tray />
      {dialog.value === 'add' && meta && (
        <PartForm
          meta={meta}
          known={list}
          onClose={(saved) => {
            dialog.value = null;
            if (saved) void reload(family);
          }}
        />
      )}
      {dialog.value === 'import' && meta && (
        <ImportDialog
          meta={meta}
          onClose={(done) => {
            dialog.value = null;
            if (done) void reload(family);
          }}
        />
      )}
      {dialog.value === 'check' && (
        <CheckDialog family={family} onClose={() => (dialog.value = null)} />
      )}
      {dialog.value === 'update' && (
        <SeedDialog
          onClose={(changed) => {
            dialog.value = null;
            if (changed) void reload(family);
          }}
        />
      )}
      {dialog.value === 'history' && (
        <RevisionsDialog
          onClose={(changed) => {
            dialog.value = null;
            if (changed) void reload(family);
          }}
        />
      )}
      {opened && meta && (
        <PartDialog
          key={opened}
          id={opened}
          meta={meta}
          known={list}
          onClose={(changed) => {
            closePart();
            if (changed) void reload(family);
          }}
          onCopied={(id) => go(['catalogue', family], { part: id })}
        />
      )}
    </div>
  );
}
