// What a person who tends the catalogue should look at: duplicates, odd numbers, what is missing or
// estimated.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, get } from '../lib/api';
import { short } from '../lib/format';
import { link } from '../lib/route';
import { Dialog, Notice } from '../ui/controls';

interface Check {
  duplicates: { family: string; why: string; ids: string[] }[];
  outliers: {
    id: string;
    family: string;
    field: string;
    value: number;
    family_median: number;
  }[];
  families: {
    family: string;
    parts: number;
    without_price: string[];
    without_document: string[];
    values: number;
    estimated: number;
    estimated_share: number;
  }[];
}

const PartLink = ({ family, id }: { family: string; id: string }) => (
  <a href={link(['catalogue', family], { part: id })}>{id}</a>
);

const Duplicates = ({ rows }: { rows: Check['duplicates'] }) =>
  rows.length === 0 ? (
    <p>No part stands there twice.</p>
  ) : (
    <ul>
      {rows.map((one) => (
        <li key={one.ids.join()}>
          {one.ids.map((id, i) => (
            <>
              {i > 0 && ', '}
              <PartLink family={one.family} id={id} />
            </>
          ))}
          : {one.why}
        </li>
      ))}
    </ul>
  );

const Outliers = ({ rows }: { rows: Check['outliers'] }) =>
  rows.length === 0 ? (
    <p>No number is far from the rest of its family.</p>
  ) : (
    <ul class="import-errors">
      {rows.map((one) => (
        <li key={one.id + one.field}>
          <PartLink family={one.family} id={one.id} />: {one.field} {short(one.value)}, the family’s
          median is {short(one.family_median)}
        </li>
      ))}
    </ul>
  );

const Families = ({ rows }: { rows: Check['families'] }) => (
  <div class="scroll-frame">
    <table>
      <thead>
        <tr>
          <th>Family</th>
          <th class="number">Parts</th>
          <th class="number">No price</th>
          <th class="number">No document</th>
          <th class="number">Values</th>
          <th class="number">Estimated</th>
        </tr>
      </thead>
      <tbody>
        {rows.map((one) => (
          <tr key={one.family}>
            <th scope="row">{one.family}</th>
            <td class="number">{one.parts}</td>
            <td class="number">{one.without_price.length}</td>
            <td class="number">{one.without_document.length}</td>
            <td class="number">{one.values}</td>
            <td class="number">{Math.round(100 * one.estimated_share)} %</td>
          </tr>
        ))}
      </tbody>
    </table>
  </div>
);

export function CheckDialog({ family, onClose }: { family: string; onClose: () => void }) {
  const check = useSignal<Check | null>(null);
  const problem = useSignal('');
  useEffect(() => {
    get<Check>('/v1/parts/check')
      .then((found) => (check.value = found))
      .catch((error: unknown) => (problem.value = asProblem(error).message));
  }, []);
  const of = <T extends { family: string }>(rows: T[]) =>
    rows.filter((one) => one.family === family);
  return (
    <Dialog wide title={`Check of the catalogue, ${family}`} onClose={onClose}>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {check.value && (
        <>
          <h3>Maybe one part under several names</h3>
          <Duplicates rows={of(check.value.duplicates)} />
          <h3>Worth a second look</h3>
          <Outliers rows={of(check.value.outliers)} />
          <h3>All families</h3>
          <Families rows={check.value.families} />
        </>
      )}
    </Dialog>
  );
}
