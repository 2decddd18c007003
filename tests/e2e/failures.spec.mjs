// What the page says when a part of it does not arrive or its program stops, and how the experiment gets out.
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Lab, expect, test } from './lab.mjs';
import { SITE, serve } from './server.mjs';

const SINGLE = join(SITE, 'quadtank.html');
/** The sentence about a laboratory that is late appears after 8 s. */
const LATE = { timeout: 20_000 };

/**
 * Makes traps possible on pages that load from now on. `trap()` asks the program for more memory than there is, to which it
 * answers with `unreachable`; `trapInside()` lets it do so when it next sets a text or HTML, with the program on the stack.
 */
async function allowTraps(page) {
  await page.addInitScript(() => {
    const keep = (make) => async (...given) => {
      const made = await make(...given);
      window.program = (made.instance ?? made).exports;
      return made;
    };
    WebAssembly.instantiateStreaming = keep(WebAssembly.instantiateStreaming.bind(WebAssembly));
    WebAssembly.instantiate = keep(WebAssembly.instantiate.bind(WebAssembly));
    window.trap = () => window.program.__wbindgen_malloc(0xffffffff, 1);
    window.trapInside = () => {
      const setters = [[Node.prototype, 'nodeValue'], [Node.prototype, 'textContent'], [CharacterData.prototype, 'data'], [Element.prototype, 'innerHTML']];
      const before = setters.map(([type, name]) => Object.getOwnPropertyDescriptor(type, name));
      const set = () => {
        setters.forEach(([type, name], k) => Object.defineProperty(type, name, before[k]));
        window.trap();
      };
      for (const [type, name] of setters) Object.defineProperty(type, name, { configurable: true, set });
    };
  });
}

/** What Chromium says of a file that is missing or blocked, and of what was loaded ahead and is not used after all. */
const NOT_YET_USED = /^console warning: The resource .* was preloaded/;
const NOT_LOADED = new RegExp(`^console error: Failed to load resource|^failed: .*\\.js$|${NOT_YET_USED.source}`);
const TRAP = /^error: .*unreachable/;
/** What the page had still planned when it stopped finds the task queue as the trap left it. */
const AFTER_TRAP = /RefCell already borrowed/;

/** The page has stopped: the notice is there, and nothing else takes the focus or a click. */
async function hasStopped(lab) {
  await expect(lab.id('stopped')).toBeVisible();
  const others = await lab.id('stopped').evaluate((notice) => [...notice.parentElement.children].filter((part) => part !== notice).map((part) => part.inert));
  expect(others.length).toBeGreaterThan(2);
  expect(others).not.toContain(false);
}

for (const [name, fulfil] of [
  ['is missing', (route) => route.fulfill({ status: 404 })],
  ['is blocked', (route) => route.abort()],
  ['does not end', () => undefined],
]) {
  test(`without start.js, because it ${name}, a sentence says what to do`, async ({ lab, page }) => {
    await page.route('**/start.js', fulfil);
    await page.goto(`${lab.origin}/`, { waitUntil: 'commit' });
    await expect(page.locator('#loading')).toBeVisible();
    await expect(page.locator('#late')).toBeHidden();
    await expect(page.locator('#late')).toBeVisible(LATE);
    await expect(page.locator('#late')).toContainText('reload the page');
    await expect(page.locator('#late')).toContainText('recarregue a página');
    await lab.axe();
    if (name !== 'does not end') lab.provoked(NOT_LOADED);
  });
}

for (const file of ['*.wasm', 'quadtank-lab*.js']) {
  test(`a download of ${file} that hangs is told, and the laboratory still comes when it ends`, async ({ lab, page }) => {
    let release;
    const held = new Promise((done) => (release = done));
    await page.route(`**/${file}`, async (route) => {
      await held;
      await route.continue();
    });
    await page.goto(`${lab.origin}/`, { waitUntil: 'commit' });
    await expect(page.locator('#late')).toBeVisible(LATE);
    release();
    await lab.ready();
    await expect(page.locator('#late')).toHaveCount(0);
    // The wait is long enough for Chromium to wonder about the part that did arrive, on some machines.
    lab.tolerate(NOT_YET_USED);
  });
}

test('a script that does not arrive is told at once', async ({ lab, page }) => {
  await page.route('**/quadtank-lab*.js', (route) => route.fulfill({ status: 404 }));
  await page.goto(`${lab.origin}/`);
  await expect(page.getByText('could not be loaded')).toBeVisible();
  await expect(page.locator('#late')).toHaveCount(0);
  await lab.axe();
  lab.provoked(NOT_LOADED);
});

test('a trap inside the program is told, and the experiment is saved as it was', async ({ lab, page, context }) => {
  await allowTraps(page);
  await lab.open('lang=en');
  await lab.type('gamma1-number', '0.35');
  await expect(lab.id('stopped')).toBeHidden();
  // What is kept for this is at most a second old.
  await page.waitForTimeout(1500);
  await page.evaluate(() => window.trapInside());
  await lab.id('gamma2').focus();
  await page.keyboard.press('ArrowLeft');
  await hasStopped(lab);
  await expect(lab.id('stopped')).toContainText('has stopped');
  await lab.axe();

  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('stopped-save').click()]);
  expect(download.suggestedFilename()).toBe('quadtank-experiment.json');
  const saved = JSON.parse(await readFile(await download.path(), 'utf8'));
  expect(saved.setup.valves[0]).toBe(0.35);

  const link = await lab.id('stopped-link').inputValue();
  const other = new Lab(await context.newPage(), lab.origin, lab.complaints);
  await other.page.goto(link);
  await other.ready();
  expect(await other.value('gamma1-number')).toBe(0.35);
  await other.id('open-input').setInputFiles(await download.path());
  await other.settle();
  expect(await other.value('gamma1-number')).toBe(0.35);
  lab.provoked(TRAP);
  lab.tolerate(AFTER_TRAP);
});

