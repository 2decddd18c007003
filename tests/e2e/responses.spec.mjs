// The responses: cursor, zoom, pinned runs, playing, exports, data table.
import { execFileSync } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { expect, numberIn, test } from './lab.mjs';
import { QUADTANK } from './lessons.mjs';

test('the cursor shows values and moves the drawing', async ({ lab, page }) => {
  await lab.open();
  // Without a cursor the drawing shows the end of the run; the cursor goes to a moment before the steps.
  const end = await lab.text('rig-level-2');
  const box = await lab.id('responses-surface').boundingBox();
  await page.mouse.move(box.x + box.width * 0.3, box.y + box.height * 0.3);
  await lab.settle();
  await expect(lab.id('readout')).toContainText('t = ');
  expect(await lab.text('rig-level-2')).not.toBe(end);
  const shown = (await lab.text('readout')).match(/h₂ ([\d.]+)/)[1];
  expect(await lab.text('rig-level-2')).toContain(shown);
  await page.mouse.move(box.x + box.width / 2, box.y - 60);
  await lab.settle();
  await expect(lab.id('readout')).toHaveCount(0);
  expect(await lab.text('rig-level-2')).toBe(end);
});

test('the cursor and the zoom work by keyboard', async ({ lab, page }) => {
  await lab.open();
  await lab.id('responses-surface').focus();
  await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('ArrowRight');
  await lab.settle();
  await expect(lab.id('readout')).toContainText('t = 165 s');
  const whole = await lab.picture('responses');
  await page.keyboard.press('+');
  await lab.settle();
  const zoomed = await lab.picture('responses');
  expect(zoomed.hash).not.toBe(whole.hash);
  await page.keyboard.press('0');
  await lab.settle();
  expect(await lab.picture('responses')).toEqual(whole);
  await page.keyboard.press('Escape');
  await lab.settle();
  await expect(lab.id('readout')).toHaveCount(0);
});

test('dragging across the chart zooms into that stretch', async ({ lab, page }) => {
  await lab.open();
  const whole = await lab.picture('responses');
  const box = await lab.id('responses-surface').boundingBox();
  await page.mouse.move(box.x + box.width * 0.45, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.7, box.y + 60, { steps: 5 });
  await page.mouse.up();
  await page.mouse.move(box.x + 10, box.y - 80);
  await lab.settle();
  expect((await lab.picture('responses')).hash).not.toBe(whole.hash);
  await lab.id('zoom-reset').click();
  await lab.settle();
  expect(await lab.picture('responses')).toEqual(whole);
});

test('the time axis ends some settling times after the last step', async ({ lab }) => {
  await lab.open('lang=en');
  const whole = await lab.picture('responses');
  await lab.id('zoom-fit').click();
  await lab.settle();
  expect((await lab.picture('responses')).hash).not.toBe(whole.hash);
  // A shorter run has a stretch of its own.
  await lab.type('duration-number', '1400');
  await lab.settle();
  expect((await lab.picture('responses')).ink).toBeGreaterThan(0);
  await lab.id('zoom-reset').click();
  await lab.type('duration-number', '3000');
  await lab.settle();
  expect(await lab.picture('responses')).toEqual(whole);
});

test('a set-point is dragged in the picture: up and down for its size, sideways for its time', async ({ lab, page }) => {
  await lab.open();
  const before = await lab.picture('responses');
  const box = await lab.id('responses-surface').boundingBox();
  const from = await lab.middle('set-point1');
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + box.width * 0.1, from.y - 30, { steps: 6 });
  await page.mouse.up();
  await lab.settle();
  const [size, time] = [await lab.value('step1-number'), await lab.value('step1-time')];
  expect(size).toBeGreaterThan(0.7);
  expect(time).toBeGreaterThan(350);
  expect(time).toBeLessThan(500);
  expect((await lab.picture('responses')).hash).not.toBe(before.hash);
  // The other set-point stays, and the picture was not zoomed.
  expect(await lab.value('step2-number')).toBeCloseTo(0.64, 9);
  expect(await lab.value('step2-time')).toBe(1500);
  await expect(lab.id('set-point1')).toBeFocused();
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowRight');
  await lab.settle();
  expect(await lab.value('step1-number')).toBeCloseTo(size - 0.01, 9);
  expect(await lab.value('step1-time')).toBe(time + 10);
  await expect(lab.id('set-point1')).toHaveAttribute('aria-valuetext', `${(size - 0.01).toFixed(2)}\u00a0cm at ${time + 10}\u00a0s`);
});

