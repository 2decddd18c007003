// Lessons as students take them: played to full marks, beside the bench, with work and the way back kept.
import { readFileSync } from 'node:fs';

import { expect, test } from './lab.mjs';
import { Finger, Keyboard, LESSONS, lessonOf, play } from './lessons.mjs';

/** The seed of the student follows from this. */
const STUDENT = 0.271828;

async function begin(lab, lesson, { step = 1, lang = 'en', bench = '' } = {}) {
  await lab.page.addInitScript((student) => { Math.random = () => student; }, STUDENT);
  await lab.page.goto(`${lab.origin}/?${bench}lesson=${lesson.id}&step=${step}&lang=${lang}`);
  await lab.id('lesson').waitFor();
  await lab.settle();
}

const seed = Math.trunc(STUDENT * 1e6);

for (const lesson of LESSONS) {
  test(`${lesson.id} is played to full marks by keyboard alone, without a fault of access`, async ({ lab }) => {
    test.setTimeout(180_000);
    await begin(lab, lesson);
    await play(lab, new Keyboard(lab), lesson, seed, async () => lab.axe());
    await expect(lab.id('report').getByRole('heading', { level: 2 })).toBeFocused();
    await expect(lab.id('report')).toContainText('10 of 10 points');
    await lab.clean();
  });
}

test.describe('on a phone', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  for (const lesson of LESSONS) {
    test(`${lesson.id} is played by touch`, async ({ lab, page }) => {
      test.setTimeout(180_000);
      await begin(lab, lesson);
      await play(lab, new Finger(lab), lesson, seed, async (index) => {
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        expect(overflow, `step ${index + 1} is as wide as the phone`).toBeLessThanOrEqual(0);
      });
      await expect(lab.id('report')).toContainText('10 of 10 points');
    });
  }
});

test.describe('on a phone, step by step', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  test('a step begins with the top of its bench, and what is said of an answer comes into sight', async ({ lab, page }) => {
    await begin(lab, lessonOf('two-valves-one-zero'));
    const desk = page.locator('.desk > div:visible');
    await desk.evaluate((element) => { element.scrollTop = 300; });
    expect(await desk.evaluate((element) => element.scrollTop)).toBe(300);
    const lesson = lessonOf('two-valves-one-zero');
    for (const task of lesson.steps[0].tasks) {
      await lab.id(`task-${task.id}-0`).tap();
      await lab.id(`check-${task.id}`).tap();
    }
    await lab.id('lesson-next').tap();
    await expect(lab.id('step-title')).toContainText('Step 2');
    await expect.poll(() => desk.evaluate((element) => element.scrollTop)).toBe(0);

    const task = lesson.steps[1].tasks[0];
    const wrong = task.kind.choose.options.findIndex((option) => !option.correct);
    await lab.id(`task-${task.id}-${wrong}`).tap();
    // Pressed at the lower end of what the bench leaves free, so that the remark would be behind it.
    await lab.id(`check-${task.id}`).evaluate((button) => button.scrollIntoView({ block: 'end' }));
    await lab.id(`check-${task.id}`).tap();
    const said = lab.id(`said-${task.id}`);
    await expect(said).toContainText(task.kind.choose.options[wrong].feedback.en.slice(0, 25));
    const bench = await desk.boundingBox();
    await expect.poll(async () => { const box = await said.boundingBox(); return box.y >= 0 && box.y + box.height <= bench.y + 1; }).toBe(true);
  });
});

test('on its side a phone shows the text and the bench beside each other', async ({ lab, page }) => {
  await page.setViewportSize({ width: 844, height: 390 });
  await begin(lab, lessonOf('directions'), { step: 2 });
  const [text, bench] = [await lab.id('lesson').boundingBox(), await page.locator('section.card.responses').boundingBox()];
  expect(text.x + text.width).toBeLessThanOrEqual(bench.x);
  expect(Math.abs(text.y - bench.y)).toBeLessThan(40);
  await expect(lab.id('lesson-next')).toBeInViewport();
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  await lab.axe();
});

