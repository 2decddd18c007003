// Number fields and sliders: exact entry, limits, keyboard, extremes.
import { expect, test } from './lab.mjs';

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

test('a gain of zero is refused, a negative one is taken', async ({ lab }) => {
  await lab.open();
  await lab.id('gain1-number').fill('0');
  await expect(lab.id('gain1-number')).toHaveAttribute('aria-invalid', 'true');
  await lab.type('gain1-number', '−0.5');
  expect(await lab.value('gain1-number')).toBeCloseTo(-0.5, 9);
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
  await lab.id('integral1-number').focus();
  await page.keyboard.press('ArrowUp');
  expect(await lab.value('integral1-number')).toBeGreaterThan(30);
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
  expect(await lab.text('stability')).toContain('stable');
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