test('a dragged set-point stays under the pointer, and the axis follows when it is let go', async ({ lab, page }) => {
  await lab.open();
  // Down to almost nothing: without a held axis the response alone would fill the picture.
  const from = await lab.middle('set-point2');
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  for (const moved of [10, 25, 40]) {
    await page.mouse.move(from.x, from.y + moved);
    await lab.settle();
    expect(Math.abs((await lab.middle('set-point2')).y - from.y - moved)).toBeLessThan(2);
  }
  const held = await lab.picture('responses');
  await page.mouse.up();
  await lab.settle();
  expect((await lab.picture('responses')).hash).not.toBe(held.hash);
});

for (const [query, slider, chart] of [
  ['', 'gain1', 'responses'],
  ['', 'gamma1', 'responses'],
  ['bench=relay-tuning', 'importance', 'response'],
  ['bench=model-free', 'free-kp', 'free-course'],
  ['bench=level-loop', 'level-gain', 'level-course'],
]) {
  test(`the axis of ${chart} does not shrink under a hand on ${slider}`, async ({ lab, page }) => {
    await lab.open(query);
    await lab.id(slider).scrollIntoViewIfNeeded();
    const box = await lab.id(slider).boundingBox();
    const to = async (share) => {
      await page.mouse.move(box.x + box.width * share, box.y + box.height / 2);
      await lab.settle();
    };
    // The axis at the press is held too: the picture to come back to is one without a hand.
    await to(0.5);
    await page.mouse.down();
    await to(0.51);
    await page.mouse.up();
    await lab.settle();
    const before = await lab.picture(chart);
    await page.mouse.down();
    for (const share of [0.05, 0.95]) await to(share);
    await to(0.51);
    expect((await lab.picture(chart)).hash, 'the same curves on a wider axis').not.toBe(before.hash);
    await page.mouse.up();
    await expect.poll(async () => (await lab.picture(chart)).hash, 'the axis of these curves alone').toBe(before.hash);
  });
}

test('without a cursor the zoom keeps the first step in sight', async ({ lab }) => {
  await lab.open();
  for (let k = 0; k < 3; k += 1) await lab.id('zoom-in').click();
  await lab.settle();
  await expect(lab.id('set-point1').locator('.dot')).toBeVisible();
  await expect(lab.id('set-point2').locator('.dot')).toBeHidden();
});

test('a set-point outside the shown stretch is out of reach', async ({ lab, page }) => {
  await lab.open();
  const box = await lab.id('responses-surface').boundingBox();
  await lab.id('responses-surface').focus();
  for (let k = 0; k < 10; k += 1) await page.keyboard.press('Shift+ArrowRight');
  for (let k = 0; k < 3; k += 1) await page.keyboard.press('+');
  await lab.settle();
  await expect(lab.id('set-point1').locator('.dot')).toBeHidden();
  await expect(lab.id('set-point2').locator('.dot')).toBeVisible();
  // Hidden, it stands in the corner, where a press must not grab it.
  await page.mouse.move(box.x + 2, box.y + 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 120, box.y + 60, { steps: 4 });
  await page.mouse.up();
  await lab.settle();
  expect(await lab.value('step1-number')).toBeCloseTo(0.61, 9);
  expect(await lab.value('step1-time')).toBe(100);
});

test('the open data table lengthens the page and covers nothing', async ({ lab, page }) => {
  await lab.open();
  await lab.id('data-table').click();
  await lab.settle();
  const card = await page.locator('.responses').boundingBox();
  const table = await page.locator('.responses details:has(> [data-testid=data-table])').boundingBox();
  expect(table.y + table.height).toBeLessThanOrEqual(card.y + card.height + 1);
  expect((await lab.id('responses').boundingBox()).height).toBeGreaterThan(250);
});

