// Number fields and sliders: exact entry, limits, keyboard, extremes.
import { readFileSync } from 'node:fs';
import { expect, test } from './lab.mjs';

/** The link of Johansson's rig as it is published, valves at 0.7 and 0.6. */
const JOHANSSON = `lab=${readFileSync(new URL('../../crates/quadtank-scenario/tests/data/scenario-v1-johansson.link', import.meta.url), 'utf8').trim()}`;

test('a number out of range shows the limits and keeps the last valid value', async ({ lab, page }) => {
  await lab.open();
  const lambda = await lab.text('lambda-11');
  await lab.id('gamma1-number').fill('1.7');
  await expect(page.locator('#gamma1-number-problem')).toContainText('0.00 to 1.00');
  await expect(lab.id('gamma1-number')).toHaveAttribute('aria-invalid', 'true');
  expect(await lab.text('lambda-11')).toBe(lambda);
  await lab.id('gamma1-number').blur();
  await expect(lab.id('gamma1-number')).toHaveValue('0.70');
  await lab.id('gamma1-number').fill('nonsense');
  await expect(page.locator('#gamma1-number-problem')).toBeVisible();
  await lab.id('gamma1-number').fill('0,5');
  await expect(page.locator('#gamma1-number-problem')).toHaveCount(0);
  await lab.settle();
  expect(await lab.text('lambda-11')).not.toBe(lambda);
});

test('the red range goes when the old value returns, by whatever way', async ({ lab, page }) => {
  await lab.open();
  const field = lab.id('gamma1-number');
  const isQuiet = async (value) => {
    await expect(page.locator('#gamma1-number-problem')).toHaveCount(0);
    await expect(field).not.toHaveAttribute('aria-invalid');
    await expect(field).not.toHaveAttribute('aria-describedby');
    await expect(field).toHaveValue(value);
  };
  const refuse = async (text) => {
    await field.fill(text);
    await expect(page.locator('#gamma1-number-problem')).toBeVisible();
    await expect(field).toHaveAttribute('aria-invalid', 'true');
    await expect(field).toHaveAttribute('aria-describedby', 'gamma1-number-problem');
    await expect(field).toHaveValue(text);
  };
  for (const text of ['2', 'nonsense', '']) {
    await refuse(text);
    await field.blur();
    await isQuiet('0.70');
    await refuse(text);
    await field.press('Escape');
    await isQuiet('0.70');
    await refuse(text);
    await field.fill('0.7');
    await isQuiet('0.7');
    await field.blur();
    await isQuiet('0.70');
    await refuse(text);
    await field.press('ArrowUp');
    await isQuiet('0.71');
    await field.press('ArrowDown');
    await isQuiet('0.70');
  }
  // The document changes while the field has the focus: by a link in the address.
  for (const text of ['2', '0.3']) {
    await lab.preset('johansson-2000-non-minimum-phase');
    await field.fill(text);
    await page.evaluate((fragment) => (location.hash = fragment), JOHANSSON);
    await isQuiet('0.70');
    await page.evaluate(() => history.replaceState(null, '', '?'));
  }
});

for (const [field, pressed] of [['gamma1-number', 'voltage1'], ['integral2-number', 'antiwindup'], ['gain1-number', 'quantised'], ['step1-time', 'quantised']]) {
  test(`what is pressed after a refused entry stays where it is (${field}, ${pressed})`, async ({ lab, page }) => {
    await lab.open();
    for (const summary of await page.locator('.process details.more > summary, .pi details.more > summary').all()) await summary.click();
    await lab.id(field).fill('1e9');
    await expect(page.locator('.problem')).toBeVisible();
    await lab.id(pressed).scrollIntoViewIfNeeded();
    const { x, y } = await lab.middle(pressed);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await lab.settle();
    await expect(page.locator('.problem')).toHaveCount(0);
    expect(await lab.middle(pressed)).toEqual({ x, y });
    await page.mouse.up();
    await expect(lab.id(pressed)).toBeFocused();
  });
}

