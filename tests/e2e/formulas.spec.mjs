// A plant of one's own on the relay bench: formulas, lines of MATLAB, and what is said of those that are none.
import { expect, test } from './lab.mjs';

const open = async (lab, query = 'lang=en') => {
  await lab.open(`bench=relay-tuning&${query}`);
  await lab.id('plant').selectOption('wood-berry');
  await lab.settle();
  await lab.id('own-plant').click();
};

test('an element is typed as a formula, and a wrong one is explained at its place', async ({ lab, page }) => {
  await open(lab);
  await expect(lab.id('g12')).toHaveValue('-18.9 exp(-3 s)/(21 s + 1)');
  await lab.id('g11').fill('25.6 exp(-2 s)/(16.7 s + 1)');
  await lab.settle();
  // λ11 of the steady state: 1/(1 − (18.9 · 6.6)/(25.6 · 19.4)).
  await expect(lab.id('plant-remark')).toContainText((1 / (1 - (18.9 * 6.6) / (25.6 * 19.4))).toFixed(3));
  await lab.id('g11').fill('25.6 exp(-2 s)/(tau s + 1)');
  const problem = page.locator('#g11-problem');
  await expect(problem).toContainText('“tau” is not known');
  await expect(problem.locator('pre')).toHaveText('25.6 exp(-2 s)/(tau s + 1)\n                ^^^');
  await lab.axe();
  await lab.id('g11').fill('(s^2 + 1)/(2 s + 1)');
  await expect(problem).toContainText('improper');
  // The plant is as it was; Escape gives its formula back.
  await lab.id('g11').press('Escape');
  await expect(lab.id('g11')).toHaveValue('25.6 exp(-2 s)/(16.7 s + 1)');
  await expect(problem).toHaveCount(0);
  await lab.id('undo').click();
  await lab.settle();
  await expect(lab.id('g11')).toHaveValue('12.8 exp(-s)/(16.7 s + 1)');
});

test('lines of MATLAB make a plant, which the rules tune', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(lab, 'lang=pt-BR');
  await lab.id('script').fill("G = tf({12.8, -18.9; 6.6, oops}, 1)");
  await lab.id('take-script').click();
  await expect(page.locator('#script-problem')).toContainText('“oops” não é conhecido');
  const script = "s = tf('s');\nG = [2*exp(-s)/(10*s+1), 1/(8*s+1);\n     0.5/(9*s+1), 1.5*exp(-2*s)/(12*s+1)];";
  await lab.id('script').fill(script);
  await lab.id('take-script').click();
  await lab.settle();
  await expect(lab.id('script-taken')).toBeVisible();
  await expect(lab.id('g22')).toHaveValue('1,5 exp(-2 s)/(12 s + 1)');
  await lab.id('side-by-side').click();
  await lab.settle();
  await lab.id('take-simc').click();
  await lab.settle();
  // SIMC with τc = θ: K = τ/(k 2θ), Ti = min(τ, 8θ).
  expect(await lab.value('given-gain1')).toBe(2.5);
  expect(await lab.value('given-ti2')).toBe(12);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
  await lab.axe();
  await lab.clean();
});

test('biproper and integrating elements answer, and given controllers change their form', async ({ lab, page }) => {
  await open(lab);
  await lab.id('script').fill("G = zpk({[], -1; [], []}, {0, -5; -0.5, 0}, [1 0.2; 0.1 2], 'InputDelay', [0.5; 0])");
  await lab.id('take-script').click();
  await lab.settle();
  await expect(lab.id('plant-remark')).toContainText('G(0) is infinite');
  await expect(lab.id('plant-remark')).toContainText('λ₁₁ = 1.000');
  await lab.id('design-given').click();
  for (const [name, value] of [['given-gain1', '0.6'], ['given-ti1', '8'], ['given-td1', '1']]) await lab.type(name, value);
  for (const [name, value] of [['given-gain2', '0.4'], ['given-ti2', '9']]) await lab.type(name, value);
  await lab.settle();
  await expect(page.locator('.placement')).toContainText('Stable.');
  await lab.id('form-parallel').click();
  await lab.settle();
  expect(await lab.value('given-ki1')).toBeCloseTo(0.6 / 8, 6);
  expect(await lab.value('given-kd1')).toBeCloseTo(0.6, 6);
  await lab.id('form-series').click();
  await lab.settle();
  // Ti′ = Ti (1 + √(1 − 4 Td/Ti))/2.
  expect(await lab.value('given-ti1')).toBeCloseTo(4 * (1 + Math.SQRT1_2), 2);
  await lab.id('form-isa').click();
  await lab.type('given-td1', '3');
  await lab.settle();
  await lab.id('form-series').click();
  await expect(lab.id('form-problem')).toContainText('less than 4 Td = 12');
  // What was refused is as it was.
  await expect(lab.id('form-isa')).toHaveAttribute('aria-pressed', 'true');
  await lab.axe();
  await lab.clean();
});