test('the buttons zoom in and out, about the first step, and show the whole run again', async ({ lab, page }) => {
  await lab.open();
  const whole = await lab.picture('responses');
  const end = async () => {
    await lab.id('responses-surface').focus();
    await page.keyboard.press('End');
    await lab.settle();
    const time = Number((await lab.text('readout')).match(/t = (\d+)/)[1]);
    await page.keyboard.press('Escape');
    return time;
  };
  expect(await end()).toBe(3000);
  await lab.id('zoom-in').click();
  await lab.settle();
  expect((await lab.picture('responses')).hash).not.toBe(whole.hash);
  // 0.6 of 3000 s, with the first step, at 100 s, at its share of the picture: from 40 s on.
  expect(await end()).toBe(1840);
  await lab.id('zoom-out').click();
  await lab.settle();
  expect(await end()).toBe(3000);
  await lab.settle();
  expect(await lab.picture('responses')).toEqual(whole);
  for (let k = 0; k < 20; k += 1) await lab.id('zoom-in').click();
  await lab.settle();
  expect((await lab.picture('responses')).ink).toBeGreaterThan(1000);
  await lab.clean();
  await lab.id('zoom-reset').click();
  await lab.settle();
  expect(await lab.picture('responses')).toEqual(whole);
});

test('the linear model can be left out', async ({ lab }) => {
  await lab.open();
  await lab.type('step1-number', '4');
  const both = await lab.picture('responses');
  await lab.id('linear').click();
  await lab.settle();
  const alone = await lab.picture('responses');
  expect(alone.hash).not.toBe(both.hash);
  await lab.id('linear').click();
  await lab.settle();
  expect(await lab.picture('responses')).toEqual(both);
});

test('a pinned run stays to compare with, and its metrics too', async ({ lab, page }) => {
  await lab.open('preset=johansson-2000-non-minimum-phase');
  const alone = await lab.picture('responses');
  await expect(lab.id('metrics').locator('tbody tr')).toHaveCount(2);
  await lab.id('pin').click();
  await lab.id('pairing-swapped').click();
  await lab.type('gain1-number', '0.3');
  await lab.type('gain2-number', '0.28');
  await expect(lab.id('metrics').locator('tbody tr')).toHaveCount(4);
  const both = await lab.picture('responses');
  expect(both.hash).not.toBe(alone.hash);
  for (let k = 0; k < 7; k += 1) await lab.id('pin').click();
  await expect(lab.id('metrics').locator('tbody tr')).toHaveCount(18);
  await expect(lab.id('pin')).toBeDisabled();
  await lab.id('pinned-8-remove').click();
  await expect(lab.id('pin')).toBeEnabled();
  await expect(lab.id('metrics').locator('tbody tr')).toHaveCount(16);
  await lab.id('unpin').click();
  await expect(lab.id('metrics').locator('tbody tr')).toHaveCount(2);
  await lab.id('linear').click();
  await lab.settle();
  await expect(lab.id('linear')).toHaveAttribute('aria-pressed', 'false');
  await page.keyboard.press('Tab');
  await lab.clean();
});

test('a pinned run says what it has of its own and is taken up again in the present experiment', async ({ lab }) => {
  await lab.open('lang=en');
  await lab.id('pin').click();
  await lab.type('gain1-number', '6');
  await lab.type('gamma1-number', '0.75');
  await lab.type('step1-number', '0.9');
  expect(await lab.text('pinned-1')).toMatch(/^1 K₁ 3\.00 · 30\.0 s · K₂ 2\.70 · 40\.0 s · γ 0\.70; 0\.60$/);
  const changed = await lab.picture('responses');
  await lab.id('pinned-1-restore').click();
  await lab.settle();
  expect([await lab.value('gain1-number'), await lab.value('gamma1-number')]).toEqual([3, 0.7]);
  expect(await lab.value('step1-number')).toBe(0.9);
  expect((await lab.picture('responses')).hash).not.toBe(changed.hash);
  await lab.id('pinned-1-remove').click();
  await expect(lab.id('pinned-1')).toHaveCount(0);
  await lab.axe();
});

test('a controller against the advice can be exchanged for the advised pairing', async ({ lab }) => {
  await lab.open('preset=johansson-2000-non-minimum-phase&lang=en');
  await lab.id('try-advised').click();
  await lab.settle();
  await expect(lab.id('pairing-swapped')).toHaveAttribute('aria-pressed', 'true');
  await expect(lab.id('try-advised')).toBeHidden();
  expect(await lab.text('stability')).toContain('Closed loop stable');
});

