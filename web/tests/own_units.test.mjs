// What is typed in units of one's own outside of the requirements: shares in percent, the curve of a
// pump; and what the page says in the units that it shows.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { openPage, rank, startBoth, preset, violationsOf } from './support.mjs';

const { service, browser } = await startBoth();

const inPsi = (page) => page.getByRole('button', { name: 'psi', exact: true }).click();

test('shares are taken in percent', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByLabel('Rise counts up to').fill('90 %');
  await page.getByText('read as 0.9').waitFor();
  await page.getByText('These requirements can be searched.').waitFor();
  await page.waitForFunction(() => {
    const text = new URLSearchParams(location.hash.split('?')[1]).get('r');
    return text && atob(text.replaceAll('-', '+').replaceAll('_', '/')).includes('n":0.9}');
  });
  // A number of things is none: the service, which reads a time there, says so at the field.
  const actuations = page.getByLabel('Actuations', { exact: true });
  await actuations.fill('90 %');
  await actuations.and(page.locator('[aria-invalid="true"]')).waitFor();
  await page.getByText('or for how long, as "2 h", not "90 %"').first().waitFor();

  await page.goto(`${service.base}/#/measured`);
  const csv = ['run,t_s,valve,pressure_kpa_gauge'];
  for (let i = 0; i < 20; ++i) csv.push(`r1,${i / 10},inflate,${i}`);
  await page
    .locator('input[type=file]')
    .last()
    .setInputFiles({ name: 'few.csv', mimeType: 'text/csv', buffer: Buffer.from(csv.join('\n')) });
  await page.getByLabel('C uncertain by').fill('5 %');
  await page.getByText('read as 0.05').waitFor();
  assert.equal(await page.getByLabel('C uncertain by').getAttribute('aria-invalid'), null);
  await close([422]);
});

const numbers = [
  ['Maker', 'Acme'],
  ['Part number', 'P1'],
  ['Duty max', '100 %'],
];

test('the curve of a pump is given in the units of the page, or with units', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/compressor');
  await inPsi(page);
  await page.getByRole('button', { name: 'Add a part' }).click();
  const form = page.getByRole('dialog', { name: 'Add a part: compressor' });
  for (const [label, text] of numbers) {
    await form
      .getByLabel(new RegExp(`^${label}`))
      .first()
      .fill(text);
  }
  await form.getByText('read as 1').waitFor();
  const curve = form.getByLabel(
    'Curve: pressure in psi gauge, free air in L/min ANR, current in A',
  );
  const add = form.getByRole('button', { name: 'Add the part' });
  await curve.fill('10 3\n15 2');
  await add.click();
  await form.getByText('line 1 lacks the current: each needs').waitFor();
  assert.equal(await curve.getAttribute('aria-invalid'), 'true');
  await curve.fill('0 12 0.4\n0.6 bar, 3 L/min, 550 mA\n15 0 0.9');
  const [sent] = await Promise.all([
    page.waitForRequest((request) => request.method() === 'POST'),
    add.click(),
  ]);
  const { curve: points, duty_max } = sent.postDataJSON();
  assert.equal(duty_max, 1);
  assert.deepEqual(points[1], {
    pressure_kpa_gauge: '0.6 bar',
    free_air_l_per_min: '3 L/min',
    current_a: '550 mA',
  });
  assert.ok(Math.abs(points[2].pressure_kpa_gauge - 103.4214) < 1e-3);
  await form.getByText('Not saved; see the fields marked.').waitFor();
  assert.equal(await form.getByText('/curve').count(), 0);
  assert.equal(await curve.getAttribute('aria-invalid'), null);
  await curve.fill('0 12 0.4\n3 parsec, 3, 0.5');
  await add.click();
  await form.getByText(/line 2: the pressure .*psi/).waitFor();
  assert.deepEqual(await violationsOf(page), []);
  await page.keyboard.press('Escape');
  await close([422]);
});

test('sentences on a design name pressures as the page does', async () => {
  const id = await rank(service, preset('exosuit'));
  const { result } = await service.get(`/v1/designs/${id}`);
  const { source_pressure_kpa_gauge } = result.designs[0].settings;
  // As the service says of a design that is turned up too far.
  const detail =
    'the source pressure of 85.27 kPa gauge is above the range that works, 60 to 80 kPa gauge';
  const before = (page) =>
    page.route('**/v1/evaluations', (route) => {
      const { settings } = route.request().postDataJSON().design;
      return settings.source_pressure_kpa_gauge > 1.05 * source_pressure_kpa_gauge
        ? route.fulfill({
            json: { works: false, detail, source_pressure_range_kpa_gauge: [60, 80] },
          })
        : route.continue();
    });
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`, { before });
  await inPsi(page);
  const rows = page.getByRole('region', { name: 'Sensitivities' });
  const said =
    'source pressure of 12.37 psi gauge is above the range that works, 8.702 to 11.6 psi';
  await rows.getByText(said).waitFor();
  assert.ok(!(await rows.innerText()).includes('kPa'));
  await close();
});
