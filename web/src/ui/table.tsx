// Tables: heads with units, heads that sort, and long tables of which only the rows in sight are
// drawn.
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useRef } from 'preact/hooks';

import { pageScale } from '../lib/page_scale';
import { copyTable } from '../lib/table_copy';
import { Scroll } from './scroll';

export interface Head {
  text: string;
  unit?: string;
  isNumber?: boolean;
  isHeard?: boolean; // not seen
  isExtra?: boolean; // left out where there is little room; its cells carry the class "extra"
}

export const number = (text: string, unit?: string): Head => ({ text, unit, isNumber: true });
export const heard = (text: string): Head => ({ text, isHeard: true });
export const extra = (head: Head): Head => ({ ...head, isExtra: true });

const classOf = (head: Head) => `${head.isNumber ? 'num' : ''} ${head.isExtra ? 'extra' : ''}`;

export function Table(props: {
  label: string;
  heads: (string | Head)[];
  class?: string; // of the table
  boxClass?: string;
  foot?: ComponentChildren;
  children: ComponentChildren; // the rows
}) {
  const table = useRef<HTMLTableElement>(null);
  return (
    <Scroll
      label={props.label}
      class={props.boxClass}
      aside={<CopyButton of={table} label={props.label} />}
    >
      <table ref={table} class={props.class}>
        <thead>
          <tr>
            {props.heads.map((given) => {
              const head = typeof given === 'string' ? { text: given } : given;
              return (
                <th key={head.text} scope="col" class={classOf(head)}>
                  {head.isHeard ? <span class="only-heard">{head.text}</span> : head.text}
                  {head.unit && <small> {head.unit}</small>}
                </th>
              );
            })}
          </tr>
        </thead>
        <tbody>{props.children}</tbody>
        {props.foot && <tfoot>{props.foot}</tfoot>}
      </table>
    </Scroll>
  );
}

// The whole table to the clipboard, for a spreadsheet. Seen where the pointer or the keyboard is.
function CopyButton({ of, label }: { of: { current: HTMLTableElement | null }; label: string }) {
  const said = useSignal('Copy');
  const copy = () => {
    said.value = copyTable(of.current!) ? 'Copied' : 'Not allowed';
    setTimeout(() => (said.value = 'Copy'), 2000);
  };
  return (
    <button type="button" class="small copy" aria-label={`Copy the table: ${label}`} onClick={copy}>
      <span role="status">{said.value}</span>
    </button>
  );
}

// `sort` is the name of the column that rows are sorted by, with a minus for the other way round.
export function SortHead(props: {
  name: string;
  head: Head;
  sort: string;
  tip?: string;
  onSort: (sort: string) => void;
}) {
  const { name, head, sort } = props;
  const [up, down] = [sort === name, sort === `-${name}`];
  return (
    <th
      scope="col"
      class={classOf(head)}
      aria-sort={up ? 'ascending' : down ? 'descending' : 'none'}
    >
      <button
        type="button"
        data-tip={props.tip}
        onClick={() => props.onSort(up ? `-${name}` : name)}
      >
        {head.text}
        {head.unit && <small> {head.unit}</small>}
        <i>{up ? '▲' : down ? '▼' : ''}</i>
      </button>
    </th>
  );
}

const rowsAbove = 4; // of those in sight, drawn ahead

export function LongTable<Row>(props: {
  label: string;
  class: string; // of the box
  rowHeight: number;
  inSight: number;
  rows: Row[];
  head: ComponentChildren;
  row: (row: Row, index: number) => ComponentChildren; // a <tr> with aria-rowindex
}) {
  const { rows, inSight } = props;
  const rowHeight = Math.round(props.rowHeight * pageScale.value);
  const first = useSignal(0);
  const start = Math.max(0, Math.min(first.value, rows.length - inSight));
  const below = rows.length - start - inSight;
  const spacer = (count: number) =>
    count > 0 && (
      <tr aria-hidden="true" class="spacer" style={{ height: `${count * rowHeight}px` }} />
    );
  return (
    <Scroll
      label={props.label}
      class={props.class}
      onScroll={(event) => {
        const top = (event.currentTarget as Element).scrollTop;
        const row = Math.floor(top / rowHeight) - rowsAbove;
        first.value = Math.max(0, row - (row % 2));
      }}
    >
      <table aria-rowcount={rows.length + 1} style={{ '--row-height': `${rowHeight}px` }}>
        <thead>
          <tr>{props.head}</tr>
        </thead>
        <tbody>
          {spacer(start)}
          {rows.slice(start, start + inSight).map((row, i) => props.row(row, start + i))}
          {spacer(below)}
        </tbody>
      </table>
    </Scroll>
  );
}
