// A double-acting cylinder from the form to its design: two chambers with a valve each.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, rank, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

test('the form asks for a cylinder that acts both ways', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByLabel('Volume by').first().selectOption('cylinder');
  await page.getByLabel('Acting').selectOption('double');
  await page.getByLabel('Rod', { exact: true }).fill('5');
  await page.getByText('on the side of the rod').waitFor();
  const asked = page.waitForRequest(
    (request) => request.method() === 'POST' && request.url().endsWith('/v1/designs'),
  );
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const { cylinder } = (await asked).postDataJSON().actuators[0];
  assert.equal(cylinder.acting, 'double');
  assert.equal(cylinder.rod_mm, 5);
  await close();
});

test('a design shows both sides, with their peaks, and can be tried', async () => {
  const id = await rank(service, example('double_acting_lift'));
  const { result } = await service.get(`/v1/designs/${id}`);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const simulated = page.waitForResponse((reply) => reply.url().endsWith('/v1/simulations'));
  await page.reload();
  assert.equal((await simulated).status(), 200);
  for (const side of ['cap side', 'rod side'])
    await page.getByText(`Rise of lift, ${side}`).first().waitFor();
  if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT, fullPage: true });
  const tried = await service.post('/v1/evaluations', {
    schema: 'evaluation/1',
    requirements: result.requirements,
    design: result.designs[0],
  });
  assert.equal(tried.works, true);
  await close();
});
