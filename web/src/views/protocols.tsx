// How to measure a part: steps, expected precision with the user's sensor, and the template that the
// recording needs.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { ask, asProblem } from '../lib/api';
import { partPath } from '../lib/catalogue';
import { fieldName, uncertainty, significant } from '../lib/format';
import { route } from '../lib/route';
import type { Protocol, ProtocolTest } from '../lib/types';
import { Notice, NumberField } from '../ui/controls';
import { saveFile } from '../ui/files';
import { number, Table } from '../ui/table';

export function Protocols({ id }: { id: string }) {
  const isOpen = useSignal(route.value.query.get('protocol') === 'open');
  return (
    <details open={isOpen.value} onToggle={(event) => (isOpen.value = event.currentTarget.open)}>
      <summary>How to measure it</summary>
      {isOpen.value && <Tests id={id} />}
    </details>
  );
}

const sensorFields = [
  { name: 'sensor_noise_kpa', label: 'Sensor noise', unit: 'kPa', usual: 0.2 },
  { name: 'sensor_resolution_kpa', label: 'Step of its readings', unit: 'kPa', usual: 0.1 },
  { name: 'sampling_hz', label: 'Readings a second', unit: 'Hz', usual: 100 },
  { name: 'bottle_l', label: 'Bottle', unit: 'L' },
  {
    name: 'bottle_uncertainty',
    label: 'Uncertainty of its volume (weighed: 0.002)',
    usual: 0.02,
    isShare: true,
  },
];

function Tests({ id }: { id: string }) {
  const sensor = useSignal<Record<string, number | string>>({});
  const protocol = useSignal<Protocol | null>(null);
  const problem = useSignal('');
  const query = new URLSearchParams(
    Object.entries(sensor.value).map(([name, value]) => [name, String(value)]),
  ).toString();
  const put = (name: string) => (value: number | string | null) => {
    const { [name]: _, ...rest } = sensor.value;
    sensor.value = value === null ? rest : { ...rest, [name]: value };
  };
  useEffect(() => {
    let isNewest = true;
    ask<Protocol>('GET', `${partPath(id)}/protocol?${query}`).then(
      ({ body }) => {
        if (!isNewest) return;
        protocol.value = body;
        problem.value = '';
      },
      (error) => isNewest && (problem.value = asProblem(error).sentence),
    );
    return () => void (isNewest = false);
  }, [id, query]);
  return (
    <>
      <div class="toolbar">
        {sensorFields.map(({ name, ...field }) => (
          <NumberField
            key={name}
            {...field}
            value={sensor.value[name] ?? null}
            optional
            placeholder={field.usual === undefined ? 'a fitting one' : undefined}
            onChange={put(name)}
            onText={put(name)}
          />
        ))}
      </div>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {protocol.value?.tests.length === 0 && <p>No test is known for this family.</p>}
      {protocol.value?.tests.map((test) => (
        <Test key={test.protocol} part={id} test={test} />
      ))}
    </>
  );
}

function Test({ part, test }: { part: string; test: ProtocolTest }) {
  const { equipment, recording } = test;
  return (
    <>
      <h3>{test.protocol.replace(/_/g, ' ')}</h3>
      {equipment && (
        <p>
          Bottle of {significant(equipment.bottle_l)} L
          {equipment.source_pressure_kpa_gauge !== null &&
            `, source at ${significant(equipment.source_pressure_kpa_gauge)} kPa gauge`}
          , {significant(equipment.sampling_hz)} readings a second for{' '}
          {significant(equipment.duration_s)} s, {equipment.repeats} times; one check with{' '}
          {significant(equipment.check_bottle_l)} L.
        </p>
      )}
      <ol>
        {test.steps.map((step) => (
          <li key={step}>{step}</li>
        ))}
      </ol>
      <Table
        label={`How precise a ${test.protocol.replace(/_/g, ' ')} will be`}
        heads={[
          'number',
          number('uncertainty'),
          number('by the sensor'),
          number('by the rig'),
          'how',
        ]}
      >
        {test.precision.map((row) => (
          <tr key={`${row.field} ${row.pressure_kpa_gauge ?? ''} ${row.how}`}>
            <th scope="row">
              {fieldName(row.field).label || row.field.replace(/_/g, ' ')}
              {row.pressure_kpa_gauge !== undefined &&
                ` at ${significant(row.pressure_kpa_gauge)} kPa`}
            </th>
            <td class="num">{uncertainty(row.uncertainty, 2)}</td>
            <td class="num">{uncertainty(row.from_noise, 2)}</td>
            <td class="num">{uncertainty(row.from_rig, 2)}</td>
            <td>{row.told ? row.how : `${row.how}; not told`}</td>
          </tr>
        ))}
      </Table>
      {test.warnings.map((warning) => (
        <Notice key={warning} kind="warn">
          {warning}
        </Notice>
      ))}
      {recording && (
        <p>
          <button
            type="button"
            onClick={() =>
              saveFile(`${part}-template.json`, `${JSON.stringify(recording.template, null, 2)}\n`)
            }
          >
            Save the template
          </button>{' '}
          Record a CSV with the columns <code>{recording.columns.join(', ')}</code> and open it
          together with the template under Measured data.
        </p>
      )}
    </>
  );
}
