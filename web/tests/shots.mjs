// Pictures of every view: node tests/shots.mjs FOLDER [NAME…]
// WIDTHS=1280 SCHEMES=light node tests/shots.mjs FOLDER designs design: those of ../screenshots.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

import { openPage, startBrowser, startService } from './support.mjs';
import { makeViews, schemes, widths } from './views.mjs';

const [folder = 'shots', ...names] = process.argv.slice(2);
const taken = {
  widths: process.env.WIDTHS?.split(',').map(Number) ?? widths,
  schemes: process.env.SCHEMES?.split(',') ?? schemes,
};
mkdirSync(folder, { recursive: true });
const [service, browser] = await Promise.all([startService(), startBrowser()]);
for (const view of await makeViews(service)) {
  if (names.length > 0 && !names.includes(view.name)) continue;
  for (const colorScheme of taken.schemes) {
    for (const width of taken.widths) {
      const { page, close } = await openPage(browser, service.base, view.hash, {
        colorScheme,
        viewport: { width, height: width === 1920 ? 1080 : 900 },
      });
      await view.ready(page);
      await page.waitForTimeout(400);
      await page.screenshot({
        path: join(folder, `${view.name}-${width}-${colorScheme}.png`),
        fullPage: true,
      });
      await close();
    }
  }
}
await browser.close();
await service.stop();
