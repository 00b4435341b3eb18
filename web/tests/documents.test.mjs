// Data sheets and recordings of a part: added with their file, and saved again byte for byte.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

import { openPage, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

test('a data sheet is added to a part and saved again', async () => {
  const id = (await service.get('/v1/parts?family=valve&limit=1')).parts[0].id;
  const bytes = Buffer.from(Array.from({ length: 5000 }, (_, i) => (i * 37) % 256));
  const hash = createHash('sha256').update(bytes).digest('hex');
  const { page, close } = await openPage(browser, service.base, `#/catalogue/valve?part=${id}`);
  const documents = page.getByRole('region', { name: 'Documents' });
  await documents.waitFor();
  await documents
    .getByLabel('Add a document…')
    .last()
    .setInputFiles({ name: 'Blatt ü 1.pdf', mimeType: 'application/pdf', buffer: bytes });
  const save = documents.getByRole('button', { name: 'Save the file, 5 kB' });
  await save.waitFor();
  const [download] = await Promise.all([page.waitForEvent('download'), save.click()]);
  assert.equal(download.suggestedFilename(), 'Blatt ü 1.pdf');
  assert.deepEqual(readFileSync(await download.path()), bytes);
  const listed = (await service.get(`/v1/parts/${id}/documents`)).documents.at(-1);
  assert.equal(listed.sha256, hash);
  assert.equal(listed.file.media_type, 'application/pdf');
  // The part that is edited is the one with the document.
  await page.getByRole('button', { name: 'Edit' }).click();
  assert.ok((await page.getByLabel(/^Documents/).inputValue()).includes(hash));
  await close();
});

test('a file that is too large is refused before it is sent', async () => {
  const id = (await service.get('/v1/parts?family=valve&limit=1')).parts[0].id;
  const { page, close } = await openPage(browser, service.base, `#/catalogue/valve?part=${id}`);
  const folder = mkdtempSync(join(tmpdir(), 'plenum-documents-'));
  after(() => rmSync(folder, { recursive: true }));
  const huge = join(folder, 'huge.pdf');
  writeFileSync(huge, Buffer.alloc(20 * 2 ** 20 + 1));
  await page.getByLabel('Add a document…').last().setInputFiles(huge);
  await page.getByText('huge.pdf has more than 20 MiB').waitFor();
  await close();
});
