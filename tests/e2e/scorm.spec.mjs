// A lesson in a learning management system: the package as the command line makes it, in a page with an API around it. The API is
// once `scorm-again`, once a strict one with the rules of Moodle (mod/scorm/datamodels/scorm_12.js).
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { inflateRawSync } from 'node:zlib';

import { expect, test } from './lab.mjs';
import { QUADTANK, lessonOf, solutionsOf } from './lessons.mjs';
import { SITE, serve } from './server.mjs';

const ID = 'two-valves-one-zero';
const lesson = lessonOf(ID);
const SCORM_AGAIN = readFileSync(fileURLToPath(new URL('node_modules/scorm-again/dist/scorm12.js', import.meta.url)), 'utf8');

/** The text of a file in a zip archive. */
function unzipped(archive, name) {
  const end = archive.lastIndexOf(Buffer.from('PK\x05\x06'));
  let at = archive.readUInt32LE(end + 16);
  for (let k = archive.readUInt16LE(end + 10); k > 0; k -= 1) {
    const [size, long, extra, comment] = [archive.readUInt32LE(at + 20), ...[28, 30, 32].map((field) => archive.readUInt16LE(at + field))];
    const local = archive.readUInt32LE(at + 42);
    if (archive.toString('utf8', at + 46, at + 46 + long) === name) {
      const from = local + 30 + archive.readUInt16LE(local + 26) + archive.readUInt16LE(local + 28);
      const packed = archive.subarray(from, from + size);
      return (archive.readUInt16LE(at + 10) === 8 ? inflateRawSync(packed) : packed).toString('utf8');
    }
    at += 46 + long + extra + comment;
  }
  throw new Error(`no ${name}`);
}

let page_;
/** `index.html` of the package. */
function packed() {
  page_ ??= unzipped(
    execFileSync(QUADTANK, ['scorm', ID, '--output', '-', '--site', `${SITE}/quadtank.html`], { maxBuffer: 64e6 }),
    'index.html',
  );
  return page_;
}

