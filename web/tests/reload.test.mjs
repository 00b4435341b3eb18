// What outlives a reload of the page, and what is not there to go to.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { ended, openPage, startBoth, violationsOf } from './support.mjs';
import { makeMeasurement } from './fixture.mjs';

const { service, browser } = await startBoth();

test('requirements outlive a reload, and the example is a click away', async () => {
  const { page, close } = await openPage(browser, service.base);
  const name = page.getByLabel('Name', { exact: true });
  await name.fill('my leg');
  await page.getByLabel('Frequency').fill('20 per minute');
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('link', { name: 'Catalogue' }).click();
  await page.getByRole('button', { name: 'Add a part' }).waitFor();
  await page.reload();
  await page.getByRole('link', { name: 'Requirements', exact: true }).click();
  await page.getByText('your requirements from before the page was loaded again').waitFor();
  assert.equal(await name.inputValue(), 'my leg');
  assert.equal(await page.getByLabel('Frequency').inputValue(), '20 per minute');
  await page.getByRole('button', { name: 'Begin with the example' }).click();
  assert.equal(await name.inputValue(), 'exosuit');
  assert.equal(await page.getByText('from before the page was loaded').count(), 0);
  await page.reload();
  await page.getByText('These requirements can be searched.').waitFor();
  assert.equal(await name.inputValue(), 'exosuit');
  // What the address says comes first.
  await name.fill('my leg');
  await page.waitForFunction(() => location.hash.includes('r='));
  await page.reload();
  assert.equal(await name.inputValue(), 'my leg');
  assert.equal(await page.getByText('from before the page was loaded').count(), 0);
  await close();
});

test('a model that was saved before is ranked with', async () => {
  const { links } = await service.post('/v1/diagnoses', await makeMeasurement(service));
  await ended(service, links.self);
  const at = `#/measured?job=${links.self.split('/').pop()}`;
  const { page, close } = await openPage(browser, service.base, at);
  const name = page.getByLabel('Name', { exact: true });
  await name.fill('leg-creep');
  await page.getByRole('button', { name: 'Save the revision' }).click();
  await page.getByText('Saved as leg-creep, version 1.').waitFor();
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page.goBack();
  await page.getByText('Saved as leg-creep, version 1.').waitFor();
  assert.ok(await page.getByRole('button', { name: 'Rank exosuit with leg-creep' }).isEnabled());
  // In another window, by its name.
  const other = await openPage(browser, service.base, at);
  const rank = other.page.getByRole('button', { name: /^Rank exosuit with/ });
  await rank.waitFor();
  assert.ok(await rank.isDisabled());
  await other.page.getByLabel('Name', { exact: true }).fill('leg-creep');
  await other.page.getByText('leg-creep, version 1, was saved before').waitFor();
  await rank.click();
  await other.page.getByText('model leg-creep').waitFor({ timeout: 90_000 });
  await other.close();
  await close();
});

test('where the documentation was not built, the page says how', async () => {
  const { page, close } = await openPage(browser, service.base, '', {
    before: (opened) =>
      opened.route('**/docs/', (route) => route.fulfill({ status: 404, body: '{}' })),
  });
  await page.getByRole('link', { name: 'Docs' }).click();
  await page.getByRole('dialog').getByText('docs/build.sh').waitFor();
  await close([404]);
});

test('open filters leave the parts, and what is done with them, in reach', async () => {
  for (const viewport of [
    { width: 1280, height: 900 },
    { width: 390, height: 844 },
  ]) {
    const { page, close } = await openPage(browser, service.base, '#/catalogue/valve', {
      viewport,
    });
    const filters = page.locator('details.facets');
    await filters.locator('.facet').first().waitFor({ state: 'attached' });
    if (!(await filters.evaluate((at) => at.open))) await page.getByText('Filters').click();
    const add = page.getByRole('button', { name: 'Add a part' });
    assert.ok((await add.boundingBox()).y < 1.5 * viewport.height);
    assert.ok((await filters.boundingBox()).y < viewport.height);
    assert.deepEqual(await violationsOf(page), []);
    await add.click();
    await page.getByRole('dialog').waitFor();
    assert.ok((await page.evaluate(() => scrollY)) < viewport.height);
    await close();
  }
});
