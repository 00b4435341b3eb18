// The unit of a column that has a target, "mass_kg [g]": an empty one takes the target's own.
export function UnitInput(props: {
  of: string; // the key of the column
  target: string;
  unit: string;
  onTarget: (target: string) => void;
}) {
  return (
    <input
      class="unit"
      aria-label={`Unit of ${props.of}`}
      placeholder="unit"
      value={props.unit}
      onChange={(event) => {
        const typed = event.currentTarget.value.trim();
        props.onTarget(typed ? `${props.target} [${typed}]` : props.target);
      }}
    />
  );
}

// What may be answered to a question, each by a button.
export function AnswerButtons(props: { answers: string[]; onAnswer: (answer: string) => void }) {
  return (
    <div class="toolbar">
      {props.answers.map((answer) => (
        <button type="button" key={answer} onClick={() => props.onAnswer(answer)}>
          {answer}
        </button>
      ))}
    </div>
  );
}
