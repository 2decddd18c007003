// What reaches the visitor, and what leaves his browser: nothing else.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Lab, expect, test } from './lab.mjs';
import { SITE } from './server.mjs';

const SINGLE = join(SITE, 'quadtank.html');

/** The address of every request from now on. */
function requests(page) {
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  return asked;
}

test('no third party is asked for anything, no cookie is left, only the last experiment is remembered', async ({ lab, page }) => {
  const asked = requests(page);
  await lab.open();
  const remembered = () => page.evaluate(() => Object.keys(localStorage));
  expect(await remembered()).toEqual([]);
  await lab.id('gamma1').fill('0.3');
  await expect.poll(remembered).toEqual(['quadtank-last']);
  expect([...new Set(asked.map((url) => new URL(url).origin))]).toEqual([lab.origin]);
  expect(await page.context().cookies()).toEqual([]);
});

test('the page carries its policy, before anything that it rules', async ({ lab, page }) => {
  await lab.open();
  const policies = await page.locator('meta[http-equiv="Content-Security-Policy"]').all();
  expect(policies).toHaveLength(1);
  const policy = await policies[0].getAttribute('content');
  expect(policy).toContain("default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self';");
  expect(policy).not.toContain('unsafe-inline');
  const loadsBefore = await policies[0].evaluate((tag) =>
    [...document.querySelectorAll('link, script, style')].filter((e) => tag.compareDocumentPosition(e) & Node.DOCUMENT_POSITION_PRECEDING).length,
  );
  expect(loadsBefore).toBe(0);
});

test('the single file loads nothing, and its policy names its parts by hash', async ({ lab, page }) => {
  const asked = requests(page);
  const address = `${pathToFileURL(SINGLE).href}?view=full`;
  await page.goto(address);
  await lab.ready();
  await lab.id('gamma1').fill('0.3');
  await lab.settle();
  expect(asked.filter((url) => !/^(data|blob):/.test(url))).toEqual([address]);
  const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute('content');
  expect(policy).toMatch(/^default-src 'none'; script-src 'sha256-[^']+' 'wasm-unsafe-eval'; style-src 'sha256-[^']+';/);
  expect(policy).not.toMatch(/unsafe-inline|connect-src/);
});

test('the download is the single file', async ({ lab, page }) => {
  await lab.open();
  await lab.id('file-menu').locator('summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('single-file').click()]);
  expect(download.suggestedFilename()).toBe('quadtank.html');
  expect(readFileSync(await download.path()).equals(readFileSync(SINGLE))).toBe(true);
});

test('axe finds nothing before the laboratory has arrived', async ({ lab, page }) => {
  let release;
  const held = new Promise((done) => (release = done));
  await page.route('**/*.wasm', async (route) => {
    await held;
    await route.continue();
  });
  await page.goto(`${lab.origin}/`);
  await expect(page.locator('#loading')).toBeVisible();
  await lab.axe();
  release();
  await lab.ready();
});

for (const deviceScaleFactor of [1, 1.5, 2, 3]) {
  test(`pictures are as sharp as a screen with ${deviceScaleFactor} pixels for each CSS pixel`, async ({ browser, lab, complaints }) => {
    const context = await browser.newContext({ deviceScaleFactor, viewport: { width: 1440, height: 900 } });
    const sharp = new Lab(await context.newPage(), lab.origin, complaints);
    sharp.watch(sharp.page);
    await sharp.open();
    for (const name of ['valve-plane', 'pole-zero', 'responses']) {
      const pixels = await sharp.id(name).evaluate((canvas) => canvas.width / canvas.getBoundingClientRect().width);
      expect(Math.abs(pixels - deviceScaleFactor)).toBeLessThan(0.02);
    }
    await context.close();
  });
}
