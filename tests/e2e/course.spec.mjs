// The laboratory in the page of a course: the element, its messages, and the site without a network.
import { expect, test } from './lab.mjs';
import { lessonOf } from './lessons.mjs';
import { serve } from './server.mjs';

const heard = `
  window.heard = [];
  for (const kind of ['ready', 'state', 'answer', 'score', 'height'])
    addEventListener('quadtank-' + kind, (event) => window.heard.push({ kind, ...event.detail }));
`;
const coursePage = (site, attributes) => `<!doctype html><html lang="en"><title>Course</title><body><script>${heard}</script>
  <script type="module" src="${site}/embed.js"></script><quadtank-lab lang="en" ${attributes}></quadtank-lab>`;
const kinds = (page, kind) => page.evaluate((kind) => window.heard.filter((message) => message.kind === kind), kind);

test('the element shows a bench, grows with it, tells its state and opens another', async ({ lab, page }) => {
  // The element is loaded from another origin, as from a course page.
  const site = await serve({ open: true });
  const course = await serve({ base: '/none/', pages: { '/': coursePage(site.origin, 'bench="quadruple-tank" panels="valves,zeros" lock="gains"') } });
  await page.goto(`${course.origin}/`);
  const frame = page.frameLocator('iframe');
  await frame.locator('#bench:not(.outline)').waitFor();
  await expect.poll(async () => (await kinds(page, 'ready')).length).toBe(1);
  await expect.poll(async () => (await kinds(page, 'height')).length).toBeGreaterThan(0);
  const told = async () => (await kinds(page, 'height')).at(-1).height;
  expect(await told()).toBeGreaterThan(200);
  // The content may still be growing: the frame ends at what was told last.
  await expect.poll(async () => (await page.locator('iframe').evaluate((element) => element.clientHeight)) - (await told())).toBe(0);
  await expect(frame.getByTestId('zero-sentence').or(frame.locator('.zeros'))).toBeVisible();
  await expect(frame.locator('.rga')).toHaveCount(0);

  await frame.getByTestId('valve-handle').focus();
  await page.keyboard.press('ArrowLeft');
  await expect.poll(async () => (await kinds(page, 'state')).length).toBeGreaterThan(1);
  const states = await kinds(page, 'state');
  const label = await frame.getByTestId('valve-handle').getAttribute('aria-valuetext');
  // The first state again.
  await page.evaluate((state) => document.querySelector('quadtank-lab').open(state), states[0].state);
  await expect(frame.getByTestId('valve-handle')).not.toHaveAttribute('aria-valuetext', label);
  course.close();
  site.close();
});

test('the element tells answers and points of a lesson to its page, and to no other', async ({ lab, page }) => {
  const site = await serve({ open: true });
  const lesson = lessonOf('two-valves-one-zero');
  const course = await serve({
    base: '/none/',
    pages: {
      '/': coursePage(site.origin, `lesson="${lesson.id}"`),
      // A frame without the flag of allowed origins.
      '/stranger': `<!doctype html><html lang="en"><title>x</title><body><script>window.heard = []; addEventListener('message', (event) => window.heard.push({ kind: event.data.quadtank }));</script>
        <iframe title="lab" width="1200" height="800" src="${site.origin}/?embed=1&lang=en&lesson=${lesson.id}"></iframe>`,
    },
  });
  for (const path of ['/', '/stranger']) {
    await page.goto(`${course.origin}${path}`);
    const frame = page.frameLocator('iframe');
    await frame.getByTestId('task-predict-push-0').check();
    await frame.getByTestId('check-predict-push').click();
    await expect(frame.getByTestId('said-predict-push')).toHaveClass(/right/);
    if (path === '/') {
      await expect.poll(async () => (await kinds(page, 'answer')).at(-1)).toMatchObject({ lesson: lesson.id, task: 'predict-push', right: true });
      expect((await kinds(page, 'score')).at(-1)).toMatchObject({ lesson: lesson.id, score: 0, complete: false });
      // Who turns back to an answer, or is told something while trying, gives no answer.
      await frame.getByTestId('lesson-next').click();
      await frame.getByTestId('lesson-back').click();
      await expect(frame.getByTestId('said-predict-push')).toHaveClass(/right/);
      expect(await kinds(page, 'answer')).toHaveLength(1);
      // The frame is as high as the bench needs, within limits, and stays so.
      const told = async () => (await kinds(page, 'height')).at(-1).height;
      expect(await told()).toBeGreaterThanOrEqual(720);
      expect(await told()).toBeLessThanOrEqual(1200);
      await expect.poll(async () => (await page.locator('iframe').evaluate((element) => element.clientHeight)) - (await told())).toBe(0);
    } else {
      const told = await page.evaluate(() => window.heard.map((message) => message.kind));
      expect(told.filter((kind) => !['ready', 'height'].includes(kind))).toEqual([]);
      // What a stranger sends is not heard.
      await page.evaluate(() => frames[0].postMessage({ quadtank: 'open', state: 'damaged' }, '*'));
      await expect(frame.getByTestId('notice')).toHaveCount(0);
    }
  }
  course.close();
  site.close();
});

test('the site is there without a network, with its lessons, and says so', async ({ lab, page, context }) => {
  await lab.open();
  await page.locator('details.about summary').click();
  await expect(lab.id('offline')).toBeVisible();
  await context.setOffline(true);
  await page.goto(`${lab.origin}/?lesson=directions&lang=en`);
  await expect(lab.id('lesson')).toBeVisible();
  await page.goto(`${lab.origin}/?page=glossary&lang=en`);
  await expect(lab.id('glossary')).toBeVisible();
});
