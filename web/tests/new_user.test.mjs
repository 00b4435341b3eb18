// Three tasks of somebody who is here for the first time: a design of their own, on paper; a part of
// their own; a recording that came with the page. And what is copied, noted and updated on the way.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { openPage, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

const listed = (page) => page.getByText('Proved: no kind of design').waitFor();

async function designGripper(page) {
  await page.getByText('These requirements can be searched.').waitFor();
  const texts = [
    ['Name', 'my gripper'],
    ['Note', 'for the fair'],
    ['Group', 'finger'],
    ['Actuators', '3'],
    ['Volume at rest', '20'],
    ['Expansion', '1.6'],
    ['Operating pressure', '0.8 bar'],
    ['Rise time, at most', '300 ms'],
    ['Fall time, at most', '400 ms'],
    ['Tube length', '1.2 m'],
    ['Frequency', 'every 2 s'],
    ['Actuations', '4000 s'],
  ];
  for (const [label, text] of texts) await page.getByLabel(label, { exact: true }).fill(text);
  await page.getByText('read as 0.5 Hz').waitFor();
  await page.getByText('read as 2 000 actuations').waitFor();
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  await listed(page);
}

test('a design of their own, its strokes, and its data sheet', async () => {
  const { page, close } = await openPage(browser, service.base);
  await designGripper(page);
  const id = page.url().split('/').at(-1);
  const { result } = await service.get(`/v1/designs/${id}`);
  const [first] = result.designs;
  await page.getByRole('link', { name: '1', exact: true }).first().click();
  for (const name of ['Rise of finger', 'Fall of finger'])
    await page.getByRole('figure', { name }).waitFor();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'FMU' }).click();
  assert.equal((await download).suggestedFilename(), 'my gripper-1.fmu');
  const unit = await (await download).createReadStream().then((stream) => stream.toArray());
  assert.equal(Buffer.concat(unit).subarray(30, 50).toString(), 'modelDescription.xml');
  await page.getByRole('link', { name: 'Data sheet' }).click();
  await page.getByRole('heading', { name: 'my gripper: data sheet of design 1' }).waitFor();
  await page.getByText('for the fair').waitFor();
  const bill = page.getByRole('region', { name: 'Bill of materials' });
  for (const part of first.parts) await bill.getByText(part.part_number).first().waitFor();
  const safety = page.locator('section.panel', { hasText: 'Safety' });
  await safety.getByText('Let the pressure out before you open a joint').waitFor();
  if (first.parts.some((part) => /PET bottle/.test(part.part_number)))
    await safety.getByText('A PET bottle is no pressure vessel').waitFor();
  await page.getByText('2 000 actuations at 0.5 Hz').waitFor();
  await close();
});

test('a table is copied as a spreadsheet takes it', async () => {
  const { page, close } = await openPage(browser, service.base, '#/jobs', {
    permissions: ['clipboard-read', 'clipboard-write'],
  });
  await page.getByText('for the fair').waitFor();
  const table = page.getByRole('region', { name: 'Searches' });
  await table.hover();
  await page.getByRole('button', { name: 'Copy the table: Searches' }).click();
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  const [head, row] = copied.split('\n').map((line) => line.split('\t'));
  assert.equal(head.length, row.length);
  assert.match(row[0], /^my gripper\s+for the fair$/);
  assert.ok(row.includes('least mass'));
  assert.ok(row.includes('proved'));
  await close();
});

test('what is best among products to order is listed by one button', async () => {
  const { page, close } = await openPage(browser, service.base);
  await designGripper(page);
  const before = page.url();
  await page
    .getByRole('row', { name: /products to order/ })
    .getByRole('button')
    .click();
  await page.waitForFunction((url) => location.href !== url, before);
  await listed(page);
  const { result } = await service.get(`/v1/designs/${page.url().split('/').at(-1)}`);
  assert.equal(result.requirements.supply.parts, 'orderable');
  await page.getByText('that cannot be ordered').waitFor();
  await close();
});

test('a part of their own is added, and the last search is done again with it', async () => {
  const { page, close } = await openPage(browser, service.base);
  await designGripper(page);
  await page.getByRole('link', { name: 'Catalogue' }).click();
  await page.getByRole('button', { name: 'Add a part' }).click();
  const form = page.getByRole('dialog', { name: 'Add a part: valve' });
  await form.getByRole('button', { name: 'Add the part' }).click();
  await form.getByText('is required, one of: 3/2, 2/2 pair, proportional').waitFor();
  await form.getByLabel('Function').selectOption('3/2');
  const texts = [
    ['Maker', 'Acme'],
    ['Part number', 'X1'],
    ['Port', 'M5'],
    ['Channels', '1'],
    ['Sonic conductance fill', 'Cv 0.05'],
    ['Critical ratio fill', '0.3'],
    ['Sonic conductance exhaust', '50 l/min'],
    ['Critical ratio exhaust', '0.3'],
    ['Coil power', '0.5'],
    ['Mass', '12 g'],
    ['Body volume', '8'],
    ['Pressure max', '7 bar'],
  ];
  for (const [label, text] of texts) await form.getByLabel(label, { exact: true }).fill(text);
  await form.getByRole('button', { name: 'Add the part' }).click();
  await form.getByText('one of dm3/(s·bar), L/(s·bar)').waitFor();
  assert.equal(await form.getByText('the part has no value').count(), 0);
  await form.getByLabel('Sonic conductance exhaust').fill('Qn 50 l/min');
  await form.getByRole('button', { name: 'Add the part' }).click();
  await page.getByRole('link', { name: 'Acme X1' }).waitFor();
  await page.getByRole('button', { name: 'Rank my gripper again' }).click();
  await listed(page);
  const { result } = await service.get(`/v1/designs/${page.url().split('/').at(-1)}`);
  assert.ok(result.designs[0].parts.some((part) => part.manufacturer === 'Acme'));
  await close([422]);
});

test('a shipped recording is opened and diagnosed', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  await page.getByRole('button', { name: 'Open a shipped one' }).click();
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  await page.getByText('The model lacks creep of the wall; with it, only noise is left.').waitFor();
  await close();
});

test('an update says where there is no installed catalogue', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/valve');
  await page.getByRole('button', { name: 'Update' }).click();
  await page
    .getByText(/no catalogue was installed with this program|nothing newer|Added: \d/)
    .first()
    .waitFor();
  await close([404]);
});
