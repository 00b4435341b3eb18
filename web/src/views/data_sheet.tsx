// A design on paper: when and from what it was computed, how it is connected, what to buy, what it
// does, what can hurt.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { objectiveName, quantityOf, supplyWord } from '../lib/amounts';
import { isAddress, sheetOf } from '../lib/catalogue';
import { moment, shown, short, significant } from '../lib/format';
import { type Parts, partsOf } from '../lib/rig';
import { link } from '../lib/route';
import { safetyNotes } from '../lib/safety';
import type { Answer, Design, Group, Job, Part, Requirements } from '../lib/types';
import { unitOf } from '../lib/units';
import { noteText, proofInWords } from '../lib/words';
import { Notice, Panel } from '../ui/controls';
import { Scroll } from '../ui/scroll';
import { number, Table } from '../ui/table';
import { Estimates, Facts, MarginsPanel, Packs } from './design_panels';
import { Schematic } from './schematic';
import { Strokes } from './strokes';

export function DataSheet({ answer, job, rank }: { answer: Answer; job: Job; rank: number }) {
  const design = answer.designs.find((d) => d.rank === rank);
  const parts = useSignal<Parts | null>(null);
  useEffect(() => {
    if (design) void partsOf(design).then((loaded) => (parts.value = loaded));
  }, [design]);
  if (!design) return <Notice kind="bad">This search lists no design {rank}.</Notice>;
  const { requirements } = answer;
  const note = noteText(requirements.note);
  return (
    <div class="sheet">
      <div class="toolbar">
        <h1>
          {answer.name || 'Design'}: data sheet of design {rank}
        </h1>
        <span class="toolbar-group">
          <a class="button" href={link(['designs', job.id, String(rank)])}>
            To the design
          </a>
          <button type="button" class="primary" onClick={() => print()}>
            Print
          </button>
        </span>
      </div>
      <p>
        Computed {moment(job.submitted_at, true)} with revision{' '}
        {answer.catalogue_revision?.number ?? '–'} of the catalogue
        {answer.plenum && ` by plenum ${answer.plenum}`}. Search {job.id}.
      </p>
      {note && <p>{note}</p>}
      <p>{proofInWords(answer)}</p>
      <Panel title={`The design: ${supplyWord(design)}`}>
        <Facts design={design} />
        <Scroll label="Schematic">
          <Schematic design={design} requirements={requirements} />
        </Scroll>
      </Panel>
      <Panel title="Requirements as given">
        <Inputs requirements={requirements} />
      </Panel>
      <Panel title="Bill of materials">
        <Bill design={design} parts={parts.value} />
      </Panel>
      <MarginsPanel design={design} answer={answer} />
      <Strokes design={design} requirements={requirements} />
      <Panel title="Safety">
        {parts.value && (
          <ul class="reasons">
            {safetyNotes(design, requirements, parts.value).map((text) => (
              <li key={text}>{text}</li>
            ))}
          </ul>
        )}
        <p class="hint">
          These notes follow from the numbers above. They do not replace the judgement of those who
          build it.
        </p>
      </Panel>
      <Estimates design={design} />
    </div>
  );
}

const pressureText = (kpa: number): string => `${shown('pressure', kpa)} ${unitOf('pressure')}`;

function groupRows(group: Group): [string, string][] {
  const rest = group.rest_volume_ml ?? group.pressure_volume?.[0]?.volume_ml;
  const limits = [
    group.rise_time_s_max && `rise in ${short(group.rise_time_s_max)} s`,
    group.fall_time_s_max && `fall in ${short(group.fall_time_s_max)} s`,
    group.pressure_kpa_gauge_max && `at most ${pressureText(group.pressure_kpa_gauge_max)}`,
  ].filter(Boolean);
  return [
    [
      `${group.count} × ${group.name}`,
      [
        rest !== undefined && `${shown('volume_ml', rest)} ${unitOf('volume_ml')} at rest`,
        group.expansion_ratio !== undefined && `× ${short(group.expansion_ratio)} when inflated`,
        pressureText(group.operating_pressure_kpa_gauge),
        `${short(group.tube_length_m)} m of tube, ${group.fittings_per_line ?? 2} fittings each`,
      ]
        .filter(Boolean)
        .join(', '),
    ],
    [`limits of ${group.name}`, limits.join(', ') || 'none'],
  ];
}