test('the last wrong choice and the solution are told apart', async ({ lab }) => {
  const lesson = lessonOf('two-valves-one-zero');
  await begin(lab, lesson, { step: 2 });
  const task = lesson.steps[1].tasks[0];
  const { options } = task.kind.choose;
  const said = lab.id(`said-${task.id}`);
  for (const wrong of options.keys()) {
    if (options[wrong].correct) continue;
    await lab.id(`task-${task.id}-${wrong}`).check();
    await lab.id(`check-${task.id}`).click();
    await expect(said).toContainText(options[wrong].feedback.en.slice(0, 25));
    if (await said.locator('text=solution').count()) break;
  }
  const right = options.find((option) => option.correct);
  const text = (await said.locator('div:last-child').textContent()).replaceAll('\u00a0', ' ');
  const plain = (words) => words.replaceAll('**', '').slice(0, 25);
  expect(text.indexOf(plain(right.feedback.en))).toBeGreaterThan(0);
  // The remark on what was chosen comes first, that on the solution after its word.
  const wrongs = options.filter((option) => !option.correct).map((option) => text.indexOf(plain(option.feedback.en)));
  expect(Math.max(...wrongs)).toBeGreaterThanOrEqual(0);
  expect(Math.max(...wrongs)).toBeLessThan(text.indexOf(plain(right.feedback.en)));
});

test('a wrong answer says why, costs a point, and moves nothing', async ({ lab }) => {
  const lesson = lessonOf('two-valves-one-zero');
  await begin(lab, lesson, { step: 2 });
  const task = lesson.steps[1].tasks[0];
  const wrong = task.kind.choose.options.findIndex((option) => !option.correct);
  const points = lab.id(`task-${task.id}`).locator('.points');
  const before = await points.boundingBox();
  await lab.id(`task-${task.id}-${wrong}`).check();
  await lab.id(`check-${task.id}`).click();
  await expect(lab.id(`said-${task.id}`)).toContainText(task.kind.choose.options[wrong].feedback.en.slice(0, 25));
  expect(Math.abs((await points.boundingBox()).y - before.y)).toBeLessThanOrEqual(25);
  await expect(lab.id('lesson-next')).toHaveAttribute('aria-disabled', 'true');
});

test('a step that is not done says why it cannot be left, and a lesson ticks off nothing of a first visit', async ({ lab, page }) => {
  await begin(lab, lessonOf('two-valves-one-zero'), { step: 3 });
  await expect(lab.id('lesson-blocked')).toBeEmpty();
  // Playwright waits for what is said to be disabled.
  await lab.id('lesson-next').click({ force: true });
  await expect(lab.id('lesson-blocked')).not.toBeEmpty();
  await expect(lab.id('step-title')).toContainText('Step 3');
  await expect(page.locator('.lesson [data-testid^=task-]').first()).toBeInViewport();
  await expect(lab.id('keep-progress')).not.toBeChecked();
  await lab.id('leave-lesson').click();
  await lab.settle();
  for (const id of ['prompt-water', 'prompt-valves', 'prompt-swap']) await expect(lab.id(id)).not.toHaveClass(/done/);
});

test('a goal that is given up is shown, without points', async ({ lab }) => {
  const lesson = lessonOf('two-valves-one-zero');
  await begin(lab, lesson, { step: 3 });
  const task = lesson.steps[2].tasks[0];
  for (const hint of task.hints) {
    await lab.id('hint').click();
    await expect(lab.id('hints')).toContainText(hint.en.slice(0, 20).replaceAll('*', ''));
  }
  await lab.id('show-solution').click();
  await expect(lab.id('said-draw')).toContainText('solution');
  await expect(lab.id('goals').locator('li.met')).toHaveCount(2);
  await expect(lab.id('lesson-points')).toContainText('0 of 10');
});

test('work on the bench and on the bench of the lesson comes back, and so does the address', async ({ lab, page }) => {
  await lab.open();
  await lab.type('gamma1-number', '0.55');
  await lab.bench('relay-tuning');
  await page.waitForTimeout(500);
  // A lesson on the home bench while another one is open.
  await lab.id('to-lessons').click();
  await lab.id('begin-two-valves-one-zero').click();
  await lab.id('lesson').waitFor();
  await lab.id('lesson-next').waitFor();
  await lab.id('leave-lesson').click();
  await expect(lab.id('lesson')).toHaveCount(0);
  await expect(page).toHaveURL(/bench=relay-tuning/);
  await expect(page).not.toHaveURL(/lesson=|step=|page=/);
  await lab.bench('quadruple-tank');
  await expect(lab.id('gamma1-number')).toHaveValue('0.55');
});

