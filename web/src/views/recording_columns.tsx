// What the service understood of a recording, each column to be put right by hand.
import {
  type Recording,
  type RecordingColumn,
  recordingFields,
  type RecordingQuestion,
  splitField,
  type TableAnswers,
} from '../lib/recording';
import { AnswerButtons, UnitInput } from '../ui/column_answers';
import { Notice, Panel, Select } from '../ui/controls';
import { Scroll } from '../ui/scroll';

type Change = (answers: TableAnswers) => void;

function ColumnRow(props: {
  column: RecordingColumn;
  question?: RecordingQuestion;
  answer?: string;
  onAnswer: (target: string) => void;
}) {
  const { column, question } = props;
  const given = props.answer === undefined ? null : splitField(props.answer);
  const field = given ? given.field : (column.field ?? '');
  const unit = given?.unit || (column.unit ?? '');
  const options = [
    { value: '', label: 'left out' },
    ...recordingFields.map((name) => ({ value: name, label: name })),
  ];
  return (
    <tr>
      <th scope="row">{column.heading || `column ${column.key.slice(1)}`}</th>
      <td class="samples">{column.first.join(' · ')}</td>
      <td>
        <Select
          label={`Field of ${column.key}`}
          hideLabel
          value={field}
          options={options}
          onChange={props.onAnswer}
        />
      </td>
      <td>
        {field && !['run', 'specimen', 'date'].includes(field) && (
          <UnitInput of={column.key} target={field} unit={unit} onTarget={props.onAnswer} />
        )}
      </td>
      <td>
        {column.meaning && <span class="muted">{column.meaning}</span>}
        {question && (
          <>
            <span class="from estimated">{question.question}</span>
            <span class="toolbar">
              {question.answers.slice(0, 6).map((answer) => (
                <button type="button" key={answer} onClick={() => props.onAnswer(answer)}>
                  {answer || 'leave it out'}
                </button>
              ))}
            </span>
          </>
        )}
      </td>
    </tr>
  );
}

function Questions(props: { recording: Recording; onChange: Change }) {
  const { answers, questions, understood } = props.recording;
  const keys = new Set(understood.columns.map((column) => column.key));
  const ofTable = questions.filter(
    (one) => one.option !== 'valve' && !(one.option === 'column' && keys.has(one.heading ?? '')),
  );
  return (
    <>
      {ofTable.map((one) => (
        <Notice kind="warn" key={one.question}>
          <p>{one.question}</p>
          {one.option !== 'column' && (
            <AnswerButtons
              answers={one.answers}
              onAnswer={(answer) => props.onChange({ ...answers, [one.option]: answer })}
            />
          )}
        </Notice>
      ))}
    </>
  );
}

export function RecordingPanel(props: { recording: Recording; onChange: Change }) {
  const { recording } = props;
  const { understood, answers } = recording;
  const put = (key: string, target: string) =>
    props.onChange({ ...answers, columns: { ...answers.columns, [key]: target } });
  const questionOf = (key: string) =>
    recording.questions.find((one) => one.option === 'column' && one.heading === key);
  return (
    <Panel title={`What was read in ${recording.name}`}>
      <Questions recording={recording} onChange={props.onChange} />
      <Scroll label="Columns of the recording">
        <table class="import-columns">
          <thead>
            <tr>
              <th>Heading</th>
              <th>First cells</th>
              <th>Field</th>
              <th>Unit</th>
              <th>Remarks</th>
            </tr>
          </thead>
          <tbody>
            {understood.columns.map((column) => (
              <ColumnRow
                key={column.key}
                column={column}
                question={questionOf(column.key)}
                answer={answers.columns?.[column.key]}
                onAnswer={(target) => put(column.key, target)}
              />
            ))}
          </tbody>
        </table>
      </Scroll>
      <p class="hint">
        Read as {understood.encoding}, columns by {understood.delimiter}
        {understood.decimal && `, decimal ${understood.decimal}`}
        {understood.heading_line && `, headings in line ${understood.heading_line}`}.{' '}
        {understood.notes.join('. ')}
      </p>
    </Panel>
  );
}
