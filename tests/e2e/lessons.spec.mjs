// Lessons beside the benches: taken by keyboard, by mouse and by finger, kept, handed in, and read from files of others.
import { readFile } from 'node:fs/promises';
import { Lab } from './lab.mjs';
import {
  FAR_OFF, KeyboardStudent, LANGUAGES, LESSONS, Student, expect, kindOf, languageOf, numberIn, pointsOf, say, shownAs, tasksOf, test, typed,
} from './lessons.mjs';

for (const [index, lesson] of LESSONS.entries()) {
  const language = languageOf(index);
  test(`by keyboard alone ${lesson.id} is taken to full marks, in ${language}`, async ({ lab, page, solutionOf }) => {
    test.setTimeout(300_000);
    const student = new KeyboardStudent(lab, lesson, language);
    await student.begin();
    for (const [at, step] of lesson.steps.entries()) {
      await student.arrived(at);
      if (at > 0) await expect(lab.id('step-title')).toBeFocused();
      await expect(lab.id('step-title')).toBeInViewport();
      expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
      if (step.tasks.length > 0) await expect(lab.id('lesson-next')).toHaveAttribute('aria-disabled', 'true');
      for (const task of step.tasks) {
        await student.answer(task, await solutionOf(lesson, task));
        const points = task.points ? student.say('lesson.reached', { points: task.points, of: task.points }) : student.say('lesson.not_marked');
        await expect(student.points(task)).toHaveText(points);
      }
      await expect(lab.id('lesson-next')).not.toHaveAttribute('aria-disabled');
      if (step.after) await expect(lab.id('after')).toHaveText(shownAs(step.after[language]));
      await lab.axe();
      await student.next();
    }
    const of = pointsOf(lesson);
    expect(of).toBe(10);
    await expect(lab.id('report').locator('.sum')).toContainText(student.say('lesson.sum', { points: of, of, minutes: '' }).split(of).slice(0, 2).join(of));
    await lab.axe();
    await lab.clean();
  });
}
