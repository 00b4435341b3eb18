// Pictures of every view: node tests/shots.mjs FOLDER [NAME…]
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';

import { openPage, startBrowser, startService } from './support.mjs';
import { makeViews, schemes, widths } from './views.mjs';

const [folder = 'shots', ...names] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const [service, browser] = await Promise.all([startService(), startBrowser()]);
for (const view of await makeViews(service)) {
  if (names.length > 0 && !names.includes(view.name)) continue;
  for (const colorScheme of schemes) {
    for (const width of widths) {
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