test('the run plays on the drawing and pauses', async ({ lab }) => {
  await lab.open();
  await lab.id('play-length').selectOption('12');
  await lab.id('play').click();
  await expect(lab.id('readout')).toBeVisible();
  const first = await lab.text('readout');
  await expect.poll(() => lab.text('readout')).not.toBe(first);
  await lab.id('play').click();
  const paused = await lab.text('readout');
  await lab.settle();
  expect(await lab.text('readout')).toBe(paused);
});

const EXPORTS = [
  ['responses', /^time_s,level_1_m,level_2_m,level_3_m,level_4_m,reference_1_m/, 3001],
  ['valve-plane', /^gamma_1,gamma_2,rightmost_zero_per_s/, 441],
  ['poles-and-zeros', /^kind,real_per_s,imaginary_per_s/, 12],
];
for (const [name, heading, rows] of EXPORTS) {
  test(`${name} is exported as CSV, SVG and PNG`, async ({ lab, page }) => {
    await lab.open();
    const save = async (kind) => {
      // It closes when something is chosen.
      await lab.id(`${name}-menu`).locator('summary').click();
      const [download] = await Promise.all([page.waitForEvent('download'), lab.id(`${name}-${kind}`).click()]);
      expect(download.suggestedFilename()).toBe(`${name}.${kind}`);
      return readFile(await download.path());
    };
    const csv = (await save('csv')).toString();
    expect(csv).toMatch(heading);
    expect(csv.trim().split('\n').length - 1).toBe(rows);
    expect(csv).not.toMatch(/NaN|inf/);
    const svg = (await save('svg')).toString();
    const problem = await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelector('parsererror')?.textContent ?? null, svg);
    expect(problem).toBeNull();
    expect(svg).toContain('<path');
    const png = await save('png');
    expect(png.subarray(1, 4).toString()).toBe('PNG');
    expect(png.length).toBeGreaterThan(5000);
  });
}

test('an exported picture leads back to its experiment', async ({ lab, page }) => {
  await lab.open();
  await lab.id('gamma1').fill('0.25');
  await lab.id('responses-menu').locator('summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('responses-svg').click()]);
  const svg = (await readFile(await download.path())).toString();
  const link = await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelector('desc').textContent, svg);
  await page.goto('about:blank');
  await page.goto(link);
  await expect(lab.id('gamma1-number')).toHaveValue('0.25');
});

test('the data table holds the numbers of the picture', async ({ lab, page }) => {
  await lab.open();
  await lab.id('data-table').click();
  const table = page.locator('.responses details:has(> [data-testid=data-table]) table');
  await expect(table.locator('tbody tr')).toHaveCount(25);
  expect(await table.locator('thead').innerText()).toContain('level 1');
  await lab.clean();
});

test('a sentence tells how long a response was looked at, and that a load ends it', async ({ lab }) => {
  await lab.open();
  await lab.type('step2-time', '120');
  expect(await lab.text('responses-sentence')).toMatch(/Level 1 settles \(to 2\s%\) 17\.8 s after its step \(watched for 20\.0 s\)/);
  // Level 2 still answers the first step.
  expect(await lab.text('responses-sentence')).toMatch(/Level 2 was not at rest before its step, but up to 0\.\d+ cm from its reference/);
  await lab.type('step2-time', '103');
  expect(await lab.text('responses-sentence')).toContain('Level 1 does not settle in the 3.00 s to the next step, load or end');
  await lab.type('step2-time', '1500');
  expect(await lab.text('responses-sentence')).not.toContain('watched');
});

test('a run that does not begin at rest has no step response and says why', async ({ lab, page }) => {
  await lab.open();
  await lab.type('gamma1-number', '0.3');
  await lab.type('gamma2-number', '0.7');
  expect(await lab.text('responses-sentence')).toContain('does not begin at rest');
  expect(await page.locator('[data-testid="metrics"] tbody tr').first().textContent()).toMatch(/level 1–.*does not begin at rest/);
});

