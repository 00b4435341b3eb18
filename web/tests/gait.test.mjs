// A gait from the form to the response of a design, each squad with its own trace.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

test('the form asks for phases, one number or one an actuator', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByText('Gait: when in the period').first().click();
  const phase = page.getByLabel('Phase', { exact: true }).first();
  await phase.fill('0, 0.5');
  await page
    .getByText(/must be one number or one for each of/)
    .first()
    .waitFor();
  await page.getByLabel('Actuators', { exact: true }).first().fill('2');
  await page.getByText('These requirements can be searched.').waitFor();
  assert.equal(await phase.inputValue(), '0, 0.5');
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { actuators } = (await asked).postDataJSON();
  assert.deepEqual(actuators[0].phase, [0, 0.5]);
  await close([422]);
});

test('a design of a gait is simulated as it was ranked', async () => {
  const id = await rank(service, {
    ...example('walking_gait'),
    ranking: { count: 1, time_limit_s: 30 },
  });
  const { result } = await service.get(`/v1/designs/${id}`);
  const [design] = result.designs;
  assert.deepEqual(
    design.response.groups.map(({ phase }) => phase),
    [0, 0.25, 0.5, 0.75],
  );
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  const reply = await simulated;
  assert.equal(reply.status(), 200);
  const asked = reply.request().postDataJSON();
  assert.equal(asked.actuators.length, 4);
  assert.equal(asked.actuators[1].name, 'legs, phase 0.25');
  const begins = asked.actuators.map(({ valve }) => valve[0].t_s);
  const period = 1 / result.requirements.duty.frequency_hz;
  begins.forEach((t, i) => assert.ok(Math.abs(t - 0.25 * i * period) < 1e-9));
  await close();
});