test('after a trap the laboratory starts again, without the link that it stopped at', async ({ lab, page }) => {
  await allowTraps(page);
  await lab.open('lang=pt-BR');
  await lab.type('gamma1-number', '0.35');
  await page.waitForTimeout(1500);
  const link = await lab.id('stopped-link').inputValue();
  // The address follows what is done: the link is of before.
  await lab.type('gamma1-number', '0.45');
  await expect.poll(() => page.url()).not.toContain(new URL(link).hash);
  await page.evaluate(() => setTimeout(() => window.trap()));
  await hasStopped(lab);
  await expect(lab.id('stopped')).toContainText('O laboratório parou');
  // A link that is pasted into the address is opened.
  await page.evaluate((fragment) => (location.hash = fragment), new URL(link).hash);
  await expect(lab.id('stopped')).toBeHidden();
  await lab.ready();
  expect(await lab.value('gamma1-number')).toBe(0.35);
  await page.evaluate(() => setTimeout(() => window.trap()));
  await hasStopped(lab);
  await lab.id('again').click();
  await expect(lab.id('stopped')).toBeHidden();
  await lab.ready();
  expect(await lab.value('gamma1-number')).toBe(0.7);
  expect(page.url()).not.toContain('#');
  lab.provoked(TRAP);
});

test('what is kept is of the bench that is shown, and follows it', async ({ lab, page }) => {
  await lab.open();
  const kept = async () => JSON.parse(decodeURIComponent((await lab.id('stopped-save').getAttribute('href'))?.split(/,(.*)/s)[1] ?? 'null'));
  await expect.poll(async () => (await kept())?.setup?.valves, { timeout: 5000 }).toEqual([0.7, 0.6]);
  await lab.bench('relay-tuning');
  await expect.poll(async () => (await kept()).tuning?.plant, { timeout: 5000 }).toEqual({ published: 'wood-berry' });
  await lab.bench('model-free');
  await expect.poll(async () => (await kept()).version, { timeout: 5000 }).toBe(3);
});

test('a trap in a promise is told in an embedded bench too', async ({ lab, page }) => {
  await allowTraps(page);
  await lab.open('embed=1&theme=dark');
  await page.evaluate(() => void Promise.resolve().then(() => window.trap()));
  await hasStopped(lab);
  await lab.axe();
  lab.provoked(TRAP);
});

test('an error that is no trap does not stop the laboratory', async ({ lab, page }) => {
  await lab.open();
  await page.evaluate(() => setTimeout(() => null.nothing));
  await page.evaluate(() => void Promise.reject(new Error('of an extension')));
  await lab.type('gamma1-number', '0.3');
  await expect(lab.id('stopped')).toBeHidden();
  expect(await lab.number('lambda-11')).toBeLessThan(0);
  lab.provoked(/^error: .*null/, /^error: of an extension/);
});

test('a trap at the start is told although the page is empty by then', async ({ lab, page }) => {
  await allowTraps(page);
  await page.addInitScript(() => window.trapInside());
  await page.goto(`${lab.origin}/#lab=q2.A`);
  await expect(page.getByText('The laboratory stopped at an error')).toBeVisible();
  await expect(page.getByText('O laboratório parou por um erro')).toBeVisible();
  await lab.axe();
});

test('a trap is told in the single file, from the disk and in a sandboxed frame', async ({ lab, page }) => {
  await allowTraps(page);
  await page.goto(pathToFileURL(SINGLE).href);
  await lab.ready();
  await page.waitForTimeout(1500);
  await page.evaluate(() => setTimeout(() => window.trap()));
  await hasStopped(lab);
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('stopped-save').click()]);
  expect(JSON.parse(await readFile(await download.path(), 'utf8')).version).toBe(1);
  await lab.id('again').click();
  await expect(lab.id('stopped')).toBeHidden();
  await lab.ready();

  const course = await serve({ pages: { '/course': '<title>c</title><iframe title="lab" sandbox="allow-scripts" width="1200" height="800" src="/quadtank.html"></iframe>' } });
  await page.goto(`${course.origin}/course`);
  const frame = page.frames()[1];
  await frame.locator('#bench:not(.outline)').waitFor();
  await page.waitForTimeout(1500);
  await frame.evaluate(() => setTimeout(() => window.trap()));
  await expect(frame.getByTestId('stopped')).toBeVisible();
  // Such a frame may not hand over a file; the link can be copied.
  expect(await frame.getByTestId('stopped-link').inputValue()).toMatch(/#lab=q/);
  await frame.getByTestId('again').click();
  await expect(frame.getByTestId('stopped')).toBeHidden();
  await frame.locator('#bench:not(.outline)').waitFor();
  course.close();
  lab.provoked(TRAP);
});
