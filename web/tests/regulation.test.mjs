// A regulator of each group: asked for by the form, drawn with its pressure, tried with others.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth, violationsOf } from './support.mjs';

const { service, browser } = await startBoth();

test('the form asks for a regulator of each group where there are several', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  const regulators = page.getByRole('group', { name: 'Regulators' });
  assert.equal(await regulators.count(), 0);
  await page.getByRole('button', { name: /Add a group/ }).click();
  await regulators.getByText('one a group').click();
  await page.getByText('These requirements can be searched.').waitFor();
  assert.deepEqual(await violationsOf(page), []);
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  assert.equal((await asked).postDataJSON().supply.regulation, 'per_group');
  await close();
});

test('a design shows both regulators with their pressures and can be tried', async () => {
  const request = { ...example('orthosis'), ranking: { count: 2, time_limit_s: 20 } };
  request.supply.regulation = 'per_group';
  const id = await rank(service, request);
  const { result } = await service.get(`/v1/designs/${id}`);
  const { group_pressure_kpa_gauge } = result.designs[0].settings;
  assert.equal(group_pressure_kpa_gauge.length, 2);

  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = [];
  page.on('response', (reply) => {
    if (reply.url().endsWith('/v1/simulations')) simulated.push(reply.status());
  });
  const evaluated = page.waitForResponse((reply) => reply.url().endsWith('/v1/evaluations'));
  await page.reload();
  const judged = await (await evaluated).json();
  assert.equal(judged.works, true);
  await page.getByText('Rise of dorsi').first().waitFor();
  await page.waitForLoadState('networkidle');
  assert.deepEqual(simulated.slice(0, 2), [200, 200]); // one behind each regulator
  assert.deepEqual(await violationsOf(page), []);
  if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT, fullPage: true });

  await page.getByRole('link', { name: 'Data sheet' }).click();
  const drawing = page.getByRole('img', { name: /^Schematic/ });
  await drawing.waitFor();
  const words = await drawing.innerText().catch(() => drawing.textContent());
  for (const kpa of group_pressure_kpa_gauge)
    assert.match(words, new RegExp(String(Math.round(kpa)).slice(0, 2)));
  if (process.env.SHOT)
    await page.screenshot({ path: `${process.env.SHOT}.sheet.png`, fullPage: true });
  await close();
});
