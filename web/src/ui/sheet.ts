// The first sheet of an .xlsx file as CSV. The library is loaded when the first file is opened; its
// form without workers is the one that the service's policy allows.
import { csv } from './files';

export const isWorkbook = (file: File): boolean => /\.xlsx$/i.test(file.name);

export async function csvOf(file: File): Promise<string> {
  const { readSheet } = await import('read-excel-file/universal');
  const rows = await readSheet(file);
  return csv(
    rows.map((row) =>
      row.map((cell) => (cell instanceof Date ? cell.toISOString().slice(0, 10) : cell)),
    ),
  );
}
