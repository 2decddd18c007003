// The JavaScript module in the page of a course, as `make module` builds both.
import { fileURLToPath } from 'node:url';
import { expect, test } from './lab.mjs';
import { serve } from './server.mjs';

const PACKAGES = fileURLToPath(new URL('../../target/npm', import.meta.url));

test('a page of a course shows zeros, relative gains and a step response by the module', async ({ lab, page }) => {
  const site = await serve({ site: PACKAGES });
  await page.goto(`${site.origin}/examples/module.html`);
  const value = async (id) => page.locator(`#${id}`).textContent();
  // Johansson (2000) prints −0.060 and −0.018, and λ = 1.40.
  await expect(page.locator('#pairing')).toHaveText('diagonal');
  const zeros = async () => (await value('zeros')).split(' and ').map(Number);
  expect((await zeros())[0]).toBeCloseTo(-0.0597, 4);
  expect((await zeros())[1]).toBeCloseTo(-0.0175, 4);
  expect(Number(await value('relative-gain'))).toBeCloseTo(1.4, 3);
  expect(await value('overshoot')).toMatch(/^\d+\.\d %$/);
  const picture = page.locator('#response img');
  await expect(picture).toBeVisible();
  expect(await picture.evaluate((image) => image.decode().then(() => image.naturalWidth))).toBe(840);

  // Beyond the line γ1 + γ2 = 1 a zero is in the right half-plane, and the other pairing is suggested.
  const before = await picture.getAttribute('src');
  await page.locator('#valve').fill('0.2');
  await expect(page.locator('#pairing')).toHaveText('swapped');
  expect((await zeros()).at(-1)).toBeGreaterThan(0);
  expect(Number(await value('relative-gain'))).toBeLessThan(0);
  expect(await picture.getAttribute('src')).not.toBe(before);
  expect(await page.locator('#link').getAttribute('href')).toMatch(/^\.\.\/#lab=q1\.[\w-]+$/);
  // On the line there is no answer to either question, and it says so.
  await page.locator('#valve').fill('0.4');
  await expect(page.locator('#relative-gain')).toHaveText('not defined');
  await lab.clean();
  await lab.axe();
  site.close();
});
