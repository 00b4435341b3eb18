// No violation that axe finds, and nothing wider than the window, in every view, light and dark, at
// three widths; everything within reach of the keyboard.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';

import { openPage, startBoth, violationsOf } from './support.mjs';
import { makeViews, schemes, widths } from './views.mjs';

const { service, browser } = await startBoth();
let views;
before(async () => {
  views = await makeViews(service);
});

// The gate looks at the narrowest page alone (PLENUM_NARROW).
for (const colorScheme of schemes) {
  for (const width of process.env.PLENUM_NARROW ? widths.slice(0, 1) : widths) {
    test(`${colorScheme}, ${width} px`, async () => {
      const found = [];
      for (const view of views) {
        const { page, close } = await openPage(browser, service.base, view.hash, {
          colorScheme,
          viewport: { width, height: 900 },
        });
        await view.ready(page);
        for (const violation of await violationsOf(page)) found.push(`${view.name}: ${violation}`);
        await close();
      }
      assert.deepEqual(found, []);
    });
  }
}

test('a search is written and started with the keyboard alone', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('can be searched').waitFor();
  await page.keyboard.press('Tab');
  assert.equal(
    await page.evaluate(() => document.activeElement.textContent.trim()),
    'Skip to the content',
  );
  await page.keyboard.press('Enter');
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press('Tab');
    if (await page.evaluate(() => document.activeElement.textContent === 'Find the best designs'))
      break;
  }
  await page.keyboard.press('Enter');
  await page.getByText('Proved: no kind of design').waitFor();
  await page.keyboard.press('Alt+3');
  await page.getByRole('heading', { name: 'Catalogue' }).waitFor();
  await close();
});

test('a table that goes on beyond its box says so, and its first columns stay', async () => {
  const ranked = views.find((view) => view.name === 'designs');
  const { page, close } = await openPage(browser, service.base, ranked.hash, {
    viewport: { width: 360, height: 900 },
  });
  await ranked.ready(page);
  const box = page.getByRole('region', { name: 'Ranked designs' });
  const frame = box.locator('..');
  await page.waitForFunction(
    (at) => at.dataset.beyond.includes('right'),
    await frame.elementHandle(),
  );
  assert.equal(
    await frame.locator('.edge.left').evaluate((at) => getComputedStyle(at).opacity),
    '0',
  );
  const before = await box.getByRole('rowheader').first().boundingBox();
  await box.focus();
  for (let i = 0; i < 60; ++i) await page.keyboard.press('ArrowRight');
  await page.waitForFunction(
    (at) => at.dataset.beyond.includes('left'),
    await frame.elementHandle(),
  );
  const after = await box.getByRole('rowheader').first().boundingBox();
  assert.ok(Math.abs(after.x - before.x) < 1, `${before.x} to ${after.x}`);
  await close();
});

test('a projector gets larger letters', async () => {
  const sizes = [];
  for (const width of [1280, 1920, 3840]) {
    const { page, close } = await openPage(browser, service.base, '', {
      viewport: { width, height: 1000 },
    });
    sizes.push(await page.evaluate(() => parseFloat(getComputedStyle(document.body).fontSize)));
    await close();
  }
  assert.equal(sizes[0], 13);
  assert.ok(sizes[1] >= 15.9 && sizes[2] >= 31.9, `${sizes}`);
});
