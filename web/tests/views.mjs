// Every view, as tests and screenshots open it.
import { makeMeasurement, toCsv } from './fixture.mjs';
import { ended, example, rank } from './support.mjs';

const json = (name, body) => ({
  name,
  mimeType: 'application/json',
  buffer: Buffer.from(JSON.stringify(body)),
});

export async function makeViews(service) {
  const exosuit = await rank(service, example('exosuit'));
  const crawler = await rank(service, {
    ...example('crawler'),
    ranking: { count: 20, time_limit_s: 4 },
  });
  const explained = await rank(service, {
    ...example('exosuit'),
    ranking: { count: 8, time_limit_s: 30 },
    explain: { prices: true, ranks: 4 },
    robust: { draws: 100 },
  });
  const impossible = example('exosuit');
  impossible.supply.mass_kg_max = 0.2;
  impossible.ranking.time_limit_s = 2;
  const conflict = await rank(service, impossible);
  const measurement = await makeMeasurement(service);
  const open = async (page) =>
    page.locator('input[type=file]').first().setInputFiles(json('pneunet bench.json', measurement));
  const diagnosed = async (truth) => {
    const { id } = await service.post('/v1/diagnoses', await makeMeasurement(service, truth));
    await ended(service, `/v1/diagnoses/${id}`);
    return {
      hash: `#/measured?job=${id}`,
      ready: (page) => page.getByText('Residual: measured less model').waitFor(),
    };
  };
  const designReady = async (page) => {
    await page.getByText('Fall time × C·P₀/V₀').waitFor();
    await page.getByRole('rowheader', { name: 'actuations' }).last().waitFor();
  };
  return [
    {
      name: 'requirements',
      hash: '#/requirements',
      ready: (p) => p.getByText('can be searched').waitFor(),
    },
    {
      name: 'designs',
      hash: `#/designs/${exosuit}`,
      ready: (p) => p.locator('.ranked tbody tr').first().waitFor(),
    },
    {
      name: 'designs-two-groups',
      hash: `#/designs/${crawler}`,
      ready: (p) => p.locator('.ranked tbody tr').first().waitFor(),
    },
    {
      name: 'conflict',
      hash: `#/designs/${conflict}`,
      ready: (p) => p.getByText('cannot be met together').waitFor(),
    },
    {
      name: 'explained',
      hash: `#/designs/${explained}`,
      ready: (p) => p.getByRole('region', { name: 'Prices of requirements' }).waitFor(),
    },
    { name: 'design', hash: `#/designs/${exosuit}/1`, ready: designReady },
    {
      name: 'data-sheet',
      hash: `#/designs/${exosuit}/1/sheet`,
      ready: (p) => p.getByText('Let the pressure out before you open a joint').waitFor(),
    },
    { name: 'design-two-groups', hash: `#/designs/${crawler}/2`, ready: designReady },
    {
      name: 'compare',
      hash: `#/designs/${exosuit}/compare?ranks=1,9,13,14`,
      ready: (p) => p.getByText('Pressure of spa_pack').waitFor(),
    },
    {
      name: 'catalogue',
      hash: '#/catalogue/valve',
      ready: (p) => p.locator('.parts tbody tr').first().waitFor(),
    },
    {
      name: 'catalogue-found',
      hash: '#/catalogue/valve?q=festo&pick=festo-cpe10~festo-vuvg-l10~festo-vuvg-lk10-b52-m7',
      ready: async (p) => {
        await p.locator('.parts tbody tr').first().waitFor();
        await p.getByText('Columns').click();
      },
    },
    {
      name: 'parts-compared',
      hash: '#/catalogue/valve?q=festo&pick=festo-cpe10~festo-vuvg-l10~festo-vuvg-lk10-b52-m7',
      ready: async (p) => {
        await p.getByRole('button', { name: 'Compare 3' }).click();
        await p.getByText('Only what differs').waitFor();
      },
    },
    {
      name: 'part',
      hash: '#/catalogue/compressor?part=adafruit-zr370-02pm',
      ready: (p) => p.getByText('Delivery').first().waitFor(),
    },
    {
      name: 'part-form',
      hash: '#/catalogue/compressor',
      ready: async (p) => {
        await p.getByRole('button', { name: 'Add a part' }).click();
        await p.getByRole('button', { name: 'Add the part' }).waitFor();
      },
    },
    { name: 'measured', hash: '#/measured', ready: open },
    {
      name: 'measured-csv',
      hash: '#/measured',
      ready: async (p) => {
        const csv = {
          name: 'b.csv',
          mimeType: 'text/csv',
          buffer: Buffer.from(toCsv(measurement)),
        };
        await p.locator('input[type=file]').first().setInputFiles(csv);
        await p.getByRole('heading', { name: 'The rig it was measured on' }).waitFor();
      },
    },
    { name: 'diagnosis', ...(await diagnosed('creep')) },
    { name: 'tie', ...(await diagnosed('tie')) },
    { name: 'unexplained', ...(await diagnosed('seam')) },
    {
      name: 'jobs',
      hash: '#/jobs',
      ready: (p) => p.getByRole('region', { name: 'Searches' }).waitFor(),
    },
  ];
}

export const widths = [360, 1024, 1920];
export const schemes = ['light', 'dark'];
