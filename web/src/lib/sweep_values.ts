// The values of a sweep as they are typed: plain numbers in the units that the page shows, or with a
// unit of their own, which the service reads as it reads it in the requirements.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { placeInWords } from './amounts';
import { asProblem, type FieldError, post } from './api';
import { fieldKind, fieldName, inUnit, short } from './format';
import { stepsOf, withValue } from './sweeps';
import { mayBeEither, readShare, readTyped, splitAmounts } from './typed';
import type { Requirements } from './types';
import { namesUnit, type Remarked } from './understood';
import { fromShown, type Kind, toShown } from './units';

export interface SweptField {
  pointer: string;
  name: string;
  kind: Kind;
  unit: string; // as it is shown
  takesUnits: boolean;
}

export function sweptField(pointer: string, groups: { name: string }[]): SweptField {
  const field = pointer.split('/').pop()!;
  const bare = field.replace(/_(max|min)$/, '');
  return {
    pointer,
    name: placeInWords(pointer, groups),
    kind: fieldKind(bare),
    unit: fieldName(bare).unit,
    takesUnits: namesUnit(field),
  };
}

export const withUnit = ({ unit }: SweptField, text: string): string =>
  unit ? `${text} ${unit}` : text;

export const shownValue = ({ kind }: SweptField, value: number): string =>
  short(toShown(kind, value));

// A value in the document's unit, or why it is none; neither while the service is asked.
export interface SweptValue {
  value?: number;
  error?: string;
}

// The texts of a list. A unit behind the last of plain numbers is that of all.
export function textsOf(list: string): string[] {
  const texts = splitAmounts(list);
  const last = texts[texts.length - 1] ?? '';
  const unit = /^[-+−]?[\d.,]+(?:e[-+]?\d+)?\s*([^\d.,\s].*)$/i.exec(last)?.[1];
  if (!unit) return texts;
  return texts.map((text) => (typeof readTyped(text) === 'number' ? `${text} ${unit}` : text));
}

// What can be told without the service.
function readHere(field: SweptField, text: string): SweptValue | null {
  const typed = field.takesUnits ? readTyped(text) : readShare(text, false);
  if (typeof typed === 'number') return { value: fromShown(field.kind, typed) };
  if (typed === 'ambiguous') return { error: `“${text}” ${mayBeEither(text)}` };
  return field.takesUnits && /\d/.test(text) ? null : { error: `“${text}” is no number` };
}

async function askFor(
  document: Requirements,
  field: SweptField,
  text: string,
): Promise<SweptValue> {
  const asked = withValue(document, stepsOf(field.pointer), text);
  try {
    const { understood } = await post<Remarked>('/v1/designs?validate_only=true', asked);
    const row = understood?.find((one) => one.pointer === field.pointer && !one.name);
    return row ? { value: row.value } : { error: `“${text}” was not understood` };
  } catch (error) {
    const problem = asProblem(error);
    const own = problem.errors.find((one) => one.pointer === field.pointer);
    const other = problem.errors[0];
    if (own || !other) return { error: `“${text}”: ${own?.detail ?? problem.message}` };
    return {
      error: `“${text}”: ${placeInWords(other.pointer, document.actuators)} ${other.detail}`,
    };
  }
}

// The values of the texts, in their order.
export function useValues(
  document: Requirements,
  field: SweptField,
  texts: string[],
): SweptValue[] {
  const found = useSignal<Record<string, SweptValue>>({});
  const here = texts.map((text) => readHere(field, text));
  const toAsk = texts.filter((_, i) => here[i] === null);
  useEffect(() => void (found.value = {}), [document, field.pointer]);
  useEffect(() => {
    let isOver = false;
    const ask = async () => {
      for (const text of toAsk) {
        if (found.peek()[text]) continue;
        const value = await askFor(document, field, text);
        if (isOver) return;
        found.value = { ...found.peek(), [text]: value };
      }
    };
    const timer = toAsk.length > 0 ? window.setTimeout(() => void ask(), 250) : 0;
    return () => {
      isOver = true;
      clearTimeout(timer);
    };
  }, [document, field.pointer, toAsk.join('\n')]);
  return texts.map((text, i) => here[i] ?? found.value[text] ?? {});
}

// So many values from one to another, even in the unit that is shown.
export function evenly(field: SweptField, from: number, to: number, steps: number): number[] {
  if (!Number.isInteger(steps) || steps < 2 || steps > 256) return [];
  const [first, last] = [toShown(field.kind, from), toShown(field.kind, to)];
  const at = (i: number) => Number((first + ((last - first) * i) / (steps - 1)).toPrecision(6));
  return Array.from({ length: steps }, (_, i) => fromShown(field.kind, at(i)));
}

// What the service refuses of the patches, in the words of the form; none where it is something else.
export function refusedValues(field: SweptField, names: string[], errors: FieldError[]): string {
  return errors
    .map(({ pointer, detail }) => {
      const patch = /^\/patches\/(\d+)\//.exec(pointer);
      return patch && `${names[Number(patch[1])]}: ${inUnit(field.kind, detail)}`;
    })
    .filter(Boolean)
    .join('; ');
}
