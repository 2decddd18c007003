// Every published rig, held against the figures its source prints.
import { expect, numberIn, test } from './lab.mjs';

// Printed: Johansson 2000 (operating points, time constants, zeros, λ) and Cocota 2009 (Tables of ch. 3 and 4).
// `exact` are the values recomputed at the exact equilibrium: levels in cm or mm, zeros in 1/s.
const RIGS = [
  {
    name: 'johansson-2000-minimum-phase', lambda: 1.4, zeros: [-0.0597, -0.01747], printedZeros: [-0.06, -0.018],
    levels: [12.263, 12.783, 1.634, 1.409], printedLevels: [12.4, 12.7, 1.8, 1.4], gains: [3, 2.7], times: [30, 40], pairing: 'diagonal',
  },
  {
    name: 'johansson-2000-non-minimum-phase', lambda: -0.64, zeros: [-0.05625, 0.01276], printedZeros: [-0.057, 0.013],
    levels: [12.442, 13.167, 4.73, 4.986], printedLevels: [12.6, 13, 4.8, 4.9], gains: [1.5, -0.12], times: [110, 220], pairing: 'diagonal',
  },
  {
    name: 'cocota-2009-minimum-phase', lambda: 1.125, zeros: [-0.01496, -0.00747], printedZeros: [-0.015, -0.0075],
    levels: [156.729, 152.473, 40.371, 43.934], printedLevels: [156.7, 152.5, 40.4, 43.9], gains: [1, 1], times: [32, 32], pairing: 'diagonal',
  },
  {
    name: 'cocota-2009-non-minimum-phase', lambda: -1.32, zeros: [-0.009823, 0.001369], printedZeros: [-0.0099, 0.0014],
    levels: [156.229, 157.855, 234.822, 284.427], printedLevels: [156.1, 157.5, 234, 282.3], gains: [1.39, 1.75], times: [380, 365], pairing: 'swapped',
  },
];

/** A cell of the table of published figures. */
const cell = async (lab, which, key) =>
  numberIn(await lab.id('published').locator(`[data-${which}^="${key}"]`).textContent());

for (const rig of RIGS) {
  test(`${rig.name} loads its plant and controller, and shows printed beside exact`, async ({ lab, page }) => {
    await lab.open();
    await lab.preset(rig.name);
    expect(await lab.number('lambda-11')).toBeCloseTo(rig.lambda, 1);
    for (const k of [0, 1]) {
      expect(await lab.value(`gain${k + 1}-number`)).toBeCloseTo(rig.gains[k], 6);
      expect(await lab.value(`integral${k + 1}-number`)).toBeCloseTo(rig.times[k], 6);
    }
    await expect(lab.id(`pairing-${rig.pairing}`)).toHaveAttribute('aria-pressed', 'true');
    await page.locator('.process details.more > summary').click();
    const subscript = ['₁', '₂', '₃', '₄'];
    for (const [k, level] of rig.levels.entries()) {
      const digits = rig.name.startsWith('cocota') ? 1 : 2;
      expect(Math.abs((await cell(lab, 'exact', `h${subscript[k]}`)) - level)).toBeLessThanOrEqual(0.5 * 10 ** -digits + 1e-9);
      expect(await cell(lab, 'printed', `h${subscript[k]}`)).toBeCloseTo(rig.printedLevels[k], 6);
    }
    for (const k of [0, 1]) {
      const shown = await cell(lab, 'exact', `z${subscript[k]}`);
      expect(Math.abs(shown / rig.zeros[k] - 1)).toBeLessThan(1e-3);
      expect(await cell(lab, 'printed', `z${subscript[k]}`)).toBeCloseTo(rig.printedZeros[k], 6);
    }
    expect(await cell(lab, 'printed', 'λ')).toBeCloseTo(rig.lambda, 2);
    await lab.clean();
  });
}

test('the published points of the source are marked and load with a click or the keyboard', async ({ lab, page }) => {
  await lab.open();
  await lab.id('point-johansson-2000-non-minimum-phase').locator('.hit').click({ force: true });
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.43, 9);
  await lab.id('point-johansson-2000-minimum-phase').focus();
  await page.keyboard.press('Enter');
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBeCloseTo(0.7, 9);
});

for (const [name, lambda] of [['junqueira-case-a', 1.8], ['junqueira-case-b', -0.8]]) {
  test(`${name} says that the PI gains are ours, and settles`, async ({ lab, page }) => {
    await lab.open(`preset=${name}`);
    expect(await lab.number('lambda-11')).toBeCloseTo(lambda, 9);
    expect(await lab.text('stability')).toContain('stable');
    await page.locator('.process details.more > summary').click();
    expect(await lab.text('preset-remark')).toContain('gains here are ours');
    await lab.clean();
  });
}

// Cocota 2009, ch. 4, recomputed: overshoot 9.9 % and 8.7 %, 2 % settling 255 s and 258 s.
test('the run of Cocota P− has the published metrics', async ({ lab }) => {
  await lab.open('preset=cocota-2009-minimum-phase');
  const row = async (k) => (await lab.id('metrics').locator('tbody tr').nth(k).locator('td').allTextContents()).map(numberIn);
  const [first, second] = [await row(0), await row(1)];
  expect(first[3]).toBeCloseTo(9.9, 1);
  expect(second[3]).toBeCloseTo(8.7, 1);
  expect(Math.abs(first[1] - 255)).toBeLessThanOrEqual(1);
  expect(Math.abs(second[1] - 258)).toBeLessThanOrEqual(1);
});
