// Evacuated actuators from the form to their design.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

test('a pressure below ambient asks for a vacuum', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  // Each step can be searched: without a limit above, and rigid, which both sides know.
  await page.getByLabel('Pressure, at most', { exact: false }).first().fill('');
  await page.getByLabel('Expansion', { exact: false }).fill('1');
  await page.getByLabel('Operating pressure', { exact: false }).first().fill('-40');
  await page.getByLabel('Contraction', { exact: false }).fill('0.8');
  await page.getByLabel('Vacuum, no deeper than', { exact: false }).fill('-80');
  await page.getByText('These requirements can be searched.').waitFor();
  assert.equal(await page.getByText('Wall supply').isVisible(), false);
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { actuators, supply } = (await asked).postDataJSON();
  assert.equal(actuators[0].operating_pressure_kpa_gauge, -40);
  assert.equal(supply.vacuum.vacuum_kpa_gauge_min, -80);
  await close();
});

test('the wall may give the vacuum, and its design can be tried', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByLabel('Pressure, at most', { exact: false }).first().fill('');
  await page.getByLabel('Expansion', { exact: false }).fill('1');
  await page.getByLabel('Operating pressure', { exact: false }).first().fill('-40');
  await page.getByText('Vacuum from the wall', { exact: true }).click();
  await page.getByText('Vacuum pump', { exact: true }).click();
  await page.getByLabel('Vacuum of the wall', { exact: false }).fill('-85');
  await page.getByText('These requirements can be searched.').waitFor();
  if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT, fullPage: true });
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { supply } = (await asked).postDataJSON();
  assert.deepEqual(supply.vacuum, {
    configurations: ['mains'],
    mains: { pressure_kpa_gauge: -85 },
  });
  await close();

  const bag = example('jamming_gripper');
  bag.supply.vacuum = supply.vacuum;
  const id = await rank(service, { ...bag, ranking: { count: 1, time_limit_s: 30 } });
  const { result } = await service.get(`/v1/designs/${id}`);
  assert.equal(result.designs[0].configuration, 'mains');
  const design = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = design.page.waitForResponse((r) => r.url().endsWith('/v1/simulations'));
  await design.page.reload();
  const response = await (await simulated).json();
  const listed = result.designs[0].performance.groups[0].rise_time_s;
  const { rise_time_s } = response.performance.groups[0];
  assert.ok(Math.abs(rise_time_s - listed) < 1e-3 * listed);
  await design.close();
});

test('ejectors take the compressed air that the form states', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByLabel('Pressure, at most', { exact: false }).first().fill('');
  await page.getByLabel('Expansion', { exact: false }).fill('1');
  await page.getByLabel('Operating pressure', { exact: false }).first().fill('-40');
  await page.getByText("Ejector on the wall's compressed air", { exact: true }).click();
  await page.getByText('Vacuum pump', { exact: true }).click();
  await page.getByLabel('Wall flow, at most', { exact: false }).fill('80');
  await page.getByText('These requirements can be searched.').waitFor();
  if (process.env.SHOT_EJECTOR)
    await page.screenshot({ path: process.env.SHOT_EJECTOR, fullPage: true });
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { supply } = (await asked).postDataJSON();
  assert.deepEqual(supply.vacuum, { configurations: ['ejector'] });
  assert.equal(supply.mains.flow_l_per_min_anr_max, 80);
  await close();

  const id = await rank(service, {
    ...example('ejector_gripper'),
    ranking: { count: 4, per_source: 20, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const kinds = new Set(result.designs.map((d) => d.configuration));
  assert.ok(kinds.has('ejector') && kinds.has('direct_ejector'), [...kinds].join());
  for (const configuration of ['ejector', 'direct_ejector']) {
    const index = result.designs.findIndex((d) => d.configuration === configuration);
    const design = await openPage(browser, service.base, `#/designs/${id}/${index + 1}`);
    const simulated = design.page.waitForResponse((r) => r.url().endsWith('/v1/simulations'));
    await design.page.reload();
    const response = await (await simulated).json();
    const listed = result.designs[index].performance.groups[0].rise_time_s;
    const { rise_time_s } = response.performance.groups[0];
    assert.ok(Math.abs(rise_time_s - listed) < 2e-3 * listed, `${configuration} ${rise_time_s}`);
    if (process.env.SHOT_EJECTOR)
      await design.page.screenshot({
        path: process.env.SHOT_EJECTOR.replace('.png', `_${configuration}.png`),
        fullPage: true,
      });
    await design.close();
  }
});

test('an evacuated design can be tried', async () => {
  const id = await rank(service, {
    ...example('jamming_gripper'),
    ranking: { count: 3, per_source: 20, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const index = result.designs.findIndex((d) => d.configuration === 'vacuum_pump');
  const design = result.designs[index];
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/${index + 1}`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  const response = await (await simulated).json();
  assert.equal(response.status, 'done');
  const lowest = Math.min(...response.groups[0].pressure_kpa_gauge);
  assert.ok(Math.abs(lowest + 60) < 1, `${lowest}`);
  // Deeper than it is set: the pump's end.
  const slider = page.getByLabel('Source pressure', { exact: true });
  await slider.waitFor();
  const tried = page.waitForResponse((reply) => reply.url().endsWith('/v1/evaluations'));
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  assert.equal((await (await tried).json()).works, true);
  assert.equal(design.settings.vacuum_kpa_gauge, design.settings.source_pressure_kpa_gauge);
  await close();
});
