// Plays lessons as a student does: by keyboard alone, or by touch. What is right comes from `quadtank check --solutions`, so the
// page is checked against the core; how a goal is reached on the bench is written here, control by control.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

import { expect } from './lab.mjs';

const root = (path) => fileURLToPath(new URL(`../../${path}`, import.meta.url));
/** The command line as the native tests build it. */
export const QUADTANK = process.env.QUADTANK_CLI ?? root('target/debug/quadtank');
const FOLDER = root('crates/quadtank-lesson/lessons');

/** The lessons of the laboratory, in their order. */
export const LESSONS = readdirSync(FOLDER)
  .sort()
  .map((file) => JSON.parse(readFileSync(`${FOLDER}/${file}`, 'utf8')));

export const lessonOf = (id) => LESSONS.find((lesson) => lesson.id === id);

/** The answers that are right for a student, by task. */
export function solutionsOf(lesson, seed) {
  const printed = execFileSync(QUADTANK, ['check', lesson.id, '--solutions', '--seed', String(seed)], { encoding: 'utf8' });
  return Object.fromEntries(JSON.parse(printed).map((solution) => [solution.task, solution.answer]));
}

/** How each goal is reached: a name and what is typed into that field; a name alone is pressed; a name and keys are pressed on it. */
const both = (gain, time) => [['gain1-number', gain], ['integral1-number', time], ['gain2-number', gain], ['integral2-number', time]];
const WAYS = {
  draw: [['gamma1-number', '0.6'], ['gamma2-number', '0.4']],
  'draw-again': [['gamma1-number', '0.25'], ['gamma2-number', '0.75']],
  'a-fifth': [['valve-handle', { key: 'ArrowLeft', times: 10 }], ['valve-handle', { key: 'ArrowDown', times: 15 }]],
  paradise: [['valve-handle', { key: 'ArrowRight', times: 30 }]],
  postpone: both('0.1', '800'),
  swap: [['pairing-swapped'], ...both('0.3', '100')],
  trap: [['pairing-swapped'], ['gain1-number', '0.3'], ['integral1-number', '170'], ['gain2-number', '0.28'], ['integral2-number', '160']],
  fast: both('0.3', '80'),
  cheat: [['gain1-number', '0.6'], ['gain2-number', '0.25'], ['integral2-number', '150']],
  'costly-wish': [['step2-number', '-0.5']],
  'level-2-alone': [['gamma1-number', '0.8'], ['gamma2-number', '0.1']],
  'break-model': [['pi-more'], ['manual1-output', '1.4']],
  tame: [['pi-more'], ['antiwindup']],
  'largest-step': [['set-point1', { key: 'Shift+ArrowUp', times: 60 }]],
  slower: [['test-hysteresis1', '0.3']],
  'just-right': [['rig-dead-time', '150']],
  'fast-swing': [['importance-number', '0.18']],
  'honest-test': [['ratio-number', '1']],
  'both-loci': [['method-b'], ['root1']],
  'easy-direction': [['free-step2', '2']],
  repair: [['free-swapped'], ['free-off'], ['free-alpha-number', '1'], ['free-kp-number', '0.3'], ['free-ki-number', '0.005']],
  tight: [['level-gain-number', '13']],
  averaging: [['level-gain-number', '0.2'], ['level-time-number', '3000']],
  lasting: [['level-gain-number', '0.5'], ['level-time-number', '600']],
  'double-slope': [['level-inflow-number', '17']],
  'right-test': [['test-inflow', '17'], ['level-gain-number', '7.3'], ['level-time-number', '23.5']],
  'tip-over': [['level-inflow-number', '18.5']],
};

/** The keyboard: everything is focused and then keyed, and has to take the focus. */
export class Keyboard {
  constructor(lab) {
    this.lab = lab;
  }

  async focus(target) {
    await target.focus();
    await expect(target).toBeFocused();
    expect(await target.evaluate((element) => element.tabIndex), 'Tab reaches it').toBeGreaterThanOrEqual(0);
  }

