// A part to add, copy or change. The service checks it; a change is refused when the part is no
// longer the one that was opened (If-Match).
import { useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';

import { ask, asProblem, type FieldError } from '../lib/api';
import { added, partPath, provenanceWord } from '../lib/catalogue';
import { fieldKind, fieldName } from '../lib/format';
import type { Family, Part, Provenance } from '../lib/types';
import { namesUnit } from '../lib/understood';
import { familyWord } from '../lib/words';
import { Dialog, Notice, NumberField, Select, TextField } from '../ui/controls';
import { focusFirstWrong } from '../ui/refused';
import { CurveField, curveText, isFreeFlow, readCurve } from './part_curve';
import { documentsText, offersText, readAliases, readDocuments, readOffers } from './part_details';

type Draft = Record<string, unknown>;

// What a number may be given as, too.
const printedAs = (name: string): { hint?: string } => {
  if (name.startsWith('sonic_conductance'))
    return { hint: 'or as printed: Qn 100 L/min at 6 to 5 bar, Cv 0.05, Kv 0.04, orifice 1.2 mm' };
  if (name === 'body_volume_ml') return { hint: 'or its size: 70 x 30 x 50 mm, ⌀18.5 x 65 mm' };
  return name === 'current_max_a' ? { hint: 'or the C-rate: 25C' } : {};
};

// Fields of several lines: what is wrong with them is said above the form.
const inLines = ['/aliases', '/offers', '/documents', '/orderable'];

const labelOf = (name: string, isRequired: boolean): string =>
  `${name[0]!.toUpperCase()}${name.slice(1)}${isRequired ? '' : ' (optional)'}`;

export function PartForm(props: {
  meta: Family;
  known: Part[];
  part?: Part;
  etag?: string;
  onClose: (saved: boolean) => void;
}) {
  const { meta, part, etag } = props;
  const draft = useSignal<Draft>(
    part
      ? { ...part, ...(etag ? {} : { id: undefined, part_number: `${part.part_number} copy` }) }
      : { family: meta.name },
  );
  const curve = useSignal(curveText(part?.curve));
  const aliases = useSignal((part?.aliases ?? []).join('\n'));
  const offers = useSignal(offersText(part?.offers));
  const documents = useSignal(documentsText(part?.documents));
  const kind = useSignal<Provenance['kind']>('datasheet');
  const source = useSignal('');
  const form = useRef<HTMLFormElement>(null);
  const uncertainty = useSignal<number | string | null>(null);
  const errors = useSignal<FieldError[]>([]);
  const problem = useSignal('');
  const busy = useSignal(false);
  const now = draft.value;
  const set = (name: string, value: unknown) =>
    (draft.value = { ...draft.value, [name]: value === '' || value === null ? undefined : value });
  // An id that is made from other fields is only wrong where they are.
  const errorAt = (name: string) =>
    name === 'id' && now.id === undefined && errors.value.length > 1
      ? undefined
      : errors.value.find((e) => e.pointer === `/${name}`)?.detail;
  // The source of a number that is wrong itself is not another fault.
  const elsewhere = errors.value.filter(
    (e) =>
      !/^\/curve(\/|$)/.test(e.pointer) && // said below it
      (!/^\/[a-z_0-9]+$/.test(e.pointer) || inLines.includes(e.pointer)) &&
      errorAt(e.pointer.replace('/provenance/', '')) === undefined,
  );

  // Changed numbers get the source named here, the others keep theirs.
  const documentOf = (): Draft | null => {
    const freeFlow = meta.has_curve && isFreeFlow(curve.value);
    const points = meta.has_curve && !freeFlow ? readCurve(curve.value, part) : undefined;
    if (points && 'pointer' in points) {
      errors.value = [points];
      return null;
    }
    const provenance: Record<string, Provenance> = {};
    const fields = [...meta.numbers, ...meta.texts]
      .map((f) => f.name)
      .filter((f) => now[f] !== undefined);
    const mine: Provenance = { kind: kind.value, source: source.value.trim() || 'user' };
    const share = typeof uncertainty.value === 'number' ? uncertainty.value / 100 : undefined;
    const measured: Provenance = { ...mine, ...(share !== undefined && { uncertainty: share }) };
    for (const field of fields)
      provenance[field] =
        part && now[field] === part[field] && part.provenance[field]
          ? part.provenance[field]!
          : meta.numbers.some((f) => f.name === field)
            ? measured
            : mine;
    if (points && points.length > 0) {
      const same = curveText(part?.curve) === curve.value && part;
      provenance.free_air = (same && part.provenance.free_air) || measured;
      if (points.some((p) => p.current_a !== undefined))
        provenance.current = (same && part.provenance.current) || measured;
    }
    if (freeFlow) provenance.free_air = provenance.current = mine;
    const { origin: _, ...rest } = now;
    return {
      ...rest,
      family: meta.name,
      ...(points && points.length > 0 && { curve: points }),
      ...(freeFlow && { curve: curve.value.trim() }),
      aliases: readAliases(aliases.value),
      offers: readOffers(offers.value),
      documents: readDocuments(documents.value),
      provenance,
    };
  };

  const goToWhatIsWrong = () =>
    form.current &&
    focusFirstWrong(
      form.current,
      errors.value.map((error) => error.pointer),
    );
  const save = async () => {
    errors.value = [];
    problem.value = '';
    const document = documentOf();
    if (!document || typeof uncertainty.value === 'string') {
      setTimeout(goToWhatIsWrong);
      return;
    }
    busy.value = true;
    try {
      if (etag)
        await ask('PUT', partPath(part!.id), { body: document, headers: { 'If-Match': etag } });
      else added.value = (await ask<Part>('POST', '/v1/parts', { body: document })).body;
      props.onClose(true);
    } catch (error) {
      const refused = asProblem(error);
      errors.value = refused.errors;
      problem.value =
        refused.status === 412
          ? 'Someone changed this part meanwhile. Close this window and open the part again; nothing was saved.'
          : refused.errors.length > 0
            ? 'Not saved; see the fields marked.'
            : refused.message;
      setTimeout(goToWhatIsWrong); // once the fields are marked
    } finally {
      busy.value = false;
    }
  };

  const text = (name: string, label: string, options?: string[], hint?: string) => (
    <TextField
      key={name}
      label={label}
      value={String(now[name] ?? '')}
      error={errorAt(name)}
      options={options}
      hint={hint}
      pointer={`/${name}`}
      onChange={(v) => set(name, v)}
    />
  );
  const choice = (name: string, label: string, allowed: string[], hint?: string) => (
    <Select
      key={name}
      label={label}
      value={String(now[name] ?? '')}
      options={['', ...allowed].map((value) => ({ value, label: value || 'not said' }))}
      error={errorAt(name)}
      hint={hint}
      pointer={`/${name}`}
      onChange={(v) => set(name, v)}
    />
  );
  const lines = (
    label: string,
    pointer: string,
    state: { value: string },
    rows: number,
    hint?: string,
  ) => (
    <label class="curve">
      {label}
      <textarea
        rows={rows}
        value={state.value}
        data-pointer={pointer}
        aria-invalid={errorAt(pointer.slice(1)) ? true : undefined}
        placeholder={hint}
        onInput={(e) => (state.value = e.currentTarget.value)}
      />
    </label>
  );
  const usual = (field: string) =>
    [
      ...new Set(
        props.known.map((p) => p[field]).filter((v): v is string => typeof v === 'string'),
      ),
    ].sort();
  return (
    <Dialog
      wide
      title={etag ? `Edit ${part!.part_number}` : `Add a part: ${familyWord(meta.name)}`}
      onClose={() => props.onClose(false)}
    >
      <form
        ref={form}
        noValidate
        onSubmit={(event) => {
          event.preventDefault();
          void save();
        }}
      >
        {problem.value && <Notice kind="bad">{problem.value}</Notice>}
        {elsewhere.map((e) => (
          <p key={e.pointer} class="error">
            <code>{e.pointer}</code> {e.detail}
          </p>
        ))}
        <div class="fields">
          {text('manufacturer', 'Maker', usual('manufacturer'))}
          {text('part_number', 'Part number')}
          {text('series', 'Series (optional)', usual('series'), 'what variants of one part share')}
          {!etag && text('id', 'Id', undefined, 'made from maker and number if empty')}
          {meta.texts.map((field) => {
            const label = labelOf(field.name.replaceAll('_', ' '), field.required);
            return field.allowed.length > 0
              ? choice(field.name, label, field.allowed, field.meaning)
              : text(field.name, label, usual(field.name), field.meaning);
          })}
          {meta.numbers.map((field) => {
            const { label, unit } = fieldName(field.name);
            return (
              <NumberField
                key={field.name}
                label={labelOf(label, field.required)}
                unit={unit}
                kind={fieldKind(field.name)}
                value={now[field.name] as number | string | undefined}
                range={[field.min, field.max]}
                {...printedAs(field.name)}
                {...(!field.required && { optional: true, placeholder: '' })}
                takesUnits={namesUnit(field.name)}
                onText={(v) => set(field.name, v)}
                error={errorAt(field.name)}
                pointer={`/${field.name}`}
                onChange={(v) => set(field.name, v)}
              />
            );
          })}
        </div>
        {meta.has_curve && (
          <CurveField
            text={curve.value}
            errors={errors.value}
            onChange={(text) => (curve.value = text)}
          />
        )}
        {lines(
          'Offers, net of tax: supplier | price | currency | pieces in the pack | date | link; one a line. The newest makes the price.',
          '/offers',
          offers,
          2,
          'Shop | 12.50 | EUR | 1 | 2024-05-31 | https://example.org/part',
        )}
        {lines(
          'Documents: link; one a line',
          '/documents',
          documents,
          2,
          'https://example.org/part.pdf',
        )}
        {lines('Other names and numbers; one a line', '/aliases', aliases, 2)}
        <div class="fields">
          <Select
            label={part ? 'Changed numbers are from' : 'These numbers are from'}
            value={kind.value}
            onChange={(v) => (kind.value = v)}
            options={(Object.keys(provenanceWord) as Provenance['kind'][]).map((k) => ({
              value: k,
              label: provenanceWord[k],
            }))}
          />
          <TextField
            label="Source"
            value={source.value}
            onChange={(v) => (source.value = v)}
            hint="page, file or measurement"
          />
          <NumberField
            label="Uncertainty of these numbers (optional)"
            unit="%"
            value={uncertainty.value}
            range={[1e-4, 100]}
            hint="one standard deviation"
            optional
            placeholder=""
            onText={(v) => (uncertainty.value = v)}
            onChange={(v) => (uncertainty.value = v)}
          />
          <Select
            label="Can be ordered"
            value={now.orderable === true ? 'yes' : now.orderable === false ? 'no' : ''}
            onChange={(v) => set('orderable', v === '' ? null : v === 'yes')}
            options={[
              { value: '', label: 'not known' },
              { value: 'yes', label: 'yes' },
              { value: 'no', label: 'no, a class of parts' },
            ]}
          />
          {text('notes', 'Notes')}
        </div>
        <div class="toolbar end">
          <button type="submit" class="primary" disabled={busy.value}>
            {etag ? 'Save the change' : 'Add the part'}
          </button>
        </div>
      </form>
    </Dialog>
  );
}
