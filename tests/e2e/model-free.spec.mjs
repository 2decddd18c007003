// The model-free bench: the cases of Junqueira, Neves and Angelico, what their outputs hide, and moving valves.
import { LOOKS, expect, test } from './lab.mjs';

const BENCH = 'bench=model-free';

async function press(lab, ...names) {
  for (const name of names) await lab.id(name).click();
  await lab.settle();
}

/** Presses Tab until an element has the focus, as somebody without a mouse does. */
async function tabTo(page, name) {
  for (let k = 0; k < 80; k += 1) {
    if ((await page.evaluate(() => document.activeElement?.dataset?.testid)) === name) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab does not reach ${name}`);
}

/** Both tables of figures by rows: IAE, ISE, overshoot, settling, total variation, time at a limit, lost; null where there is none. */
async function figures(lab) {
  const number = (text) => (text.startsWith('–') ? null : Number.parseFloat(text.replace('−', '-')));
  const table = async (name) => {
    const rows = await lab.id(name).locator('tbody tr').all();
    return Promise.all(rows.map(async (row) => (await row.locator('td').allTextContents()).map(number)));
  };
  const [steps, costs] = [await table('free-figures'), await table('free-costs')];
  return steps.map(([overshoot, settling, lost], k) => {
    const [iae, ise, variation, limit] = costs[k];
    return [iae, ise, overshoot, settling, variation, limit, lost];
  });
}

/** Levels 1 to 4 on the drawing (cm). */
async function levels(lab) {
  const texts = [1, 2, 3, 4].map((k) => lab.id('free-rig').getByTestId(`rig-level-${k}`).textContent());
  return (await Promise.all(texts)).map((text) => Number.parseFloat(text));
}

test('case a is reproduced: from empty tanks, and its course at the times that are known', async ({ lab }) => {
  await lab.open(BENCH);
  // S2, computed by a second program: t, h1…h4 (cm).
  for (const [time, ...known] of [
    [40, 15.896, 15.8868, 9.2203, 9.2196], [100, 15.197, 15.1938, 7.9787, 7.9807], [320, 15.0008, 15.0008, 7.8249, 7.8253],
  ]) {
    await lab.type('free-time-number', String(time));
    const shown = await levels(lab);
    known.forEach((level, k) => expect(Math.abs(shown[k] - level), `h${k + 1} at ${time} s`).toBeLessThanOrEqual(0.0051));
  }
  await press(lab, 'free-s1');
  // IAE, ISE, overshoot, settling, total variation, time at a limit (8.3 % of 300 s); nothing is lost.
  expect(await figures(lab)).toEqual([
    [190.3, 732.4, 22.8, 122, 16.8, 25, null], [189.2, 727.6, 22.4, 121, 15.6, 25, null],
  ]);
  expect(await lab.text('free-verdict')).toContain('All settles: the levels after 122 and 121 s');
  expect(await lab.text('free-stability')).toContain('stable');
  await lab.clean();
});

test('a run that is lost ends with a button that mends it', async ({ lab }) => {
  await lab.open(BENCH);
  await expect(lab.id('mend-free')).toHaveCount(0);
  await press(lab, 'free-b', 'free-long');
  expect(await lab.text('free-verdict')).toContain('is lost');
  await press(lab, 'mend-free');
  expect(await lab.text('free-verdict')).toContain('All settles');
  await expect(lab.id('mend-free')).toHaveCount(0);
});

test('the loss that case b hides is found by keyboard alone', async ({ lab, page }) => {
  await lab.open(BENCH);
  await tabTo(page, 'free-b');
  await page.keyboard.press('Enter');
  await lab.settle();
  // Over 320 s the outputs look as good as those of case a.
  const [first, second] = await figures(lab);
  expect([first[0], first[6], second[6]]).toEqual([111.6, null, null]);
  expect(await lab.text('free-verdict')).toContain('The outputs look settled, the states are leaving.');
  expect(await lab.text('free-verdict')).toContain('tank 3 runs over at about 1018 s. Run 2000 s to see it.');
  expect(await lab.text('free-stability')).toContain('unstable');
  await tabTo(page, 'free-long');
  await page.keyboard.press('Space');
  await lab.settle();
  expect(await lab.text('free-verdict')).toContain('Level 2 is lost at 1190 s');
  expect(await lab.text('free-verdict')).toContain('Tank 3 first ran over at 1020 s. The zero in the right half-plane had foretold it');
  await expect(lab.id('free-rig')).toContainText('overflows');
  // The cursor goes back to where nobody sees it yet in the outputs.
  await tabTo(page, 'free-time');
  await page.keyboard.press('Home');
  for (let k = 0; k < 4; k += 1) await page.keyboard.press('PageUp');
  await lab.settle();
  const [h1, h2, h3, h4] = await levels(lab);
  expect(Math.abs(h1 - 15)).toBeLessThan(0.05);
  expect(Math.abs(h2 - 15)).toBeLessThan(0.05);
  expect(Math.abs(h3 - h4)).toBeGreaterThan(4);
  await lab.clean();
});

test('a step of one level of case b is lost within two minutes, with a larger α̂ too, and PI with the other pairing holds it', async ({ lab }) => {
  await lab.open(BENCH);
  await press(lab, 'free-b', 'free-s3', 'free-pi');
  expect(await lab.text('free-verdict')).toMatch(/Level 1 is lost at 135 s.*Pump 1 had come to its limit/);
  const [law, , pi] = await figures(lab);
  expect([law[6], pi[6]]).toEqual([135, null]);
  expect(await lab.text('free-comparison')).toBe('PI: pairing 1–2 / 2–1, K = 0.30 V/V, Ti = 60 s, with back-calculation.');
  expect(await lab.text('free-moment')).toContain('λ₁₁ = −0.800');
  await lab.type('free-alpha-number', '0.3');
  expect(await lab.text('free-verdict')).toContain('is lost at');
});

test('case c plays: the point moves, the zero crosses the axis, the water follows, and it stops at the end', async ({ lab, page }) => {
  await lab.open(BENCH);
  await press(lab, 'free-c');
  expect(await lab.text('free-verdict')).toContain('Both levels follow, the upper tanks drift apart');
  await lab.id('free-play-length').selectOption('6');
  const way = await lab.id('free-way').innerHTML();
  const zeros = await lab.picture('free-pole-zero');
  await lab.id('free-play').click();
  const sides = new Set();
  const times = new Set();
  const drawings = new Set();
  await expect
    .poll(async () => {
      const text = await lab.text('free-moment');
      sides.add(/in the (left|right) half-plane/.exec(text)?.[1]);
      times.add(await lab.value('free-time-number'));
      drawings.add((await levels(lab)).join());
      return (await lab.text('free-play')).includes('pause');
    }, { intervals: [20], timeout: 60_000 })
    .toBe(false);
  expect(times.size).toBeGreaterThan(3);
  // The words follow the charts.
  await lab.settle();
  expect([...sides].filter(Boolean).sort()).toEqual(['left', 'right']);
  expect(drawings.size).toBeGreaterThan(3);
  expect(await lab.value('free-time-number')).toBe(320);
  await lab.type('free-time-number', '110');
  expect(await lab.id('free-way').innerHTML()).not.toBe(way);
  expect((await lab.picture('free-pole-zero')).hash).not.toBe(zeros.hash);
  // A page that nobody sees does not run.
  await page.evaluate(() => Object.defineProperty(document, 'hidden', { value: true }));
  await lab.id('free-play').click();
  await page.waitForTimeout(300);
  expect(await lab.value('free-time-number')).toBe(110);
  await lab.clean();
});

test('every setting changes the run, and what cannot be is explained with nothing lost', async ({ lab }) => {
  await lab.open(BENCH);
  const all = async () => (await lab.picture('free-course')).hash;
  let last = await all();
  const changes = async (name, change) => {
    await change();
    await lab.settle();
    const now = await all();
    expect(now, name).not.toBe(last);
    last = now;
  };
  for (const name of ['free-sliding', 'free-trapezoidal', 'free-conditional', 'free-back', 'free-off', 'free-block', 'free-swapped', 'free-diagonal', 'free-windup', 'free-commanded', 'free-c', 'free-a', 'free-s3', 'free-s1', 'free-s2', 'free-pi']) {
    await changes(name, () => lab.id(name).click());
  }
  for (const [name, value] of [['free-alpha-number', '0.2'], ['free-kp-number', '1'], ['free-ki-number', '0.1'], ['free-window', '20'], ['free-sampling', '0.5'], ['free-noise', '0.05'], ['free-gamma1', '0.55'], ['free-step2', '3'], ['free-end', '500']]) {
    await changes(name, () => lab.type(name, value));
  }
  const refused = async (name, value, reason) => {
    const before = await lab.id(name).inputValue();
    await lab.id(name).fill(value);
    await lab.settle();
    await expect(lab.page.locator('.problem')).toContainText(reason);
    expect(await all(), name).toBe(last);
    await lab.id(name).press('Escape');
    expect(await lab.id(name).inputValue()).toBe(before);
  };
  // T < 2 Ts; T no multiple of Ts; α̂ ≤ 0; γ(t) leaving [0, 1].
  await refused('free-window', '0.5', '1.00 to');
  await refused('free-window', '7.3', 'a multiple of 0.500');
  await refused('free-alpha-number', '0', '0.0000100 to 100');
  await refused('free-alpha-number', '-0.1', '0.0000100 to 100');
  await lab.id('free-c').click();
  await lab.settle();
  last = await all();
  await refused('free-gamma1', '0.95', '0.10 to 0.90');
  await lab.clean();
});

test('a file whose valve leaves [0, 1] or whose window does not fit is refused with the reason, and the bench stays', async ({ lab, page }) => {
  await lab.open(BENCH);
  await page.locator('[data-testid=file-menu] > summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('save').click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const text = Buffer.concat(chunks).toString();
  const verdict = await lab.text('free-verdict');
  const open = async (change) => {
    const document = JSON.parse(text);
    change(document.model_free);
    const buffer = Buffer.from(JSON.stringify(document));
    await lab.id('open-input').setInputFiles({ name: 'run.json', mimeType: 'application/json', buffer });
  };
  await open((run) => (run.valves[0] = { sine: { mean: 0.95, amplitude: 0.1, frequency: 0.2, phase: 0 } }));
  await expect(lab.id('notice')).toContainText('model_free.valves[0]');
  await open((run) => (run.controller.estimator.window_s = 7.5));
  await expect(lab.id('notice')).toContainText('model_free.controller');
  await expect(lab.id('notice')).toContainText('a window of 7.500 s has to be a multiple of 1.000 s, of 2 to 1000 samples');
  await lab.id('language').selectOption('pt-BR');
  await expect(lab.id('notice')).toContainText('uma janela de 7,500 s precisa ser um múltiplo de 1,000 s');
  await lab.id('language').selectOption('en');
  await open((run) => (run.controller.loops[0].model_gain = 0));
  await expect(lab.id('notice')).toContainText('model_gain');
  expect(await lab.text('free-verdict')).toBe(verdict);
  // A ramp through the line, as the file says it.
  await open((run) => (run.valves = [0, 1].map(() => ({ ramp: { from: 0.6, to: 0.4, begin_s: 100, end_s: 200 } }))));
  await expect(lab.id('free-moment')).toContainText('γ₁ + γ₂ = 0.80');
  await lab.clean();
});

test('valves where no run begins, no zero is finite or the zero is at the origin: the page says so', async ({ lab }) => {
  await lab.open(BENCH);
  const valves = async (one, two) => {
    await lab.type('free-gamma1', one);
    await lab.type('free-gamma2', two);
  };
  await valves('0', '0');
  expect(await lab.text('free-verdict')).toMatch(/^No run: it cannot begin at rest\. Tank 3 would need 32\.6 cm, its wall ends at 30\.0 cm\.$/);
  await valves('0.2', '0.85');
  expect(await lab.text('free-verdict')).toContain('Pump 1 would need 85.52 V, outside 0.0 to 12.0 V.');
  await valves('0.5', '0.5');
  expect(await lab.text('free-moment')).toContain('right-most zero 0, on the boundary, λ₁₁ = –');
  expect(await lab.text('free-stability')).toContain('at the limit of stability');
  await valves('1', '1');
  expect(await lab.text('free-moment')).toContain('no finite zero');
  await lab.clean();
});

test('references that nothing holds are refused or explained, and the picture stays in its plot', async ({ lab }) => {
  await lab.open(BENCH);
  // From 10 cm down to the bottom, or up to the wall at 30 cm.
  await lab.id('free-step1').fill('-11');
  await expect(lab.page.locator('.problem')).toContainText('−10.00 to 20.00');
  await lab.id('free-step1').press('Escape');
  await press(lab, 'free-c', 'free-s3');
  expect(await lab.text('free-stability')).toContain('While valves move');
  await lab.type('free-time-number', '100');
  const [dot, plane] = await Promise.all([lab.page.locator('[data-testid=free-way] .dot').boundingBox(), lab.id('free-valve-plane').boundingBox()]);
  expect(dot.x).toBeGreaterThan(plane.x + 0.3 * plane.width);
  expect(dot.y).toBeGreaterThan(plane.y + 0.2 * plane.height);
  await press(lab, 'free-a', 'free-s1');
  await lab.type('free-gamma1', '0.7');
  await lab.type('free-gamma2', '0.3');
  expect(await lab.text('free-stability')).toContain('The last references cannot be held at rest. With γ₁ + γ₂ = 1');
  expect(await lab.text('free-verdict')).toMatch(/Not settled.*first ran over/);
});

test('a link restores the run, its settings and the cursor in a new page', async ({ lab, context, page }) => {
  await lab.open(BENCH);
  await press(lab, 'free-b', 'free-sliding', 'free-pi');
  await lab.type('free-alpha-number', '0.15');
  await lab.type('free-time-number', '77');
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.id('share').click();
  await expect(lab.id('notice')).toBeVisible();
  const address = page.url();
  expect(address).toMatch(/#lab=q3\.[\w-]+$/);
  expect(address.length).toBeLessThan(2000);
  const other = await context.newPage();
  lab.watch(other);
  await other.goto(address);
  await lab.ready(other);
  expect(await other.getByTestId('free-alpha-number').inputValue()).toBe('0.150');
  expect(await other.getByTestId('free-time-number').inputValue()).toBe('77');
  await expect(other.getByTestId('free-sliding')).toHaveAttribute('aria-pressed', 'true');
  for (const table of ['free-figures', 'free-costs']) {
    expect(await other.getByTestId(table).innerText()).toBe(await lab.id(table).innerText());
  }
});

test('the claims of the paper have the verdicts that the numbers give them, and each shows its case', async ({ lab }) => {
  await lab.open(BENCH);
  const claim = async (name) => lab.text(`claim-${name}`);
  expect(await claim('a')).toMatch(/reproduced.*IAE 190 cm s, overshoot 23 %.*8 % of the time.*122 s/);
  expect(await claim('b')).toMatch(/only for equal set-points and a limited time.*112 cm s, against 78.*1018 s.*1190 s/);
  expect(await claim('zero')).toMatch(/not reproduced.*115 s later.*−0.80.*−1.25/);
  expect(await claim('c')).toMatch(/only for equal set-points and a limited time.*0.13 cm.*part by 5\.1 cm.*1\.95 cm/);
  expect(await claim('alpha')).toMatch(/large enough.*0.0633.*0.0629/);
  for (const [name, verdict] of [['a', 'All settles'], ['b', 'Level 2 is lost at 1190 s'], ['zero', 'Level 1 is lost at 135 s'], ['c', 'ripple'], ['alpha', 'Not settled']]) {
    await press(lab, `claim-${name}-show`);
    await expect(lab.id('free-verdict')).toBeInViewport();
    expect(await lab.text('free-verdict'), name).toContain(verdict);
  }
});

test('the course is exported, zoomed and read by keyboard', async ({ lab, page }) => {
  await lab.open(BENCH);
  await page.locator('[data-testid=model-free-menu] > summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('model-free-csv').click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const lines = Buffer.concat(chunks).toString().trim().split('\n');
  expect(lines[0]).toContain('phi_estimate_1_m_per_s');
  expect(lines.length).toBe(322);
  await page.keyboard.press('Escape');
  await tabTo(page, 'free-surface');
  const whole = await lab.picture('free-course');
  await page.keyboard.press('+');
  await page.keyboard.press('ArrowRight');
  await lab.settle();
  expect((await lab.picture('free-course')).hash).not.toBe(whole.hash);
  await expect(lab.id('free-surface')).toHaveAttribute('aria-valuetext', /t = \d+ s.*h₃.*φ̂₁ -?−?\d.*φ₁/);
  await page.keyboard.press('0');
  await page.keyboard.press('Escape');
  await lab.settle();
  expect((await lab.picture('free-course')).hash).toBe(whole.hash);
});

for (const [theme, language] of LOOKS) {
  test(`${theme}, ${language}: axe finds nothing, and nothing is cut off at any width`, async ({ lab, page }) => {
    await lab.open(`${BENCH}&theme=${theme}&lang=${language}`);
    for (const width of [1440, 1024, 390]) {
      await page.setViewportSize({ width, height: width === 390 ? 844 : 900 });
      for (const name of ['free-a', 'free-b', 'free-c']) {
        await press(lab, name);
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      }
      await lab.axe();
    }
    await lab.clean();
  });
}

test('one card, locked, in a course page', async ({ lab, page }) => {
  await lab.open(`${BENCH}&embed=1&panels=responses,experiment&lock=valves`);
  await expect(lab.id('free-a')).toBeDisabled();
  await expect(lab.id('free-s3')).toBeEnabled();
  await expect(page.locator('.card')).toHaveCount(2);
  expect((await lab.id('free-course').boundingBox()).height).toBeGreaterThan(400);
  await lab.axe();
});

test('a first visit tries the easy side, the hard side, and waits', async ({ lab, page }) => {
  await lab.open(`${BENCH}&view=explore&lang=en`);
  await expect(lab.id('try-easy')).toHaveAttribute('aria-pressed', 'true');
  expect(await lab.text('free-verdict')).toContain('All settles');
  await expect(lab.id('free-a')).toBeHidden();
  await lab.id('try-hard').click();
  await lab.settle();
  await expect(lab.id('try-hard')).toHaveAttribute('aria-pressed', 'true');
  await lab.id('try-wait').click();
  await lab.settle();
  expect(await lab.text('free-verdict')).toContain('is lost at');
  // All else opens in place.
  for (const [drawer, inside] of [['case', 'free-c'], ['law', 'free-kp'], ['zeros', 'free-moment'], ['claims', 'claim-a']]) {
    await lab.id(`drawer-${drawer}`).click();
    await expect(lab.id(inside)).toBeVisible();
  }
  await lab.clean();
  await lab.axe();
  await page.keyboard.press('Control+z');
  await lab.settle();
  await lab.id('view-full').click();
  await expect(lab.id('free-figures')).toBeVisible();
});
