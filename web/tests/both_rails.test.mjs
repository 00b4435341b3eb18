// A vacuum pump beside a pressure supply, from the form to the drawing of its design.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

test('a low pressure asks for a vacuum, by a pump or from the wall', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByText('Compressor and reservoir', { exact: true }).click();
  await page.getByLabel('Low pressure', { exact: false }).first().fill('-20');
  await page.getByRole('group', { name: 'Vacuum beside the pressure' }).waitFor();
  await page.getByLabel('Vacuum, no deeper than', { exact: false }).fill('-80');
  await page.getByText('These requirements can be searched.').waitFor();
  if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT, fullPage: true });
  await page.getByText('from the wall', { exact: true }).click();
  await page.getByLabel('Vacuum of the wall', { exact: false }).fill('-85');
  await page.getByText('a vacuum pump', { exact: true }).click();
  await page.getByText('These requirements can be searched.').waitFor();
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { actuators, supply } = (await asked).postDataJSON();
  assert.equal(actuators[0].low_pressure_kpa_gauge, -20);
  assert.deepEqual(supply.vacuum, { configurations: ['pump'] });
  await close();
});

test('a design with both rails is drawn and can be tried', async () => {
  const id = await rank(service, {
    ...example('both_rails'),
    ranking: { count: 1, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const [design] = result.designs;
  const pump = design.parts.find(({ family }) => family === 'vacuum_pump');
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  const response = await (await simulated).json();
  const listed = design.performance.groups[0].fall_time_s;
  const { fall_time_s } = response.performance.groups[0];
  assert.ok(Math.abs(fall_time_s - listed) < 1e-3 * listed, `${fall_time_s}`);
  const slider = page.getByRole('slider', { name: 'Source pressure' });
  await slider.and(page.locator(':enabled')).waitFor(); // once its range is known
  const tried = page.waitForResponse((reply) => reply.url().endsWith('/v1/evaluations'));
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  assert.equal((await (await tried).json()).works, true);
  await page.getByRole('link', { name: 'Data sheet' }).click();
  const schematic = page.getByRole('img', { name: /^Schematic/ });
  await schematic.waitFor();
  const drawn = (await schematic.textContent()).replaceAll(' ', ''); // its lines are broken
  for (const words of [pump.part_number, 'at the weakest', 'pump stops at'])
    assert.ok(drawn.includes(words.replaceAll(' ', '')), drawn);
  if (process.env.SHOT_DESIGN)
    await page.screenshot({ path: process.env.SHOT_DESIGN, fullPage: true });
  await close();
});
