// One design: parts, masses, margins, response, maps, sensitivities, what if.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { powerWord, supplyWord } from '../lib/amounts';
import { significant } from '../lib/format';
import { traceName, type Parts, partsOf } from '../lib/rig';
import { link } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { proofInWords } from '../lib/words';
import { Chip, Notice } from '../ui/controls';
import { csv, saveFile } from '../ui/files';
import { VariantsPanel } from './kinds';
import { Exchange } from './exchange';
import { FmuButton } from './fmu_button';
import { Maps } from './maps';
import { MovedOn } from './moved_on';
import { Sensitivities } from './sensitivities';
import { Strokes } from './strokes';
import { WhatIf } from './what_if';
import { Estimates, Facts, MarginsPanel, PartsPanel } from './design_panels';
import { areEvacuated, haveVacuumRail } from '../lib/vacuum';

export function DesignPage({ answer, id, rank }: { answer: Answer; id: string; rank: number }) {
  const design = answer.designs.find((d) => d.rank === rank);
  const parts = useSignal<Parts | null>(null);
  useEffect(() => {
    parts.value = null;
    if (design) void partsOf(design).then((loaded) => (parts.value = loaded));
  }, [design]);
  if (!design) {
    return (
      <Notice kind="bad">
        This search lists no design {rank}. <a href={link(['designs', id])}>To the list</a>
      </Notice>
    );
  }
  const names = `${answer.name || id}-${rank}`;
  return (
    <div class="design-page">
      <div class="headline">
        <div class="toolbar">
          <h1>
            <a href={link(['designs', id])}>{answer.name || 'Designs'}</a> › design {rank}
          </h1>
          <Chip>{supplyWord(design)}</Chip>
          {design.settings.power && <Chip>{powerWord(design.settings.power)}</Chip>}
          <span class="toolbar-group">
            {rank > 1 && (
              <a class="button" href={link(['designs', id, String(rank - 1)])}>
                ‹ {rank - 1}
              </a>
            )}
            {rank < answer.designs.length && (
              <a class="button" href={link(['designs', id, String(rank + 1)])}>
                {rank + 1} ›
              </a>
            )}
            <button
              type="button"
              onClick={() => saveFile(`${names}.json`, `${JSON.stringify(design, null, 2)}\n`)}
            >
              JSON
            </button>
            <button
              type="button"
              onClick={() => saveFile(`${names}-parts.csv`, partsCsv(design), 'text/csv')}
            >
              Parts CSV
            </button>
            <button
              type="button"
              onClick={() => saveFile(`${names}-response.csv`, responseCsv(design), 'text/csv')}
            >
              Response CSV
            </button>
            {!answer.model && (
              <FmuButton name={names} design={design} requirements={answer.requirements} />
            )}
            <a class="button" href={link(['designs', id, String(rank), 'sheet'])}>
              Data sheet
            </a>
          </span>
        </div>
        <MovedOn answer={answer} />
        <Facts design={design} />
        {design.guarantee && (
          <p class="proof">
            Guaranteed: performance, energy and margins are those of the worst case within the
            tolerances of its parts. It may weigh up to {significant(design.guarantee.mass_kg_max)}{' '}
            kg.
          </p>
        )}
        <p class="only-printed">
          {proofInWords(answer)} Catalogue revision {answer.catalogue_revision?.number ?? '–'}.
        </p>
      </div>
      <div class="plots wide-left">
        <PartsPanel design={design} />
        <MarginsPanel design={design} answer={answer} />
      </div>
      <Strokes design={design} requirements={answer.requirements} />
      <VariantsPanel design={design} />
      <Exchange answer={answer} design={design} />
      {parts.value && (
        <WhatIf
          design={design}
          requirements={answer.requirements}
          parts={parts.value}
          effects={answer.model?.effects}
        />
      )}
      <Sensitivities design={design} requirements={answer.requirements} />
      {!areEvacuated(answer.requirements) && !haveVacuumRail(answer.requirements) && (
        <div class={`plots ${design.configuration === 'compressor' ? 'three' : 'even'}`}>
          <Maps design={design} requirements={answer.requirements} parts={parts.value} />
        </div>
      )}
      <Estimates design={design} />
    </div>
  );
}

const partsCsv = (design: Design): string =>
  csv([
    [
      'family',
      'id',
      'manufacturer',
      'part_number',
      'group',
      'quantity',
      'unit',
      'mass_kg',
      'volume_l',
      'cost_eur',
    ],
    ...design.parts.map((p) => [
      p.family,
      p.id,
      p.manufacturer,
      p.part_number,
      p.group,
      p.quantity,
      p.unit,
      p.mass_kg,
      p.volume_l,
      p.cost_eur,
    ]),
  ]);

function responseCsv(design: Design): string {
  const { t_s, groups, source_pressure_kpa_gauge } = design.response;
  return csv([
    [
      't_s',
      ...groups.map((g) => `${traceName(g)}_pressure_kpa_gauge`),
      'source_pressure_kpa_gauge',
    ],
    ...t_s.map((t, i) => [
      t,
      ...groups.map((g) => g.pressure_kpa_gauge[i]),
      source_pressure_kpa_gauge[i],
    ]),
  ]);
}