test('a number can be typed at any pace', async ({ lab, page }) => {
  await lab.open();
  await page.locator('[data-testid=operating-point-fold] > summary').click();
  for (const name of ['gamma1-number', 'voltage1']) {
    const field = lab.id(name);
    await field.fill('');
    for (const [key, text] of [['0', '0'], ['.', '0.'], ['5', '0.5'], ['x', '0.5x'], ['Backspace', '0.5'], ['0', '0.50']]) {
      await field.press(key);
      await expect(field).toHaveValue(text);
      await lab.settle();
      await expect(field).toHaveValue(text);
    }
    await field.fill('0.25');
    await field.fill('1000000');
    await lab.settle();
    await expect(field).toHaveValue('1000000');
    await field.blur();
    await expect(field).toHaveValue('0.25');
  }
  await lab.clean();
});

test('a gain that is too small is refused, zero and a negative one are taken', async ({ lab, page }) => {
  await lab.open();
  for (const text of ['0.0005', '-0.0005', '1001']) {
    await lab.id('gain1-number').fill(text);
    await expect(lab.id('gain1-number'), text).toHaveAttribute('aria-invalid', 'true');
    await expect(page.locator('#gain1-number-problem')).toHaveText(/^0 or ± 0\.0010* to 1000$/);
  }
  await lab.id('gain1-number').blur();
  expect(await lab.value('gain1-number')).toBe(3);
  const stable = await lab.text('stability');
  await lab.type('gain1-number', '−0.5');
  expect(await lab.value('gain1-number')).toBe(-0.5);
  expect(await lab.text('stability')).not.toBe(stable);
  await lab.id('pi-more').click();
  await lab.id('sign1').click();
  await lab.settle();
  expect(await lab.value('gain1-number')).toBe(0.5);
  await lab.clean();
});

test('the sliders work by keyboard alone', async ({ lab, page }) => {
  await lab.open();
  await lab.id('gamma1').focus();
  await page.keyboard.press('ArrowLeft');
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.69, 9);
  await page.keyboard.press('PageDown');
  expect(await lab.value('gamma1-number')).toBeLessThan(0.65);
  await page.keyboard.press('Home');
  expect(await lab.value('gamma1-number')).toBe(0);
  await page.keyboard.press('End');
  expect(await lab.value('gamma1-number')).toBe(1);
  await lab.id('gain1').focus();
  const before = await lab.value('gain1-number');
  await page.keyboard.press('ArrowRight');
  const after = await lab.value('gain1-number');
  expect(after / before).toBeGreaterThan(1);
  expect(after / before).toBeLessThan(1.03);
  // A logarithmic slider: equal steps are equal ratios, a tenth of the travel of 0.05 to 50 is a factor of two.
  await page.keyboard.press('PageUp');
  expect((await lab.value('gain1-number')) / after).toBeCloseTo(2, 1);
  await page.keyboard.press('PageDown');
  expect((await lab.value('gain1-number')) / after).toBeCloseTo(1, 1);
  await page.keyboard.press('Home');
  expect(await lab.value('gain1-number')).toBe(0.05);
  await page.keyboard.press('End');
  expect(await lab.value('gain1-number')).toBe(50);
});

test('the number fields work by keyboard alone', async ({ lab, page }) => {
  await lab.open();
  await lab.id('integral1-number').focus();
  await page.keyboard.press('ArrowUp');
  const once = await lab.value('integral1-number');
  expect(once).toBeGreaterThan(30);
  await page.keyboard.press('PageUp');
  expect(await lab.value('integral1-number')).toBeGreaterThan(once * 1.2);
  await lab.id('gamma1-number').focus();
  await page.keyboard.press('ArrowDown');
  expect(await lab.value('gamma1-number')).toBe(0.69);
  await page.keyboard.press('PageDown');
  expect(await lab.value('gamma1-number')).toBe(0.59);
  await lab.id('gamma1-number').fill('5');
  await page.keyboard.press('Escape');
  await expect(lab.id('gamma1-number')).toHaveValue('0.59');
  await expect(page.locator('#gamma1-number-problem')).toHaveCount(0);
});

