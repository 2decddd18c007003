// What the tests of lessons share: the files of the lessons, the words of the page, and a student who answers.
//
// - `LESSONS` are the lessons of the laboratory as their files say them; `say(language, key)` is a text of the page.
// - `Student` takes a lesson: with a mouse, with a finger, or, as `KeyboardStudent`, with the keyboard alone.
// - The fixture `solutionOf` says what is right: `{ choice }`, `{ number }`, `{ order }` or `{ link }` of a state that reaches a goal.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { Lab, expect, numberIn, test as base } from './lab.mjs';

export { expect };

const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const FOLDER = `${ROOT}crates/quadtank-lesson/lessons/`;
const CLI = process.env.QUADTANK_CLI ?? `${ROOT}target/debug/quadtank`;

/** The lessons by their files, in the order of the course. */
export const LESSONS = readdirSync(FOLDER)
  .filter((name) => name.endsWith('.json'))
  .sort()
  .map((name) => ({ ...JSON.parse(readFileSync(FOLDER + name, 'utf8')), file: FOLDER + name }));

export const LANGUAGES = ['en', 'pt-BR', 'es'];

/** A language for each lesson, so that all occur. */
export const languageOf = (index, shift = 0) => LANGUAGES[(index + shift) % LANGUAGES.length];

const WORDS = Object.fromEntries(LANGUAGES.map((tag) => [tag, JSON.parse(readFileSync(`${ROOT}assets/locales/${tag}.json`, 'utf8'))]));

/** A text of the page in a language: `say('en', 'lesson.reached', { points: 1, of: 2 })`. */
export function say(language, key, values = {}) {
  const text = key.split('.').reduce((part, name) => part[name], WORDS[language]);
  return text.replace(/\{\{ *(\w+) *\}\}/g, (_, name) => values[name]);
}

/** A pattern for a text of a lesson as the page shows it: without its markup, with any live value. */
export function shownAs(text) {
  const plain = (part) => part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
  const MARKUP = /\*\*(.+?)\*\*|\{(?:value|formula):[^}]+\}|\$[^$]+\$|\[([^\]]+)\]\((?:glossary|bench|lesson):[^)]*\)/g;
  let pattern = '';
  let end = 0;
  for (const found of text.matchAll(MARKUP)) {
    pattern += plain(text.slice(end, found.index)) + (found[1] ?? found[2] ? plain(found[1] ?? found[2]) : '[^]+?');
    end = found.index + found[0].length;
  }
  return new RegExp((pattern + plain(text.slice(end))).replace(/\s+/g, '\\s+'));
}

/** A number as somebody types it who writes in a language. */
export const typed = (value, language) => String(Number(value.toPrecision(9))).replace('.', language === 'en' ? '.' : ',');

/** The kind of a task and what it holds. */
export const kindOf = (task) => Object.entries(task.kind)[0];

/** All tasks of a kind: `{ step, task, kind }`. */
export const tasksOf = (lesson, wanted) =>
  lesson.steps.flatMap((step, index) =>
    step.tasks.map((task) => ({ step: index, task, kind: task.kind[wanted] })).filter(({ kind }) => kind),
  );

export const pointsOf = (lesson) => lesson.steps.flatMap((step) => step.tasks).reduce((sum, task) => sum + (task.points ?? 0), 0);

/** A wrong number that no lesson lists. */
export const FAR_OFF = 98765;

/** Somebody who takes a lesson with a mouse. */
export class Student {
  constructor(lab, lesson, language = 'en') {
    Object.assign(this, { lab, page: lab.page, lesson, language });
  }

  /** Opens the lesson by its address; without `step` as a link to it does. The seed says which numbers this student gets. */
  async begin({ step, seed = 7, query = '' } = {}) {
    await this.page.addInitScript((seed) => {
      Math.random = () => (seed + 0.5) / 1e6;
    }, seed);
    const at = step === undefined ? '' : `&step=${step + 1}`;
    await this.page.goto(`${this.lab.origin}/?lesson=${this.lesson.id}${at}&lang=${this.language}${query}`);
    await this.arrived(step ?? 0);
  }

  /** Waits until a step is shown and its bench is computed. */
  async arrived(step) {
    const title = say(this.language, 'lesson.step', { number: step + 1, title: this.lesson.steps[step].title[this.language] });
    await expect(this.lab.id('step-title')).toHaveText(title);
    await this.lab.ready();
  }

  say(key, values) {
    return say(this.language, key, values);
  }

  section(task) {
    return this.lab.id(`task-${task.id}`);
  }

  said(task) {
    return this.lab.id(`said-${task.id}`);
  }

  points(task) {
    return this.section(task).locator('.points');
  }

  async press(id) {
    await this.lab.id(id).click();
    await this.lab.settle();
  }

  async write(id, text) {
    await this.lab.id(id).fill(text);
  }

  async choose(task, index) {
    await this.press(`task-${task.id}-${index}`);
    await this.press(`check-${task.id}`);
  }

  async number(task, value) {
    await this.write(`number-${task.id}`, typed(value, this.language));
    await this.press(`check-${task.id}`);
  }

  /** Brings the items of a task into the right order. */
  async order(task) {
    const items = kindOf(task)[1].items.map((item) => shownAs(item[this.language]));
    const rows = this.section(task).locator('.ordering li > span');
    for (let place = 0; place < items.length; place += 1) {
      let from = (await rows.allTextContents()).findIndex((text) => items[place].test(text));
      expect(from, `${items[place]} among the items`).toBeGreaterThanOrEqual(place);
      for (; from > place; from -= 1) await this.press(`up-${from}`);
    }
    await this.press(`check-${task.id}`);
  }

