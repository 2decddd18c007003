// An experiment leaves the page as a link or a file and comes back whole.
import { readFile } from 'node:fs/promises';
import { Lab, expect, test } from './lab.mjs';

async function change(lab, page) {
  await lab.preset('johansson-2000-non-minimum-phase');
  await lab.id('pairing-swapped').click();
  await lab.type('gain1-number', '0.3');
  await lab.type('integral2-number', '160');
  await lab.type('step1-number', '1.25');
  await lab.id('pin').click();
  await lab.type('gamma2-number', '0.27');
  await lab.id('responses-surface').focus();
  for (let k = 0; k < 5; k += 1) await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('+');
  await lab.id('linear').click();
  await lab.settle();
}

async function state(lab) {
  const fields = ['gamma1-number', 'gamma2-number', 'gain1-number', 'gain2-number', 'integral1-number', 'integral2-number', 'step1-number', 'step1-time', 'duration-number'];
  const values = await Promise.all(fields.map((name) => lab.id(name).inputValue()));
  const pressed = await Promise.all(['pairing-swapped', 'linear'].map((name) => lab.id(name).getAttribute('aria-pressed')));
  const table = await lab.id('metrics').innerText();
  return [...values, ...pressed, table, await lab.text('readout'), await lab.id('preset').inputValue()];
}

test('a shared link restores everything in a new page and after a reload', async ({ lab, page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.open();
  await change(lab, page);
  const before = await state(lab);
  const picture = await lab.picture('responses');
  await lab.id('share').click();
  await expect(lab.id('notice')).toContainText('Link copied');
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link.split('#')[1].length).toBeLessThanOrEqual(2000);

  const other = await context.newPage();
  const second = new Lab(other, lab.origin, lab.complaints);
  second.watch(other);
  await other.goto(link);
  await second.ready();
  expect(await state(second)).toEqual(before);
  expect(await second.picture('responses')).toEqual(picture);

  await page.reload();
  await lab.ready();
  expect(await state(lab)).toEqual(before);
});

