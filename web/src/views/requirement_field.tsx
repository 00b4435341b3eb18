// A number of the requirements, by its path in the document. Where its name ends in a unit, a text
// with another unit may stand in its place; the service reads it, and the field says what it read.
import { short } from '../lib/format';
import { edit, errorAt, requirements, understoodAt, valueAt, warningAt } from '../lib/requirements';
import { takesText } from '../lib/understood';
import { toShown, unitOf } from '../lib/units';
import { NumberField, type NumberFieldProps } from '../ui/controls';

export function RequirementField(
  props: Omit<NumberFieldProps, 'value' | 'onChange' | 'onText' | 'error' | 'pointer'> & {
    path: (string | number)[];
    then?: () => void; // after an edit
  },
) {
  const { path, then, ...rest } = props;
  const pointer = `/${path.join('/')}`;
  const kind = props.kind ?? 'plain';
  const row = understoodAt(pointer);
  const read =
    row &&
    `read as ${short(toShown(kind, row.value))} ${unitOf(kind, row.unit)}${row.condition ? ` at ${row.condition}` : ''}`;
  const warning = warningAt(pointer);
  return (
    <NumberField
      {...rest}
      value={valueAt(requirements.value, path) as number | string | null | undefined}
      pointer={pointer}
      error={errorAt(pointer)}
      takesUnits={takesText(String(path.at(-1)))}
      {...(read !== undefined && { read })}
      {...(warning !== undefined && { warning })}
      onText={(text) => {
        edit(path, text);
        then?.();
      }}
      onChange={(value) => {
        edit(path, value ?? (props.optional || props.usual !== undefined ? undefined : null));
        then?.();
      }}
    />
  );
}
