// Small controls that the views share.
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect, useId, useLayoutEffect, useRef } from 'preact/hooks';

import { inUnit, short } from '../lib/format';
import { mayBeEither, readShare, readTyped, type Typed } from '../lib/typed';
import { fromShown, type Kind, toShown, unitOf } from '../lib/units';

export function Panel(props: {
  title?: ComponentChildren;
  aside?: ComponentChildren;
  class?: string;
  children: ComponentChildren;
  first?: boolean; // heads the view
}) {
  const Heading = props.first ? 'h1' : 'h2';
  return (
    <section class={`panel ${props.class ?? ''}`}>
      {props.title !== undefined && (
        <header class="panel-head">
          <Heading>{props.title}</Heading>
          {props.aside !== undefined && <div class="aside">{props.aside}</div>}
        </header>
      )}
      {props.children}
    </section>
  );
}

export function Segmented<T extends string>(props: {
  label: string;
  options: readonly (T | { value: T; label: string })[];
  value: T;
  onChange: (value: T) => void;
  hideLabel?: boolean;
}) {
  return (
    <div class="segmented" role="group" aria-label={props.label}>
      {!props.hideLabel && <span class="segmented-label">{props.label}</span>}
      <span class="segments">
        {props.options.map((option) => {
          const value = typeof option === 'string' ? option : option.value;
          const text = typeof option === 'string' ? option : option.label;
          return (
            <button
              type="button"
              key={value}
              aria-pressed={props.value === value}
              onClick={() => props.onChange(value)}
            >
              {text}
            </button>
          );
        })}
      </span>
    </div>
  );
}

export function Select<T extends string>(props: {
  label: string;
  value: T;
  options: readonly { value: T; label: string }[];
  onChange: (value: T) => void;
  hideLabel?: boolean;
  error?: string;
  hint?: string;
  pointer?: string;
}) {
  const id = useId();
  const below = props.error ?? props.hint;
  return (
    <span class={`select ${props.error ? 'wrong' : ''}`}>
      <label for={id} class={props.hideLabel ? 'only-heard' : ''}>
        {props.label}
      </label>
      <select
        id={id}
        value={props.value}
        data-pointer={props.pointer}
        aria-invalid={props.error ? true : undefined}
        aria-describedby={below === undefined ? undefined : `${id}-hint`}
        onChange={(event) => props.onChange(event.currentTarget.value as T)}
      >
        {props.options.map((option) => (
          <option key={option.value} value={option.value}>
            {option.label}
          </option>
        ))}
      </select>
      {below !== undefined && (
        <span class={props.error ? 'error' : 'hint'} id={`${id}-hint`}>
          {below}
        </span>
      )}
    </span>
  );
}

export function Check(props: {
  label: ComponentChildren;
  checked: boolean;
  onChange: (on: boolean) => void;
}) {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={props.checked}
        onChange={(event) => props.onChange(event.currentTarget.checked)}
      />
      <span>{props.label}</span>
    </label>
  );
}

type Entry = number | string | null | undefined;

const asText = (kind: Kind, value: Entry): string =>
  typeof value === 'string'
    ? value
    : value === null || value === undefined
      ? ''
      : String(Number(toShown(kind, value).toPrecision(7)));

export interface NumberFieldProps {
  label: string;
  value: Entry;
  onChange: (value: number | null) => void;
  usual?: number; // what holds where nothing is given
  // Takes what is no plain number: one with its unit, which the service reads, or what it refuses.
  // A field whose text stands nowhere would be asked for with the number that it had before.
  onText: (text: string) => void;
  takesUnits?: boolean;
  isShare?: boolean; // takes percent, as does what ends at 1 and what counts in %
  read?: string; // what it read
  warning?: string;
  kind?: Kind;
  unit?: string;
  range?: [number, number];
  hint?: string;
  error?: string;
  optional?: boolean;
  placeholder?: string; // of an optional one
  pointer?: string;
}

const needed = 'a number is needed here';

// What is wrong with a text whatever the service says; nothing where it is the service's to judge.
function wrongWith(text: string, typed: Typed, takesUnits = false): string | undefined {
  if (typed === 'ambiguous') return mayBeEither(text);
  return typed === 'unreadable' && !takesUnits ? needed : undefined;
}

