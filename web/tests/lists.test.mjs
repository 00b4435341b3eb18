// A list and what comes after it: prices and draws that are asked for, parts that are added, a
// catalogue that moves on, a model that was measured.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { openPage, preset, rank, startBoth, textOf, violationsOf } from './support.mjs';

const { service, browser } = await startBoth();

const few = (name, count = 5) => ({
  ...preset(name),
  ranking: { count, time_limit_s: 30 },
});
const idOf = (page) => /designs\/([0-9a-f]+)/.exec(page.url())[1];
const rows = (page) =>
  page.getByRole('region', { name: 'Ranked designs' }).locator('tbody tr:not(.spacer)');
const headOf = async () => (await service.get('/v1/revisions?limit=1')).revisions[0].number;

// A copy of a design's battery with another mass.
async function addPack(design, id, factor) {
  const row = design.parts.find((part) => part.family === 'battery');
  const { origin: _, ...part } = await service.get(`/v1/parts/${row.id}`);
  const added = { ...part, id, part_number: `pack ${id}`, mass_kg: part.mass_kg * factor };
  assert.equal((await service.post('/v1/parts', added)).id, id);
}
async function checkAtWidths(page) {
  for (const width of [400, 1024, 1600]) {
    await page.setViewportSize({ width, height: 900 });
    assert.deepEqual(await violationsOf(page), [], `${width} px`);
  }
}
const removePart = (id) =>
  fetch(`${service.base}/v1/parts/${id}`, { method: 'DELETE', headers: { 'If-Match': '*' } });

test('prices and draws fill the list in place', async () => {
  const id = await rank(service, few('exosuit'));
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await rows(page).first().waitFor();
  await page.getByLabel('Compare design 2', { exact: true }).check();
  // The list must be there at every moment, with what was marked in it.
  await page.evaluate(() => {
    globalThis.gone = 0;
    new MutationObserver(() => {
      if (!document.querySelector('.ranked tbody tr th a')) ++globalThis.gone;
    }).observe(document.body, { childList: true, subtree: true });
  });
  await page.getByRole('button', { name: 'What do requirements cost, how sure is it?' }).click();
  await page.getByRole('progressbar', { name: 'How far prices and draws are' }).waitFor();
  assert.equal(idOf(page), id);
  await page.getByRole('columnheader', { name: 'probability' }).waitFor();
  await page.getByRole('cell', { name: '…', exact: true }).first().waitFor();
  assert.deepEqual(await violationsOf(page), []);
  await page.getByRole('region', { name: 'Prices of requirements' }).waitFor({ timeout: 60_000 });
  assert.equal(await page.evaluate(() => globalThis.gone), 0);
  assert.equal(idOf(page), id);
  assert.ok(await page.getByLabel('Compare design 2', { exact: true }).isChecked());

  // What is filled in is what was worked out.
  const job = new URL(page.url().replace('#/', '')).searchParams.get('explained');
  const { result } = await service.get(`/v1/designs/${job}`);
  const heads = await page
    .getByRole('region', { name: 'Ranked designs' })
    .getByRole('columnheader')
    .allInnerTexts();
  const column = heads.findIndex((text) => text.startsWith('probability'));
  for (const [i, design] of result.designs.entries()) {
    const shown = await rows(page).nth(i).locator('td, th').nth(column).innerText();
    assert.equal(shown, (100 * design.robustness.probability).toFixed(1));
  }
  assert.equal(
    await page.getByRole('region', { name: 'Prices of requirements' }).locator('tbody tr').count(),
    result.prices.length,
  );

  // What is saved is a document of the service, not one put together.
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save JSON' }).click();
  const saved = JSON.parse(await textOf(await download));
  assert.deepEqual(saved.designs, result.designs);
  assert.deepEqual(saved.robust, result.robust);
  assert.ok(saved.requirements.robust);

  // It stays with the list: in one design, back again, and by its address.
  await rows(page).first().getByRole('link').click();
  await page.getByText(/Meets everything in \d+ % of the draws/).waitFor();
  await page.goBack();
  await page.getByRole('region', { name: 'Prices of requirements' }).waitFor();
  await page.reload();
  await page.getByRole('region', { name: 'Prices of requirements' }).waitFor();
  assert.equal(idOf(page), id);
  await close();
});

