// A listed design says why it is not first, and takes another part.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';

import { example, openPage, rank, startBoth } from './support.mjs';

const { service, browser } = await startBoth();
let id, result;
before(async () => {
  id = await rank(service, { ...example('exosuit'), ranking: { count: 4, time_limit_s: 30 } });
  ({ result } = await service.get(`/v1/designs/${id}`));
});

test('the second says what it costs more than the first', async () => {
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/2`);
  const panel = page.locator('section.panel', { hasText: 'Why it is not first, and another part' });
  await panel.getByText('more than the first.').waitFor();
  assert.match(await panel.innerText(), /It comes to [\d.]+ kg/);
  await close();
});

test('another part is evaluated at once, and what does not fit is named', async () => {
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  const panel = page.locator('section.panel', { hasText: 'Another part' });
  await panel.getByText('It is the first of its list.').waitFor();
  const reservoir = panel.getByLabel('reservoir');
  const mine = result.designs[0].parts.find(({ family }) => family === 'reservoir').id;
  const other = mine === 'generic-pet-2l' ? 'generic-pet-1500ml' : 'generic-pet-2l';
  await reservoir.fill(other);
  await panel
    .getByText(/It comes to|No settings of its parts/)
    .first()
    .waitFor();
  await reservoir.fill('no-such-part');
  await panel.getByText('no part "no-such-part"').waitFor();
  await panel.getByRole('button', { name: 'As designed' }).click();
  await panel.getByText('It is the first of its list.').waitFor();
  assert.equal(await reservoir.inputValue(), mine);
  await close([422]);
});