test('a slider and its number field always say the same', async ({ lab }) => {
  await lab.open();
  const slider = async (name) => Number(await lab.id(name).inputValue());
  await lab.type('gamma1-number', '0.25');
  expect(await slider('gamma1')).toBe(0.25);
  // 600 positions over 0.05 to 50: the middle is the geometric mean.
  await lab.type('gain1-number', String(Math.sqrt(0.05 * 50)));
  expect(await slider('gain1')).toBe(300);
  await lab.id('gain1').fill('600');
  expect(await lab.value('gain1-number')).toBe(50);
  // Beyond its travel the slider stands at its end, and the field keeps the number.
  await lab.type('gain1-number', '400');
  expect(await slider('gain1')).toBe(600);
  expect(await lab.value('gain1-number')).toBe(400);
});

test('what is no number is never taken for one', async ({ lab }) => {
  await lab.open();
  for (const text of ['NaN', 'Infinity', 'inf', '1e999', '--3', '1.2.3', '', ' ', '0x1', '<b>']) {
    await lab.id('gamma1-number').fill(text);
    await expect(lab.id('gamma1-number'), text).toHaveAttribute('aria-invalid', 'true');
  }
  await lab.id('gamma1-number').blur();
  await expect(lab.id('gamma1-number')).toHaveValue('0.70');
  await lab.clean();
});

test('extreme gains are called unstable, the response is clipped and the page goes on', async ({ lab }) => {
  await lab.open('preset=johansson-2000-non-minimum-phase');
  await lab.type('gain1-number', '900');
  await lab.type('gain2-number', '900');
  await lab.type('integral1-number', '0.2');
  expect(await lab.text('stability')).toContain('unstable');
  expect(await lab.text('responses-sentence')).toContain('unstable');
  await lab.clean();
  expect((await lab.picture('responses')).ink).toBeGreaterThan(2000);
  await lab.preset('johansson-2000-minimum-phase');
  expect(await lab.text('stability')).toContain('Closed loop stable');
});

test('P+ with the diagonal pairing and integral action in both loops runs into a pump limit', async ({ lab }) => {
  await lab.open('preset=cocota-2009-non-minimum-phase');
  await lab.id('pairing-diagonal').click();
  await lab.settle();
  expect(await lab.text('stability')).toContain('unstable');
  expect(await lab.text('responses-sentence')).toMatch(/at its limit|overflows|runs dry/);
});

test('anti-windup, weight, sampling, noise, load and manual mode act on the run', async ({ lab, page }) => {
  await lab.open();
  await page.locator('.pi details.more > summary').click();
  let last = await lab.picture('responses');
  const changes = async (act) => {
    await act();
    await lab.settle();
    const now = await lab.picture('responses');
    expect(now.hash).not.toBe(last.hash);
    last = now;
  };
  await changes(() => lab.type('weight-number', '0.2'));
  await changes(() => lab.type('sampling-number', '8'));
  await changes(() => lab.type('noise-number', '0.1'));
  await changes(() => lab.id('load-kind').selectOption('leak1'));
  await changes(() => lab.id('load-kind').selectOption('pump1'));
  await changes(() => lab.type('load-size-number', '2'));
  await changes(() => lab.id('manual1').check());
  await changes(() => lab.type('step1-number', '6'));
  await lab.id('manual1').uncheck();
  await lab.type('gain1-number', '30');
  await lab.type('integral1-number', '3');
  last = await lab.picture('responses');
  await changes(() => lab.id('antiwindup').uncheck());
  await changes(() => lab.id('quantised').check());
  await lab.clean();
});