test('prices and draws that were cancelled leave the list, and can be asked for again', async () => {
  const id = await rank(service, few('exosuit'));
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await rows(page).first().waitFor();
  const listed = await rows(page).count();
  const ask = page.getByRole('button', { name: 'What do requirements cost, how sure is it?' });
  await ask.click();
  await page.getByRole('button', { name: 'Cancel' }).click();
  // How far it came until then is a matter of the machine; that it was stopped is said.
  await page.getByText(/^It was stopped(:| before)/).waitFor();
  assert.equal(await rows(page).count(), listed);
  await ask.waitFor();
  await close();
});

const saveModel = (name, effects) =>
  service.post('/v1/models', {
    name,
    model: {
      schema: 'model/1',
      effects,
      factors: {},
      covariance: { parameters: [], matrix: [] },
      data: [],
    },
  });

test('a revised ranking shows no full bar while it still searches', async () => {
  await saveModel('bench-creep', [
    { id: 'creep', parameters: { fraction: 0.15, time_constant_s: 2 } },
  ]);
  const asked = { ...few('exosuit', 20), model: 'bench-creep' };
  asked.ranking.time_limit_s = 6;
  // Every bar that was ever on the page, as wide as it was.
  const watchBars = () => {
    globalThis.bars = [];
    new MutationObserver(() => {
      for (const bar of document.querySelectorAll('[role=progressbar]'))
        globalThis.bars.push([bar.ariaValueNow, bar.firstElementChild.style.width]);
    }).observe(document, { childList: true, subtree: true, attributes: true });
  };
  const { id } = await service.post('/v1/designs', asked);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`, {
    before: (opened) => opened.addInitScript(watchBars),
  });
  await page.getByText(/Catalogue revision \d+\./).waitFor({ timeout: 60_000 });
  const bars = await page.evaluate(() => globalThis.bars);
  assert.ok(bars.length > 3, `${bars.length} bars`);
  for (const [now, width] of bars) {
    assert.ok(now === null || Number(now) < 100, `${now}`);
    assert.notEqual(width, '100%');
  }
  // Nor does the service say that more is proved than in the end.
  const events = [];
  const again = await service.post('/v1/designs', asked);
  for (;;) {
    const job = await service.get(`/v1/designs/${again.id}`);
    if (!['queued', 'running'].includes(job.status)) break;
    if (job.progress) events.push(job.progress.lower_bound);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  const { result } = await service.get(`/v1/designs/${again.id}`);
  assert.ok(events.length > 3);
  assert.ok(Math.max(...events) <= result.proof.lower_bound, `${Math.max(...events)}`);
  await close();
});

test('where the measured model leaves no design, it is said what none meets', async () => {
  await saveModel('bench-leak', [
    { id: 'leak', parameters: { sonic_conductance_dm3_per_s_bar: 0.0024, critical_ratio: 0.3 } },
  ]);
  const parts = (await service.get(`/v1/designs/${await rank(service, few('gripper'))}`)).result
    .designs[0].parts;
  const only = Object.fromEntries(parts.map(({ family, id }) => [family, [id]]));
  const asked = { ...few('gripper'), require: only, model: 'bench-leak' };
  asked.ranking.time_limit_s = 5;
  const id = await rank(service, asked);
  const { result } = await service.get(`/v1/designs/${id}`);
  assert.equal(result.status, 'infeasible');
  const { why } = result.against_nominal.dropped[0];
  assert.equal(why.requirement, '/actuators/0/rise_time_s_max');
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await page.getByRole('heading', { name: 'What no design meets with this model' }).waitFor();
  await page.getByText('rise time ≤ 0.15 s is missed').waitFor();
  await page.getByText(`the nearest reaches ${Number(why.achieved.toPrecision(3))} s`).waitFor();
  await checkAtWidths(page);
  await close();
});

test('changes since a part was added stand at the top, with the part named', async () => {
  const asked = few('exosuit', 8);
  const first = await rank(service, asked);
  const old = (await service.get(`/v1/designs/${first}`)).result;
  const was = await headOf();
  await addPack(old.designs[0], 'bench-light', 0.5);
  const { page, close } = await openPage(browser, service.base);
  page.setDefaultTimeout(90_000); // a search may take its whole time
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByLabel('Designs to list').fill('8');
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  const panel = page.locator('.panel').first();
  await panel
    .getByRole('heading', { name: `Changes since revision ${was} of the catalogue` })
    .waitFor();
  const now = (await service.get(`/v1/designs/${idOf(page)}`)).result;
  const key = ({ parts }) => parts.map((p) => `${p.id} ${p.quantity} ${p.group}`).join();
  const [mine, theirs] = [now, old].map(({ designs }) => new Set(designs.map(key)));
  const fresh = now.designs.filter((design) => !theirs.has(key(design)));
  const gone = old.designs.filter((design) => !mine.has(key(design)));
  assert.ok(fresh.length > 0);
  await panel.getByText(`${fresh.length} new, ${gone.length} no longer listed`).waitFor();
  await panel.getByText(/^Added: .*pack bench-light \(battery\), now in #1/).waitFor();
  await panel.getByText('Design by design').click();
  await panel.getByText(/^#1 new: as #\d+ was, with pack bench-light in place of /).waitFor();
  await rows(page).first().getByText('new').waitFor();
  await checkAtWidths(page);
  // The same again has no news of its own, and still tells what came since.
  await page.getByRole('button', { name: 'Rank again' }).click();
  await page.waitForFunction((id) => !location.hash.includes(id), idOf(page));
  await panel.getByRole('heading', { name: `Changes since revision ${was}` }).waitFor();

  // A part that changes nothing is named, too; so is one that goes.
  await addPack(old.designs[0], 'bench-heavy', 2);
  await removePart('bench-light');
  await page.getByRole('button', { name: 'Rank again', exact: true }).click();
  await panel.getByText(/^Removed: .*pack bench-light \(battery\), was in #1/).waitFor();
  await panel.getByText(/^Added: .*pack bench-heavy \(battery\)\.$/).waitFor();
  await panel.getByText('Design by design').click();
  await panel
    .getByText(/^No longer listed, as pack bench-light was removed: what was #1/)
    .waitFor();
  // It can be put away.
  await page.getByLabel('Changes since').selectOption('no search chosen');
  await page.getByRole('heading', { name: /^Changes since/ }).waitFor({ state: 'detached' });
  await removePart('bench-heavy');
  await close();
});

test('an old list says that the catalogue has moved on', async () => {
  const id = await rank(service, few('exosuit'));
  const { result } = await service.get(`/v1/designs/${id}`);
  const was = result.catalogue_revision.number;
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await rows(page).first().waitFor();
  const notice = page.getByText('The catalogue has moved on');
  assert.equal(await notice.count(), 0);

  // Someone else adds a part while it is open.
  await addPack(result.designs[0], 'bench-other', 0.6);
  await notice.waitFor({ timeout: 20_000 });
  await page
    .getByText(`this list is of revision ${was}, the catalogue is at revision ${was + 1}`)
    .waitFor();
  await page.getByText(/^Added: .*pack bench-other \(battery\)\.$/).waitFor();
  // A part of the list that goes, seen from one design, opened from the jobs.
  const pack = result.designs[0].parts.find((part) => part.family === 'battery');
  await removePart(pack.id);
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page.locator(`th a[href="#/designs/${id}"]`).click();
  await page.getByText(/^Removed: .*, part of #1/).waitFor();
  await checkAtWidths(page);
  await rows(page).first().getByRole('link').click();
  await notice.waitFor();
  await page.goBack();
  await page.getByRole('button', { name: 'Rank with the catalogue as it is' }).click();
  await page.getByRole('heading', { name: `Changes since revision ${was}` }).waitFor();
  assert.equal(await notice.count(), 0);

  // Once all is undone, the list is of the catalogue as it is.
  for (const number of [was + 2, was + 1]) await service.post(`/v1/revisions/${number}/undo`, {});
  await page.goto(`${service.base}/#/designs/${id}`);
  await rows(page).first().waitFor();
  await notice.waitFor({ state: 'detached', timeout: 20_000 });
  await close([404, 422]); // the part that one design had, and what it does with it
});
