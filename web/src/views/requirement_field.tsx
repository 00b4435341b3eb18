// A number of the requirements, by its path in the document.
import { edit, errorAt, requirements, valueAt } from '../lib/requirements';
import { NumberField, type NumberFieldProps } from '../ui/controls';

export function RequirementField(
  props: Omit<NumberFieldProps, 'value' | 'onChange' | 'error' | 'pointer'> & {
    path: (string | number)[];
    usual?: number; // where the document does not say
  },
) {
  const { path, usual, ...rest } = props;
  const pointer = `/${path.join('/')}`;
  return (
    <NumberField
      {...rest}
      value={(valueAt(requirements.value, path) as number | null | undefined) ?? usual}
      pointer={pointer}
      error={errorAt(pointer)}
      onChange={(value) => edit(path, value ?? (props.optional ? undefined : null))}
    />
  );
}
