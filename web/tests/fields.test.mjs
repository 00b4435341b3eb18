// A field that cannot be read says why, where it is, and keeps what rests on it from being done.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { openPage, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
const isFocused = (field) => field.evaluate((at) => at === document.activeElement);

test('a field that cannot be read blocks the search, with the reason, and is gone to', async () => {
  const { page, close } = await openPage(browser, service.base);
  const searches = [];
  page.on('request', (request) => {
    if (request.method() === 'POST' && request.url().endsWith('/v1/designs'))
      searches.push(request);
  });
  const canBeSearched = page.getByText('These requirements can be searched.');
  const find = page.getByRole('button', { name: 'Find the best designs' });
  await canBeSearched.waitFor();
  await page.getByText('Wall supply').click();
  await page.getByText('Ambient, numbers of parts').click();
  await page.getByText('Gait: when in the period').click();
  await page.getByRole('button', { name: 'weighted sum' }).click();
  await page.getByText("Probability of meeting everything within the parts' tolerances").click();
  const fields = page.locator('input[data-pointer][inputmode=decimal]');
  const reasonOf = (field) =>
    field.evaluate(
      (at) => document.getElementById(at.getAttribute('aria-describedby')).textContent,
    );
  const count = await fields.count();
  assert.ok(count >= 30, `${count} fields`);
  for (let i = 0; i < count; ++i) {
    const field = fields.nth(i);
    const pointer = await field.getAttribute('data-pointer');
    const was = await field.inputValue();
    const texts = [['many', /number/]];
    // A comma that may be either, with a unit and without.
    if (/(rest_volume_ml|duty.actuations)$/.test(pointer))
      texts.push(['1,500', /may be 1\.500 or 1500/]);
    for (const [text, reason] of texts) {
      await field.fill(text);
      await page.getByText('One thing has to change').waitFor();
      assert.equal(await field.getAttribute('aria-invalid'), 'true', pointer);
      assert.match(await reasonOf(field), reason, pointer);
      await find.focus();
      await page.keyboard.press('Enter');
      assert.ok(await isFocused(field), pointer);
      await field.fill(was);
      await canBeSearched.waitFor();
    }
  }
  assert.equal(searches.length, 0);

  // At once, before anything was checked; and where the field is folded away.
  await page.getByLabel('Compressors, at most').fill('two');
  await page.locator('details.panel > summary').click();
  await find.focus();
  await page.keyboard.press('Enter');
  await page.waitForFunction(
    () => document.activeElement?.dataset.pointer === '/limits/compressors_max',
  );
  assert.equal(new URL(page.url()).hash.startsWith('#/designs'), false);
  await page.getByLabel('Compressors, at most').fill('2');

  // A field with a usual value may be emptied while another number is written.
  const rise = page.getByLabel('Rise counts up to');
  await rise.fill('');
  assert.equal(await rise.inputValue(), '');
  await rise.pressSequentially('0,9');
  await canBeSearched.waitFor();
  await rise.fill('');
  await rise.blur();
  assert.equal(await rise.inputValue(), '0.95');
  // Blanks between thousands, as the page prints them.
  await page.getByLabel('Actuations').fill('12\u202f000');
  await canBeSearched.waitFor();
  await page.waitForFunction(() => {
    const text = new URLSearchParams(location.hash.split('?')[1]).get('r');
    return text && atob(text.replaceAll('-', '+').replaceAll('_', '/')).includes(':12000');
  });
  await close([422]);
});

test('what cannot be read of a part or a rig is not taken for what stood there', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/valve');
  const [part] = (await service.get('/v1/parts?family=valve&limit=1')).parts;
  await page.goto(`${service.base}/#/catalogue/valve?part=${part.id}`);
  await page.getByRole('button', { name: 'Edit' }).click();
  const ratio = page.locator('input[data-pointer^="/critical_ratio"]').first();
  await ratio.fill('a third');
  await page.getByRole('button', { name: 'Save the change' }).click();
  await page.getByText('Not saved; see the fields marked.').waitFor();
  assert.equal(await ratio.getAttribute('aria-invalid'), 'true');
  assert.ok(await isFocused(ratio));
  assert.deepEqual(await service.get(`/v1/parts/${part.id}`), part);
  await page.keyboard.press('Escape');

  await page.goto(`${service.base}/#/measured`);
  const csv = ['run,t_s,valve,pressure_kpa_gauge'];
  for (let i = 0; i < 20; ++i) csv.push(`r1,${i / 10},inflate,${i}`);
  await page
    .locator('input[type=file]')
    .last()
    .setInputFiles(file('few.csv', csv.join('\n')));
  const expansion = page.getByLabel('Expansion');
  await expansion.fill('double');
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  assert.ok(await isFocused(expansion));
  await page.getByText('a number is needed here').waitFor();
  assert.equal(page.url().includes('job='), false);
  // With a unit it is understood.
  await expansion.fill('2');
  await page.getByLabel('Volume at rest').fill('50 mL');
  await page.getByLabel('Operating pressure').fill('1 bar');
  await page.getByLabel('Conductance C of the line').fill('0.05');
  await page.getByLabel('Critical ratio b').fill('0.3');
  await page.getByLabel('Source pressure').fill('2 bar');
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  await page.waitForFunction(() => location.hash.includes('job='));
  await close([422]);
});
