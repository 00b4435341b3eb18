// A design as a unit for co-simulation, which the simulator of a robot drives.
import { post } from '../lib/api';
import type { Design, Requirements } from '../lib/types';
import { saveFile } from '../ui/files';
import { ActionButton } from '../ui/job';

export function FmuButton(props: { name: string; design: Design; requirements: Requirements }) {
  const { name, design, requirements } = props;
  const save = async () => {
    const unit = await post<Blob>('/v1/fmus', { schema: 'evaluation/1', requirements, design });
    saveFile(`${name}.fmu`, unit, 'application/octet-stream');
  };
  return (
    <ActionButton
      label="FMU"
      tip="For the simulator of your robot: a unit for co-simulation (FMI 2.0)"
      act={save}
    />
  );
}
