// No violation that axe finds, and nothing wider than the window, in every view, light and dark, at
// three widths; everything within reach of the keyboard.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';

import { openPage, startBrowser, startService } from './support.mjs';
import { makeViews, schemes, widths } from './views.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

let service, browser, views;
before(async () => {
  [service, browser] = await Promise.all([startService(), startBrowser()]);
  views = await makeViews(service);
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

for (const colorScheme of schemes) {
  for (const width of widths) {
    test(`${colorScheme}, ${width} px`, async () => {
      const found = [];
      for (const view of views) {
        const { page, close } = await openPage(browser, service.base, view.hash, {
          colorScheme,
          viewport: { width, height: 900 },
        });
        await view.ready(page);
        await page.evaluate(axe);
        const { violations } = await page.evaluate(() =>
          globalThis.axe.run(document, { resultTypes: ['violations'] }),
        );
        for (const { id, nodes } of violations)
          found.push(`${view.name}: ${id}: ${nodes.map((n) => n.html.slice(0, 160)).join(' | ')}`);
        const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        if (over > 0) found.push(`${view.name} is ${over} px wider than the window`);
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
  await page.getByText('Proved: no other combination').waitFor();
  await page.keyboard.press('Alt+3');
  await page.getByRole('heading', { name: 'Catalogue' }).waitFor();
  await close();
});
