// Recordings as instruments write them: what was read is shown, put right by hand, and marked.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { openPage, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

const table = (name, text, encoding = 'utf8') => ({
  name,
  mimeType: 'text/csv',
  buffer: Buffer.from(text, encoding),
});
const openFile = async (page, file) => page.locator('input[type=file]').last().setInputFiles(file);
const cell = (page, heading, index) =>
  page
    .getByRole('row', { name: new RegExp(`^${heading}`) })
    .getByRole('cell')
    .nth(index);

const bar = [0, 0.001, 0.31, 0.58, 0.82, 0.95, 1.0, 0.99, 0.42, 0.12, 0.03, 0.001];
const rows = (row) => bar.map((p, i) => row(i * 10, p)).join('\n');
const comma = (number) => String(number).replace('.', ',');

test('a recording in a dialect is read, and its open unit asked for', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  const text = `Zeit;Druck [bar];Ventil µ\n${rows(
    (ms, p) => `${ms};${comma(p)};${ms > 0 && ms < 60 ? 1 : 0}`,
  )}\n`;
  await openFile(page, table('bench.csv', text, 'latin1'));
  await page.getByRole('heading', { name: 'What was read in bench.csv' }).waitFor();
  await page.getByText('in which unit is it?').waitFor();
  assert.equal(await page.getByRole('button', { name: 'Find what the model lacks' }).count(), 0);
  await page.getByRole('button', { name: 't_s [ms]' }).click();
  await page.getByRole('heading', { name: 'The rig it was measured on' }).waitFor();
  await page.getByText(/on is inflate, off is deflate/).waitFor();
  await page.getByText('1 run, 12 samples').waitFor();
  assert.equal(await cell(page, 'Druck', 1).locator('select').inputValue(), 'pressure_kpa_gauge');
  // A field is changed by hand: without a pressure the measurement is no more complete.
  await page.getByLabel('Unit of Druck [bar]').fill('psi gauge');
  await page.getByLabel('Unit of Druck [bar]').press('Tab');
  await page.waitForFunction(() => document.body.innerText.includes('1 run, 12 samples'));
  await close();
});

test('a valve without a column is marked on the curve', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  await openFile(page, table('scope.csv', `t [ms],p [bar]\n${rows((ms, p) => `${ms},${p}`)}\n`));
  await page.getByText('The file does not say what the valve did').waitFor();
  await page.getByRole('button', { name: 'Mark as the curve suggests' }).click();
  assert.equal(await page.locator('.valve-marks li').count(), 2);
  assert.equal(await page.getByLabel('Instant 1, s').inputValue(), '0.01');
  await page.getByRole('button', { name: 'hold', exact: true }).click();
  const plot = await page.locator('.plot .u-over').boundingBox();
  await page.mouse.click(plot.x + plot.width / 2, plot.y + plot.height / 2);
  await page.waitForFunction(() => document.querySelectorAll('.valve-marks li').length === 3);
  await page.getByRole('button', { name: /^Remove hold/ }).click();
  await page.waitForFunction(() => document.querySelectorAll('.valve-marks li').length === 2);
  await close();
});

test('what is wrong in a file names its line', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  await openFile(page, table('bad.csv', 't [s],p [bar],valve\n0,0,hold\n1,O.5,hold\n'));
  await page.getByText('line 3, p [bar]: must be a number').waitFor();
  await close([422]);
});

test('runs of a CSV have a source pressure each, or one for all', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  const run = (name) => rows((ms, p) => `${name},${ms},${p},${ms > 0 && ms < 60 ? 1 : 0}`);
  await openFile(
    page,
    table('two.csv', `run,t [ms],p [bar],valve\n${run('low')}\n${run('high')}\n`),
  );
  await page.getByRole('heading', { name: 'The rig it was measured on' }).waitFor();
  const all = page.getByLabel('Source pressure', { exact: true });
  const ofHigh = page.getByLabel('Source in high');
  const put = async (field, value) => {
    await field.fill(value);
    await field.press('Tab');
  };
  await put(all, '150');
  await page.getByText('Another source pressure in some runs').click();
  assert.equal(await ofHigh.inputValue(), '150');
  await put(ofHigh, '2 bar');
  await page.waitForFunction(() => document.body.innerText.includes('Another source pressure'));
  assert.equal(await page.getByLabel('Source in low').inputValue(), '150');
  assert.equal(await all.inputValue(), '');
  for (const [label, value] of [
    ['Volume at rest', '50'],
    ['Expansion', '1'],
    ['Operating pressure', '100'],
    ['Conductance C of the line', '0.05'],
    ['Critical ratio b', '0.3'],
  ])
    await put(page.getByLabel(label), value);
  const asked = page.waitForRequest(
    (r) => r.method() === 'POST' && r.url().includes('/v1/diagnos'),
  );
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  const sent = (await asked).postDataJSON();
  const runs = (sent.measurement ?? sent).runs;
  assert.deepEqual(
    runs.map((r) => r.source_pressure_kpa_gauge),
    [150, '2 bar'],
  );
  await close();
});