/** An API with the rules of Moodle. What it stores survives in the session storage, as a database would keep it. */
const STRICT = `
  const stored = JSON.parse(sessionStorage.getItem('cmi') ?? '{}');
  const faults = []; const calls = []; let open = false, over = false, last = '0';
  const time = /^([0-9]{2,4}):([0-9]{2}):([0-9]{2})(\\.[0-9]{1,2})?$/, score = /^-?[0-9]{0,3}(\\.[0-9]*)?$/;
  const writable = [
    [/^cmi\\.core\\.lesson_status$/, (v) => ['passed', 'completed', 'failed', 'incomplete', 'browsed'].includes(v)],
    [/^cmi\\.core\\.lesson_location$/, (v) => v.length <= 255],
    [/^cmi\\.core\\.score\\.(raw|min|max)$/, (v) => score.test(v) && +v >= 0 && +v <= 100],
    [/^cmi\\.core\\.session_time$/, (v) => time.test(v)],
    [/^cmi\\.core\\.exit$/, (v) => ['time-out', 'suspend', 'logout', ''].includes(v)],
    [/^cmi\\.suspend_data$/, (v) => v.length <= 4096],
    [/^cmi\\.objectives\\.[0-9]+\\.id$/, (v) => /^[\\u0021-\\u007E]{1,255}$/.test(v)],
    [/^cmi\\.objectives\\.[0-9]+\\.score\\.(raw|min|max)$/, (v) => score.test(v) && +v >= 0 && +v <= 100],
    [/^cmi\\.objectives\\.[0-9]+\\.status$/, (v) => ['passed', 'completed', 'failed', 'incomplete', 'browsed', 'not attempted'].includes(v)],
  ];
  const fail = (code, what) => { last = code; faults.push(code + ' ' + what); return 'false'; };
  const objectives = () => new Set(Object.keys(stored).filter((k) => k.startsWith('cmi.objectives.')).map((k) => k.split('.')[2])).size;
  const known = { 'cmi.core.student_name': 'Souza, Ana', 'cmi.core.lesson_mode': MODE, 'cmi.core.lesson_status': 'not attempted', 'cmi.suspend_data': '' };
  window.API = {
    LMSInitialize: (x) => { calls.push('Initialize'); if (x !== '' || open || over) return fail('101', 'LMSInitialize'); open = true; last = '0'; return 'true'; },
    LMSFinish: (x) => { calls.push('Finish'); if (x !== '' || !open) return fail('301', 'LMSFinish'); open = false; over = true; keep(); return 'true'; },
    LMSGetValue: (name) => {
      if (!open) return fail('301', name), '';
      if (/session_time|exit$/.test(name)) return fail('404', name), '';
      last = '0';
      if (name === 'cmi.core.lesson_mode' && MODE === undefined) { last = '201'; return ''; }
      return stored[name] ?? known[name] ?? '';
    },
    LMSSetValue: (name, value) => {
      calls.push(name);
      if (!open) return fail('301', name);
      const rule = writable.find(([pattern]) => pattern.test(name));
      if (!rule) return fail('403', name);
      if (typeof value !== 'string' || !rule[1](value)) return fail('405', name + '=' + value);
      const index = name.match(/^cmi\\.objectives\\.([0-9]+)/)?.[1];
      if (index !== undefined && +index > objectives()) return fail('201', name);
      stored[name] = value; last = '0'; return 'true';
    },
    LMSCommit: (x) => { calls.push('Commit'); if (x !== '' || !open) return fail('301', 'LMSCommit'); keep(); return 'true'; },
    LMSGetLastError: () => last, LMSGetErrorString: () => '', LMSGetDiagnostic: () => '',
  };
  const keep = () => sessionStorage.setItem('cmi', JSON.stringify(stored));
  window.lms = () => ({ stored, faults, calls });
`;
const AGAIN = `
  ${SCORM_AGAIN.replaceAll('</script', '<\\/script')}
  window.API = new (window.Scorm12API ?? window.ScormAgain?.Scorm12API)({ autocommit: false, logLevel: 5 });
  window.API.cmi.core.student_name = 'Souza, Ana';
  window.lms = () => ({ stored: { 'cmi.core.score.raw': API.cmi.core.score.raw, 'cmi.core.lesson_status': API.cmi.core.lesson_status, 'cmi.suspend_data': API.cmi.suspend_data }, faults: [API.lmsGetLastError()].filter((code) => String(code) !== '0'), calls: [] });
`;
const frame = (source) => `<iframe src="${source}" title="lesson" style="width:1280px;height:820px;border:0"></iframe>`;
const html = (script, body) => `<!doctype html><html lang="en"><title>Course</title><body>${script ? `<script>${script}</script>` : ''}${body}`;
const strict = (mode = "'normal'") => STRICT.replaceAll('MODE', mode);

/** Serves the package in courses of several kinds. */
async function course(pages = {}) {
  return serve({
    pages: {
      '/index.html': packed(),
      '/strict': html(strict(), frame('/index.html')),
      '/no-mode': html(strict('undefined'), frame('/index.html')),
      '/review': html(strict("'review'"), frame('/index.html')),
      '/again': html(AGAIN, frame('/index.html')),
      '/two-up': html(strict(), frame('/between')),
      '/between': html('', frame('/index.html')),
      '/opener': html(strict(), ''),
      ...pages,
    },
  });
}

const test_ = test.extend({
  courses: async ({}, use) => {
    const site = await course();
    await use(site);
    site.close();
  },
});

const lms = (page) => page.evaluate(() => window.lms());

/** The innermost frame, which has the lesson. */
async function lessonIn(page) {
  await expect.poll(() => page.frames().find((frame) => frame.url().includes('/index.html'))?.locator('[data-testid=lesson]').count()).toBe(1);
  return page.frames().find((frame) => frame.url().includes('/index.html'));
}

/** Answers the first two steps; two of ten points. */
async function answerTwoSteps(frame) {
  await frame.getByTestId('task-predict-push-0').check();
  await frame.getByTestId('check-predict-push').click();
  await frame.getByTestId('lesson-next').click();
  await frame.getByTestId(`task-why-turn-${solutionsOf(lesson, 0)['why-turn'].choice}`).check();
  await frame.getByTestId('check-why-turn').click();
  await expect(frame.getByTestId('lesson-points')).toContainText('2 of 10');
}

