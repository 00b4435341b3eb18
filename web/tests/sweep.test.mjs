// Values of one number are searched one after the other and stand in one table; a sweep is cancelled.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, startBoth, textOf, violationsOf } from './support.mjs';

const { service, browser } = await startBoth();
const idOf = (page) => /sweep\/([0-9a-f]+)/.exec(page.url())[1];
const valuesField = (page) => page.getByLabel('Values', { exact: true });
const answers = (page) => page.getByRole('region', { name: 'Answers' }).locator('tbody tr');

test('values of one number give one table', async () => {
  const { page, close } = await openPage(browser, service.base, '#/requirements');
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('link', { name: /a sweep/ }).click();
  await page.getByText('No values yet.').waitFor();
  const start = page.getByRole('button', { name: 'Start the sweep' });
  assert.ok(await start.isDisabled());
  assert.match(await page.getByLabel('Field').inputValue(), /frequency_hz$/);
  await valuesField(page).fill('0.02 0.05 100');
  await page.getByText('3 searches: 0.02, 0.05, 100').waitFor();
  assert.deepEqual(await violationsOf(page), []);
  await start.click();
  await page.getByText('All 3 searches have ended.').waitFor({ timeout: 60_000 });
  assert.equal(await answers(page).count(), 3);
  // The rows say what the service's table says, what cannot be met in words.
  const { rows } = await service.get(`/v1/sweeps/${idOf(page)}/table`);
  assert.deepEqual(
    rows.map((row) => row.outcome),
    ['optimal', 'optimal', 'infeasible'],
  );
  const said = await answers(page).last().innerText();
  assert.ok(said.includes(rows[2].conflict), said);
  assert.match(rows[2].conflict, /frequency that it sustains: 100 Hz asked/);
  assert.ok(!rows[2].conflict.includes('/'), rows[2].conflict);
  assert.deepEqual(await violationsOf(page), []);
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('button', { name: 'CSV' }).click(),
  ]);
  const csv = await textOf(download);
  assert.equal(csv.trim().split('\n').length, 4);
  assert.match(csv, /^name,status,\/duty\/frequency_hz,/);
  // A row leads to its list.
  await answers(page).first().getByRole('link').click();
  await page.getByText('Proved: no kind of design').waitFor();
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page
    .getByRole('region', { name: /sweeps/i })
    .getByRole('link')
    .first()
    .waitFor();
  await close();
});

test('steps from one value to another; what waits is cancelled', async () => {
  // Another client's long searches keep the workers.
  const slow = { ...example('exosuit'), objective: { minimize: 'volume_l' } };
  slow.ranking = { count: 100, time_limit_s: 60, list: 'combinations' };
  const jobs = await Promise.all([1, 2, 3].map(() => service.post('/v1/designs', slow)));
  const { page, close } = await openPage(browser, service.base, '#/sweep');
  await page.getByRole('button', { name: 'from – to' }).click();
  await page.getByLabel('From').fill('0.01');
  await page.getByLabel('To', { exact: true }).fill('0.05');
  await page.getByLabel('How many values').fill('20');
  await page.getByText(/^20 searches: 0.01, /).waitFor();
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.getByText('All 20 searches have ended.').waitFor();
  const { rows } = await service.get(`/v1/sweeps/${idOf(page)}/table`);
  assert.ok(rows.filter(({ status }) => status === 'cancelled').length > 10);
  for (const { links } of jobs) await fetch(service.base + links.self, { method: 'DELETE' });
  await close();
});

test('a value that cannot be is refused in words before anything begins', async () => {
  const { page, close } = await openPage(browser, service.base, '#/sweep');
  const before = (await service.get('/v1/sweeps')).sweeps.length;
  await valuesField(page).fill('0.02 -1');
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.getByText(/−1 Hz: must be/).waitFor();
  assert.equal(await valuesField(page).getAttribute('aria-invalid'), 'true');
  assert.equal((await service.get('/v1/sweeps')).sweeps.length, before);
  await close([422]);
});

test('pressures are those of the page, in its table and plot, or have their own unit', async () => {
  const { page, close } = await openPage(browser, service.base, '#/sweep');
  await page.getByRole('button', { name: 'psi', exact: true }).click();
  await page.getByLabel('Field').selectOption('/actuators/0/operating_pressure_kpa_gauge');
  await page.getByText('in psi gauge, or each with its unit').waitFor();
  await valuesField(page).fill('6 8 10');
  await page.getByText('3 searches: 6, 8, 10 psi gauge').waitFor();
  await valuesField(page).fill('6 psi, 0.5 bar');
  await page.getByText('2 searches: 6, 7.25189 psi gauge').waitFor();
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.getByText('All 2 searches have ended.').waitFor({ timeout: 60_000 });
  const { rows } = await service.get(`/v1/sweeps/${idOf(page)}/table`);
  const close_to = (value, kpa) => assert.ok(Math.abs(value - kpa) < 1e-3, `${value}`);
  close_to(rows[0].values[0], 6 * 6.894757);
  close_to(rows[1].values[0], 50);
  const region = page.getByRole('region', { name: 'Answers' });
  await region.getByRole('columnheader', { name: /operating pressure.*psi gauge/ }).waitFor();
  assert.match(await answers(page).last().innerText(), /7\.25189/);
  await page
    .getByRole('figure', { name: /over operating pressure of spa_pack, psi gauge/ })
    .waitFor();
  await close();
});

test('a number that was typed with a unit is swept as any other', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByLabel('Rise time, at most').fill('600 ms');
  await page.getByLabel('Tube length').fill('5 ft');
  await page.getByLabel('Frequency').fill('6 per minute');
  await page.getByText('read as 0.1 Hz').waitFor();
  await page.getByRole('link', { name: /a sweep/ }).click();
  const field = page.getByLabel('Field');
  for (const name of ['frequency_hz', 'tube_length_m', 'rise_time_s_max'])
    await field.locator(`option[value$="/${name}"]`).waitFor({ state: 'attached' });
  assert.match(await field.inputValue(), /frequency_hz$/);
  await field.selectOption('/actuators/0/rise_time_s_max');
  // A unit behind the last is that of all.
  await valuesField(page).fill('500 700 ms');
  await page.getByText('2 searches: 0.5, 0.7 s').waitFor();
  await valuesField(page).fill('500 ms, soon');
  await page.getByText('“soon” is no number').waitFor();
  await page.getByText('See the field that is marked.').waitFor();
  assert.equal(await valuesField(page).getAttribute('aria-invalid'), 'true');
  await valuesField(page).fill('500 psi');
  await page.getByText(/“500 psi”: .*one of s, ms/).waitFor();
  await page.getByRole('button', { name: 'from – to' }).click();
  await page.getByLabel('From').fill('400 ms');
  await page.getByLabel('To', { exact: true }).fill('0.6');
  await page.getByLabel('How many values').fill('3');
  await page.getByText('3 searches: 0.4, 0.5, 0.6 s').waitFor();
  assert.deepEqual(await violationsOf(page), []);
  await close([422]);
});
