// The real service on a copy of the catalogue, and Chromium that notes every error and every
// request to elsewhere.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';
import { fileURLToPath } from 'node:url';

import { chromium } from 'playwright-core';

export const top = fileURLToPath(new URL('../..', import.meta.url));
const binary = process.env.PLENUM ?? join(top, 'build/release/plenum');

// With `scopes` others may reach it, and it asks for tokens: `tokens` holds one of each scope.
export async function startService({ scopes = [] } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'plenum-page-'));
  const catalog = join(folder, 'catalog.db');
  copyFileSync(join(top, 'catalog.db'), catalog);
  const make = (scope) =>
    execFileSync(binary, ['token', 'create', 'a test', '--scope', scope, '--catalog', catalog], {
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'ignore'],
    }).trim();
  const tokens = Object.fromEntries(scopes.map((scope) => [scope, make(scope)]));
  const args = scopes.length > 0 ? ['--allow-host', 'plenum.example'] : [];
  const child = spawn(binary, ['serve', '--port', '0', '--catalog', catalog, ...args], {
    stdio: ['ignore', 'ignore', 'pipe'],
  });
  const base = await new Promise((resolve, reject) => {
    let said = '';
    child.stderr.on('data', (data) => {
      said += data;
      const found = /listens at (http:\S+)\//.exec(said);
      if (found) resolve(found[1]);
    });
    child.on('exit', () => reject(new Error(`the service ended: ${said}`)));
  });
  return {
    base,
    tokens,
    get: async (path) => (await fetch(base + path)).json(),
    post: async (path, body, headers = {}) =>
      (
        await fetch(base + path, {
          method: 'POST',
          headers: { 'Content-Type': 'application/json', ...headers },
          body: JSON.stringify(body),
        })
      ).json(),
    // 'SIGKILL': as in a crash.
    async stop(how = 'SIGTERM') {
      child.removeAllListeners('exit');
      const gone = new Promise((resolve) => child.on('exit', resolve));
      child.kill(how);
      await gone;
      rmSync(folder, { recursive: true });
    },
  };
}

export const startBrowser = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });

// Both, for all tests of a file; they end with them.
export async function startBoth() {
  const [service, browser] = await Promise.all([startService(), startBrowser()]);
  after(async () => {
    await browser.close();
    await service.stop();
  });
  return { service, browser };
}

// A page of its own. `close` fails the test on console errors and on requests to elsewhere; a test
// of an error path names the answers it expects, as Chromium writes each refusal to the console.
export async function openPage(browser, base, hash = '', options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  const errors = [];
  const outside = [];
  page.on(
    'console',
    (message) => ['error', 'warning'].includes(message.type()) && errors.push(message.text()),
  );
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('request', (request) => {
    if (!request.url().startsWith(base) && !/^(data|blob):/.test(request.url()))
      outside.push(request.url());
  });
  await options.before?.(page);
  await page.goto(`${base}/${hash}`);
  return {
    page,
    async close(expectedStatuses = []) {
      const unexpected = errors.filter(
        (text) => !expectedStatuses.some((status) => text.includes(`status of ${status} `)),
      );
      assert.deepEqual(unexpected, [], 'console errors');
      assert.deepEqual(outside, [], 'requests to elsewhere');
      await context.close();
    },
  };
}

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

// What axe finds, and how much wider the page is than its window.
export async function violationsOf(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() =>
    globalThis.axe.run(document, { resultTypes: ['violations'] }),
  );
  const found = violations.map(
    ({ id, nodes }) => `${id}: ${nodes.map((n) => n.html.slice(0, 160)).join(' | ')}`,
  );
  const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  return over > 0 ? [...found, `${over} px wider than the window`] : found;
}

// What was downloaded, as text.
export const textOf = async (download) =>
  Buffer.concat(await (await download.createReadStream()).toArray()).toString();

export const example = (name) =>
  JSON.parse(readFileSync(join(top, 'examples', `${name}.json`), 'utf8'));

// An example as the page begins with it: the usual limit of a pressure is left to the service.
export function preset(name) {
  const requirements = example(name);
  for (const group of requirements.actuators)
    if (Math.abs(group.pressure_kpa_gauge_max / group.operating_pressure_kpa_gauge - 1.05) < 1e-9)
      delete group.pressure_kpa_gauge_max;
  return requirements;
}

// A job that has ended by itself.
export async function ended(service, self) {
  for (;;) {
    const job = await service.get(self);
    if (job.status === 'done') return job;
    assert.ok(['queued', 'running'].includes(job.status), `the job is ${job.status}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

// Ranks an example and gives the job's id.
export async function rank(service, requirements) {
  const { id } = await service.post('/v1/designs', requirements);
  await ended(service, `/v1/designs/${id}`);
  return id;
}