test('figures of a step and costs of the run stand apart, and what has no figure says why', async ({ lab, page }) => {
  await lab.open();
  const cell = (row, column) => lab.id('metrics').locator('tbody tr').nth(row).locator('td').nth(column);
  await expect(lab.id('costs').locator('tbody tr')).toHaveCount(2);
  const settling = await cell(0, 1).textContent();
  // With noise the twin without it is judged, and the table says so.
  await lab.type('noise-number', '0.05');
  expect(await cell(0, 1).textContent()).toBe(settling);
  expect(await lab.text('metrics-note')).toContain('without noise');
  await lab.type('noise-number', '0');
  expect(await lab.text('metrics-note')).toBe('');
  // A pinned run follows the experiment.
  await lab.id('pin').click();
  await lab.type('step1-number', '1.2');
  expect(await lab.text('metrics-note')).toContain('in the present experiment');
  expect(await cell(2, 3).textContent()).toBe(await cell(0, 3).textContent());
  await lab.id('unpin').click();
  // A level that still answers another step.
  await lab.type('step2-time', '120');
  await expect(cell(1, 0)).toHaveAttribute('title', /Level 2 was not at rest/);
  await expect(cell(1, 0)).toContainText('Level 2 was not at rest');
  // Steps that never come.
  await lab.type('step2-time', '2500');
  await lab.type('duration-number', '2000');
  await expect(lab.id('after-end')).toContainText('at 2500 s, when the experiment is over (2000 s)');
  await expect(cell(1, 0)).toHaveAttribute('title', /when the experiment is over/);
  expect(await lab.text('responses-sentence')).toContain('The step of reference 2 at 2500 s');
  // Singular: no settling time anywhere.
  await lab.type('gamma1-number', '0.625');
  await lab.type('gamma2-number', '0.375');
  expect(await lab.text('responses-sentence')).toContain('on the border of stability');
  expect(await lab.text('responses-sentence')).not.toMatch(/Level \d settles/);
  await expect(cell(0, 1)).toHaveAttribute('title', /border of stability/);
  await lab.axe();
  await lab.clean();
});

test('without a step there is nothing but sums, and none of rounding', async ({ lab, page }) => {
  await lab.open();
  await lab.type('step1-number', '0');
  await lab.type('step2-number', '0');
  expect(await lab.text('responses-sentence')).toContain('No reference moves');
  expect(await page.locator('[data-testid="metrics"] tbody tr').first().textContent()).toMatch(/level 1–.*does not move/);
  expect(await page.locator('[data-testid="costs"] tbody tr').first().textContent()).toMatch(/level 10000/);
});

test('the tables hold the numbers that `quadtank analyse` gives by name', async ({ lab, page }) => {
  const presets = ['johansson-2000-minimum-phase', 'johansson-2000-non-minimum-phase'];
  for (const preset of presets) {
    await lab.open(`lang=en&preset=${preset}`);
    const scenario = execFileSync(QUADTANK, ['presets', preset]);
    const tables = {
      metrics: ['rise_time', 'settling_2_percent', 'settling_5_percent', 'overshoot', 'undershoot', 'coupling', 'window_iae', 'window'],
      costs: ['iae', 'ise', 'itae'],
    };
    // A share is shown in per cent, a length in centimetres.
    const factor = { overshoot: 100, undershoot: 100, coupling: 100, window_iae: 100, iae: 100, ise: 1e4, itae: 100 };
    for (const level of [1, 2]) {
      const names = Object.values(tables).flat().map((name) => `level${level}.${name}`);
      const printed = execFileSync(QUADTANK, ['analyse', '-', ...names.flatMap((name) => ['--only', name])], { input: scenario });
      const values = JSON.parse(printed.toString());
      for (const [table, columns] of Object.entries(tables)) {
        const cells = await lab.id(table).locator('tbody tr').nth(level - 1).locator('td').allTextContents();
        for (const [column, name] of columns.entries()) {
          const shown = numberIn(cells[column]);
          const value = values[`level${level}.${name}`];
          const where = `${preset}, level ${level}, ${name}: ${cells[column]}`;
          if (value === null) expect(cells[column], where).toMatch(/^(–|never)/);
          // Half of the last digit that is shown: one behind the point of a share, two of a length, else the third of all.
          const half = { overshoot: 0.05, undershoot: 0.05, coupling: 0.005 }[name] ?? 0.005 * Math.abs(shown);
          if (value !== null) expect(Math.abs(shown - value * (factor[name] ?? 1)), where).toBeLessThanOrEqual(1.001 * half);
        }
      }
    }
  }
});
