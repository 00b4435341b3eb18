// Parts from a table: what would happen is shown before anything is written, and what the table
// leaves open is answered by hand. The answers are kept for files of the same shape.
import { useSignal } from '@preact/signals';

import { ask, asProblem, type FieldError } from '../lib/api';
import { csvOf, isWorkbook } from '../ui/sheet';
import {
  type Answers,
  forget,
  importPath,
  noAnswers,
  type Question,
  recall,
  remember,
  shapeOf,
  type Understood,
} from '../lib/table_import';
import type { Family } from '../lib/types';
import { Dialog, Notice } from '../ui/controls';
import { ExportButton, FilePicker } from '../ui/files';
import { ColumnTable, ForAllRows, ReadAs, TableQuestions } from './import_columns';

interface Plan {
  added: string[];
  replaced: string[];
  unchanged: string[];
  understood: Understood;
}

const IdList = ({ label, ids }: { label: string; ids: string[] }) =>
  ids.length === 0 ? null : (
    <p>
      <b>
        {ids.length} {label}:
      </b>{' '}
      {ids.slice(0, 12).join(', ')}
      {ids.length > 12 && ' …'}
    </p>
  );

const ErrorRows = ({ errors }: { errors: FieldError[] }) =>
  errors.length === 0 ? null : (
    <ul class="import-errors">
      {errors.slice(0, 50).map((e) => (
        <li key={e.pointer + e.detail}>
          <code>{e.pointer}</code> {e.detail}
        </li>
      ))}
    </ul>
  );

function useTable(family: string) {
  const table = useSignal<string | Blob>('');
  const start = useSignal('');
  const answers = useSignal<Answers>(noAnswers());
  const isRecalled = useSignal(false);
  const understood = useSignal<Understood | null>(null);
  const questions = useSignal<Question[]>([]);
  const plan = useSignal<Plan | null>(null);
  const errors = useSignal<FieldError[]>([]);
  const problem = useSignal('');
  const latest = useSignal(0);
  const shapes = () => [
    shapeOf(family, null, start.value),
    shapeOf(family, understood.value, start.value),
  ];
  const send = (dryRun: boolean) =>
    ask<Plan>('POST', importPath(family, answers.value, dryRun), {
      text: table.value,
      headers: { 'Content-Type': 'text/csv' },
    });
  const look = async () => {
    const turn = (latest.value += 1); // a later answer may come first
    plan.value = null;
    errors.value = [];
    questions.value = [];
    problem.value = '';
    try {
      const { body } = await send(true);
      if (turn !== latest.value) return;
      plan.value = body;
      understood.value = body.understood;
    } catch (error) {
      if (turn !== latest.value) return;
      const refused = asProblem(error);
      questions.value = (refused.body.questions as Question[] | undefined) ?? [];
      understood.value = (refused.body.understood as Understood | undefined) ?? understood.value;
      if (questions.value.length > 0) return;
      errors.value = refused.errors;
      problem.value = refused.errors.length
        ? `${refused.errors.length} errors; nothing can be imported.`
        : refused.message;
    }
  };
  const use = async (given: Answers, recalled = false) => {
    answers.value = given;
    isRecalled.value = recalled;
    await look();
  };
  const open = async (opened: string | Blob) => {
    table.value = opened;
    start.value =
      typeof opened === 'string' ? opened.slice(0, 400) : await opened.slice(0, 400).text();
    understood.value = null;
    if (typeof opened === 'string' && opened.trim() === '') return;
    await use(noAnswers());
    const known = shapes().map(recall).find(Boolean);
    if (known) await use(known, true);
  };
  return {
    ...{ answers, isRecalled, understood, questions, plan, errors, problem, send, use, open },
    text: () => (typeof table.value === 'string' ? table.value : ''),
    keep: () => {
      if (!understood.value?.as_exported) remember(shapes(), answers.value);
    },
    startAnew: () => {
      forget(shapes());
      return use(noAnswers());
    },
  };
}

function Reading({ table, meta }: { table: ReturnType<typeof useTable>; meta: Family }) {
  const understood = table.understood.value;
  const answers = table.answers.value;
  const change = (given: Answers) => void table.use(given);
  return (
    <>
      {table.isRecalled.value && (
        <Notice kind="info">
          Read as the last table with these headings.{' '}
          <button type="button" onClick={() => void table.startAnew()}>
            Start anew
          </button>
        </Notice>
      )}
      <TableQuestions questions={table.questions.value} answers={answers} onChange={change} />
      {understood && !understood.as_exported && understood.columns.length > 0 && (
        <>
          <ReadAs understood={understood} />
          <ColumnTable
            understood={understood}
            questions={table.questions.value}
            meta={meta}
            answers={answers}
            onChange={change}
          />
          <ForAllRows understood={understood} meta={meta} answers={answers} onChange={change} />
        </>
      )}
    </>
  );
}

export function ImportDialog({
  meta,
  onClose,
}: {
  meta: Family;
  onClose: (done: boolean) => void;
}) {
  const family = meta.name;
  const table = useTable(family);
  const choose = async (file: File) => {
    try {
      await table.open(isWorkbook(file) ? await csvOf(file) : file);
    } catch (error) {
      table.problem.value = `${file.name}: ${asProblem(error).message}`;
    }
  };
  const write = async () => {
    try {
      await table.send(false);
      table.keep();
      onClose(true);
    } catch (error) {
      table.problem.value = asProblem(error).message;
    }
  };
  const plan = table.plan.value;
  const n = plan ? plan.added.length + plan.replaced.length : 0;
  return (
    <Dialog wide title={`Import ${family} parts`} onClose={() => onClose(false)}>
      <p class="hint">
        A table as you have it, .xlsx or CSV of any dialect: headings in other words and with units,
        titles above them, totals below. Cells may carry units, such as 6 bar or 350 g.
      </p>
      <div class="toolbar">
        <FilePicker
          label="Choose a file…"
          accept=".csv,.tsv,.txt,.xlsx,text/csv"
          onFiles={([file]) => void choose(file!)}
        />
        <ExportButton family={family} label="Export as a pattern" />
      </div>
      <label class="curve">
        or paste it here
        <textarea
          rows={5}
          value={table.text()}
          onInput={(e) => void table.open(e.currentTarget.value)}
        />
      </label>
      <Reading table={table} meta={meta} />
      {table.problem.value && <Notice kind="bad">{table.problem.value}</Notice>}
      <ErrorRows errors={table.errors.value} />
      {plan && (
        <Notice kind="info">
          <IdList label="to add" ids={plan.added} />
          <IdList label="to replace" ids={plan.replaced} />
          <IdList label="unchanged" ids={plan.unchanged} />
        </Notice>
      )}
      <div class="toolbar end">
        <button type="button" class="primary" disabled={n === 0} onClick={() => void write()}>
          Import {n === 1 ? 'the part' : `${n} parts`}
        </button>
      </div>
    </Dialog>
  );
}
