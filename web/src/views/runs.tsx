// Which run is shown, and what the shades behind its plot mean.
import { route, setQuery } from '../lib/route';
import { Segmented, Select } from '../ui/controls';

export function RunPicker({ ids, value }: { ids: string[]; value: string }) {
  if (ids.length < 2) return null;
  const onChange = (id: string) => setQuery({ run: id === ids[0] ? undefined : id });
  return ids.length <= 6 ? (
    <Segmented label="run" options={ids} value={value} onChange={onChange} />
  ) : (
    <Select
      label="run"
      value={value}
      options={ids.map((id) => ({ value: id, label: id }))}
      onChange={onChange}
    />
  );
}

export const pickRun = (ids: string[]): string => {
  const asked = route.value.query.get('run');
  return asked && ids.includes(asked) ? asked : (ids[0] ?? '');
};

export const PhaseKey = () => (
  <p class="hint phase-key">
    Shades: <i class="swatch inflate" /> inflate <i class="swatch hold" /> hold{' '}
    <i class="swatch deflate" /> deflate
  </p>
);
