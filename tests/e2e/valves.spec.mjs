// The heart of the home bench: move the valves, see everything follow.
import { expect, test } from './lab.mjs';

/** What the page says about the zero: the sign of the right-most one. */
async function zero(lab) {
  const sentence = await lab.text('valves-sentence');
  return Number(sentence.replaceAll('−', '-').match(/[+-]?\d+\.\d+/)[0]);
}

async function minimumPhase(lab) {
  expect(await zero(lab)).toBeLessThan(0);
  expect(await lab.number('lambda-11')).toBeGreaterThan(1);
  expect(await lab.text('rga-verdict')).toContain('level 1 – pump 1');
  expect(await lab.text('pairing-diagonal')).toContain('advised');
  expect(await lab.text('process-sentence')).toContain('minimum phase');
}

async function rightHalfPlane(lab) {
  expect(await zero(lab)).toBeGreaterThan(0);
  expect(await lab.number('lambda-11')).toBeLessThan(0);
  expect(await lab.text('rga-verdict')).toContain('level 1 – pump 2');
  expect(await lab.text('pairing-swapped')).toContain('advised');
  expect(await lab.text('process-sentence')).toContain('right half-plane');
}

test('dragging the point across the line flips zero, relative gain, pairing and responses', async ({ lab, page }) => {
  await lab.open();
  await minimumPhase(lab);
  const before = { responses: await lab.picture('responses'), poles: await lab.picture('pole-zero') };
  const plane = await lab.id('valve-plane').boundingBox();
  const from = await lab.middle('valve-handle');
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(plane.x + plane.width * 0.4, plane.y + plane.height * 0.6, { steps: 12 });
  await page.mouse.up();
  await lab.settle();
  await rightHalfPlane(lab);
  const after = { responses: await lab.picture('responses'), poles: await lab.picture('pole-zero') };
  expect(after.responses.hash).not.toBe(before.responses.hash);
  expect(after.poles.hash).not.toBe(before.poles.hash);
  expect(after.responses.ink).toBeGreaterThan(2000);
  // The student's own pairing is obeyed, not replaced by the suggestion.
  await expect(lab.id('pairing-diagonal')).toHaveAttribute('aria-pressed', 'true');
  await lab.clean();
});

test('fractions that fall with the flow take the zero across while the valves stand', async ({ lab }) => {
  await lab.open();
  await minimumPhase(lab);
  const plane = await lab.picture('valve-plane');
  await lab.page.locator('[data-testid=operating-point-fold] > summary').click();
  await lab.id('rig-numbers').locator('summary').click();
  await lab.type('rig-valve-slope1', '-0.01');
  await lab.type('rig-valve-slope2', '-0.01');
  await lab.settle();
  // γ̃ = γ + 2 s q with flows of 9.99 and 10.05 cm³/s from 3 V.
  const [first, second] = [0.7 - 0.02 * 9.99, 0.6 - 0.02 * 10.05];
  await rightHalfPlane(lab);
  const sentence = await lab.text('process-sentence');
  for (const text of [(first + second).toFixed(2), first.toFixed(3), second.toFixed(3), (0.7 - 0.0999).toFixed(3)]) {
    expect(sentence).toContain(text);
  }
  expect(await lab.number('lambda-11')).toBeCloseTo((first * second) / (first + second - 1), 2);
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.7, 9);
  expect((await lab.picture('valve-plane')).hash).not.toBe(plane.hash);
  await lab.clean();
  await lab.axe();
});

test('the arrow keys do the same as the mouse', async ({ lab, page }) => {
  await lab.open();
  await minimumPhase(lab);
  const before = await lab.picture('responses');
  await lab.id('valve-handle').focus();
  for (let k = 0; k < 5; k += 1) await page.keyboard.press('Shift+ArrowLeft');
  for (let k = 0; k < 4; k += 1) await page.keyboard.press('Shift+ArrowDown');
  await page.keyboard.press('ArrowLeft');
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.44, 9);
  expect(await lab.value('gamma2-number')).toBeCloseTo(0.4, 9);
  await rightHalfPlane(lab);
  expect((await lab.picture('responses')).hash).not.toBe(before.hash);
  await expect(lab.id('valve-handle')).toBeFocused();
  await expect(lab.id('valve-handle')).toHaveAttribute('aria-valuetext', 'γ₁ 0.44, γ₂ 0.40');
  await page.keyboard.press('End');
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBe(1);
});

test('a valve is dragged on the drawing, or moved by keys', async ({ lab, page }) => {
  await lab.open();
  await minimumPhase(lab);
  const from = await lab.middle('valve1');
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // Down is shut: half of the 120 px from open to shut.
  await page.mouse.move(from.x, from.y + 60, { steps: 6 });
  await page.mouse.up();
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.2, 9);
  await rightHalfPlane(lab);
  await expect(lab.id('valve1')).toBeFocused();
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('Shift+ArrowUp');
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.26, 9);
  await expect(lab.id('valve1')).toHaveAttribute('aria-valuetext', '0.26');
  await lab.id('valve2').focus();
  await page.keyboard.press('End');
  await lab.settle();
  expect(await lab.value('gamma2-number')).toBe(1);
});