for (const [name, path] of [['a strict system with the rules of Moodle', '/strict'], ['a system without a mode', '/no-mode'], ['a system two frames up', '/two-up'], ['scorm-again', '/again']]) {
  test_(`${name} gets points, status and state after each answer, and the lesson goes on`, async ({ lab, page, courses }) => {
    await page.goto(`${courses.origin}${path}`);
    let frame = await lessonIn(page);
    await answerTwoSteps(frame);
    const { stored, faults } = await lms(page);
    expect(faults).toEqual([]);
    expect(String(stored['cmi.core.score.raw'])).toBe('20');
    expect(stored['cmi.core.lesson_status']).toBe('incomplete');
    expect(stored['cmi.suspend_data'].length).toBeLessThanOrEqual(4096);
    if (path === '/again') return;
    expect(stored['cmi.core.session_time']).toMatch(/^\d{4}:\d{2}:\d{2}\.\d{2}$/);
    const objectives = Object.keys(stored).filter((key) => /^cmi\.objectives\.\d+\.id$/.test(key));
    expect(objectives).toHaveLength(lesson.steps.flatMap((step) => step.tasks).length);
    expect(stored['cmi.objectives.1.status']).toBe('completed');
    await page.reload();
    frame = await lessonIn(page);
    await expect(frame.getByTestId('step-title')).toContainText('2 ·');
    await expect(frame.getByTestId('lesson-points')).toContainText('2 of 10');
    expect((await lms(page)).faults).toEqual([]);
  });
}

test_('a review writes nothing', async ({ lab, page, courses }) => {
  await page.goto(`${courses.origin}/review`);
  await answerTwoSteps(await lessonIn(page));
  const { calls, faults } = await lms(page);
  expect(faults).toEqual([]);
  expect(calls.filter((call) => call !== 'Initialize')).toEqual([]);
});

test_('leaving the page ends the session once, with everything handed over', async ({ lab, page, courses }) => {
  await page.goto(`${courses.origin}/strict`);
  await answerTwoSteps(await lessonIn(page));
  await page.evaluate(() => { document.querySelector('iframe').src = 'about:blank'; });
  await expect.poll(async () => (await lms(page)).calls.at(-1)).toBe('Finish');
  const { calls, faults, stored } = await lms(page);
  expect(calls.filter((call) => call === 'Finish')).toHaveLength(1);
  expect(faults).toEqual([]);
  expect(stored['cmi.core.exit']).toBe('suspend');
});

test_('a page that the browser has laid aside and brought back goes on with its session', async ({ lab, page, courses }) => {
  await page.goto(`${courses.origin}/strict`);
  const frame = await lessonIn(page);
  await frame.evaluate(() => dispatchEvent(new PageTransitionEvent('pagehide', { persisted: true })));
  await answerTwoSteps(frame);
  const { calls, faults, stored } = await lms(page);
  expect(faults).toEqual([]);
  expect(calls).not.toContain('Finish');
  expect(stored).toMatchObject({ 'cmi.core.score.raw': '20', 'cmi.core.exit': 'suspend' });
});

test_('a lesson in a window of its own finds the system in the window that opened it', async ({ lab, page, courses }) => {
  await page.goto(`${courses.origin}/opener`);
  const [popup] = await Promise.all([page.waitForEvent('popup'), page.evaluate(() => { window.open('/index.html'); })]);
  await answerTwoSteps(popup);
  const { stored, faults } = await lms(page);
  expect(faults).toEqual([]);
  expect(stored['cmi.core.score.raw']).toBe('20');
});

test_('without a system, or with one of another origin, the lesson is as good', async ({ lab, page, courses }) => {
  await page.goto(`${courses.origin}/index.html`);
  await answerTwoSteps(page);
  const elsewhere = await serve({ pages: { '/': html(strict(), frame(`${courses.origin}/index.html`)) } });
  await page.goto(`${elsewhere.origin}/`);
  await answerTwoSteps(await lessonIn(page));
  expect((await lms(page)).calls).toEqual([]);
  elsewhere.close();
});