test('Back leaves a lesson for what was there, and the next lesson begins in place', async ({ lab, page }) => {
  await lab.open();
  await lab.type('gamma1-number', '0.55');
  await page.waitForTimeout(500);
  await page.evaluate(() => { window.isSamePage = true; });
  await lab.id('to-lessons').click();
  await lab.id('begin-swap-the-pairing').click();
  await lab.id('lesson').waitFor();
  await page.goBack();
  await expect(lab.id('lessons')).toBeVisible();
  await expect(lab.id('lesson')).toHaveCount(0);
  await page.goBack();
  await expect(lab.id('gamma1-number')).toHaveValue('0.55');
  await page.goForward();
  await page.goForward();
  await expect(lab.id('lesson')).toBeVisible();
  await expect(lab.id('step-title')).toContainText('1 ·');
  expect(await page.evaluate(() => window.isSamePage)).toBe(true);
});

test.describe('where files come from the network', () => {
  test.use({ serviceWorkers: 'block' });

  test('a lesson that arrives after its reader has gone back does not begin', async ({ lab, page }) => {
    let release;
    const held = new Promise((done) => (release = done));
    await lab.open();
    await lab.id('to-lessons').click();
    await lab.id('begin-directions').waitFor();
    await page.waitForLoadState('networkidle');
    await page.route('**/*-directions.json', async (route) => {
      await held;
      await route.continue();
    });
    await lab.id('begin-directions').click();
    await page.goBack();
    await expect(lab.id('lessons')).toHaveCount(0);
    const arrived = page.waitForResponse('**/*-directions.json');
    release();
    await arrived;
    await lab.settle();
    await expect(lab.id('lesson')).toHaveCount(0);
    await expect(page).not.toHaveURL(/lesson=/);
    lab.tolerate(/Service Worker registration blocked/);
  });

  test("an instructor's own lesson has an address: of its file beside the site, and in its tab", async ({ lab, page }) => {
    const own = { ...lessonOf('two-valves-one-zero'), id: 'my-own' };
    const text = JSON.stringify(own);
    await page.route('**/course/my-own.json', (route) => route.fulfill({ contentType: 'application/json', body: text }));
    await page.goto(`${lab.origin}/?lesson=course/my-own.json&step=2&lang=en`);
    await expect(lab.id('step-title')).toContainText('Step 2');
    await expect(page).toHaveURL(/lesson=course\/my-own\.json&step=2/);
    // From a file.
    await lab.open('page=lessons&lang=en');
    await lab.id('open-lesson-input').setInputFiles({ name: 'own.json', mimeType: 'application/json', buffer: Buffer.from(text) });
    await expect(lab.id('step-title')).toContainText('Step 1');
    await page.reload();
    await expect(lab.id('step-title')).toContainText('Step 1');
    await page.goBack();
    await expect(lab.id('lessons')).toBeVisible();
    await page.goForward();
    await expect(lab.id('lesson')).toBeVisible();
    // In another tab, and elsewhere.
    await page.evaluate(() => sessionStorage.clear());
    await page.goto(`${lab.origin}/?lesson=file:my-own&lang=en`);
    await expect(lab.id('notice')).toContainText('my-own');
    await page.goto(`${lab.origin}/?lesson=//example.org/my-own.json&lang=en`);
    await expect(lab.id('notice')).toContainText('There is no lesson');
    lab.tolerate(/Service Worker registration blocked/);
  });
});

test('a lesson on a bench that was not open yet shows its own state', async ({ lab, page }) => {
  await begin(lab, lessonOf('relay-finds-the-ultimate-point'), { step: 3 });
  await expect(lab.id('lesson')).toContainText('37.2');
  await expect(lab.id('test-figures')).toContainText('37.23');
  expect(await page.evaluate(() => document.querySelector('[data-testid=test-figures] tbody').rows.length)).toBe(1);
});

test('progress is kept only by consent, and forgotten with it', async ({ lab, page }) => {
  await lab.open('page=lessons');
  const kept = () => page.evaluate(() => Object.keys(localStorage).filter((key) => key.startsWith('quadtank-lesson-')));
  await lab.id('begin-two-valves-one-zero').click();
  await lab.id('task-predict-push-1').check();
  await lab.id('check-predict-push').click();
  expect(await kept()).toEqual([]);
  await page.goBack();
  await lab.id('keep-progress').check();
  expect(await kept()).toHaveLength(1);
  await lab.open('page=lessons');
  await lab.id('begin-two-valves-one-zero').click();
  await expect(lab.id('task-predict-push-1')).toBeChecked();
  await page.goBack();
  // The lesson of an instructor's own file, from an earlier visit.
  await page.evaluate(() => localStorage.setItem('quadtank-lesson-my-own', '{}'));
  await lab.id('keep-progress').uncheck();
  expect(await kept()).toEqual([]);
});