test('the point cannot be dragged off the plane', async ({ lab, page }) => {
  await lab.open();
  const from = await lab.middle('valve-handle');
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 400, from.y + 500, { steps: 6 });
  await lab.settle();
  expect([await lab.value('gamma1-number'), await lab.value('gamma2-number')]).toEqual([1, 0]);
  await page.mouse.move(from.x - 500, from.y - 200, { steps: 6 });
  await page.mouse.up();
  await lab.settle();
  expect([await lab.value('gamma1-number'), await lab.value('gamma2-number')]).toEqual([0, 1]);
  await page.mouse.move(from.x, from.y);
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBe(0);
  await lab.clean();
});

test.describe('by touch', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  test('a finger drags the point, the page stays where it is, and the point stays under the finger', async ({ lab, page }) => {
    await lab.open();
    await lab.id('valve-handle').scrollIntoViewIfNeeded();
    const from = await lab.middle('valve-handle');
    const scrolled = await page.evaluate(() => scrollY);
    const client = await page.context().newCDPSession(page);
    const touch = (type, x, y) => client.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x, y }] });
    await touch('touchStart', from.x, from.y);
    for (let k = 1; k <= 10; k += 1) {
      await touch('touchMove', from.x - 8 * k, from.y + 8 * k);
      await lab.settle();
    }
    const reached = await lab.middle('valve-handle');
    await touch('touchEnd');
    await lab.settle();
    await rightHalfPlane(lab);
    expect(await page.evaluate(() => scrollY)).toBe(scrolled);
    expect(Math.abs(reached.x - (from.x - 80))).toBeLessThan(4);
    expect(Math.abs(reached.y - (from.y + 80))).toBeLessThan(4);
  });
});

test('sliders and number fields lead to the same place', async ({ lab }) => {
  await lab.open();
  await lab.id('gamma1').fill('0.43');
  await lab.type('gamma2-number', '0,34');
  await rightHalfPlane(lab);
  const drawn = await lab.id('rig').textContent();
  expect(drawn).toContain('0.43');
  expect(drawn).toContain('0.34');
});

const SINGULAR = [
  ['0.6', '0.4', 'origin', 'No pairing works'],
  ['1', '0', 'singular at every frequency', 'No pairing works'],
  ['0', '1', 'singular at every frequency', 'No pairing works'],
  ['0', '0.5', 'nothing straight down', 'level 1 – pump 2'],
  ['0', '0', 'nothing straight down', 'level 1 – pump 2'],
  ['1', '0.5', '> 1', 'level 1 – pump 1'],
  ['1', '1', 'two separate tanks', 'level 1 – pump 1'],
];
for (const [gamma1, gamma2, sentence, verdict] of SINGULAR) {
  test(`γ = (${gamma1}, ${gamma2}) has its own sentence and no NaN`, async ({ lab }) => {
    await lab.open();
    await lab.type('gamma1-number', gamma1);
    await lab.type('gamma2-number', gamma2);
    expect(await lab.text('process-sentence')).toContain(sentence);
    expect(await lab.text('rga-verdict')).toContain(verdict);
    await lab.clean();
    expect((await lab.picture('responses')).ink).toBeGreaterThan(2000);
  });
}

test('where a wall is too low, the page says so and goes on', async ({ lab }) => {
  await lab.open();
  await lab.type('gamma1-number', '1');
  await lab.type('gamma2-number', '0.2');
  expect(await lab.text('process-sentence')).toMatch(/Tank 1 would need \d+\.\d cm.*It overflows/);
  await lab.clean();
});

test('on the line all cards say the same, and rounding is told by none', async ({ lab, page }) => {
  await lab.open();
  for (const [gamma1, gamma2] of [['0.5', '0.5'], ['0.2', '0.8'], ['0.4', '0.6']]) {
    await lab.type('gamma1-number', gamma1);
    await lab.type('gamma2-number', gamma2);
    expect(await lab.text('valves-sentence')).toContain('at the origin');
    expect(await lab.text('zeros-sentence')).not.toContain('left half-plane');
    expect(await lab.text('niederlinski')).toMatch(/index:\s–\sfor .*,\s–\sfor/);
    expect(await lab.id('pole-zero').getAttribute('aria-label')).not.toMatch(/e−\d\d/);
    expect(await page.locator('main').textContent()).not.toMatch(/\de−1\d/);
  }
  // Beside it, a small relative gain in the denominator is no zero.
  await lab.type('gamma1-number', '0.5');
  await lab.type('gamma2-number', '0.501');
  expect(await lab.text('process-sentence')).toContain('1.00100 > 1');
  expect(await page.locator('.card.rga .formula').textContent()).toContain('0.0010');
  expect(await lab.text('rga-verdict')).toContain('hard to control');
});

test('where the plant is singular at every frequency, a relative gain is 0/0', async ({ lab }) => {
  await lab.open();
  await lab.type('gamma1-number', '1');
  await lab.type('gamma2-number', '0');
  expect(await lab.text('lambda-11')).toBe('–');
  expect(await lab.text('lambda')).toBe('–');
});