test('opening a link leaves the remembered choices alone', async ({ lab, page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.open();
  await lab.id('theme').click();
  await lab.id('language').selectOption('pt-BR');
  const kept = await page.evaluate(() => JSON.stringify({ ...localStorage }));
  await lab.id('share').click();
  await expect(lab.id('notice')).toBeVisible();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  await page.goto('about:blank');
  await page.goto(link.replace('/?', '/?lang=en&theme=light&'));
  await lab.ready();
  await expect(page.locator('html')).toHaveAttribute('lang', 'en');
  expect(await page.evaluate(() => JSON.stringify({ ...localStorage }))).toBe(kept);
});

test('a link that is opened on a page that runs already is followed as well', async ({ lab, page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.open();
  await change(lab, page);
  const before = await state(lab);
  await lab.id('share').click();
  await expect(lab.id('notice')).toBeVisible();
  const [, fragment] = (await page.evaluate(() => navigator.clipboard.readText())).split('#');
  await lab.open('preset=cocota-2009-minimum-phase');
  await page.evaluate((f) => (location.hash = f), fragment);
  await expect(lab.id('gamma2-number')).toHaveValue('0.27');
  await lab.settle();
  expect(await state(lab)).toEqual(before);
  await page.evaluate(() => (location.hash = 'lab=nonsense'));
  await expect(lab.id('notice')).toContainText('could not be used');
  expect(await state(lab)).toEqual(before);
});

test('the share link can be taken by hand where there is no clipboard', async ({ lab, page }) => {
  await page.addInitScript(() => Object.defineProperty(navigator, 'clipboard', { value: undefined }));
  await lab.open();
  await lab.type('gamma1-number', '0.35');
  await lab.id('share').click();
  const link = await lab.id('link').inputValue();
  await page.goto('about:blank');
  await page.goto(link);
  await lab.ready();
  expect(await lab.value('gamma1-number')).toBe(0.35);
});

const BAD = ['lab=', 'lab=q1.AAAA', 'lab=%00%ff', `lab=q1.${'A'.repeat(5000)}`, 'lab=q9.eJw', 'lab=<script>alert(1)</script>', 'lab=q1.-_-_-_-_-_'];
for (const fragment of BAD) {
  test(`a hostile link (${fragment.slice(0, 14)}) gives a message and a working bench`, async ({ lab }) => {
    await lab.open('', fragment);
    await expect(lab.id('notice')).toContainText('could not be used');
    expect(await lab.number('lambda-11')).toBeCloseTo(1.4, 2);
    await lab.type('gamma1-number', '0.3');
    expect(await lab.number('lambda-11')).toBeLessThan(0);
    await lab.clean();
  });
}

test('a link cut off at any place gives a message, never a broken bench', async ({ lab, page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await lab.open();
  await change(lab, page);
  await lab.id('share').click();
  await expect(lab.id('notice')).toBeVisible();
  const [, fragment] = (await page.evaluate(() => navigator.clipboard.readText())).split('#');
  for (const part of [0.2, 0.5, 0.8, 0.97]) {
    await page.goto('about:blank');
    await lab.open('', fragment.slice(0, Math.floor(fragment.length * part)));
    await expect(lab.id('notice')).toContainText('could not be used');
    await lab.clean();
  }
});

test('an experiment is saved as a file and opened again', async ({ lab, page }) => {
  await lab.open();
  await change(lab, page);
  const before = await state(lab);
  await lab.id('file-menu').locator('summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('save').click()]);
  const file = await download.path();
  const document = JSON.parse(await readFile(file, 'utf8'));
  expect(document.version).toBe(1);
  await lab.open();
  await lab.id('open-input').setInputFiles(file);
  await expect(lab.id('gamma2-number')).toHaveValue('0.27');
  await lab.settle();
  expect(await state(lab)).toEqual(before);
});

test('a broken file names the field and the reason', async ({ lab, page }) => {
  await lab.open();
  await lab.id('file-menu').locator('summary').click();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('save').click()]);
  const good = await readFile(await download.path(), 'utf8');
  const open = (text) => lab.id('open-input').setInputFiles({ name: 'x.json', mimeType: 'application/json', buffer: Buffer.from(text) });
  const broken = JSON.parse(good);
  broken.setup.valves[0] = 1.5;
  await open(JSON.stringify(broken));
  await expect(lab.id('notice')).toContainText('setup.valves[0]');
  await expect(lab.id('notice')).toContainText('1.5');
  broken.setup.valves[0] = 'open';
  await open(JSON.stringify(broken));
  await expect(lab.id('notice')).toContainText('setup.valves[0]');
  await open(good.replace('"version": 1', '"version": 7').replace('"version":1', '"version":7'));
  await expect(lab.id('notice')).toContainText('version');
  await open('{');
  await expect(lab.id('notice')).toContainText('could not be used');
  await lab.clean();
});

test('an experiment has a name and a note: in header, link, undo and the names of files', async ({ lab, page }) => {
  await lab.open('lang=en');
  await lab.page.locator('[data-testid=file-menu] > summary').click();
  await lab.id('experiment-name').fill('Ensaio 3: γ₁ = 0,7');
  await lab.id('experiment-note').fill('Two lines,\nsecond line');
  await lab.id('experiment-note').blur();
  await expect(lab.id('shown-name')).toHaveText('Ensaio 3: γ₁ = 0,7');
  await expect(lab.id('shown-name')).toHaveAttribute('title', 'Two lines,\nsecond line');
  await lab.axe();
  const [download] = await Promise.all([page.waitForEvent('download'), lab.id('save').click()]);
  expect(download.suggestedFilename()).toBe('ensaio-3-γ₁-0-7-quadtank-experiment.json');
  await page.waitForTimeout(600);
  await page.reload();
  await lab.ready();
  await expect(lab.id('shown-name')).toHaveText('Ensaio 3: γ₁ = 0,7');
  await lab.type('gain1-number', '4');
  await page.waitForTimeout(600);
  await lab.id('reset').click();
  await expect(lab.id('shown-name')).toBeHidden();
  await lab.id('undo').click();
  await expect(lab.id('shown-name')).toBeVisible();
});

for (const bench of ['quadruple-tank', 'relay-tuning', 'model-free', 'level-loop']) {
  test(`${bench} prints a handout with pictures, numbers, link and code`, async ({ lab, page }) => {
    await lab.open(`bench=${bench}&lang=en&theme=dark`);
    await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
    await page.emulateMedia({ media: 'print' });
    const handout = lab.id('handout');
    await expect(handout).toBeVisible();
    await expect(page.locator('header.top')).toBeHidden();
    await expect(page.locator('main')).toBeHidden();
    expect(await handout.locator('figure svg').count()).toBeGreaterThanOrEqual(3);
    for (const says of await handout.locator('figcaption').allInnerTexts()) expect(says.length).toBeGreaterThan(20);
    expect(await handout.locator('li').count()).toBeGreaterThan(15);
    await expect(handout.locator('svg.code path')).toHaveAttribute('d', /^M0 0h1v1h-1z/);
    const link = await handout.locator('.link').innerText();
    expect(link).toContain('#');
    const pdf = await page.pdf();
    expect(pdf.length).toBeGreaterThan(20_000);
    await page.evaluate(() => dispatchEvent(new Event('afterprint')));
    await page.emulateMedia({ media: 'screen' });
    await expect(handout.locator('figure')).toHaveCount(0);
    // The link leads to the same experiment.
    await page.goto(link);
    await lab.ready();
    await lab.clean();
  });
}

test('gains and rigs travel from bench to bench', async ({ lab, page }) => {
  await lab.open('lang=en');
  await lab.type('gamma1-number', '0.65');
  await lab.id('to-relays').click();
  await lab.settle();
  expect(page.url()).toContain('bench=relay-tuning');
  expect(await lab.value('rig-gamma1')).toBe(0.65);
  expect(await lab.text('test-verdict')).toContain('Unimodal');
  // Derivative action has no place on the rig.
  await lab.id('action-pid').click();
  await lab.settle();
  await expect(lab.id('to-rig')).toBeHidden();
  await lab.id('action-pi').click();
  await lab.settle();
  await lab.id('mend-placement').click();
  await lab.settle();
  await lab.id('to-rig').click();
  await lab.settle();
  expect(page.url()).toContain('bench=quadruple-tank');
  expect(await lab.value('gamma1-number')).toBe(0.65);
  expect(await lab.value('gain1-number')).not.toBe(3);
  expect(await lab.text('stability')).toContain('Closed loop stable');
  await lab.id('to-model-free').click();
  await lab.settle();
  expect(page.url()).toContain('bench=model-free');
  await expect(lab.id('free-pi')).toHaveAttribute('aria-pressed', 'true');
  await lab.clean();
  await page.goBack();
  await lab.settle();
  expect(page.url()).toContain('bench=quadruple-tank');
});

test('a rig of one\'s own is tuned by relays and comes back with its gains', async ({ lab, page }) => {
  await lab.open('lang=en');
  await lab.page.locator('[data-testid=operating-point-fold] > summary').click();
  await lab.id('rig-numbers').locator('summary').click();
  await lab.type('rig-area1', '40');
  await lab.type('rig-name', 'Bench 7');
  await lab.id('to-relays').click();
  await lab.settle();
  expect(page.url()).toContain('bench=relay-tuning');
  await expect(lab.id('plant').locator('option:checked')).toHaveText('Own rig');
  expect(await lab.text('test-verdict')).toContain('Unimodal');
  // Its period is not that of the rig with 28 cm², and the nonlinear plant is there as for a published rig.
  const verdict = await lab.text('test-verdict');
  await lab.id('rig-nonlinear').click();
  await lab.settle();
  expect(await lab.text('plant-remark')).toContain('Own rig');
  await lab.id('rig-linear').click();
  await lab.settle();
  expect(await lab.text('test-verdict')).toBe(verdict);
  await lab.axe();
  await lab.id('action-pi').click();
  await lab.settle();
  await lab.id('mend-placement').click();
  await lab.settle();
  await lab.id('to-rig').click();
  await lab.settle();
  expect(page.url()).toContain('bench=quadruple-tank');
  expect(await lab.text('stability')).toContain('Closed loop stable');
  await expect(lab.id('preset').locator('option:checked')).toHaveText('Bench 7');
  if (!(await lab.id('rig-area1').isVisible())) await lab.id('rig-numbers').locator('summary').click();
  expect(await lab.value('rig-area1')).toBe(40);
  // The nonlinear plant of that bench has no hoses, and says so.
  await lab.type('rig-delay1', '4');
  await lab.id('to-relays').click();
  await lab.settle();
  await lab.id('rig-nonlinear').click();
  await expect(lab.id('notice')).toContainText('delay_s');
  await expect(lab.id('rig-linear')).toHaveAttribute('aria-pressed', 'true');
  await lab.clean();
});

test('the experiment is exported as a script in three languages', async ({ lab, page }) => {
  await lab.open('lang=en&preset=johansson-2000-minimum-phase');
  for (const [extension, sign] of [['py', 'GAMMA = np.array([0.7, 0.6])'], ['m', 'p.gamma = [0.7, 0.6];'], ['jl', 'const GAMMA = [0.7, 0.6]']]) {
    await lab.id('file-menu').locator('summary').click();
    const download = page.waitForEvent('download');
    await lab.id(`script-${extension}`).click();
    const file = await download;
    expect(file.suggestedFilename()).toBe(`quadtank_experiment.${extension}`);
    let text = '';
    for await (const piece of await file.createReadStream()) text += piece;
    expect(text).toContain(sign);
    await page.keyboard.press('Escape');
  }
  await lab.bench('relay-tuning');
  await lab.id('file-menu').locator('summary').click();
  await expect(lab.id('script-py')).toHaveCount(0);
});
