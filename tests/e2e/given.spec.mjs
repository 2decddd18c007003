// Given controllers on the relay bench.
import { expect, test } from './lab.mjs';

const open = async (lab, query = 'lang=en') => {
  await lab.open(`bench=relay-tuning&${query}`);
  await lab.id('plant').selectOption('wood-berry');
  await lab.settle();
  await lab.id('design-given').click();
  await lab.settle();
};

test('published controllers are taken over and stand side by side', async ({ lab, page }) => {
  await open(lab);
  await lab.id('given-published').selectOption({ index: 1 });
  await lab.settle();
  expect(await lab.value('given-gain1')).toBe(0.375);
  expect(await lab.value('given-ti2')).toBe(23.6);
  // Luyben (1986): stable, Ms 2.10, biggest log modulus 3.98 dB.
  await expect(page.locator('.placement')).toContainText('3.98 dB, Ms 2.10');
  await lab.id('side-by-side').click();
  await expect(page.locator('.placement .folded table').last()).toContainText('39.53');
  // BLT beside the placement: the rule has the 4 dB that it asks for.
  await expect(page.getByRole('row', { name: /4 dB \(Luyben 1986\) ✓/ })).toContainText('4.00');
  await expect(page.getByRole('row', { name: 'At work now' })).toContainText('3.98');
  await lab.clean();
  await lab.axe();
  // The derivative filter is a number of its own where there is derivative action.
  await expect(lab.id('given-tf1')).toBeHidden();
  await lab.id('given-published').selectOption('wood-berry-boyd-hast-astrom');
  await lab.settle();
  expect(await lab.value('given-tf1')).toBe(0.3);
  await lab.id('undo').click();
  await lab.settle();
  // A gain of one's own is none of them; a far one makes the loop unstable, and what follows says so.
  await lab.type('given-gain1', '3');
  await expect(lab.id('given-published')).toHaveValue('');
  await lab.clean();
  await lab.id('undo').click();
  await lab.settle();
  expect(await lab.value('given-gain1')).toBe(0.375);
});

test('given controllers fit into a phone', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(lab, 'lang=pt-BR');
  await lab.id('side-by-side').click();
  await lab.settle();
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
});
