// The documents of a part: their links, the files that the service keeps, and one more.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { ask, asProblem, get, getFile } from '../lib/api';
import { partPath } from '../lib/catalogue';
import type { DocumentOfPart, Part } from '../lib/types';
import { Notice } from '../ui/controls';
import { FilePicker, saveFile } from '../ui/files';
import { ActionButton } from '../ui/job';
import { Address } from './part_details';

const bytesMost = 20 * 2 ** 20;

const sizeOf = (bytes: number): string =>
  bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;

async function keep(id: string, file: File): Promise<void> {
  if (file.size > bytesMost) throw new Error(`${file.name} has more than 20 MiB`);
  await ask('POST', `${partPath(id)}/documents?link=${encodeURIComponent(file.name)}`, {
    text: file,
    headers: { 'Content-Type': 'application/octet-stream' },
  });
}

export function PartDocuments({ part, onChanged }: { part: Part; onChanged: () => void }) {
  const listed = useSignal<DocumentOfPart[]>([]);
  const problem = useSignal('');
  const load = () =>
    get<{ documents: DocumentOfPart[] }>(`${partPath(part.id)}/documents`).then(
      ({ documents }) => (listed.value = documents),
      (error) => (problem.value = asProblem(error).sentence),
    );
  useEffect(() => void load(), [part]);
  const add = async (files: File[]) => {
    problem.value = '';
    try {
      for (const file of files) await keep(part.id, file);
    } catch (error) {
      problem.value = asProblem(error).sentence;
    }
    await load();
    onChanged();
  };
  return (
    <section aria-label="Documents">
      <h3>Documents</h3>
      <ul>
        {listed.value.map((document) => (
          <Entry key={document.link + document.sha256} document={document} />
        ))}
      </ul>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      <FilePicker label="Add a document…" accept="" multiple onFiles={(files) => void add(files)} />
    </section>
  );
}

function Entry({ document: { link, sha256, file } }: { document: DocumentOfPart }) {
  return (
    <li>
      <Address text={link} />
      {sha256 && (
        <>
          {' '}
          <code data-tip="SHA-256 of the file">{sha256.slice(0, 12)}</code>
        </>
      )}{' '}
      {file && (
        <ActionButton
          label={`Save the file, ${sizeOf(file.bytes)}`}
          act={async () => {
            const { name, content } = await getFile(file.href);
            saveFile(name, content, file.media_type);
          }}
        />
      )}
    </li>
  );
}
