// What goes wrong is said where it went wrong, and nothing is lost.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { example, openPage, preset, rank, startBoth, startService, textOf } from './support.mjs';

const { service, browser } = await startBoth();

const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });

test('a bad number is marked at its field while it is typed', async () => {
  const { page, close } = await openPage(browser, service.base);
  const field = page.getByLabel('Volume at rest');
  await field.fill('-5');
  await page.getByText('One thing has to change').waitFor();
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  assert.ok(await page.getByRole('button', { name: 'Find the best designs' }).isDisabled());
  // What is no number may be one with a unit: the service says why it is not.
  await field.fill('many');
  await page.getByText('or a text of a number and one of mL').first().waitFor();
  assert.ok(await page.getByRole('button', { name: 'Find the best designs' }).isDisabled());
  await page.getByLabel('Expansion').fill('many');
  await page.getByText('a number is needed here').waitFor();
  await page.getByLabel('Expansion').fill('2');
  await field.fill('50');
  await page.getByText('These requirements can be searched.').waitFor();
  await close([422]);
});

test('the ranges shown are those of the service', async () => {
  const { components } = await service.get('/openapi.json');
  // The numbers' schema at a pointer, without the choice to say nothing.
  const schemaAt = (pointer) =>
    pointer
      .split('/')
      .slice(1)
      .reduce((at, step) => {
        const inner = /^\d+$/.test(step) ? at.items : at.properties[step];
        return inner.anyOf?.find((one) => one.type !== 'null') ?? inner;
      }, components.schemas.Requirements);
  const { page, close } = await openPage(browser, service.base);
  await page.getByText('Wall supply').click();
  await page.getByText('Ambient, numbers of parts').click();
  const shown = await page
    .locator('input[data-pointer]')
    .evaluateAll((inputs) =>
      inputs.map((input) => [
        input.dataset.pointer,
        document.getElementById(input.getAttribute('aria-describedby')).textContent,
      ]),
    );
  let ranges = 0;
  for (const [pointer, hint] of shown) {
    const [, low, high] =
      /(\S+) … (\S+)$/.exec(hint.replaceAll('\u202f', '').replace('−', '-')) ?? [];
    if (low === undefined) continue;
    ++ranges;
    const { minimum, exclusiveMinimum, maximum, exclusiveMaximum } = schemaAt(pointer);
    // Below 1 is for evacuated actuators, which this one is not.
    const least = pointer.endsWith('expansion_ratio') ? 1 : (minimum ?? exclusiveMinimum);
    const range = [least, maximum ?? exclusiveMaximum];
    assert.deepEqual([Number(low), Number(high)], range, pointer);
  }
  assert.ok(ranges >= 18, `${ranges} ranges`);
  await close();
});

test('units change what is shown and never what is asked', async () => {
  const { page, close } = await openPage(browser, service.base);
  const posted = [];
  page.on(
    'request',
    (request) => request.url().includes('validate_only') && posted.push(request.postDataJSON()),
  );
  const field = page.getByLabel('Operating pressure');
  await page.getByRole('button', { name: 'bar' }).click();
  assert.equal(await field.inputValue(), '1');
  await page.getByRole('button', { name: 'abs' }).click();
  assert.equal(await field.inputValue(), '2');
  await page.getByRole('button', { name: 'psi' }).click();
  assert.equal(await field.inputValue(), '29.00755');
  await page.getByRole('button', { name: 'bar' }).click();
  await field.fill('2.05');
  await page.waitForTimeout(400);
  assert.equal(posted.at(-1).actuators[0].operating_pressure_kpa_gauge, 105);
  await page.getByRole('button', { name: 'L', exact: true }).click();
  assert.equal(await page.getByLabel('Volume at rest').inputValue(), '0.05');
  // So do the limits that the service names.
  await page.getByLabel('Volume at rest').fill('2000');
  await page.getByText('must be ≥ 0.00001 and ≤ 1\u202f000, not 2\u202f000').first().waitFor();
  // And what the catalogue shows.
  await page.getByRole('link', { name: 'Catalogue' }).click();
  await page.getByRole('link', { name: /^reservoir/ }).click();
  await page.getByRole('columnheader', { name: 'internal volume L' }).waitFor();
  await page.getByRole('columnheader', { name: 'p max bar abs' }).waitFor();
  await close([422]);
});

test('requirements are saved, loaded and shared by address', async () => {
  const { page, close } = await openPage(browser, service.base);
  await page.getByLabel('Frequency').fill('0.2');
  await page.waitForFunction(() => location.hash.includes('r='));
  const address = page.url();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save' }).click();
  const saved = JSON.parse(await textOf(await download));
  assert.deepEqual(saved, {
    ...preset('exosuit'),
    duty: { ...preset('exosuit').duty, frequency_hz: 0.2 },
  });
  await page
    .locator('input[type=file]')
    .setInputFiles(file('mine.json', JSON.stringify({ ...saved, name: 'mine' })));
  await page.waitForFunction(() => document.querySelector('input[type=text]').value === 'mine');
  await page.locator('input[type=file]').setInputFiles(file('broken.json', '{'));
  await page.getByText('broken.json is no requirements file').waitFor();
  await close();
  const again = await openPage(browser, service.base, address.slice(service.base.length + 1));
  assert.equal(await again.page.getByLabel('Frequency').inputValue(), '0.2');
  await again.close();
});

