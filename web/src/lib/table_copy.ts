// Tables as a spreadsheet takes them: cells between tabs, numbers that it reads as numbers.

// Of a cell what a person reads as its value: no pictures, no controls, no words for listeners only.
const aside =
  'svg, button i, input, .only-heard, [aria-hidden="true"], .swatch, .track, .swing-track';

function textOfCell(cell: HTMLTableCellElement): string {
  const copy = cell.cloneNode(true) as HTMLElement;
  for (const element of copy.querySelectorAll(aside)) element.remove();
  for (const element of copy.querySelectorAll('*')) element.after(' ');
  return plain(copy.textContent ?? '');
}

// "1 200", "−3", "2.1×10⁻⁶" and "–" as 1200, -3, 2.1e-6 and nothing.
export function plain(shown: string): string {
  const text = shown
    .replace(/\s*[\t\n]\s*/g, ' ')
    .replace(/ {2,}/g, ' ')
    .trim();
  if (text === '–') return '';
  const number = text
    .replace(/(\d)\u202f(?=\d)/g, '$1')
    .replace('−', '-')
    .replace(
      /×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/,
      (_, digits: string) =>
        `e${[...digits].map((d) => (d === '⁻' ? '-' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(d))).join('')}`,
    );
  return /^[~+-]?\d/.test(number) ? number : text;
}

const rowsOf = (table: HTMLTableElement) =>
  [...table.rows].filter((row) => row.getAttribute('aria-hidden') !== 'true');

// Of all rows, or of those that are selected, with the heads.
export function cellsOf(table: HTMLTableElement, selection?: Selection): string[][] {
  const isTaken = (row: HTMLTableRowElement) =>
    !selection || row.parentElement!.tagName === 'THEAD' || selection.containsNode(row, true);
  return rowsOf(table)
    .filter(isTaken)
    .map((row) =>
      [...row.cells].flatMap((cell) => [
        textOfCell(cell),
        ...Array<string>(Math.max(0, cell.colSpan - 1)).fill(''),
      ]),
    );
}

// Without columns of controls, which are empty in all rows.
function withoutEmptyColumns(rows: string[][]): string[][] {
  const width = Math.max(0, ...rows.map((row) => row.length));
  const used = Array.from({ length: width }, (_, i) => rows.some((row, r) => r > 0 && row[i]));
  return rows.map((row) => row.filter((_, i) => used[i]));
}

export const tabbed = (rows: string[][]): string =>
  withoutEmptyColumns(rows)
    .map((row) => row.join('\t'))
    .join('\n');

const escaped = (text: string): string =>
  text.replace(/[&<>]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[c]!);

const asHtml = (rows: string[][]): string =>
  `<table>${withoutEmptyColumns(rows)
    .map((row) => `<tr>${row.map((cell) => `<td>${escaped(cell)}</td>`).join('')}</tr>`)
    .join('')}</table>`;

// The table that a selection is inside of, if it takes more than one of its cells.
function tableOf(selection: Selection): HTMLTableElement | null {
  if (selection.isCollapsed || selection.rangeCount === 0) return null;
  const { commonAncestorContainer: node } = selection.getRangeAt(0);
  const element = node instanceof Element ? node : node.parentElement;
  if (!element || element.closest('td, th')) return null;
  return element.closest('table');
}

// Copying rows of a table puts them on the clipboard clean.
export function copyTablesClean(): void {
  addEventListener('copy', (event) => {
    const selection = document.getSelection();
    const table = selection && tableOf(selection);
    if (!table || !event.clipboardData) return;
    const rows = cellsOf(table, selection);
    event.clipboardData.setData('text/plain', tabbed(rows));
    event.clipboardData.setData('text/html', asHtml(rows));
    event.preventDefault();
  });
}

// The whole table, by way of the selection: that works without encryption, too. Whether it did.
export function copyTable(table: HTMLTableElement): boolean {
  const selection = document.getSelection()!;
  const before = Array.from({ length: selection.rangeCount }, (_, i) => selection.getRangeAt(i));
  selection.selectAllChildren(table);
  const isDone = document.execCommand('copy');
  selection.removeAllRanges();
  for (const range of before) selection.addRange(range);
  return isDone;
}
