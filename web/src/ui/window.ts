// Which rows of a long list are in sight, for tables that draw only these.
import { useSignal } from '@preact/signals';

export function useWindow(rowHeight: number, rows: number, inSight: number) {
  const first = useSignal(0);
  const start = Math.max(0, Math.min(first.value, rows - inSight));
  return {
    start,
    end: Math.min(rows, start + inSight),
    above: start * rowHeight,
    below: Math.max(0, rows - start - inSight) * rowHeight,
    onScroll: (event: Event) => {
      const row = Math.floor((event.currentTarget as Element).scrollTop / rowHeight) - 4;
      first.value = Math.max(0, row - (row % 2));
    },
  };
}
