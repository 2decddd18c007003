// A measured record over the responses: read, mapped, compared, run and fitted.
import { expect, test } from './lab.mjs';

/** A record of Johansson's rig whose pump 1 moves twice, as the laboratory itself computes it, written the Brazilian way. */
async function recorded(lab, page) {
  await lab.open('lang=en');
  await lab.id('experiment-more').locator('summary').first().click();
  await page.getByTestId('pumps-kind').selectOption('random');
  await lab.settle();
  await page.getByTestId('responses-menu').locator('summary').click();
  const download = page.waitForEvent('download');
  await page.getByTestId('responses-menu').getByText('CSV').click();
  const stream = await (await download).createReadStream();
  let text = '';
  for await (const piece of stream) text += piece;
  const [head, ...rows] = text.trim().split('\n').map((line) => line.split(','));
  const column = (name) => head.indexOf(name);
  const wanted = ['time_s', 'level_1_m', 'level_2_m', 'pump_voltage_1_v', 'pump_voltage_2_v'].map(column);
  const names = ['Tempo (s)', 'Nível 1 (cm)', 'Nível 2 (cm)', 'Bomba 1', 'Bomba 2'];
  const lines = rows.map((row) =>
    wanted.map((at, k) => (k === 1 || k === 2 ? (100 * Number(row[at])).toFixed(4) : row[at]).replace('.', ',')).join(';'),
  );
  return [names.join(';'), ...lines].join('\r\n');
}

const file = (text, name = 'rig.csv') => ({ name, mimeType: 'text/csv', buffer: Buffer.from(text) });

async function openRecord(lab, page, text, name) {
  const fold = lab.id('record-fold');
  if (!(await fold.evaluate((e) => e.open))) await fold.locator('summary').first().click();
  await lab.id('record-input').setInputFiles(file(text, name));
  await expect(lab.id('record-told')).not.toBeEmpty();
  await lab.settle();
}

test('a record is read, run and fitted', async ({ lab, page }) => {
  const text = await recorded(lab, page);
  // A preset that is asked for leaves no room for the offer to go on.
  await lab.open('lang=en&preset=johansson-2000-minimum-phase');
  // What is believed of the rig is wrong.
  await lab.type('gamma1-number', '0.6');
  await openRecord(lab, page, text);
  await expect(lab.id('record-told')).toContainText('rig.csv');
  const means = await lab.id('record-signal').evaluateAll((all) => all.map((select) => select.value));
  expect(means).toEqual(['time', 'level1', 'level2', 'pump1', 'pump2']);
  await lab.id('record-run').click();
  await lab.settle();
  await expect(lab.id('pumps-kind')).toHaveValue('given');
  const fits = async () => (await lab.id('record-figures').locator('td:nth-child(4)').allTextContents()).map((t) => Number.parseFloat(t.replace('−', '-')));
  expect((await fits())[0]).toBeLessThan(95);
  await lab.id('fit-fold').locator('summary').first().click();
  await lab.id('fit-k1').uncheck();
  await lab.id('fit-k2').uncheck();
  await lab.id('fit-bounds').click();
  await expect(lab.id('fit-low')).toHaveCount(2);
  expect((await lab.id('fit-low').first().boundingBox()).height).toBeGreaterThanOrEqual(32);
  await lab.id('fit-low').first().fill('0.3');
  await lab.id('fit-low').first().press('Enter');
  await lab.id('fit-start').click();
  await expect(lab.id('fit-take')).toBeVisible({ timeout: 60_000 });
  await lab.id('fit-correlation').click();
  await expect(page.locator('details:has(> [data-testid=fit-correlation]) tbody tr')).toHaveCount(2);
  await lab.axe();
  await lab.id('fit-take').click();
  await lab.settle();
  expect(Math.abs((await lab.value('gamma1-number')) - 0.7)).toBeLessThan(0.014);
  expect(Math.abs((await lab.value('gamma2-number')) - 0.6)).toBeLessThan(0.012);
  for (const fit of (await fits()).slice(0, 2)) expect(fit).toBeGreaterThan(99);
  // Tanks 3 and 4 were not recorded, which the fit says; of the levels next to nothing is left.
  await expect(lab.id('fit-unrecorded')).toContainText('(3, 4)');
  await lab.id('residuals').click();
  await lab.id('residual-table').click();
  const left = page.locator('details:has(> [data-testid=residual-table]) tbody td:nth-child(n+2)');
  await expect.poll(() => left.count()).toBeGreaterThan(20);
  const residuals = (await left.allTextContents()).map((text) => Math.abs(Number.parseFloat(text.replace('−', '-'))));
  expect(residuals.length).toBeGreaterThan(20);
  expect(Math.max(...residuals)).toBeLessThan(0.1);
  await lab.clean();
  // One step takes the rig back, another one the experiment.
  await lab.id('undo').click();
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBe(0.6);
});

