// How it stands on screens of several sizes. Pictures go to the report of the run.
import { expect, test } from './lab.mjs';

const SIZES = [
  [1440, 900],
  [1024, 768],
  [390, 844],
  [360, 740],
];

/** Elements whose content is cut off at the side, outside what scrolls on purpose. */
const cutOff = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll('#app *')]
      .filter((e) => e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0)
      .filter((e) => !e.closest('.scroll, svg, math, select, .visually-hidden, .formula') && getComputedStyle(e).display !== 'inline')
      .map((e) => `${e.tagName}.${e.className} ${e.textContent.slice(0, 40)}`),
  );

for (const [width, height] of SIZES) {
  for (const theme of ['light', 'dark']) {
    for (const lang of ['en', 'pt-BR']) {
      test(`${width} × ${height}, ${theme}, ${lang}: nothing is cut off`, async ({ lab, page }, info) => {
        await page.setViewportSize({ width, height });
        await lab.open(`theme=${theme}&lang=${lang}&preset=cocota-2009-non-minimum-phase`);
        const sheet = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
        expect(sheet[0]).toBeLessThanOrEqual(width);
        if (width === 1440) expect(sheet[1]).toBeLessThanOrEqual(height);
        expect(await cutOff(page)).toEqual([]);
        for (const name of ['valve-plane', 'pole-zero', 'responses']) {
          const box = await lab.id(name).boundingBox();
          expect(box.width).toBeGreaterThan(140);
          expect(box.height).toBeGreaterThan(140);
          expect((await lab.picture(name)).ink).toBeGreaterThan(1000);
        }
        await info.attach('page', { body: await page.screenshot({ fullPage: true }), contentType: 'image/png' });
      });
    }
  }
}

test('narrow screens stack the cards in reading order', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await lab.open();
  const tops = [];
  for (const card of ['process', 'plane', 'zeros', 'rga', 'pi', 'experiment', 'responses']) {
    tops.push((await page.locator(`section.card.${card}`).boundingBox()).y);
  }
  expect(tops).toEqual([...tops].sort((a, b) => a - b));
});

test('what a finger has to hit is large enough', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await lab.open();
  const small = await page.evaluate(() =>
    [...document.querySelectorAll('button, select, input, summary, [role=slider], [role=button]')]
      .map((e) => ({ name: e.dataset.testid ?? e.textContent, box: e.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && (box.height < 24 || box.width < 16))
      .map(({ name, box }) => `${name}: ${box.width} × ${box.height}`),
  );
  expect(small.filter((s) => !/antiwindup|manual|quantised/.test(s))).toEqual([]);
});

test('the screenshot of the README', async ({ lab, page }) => {
  await lab.open('preset=johansson-2000-non-minimum-phase');
  await lab.id('pin').click();
  await lab.id('pairing-swapped').click();
  await lab.type('gain1-number', '0.3');
  await lab.type('integral1-number', '170');
  await lab.type('gain2-number', '0.28');
  await lab.type('integral2-number', '160');
  expect(await lab.text('stability')).toContain('stable');
  await page.screenshot({ path: process.env.QUADTANK_SCREENSHOT ?? 'test-results/screenshot.png' });
});