test('an infeasible problem says what conflicts', async () => {
  const impossible = example('exosuit');
  impossible.supply.mass_kg_max = 0.2;
  impossible.ranking.time_limit_s = 20;
  const id = await rank(service, impossible);
  const { page, close } = await openPage(browser, service.base, `#/designs/${id}`);
  await page.getByText('infeasible', { exact: true }).waitFor();
  const conflicts = page.getByRole('region', { name: 'Conflicting requirements' });
  await conflicts.getByRole('columnheader', { name: 'best found' }).waitFor();
  await conflicts.getByRole('row', { name: /mass/ }).waitFor();
  // What was found can be asked for, and is then met.
  await conflicts.getByRole('button', { name: 'Ask for that' }).click();
  await page.getByText('These requirements can be searched.').waitFor();
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  await page.getByText('Proved: no kind of design').waitFor();
  await close();
});

test('a job or design that is not there says so', async () => {
  const { page, close } = await openPage(browser, service.base, '#/designs/none');
  await page.getByText('no design job has the id none').waitFor();
  await close([404]);
  const id = await rank(service, {
    ...example('gripper'),
    ranking: { count: 2, time_limit_s: 10 },
  });
  const other = await openPage(browser, service.base, `#/designs/${id}/9`);
  await other.page.getByText('lists no design 9').waitFor();
  await other.close();
});

test('a bad part is refused at its fields, and a stale one is not overwritten', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/battery');
  await page.getByRole('button', { name: 'Add a part' }).click();
  await page.getByLabel('Mass', { exact: true }).fill('-1');
  await page.getByRole('button', { name: 'Add the part' }).click();
  await page.getByText('Not saved; see the fields marked.').waitFor();
  assert.equal(await page.getByLabel('Maker').getAttribute('aria-invalid'), 'true');
  await page.keyboard.press('Escape');

  const [part] = (await service.get('/v1/parts?family=battery&limit=1')).parts;
  await page.goto(`${service.base}/#/catalogue/battery?part=${part.id}`);
  await page.getByRole('button', { name: 'Edit' }).click();
  await page.getByLabel('Mass', { exact: true }).waitFor();
  const changed = await fetch(`${service.base}/v1/parts/${part.id}`, {
    method: 'PUT',
    headers: { 'If-Match': '*', 'Content-Type': 'application/json' },
    body: JSON.stringify({ ...part, notes: 'changed elsewhere' }),
  });
  assert.equal(changed.status, 200);
  await page.getByLabel('Mass', { exact: true }).fill('0.5');
  await page.getByRole('button', { name: 'Save the change' }).click();
  await page.getByText('Someone changed this part meanwhile').waitFor();
  assert.equal((await service.get(`/v1/parts/${part.id}`)).mass_kg, part.mass_kg);
  await close([412, 422]);
});

test('an import is previewed, its errors named, then written', async () => {
  const csv = await (await fetch(`${service.base}/v1/parts/export?family=tubing`)).text();
  const [head, row] = csv.split('\n');
  const { page, close } = await openPage(browser, service.base, '#/catalogue/tubing');
  await page.getByRole('button', { name: 'Import a table' }).click();
  const box = page.getByLabel('or paste it here');
  await box.fill(`${head}\nonly-an-id\n`);
  await page.getByText(/errors; nothing can be imported/).waitFor();
  await box.fill(`${head}\n${row.replace(/^[^,]*/, 'bench-tube')}\n`);
  await page.getByText('1 to add:').waitFor();
  await page.getByRole('button', { name: 'Import the part' }).click();
  await page.getByRole('link', { name: /tubing/ }).waitFor();
  await page.waitForFunction(() => document.body.innerText.includes('own'));
  assert.equal((await service.get('/v1/parts/bench-tube')).origin, 'user');
  await close([422]);
});

test('a measurement that cannot be read says which line', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  const input = page.locator('input[type=file]');
  await input.setInputFiles(file('bad.csv', 'run,t_s,valve,pressure_kpa_gauge\na,0,opne,1\n'));
  await page.getByText('line 2, valve: must be hold').waitFor();
  await input.setInputFiles(file('bad.json', '{"schema":"other/1"}'));
  await page.getByText('not "measurement/1"').waitFor();
  await close([422]);
});

