// The level-loop bench: one tank with real instruments (Andreis 2017; lecture slides).
import { expect, test } from './lab.mjs';

const BENCH = 'bench=level-loop&lang=en';

async function press(lab, ...names) {
  for (const name of names) await lab.id(name).click();
  await lab.settle();
}

/** Presses Tab until an element has the focus, as somebody without a mouse does. */
async function tabTo(page, name) {
  for (let k = 0; k < 120; k += 1) {
    if ((await page.evaluate(() => document.activeElement?.dataset?.testid)) === name) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab does not reach ${name}`);
}

/** The rows of a table by their cells. */
async function rows(lab, name) {
  const all = await lab.id(name).locator('tbody tr').all();
  return Promise.all(all.map(async (row) => row.locator('th, td').allTextContents()));
}

const power = (text) => Number(text.replace('−', '-'));

/** Ratio of an index of the assessment, by its row. */
async function index(lab, row) {
  return Number.parseFloat((await rows(lab, 'level-indices'))[row][3]);
}

test('a first visit sees who moves: the level or the outflow', async ({ lab }) => {
  await lab.open(`${BENCH}&view=explore`);
  await press(lab, 'try-tight');
  // Under Sine L the tight tuning of the source: 99.35 to 100.72 cm, 8.14 to 26.98 L/s in its window (Table 5.19).
  expect(await lab.text('level-verdict')).toContain('between 99.35 and 100.72 cm');
  await expect(lab.id('try-tight')).toHaveAttribute('aria-pressed', 'true');
  await press(lab, 'try-averaging');
  // Table 5.19: 16.4 to 18.5 L/s, 94.93 to 111.84 cm from 50 to 150 s; after that the outflow comes down to 16.40.
  expect(await lab.text('level-verdict')).toContain('The outflow moves between 16.40 and 18.48 L/s');
  expect(await lab.text('level-verdict')).toContain('the level between 94.93 and 111.84 cm');
  await press(lab, 'try-off');
  expect(await lab.text('level-verdict')).toContain('No controller acts. The level moves');
  for (const drawer of ['tuning', 'trade', 'experiment', 'test', 'map', 'published', 'forms', 'heated']) await press(lab, `drawer-${drawer}`);
  await lab.clean();
  await lab.axe();
});

test('by keyboard alone the loop is tuned for either objective, and the index follows', async ({ lab, page }) => {
  await lab.open(BENCH);
  // Table 5.9: 0.0130 for the current tuning under Sine L; Table 5.12: 0.0152.
  expect(await index(lab, 0)).toBe(0.013);
  await tabTo(page, 'objective-averaging');
  await page.keyboard.press('Enter');
  await lab.settle();
  expect(await index(lab, 1)).toBe(0.0152);
  expect(await lab.text('level-index')).toContain('Index of the outflow');
  await tabTo(page, 'level-gain');
  await page.keyboard.press('Home');
  await lab.settle();
  // Kp 0.05 is calmer still than the best tuning of the box: the index of the outflow passes 1.
  expect(await index(lab, 1)).toBeGreaterThan(1.05);
  expect(await lab.text('level-index')).toContain('above 1');
  await page.keyboard.press('Shift+Tab');
  await tabTo(page, 'rule-simc');
  await page.keyboard.press('Enter');
  await lab.settle();
  expect(await lab.value('level-time-number')).toBe(23.5);
  await lab.clean();
});

test('published tables are shown equal to the source, with their errata', async ({ lab }) => {
  await lab.open(BENCH);
  const printed = {
    1: ['3.5016e−4', '4.5520e−6', '6.8113e−6', '4.5518e−6', '6.6309e−6', '1.6513e−4', '2.4914e−4', '5.0389e−6', '7.0385e−6'],
  };
  const found = await rows(lab, 'published-numbers');
  expect(found.map((row) => row[4])).toEqual(printed[1]);
  for (const row of found) expect(Math.abs(power(row[5]) / power(row[4]) - 1)).toBeLessThan(0.0005);
  for (const table of [2, 3, 4, 5, 6, 9, 10, 12, 13, 17, 18]) {
    await lab.id('published-table').selectOption(String(table));
    await lab.settle();
    const numbers = await rows(lab, 'published-numbers');
    expect(numbers.length).toBeGreaterThan(3);
    // Random rows differ by up to 0.53 % (no instant of switching is printed), ratios of four digits by half a digit.
    for (const row of numbers) {
      const slack = table >= 9 && table <= 13 ? 0.00006 + 0.0053 * power(row[4]) : 0.0054 * power(row[4]);
      expect(Math.abs(power(row[5]) - power(row[4])), `table ${table}: ${row}`).toBeLessThanOrEqual(slack);
    }
  }
  await lab.id('published-table').selectOption('2');
  await lab.settle();
  await expect(lab.page.locator('.tables .remarks')).toContainText('Nothing asks for the level');
  // A click brings the loop behind a number.
  await lab.id('published-numbers').locator('tbody tr').nth(1).getByRole('button').click();
  await lab.settle();
  expect(await lab.value('level-gain-number')).toBe(0.2);
  await expect(lab.id('objective-averaging')).toHaveAttribute('aria-pressed', 'true');
  const features = await rows(lab, 'published-features');
  expect(features[0].slice(1, 3)).toEqual(['0.9935', '0.9935']);
  await lab.clean();
});

test('a running search is cancelled, and a whole one finds the bound of the box', async ({ lab, page }) => {
  await lab.open(BENCH);
  await lab.id('search-genetic').click();
  await expect(lab.id('work-cancel')).toBeVisible();
  await lab.id('work-cancel').click();
  await expect(lab.id('work-cancel')).toBeHidden();
  await expect(lab.id('search-genetic')).toHaveAttribute('aria-pressed', 'false');
  await press(lab, 'objective-averaging');
  await lab.id('map-start').click();
  await expect(lab.id('map-sentence')).toContainText('1600 runs', { timeout: 30_000 });
  expect((await lab.picture('cost-map-chart')).colours).toBeGreaterThan(20);
  await lab.id('search-simplex').click();
  await expect(lab.id('map-sentence')).toContainText('Kp stands at the bound of the box', { timeout: 30_000 });
  await press(lab, 'search-take');
  expect(await lab.value('level-gain-number')).toBe(0.2);
  // Held within the band and to a robust loop the cost has another best.
  await press(lab, 'search-robust', 'search-band');
  await expect(lab.id('map-sentence')).not.toContainText('1600 runs');
  await lab.clean();
  expect(await page.locator('progress').isHidden()).toBe(true);
});

test('the test of the source does not suit the loop where it works', async ({ lab }) => {
  await lab.open(BENCH);
  // §4.2.7.1: K = 5.75, τ = 588 s; source notes: K/τ 0.0098 against 0.0231.
  expect(await lab.text('test-sentence')).toContain('K = 5.75, τ = 590 s');
  expect(await lab.text('test-sentence')).toContain('wrong where it works');
  await press(lab, 'test-here');
  await lab.type('test-step', '0.2');
  await press(lab, 'test-two-point');
  expect(await lab.text('test-sentence')).not.toContain('wrong where it works');
  await press(lab, 'test-return', 'p-only');
  expect(await lab.text('test-sentence')).toContain('Self-regulating');
  expect(await lab.text('p-only-verdict')).toContain('the offset grows');
  // A pump in the outlet makes the tank integrate.
  await press(lab, 'element-outlet', 'outflow-pumped', 'test-ramp');
  expect(await lab.text('p-only-verdict')).toContain('Integrating');
  expect(await lab.text('level-point')).toContain('integrates');
  await lab.type('test-step', '0.05');
  expect(await lab.text('test-sentence')).toContain('integrating');
  await lab.clean();
});

test('every element opens to its curve by the keyboard', async ({ lab, page }) => {
  await lab.open(BENCH);
  for (const element of ['transmitter', 'converter', 'actuator', 'valve', 'outlet']) {
    await tabTo(page, `element-${element}`);
    await page.keyboard.press('Enter');
    await lab.settle();
    expect((await lab.picture('element-curve')).ink).toBeGreaterThan(500);
  }
  await lab.axe();
});

test('the four settings of the lecture slides, and their set-point out of reach', async ({ lab }) => {
  await lab.open(BENCH);
  await press(lab, 'slides-1', 'level-figures-fold');
  const note = () => lab.page.locator('.course details .remark').textContent();
  // Final value 0.656/1.656: an offset of 60.4 %.
  expect(await note()).toContain('60.4 %');
  await press(lab, 'slides-2');
  expect(await note()).toContain('overshoot');
  await lab.type('level-set-point', '80');
  // R times the flow of the open valve is 98.4 cm.
  expect(await lab.text('level-verdict')).toContain('cannot be held');
  // Typed in metres into a loop that takes psi, the step is a fifth.
  await lab.type('level-set-point', '30');
  await press(lab, 'level-scale-signal');
  expect(await lab.text('level-scale-remark')).toContain('0.3');
  await lab.clean();
});

test('what cannot be is explained, and nothing is lost', async ({ lab, page }) => {
  await lab.open(BENCH);
  const before = page.url();
  // More than the open valve carries.
  await lab.type('level-inflow-number', '60');
  expect(await lab.text('level-verdict')).toContain('No run.');
  expect(await lab.text('level-point')).toContain('The valve would have to let through');
  await lab.type('level-inflow-number', '17');
  expect(await lab.text('level-verdict')).toContain('The level moves');
  for (const [field, text] of [['level-time-number', '0'], ['level-start-number', '300'], ['level-inflow-number', '-3'], ['level-gain-number', 'much']]) {
    await lab.id(field).fill(text);
    await expect(lab.id(field), field).toHaveAttribute('aria-invalid', 'true');
    await lab.id(field).press('Escape');
  }
  await lab.type('level-gain-number', '0');
  expect(await lab.text('level-verdict')).toContain('Kp is 0');
  const gainless = page.url();
  await lab.id('level-disturbance').selectOption('none');
  await lab.settle();
  expect(await lab.text('level-index')).toContain('does not move in this run');
  // The address follows the work.
  await expect.poll(() => page.url()).not.toBe(gainless);
  expect(page.url()).not.toBe(before);
  await page.reload();
  await lab.ready();
  expect(await lab.value('level-gain-number')).toBe(0);
  await lab.clean();
});

test('a tuning is pinned, pulled apart and restored; points of the trade-off are taken up', async ({ lab }) => {
  await lab.open(BENCH);
  await press(lab, 'level-pin');
  await press(lab, 'trade-4');
  expect(await lab.value('level-gain-number')).not.toBe(10);
  await expect(lab.id('level-pinned-1')).toContainText('Kp 10');
  await press(lab, 'level-pinned-1-restore');
  expect(await lab.value('level-gain-number')).toBe(10);
  // Typed into a parallel controller, the integral time is Kp times as long.
  await press(lab, 'forms-mistake');
  expect(await lab.value('level-time-number')).toBe(25000);
  await lab.clean();
});

test('the model of the reference errs, and the index with it', async ({ lab }) => {
  await lab.open(BENCH);
  await press(lab, 'level-error-fold');
  await lab.type('error-area-number', '1.1');
  await lab.type('error-flow-number', '0.95');
  await lab.type('reference-gain', '91.2');
  // Table 5.9: 0.0195 with the model with errors.
  expect(await index(lab, 0)).toBe(0.0195);
  await lab.clean();
});

test('an unstable loop has no step figures, and a button puts it on the rule', async ({ lab }) => {
  await lab.open(BENCH);
  await press(lab, 'level-figures-fold');
  const note = () => lab.page.locator('.course details .remark').textContent();
  await lab.type('level-set-point', '5');
  await lab.type('level-gain-number', '100');
  await lab.type('level-time-number', '588');
  expect(await lab.text('level-verdict')).toContain('unstable');
  expect(await note()).toContain('settling –');
  await press(lab, 'mend-run');
  expect(await lab.text('level-verdict')).not.toContain('unstable');
  await expect(lab.id('mend-run')).toHaveCount(0);
  await lab.clean();
});

test('a set-point out of reach is mended, and one that is held has an offset of its own', async ({ lab }) => {
  await lab.open(BENCH);
  await lab.type('level-set-point', '-99');
  expect(await lab.text('level-verdict')).toContain('cannot be held');
  await press(lab, 'mend-run');
  expect(await lab.text('level-verdict')).not.toContain('cannot be held');
  await lab.clean();
});

test('a PID controller without P becomes a PI controller with numbers', async ({ lab }) => {
  await lab.open(BENCH);
  await press(lab, 'kind-pid');
  await lab.type('level-p-number', '0');
  await press(lab, 'kind-pi');
  expect(await lab.value('level-gain-number')).toBe(10);
  expect(await lab.value('level-time-number')).toBe(2500);
  await lab.clean();
});

test('the heated tank shows where steps are too long', async ({ lab }) => {
  await lab.open(BENCH);
  await lab.type('heated-step-number', '0.5');
  await expect(lab.id('heated-verdict')).toHaveClass(/verdict$/);
  await lab.type('heated-step-number', '5');
  expect(await lab.text('heated-verdict')).toContain('too long');
  await lab.clean();
});

for (const theme of ['light', 'dark']) {
  test(`on a phone nothing runs over the edge, in Portuguese, ${theme}`, async ({ lab, page }) => {
    await page.setViewportSize({ width: 390, height: 844 });
    for (const view of ['explore', 'full']) {
      await lab.open(`bench=level-loop&lang=pt-BR&theme=${theme}&view=${view}`);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
      await lab.axe();
    }
    await lab.clean();
  });
}