test('a rig of another laboratory is typed in, and what cannot be is explained', async ({ lab }) => {
  await lab.open('lang=en&preset=johansson-2000-minimum-phase');
  const openNumbers = async () => {
    await lab.page.locator('[data-testid=operating-point-fold] > summary').click();
    await lab.id('rig-numbers').locator('summary').click();
  };
  await openNumbers();
  // The benchmark of Seville (Alvarado et al. 2011): flows in m³/h instead of volts.
  const tank = (name, values) => values.map((value, k) => [`rig-${name}${k + 1}`, String(value)]);
  const numbers = [
    ...tank('height', [136, 136, 130, 130]),
    ...tank('area', [600, 600, 600, 600]),
    ...tank('outlet', [1.31, 1.51, 0.927, 0.882]),
    ...tank('gain', ['1000/3.6', '1000/3.6']),
    ...tank('high', [3.26, 4]),
    ['rig-gravity', '9.81'],
    ['gamma1-number', '0.3'],
    ['gamma2-number', '0.4'],
  ];
  for (const [id, value] of numbers) await lab.type(id, value);
  await lab.type('voltage1', '1.63');
  await lab.type('voltage2', '2.00');
  // Without a step the rig stays at rest.
  await lab.id('experiment-more').locator('summary').first().click();
  await lab.id('step-remove-2').click();
  await lab.id('step-remove-1').click();
  await lab.settle();
  // Levels at rest, 0.6538, 0.6498, 0.6590 and 0.6582 m as computed apart from this program.
  const levels = await lab.page.evaluate(() => [1, 2, 3, 4].map((k) => document.querySelector(`[data-testid="rig-level-${k}"]`)?.textContent));
  expect(levels.join(' ')).toMatch(/65\.3\d.*64\.9\d.*65\.9\d.*65\.8\d/);
  // Its published sequence of references: 0.65/0.65, 0.30/0.30, 0.50/0.75 and 0.90/0.75 m.
  await lab.id('duration-number').fill('12000');
  await lab.id('duration-number').blur();
  for (let k = 0; k < 5; k += 1) await lab.id('step-add').click();
  const steps = [[1, 3000, -35], [2, 3000, -35], [1, 6000, 20], [2, 6000, 45], [1, 9000, 40]];
  for (const [k, [level, time, size]] of steps.entries()) {
    await lab.id(`step-level-${k + 1}`).selectOption(`level${level}`);
    await lab.type(`step-time-${k + 1}`, String(time));
    await lab.type(`step-size-${k + 1}`, String(size));
  }
  await lab.page.waitForTimeout(600);
  await lab.page.reload();
  await lab.ready();
  await lab.id('experiment-more').locator('summary').first().click();
  const sizes = await Promise.all(steps.map((_, k) => lab.value(`step-size-${k + 1}`)));
  expect(sizes).toEqual([-35, -35, 20, 45, 40]);
  await lab.id('step-remove-5').click();
  await expect(lab.id('step-size-5')).toHaveCount(0);
  await openNumbers();
  // An outlet of more than a tenth of the tank is none of Torricelli's.
  await lab.type('rig-outlet1', '90');
  await expect(lab.id('rig-refused')).toContainText('outlet');
  expect(await lab.value('rig-outlet1')).toBeCloseTo(1.31, 6);
  await lab.clean();
  await lab.axe();
});

test('a rig changes during a run, its pumps have a curve, and its levels can be held', async ({ lab }) => {
  await lab.open('lang=en&view=full&preset=johansson-2000-minimum-phase');
  // A closed outlet: tank 4 runs over.
  await lab.id('load-kind').selectOption('outlet3');
  await lab.type('load-size-number', '-100');
  await lab.settle();
  await expect(lab.id('responses-sentence')).toContainText('Tank 4 overflows');
  await lab.id('load-kind').selectOption('valve0');
  await lab.type('load-size-number', '10');
  await lab.settle();
  await expect(lab.id('responses-sentence')).not.toContainText('overflows');
  // With the levels held, the pumps follow the valves.
  await lab.page.locator('[data-testid=operating-point-fold] > summary').click();
  await lab.id('hold-levels').check();
  const level = await lab.text('rig-level-1');
  await lab.id('valve-handle').focus();
  await lab.page.keyboard.press('Shift+ArrowLeft');
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.65, 1);
  expect(await lab.text('rig-level-1')).toBe(level);
  await lab.type('gamma1-number', '0.66');
  await lab.settle();
  expect(await lab.text('rig-level-1')).toBe(level);
  expect(Math.abs((await lab.value('voltage1')) - 3)).toBeGreaterThan(0.02);
  await lab.type('voltage1', '3');
  // A dead zone in which the pump would rest is told.
  await lab.id('rig-numbers').locator('summary').click();
  await lab.type('rig-start1', '3.5');
  await lab.settle();
  await expect(lab.id('process-sentence')).toContainText('3.5');
  // A hose that delays its pump is told with the loop, whose poles are then not listed.
  await lab.type('rig-start1', '0');
  await lab.type('rig-delay1', '4');
  await lab.settle();
  await expect(lab.id('stability')).toContainText('dead time');
  await lab.clean();
  await lab.axe();
});

