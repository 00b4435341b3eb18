// The catalogue: families, filters with counts, a table that shows where each number comes from.
import { signal, useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem } from '../lib/api';
import { families, familyCounts, loadFamilies, loadFamily, revision } from '../lib/catalogue';
import { go, link, route, setQuery } from '../lib/route';
import type { Part } from '../lib/types';
import { Notice, Panel } from '../ui/controls';
import { ExportButton } from '../ui/files';
import { CheckDialog } from './catalogue_check';
import { Facets, filters, passes } from './facets';
import { RevisionsDialog } from './history';
import { ImportDialog } from './part_import';
import { PartDialog } from './part_dialogs';
import { PartForm } from './part_form';
import { PartTable } from './part_table';

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

export function CatalogueView() {
  const [, asked] = route.value.path;
  const family = asked ?? 'valve';
  const dialog = useSignal<'add' | 'import' | 'check' | 'history' | null>(null);
  useEffect(() => void reload(family), [family]);
  const meta = families.value.find((f) => f.name === family);
  const list = parts.value.family === family ? parts.value.list : [];
  const shown = list.filter((part) => passes(part, filters.value));
  const opened = route.value.query.get('part');
  const closePart = () => setQuery({ part: undefined });
  return (
    <div class="catalogue">
      <Panel
        first
        title="Catalogue"
        class="families"
        aside={revision.value && <span class="muted">revision {revision.value.number}</span>}
      >
        <ul>
          {families.value.map((f) => (
            <li key={f.name}>
              <a
                href={link(['catalogue', f.name])}
                aria-current={f.name === family ? 'true' : undefined}
              >
                {f.name === 'co2' ? 'CO₂' : f.name}{' '}
                <span class="muted">{familyCounts.value[f.name] ?? 0}</span>
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
          </>
        }
      >
        {problem.value && <Notice kind="bad">{problem.value}</Notice>}
        {asked && families.value.length > 0 && !meta && (
          <Notice kind="bad">There is no family {asked}.</Notice>
        )}
        {meta && <PartTable meta={meta} rows={shown} />}
        <p class="hint">
          <span class="from datasheet">data sheet</span>{' '}
          <span class="from third_party">third party</span>{' '}
          <span class="from derived">derived</span> <span class="from estimated">~ estimated</span>{' '}
          — the source is on each number.
        </p>
      </Panel>
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