test('a lesson file is refused with its place, and nothing is lost', async ({ lab, page }) => {
  const file = (text) => ({ name: 'lesson.json', mimeType: 'application/json', buffer: Buffer.from(text) });
  const good = JSON.stringify(lessonOf('two-valves-one-zero'));
  await lab.open('page=lessons');
  const input = lab.id('open-lesson-input');
  for (const [text, told] of [
    ['{ "lesson": 1', /line 1/],
    [good.replace('"minutes":8', '"minutes":"eight"'), /minutes/],
    [good.replace('"lesson":1', '"lesson":99'), /version/],
    [`{"lesson":1,"id":"${'x'.repeat(600_000)}"}`, /at most 262144/],
  ]) {
    await input.setInputFiles(file(text));
    await expect(lab.id('notice')).toContainText(told);
    await expect(lab.id('lessons')).toBeVisible();
  }
  // Text is text, whatever it looks like.
  const hostile = JSON.parse(good);
  hostile.id = 'hostile';
  hostile.title.en = '<img src=x onerror="window.isHurt=true"><script>window.isHurt=true</script>';
  hostile.steps[0].text.en = '[x](javascript:window.isHurt=true) <b onclick="window.isHurt=true">b</b>';
  await input.setInputFiles(file(JSON.stringify(hostile)));
  await expect(lab.id('lesson')).toContainText('<img src=x');
  await expect(lab.id('lesson')).toContainText('<b onclick');
  expect(await page.evaluate(() => window.isHurt)).toBeUndefined();
  expect(await lab.id('lesson').locator('img, script, a[href^="javascript"]').count()).toBe(0);
});

test('a report is read back from its code on the page for teachers', async ({ lab, page }) => {
  const lesson = lessonOf('two-valves-one-zero');
  await begin(lab, lesson, { step: 7 });
  await lab.id('task-predict-rig-0').check();
  await lab.id('check-predict-rig').click();
  await lab.type('gamma1-number', '0.25');
  await lab.type('gamma2-number', '0.75');
  await lab.id('lesson-next').click();
  await lab.id('report-name').fill('Ana Souza');
  const code = await lab.text('report-code');
  // The report has what the student reached, and from what the numbers follow.
  await expect(lab.id('report-seed')).toContainText(String(seed));
  await expect(lab.id('report').locator('.report-lines a[href*="#lab="]')).toHaveCount(2);
  const [json] = await Promise.all([page.waitForEvent('download'), lab.id('report-json').click()]);
  const { tasks } = JSON.parse(readFileSync(await json.path(), 'utf8'));
  const reached = tasks.find((task) => task.id === 'draw-again').state;
  expect(await lab.id('report').locator('.report-lines a').last().getAttribute('href')).toContain(`#lab=${reached}`);
  await lab.id('report-leave').click();
  await lab.open('page=teachers');
  await lab.id('read-code').fill(code);
  await expect(lab.id('read-report')).toContainText('Ana Souza');
  await expect(lab.id('read-report').getByTestId('of-draw-again')).toContainText('2/2');
  await lab.id('read-code').fill(`${code}x`);
  await expect(lab.id('read-report').locator('.bad')).toBeVisible();
  // A class: a line for each, and the damaged one named.
  await lab.id('read-code').fill(`Ana: ${code.slice(0, 40)}\n${code.slice(40)}, QL1-damaged; "${code}"`);
  await expect(lab.id('read-report').locator('tbody tr')).toHaveCount(3);
  await expect(lab.id('read-report').locator('tbody tr').nth(1).locator('.bad').first()).toBeVisible();
  await expect(lab.id('read-report').locator('tbody tr').nth(2)).toContainText('twice');
  const [csv] = await Promise.all([page.waitForEvent('download'), lab.id('reports-csv').click()]);
  const lines = readFileSync(await csv.path(), 'utf8').trim().split('\n');
  expect(lines[0]).toBe('name,lesson,fingerprint,score,seconds,seed');
  expect(lines.slice(1).map((line) => line.split(',')[0])).toEqual(['"Ana Souza"', 'damaged', '"Ana Souza"']);
});