test('what is no record is explained and loses nothing', async ({ lab, page }) => {
  await lab.open('lang=en');
  await lab.type('gamma1-number', '0.55');
  const cases = [
    ['', /no row of numbers/],
    ['t,h1\n', /no row of numbers/],
    ['1\n2\n3\n', /one column only/],
    ['t,h1\n0,12\n1,open\n', /Line 3, column 2: “open” is not a number/],
    ['t;h1\n0;12,5\n1;1.234,5\n', /more than one decimal sign/],
    ['t,h1\n0,12\n1,12,7\n', /Line 3 has 3 cells/],
    ['t,h1\n5,12\n4,12\n', /Line 3: the time 4.* comes after 5/],
    ['t,h1\n0,12\n,12\n', /Line 3 has no time/],
    ['a,b\n3,12\n1,12\n', /Say which column is the time/],
    ['t,b\n0,12\n1,12\n', /Say which columns are levels/],
  ];
  for (const [text, told] of cases) {
    await openRecord(lab, page, text);
    await expect(lab.id('record-told')).toContainText(told);
    await expect(lab.id('record-run')).toHaveCount(0);
  }
  await openRecord(lab, page, 't,h1\n0,12\n1,\n1,12\n2,12.5\n');
  await expect(lab.id('record-told')).toContainText('1 row repeats the time');
  expect(await lab.value('gamma1-number')).toBe(0.55);
  await lab.clean();
  await lab.id('record-close').click();
  await expect(lab.id('record-told')).toHaveCount(0);
});

test('a column is said to be another signal', async ({ lab, page }) => {
  await lab.open('lang=en');
  await openRecord(lab, page, 't (s),h1 (ft),u1 (V)\n0,0.4,3\n1,0.4,3\n', 'feet.csv');
  await expect(lab.id('record-units')).toContainText('not known here, and another one was taken: h1 (ft) → cm');
  await lab.id('record-unit').nth(1).selectOption('Inch');
  await expect(lab.id('record-units')).toBeHidden();
  await openRecord(lab, page, 's,a,b\n0,120,3\n1,121,3\n2,122,3\n', 'bare.csv');
  await expect(lab.id('record-told')).toContainText('Say which columns are levels');
  await lab.id('record-signal').nth(1).selectOption('level1');
  await lab.id('record-unit').nth(1).selectOption('Millimetre');
  await lab.settle();
  await expect(lab.id('record-figures')).toContainText('level 1');
  await lab.id('record-signal').nth(2).selectOption('level1');
  await expect(lab.id('record-told')).toContainText('Columns 2 and 3 are both level 1');
});

test('a record of 20,000 rows whose pump moves at each paints and is run', async ({ lab, page }) => {
  const rows = Array.from({ length: 20_000 }, (_, k) => `${k / 10},${12.4 + Math.sin(k / 300)},${3 + (k % 2) / 10}`);
  await lab.open('lang=en');
  await openRecord(lab, page, `t,h1,u1\n${rows.join('\n')}\n`, 'long.csv');
  await expect(lab.id('record-told')).toContainText('20000 rows');
  await expect(lab.id('record-units')).toContainText('t → s, h1 → cm, u1 → V');
  await lab.id('record-run').click();
  await expect(lab.id('record-fold')).toContainText('The simulation now does what the record did');
  await lab.settle();
  await expect(lab.id('pumps-kind')).toHaveValue('given');
  await lab.clean();
});

test('steps of the pumps are typed as a table', async ({ lab }) => {
  await lab.open('lang=en');
  await lab.id('experiment-more').locator('summary').first().click();
  await lab.id('pump-table').locator('summary').click();
  await lab.id('pump-table-text').fill('0; 3; 3\n100; x; 3');
  await lab.id('pump-table-use').click();
  await expect(lab.id('pump-table-told')).toContainText('Line 2, column 2: “x” is not a number');
  await expect(lab.id('pumps-kind')).toHaveValue('controlled');
  await lab.id('pump-table-text').fill('0; 3; 3\n100; 3,5; 3\n');
  await lab.id('pump-table-use').click();
  await expect(lab.id('pump-table-told')).toContainText('The pumps make 3 steps now');
  await lab.settle();
  await expect(lab.id('pumps-kind')).toHaveValue('given');
  await lab.axe();
  await lab.clean();
});

test('a run begins at other levels and the pumps are moved by hand', async ({ lab }) => {
  await lab.open('lang=en');
  await lab.id('experiment-more').locator('summary').first().click();
  await lab.id('start-kind').selectOption('levels');
  await lab.settle();
  await lab.type('start-level1', '5');
  await lab.type('start-level4', '99');
  await lab.settle();
  // Not above the wall.
  expect(await lab.value('start-level4')).toBeLessThan(99);
  await expect(lab.id('responses-sentence')).not.toBeEmpty();
  await lab.id('load-kind').selectOption('inflow2');
  await lab.settle();
  await lab.clean();
  await lab.axe();
});
