// Plant and loop over frequency, buttons that mend warnings, and the document about the model beside the laboratory.
import { expect, test } from './lab.mjs';

test('over frequency the loop has the Ms of the controller card, and warnings end with what mends them', async ({ lab, page }) => {
  await lab.open('lang=en&theme=dark');
  await lab.id('frequency-fold').click();
  await lab.settle();
  const shown = async () => (await lab.text('frequency-sentence')).match(/Ms = ([\d.]+)/)?.[1];
  const before = await lab.picture('frequency');
  expect(await lab.text('stability')).toContain(`Ms = ${await shown()}`);
  await lab.id('gain1-number').fill('6');
  await lab.settle();
  expect(await lab.text('stability')).toContain(`Ms = ${await shown()}`);
  expect((await lab.picture('frequency')).hash).not.toBe(before.hash);
  // The wrong pairing has no S; the button at the end of the sentence gives a stable loop back, and is one step to undo.
  await lab.id('pairing-swapped').click();
  await lab.settle();
  expect(await lab.text('frequency-sentence')).toContain('The loop is unstable');
  await expect(lab.id('mend-run')).toBeVisible();
  await lab.axe();
  await expect(lab.id('mend-loop')).toHaveCount(0);
  await lab.id('mend-run').click();
  await lab.settle();
  expect(await lab.text('stability')).toContain('stable, slowest pole');
  expect(await shown()).toBeDefined();
  await lab.id('undo').click();
  await lab.settle();
  expect(await lab.text('stability')).toContain('unstable');
  // Beyond the line the zero is named as the ceiling that it is.
  await lab.id('gamma1').fill('0.43');
  await lab.id('gamma2').fill('0.34');
  await lab.settle();
  expect(await lab.text('frequency-sentence')).toMatch(/z = 0\.01\d* 1\/s, is a ceiling/);
  await lab.clean();
});

test('the model is a page of the site, in both themes and on a phone', async ({ lab, page }) => {
  await lab.open('lang=en');
  await page.locator('.menu.about > summary').click();
  const address = await lab.id('to-model').getAttribute('href');
  for (const [width, colorScheme] of [[1440, 'light'], [390, 'dark']]) {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme });
    // The same address with another anchor would not load it again.
    await page.goto('about:blank');
    await page.goto(`${lab.origin}/${address}#6-zeros-and-directions`);
    await expect(page.locator('html')).toHaveAttribute('data-theme', colorScheme);
    await expect(page.getByRole('heading', { name: '6. Zeros and directions' })).toBeInViewport();
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
    await lab.axe();
  }
  // Every link within it leads somewhere.
  const lost = await page.evaluate(() =>
    [...document.querySelectorAll('a[href^="#"]')].map((link) => link.hash.slice(1)).filter((anchor) => !document.getElementById(anchor)),
  );
  expect(lost).toEqual([]);
});