  async explain(task, words) {
    await this.write(`words-${task.id}`, words);
    await this.press(`check-${task.id}`);
  }

  /** Opens a state on the bench, as a link in the address does. */
  async bring(link) {
    await this.page.evaluate((link) => (location.hash = `lab=${link}`), link);
    await this.lab.settle();
  }

  /** Answers a task rightly. */
  async answer(task, solution) {
    const [kind] = kindOf(task);
    if (kind === 'predict') await this.choose(task, 0);
    if (kind === 'choose') await this.choose(task, solution.choice);
    if (kind === 'number') await this.number(task, solution.number);
    if (kind === 'order') await this.order(task);
    if (kind === 'explain') await this.explain(task, 'Água, señal & <b>λ₁₁</b>: one arrives late.');
    if (kind === 'achieve') await this.bring(solution.link);
    const verdict = ['predict', 'explain'].includes(kind) ? 'lesson.recorded' : 'lesson.right';
    await expect(this.said(task), `${this.lesson.id} ${task.id}`).toContainText(this.say(verdict));
  }

  async next() {
    await this.press('lesson-next');
  }
}

/** Somebody who takes a lesson with the keyboard alone. */
export class KeyboardStudent extends Student {
  /** Moves the focus with Tab, or with Shift+Tab to what stands before. */
  async reach(id) {
    const where = () =>
      this.page.evaluate((id) => {
        const wanted = document.querySelector(`[data-testid="${id}"]`);
        const here = document.activeElement;
        // The group of radio buttons is one stop; within it the arrow keys go on.
        const group = here?.type === 'radio' && here.name === wanted?.name;
        if (here === wanted || group) return 'there';
        return wanted && wanted.compareDocumentPosition(here) & Node.DOCUMENT_POSITION_FOLLOWING && here !== document.body ? 'behind' : 'ahead';
      }, id);
    for (let k = 0; k < 60; k += 1) {
      const place = await where();
      if (place === 'there') return;
      await this.page.keyboard.press(place === 'behind' ? 'Shift+Tab' : 'Tab');
    }
    throw new Error(`Tab does not reach ${id}`);
  }

  async press(id) {
    await this.reach(id);
    await this.page.keyboard.press('Enter');
    await this.lab.settle();
  }

  async write(id, text) {
    await this.reach(id);
    await this.page.keyboard.press('Control+a');
    await this.page.keyboard.type(text);
  }

  async choose(task, index) {
    await this.reach(`task-${task.id}-0`);
    const at = () => this.page.evaluate(() => Number(document.activeElement.value));
    // Space takes the option with the focus; an arrow key takes the one after it.
    if (!(await this.page.evaluate(() => document.activeElement.checked))) await this.page.keyboard.press('Space');
    while ((await at()) !== index) await this.page.keyboard.press((await at()) < index ? 'ArrowDown' : 'ArrowUp');
    await this.press(`check-${task.id}`);
  }
}

/** The right answers of a lesson for a seed as the command line knows them, by ids of tasks; nothing where it does not. */
function fromCommandLine(lesson, seed) {
  if (!existsSync(CLI)) return null;
  try {
    return JSON.parse(execFileSync(CLI, ['check', lesson.file, '--solution', '--seed', String(seed)], { encoding: 'utf8', stdio: 'pipe' }));
  } catch {
    return null;
  }
}

/** The right answer as the page itself shows it to somebody who gives up. */
async function fromGivingUp(lab, lesson, task, seed) {
  const student = new Student(lab, lesson);
  await student.begin({ step: lesson.steps.findIndex((step) => step.tasks.includes(task)), seed });
  const [kind] = kindOf(task);
  if (kind === 'number') {
    for (let k = 0; k < 3; k += 1) await student.number(task, FAR_OFF);
    const words = (await lab.text(`said-${task.id}`)).split(say('en', 'lesson.solution_is', { value: '' }).replace(/\W+$/, '')).at(-1);
    const [, digits, power = '0'] = words.replaceAll('−', '-').match(/(-?\d+(?:\.\d+)?)(?:e(-?\d+))?/);
    return { number: Number(`${digits}e${power}`) };
  }
  const section = student.section(task);
  for (let k = 0; k < task.hints.length; k += 1) await section.getByTestId('hint').click();
  await section.getByTestId('show-solution').click();
  await lab.settle();
  // Sharing puts the state into the address; its button is hidden during a lesson.
  await lab.id('share').evaluate((button) => button.click());
  return { link: new URL(lab.page.url()).hash.replace('#lab=', '') };
}

export const test = base.extend({
  solutionOf: [
    async ({ browser, site }, use) => {
      const known = new Map();
      const remember = async (key, find) => {
        if (!known.has(key)) known.set(key, await find());
        return known.get(key);
      };
      const context = await browser.newContext();
      await use(async (lesson, task, seed = 7) => {
        const [kind, what] = kindOf(task);
        if (kind === 'choose') return { choice: what.options.findIndex((option) => option.correct) };
        if (kind === 'order') return { order: what.items.map((_, index) => index) };
        if (!['number', 'achieve'].includes(kind)) return {};
        const all = await remember(`${lesson.id} ${seed}`, () => fromCommandLine(lesson, seed));
        if (all) return all[task.id];
        return remember(`${lesson.id} ${seed} ${task.id}`, async () => {
          const page = await context.newPage();
          try {
            return await fromGivingUp(new Lab(page, site.origin, []), lesson, task, seed);
          } finally {
            await page.close();
          }
        });
      });
      await context.close();
    },
    { scope: 'worker' },
  ],
});

export { numberIn };