function Inputs({ requirements: asked }: { requirements: Requirements }) {
  const { duty, supply = {}, ambient } = asked;
  const limits = [
    supply.source_pressure_kpa_gauge_max &&
      `source ${pressureText(supply.source_pressure_kpa_gauge_max)}`,
    supply.mass_kg_max && `${short(supply.mass_kg_max)} kg`,
    supply.volume_l_max && `${shown('volume_l', supply.volume_l_max)} ${unitOf('volume_l')}`,
    supply.cost_eur_max && `${short(supply.cost_eur_max)} €`,
  ].filter(Boolean);
  const acting = duty.simultaneous === false ? 'groups evenly staggered' : 'groups together';
  const rows: [string, string][] = [
    ...asked.actuators.flatMap(groupRows),
    [
      'duty',
      `${short(duty.actuations)} actuations at ${short(duty.frequency_hz)} Hz${asked.actuators.length > 1 ? `, ${acting}` : ''}`,
    ],
    [
      'strokes end at',
      `${short(100 * (asked.rise?.to_fraction ?? 0.95))} % rising and ${short(100 * (asked.fall?.to_fraction ?? 0.05))} % falling of operating pressure`,
    ],
    [
      'supplies searched',
      supply.configurations?.map((configuration) => supplyWord({ configuration })).join(', ') ??
        'all',
    ],
    ['at most', limits.join(', ') || 'no limits'],
    [
      'ambient',
      `${significant(ambient?.pressure_kpa_abs ?? 100, 4)} kPa absolute, ${significant(ambient?.temperature_k ?? 293.15, 5)} K`,
    ],
    ['ranked by', asked.objective?.pareto ? 'Pareto front' : `least ${objectiveName(asked)}`],
  ];
  return (
    <Table label="Requirements as given" heads={['of', 'asked']}>
      {rows.map(([name, text]) => (
        <tr key={name}>
          <th scope="row">{name}</th>
          <td>{text}</td>
        </tr>
      ))}
    </Table>
  );
}

const hostOf = (address: string): string => new URL(address).host.replace(/^www\./, '');

function Links({ part }: { part: Part | undefined }) {
  if (!part) return <>–</>;
  const links = [
    ...part.offers
      .filter((offer) => isAddress(offer.link))
      .map((offer) => ({ to: offer.link, text: `${hostOf(offer.link)}, offer` })),
    ...[sheetOf(part)]
      .filter((address) => address !== undefined)
      .map((to) => ({ to, text: `${hostOf(to)}, document` })),
  ];
  if (links.length === 0) return <>–</>;
  return (
    <>
      {links.map(({ to, text }) => (
        <div key={to + text}>
          <a class="outside" href={to} rel="noreferrer" target="_blank">
            {text}
          </a>
        </div>
      ))}
    </>
  );
}

function Bill({ design, parts }: { design: Design; parts: Parts | null }) {
  return (
    <>
      <BillTable design={design} parts={parts} />
      <Packs design={design} />
    </>
  );
}

function BillTable({ design, parts }: { design: Design; parts: Parts | null }) {
  return (
    <Table
      label="Bill of materials"
      heads={[
        'part',
        number('quantity'),
        'for',
        number('mass', 'kg'),
        number('cost', '€'),
        'where',
      ]}
      foot={
        <tr>
          <th scope="row" colSpan={3}>
            all together
          </th>
          <td class="num">{significant(design.totals.mass_kg, 4)}</td>
          <td class="num">{significant(design.totals.cost_eur)}</td>
          <td />
        </tr>
      }
    >
      {design.parts.map((row) => {
        const part = parts?.get(row.id);
        return (
          <tr key={`${row.id}${row.group}`}>
            <th scope="row">
              {row.manufacturer} {row.part_number}{' '}
              <small class="muted">
                {row.family.replaceAll('_', ' ')}
                {part?.orderable === false && ', stands for parts of its class'}
              </small>
            </th>
            <td class="num nowrap">{quantityOf(row).replace(' ×', '')}</td>
            <td>{row.group ?? 'all'}</td>
            <td class="num">{significant(row.mass_kg)}</td>
            <td class="num">{significant(row.cost_eur)}</td>
            <td>
              <Links part={part} />
            </td>
          </tr>
        );
      })}
    </Table>
  );
}
