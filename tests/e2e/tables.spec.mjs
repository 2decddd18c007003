// Tables and the model on their way out: CSV in the style of the reader, the clipboard, LaTeX.
import { readFile } from 'node:fs/promises';
import { expect, test } from './lab.mjs';

/** The text of the file that a button of a menu hands over. */
async function saved(lab, page, menu, button) {
  await lab.id(menu).locator('summary').first().click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id(button).click()]);
  await page.keyboard.press('Escape');
  return { name: download.suggestedFilename(), text: (await readFile(await download.path())).toString() };
}

test('CSV is as the language writes it, or as chosen, and stays so', async ({ lab, page }) => {
  await lab.open('lang=en');
  const csv = async () => (await saved(lab, page, 'responses-menu', 'responses-csv')).text.split('\n');
  const plain = await csv();
  expect(plain[0]).toMatch(/^time_s,level_1_m,/);
  for (const language of ['pt-BR', 'es']) {
    await lab.id('language').selectOption(language);
    const local = await csv();
    expect(local[0]).toMatch(/^time_s;level_1_m;/);
    expect(local.length).toBe(plain.length);
    expect(local[1].replaceAll(',', '.').replaceAll(';', ',')).toBe(plain[1]);
  }
  // A choice holds in every language and at the next visit.
  await lab.id('file-menu').locator('summary').click();
  await expect(lab.id('csv-style')).toHaveValue('usual');
  await lab.id('csv-style').selectOption('tab-point');
  await page.keyboard.press('Escape');
  expect((await csv())[1].replaceAll('\t', ',')).toBe(plain[1]);
  await page.reload();
  await lab.ready();
  expect((await csv())[0]).toMatch(/^time_s\tlevel_1_m\t/);
  await lab.id('file-menu').locator('summary').click();
  await expect(lab.id('csv-style')).toHaveValue('tab-point');
  await lab.axe();
  await lab.id('csv-style').selectOption('usual');
  await page.keyboard.press('Escape');
  await lab.clean();
});

test('a run saved with decimal commas is opened as a record of the rig', async ({ lab, page }) => {
  await lab.open('lang=pt-BR');
  const { text } = await saved(lab, page, 'responses-menu', 'responses-csv');
  await lab.id('record-fold').locator('summary').first().click();
  await lab.id('record-input').setInputFiles({ name: 'rig.csv', mimeType: 'text/csv', buffer: Buffer.from(text) });
  await expect(lab.id('record-told')).toContainText('rig.csv');
  await lab.clean();
});

test('a data table goes to a spreadsheet with the decimal sign of the language', async ({ lab, page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.open('lang=pt-BR');
  await lab.id('data-table').click();
  await lab.id('data-table-copy').click();
  await expect(lab.id('notice')).toContainText('Tabela copiada');
  const rows = (await page.evaluate(() => navigator.clipboard.readText())).trimEnd().split('\n').map((row) => row.split('\t'));
  expect(rows.length).toBe(26);
  expect(rows[0][0]).toBe('tempo (s)');
  const shown = await page.locator('.responses details:has(> [data-testid=data-table]) tbody tr').last().locator('td').allInnerTexts();
  expect(rows.at(-1).length).toBe(shown.length);
  const numbers = (cells) => cells.map((cell) => Number(cell.replace('−', '-').replace(',', '.')));
  for (const [index, value] of numbers(rows.at(-1)).entries()) expect(value).toBeCloseTo(numbers(shown)[index], 1);
  expect(rows.slice(1).flat().join(' ')).not.toContain('.');
  await lab.clean();
});

test('where there is no clipboard a sentence says how else to get the table', async ({ lab, page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'clipboard', { value: undefined }));
  await lab.open('lang=en');
  await lab.id('data-table').click();
  await lab.id('data-table-copy').click();
  await expect(lab.id('notice')).toContainText('Save the CSV of the chart instead');
  await lab.axe();
});

test('model and controller are saved as LaTeX with the numbers of the page', async ({ lab, page }) => {
  await lab.open('lang=en&preset=johansson-2000-minimum-phase');
  const { name, text } = await saved(lab, page, 'file-menu', 'script-tex');
  expect(name).toBe('quadtank_model.tex');
  expect(text).toContain('\\Lambda &= \\begin{bmatrix} 1.4 & -0.4 \\\\ -0.4 & 1.4 \\end{bmatrix}');
  expect(text).toContain('\\usepackage{amsmath}');
});

test('the first column of a wide table stays in sight on a phone', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await lab.open('bench=relay-tuning&lang=en');
  const wide = await page.locator('.scroll').evaluateAll((boxes) => {
    for (const details of document.querySelectorAll('details')) details.open = true;
    return boxes.map((box, index) => [index, box.scrollWidth - box.clientWidth]).filter(([, more]) => more > 40).map(([index]) => index);
  });
  expect(wide.length).toBeGreaterThan(0);
  for (const index of wide) {
    const box = page.locator('.scroll').nth(index);
    const [scrolled, first, left] = await box.evaluate((element) => {
      element.scrollLeft = element.scrollWidth;
      const cell = element.querySelector('tbody tr > :first-child');
      return [element.scrollLeft, cell.getBoundingClientRect().left, element.getBoundingClientRect().left];
    });
    expect(scrolled).toBeGreaterThan(20);
    expect(Math.abs(first - left)).toBeLessThanOrEqual(2);
  }
});