  async press(target) {
    await this.focus(target);
    const isField = await target.evaluate((element) => element.matches('input'));
    await this.lab.page.keyboard.press(isField ? 'Space' : 'Enter');
  }

  async type(target, text) {
    await this.focus(target);
    await this.lab.page.keyboard.press('ControlOrMeta+a');
    await this.lab.page.keyboard.type(text);
    await this.lab.page.keyboard.press('Tab');
  }

  async keys(target, { key, times }) {
    await this.focus(target);
    for (let k = 0; k < times; k += 1) await this.lab.page.keyboard.press(key);
  }
}

/** A finger: it taps, and types on the keyboard of the screen. Handles have keys also there, for want of a drag by touch here. */
export class Finger extends Keyboard {
  async press(target) {
    await target.tap();
  }

  async type(target, text) {
    await target.tap();
    await target.fill(text);
    await target.blur();
  }
}

/** How much further down something stands after `act` than before (CSS px). */
async function moved(target, act) {
  // Within the text of the lesson, however that is scrolled.
  const top = () => target.evaluate((element) => element.getBoundingClientRect().top - element.closest('.lesson-text').firstElementChild.getBoundingClientRect().top);
  const before = await top();
  await act();
  return Math.abs((await top()) - before);
}

/** Most that an answer may move what stands below it: a line (CSS px). */
const LINE = 25;

/** Plays a lesson from its first step to its report, with every answer right; `atStep` looks at each step before its answers. */
export async function play(lab, hand, lesson, seed, atStep = async () => {}) {
  const solutions = solutionsOf(lesson, seed);
  for (const [index, step] of lesson.steps.entries()) {
    await expect(lab.id('step-title')).toContainText(`${index + 1} ·`);
    await lab.settle();
    await atStep(index, step);
    for (const task of step.tasks) {
      const points = lab.id(`task-${task.id}`).locator('.points');
      const distance = await moved(points, () => answer(lab, hand, task, solutions[task.id]));
      // Words of a model answer are as long as they are.
      if (!task.kind.explain) expect(distance, `what stands below ${task.id}`).toBeLessThanOrEqual(LINE);
    }
    await hand.press(lab.id('lesson-next'));
  }
  await expect(lab.id('report')).toBeVisible();
}

async function answer(lab, hand, task, solution) {
  const said = lab.id(`said-${task.id}`);
  const [kind] = Object.keys(task.kind);
  if (kind === 'achieve') {
    for (const [name, what] of WAYS[task.id]) {
      const target = lab.id(name);
      if (typeof what === 'string') await hand.type(target, what);
      else if (what) await hand.keys(target, what);
      else await hand.press(target);
      await lab.settle();
    }
  } else {
    if (kind === 'predict' || kind === 'choose') await hand.press(lab.id(`task-${task.id}-${solution?.choice ?? 0}`));
    // As many digits as a student would type.
    if (kind === 'number') await hand.type(lab.id(`number-${task.id}`), String(Number(solution.number.toPrecision(4))));
    if (kind === 'explain') await hand.type(lab.id(`words-${task.id}`), 'The late water outweighs the quick one.');
    if (kind === 'order') await order(lab, hand, task);
    await hand.press(lab.id(`check-${task.id}`));
  }
  await expect(said, `${task.id}`).toHaveClass(/right/);
}

/** Puts items in order by their buttons. */
async function order(lab, hand, task) {
  const list = lab.id(`task-${task.id}`).locator('.ordering li > span');
  const texts = task.kind.order.items.map((item) => plain(item.en));
  const places = async () => (await list.allTextContents()).map((text) => texts.indexOf(plain(text)));
  for (let now = await places(); ; now = await places()) {
    expect(now).not.toContain(-1);
    const wrong = now.findIndex((item, place) => item > now[place + 1]);
    if (wrong < 0) return;
    await hand.press(lab.id(`down-${wrong}`));
  }
}

const plain = (text) => text.replaceAll('**', '').replaceAll('\u00a0', ' ').trim();
