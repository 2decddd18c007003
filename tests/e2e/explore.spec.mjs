// The first visit: what a student who knows no control theory can do, and what the page says to it.
import { expect, test } from './lab.mjs';

/** Drags a handle by so many CSS px. */
async function drag(page, lab, name, right, down) {
  const from = await lab.middle(name);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + right, from.y + down, { steps: 5 });
  await page.mouse.up();
  await lab.settle();
}

const level = (lab, k) => lab.number(`rig-level-${k}`);

test('a first visit begins with Explore, and three things to try lead to three discoveries', async ({ lab, page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await lab.open('lang=en&view=explore');
  await expect(lab.id('levels')).toBeVisible();
  await expect(lab.id('gamma1')).toHaveCount(0);
  await expect(lab.id('discovery')).toContainText('Nothing can break');
  expect(await lab.text('levels-sentence')).toMatch(/^Level 1 settles \(to 2\s%\) 51.2 s after its step/);
  await lab.axe();

  // One: ask for more water in tank 2.
  const before = await level(lab, 2);
  await drag(page, lab, 'mark2', 0, -25);
  await expect(lab.id('prompt-water')).toHaveClass('done');
  await expect(lab.id('discovery')).toContainText('a controller opens its pump');
  expect(await level(lab, 2)).toBeGreaterThan(before + 0.5);

  // Two: beyond the line the same controllers fight.
  await drag(page, lab, 'valve-handle', -60, 60);
  await expect(lab.id('prompt-valves')).toHaveClass('done');
  await expect(lab.id('discovery')).toContainText('fight each other');
  await expect(lab.id('whom')).toContainText('the wrong one');

  // Three: swapped, but still too eager; calmer gains are one click away, and then the time axis fits the slow loop.
  await lab.id('swap').click();
  await expect(lab.id('prompt-swap')).toHaveClass('done');
  await expect(lab.id('whom')).toContainText('too eager');
  await lab.id('calm').click();
  await expect(lab.id('whom')).toContainText('the right one');
  await expect(lab.id('discovery')).toContainText('It works again, but slowly');
  await expect(lab.id('levels-sentence')).toContainText('settles');
  await lab.axe();
  await lab.clean();
});

test('the marks stop at what the tanks can hold, by keyboard too', async ({ lab, page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await lab.open('lang=en&view=explore');
  await lab.id('mark1').focus();
  await page.keyboard.press('End');
  await lab.settle();
  expect(await lab.id('mark1').getAttribute('aria-valuetext')).toBe('20.00 cm');
  await page.keyboard.press('Home');
  await lab.settle();
  expect(await lab.id('mark1').getAttribute('aria-valuetext')).toBe('0.00 cm');
  await page.keyboard.press('ArrowUp');
  await lab.settle();
  expect(await lab.id('mark1').getAttribute('aria-valuetext')).toBe('0.01 cm');
});

test('levels are held while the valves turn, unless it is switched off or no pumps can', async ({ lab, page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await lab.open('lang=en&view=explore');
  const mark = async () => parseFloat(await lab.id('mark2').getAttribute('aria-valuetext'));
  const rest = await mark();
  await drag(page, lab, 'valve-handle', -60, 60);
  expect(await mark()).toBeCloseTo(rest, 2);
  await lab.id('hold-levels').uncheck();
  await drag(page, lab, 'valve-handle', -10, 10);
  expect(Math.abs((await mark()) - rest)).toBeGreaterThan(0.1);
  // On the line itself: its own words, and nothing is ticked.
  await lab.open('lang=en&view=explore&preset=johansson-2000-minimum-phase');
  await lab.id('drawer-numbers').click();
  await lab.type('gamma1-number', '0.6');
  await lab.type('gamma2-number', '0.4');
  await expect(lab.id('prompt-valves')).not.toHaveClass('done');
  await expect(lab.id('whom')).toContainText('Neither way is better');
  await lab.clean();
});

test('the lecture hall sees the four pictures at once, and Esc ends it', async ({ lab, page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  for (const [width, height] of [[1280, 720], [960, 540], [1920, 1080]]) {
    await page.setViewportSize({ width, height });
    for (const [view, pictures] of [['explore', ['rig', 'levels', 'valve-map', 'whom']], ['lab', ['rig', 'responses', 'valve-plane', 'lambda-11']]]) {
      await lab.open(`lang=en&view=${view}`);
      await page.keyboard.press('f');
      await lab.settle();
      await expect(page.locator('header.top')).toBeHidden();
      for (const name of pictures) await expect(lab.id(name), `${view} ${width}: ${name}`).toBeInViewport({ ratio: 0.99 });
      expect(await page.evaluate(() => document.scrollingElement.scrollHeight)).toBeLessThanOrEqual(height);
      await page.keyboard.press('Escape');
      await expect(page.locator('header.top')).toBeVisible();
    }
  }
});

test('in a browser that is zoomed in to 150 % the rig is whole, with the levels beside it', async ({ lab, page }) => {
  await page.setViewportSize({ width: 960, height: 600 });
  await lab.open('lang=en&view=explore');
  const [rig, levels] = [await lab.id('rig').boundingBox(), await lab.id('levels').boundingBox()];
  expect(rig.height).toBeLessThan(600);
  expect(levels.x).toBeGreaterThan(rig.x + rig.width);
  expect(levels.y).toBeLessThan(rig.y + rig.height / 2);
});

test('a bench without a layout for the lecture hall offers none', async ({ lab, page }) => {
  await lab.open('lang=en&bench=relay-tuning');
  await expect(lab.id('present')).toBeHidden();
  await page.keyboard.press('f');
  await lab.settle();
  await expect(page.locator('header.top')).toBeVisible();
});

test('a run is drawn as time passes, and stands whole for who prefers less motion', async ({ lab, page }) => {
  await lab.open('lang=en&view=explore');
  await lab.id('replay-length').selectOption('6');
  await expect(lab.id('replay')).toContainText('pause');
  const early = await lab.picture('levels');
  const low = await level(lab, 1);
  await expect(lab.id('replay')).toContainText('play', { timeout: 20_000 });
  const whole = await lab.picture('levels');
  expect(whole.ink).toBeGreaterThan(early.ink);
  expect(await level(lab, 1)).not.toBe(low);
  // After a change it runs again, also after it was stopped.
  await lab.id('replay').click();
  await lab.id('replay').click();
  await expect(lab.id('replay')).toContainText('play');
  await drag(page, lab, 'mark1', 0, -20);
  await expect(lab.id('replay')).toContainText('pause');
  await expect(lab.id('replay')).toContainText('play', { timeout: 20_000 });
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await lab.id('swap').click();
  await page.waitForTimeout(1200);
  await expect(lab.id('replay')).toContainText('play');
});

test('everything else is folded, opens in place and works', async ({ lab, page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await lab.open('lang=en&view=explore');
  for (const drawer of ['why', 'gains', 'controllers', 'disturb', 'numbers']) await lab.id(`drawer-${drawer}`).click();
  await lab.settle();
  await lab.type('gamma1-number', '0.3');
  await lab.type('gamma2-number', '0.3');
  expect(await lab.number('lambda-11')).toBeLessThan(0);
  await lab.id('try-hard').click();
  await lab.settle();
  const [one, two] = [await lab.value('step1-number'), await lab.value('step2-number')];
  expect(Math.hypot(one, two)).toBeCloseTo(2, 1);
  expect(Math.sign(one * two)).toBe(-1);
  await lab.id('try-easy').click();
  await lab.settle();
  expect(Math.sign((await lab.value('step1-number')) * (await lab.value('step2-number')))).toBe(1);
  await lab.axe();
  await lab.clean();
});

test('how much is shown is remembered, and a link says it', async ({ lab, page }) => {
  await page.goto(`${lab.origin}/?lang=en`);
  await lab.ready();
  await expect(page.locator('html')).toHaveAttribute('data-view', 'explore');
  await lab.id('view-lab').click();
  await expect(lab.id('gamma1')).toBeVisible();
  await expect(page.locator('.card.experiment')).toBeHidden();
  await page.goto(`${lab.origin}/?lang=en`);
  await lab.ready();
  await expect(page.locator('html')).toHaveAttribute('data-view', 'lab');
  await lab.type('gamma1-number', '0.55');
  await expect.poll(() => page.url()).toMatch(/view=lab#lab=/);
  // A link of before there was a choice shows every card.
  const fragment = new URL(page.url()).hash;
  await page.goto('about:blank');
  await page.goto(`${lab.origin}/${fragment}`);
  await lab.ready();
  await expect(page.locator('.card.experiment')).toBeVisible();
  expect(await lab.value('gamma1-number')).toBe(0.55);
});

test.describe('on a phone', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  test('what to try and the rig are seen at once, and handles are as large as a finger', async ({ lab, page }) => {
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await lab.open('lang=en&view=explore');
    await expect(lab.id('prompt-water')).toBeInViewport();
    await expect(lab.id('mark1')).toBeInViewport();
    for (const name of ['mark1', 'valve1', 'valve-handle']) {
      const { width, height } = await lab.id(name).locator('.touch').boundingBox();
      expect(Math.min(width, height), name).toBeGreaterThanOrEqual(43.5);
    }
    const client = await page.context().newCDPSession(page);
    const touch = (type, x, y) => client.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x, y }] });
    const from = await lab.middle('mark1');
    await touch('touchStart', from.x, from.y);
    for (let k = 1; k <= 6; k += 1) await touch('touchMove', from.x, from.y - 5 * k);
    await touch('touchEnd');
    await lab.settle();
    await expect(lab.id('prompt-water')).toHaveClass('done');
    expect(await page.evaluate(() => scrollX + document.scrollingElement.scrollWidth)).toBe(390);
  });
});

test('valves that are turned slowly across the line keep their place and a run', async ({ lab, page }) => {
  await lab.open('lang=en&view=explore');
  await expect(page.getByRole('checkbox', { name: /hold the levels/ })).toBeChecked();
  const handle = lab.id('valve-handle');
  const from = await handle.boundingBox();
  const plane = await handle.evaluate((e) => { const { x, y, width, height } = e.closest('svg').getBoundingClientRect(); return { x, y, width, height }; });
  let [x, y] = [from.x + from.width / 2, from.y + from.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 0; k < 40; k += 1) {
    [x, y] = [x - 2, y + 1.5];
    await page.mouse.move(x, y);
    await lab.settle();
    const box = await handle.boundingBox();
    expect(Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y), `step ${k}`).toBeLessThan(8);
    expect(box.x).toBeGreaterThan(plane.x - 30);
    expect(await lab.text('levels-sentence'), `step ${k}`).not.toContain('no operating point');
  }
  await page.mouse.up();
  await lab.settle();
  expect(await level(lab, 1)).toBeGreaterThan(0);
  await lab.clean();
});

