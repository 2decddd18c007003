// Where the laboratory has to run besides its own address: sub-paths, frames, one file, and pages that are not ready.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Lab, expect, test } from './lab.mjs';
import { SITE, serve } from './server.mjs';

const SINGLE = join(SITE, 'quadtank.html');

async function works(frame) {
  await frame.locator('#bench:not(.outline)').waitFor();
  // A page that is no frame of a course begins with Explore.
  const full = frame.getByTestId('view-full');
  if (await full.isVisible()) await full.click();
  await frame.getByTestId('gamma1').fill('0.3');
  await expect(frame.getByTestId('lambda-11')).toContainText('−');
}

for (const path of ['/a/b/', '/a/b/index.html']) {
  test(`under a sub-path (${path})`, async ({ lab, page }) => {
    const site = await serve({ base: '/a/b/' });
    await page.goto(`${site.origin}${path}?lang=en`);
    await works(page);
    await lab.clean();
    site.close();
  });
}

test('in a frame of another origin', async ({ lab, page }) => {
  const course = await serve({ pages: { '/course': `<title>c</title><iframe title="lab" width="1200" height="800" src="${lab.origin}/?embed=1"></iframe>` }, base: '/none/' });
  await page.goto(`${course.origin}/course`);
  await works(page.frameLocator('iframe'));
  course.close();
});

test('in a sandboxed frame, from a server that allows it, without storage', async ({ page, lab }) => {
  const site = await serve({ open: true });
  const course = await serve({ pages: { '/course': `<title>c</title><iframe title="lab" sandbox="allow-scripts" width="1200" height="800" src="${site.origin}/"></iframe>` }, base: '/none/' });
  await page.goto(`${course.origin}/course`);
  const frame = page.frameLocator('iframe');
  await works(frame);
  await frame.getByTestId('theme').click();
  await frame.getByTestId('share').click();
  await expect(frame.getByTestId('link')).toHaveValue(/#lab=/);
  expect(lab.complaints).toEqual([]);
  site.close();
  course.close();
});

test('the single file opens from the disk', async ({ lab, page }) => {
  await page.goto(pathToFileURL(SINGLE).href);
  await lab.ready();
  await works(page);
  await expect(lab.id('single-file')).toHaveCount(0);
  await lab.clean();
});

test('the single file works in a sandboxed frame', async ({ page, lab }) => {
  const course = await serve({ pages: { '/course': '<title>c</title><iframe title="lab" sandbox="allow-scripts" width="1200" height="800" src="/quadtank.html"></iframe>' } });
  await page.goto(`${course.origin}/course`);
  await works(page.frameLocator('iframe'));
  expect(lab.complaints).toEqual([]);
  course.close();
});

test('the single file works where a page brings it along', async ({ page, lab }) => {
  const text = readFileSync(SINGLE, 'utf8').replaceAll('&', '&amp;').replaceAll('"', '&quot;');
  const course = await serve({ pages: { '/course': `<title>c</title><iframe title="lab" sandbox="allow-scripts" width="1200" height="800" srcdoc="${text}"></iframe>` } });
  await page.goto(`${course.origin}/course`);
  const frame = page.frameLocator('iframe');
  await works(frame);
  await frame.getByTestId('language').selectOption('pt-BR');
  await expect(frame.getByTestId('lambda-11')).toContainText(',');
  expect(lab.complaints).toEqual([]);
  course.close();
});

test('the site offers the single file beside it', async ({ lab }) => {
  await lab.open();
  await lab.id('file-menu').locator('summary').click();
  await expect(lab.id('single-file')).toHaveAttribute('href', 'quadtank.html');
  expect(existsSync(SINGLE)).toBe(true);
});

test('the first paint comes before the laboratory', async ({ lab, page }) => {
  let release;
  const held = new Promise((done) => (release = done));
  await page.route('**/*.wasm', async (route) => {
    await held;
    await route.continue();
  });
  await page.goto(`${lab.origin}/`);
  await expect(page.getByRole('heading', { name: 'Quadtank' })).toBeVisible();
  await expect(page.locator('#loading')).toBeVisible();
  expect(await page.locator('.outline .card').count()).toBeGreaterThan(4);
  release();
  await lab.ready();
  await expect(page.locator('.outline')).toHaveCount(0);
});

test('without JavaScript a sentence says what is needed', async ({ browser, lab }) => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  for (const name of ['', 'quadtank.html']) {
    await page.goto(`${lab.origin}/${name}`);
    // Searches by text pass over <noscript>.
    const sentence = page.locator('noscript .notice');
    await expect(sentence).toBeVisible();
    await expect(sentence).toContainText('needs JavaScript and WebAssembly');
    await expect(sentence).toContainText('precisa de JavaScript e WebAssembly');
  }
  await context.close();
});

test('without WebAssembly a sentence says what is needed', async ({ lab, page }) => {
  await page.addInitScript(() => delete globalThis.WebAssembly);
  for (const name of ['', 'quadtank.html']) {
    await page.goto(`${lab.origin}/${name}`);
    await expect(page.getByText('This browser has no WebAssembly')).toBeVisible();
    await expect(page.getByText('Este navegador não tem WebAssembly')).toBeVisible();
  }
});

test('a laboratory that does not arrive is explained', async ({ browser, lab }) => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.route('**/*.wasm', (route) => route.abort());
  await page.goto(`${lab.origin}/`);
  await expect(page.getByText('could not be loaded')).toBeVisible();
  await context.close();
});

test('a second laboratory on another page does not disturb the first', async ({ lab, context }) => {
  await lab.open();
  const second = new Lab(await context.newPage(), lab.origin, lab.complaints);
  await second.open('preset=cocota-2009-non-minimum-phase');
  expect(await second.number('lambda-11')).toBeCloseTo(-1.32, 2);
  expect(await lab.number('lambda-11')).toBeCloseTo(1.4, 2);
});

for (const [path, base] of [
  ['//evil.example/a/', '//evil.example/a/'],
  ['//evil.example/index.html', '//evil.example/'],
  ['/%5Cevil.example/', '/%5Cevil.example/'],
]) {
  test(`a path that looks like a host (${path}) leads nowhere else`, async ({ lab, page, context }) => {
    const site = await serve({ base });
    await page.goto(`${site.origin}${path}?embed=1`);
    await lab.ready();
    await lab.type('gamma1-number', '0.52');
    const target = () => lab.id('full-lab').evaluate((anchor) => anchor.href);
    expect(await target()).toBe(`${site.origin}${path}?`);
    const [opened] = await Promise.all([context.waitForEvent('page'), lab.id('full-lab').click()]);
    const whole = new Lab(opened, site.origin, lab.complaints);
    await whole.ready();
    // Language, theme and how much is shown go along.
    const query = '?lang=en&theme=light&view=full';
    expect(opened.url().split('#')[0]).toBe(`${site.origin}${path}${query}`);
    expect(await whole.value('gamma1-number')).toBe(0.52);
    // The address follows to another bench under such a path as well.
    await whole.bench('relay-tuning');
    expect(opened.url()).toBe(`${site.origin}${path}${query.replace('&view=full', '')}&bench=relay-tuning&view=full`);
    site.close();
  });
}
