// What the service understood of a table, to be put right by hand.
import type { Answers, ColumnRead, Question, Understood } from '../lib/table_import';
import { columnsOf, missingColumns, splitTarget, takesUnit } from '../lib/table_import';
import type { Family } from '../lib/types';
import { AnswerButtons, UnitInput } from '../ui/column_answers';
import { Notice, Select } from '../ui/controls';
import { Scroll } from '../ui/scroll';

type Change = (answers: Answers) => void;

// Of the whole table: a choice for each question.
export function TableQuestions(props: {
  questions: Question[];
  answers: Answers;
  onChange: Change;
}) {
  const open = props.questions.filter((one) => one.option !== 'column');
  return (
    <>
      {open.map((one) => (
        <Notice kind="warn" key={one.question}>
          <p>{one.question}</p>
          <AnswerButtons
            answers={one.answers}
            onAnswer={(answer) => props.onChange({ ...props.answers, [one.option]: answer })}
          />
        </Notice>
      ))}
    </>
  );
}

function ColumnRow(props: {
  column: ColumnRead;
  meta: Family;
  question?: Question;
  answer?: string;
  onAnswer: (target: string) => void;
}) {
  const { column, question } = props;
  const target = props.answer ?? column.targets.join(' + ');
  const { column: field, unit } = splitTarget(target);
  const isOpen = props.answer === undefined && target === '';
  const several = target.includes('+');
  const options = [
    ...(isOpen && question ? [{ value: '?', label: 'choose…' }] : []),
    { value: '', label: 'left out' },
    ...(several ? [{ value: target, label: target }] : []),
    ...(question?.answers ?? [])
      .filter((answer) => answer !== target)
      .map((answer) => ({ value: answer, label: answer })),
    ...columnsOf(props.meta).map((name) => ({ value: name, label: name })),
  ];
  const isNumber = takesUnit(props.meta, field);
  return (
    <tr>
      <th scope="row">{column.heading || `column ${column.key.slice(1)}`}</th>
      <td class="samples">{column.samples.join(' · ')}</td>
      <td>
        <Select
          label={`Column for ${column.key}`}
          hideLabel
          value={isOpen && question ? '?' : several ? target : field}
          options={options}
          onChange={props.onAnswer}
        />
      </td>
      <td>
        {isNumber && !several && (
          <UnitInput of={column.key} target={field} unit={unit} onTarget={props.onAnswer} />
        )}
      </td>
      <td>
        {column.decimal && <span class="muted">decimal {column.decimal}</span>}
        {question && <span class="from estimated">{question.question}</span>}
      </td>
    </tr>
  );
}

export function ColumnTable(props: {
  understood: Understood;
  questions: Question[];
  meta: Family;
  answers: Answers;
  onChange: Change;
}) {
  const { understood, answers } = props;
  const shown = understood.columns.filter((column) => column.heading || column.samples.length);
  const of = (column: ColumnRead) =>
    props.questions.find((one) => one.option === 'column' && one.heading === column.key);
  return (
    <Scroll label="Columns of the table">
      <table class="import-columns">
        <thead>
          <tr>
            <th>Heading</th>
            <th>First cells</th>
            <th>Column</th>
            <th>Unit</th>
            <th>Remarks</th>
          </tr>
        </thead>
        <tbody>
          {shown.map((column) => (
            <ColumnRow
              key={column.key}
              column={column}
              meta={props.meta}
              question={of(column)}
              answer={answers.columns[column.key]}
              onAnswer={(target) => {
                if (target === '?') return;
                props.onChange({
                  ...answers,
                  columns: { ...answers.columns, [column.key]: target },
                });
              }}
            />
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

// What all parts need and no column has: the same for all rows.
export function ForAllRows(props: {
  understood: Understood;
  meta: Family;
  answers: Answers;
  onChange: Change;
}) {
  const missing = missingColumns(props.meta, props.understood);
  if (missing.length === 0) return null;
  return (
    <fieldset class="for-all">
      <legend>
        In no column: the same for all rows, or empty where a law of the catalogue gives it
      </legend>
      {missing.map((name) => (
        <label key={name}>
          {name}
          <input
            value={props.answers.set[name] ?? ''}
            onChange={(event) =>
              props.onChange({
                ...props.answers,
                set: { ...props.answers.set, [name]: event.currentTarget.value },
              })
            }
          />
        </label>
      ))}
    </fieldset>
  );
}

export function ReadAs({ understood }: { understood: Understood }) {
  const { left_out: rows } = understood;
  return (
    <>
      <p class="hint">
        Read as {understood.encoding}, {understood.delimiter}, headings in row{' '}
        {understood.header_row}; ids {understood.ids}.
      </p>
      {rows.length > 0 && (
        <p class="hint">
          Left out: {rows.map((one) => `row ${one.row} (${one.why})`).join(', ')}
          {understood.left_out_count > rows.length && ' …'}
        </p>
      )}
    </>
  );
}