test('the tour frames one thing after the other and ends where one likes', async ({ lab, page }) => {
  for (const view of ['explore', 'full']) {
    await lab.open(`lang=en&view=${view}`);
    await page.locator('.about > summary').click();
    await lab.id('begin-tour').click();
    const framed = new Set();
    for (let stop = 1; stop <= 5; stop += 1) {
      expect(await lab.text('tour-place')).toBe(`${stop} of 5`);
      await expect(page.locator('.framed')).toHaveCount(1);
      framed.add(await page.locator('.framed').evaluate((element) => element.className));
      if (stop === 2) await lab.axe();
      await page.keyboard.press('Enter');
    }
    expect(framed.size).toBe(5);
    await expect(lab.id('tour')).toBeHidden();
    await expect(page.locator('.framed')).toHaveCount(0);
  }
  await page.locator('.about > summary').click();
  await lab.id('begin-tour').click();
  await page.keyboard.press('Escape');
  await expect(lab.id('tour')).toBeHidden();
});

test('marks of the least and the highest level stay on the walls on every bench', async ({ lab, page }) => {
  const marks = (rig) => lab.id(rig).locator('.ghost');
  await lab.open('preset=johansson-2000-minimum-phase');
  await expect(marks('rig')).toHaveCount(0);
  await lab.type('step1-number', '3');
  await lab.settle();
  expect(await marks('rig').count()).toBeGreaterThanOrEqual(2);
  await lab.open('bench=model-free');
  expect(await marks('free-rig').count()).toBe(8);
  // With the band of averaging two more.
  await lab.open('bench=level-loop');
  await expect(marks('level-rig')).toHaveCount(2);
  const places = () => marks('level-rig').evaluateAll((paths) => paths.map((path) => path.getAttribute('d')));
  const before = await places();
  await lab.type('level-gain-number', '2');
  await lab.settle();
  expect(await places()).not.toEqual(before);
  await lab.clean();
});