test('what is too large, and a run the rig cannot have, are refused with their reason', async () => {
  const { page, close } = await openPage(browser, service.base, '#/measured');
  const input = page.locator('input[type=file]').last();
  const rows = Array.from(
    { length: 400_000 },
    (_, i) => `r${i >> 17},${i * 1e-3},hold,0.123456789`,
  );
  const csv = `run,t_s,valve,pressure_kpa_gauge\n${rows.join('\n')}\n`;
  await input.setInputFiles(file('huge.csv', csv));
  await page
    .getByText(/at most 8|too large|8 MiB|8388608/)
    .first()
    .waitFor();
  const few = rows.slice(0, 20).map((row) => row.replace('hold', 'inflate'));
  await input.setInputFiles(
    file('few.csv', `run,t_s,valve,pressure_kpa_gauge\n${few.join('\n')}\n`),
  );
  await page.getByLabel('Expansion').fill('0.5');
  await page.getByRole('button', { name: 'Find what the model lacks' }).click();
  await page.getByLabel('Expansion').and(page.locator('[aria-invalid="true"]')).waitFor();
  await close([413, 422]);
});

test('a part whose id is taken is refused at the id', async () => {
  const [part] = (await service.get('/v1/parts?family=battery&limit=1')).parts;
  const { page, close } = await openPage(
    browser,
    service.base,
    `#/catalogue/battery?part=${part.id}`,
  );
  await page.getByRole('button', { name: 'Copy', exact: true }).click();
  await page.getByLabel('Id', { exact: true }).fill(part.id);
  await page.getByRole('button', { name: 'Add the part' }).click();
  await page
    .getByText(/is taken|already/)
    .first()
    .waitFor();
  await close([409]);
});

test('a service that others can reach asks for a token; one to read may not search', async (t) => {
  const guarded = await startService({ scopes: ['read', 'write'] });
  t.after(() => guarded.stop());
  const { page, close } = await openPage(browser, guarded.base, '#/catalogue/battery');
  const use = async (token) => {
    await page.getByLabel('Token', { exact: true }).fill(token);
    await page.getByRole('button', { name: 'Use it' }).click();
  };
  await page.getByText('This service asks for a token').waitFor();
  await use('wrong');
  await page.getByText('The token given is not known').waitFor();
  await use(guarded.tokens.read);
  await page.getByRole('heading', { name: /battery: \d+ parts/ }).waitFor();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Export CSV' }).click();
  assert.match(await textOf(await download), /^id,manufacturer/);
  await page.getByRole('link', { name: 'Requirements', exact: true }).click();
  await page.getByText('Not checked: this token may read, not write').waitFor();
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  await page.getByRole('alert').getByText('this token may read, not write').waitFor();

  // With one to write the search runs, and its events are let through, too.
  await page.getByRole('button', { name: 'Token…' }).click();
  await use(guarded.tokens.write);
  await page.getByText('can be searched').waitFor();
  await page.getByRole('button', { name: 'Find the best designs' }).click();
  await page.getByText('Proved: no kind of design').waitFor();
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page.getByRole('row', { name: /exosuit proved least mass \d\.\d+ kg/ }).waitFor();
  await close([401, 403]);
});

test('a fault of the service is said where it happened', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/battery');
  await page.getByRole('heading', { name: /battery: \d+ parts/ }).waitFor();
  await page.route('**/v1/parts', (route) =>
    route.fulfill({ status: 500, contentType: 'text/plain', body: 'a fault' }),
  );
  await page.getByRole('button', { name: 'Add a part' }).click();
  await page.getByLabel('Maker').fill('bench');
  await page.getByRole('button', { name: 'Add the part' }).click();
  await page.getByText('the service answered 500').waitFor();
  assert.equal(await page.getByLabel('Maker').inputValue(), 'bench');
  await close([500]);
});

test('the service going away is said, and the page goes on when it is back', async () => {
  const own = await startService();
  const { page } = await openPage(browser, own.base);
  await page.getByText('These requirements can be searched.').waitFor();
  await page.route('**/v1/**', (route) => route.abort());
  await page.getByLabel('Frequency').fill('0.3');
  await page.getByText('The service does not answer; nothing was checked.').waitFor();
  await page.unroute('**/v1/**');
  await page.getByLabel('Frequency').fill('0.1');
  await page.getByText('These requirements can be searched.').waitFor();

  // In the middle of a search.
  const slow = { ...example('exosuit'), objective: { minimize: 'volume_l' } };
  const { id } = await own.post('/v1/designs', {
    ...slow,
    ranking: { count: 100, time_limit_s: 60 },
  });
  await page.goto(`${own.base}/#/designs/${id}`);
  await page.getByText('The proof closing').waitFor();
  await own.stop('SIGKILL');
  await page.getByText('the service does not answer').waitFor();
  await page.getByRole('link', { name: 'Catalogue' }).click();
  await page.getByText('the service does not answer').waitFor();
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page.getByText('the service does not answer').waitFor();
  await page.context().close();
});
