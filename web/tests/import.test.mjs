// Tables as people have them: mapped by hand, out of a workbook, remembered.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { strToU8, zipSync } from 'fflate';

import { openPage, startBoth } from './support.mjs';

const { service, browser } = await startBoth();

const table = (name, text) => ({ name, mimeType: 'text/csv', buffer: Buffer.from(text) });
const german = (number) =>
  `Verteiler 2024\nFabrikat;Modell;Stationen;Gewicht;Lagerort\nSMC;${number};4;210,5;A3\nSumme;;4;;\n`;

// A workbook of one sheet, texts inline: what ECMA-376 asks for and no more.
function workbook(rows) {
  const cell = (value, name) =>
    typeof value === 'number'
      ? `<c r="${name}"><v>${value}</v></c>`
      : `<c r="${name}" t="inlineStr"><is><t>${value}</t></is></c>`;
  const row = (cells, r) =>
    `<row r="${r + 1}">${cells.map((value, c) => cell(value, 'ABCDEFGH'[c] + (r + 1))).join('')}</row>`;
  const main = 'http://schemas.openxmlformats.org/spreadsheetml/2006/main';
  const office = 'http://schemas.openxmlformats.org/officeDocument/2006/relationships';
  const pack = 'http://schemas.openxmlformats.org/package/2006';
  const files = {
    '[Content_Types].xml': `<Types xmlns="${pack}/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="xml" ContentType="application/xml"/><Override PartName="/xl/workbook.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/><Override PartName="/xl/worksheets/sheet1.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/></Types>`,
    '_rels/.rels': `<Relationships xmlns="${pack}/relationships"><Relationship Id="rId1" Type="${office}/officeDocument" Target="xl/workbook.xml"/></Relationships>`,
    'xl/workbook.xml': `<workbook xmlns="${main}" xmlns:r="${office}"><sheets><sheet name="Teile" sheetId="1" r:id="rId1"/></sheets></workbook>`,
    'xl/_rels/workbook.xml.rels': `<Relationships xmlns="${pack}/relationships"><Relationship Id="rId1" Type="${office}/worksheet" Target="worksheets/sheet1.xml"/></Relationships>`,
    'xl/worksheets/sheet1.xml': `<worksheet xmlns="${main}"><sheetData>${rows.map(row).join('')}</sheetData></worksheet>`,
  };
  const bytes = Object.entries(files).map(([name, text]) => [name, strToU8(text)]);
  return Buffer.from(zipSync(Object.fromEntries(bytes)));
}

const openImport = async () => {
  const opened = await openPage(browser, service.base, '#/catalogue/manifold');
  await opened.page.getByRole('button', { name: 'Import a table' }).click();
  return opened;
};
const choose = (page, file) => page.getByLabel('Choose a file…').last().setInputFiles(file);

test('a price list goes in: the currency is asked, the body comes of its sides', async () => {
  const { page, close } = await openImport();
  const list =
    'Brand,SKU,Stations,Weight (g),Size (mm),Price,Shop\nSMC,PL-1,4,210,70x30x50,19.5,Acme\n';
  await choose(page, table('list.csv', list));
  await page.getByText('in which currency is "19.5"').waitFor();
  await page.getByLabel('Column for Price').selectOption('offer_price [USD]');
  await page.getByRole('button', { name: 'Import the part' }).click();
  await page.getByRole('dialog').waitFor({ state: 'detached' });
  const part = await service.get('/v1/parts/smc-pl-1');
  assert.equal(part.body_volume_ml, 105);
  const { supplier, price, currency, pack } = part.offers[0];
  assert.deepEqual(
    { supplier, price, currency, pack },
    { supplier: 'Acme', price: 19.5, currency: 'USD', pack: 1 },
  );
  await close([422]);
});

test('columns are mapped by hand, and as last time for the same headings', async () => {
  const { page, close } = await openImport();
  await choose(page, table('a.csv', german('VX-1')));
  await page.getByText('in which unit is').waitFor();
  await page.getByLabel('Column for Gewicht').selectOption('mass_kg [g]');
  await page.getByLabel('Column for Lagerort').selectOption({ label: 'left out' });
  await page.getByLabel('Column for Fabrikat').selectOption('manufacturer');
  await page.getByText('row 4 (a row of totals)').waitFor();
  await page.getByRole('button', { name: 'Import the part' }).click();
  await page.getByRole('dialog').waitFor({ state: 'detached' });
  assert.equal((await service.get('/v1/parts/smc-vx-1')).mass_kg, 0.2105);

  await page.getByRole('button', { name: 'Import a table' }).click();
  await choose(page, table('b.csv', german('VX-2')));
  await page.getByText('Read as the last table with these headings').waitFor();
  await page.getByText('smc-vx-2').waitFor();
  await close([422]);
});

test('the first sheet of a workbook is read in the page', async () => {
  const { page, close } = await openImport();
  const rows = [
    ['Catalogue 2024'],
    ['Model', 'Stations', 'Weight [g]'],
    ['XL-4', 4, 210.125],
    ['XL-8', 8, 405],
  ];
  await choose(page, { name: 'parts.xlsx', mimeType: '', buffer: workbook(rows) });
  await page.getByRole('dialog').getByLabel('manufacturer', { exact: true }).fill('Excel & Co');
  await page.getByRole('dialog').getByLabel('manufacturer', { exact: true }).blur();
  await page.getByRole('button', { name: 'Import 2 parts' }).click();
  await page.getByRole('dialog').waitFor({ state: 'detached' });
  assert.equal((await service.get('/v1/parts/excel-co-xl-4')).mass_kg, 0.210125);
  await close([422]);
});

test('what a table leaves open is answered by a button', async () => {
  const { page, close } = await openImport();
  await choose(page, table('c.csv', 'Maker;Model;Stations;Weight [g]\nSMC;VX-3;4;1,234\n'));
  await page.getByText('a number with decimals or with thousands').waitFor();
  await page.getByRole('button', { name: 'comma' }).click();
  await page.getByText('smc-vx-3').waitFor();
  await close([422]);
});

test('the check names what is there twice', async () => {
  const { page, close } = await openPage(browser, service.base, '#/catalogue/manifold');
  await page.getByRole('button', { name: 'Check', exact: true }).click();
  await page.getByRole('row', { name: /^manifold/ }).waitFor();
  await close([422]);
});
