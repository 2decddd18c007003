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
  await lab.id('g11').fill('(s + 1)/(2 s + 1)');
  await expect(problem).toContainText('biproper');
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