// A number in the unit chosen for its kind. What is no number is said here; everything else is the
// service's to judge.
export function NumberField(props: NumberFieldProps) {
  const kind = props.kind ?? 'plain';
  const id = useId();
  const unit = unitOf(kind, props.unit);
  const text = useSignal(asText(kind, props.value ?? props.usual));
  const sent = useRef<Entry>(props.value);
  const cleared = useSignal(false);
  const isShare =
    kind === 'plain' &&
    !props.takesUnits &&
    (props.isShare || props.unit === '%' || (props.range?.[1] ?? Infinity) <= 1);
  const readNumber = (input: string) =>
    isShare ? readShare(input, props.unit === '%') : readTyped(input);
  const shownUnit = useRef(unit);

  useLayoutEffect(() => {
    if ((props.value ?? undefined) === (sent.current ?? undefined) && unit === shownUnit.current)
      return;
    text.value = asText(kind, props.value ?? props.usual);
    cleared.value = false;
    sent.current = props.value;
    shownUnit.current = unit;
  });

  const take = (input: string) => {
    text.value = input;
    const trimmed = input.trim();
    const typed = readNumber(trimmed);
    cleared.value = trimmed === '';
    if (trimmed === '') {
      sent.current = null;
      props.onChange(null);
    } else if (typeof typed === 'number') {
      sent.current = fromShown(kind, typed);
      props.onChange(sent.current);
    } else {
      sent.current = trimmed;
      props.onText(trimmed);
    }
  };

  const range = props.range
    ? `${short(toShown(kind, props.range[0]), 3)} … ${short(toShown(kind, props.range[1]), 3)}`
    : '';
  // What is said of a text speaks of its own unit already.
  const said =
    typeof props.value === 'string' ? props.error : props.error && inUnit(kind, props.error);
  const isNeeded = cleared.value && !props.optional && props.usual === undefined;
  const typed = readNumber(text.value);
  const wrong =
    text.value.trim() === '' ? undefined : wrongWith(text.value, typed, props.takesUnits);
  const error = isNeeded ? needed : (wrong ?? said);
  const read =
    text.value.includes('%') && typeof typed === 'number' ? `read as ${short(typed)}` : props.read;
  const hint = read ?? props.warning ?? [props.hint, range].filter(Boolean).join(' · ');
  return (
    <div class={`field ${error ? 'wrong' : ''}`}>
      <label for={id}>{props.label}</label>
      <span class="input">
        <input
          id={id}
          type="text"
          inputMode="decimal"
          autocomplete="off"
          value={text.value}
          placeholder={
            props.placeholder ?? (props.optional ? 'no limit' : asText(kind, props.usual))
          }
          data-pointer={props.pointer}
          aria-invalid={error ? true : undefined}
          aria-describedby={`${id}-hint`}
          onInput={(event) => take(event.currentTarget.value)}
          onBlur={() => (text.value ||= asText(kind, props.usual))}
        />
        {unit && <span class="unit">{unit}</span>}
      </span>
      <span class={error ? 'error' : 'hint'} id={`${id}-hint`} role={error ? 'alert' : undefined}>
        {error ?? hint}
      </span>
    </div>
  );
}

export function TextField(props: {
  label: string;
  value: string;
  onChange: (value: string) => void;
  error?: string;
  hint?: string;
  options?: string[];
  pointer?: string;
}) {
  const id = useId();
  return (
    <div class={`field ${props.error ? 'wrong' : ''}`}>
      <label for={id}>{props.label}</label>
      <span class="input">
        <input
          id={id}
          type="text"
          autocomplete="off"
          list={props.options ? `${id}-list` : undefined}
          value={props.value}
          data-pointer={props.pointer}
          aria-invalid={props.error ? true : undefined}
          aria-describedby={`${id}-hint`}
          onInput={(event) => props.onChange(event.currentTarget.value)}
        />
      </span>
      {props.options && (
        <datalist id={`${id}-list`}>
          {props.options.map((option) => (
            <option key={option} value={option} />
          ))}
        </datalist>
      )}
      <span class={props.error ? 'error' : 'hint'} id={`${id}-hint`}>
        {props.error ?? props.hint ?? ''}
      </span>
    </div>
  );
}

export function Notice(props: {
  kind: 'info' | 'warn' | 'bad' | 'good';
  children: ComponentChildren;
}) {
  return (
    <div class={`notice ${props.kind}`} role={props.kind === 'bad' ? 'alert' : 'status'}>
      {props.children}
    </div>
  );
}

export const Chip = (props: { kind?: string; children: ComponentChildren; tip?: string }) => (
  <span class={`chip ${props.kind ?? ''}`} data-tip={props.tip}>
    {props.children}
  </span>
);

// A modal window; Escape closes it.
export function Dialog(props: {
  title: string;
  onClose: () => void;
  children: ComponentChildren;
  wide?: boolean;
}) {
  const ref = useRef<HTMLDialogElement>(null);
  const id = useId();
  useEffect(() => {
    ref.current?.showModal();
  }, []);
  return (
    <dialog ref={ref} class={props.wide ? 'wide' : ''} aria-labelledby={id} onClose={props.onClose}>
      <header class="panel-head">
        <h2 id={id}>{props.title}</h2>
        <button type="button" class="quiet" aria-label="Close" onClick={() => ref.current?.close()}>
          ✕
        </button>
      </header>
      <div class="dialog-body">{props.children}</div>
    </dialog>
  );
}