test('a teacher downloads the package of a lesson, and the lesson', async ({ lab, page }) => {
  await lab.open('page=teachers');
  await lab.id('guide-directions').locator('summary').first().click();
  const [zip] = await Promise.all([page.waitForEvent('download'), lab.id('scorm-directions').click()]);
  expect(zip.suggestedFilename()).toBe('quadtank-directions.zip');
  const bytes = readFileSync(await zip.path());
  expect(bytes.subarray(0, 2).toString()).toBe('PK');
  expect(bytes.includes('imsmanifest.xml') && bytes.includes('data-scorm="1"')).toBe(true);
  const [json] = await Promise.all([page.waitForEvent('download'), lab.id('save-directions').click()]);
  expect(JSON.parse(readFileSync(await json.path(), 'utf8')).id).toBe('directions');
  // A state for each step that says one, and the format of what was downloaded.
  await lab.id('guide-directions').locator('summary').nth(1).click();
  const starts = lessonOf('directions').steps.filter((step) => step.start);
  await expect(lab.id('guide-directions').getByTestId('starts').locator('a[href*="#lab="]')).toHaveCount(starts.length);
  const [format] = await Promise.all([page.waitForEvent('popup'), lab.id('to-format').click()]);
  await expect(format.getByRole('heading', { level: 1 })).toHaveText('Lessons');
});

test('the builder makes an embed and shows it as it will be', async ({ lab, page }) => {
  await lab.open('page=teachers&lang=es');
  await expect(lab.id('builder-code')).toHaveValue(/lang=es/);
  // Cards and groups are called as on the page, not as in the address.
  for (const bench of ['relay-tuning', 'model-free', 'level-loop', 'quadruple-tank']) {
    await lab.id('builder-subject').selectOption(`bench-${bench}`);
    const names = await page.locator('.boxes label').allTextContents();
    expect(names.length).toBeGreaterThan(8);
    expect(names.filter((name) => /^[a-z-]+$/.test(name.trim()))).toEqual([]);
  }
  await lab.id('box-rga').check();
  // The frame of the preview is a page of its own, with landmarks of its own.
  await lab.axe();
  await lab.id('builder-preview').click();
  const frame = page.frameLocator('iframe.preview');
  await expect(frame.locator('.rga')).toBeVisible();
  // One address after the other: a load that is broken off is a complaint.
  await lab.id('box-zeros').first().check();
  await expect(frame.locator('.zeros')).toBeVisible();
  await lab.id('box-rga').uncheck();
  await expect(frame.locator('.rga')).toHaveCount(0);
  await expect(frame.locator('.zeros')).toBeVisible();
  // On a projector all is larger: the frame is laid out as in a smaller window, and covers the place that it is given.
  await lab.id('builder-scale').selectOption('150');
  await expect(lab.id('builder-code')).toHaveValue(/height:480px;transform:scale\(1\.5\)/);
  const { width, height } = await page.locator('iframe.preview').boundingBox();
  const inside = await frame.locator('html').evaluate(() => innerWidth);
  expect(height).toBeCloseTo(722, -1);
  expect(width / inside).toBeCloseTo(1.5, 1);
  await expect(frame.locator('.zeros')).toBeVisible();
  // What is done to a bench has no place here.
  for (const name of ['present', 'share', 'undo', 'view-lab']) await expect(lab.id(name)).toBeHidden();
});

test('paper is light, also where the page is dark', async ({ lab, page }) => {
  for (const query of ['page=teachers', 'page=glossary', 'lesson=directions']) {
    await page.goto(`${lab.origin}/?${query}&lang=en&theme=dark`);
    await page.locator('#bench').waitFor();
    await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
    await page.emulateMedia({ media: 'print' });
    // A lesson with the pictures of its bench, everything with its link.
    const isLesson = query.startsWith('lesson');
    await expect(lab.id('handout').locator('figure').first()).toBeVisible({ visible: isLesson });
    await expect(page.locator(isLesson ? '.handout .link' : '.paper-link')).toContainText(isLesson ? '#lab=' : query);
    const dark = await page.evaluate(() => {
      const shown = [...document.querySelectorAll('main.side-page *, .lesson *')].filter((element) => element.checkVisibility());
      const light = (colour) => colour.match(/[\d.]+/g).slice(0, 3).reduce((sum, part) => sum + Number(part), 0) / 3;
      const isOpaque = (colour) => !/, 0\)$|transparent/.test(colour);
      return shown.filter((element) => isOpaque(getComputedStyle(element).backgroundColor) && light(getComputedStyle(element).backgroundColor) < 90 && !element.matches('button, .button, .dots *')).map((element) => element.outerHTML.slice(0, 80));
    });
    expect(dark, query).toEqual([]);
    await page.emulateMedia({ media: 'screen' });
  }
});
