// What users come for: rank designs and browse them, add a part and see the ranking change, diagnose
// a measurement and rank with the revision.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { makeMeasurement, standIn, toCsv } from './fixture.mjs';
import { example, openPage, rank, startBrowser, startService } from './support.mjs';

let service, browser;
before(async () => {
  [service, browser] = await Promise.all([startService(), startBrowser()]);
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
const rows = (page) =>
  page.getByRole('region', { name: 'Ranked designs' }).locator('tbody tr:not(.spacer)');

test('requirements are posted and the list is browsed', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('button', { name: 'gripper' }).click();
  await page.getByLabel('Rise time, at most').fill('0.2');
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  await page.getByText('Proved: no other combination').waitFor();
  assert.match(page.url(), /#\/designs\/[0-9a-f]+$/);
  const listed = await service.get(`/v1/designs/${page.url().split('/').at(-1)}`);
  assert.equal(listed.result.requirements.actuators[0].rise_time_s_max, 0.2);
  assert.equal(await rows(page).count(), listed.result.designs.length);

  // Sorting is in the address, and the order is that of the numbers.
  await page.getByRole('columnheader', { name: 'fall' }).getByRole('button').click();
  assert.match(page.url(), /sort=fall/);
  const first = Number(await rows(page).first().getByRole('rowheader').innerText());
  const least = Math.min(...listed.result.designs.map((d) => d.performance.groups[0].fall_time_s));
  assert.equal(listed.result.designs[first - 1].performance.groups[0].fall_time_s, least);

  // A brush by keyboard filters table and title, and survives a reload.
  await page.getByRole('slider', { name: /Filter by mass/ }).focus();
  for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowDown');
  await page.getByRole('heading', { name: /\d+ of 20 designs/ }).waitFor();
  const left = await rows(page).count();
  assert.ok(left > 0 && left < 20);
  await page.waitForTimeout(300); // the address follows at most five times a second
  await page.reload();
  await page.getByRole('heading', { name: `${left} of 20 designs` }).waitFor();
  await page.getByRole('button', { name: 'Show all' }).click();
  await page.getByRole('heading', { name: '20 designs', exact: true }).waitFor();

  // One design; its simulation agrees with its ranking.
  await rows(page).first().getByRole('link').click();
  const times = page.locator('table.times tbody tr').first().locator('td');
  await times.first().waitFor();
  const design = listed.result.designs[first - 1];
  const shown = (await times.allInnerTexts()).map(Number);
  assert.ok(
    Math.abs(shown[0] / design.performance.groups[0].rise_time_s - 1) < 0.01,
    `rise ${shown[0]}`,
  );
  assert.ok(
    Math.abs(shown[1] / design.performance.groups[0].fall_time_s - 1) < 0.01,
    `fall ${shown[1]}`,
  );
  await page.getByRole('slider', { name: 'Source pressure' }).focus();
  for (let i = 0; i < 20; ++i) await page.keyboard.press('ArrowRight');
  await page.getByText('Simulated in').waitFor();
  await page
    .getByText(/−\d.* %/)
    .first()
    .waitFor(); // it rises faster
  await page.getByRole('img', { name: /^Mass:/ }).waitFor();
  await page.getByText('Rise time × C·P₀/V₀').waitFor();
  await page.getByRole('rowheader', { name: 'operating pressure' }).waitFor();

  // Two compared.
  await page.goBack();
  await page.getByLabel('Compare design 1', { exact: true }).check();
  await page.getByLabel('Compare design 2', { exact: true }).check();
  await page.getByRole('button', { name: 'Compare 2' }).click();
  await page.getByText('difference to #1').waitFor();
  await page.getByText('Pressure of finger').waitFor();
  await close();
});

test('a search is followed and cancelled', async () => {
  const slow = { ...example('crawler'), ranking: { count: 20, time_limit_s: 60 } };
  const { id } = await service.post('/v1/designs', slow);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await page.getByText('best so far').first().waitFor();
  await page.getByText('The proof closing').waitFor();
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.getByText('Cancelled before the proof was complete').waitFor();
  await page.getByRole('link', { name: 'Searches' }).click();
  await page
    .getByRole('row', { name: /crawler/ })
    .getByText('cancelled')
    .waitFor();
  await close();
});

test('a part is added and the ranking changes', async () => {
  const first = await rank(service, example('exosuit'));
  const old = await service.get(`/v1/designs/${first}`);
  const pack = old.result.designs[0].parts.find((part) => part.family === 'battery');
  const { page, close } = await openPage(browser, service.base, `#/designs/${first}`);
  await rows(page).first().waitFor();

  await page.getByRole('link', { name: 'Catalogue' }).click();
  await page.getByRole('link', { name: /^battery/ }).click();
  await page.goto(`${service.base}/#/catalogue/battery?part=${pack.id}`);
  await page.getByRole('button', { name: 'Copy', exact: true }).click();
  await page.getByLabel('Part number').fill('half as heavy');
  await page.getByLabel('mass', { exact: true }).fill(String((pack.mass_kg / 2).toFixed(4)));
  await page.getByRole('button', { name: 'Add the part' }).click();
  await page.getByRole('heading', { name: /battery: \d+ parts/ }).waitFor();
  await page.getByRole('checkbox', { name: /^user/ }).check();
  await page.getByRole('heading', { name: /battery: 1 of \d+ parts/ }).waitFor();

  await page.getByRole('link', { name: 'Designs' }).click();
  await page.getByRole('button', { name: 'Rank again' }).click();
  await page.getByText('Catalogue revision 2.').waitFor();
  await page.getByLabel('Before').selectOption(first);
  await page.getByText(/\d+ new, \d+ no longer listed/).waitFor();
  const now = await service.get(`/v1/designs/${/designs\/([0-9a-f]+)/.exec(page.url())[1]}`);
  assert.ok(now.result.designs[0].totals.mass_kg < old.result.designs[0].totals.mass_kg);
  await rows(page).first().getByText('new').waitFor();

  // Undone in the history.
  await page.getByRole('link', { name: 'Catalogue' }).click();
  await page.getByRole('button', { name: 'History' }).click();
  await page.getByRole('button', { name: 'Undo revision 2' }).click();
  await page.getByRole('button', { name: 'Undo revision 3' }).waitFor();
  await close();
});

test('a measurement is diagnosed and the revision ranks', async () => {
  const measurement = await makeMeasurement(service);
  const before = await rank(service, example('gripper'));
  const { page, close } = await openPage(browser, service.base, `#/designs/${before}`);
  await rows(page).first().waitFor();
  await page.getByRole('button', { name: 'Requirements', exact: true }).click();
  await page.getByRole('link', { name: 'Measured data' }).click();
  await page
    .locator('input[type=file]')
    .setInputFiles(file('bench.json', JSON.stringify(measurement)));
  await page.getByText('Measured pressure').waitFor();
  await page.getByRole('button', { name: 'r2' }).click();
  await page.getByRole('heading', { name: 'Run r2, blocked' }).waitFor();
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  await page.getByText('The model lacks creep').waitFor();
  await page.getByText('Measured against model').waitFor();
  await page.getByText('Residual: measured less model').waitFor();
  await page
    .getByRole('region', { name: 'Candidate models' })
    .getByText('creep of the wall', { exact: true })
    .waitFor();
  await page.getByLabel('Name').fill('bench-creep');
  await page.getByRole('button', { name: 'Save the revision' }).click();
  await page.getByRole('button', { name: 'Rank gripper with bench-creep' }).click();
  await page.getByText(/Against the nominal model: \d+ new, \d+ no longer listed/).waitFor();
  await page.getByText('model bench-creep').waitFor();
  const id = /designs\/([0-9a-f]+)/.exec(page.url())[1];
  const { result } = await service.get(`/v1/designs/${id}`);
  assert.equal(result.model.name, 'bench-creep');
  const { fraction, time_constant_s } = result.model.effects[0].parameters;
  assert.ok(Math.abs(fraction - 0.15) < 0.005, `${fraction}`);
  assert.ok(Math.abs(time_constant_s - 2) < 0.1, `${time_constant_s}`);
  await close();
});

test('a tie names the experiment that would tell', async () => {
  const measurement = await makeMeasurement(service);
  const { page, close } = await openPage(browser, service.base, '#/measured', {
    before: (p) => standIn(p, service, 'tie'),
  });
  await page.locator('input[type=file]').setInputFiles(file('bench.csv', toCsv(measurement)));
  await page.getByRole('heading', { name: 'The rig it was measured on' }).waitFor();
  await page.getByLabel('Source pressure').fill('200');
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  await page.getByText('With a blocked actuator a leak goes on').waitFor();
  await page.getByText('tied').first().waitFor();
  assert.equal(await page.getByRole('button', { name: 'Save the revision' }).count(), 0);
  await close();
});
