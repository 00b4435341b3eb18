// Parts found by words, compared side by side, in columns of one's choice.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';

import { openPage, startBoth } from './support.mjs';

const { service, browser } = await startBoth();
before(async () => {
  const battery = (id, more) => ({
    id,
    family: 'battery',
    manufacturer: 'Maker',
    part_number: id,
    nominal_voltage_v: 7.4,
    cells_series: 2,
    capacity_ah: 1.4,
    current_max_a: 20,
    mass_kg: 0.1,
    body_volume_ml: 50,
    ...more,
  });
  const two = {
    notes: 'A quokka in green',
    mass_kg: 0.25,
    provenance: { mass_kg: { kind: 'estimated', source: 'a guess' } },
    documents: [{ link: 'https://maker.example/two.pdf' }],
  };
  for (const part of [battery('zq-one', { notes: 'Quokka pack, grey' }), battery('zq-two', two)])
    assert.equal((await service.post('/v1/parts', part)).id, part.id);
});

const rows = (page) => page.locator('.parts tbody tr:not(.spacer)');

test('words find parts in all their texts, and where else there are some', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/battery');
  const search = page.getByRole('searchbox', { name: 'Find parts' });
  await search.fill('green quokka');
  await page.getByText('battery: 1 part').waitFor();
  assert.equal(await rows(page).count(), 1);
  await search.fill('QUOKKA');
  await page.getByText('battery: 2 parts').waitFor();
  await page.getByRole('link', { name: 'valve 0', exact: true }).click();
  await page.getByText('No valve has these words, but').waitFor();
  await page.getByRole('link', { name: '2 battery' }).click();
  await page.getByText('battery: 2 parts').waitFor();
  assert.equal(await search.inputValue(), 'QUOKKA');
  // Signs of query languages are text.
  for (const text of ['"quokka', "quokka' OR 1", 'quokka*']) {
    await search.fill(text);
    await page
      .getByText(text.includes('OR') ? 'No battery has these words' : 'battery: 2 parts')
      .waitFor();
  }
  await search.fill('');
  await page.getByText('quokka').waitFor({ state: 'detached' });
  await close();
});

test('what is estimated and where the data sheet is stands in each row', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/battery?q=quokka');
  const two = rows(page).filter({ hasText: 'zq-two' });
  assert.equal(
    await two.getByRole('link', { name: 'sheet' }).getAttribute('href'),
    'https://maker.example/two.pdf',
  );
  assert.match(await two.textContent(), /17 %.*~ 0\.25/);
  await page.getByLabel('estimated share, at least').fill('0.1');
  await page.getByLabel('estimated share, at least').press('Enter');
  await page.getByText('battery: 1 of 2 parts').waitFor();
  await page.getByRole('button', { name: 'Clear all' }).click();
  await page.getByRole('group', { name: 'documented' }).getByText('false').click();
  await page.getByText('battery: 1 of 2 parts').waitFor();
  await close();
});

test('parts are picked, kept in the address and compared', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/battery?q=quokka');
  await page.getByLabel('Compare zq-two').check();
  assert.ok(await page.getByRole('button', { name: 'Compare 1' }).isDisabled());
  await page.getByLabel('Compare zq-one').check();
  await page.waitForFunction(() => location.hash.includes('pick=zq-two'));
  await page.reload();
  await page.getByRole('button', { name: 'Compare 2' }).click();
  const dialog = page.getByRole('dialog');
  const mass = dialog.getByRole('row').filter({ hasText: 'mass' });
  await mass.waitFor();
  assert.match(await mass.textContent(), /≠ mass kg.*~ 0\.25.*0\.1/);
  const voltage = dialog.getByRole('row').filter({ hasText: 'nominal voltage' });
  assert.doesNotMatch(await voltage.textContent(), /≠/);
  await dialog.getByText('Only what differs').click();
  await voltage.waitFor({ state: 'detached' });
  await page.keyboard.press('Escape');
  await page.getByRole('button', { name: 'Take zq-one out' }).click();
  await page.getByRole('button', { name: 'Empty' }).click();
  await page.locator('.tray').waitFor({ state: 'detached' });
  await close();
});

test('columns are chosen and stay chosen', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/battery?q=quokka');
  const head = page.getByRole('columnheader', { name: /^mass/ });
  await head.waitFor();
  await page.getByText('Columns').click();
  await page.locator('.columns').getByLabel('mass').uncheck();
  await head.waitFor({ state: 'detached' });
  await page.waitForFunction(() => location.hash.includes('without=mass_kg'));
  await page.reload();
  await rows(page).first().waitFor();
  assert.equal(await head.count(), 0);
  await page.getByText('Columns').click();
  await page.locator('.columns').getByRole('button', { name: 'All' }).click();
  await head.waitFor();
  await close();
});
