// The frame: where one is, the units, light or dark.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { hasToken, wantsToken } from './lib/api';
import { refreshModels } from './lib/models';
import { previousJob } from './lib/jobs';
import { link, route, view } from './lib/route';
import { theme } from './lib/theme';
import {
  pressureUnit,
  pressureUnits,
  reference,
  references,
  volumeUnit,
  volumeUnits,
} from './lib/units';
import { Dialog, Segmented } from './ui/controls';
import { Tooltip } from './ui/tooltip';
import { CatalogueView } from './views/catalogue';
import { DesignsView } from './views/designs';
import { JobsView } from './views/jobs';
import { MeasuredView } from './views/measured';
import { RequirementsView } from './views/requirements';
import { SweepView } from './views/sweep';
import { TokenView } from './views/token';

const views = [
  { name: 'requirements', label: 'Requirements', key: '1' },
  { name: 'designs', label: 'Designs', key: '2' },
  { name: 'catalogue', label: 'Catalogue', key: '3' },
  { name: 'measured', label: 'Measured data', key: '4' },
  { name: 'jobs', label: 'Jobs', key: '5' },
];

function View() {
  if (wantsToken.value) return <TokenView />;
  switch (view.value) {
    case 'designs':
      return <DesignsView />;
    case 'catalogue':
      return <CatalogueView />;
    case 'measured':
      return <MeasuredView />;
    case 'jobs':
      return <JobsView />;
    case 'sweep':
      return <SweepView />;
    default:
      return <RequirementsView />;
  }
}

// Alt and a digit go to a view.
function useShortcuts() {
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      const found = event.altKey && views.find((v) => v.key === event.key);
      if (!found) return;
      event.preventDefault();
      location.hash = addressOf(found.name);
      document.querySelector<HTMLElement>('main')?.focus();
    };
    addEventListener('keydown', press);
    return () => removeEventListener('keydown', press);
  }, []);
}

const addressOf = (name: string): string =>
  link(name === 'designs' && previousJob.value ? [name, previousJob.value] : [name]);

const sameAs = (name: string) => (view.value === name ? 'page' : undefined);

// Units and colours. Where there is little room they stand behind a button, so that the views come first.
function Settings() {
  const isOpen = useSignal(false);
  return (
    <>
      <button
        type="button"
        class="units-button"
        aria-expanded={isOpen.value}
        aria-controls="units"
        onClick={() => (isOpen.value = !isOpen.value)}
      >
        Units
      </button>
      <div class={`units ${isOpen.value ? 'open' : ''}`} id="units">
        {hasToken() && (
          <button type="button" onClick={() => (wantsToken.value = 'change')}>
            Token…
          </button>
        )}
        <Segmented
          hideLabel
          label="Unit of pressure"
          options={pressureUnits}
          value={pressureUnit.value}
          onChange={(v) => (pressureUnit.value = v)}
        />
        <Segmented
          hideLabel
          label="Pressure above ambient or absolute"
          options={references}
          value={reference.value}
          onChange={(v) => (reference.value = v)}
        />
        <Segmented
          hideLabel
          label="Unit of volume"
          options={volumeUnits}
          value={volumeUnit.value}
          onChange={(v) => (volumeUnit.value = v)}
        />
        <Segmented
          hideLabel
          label="Colours"
          value={theme.value}
          onChange={(v) => (theme.value = v)}
          options={[
            { value: 'system', label: 'auto' },
            { value: 'light', label: 'light' },
            { value: 'dark', label: 'dark' },
          ]}
        />
      </div>
    </>
  );
}

// The documentation, where it was built.
function DocsLink() {
  const isMissing = useSignal(false);
  const open = async (event: MouseEvent) => {
    event.preventDefault();
    const found = await fetch('/docs/', { method: 'HEAD' }).catch(() => null);
    if (found?.status === 404) isMissing.value = true;
    else window.open('/docs/', '_blank', 'noopener');
  };
  return (
    <>
      <a
        href="/docs/"
        target="_blank"
        data-tip="Opens in a tab of its own"
        onClick={(event) => void open(event)}
      >
        Docs
      </a>
      {isMissing.value && (
        <Dialog title="Documentation" onClose={() => (isMissing.value = false)}>
          <p>
            The documentation was not built with this program. Build it with{' '}
            <code>docs/build.sh</code> where plenum comes from and start <code>plenum serve</code>{' '}
            again.
          </p>
        </Dialog>
      )}
    </>
  );
}

export function App() {
  useShortcuts();
  useEffect(() => void refreshModels(), []);
  useEffect(() => {
    document.title = `${views.find((v) => v.name === view.value)?.label ?? 'Requirements'} – plenum`;
  }, [view.value]);
  void route.value;
  return (
    <>
      <header class="top">
        <a
          class="skip"
          href={location.hash}
          onClick={(event) => {
            event.preventDefault();
            document.querySelector<HTMLElement>('main')?.focus();
          }}
        >
          Skip to the content
        </a>
        <a class="brand" href={link(['requirements'])} aria-label="plenum, to the requirements">
          <svg viewBox="0 0 32 32" width="20" height="20" aria-hidden="true">
            <path
              d="M3 21h6l4-12 6 15 4-8h6"
              fill="none"
              stroke="currentColor"
              stroke-width="3"
              stroke-linejoin="round"
              stroke-linecap="round"
            />
          </svg>
          plenum
        </a>
        <nav aria-label="Views">
          {views.map((v) => (
            <a
              key={v.name}
              href={addressOf(v.name)}
              aria-current={sameAs(v.name)}
              data-tip={`Alt+${v.key}`}
            >
              {v.label}
            </a>
          ))}
          <DocsLink />
        </nav>
        <Settings />
      </header>
      <main tabIndex={-1}>
        <View />
      </main>
      <Tooltip />
    </>
  );
}
