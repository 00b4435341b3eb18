// A pump without a reservoir from the form to its design: no pressure is set, and none can be moved.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth, violationsOf } from './support.mjs';

const { service, browser } = await startBoth();

test('the form asks for a pump without a reservoir', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByText('Pump without a reservoir').click();
  await page.getByText('These requirements can be searched.').waitFor();
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { supply } = (await asked).postDataJSON();
  assert.ok(supply.configurations.includes('direct_pump'));
  await close();
});

test('a design on a pump alone can be tried', async () => {
  const id = await rank(service, {
    ...example('four_fingers'),
    ranking: { count: 3, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const design = result.designs[0];
  assert.equal(design.configuration, 'direct_pump');
  assert.equal(design.settings.reservoir_volume_ml, null);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  assert.equal((await simulated).status(), 200);
  await page.getByText('pump without a reservoir', { exact: true }).first().waitFor();
  assert.equal(await page.getByLabel('Source pressure', { exact: true }).count(), 0);
  const tried = await service.post('/v1/evaluations', {
    schema: 'evaluation/1',
    requirements: result.requirements,
    design,
  });
  assert.equal(tried.works, true);
  await close();
});

test('pumps of each actuator are asked for by the form, alone', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByText('Pump without a reservoir').click();
  await page
    .getByRole('group', { name: 'Pumps without a reservoir' })
    .getByText('for each actuator')
    .click();
  await page.getByText('These requirements can be searched.').waitFor();
  assert.deepEqual(await violationsOf(page), []);
  if (process.env.SHOT) await page.screenshot({ path: `${process.env.SHOT}.form.png` });
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { supply } = (await asked).postDataJSON();
  assert.deepEqual(supply.configurations, ['direct_pump']);
  assert.equal(supply.pumps, 'per_actuator');
  await close();
});

test('pumps that run on while actuators hold are asked for by the form, alone', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByText('Pump without a reservoir').click();
  await page.getByText('Pumps run on while actuators hold').click();
  await page.getByText('These requirements can be searched.').waitFor();
  assert.deepEqual(await violationsOf(page), []);
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { supply } = (await asked).postDataJSON();
  assert.deepEqual(supply.configurations, ['direct_pump']);
  assert.equal(supply.hold_on, true);
  await close();
});

test('a kit of pumps and vent valves can be tried and drawn', async () => {
  const id = await rank(service, {
    ...example('finger_kit'),
    ranking: { count: 3, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const pumps = result.designs[0].parts.find(({ family }) => family === 'compressor');
  assert.equal(pumps.quantity % 4, 0);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  const reply = await simulated;
  assert.equal(reply.status(), 200);
  const sent = reply.request().postDataJSON();
  assert.equal(sent.source.count, pumps.quantity / 4); // of one finger
  assert.equal(sent.actuators[0].count, 1);
  const { performance } = await reply.json();
  const listed = result.designs[0].performance.groups[0].rise_time_s;
  assert.ok(Math.abs(performance.groups[0].rise_time_s - listed) < 1e-3 * listed);
  await page.getByRole('link', { name: 'Data sheet' }).click();
  await page.getByRole('img', { name: /^Schematic/ }).waitFor();
  if (process.env.SHOT)
    await page.screenshot({ path: `${process.env.SHOT}.sheet.png`, fullPage: true });
  await close();
});
