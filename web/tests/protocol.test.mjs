// From what to measure first to the protocol of the part, and measured numbers into the catalogue.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { example, openPage, rank, startBoth, top } from './support.mjs';

const part = 'generic-lp-small-200kpa';
const file = (name) => ({
  name,
  mimeType: name.endsWith('.csv') ? 'text/csv' : 'application/json',
  buffer: readFileSync(join(top, 'examples', name)),
});

const { service, browser } = await startBoth();

test('what to measure first leads to its protocol', async () => {
  const id = await rank(service, example('gripper_guaranteed'));
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await page.getByRole('link', { name: 'bottle test' }).first().click();
  await page.getByText('Weigh the bottle empty and full of water').waitFor();
  await page.getByLabel('How precise a bottle test will be').first().waitFor();
  const asked = page.waitForRequest((request) => request.url().includes('sensor_noise_kpa=5'));
  await page.getByLabel('Sensor noise').fill('5');
  await asked;
  const saved = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the template' }).click();
  assert.equal((await saved).suggestedFilename(), `${part}-template.json`);
  await close();
});

test('a recording becomes a revision of the part', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  await page
    .locator('input[type=file]')
    .first()
    .setInputFiles([file('bottle_test_rig.json'), file('bottle_test_simulated.csv')]);
  await page.getByLabel('Time limit').fill('120');
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  await page.getByLabel('Piece, where you have several').fill('A');
  await page.getByRole('button', { name: `Write into ${part}` }).click({ timeout: 60_000 });
  await page.getByText(`Written into ${part}`).waitFor({ timeout: 60_000 });
  const stored = await service.get(`/v1/parts/${part}`);
  assert.equal(stored.provenance.sonic_conductance_dm3_per_s_bar.kind, 'measured');
  assert.ok(stored.documents[0].link.endsWith(', piece A'));
  assert.ok(Math.abs(stored.sonic_conductance_dm3_per_s_bar - 0.53) < 0.006);
  await close();
});
