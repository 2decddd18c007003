// Opening the laboratory in Chromium, and moving its controls as a hand does.
import { createRequire } from 'node:module';
import { progress } from './report.mjs';

const playwright = createRequire(new URL('../../tests/e2e/package.json', import.meta.url))('@playwright/test');

export const CHROMIUM_FLAGS = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];

/** The names of the entries that the page makes (src/timing.rs). */
export const MEASURES = { compute: 'quadtank:compute', paint: 'quadtank:paint', words: 'quadtank:words' };

/** Opens an empty page in a new browser, hands it to `work` with a session of the developer tools, and closes it. */
export async function inBrowser(flags, work) {
  const browser = await playwright.chromium.launch({ executablePath: process.env.CHROMIUM, args: [...CHROMIUM_FLAGS, ...flags] });
  try {
    const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
    page.on('pageerror', (error) => progress(`the page reports ${error}`));
    return await work(page, await page.context().newCDPSession(page));
  } finally {
    await browser.close();
  }
}

/** Goes to a bench of the laboratory and waits until it is there. */
export async function open(page, url) {
  await page.goto(url);
  await page.locator('#bench:not(.outline)').waitFor();
}

export const clearMeasures = (page) => page.evaluate(() => performance.clearMeasures());

/** Durations (ms) of the entries since they were cleared. */
export const readMeasures = (page) =>
  page.evaluate(
    (names) =>
      Object.fromEntries(
        Object.entries(names).map(([key, name]) => [key, performance.getEntriesByName(name, 'measure').map((m) => m.duration)]),
      ),
    MEASURES,
  );

/** Drags the thumb of a slider to and fro with the mouse. */
export const dragSlider = (name) => async (page, moves) => {
  const slider = page.getByTestId(name);
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await slider.boundingBox();
  // Away from the ends, where a tank runs dry and there is less to compute.
  const to = (move) => page.mouse.move(x + width * (0.5 + 0.35 * Math.sin(move / 17)), y + height / 2);
  await to(0);
  await page.mouse.down();
  for (let move = 0; move < moves; move += 1) await to(move);
  await page.mouse.up();
  await page.waitForTimeout(300);
};

/** Sets a slider by script, to one position after the other, each when the charts of the one before are painted. */
export const setSlider = (page, name, positions) =>
  page.getByTestId(name).evaluate(async (slider, all) => {
    for (const position of all) {
      slider.value = String(position);
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise(requestAnimationFrame);
      // An event inside the frame would come before the page computes that of the frame, and replace it.
      await new Promise((done) => setTimeout(done));
    }
    await new Promise((done) => setTimeout(done, 300));
  }, positions);

/** Drags a handle around a place of its drawing, given with the radii as shares of the drawing. */
export const dragHandle = (name, [x, y], [across, up]) => async (page, moves) => {
  const handle = page.getByTestId(name);
  const plane = await handle.evaluate((point) => {
    const { x, y, width, height } = point.closest('svg').getBoundingClientRect();
    return { x, y, width, height };
  });
  const at = await handle.boundingBox();
  await page.mouse.move(at.x + at.width / 2, at.y + at.height / 2);
  await page.mouse.down();
  for (let move = 0; move < moves; move += 1) {
    const right = plane.x + plane.width * (x + across * Math.cos(move / 23));
    const down = plane.y + plane.height * (y + up * Math.sin(move / 17));
    await page.mouse.move(right, down);
  }
  await page.mouse.up();
  await page.waitForTimeout(300);
};
