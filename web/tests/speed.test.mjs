// Small and quick: the bundle, the first paint, a list of 500 designs, what if.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';

import { example, openPage, rank, startBrowser, startService, top } from './support.mjs';

let service, browser;
before(async () => {
  [service, browser] = await Promise.all([startService(), startBrowser()]);
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

test('the bundle is at most 150 kB gzip', (t) => {
  const dist = join(top, 'web/dist');
  const files = readdirSync(dist, { recursive: true, withFileTypes: true }).filter((f) => f.isFile());
  const size = files.reduce((sum, f) => sum + gzipSync(readFileSync(join(f.parentPath ?? f.path, f.name))).length, 0);
  t.diagnostic(`${(size / 1000).toFixed(1)} kB gzip`);
  assert.ok(size <= 150_000, `${size} bytes`);
});

test('the first paint comes within a second', async (t) => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('can be searched').waitFor();
  const paint = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0].startTime);
  t.diagnostic(`first contentful paint ${Math.round(paint)} ms`);
  assert.ok(paint < 1000, `${paint} ms`);
  await close();
});

test('500 designs scroll and filter without a pause above 50 ms', async (t) => {
  const many = { ...example('exosuit'), ranking: { count: 500, time_limit_s: 60 } };
  const id = await rank(service, many);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await page.getByRole('heading', { name: '500 designs' }).waitFor();
  await page.waitForTimeout(500);
  await page.evaluate(() => {
    globalThis.pauses = [];
    new PerformanceObserver((list) => globalThis.pauses.push(...list.getEntries().map((e) => e.duration))).observe({ type: 'longtask' });
  });
  const box = await page.locator('.ranked').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 200);
  for (let i = 0; i < 60; ++i) {
    await page.mouse.wheel(0, 300);
    await page.waitForTimeout(16);
  }
  const ranks = await page.locator('.ranked tbody th').allInnerTexts();
  assert.ok(Number(ranks.at(-1)) > 300, 'it scrolled');

  const axis = await page.locator('.brush-axis .grab').first().boundingBox();
  await page.mouse.move(axis.x + axis.width / 2, axis.y + axis.height - 4);
  await page.mouse.down();
  for (let i = 0; i < 40; ++i) await page.mouse.move(axis.x + axis.width / 2, axis.y + axis.height - 4 - i * 3);
  await page.mouse.up();
  await page.getByRole('heading', { name: /\d+ of 500 designs/ }).waitFor();
  await page.getByRole('columnheader', { name: 'volume' }).getByRole('button').click();
  await page.waitForTimeout(300);
  const pauses = await page.evaluate(() => globalThis.pauses);
  t.diagnostic(`long tasks: ${pauses.map(Math.round).join(', ') || 'none'}`);
  assert.deepEqual(pauses.filter((ms) => ms > 50), []);
  await close();
});

test('what if answers within 100 ms', async (t) => {
  const id = await rank(service, example('exosuit'));
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}/1`);
  await page.locator('table.tornado').waitFor();
  const slider = page.getByRole('slider', { name: 'Reservoir' });
  await slider.focus();
  const times = [];
  for (let i = 0; i < 12; ++i) {
    await page.keyboard.press('ArrowRight');
    await page.waitForTimeout(120);
    times.push(Number(/Simulated in (\d+) ms/.exec(await page.locator('.sliders').innerText())[1]));
  }
  t.diagnostic(`answers: ${times.join(', ')} ms`);
  assert.ok(Math.max(...times) < 100, `${times}`);
  await close();
});
