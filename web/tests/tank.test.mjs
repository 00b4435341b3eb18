// A tank from the form to its design: the limit of its fill is asked, and the fill is shown.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

test('the form asks for a tank, with its highest fill', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  const fill = page.getByLabel('Tank filled to, at most');
  assert.equal(await fill.count(), 0);
  await page.getByText('Tank filled beforehand', { exact: true }).click();
  await fill.fill('700');
  await page.getByText('These requirements can be searched.').waitFor();
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { supply } = (await asked).postDataJSON();
  assert.ok(supply.configurations.includes('tank'));
  assert.equal(supply.tank_fill_kpa_gauge_max, 700);
  await close();
});

test('a design on a tank shows its fill and can be tried', async () => {
  const id = await rank(service, {
    ...example('tank_arm'),
    ranking: { count: 3, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const design = result.designs[0];
  assert.equal(design.configuration, 'tank');
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  assert.equal((await simulated).status(), 200);
  await page.getByText('tank fill', { exact: true }).first().waitFor();
  assert.match(
    await page.locator('body').innerText(),
    new RegExp(`\\b${Math.round(design.settings.tank_fill_kpa_gauge)}`),
  );
  const tried = await service.post('/v1/evaluations', {
    schema: 'evaluation/1',
    requirements: result.requirements,
    design,
  });
  assert.equal(tried.works, true);
  await close();
});

test('a tank with a pump is asked for, and its design says when the pump runs', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByText('Tank filled beforehand, with a pump').click();
  await page.getByLabel('Tank filled to, at most').fill('700');
  await page.getByText('These requirements can be searched.').waitFor();
  await close();
  const id = await rank(service, {
    ...example('refilled_arm'),
    ranking: { count: 3, time_limit_s: 60 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const design = result.designs[0];
  assert.equal(design.configuration, 'tank_and_pump');
  const shown = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = shown.page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await shown.page.reload();
  assert.equal((await simulated).status(), 200);
  await shown.page.getByText('pump stops', { exact: true }).first().waitFor();
  if (process.env.SHOT) await shown.page.screenshot({ path: process.env.SHOT, fullPage: true });
  await shown.close();
});
