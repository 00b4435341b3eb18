// A design as a unit for co-simulation, which the simulator of a robot drives.
import { useSignal } from '@preact/signals';

import { asProblem, post } from '../lib/api';
import type { Design, Requirements } from '../lib/types';
import { saveFile } from '../ui/files';

export function FmuButton(props: { name: string; design: Design; requirements: Requirements }) {
  const { name, design, requirements } = props;
  const problem = useSignal('');
  const save = async () => {
    problem.value = '';
    try {
      const unit = await post<Blob>('/v1/fmus', { schema: 'evaluation/1', requirements, design });
      saveFile(`${name}.fmu`, unit, 'application/octet-stream');
    } catch (error) {
      problem.value = asProblem(error).sentence;
    }
  };
  return (
    <>
      <button
        type="button"
        data-tip="For the simulator of your robot: a unit for co-simulation (FMI 2.0)"
        onClick={() => void save()}
      >
        FMU
      </button>
      {problem.value && (
        <span class="error" role="alert">
          {problem.value}
        </span>
      )}
    </>
  );
}
