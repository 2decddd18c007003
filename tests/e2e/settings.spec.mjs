// Language, theme and the flags that an instructor puts into the address.
import { LOOKS, Lab, expect, test } from './lab.mjs';

// Words that only the English texts hold.
const ENGLISH = /\b(level|pump|valve|zero in the|step|settle|gain array|share|file|about|run|pinned|whole|noise|load|reference)\b/i;
const PORTUGUESE = /\b(nível|bomba|válvula|degrau|ganhos|compartilhar|arquivo|sobre|ruído|carga)\b/i;

/** Everything that is written on the page or read out by a screen reader. */
async function texts(page) {
  const written = await page.locator('body').innerText();
  const spoken = await page.locator('[aria-label], [aria-valuetext], [title]').evaluateAll((all) =>
    all.flatMap((e) => ['aria-label', 'aria-valuetext', 'title'].map((name) => e.getAttribute(name) ?? '')).join('\n'),
  );
  return `${written}\n${spoken}`;
}

test('every text is there in both languages, with the numbers as they are written there', async ({ lab, page }) => {
  await lab.open('preset=johansson-2000-non-minimum-phase');
  await lab.id('load-kind').selectOption('leak1');
  await lab.id('pin').click();
  // All at once, as no pointer could: menus lie over what is beside them.
  const openAll = () => page.evaluate(() => document.querySelectorAll('details').forEach((details) => (details.open = true)));
  await openAll();
  await lab.settle();
  const english = await texts(page);
  expect(english).toMatch(ENGLISH);
  expect(english).not.toMatch(PORTUGUESE);
  const drawn = await lab.picture('valve-plane');
  await lab.id('language').selectOption('pt-BR');
  await lab.settle();
  await expect(page.locator('html')).toHaveAttribute('lang', 'pt-BR');
  const portuguese = await texts(page);
  expect(portuguese).toMatch(PORTUGUESE);
  expect(portuguese.match(ENGLISH)).toBeNull();
  expect((await lab.picture('valve-plane')).hash).not.toBe(drawn.hash);
  // Styles of CSV show how other countries write numbers.
  const styles = await lab.id('csv-style').locator('option').allTextContents();
  const withoutStyles = styles.reduce((text, style) => text.replaceAll(style, ''), portuguese);
  expect(withoutStyles.replaceAll('Apache-2.0', '').replaceAll(/\d+\.\d+\.\d+/g, '').match(/\d\.\d/)).toBeNull();
  expect(await lab.text('lambda-11')).toBe('−0,64');
  expect(await lab.id('gamma1-number').inputValue()).toBe('0,43');
  await lab.clean();
});

test('the title of the page follows the language', async ({ lab, page }) => {
  await lab.open('lang=en');
  await expect(page).toHaveTitle(/laboratory/);
  await lab.id('language').selectOption('pt-BR');
  await expect(page).toHaveTitle(/laboratório/);
});

test('the language of the browser is spoken where none was chosen', async ({ browser, lab }) => {
  const context = await browser.newContext({ locale: 'pt-BR', colorScheme: 'dark' });
  const page = await context.newPage();
  lab.watch(page);
  await page.goto(`${lab.origin}/`);
  await lab.ready(page);
  await expect(page.locator('html')).toHaveAttribute('lang', 'pt-BR');
  await expect(page.locator('html')).toHaveAttribute('data-theme', 'dark');
  await context.close();
});

test('a theme changes the page and every picture', async ({ lab, page }) => {
  await lab.open('theme=light');
  const names = ['valve-plane', 'pole-zero', 'responses'];
  const look = async () => [
    await page.evaluate(() => getComputedStyle(document.body).backgroundColor),
    ...(await Promise.all(names.map(async (name) => (await lab.picture(name)).hash))),
  ];
  const light = await look();
  await lab.id('theme').click();
  await lab.settle();
  const dark = await look();
  for (const [k, value] of dark.entries()) expect(value, ['page', ...names][k]).not.toBe(light[k]);
  await lab.id('theme').click();
  await lab.settle();
  expect(await look()).toEqual(light);
});

test('the chosen language and theme are remembered', async ({ lab, page }) => {
  await lab.open();
  await lab.id('language').selectOption('pt-BR');
  await lab.id('theme').click();
  await page.goto(`${lab.origin}/`);
  await lab.ready();
  await expect(page.locator('html')).toHaveAttribute('lang', 'pt-BR');
  await expect(page.locator('html')).toHaveAttribute('data-theme', 'dark');
});

test('flags in the address choose without being remembered', async ({ lab, page }) => {
  await lab.open('lang=pt-BR&theme=dark');
  await expect(page.locator('html')).toHaveAttribute('lang', 'pt-BR');
  await expect(page.locator('html')).toHaveAttribute('data-theme', 'dark');
  await page.goto(`${lab.origin}/`);
  await lab.ready();
  await expect(page.locator('html')).toHaveAttribute('lang', 'en');
  await expect(page.locator('html')).toHaveAttribute('data-theme', 'light');
});

test('an embedded bench shows the chosen cards, without header, with locked controls', async ({ lab, page }) => {
  await lab.open('embed=1&panels=valves,rga,controller&lock=gains,valves&preset=johansson-2000-non-minimum-phase');
  await expect(page.locator('header.top')).toHaveCount(0);
  await expect(page.locator('section.card')).toHaveCount(3);
  await expect(lab.id('gain1')).toBeDisabled();
  await expect(lab.id('gain1-number')).toBeDisabled();
  await expect(lab.id('pairing-swapped')).toBeEnabled();
  await lab.id('valve-handle').focus();
  await page.keyboard.press('ArrowRight');
  await lab.settle();
  expect(await lab.number('lambda-11')).toBeCloseTo(-0.64, 9);
  await lab.axe();
});

const PANELS = { process: 'process', valves: 'plane', zeros: 'zeros', rga: 'rga', controller: 'pi', experiment: 'experiment', why: 'why', responses: 'responses' };
test('a menu closes with Escape, with a press elsewhere, and when another opens', async ({ lab, page }) => {
  await lab.open();
  const menu = lab.id('file-menu');
  for (const close of [() => page.keyboard.press('Escape'), () => page.locator('.top h1').click(), () => page.locator('.about > summary').click()]) {
    await menu.locator('summary').click();
    await expect(menu).toHaveAttribute('open', '');
    await close();
    await expect(menu).not.toHaveAttribute('open', '');
  }
  await expect(page.locator('.about')).toHaveAttribute('open', '');
});

test('from an embedded bench the whole lab opens with what is shown', async ({ lab, page, context }) => {
  await lab.open('embed=1&preset=cocota-2009-minimum-phase');
  await lab.type('gamma1-number', '0.52');
  await lab.settle();
  const [opened] = await Promise.all([context.waitForEvent('page'), lab.id('full-lab').click()]);
  const whole = new Lab(opened, lab.origin, lab.complaints);
  await expect(whole.id('preset').locator('option:checked')).toHaveText('Cocota 2009 · P−, changed');
  expect(await whole.value('gamma1-number')).toBe(0.52);
  await expect(opened.locator('header.top')).toBeVisible();
});

test('each panel can be shown alone', async ({ lab, page }) => {
  for (const [panel, card] of Object.entries(PANELS)) {
    await lab.open(`panels=${panel}`);
    await expect(page.locator('section.card')).toHaveCount(1);
    await expect(page.locator(`section.card.${card}`)).toBeVisible();
    await lab.clean();
  }
});

const NONSENSE = { panels: 'nonsense', lock: 'nonsense', lang: 'xx', theme: 'blue', preset: 'none', bench: 'none' };
test('what is not understood in the address has no effect and is named', async ({ lab, page }) => {
  const pairs = Object.entries(NONSENSE).map(([flag, value]) => `${flag}=${value}`);
  await lab.open(`${pairs.join('&')}&view=full`);
  await expect(page.locator('section.card')).toHaveCount(8);
  await expect(page.locator('html')).toHaveAttribute('lang', 'en');
  for (const pair of pairs) await expect(lab.id('notice')).toContainText(pair);
  await lab.id('language').selectOption('pt-BR');
  await expect(lab.id('notice')).toContainText('Partes do endereço');
  await lab.id('notice').getByRole('button').click();
  await expect(lab.id('notice')).toHaveCount(0);

  await lab.open('embed=1&panels=valves,<b>x</b>&utm_source=mail&lang=en');
  await expect(page.locator('section.card')).toHaveCount(1);
  await expect(lab.id('notice')).toContainText('panels=<b>x</b>');
  await expect(lab.id('notice')).not.toContainText('utm_source');
  await lab.axe();

  await lab.open('embed=1&panels=valves&utm_source=mail&fbclid=1');
  await expect(lab.id('notice')).toHaveCount(0);
});

test('a language may be named by a part of its tag, as links from elsewhere do', async ({ lab, page }) => {
  for (const [asked, tag] of [['pt', 'pt-BR'], ['pt-PT', 'pt-BR'], ['es-MX', 'es'], ['en-GB', 'en']]) {
    await lab.open(`lang=${asked}`);
    await expect(page.locator('html'), asked).toHaveAttribute('lang', tag);
    await expect(lab.id('notice'), asked).toHaveCount(0);
  }
});

// What each lock disables, by data-testid.
const LOCKS = {
  preset: ['preset'],
  valves: ['gamma1', 'gamma1-number', 'gamma2', 'gamma2-number'],
  voltages: ['standing', 'voltage1', 'voltage2'],
  pairing: ['pairing-diagonal', 'pairing-swapped', 'try-advised'],
  gains: ['gain1', 'gain1-number', 'gain2', 'gain2-number', 'integral1', 'integral1-number', 'integral2', 'integral2-number', 'sign1', 'sign2', 'try-advised'],
  sampling: ['antiwindup', 'manual1', 'manual2', 'sampling', 'sampling-number', 'tracking', 'tracking-number', 'weight', 'weight-number'],
  experiment: ['duration', 'duration-number', 'flow-noise', 'flow-noise-number', 'inflow-remove', 'load-kind', 'noise', 'noise-number', 'pump-table-use', 'pumps-kind', 'quantised', 'start-kind', 'step-add', ...[1, 2].flatMap((k) => [`step-level-${k}`, `step-remove-${k}`, `step-size-${k}`, `step-time-${k}`]), 'step1', 'step1-number', 'step1-time', 'step2', 'step2-number', 'step2-time'],
};
test('each lock disables its controls and no other', async ({ lab, page }) => {
  const disabled = () =>
    // Nothing has been done that could be undone.
    page.evaluate(() => [...document.querySelectorAll('input:disabled, select:disabled, main button:disabled')].map((e) => e.dataset.testid).sort());
  await lab.open();
  expect(await disabled()).toEqual([]);
  for (const [lock, controls] of Object.entries(LOCKS)) {
    await lab.open(`lock=${lock}`);
    expect(await disabled(), lock).toEqual([...controls].sort());
    // Where the steps are fixed there is nothing to try.
    await expect(lab.id('try-easy')).toHaveCount(lock === 'experiment' ? 0 : 1);
  }
  const handles = () => page.evaluate(() => [...document.querySelectorAll('[aria-disabled=true]')].map((e) => e.dataset.testid).sort());
  expect(await handles()).toEqual(['mark1', 'mark2', 'set-point1', 'set-point2']);
  await lab.open('lock=preset,valves');
  expect(await handles()).toEqual(['valve-handle', 'valve1', 'valve2']);
  await lab.id('valve1').focus();
  await page.keyboard.press('ArrowUp');
  await lab.id('point-johansson-2000-non-minimum-phase').locator('.hit').click();
  await lab.settle();
  expect(await lab.value('gamma1-number')).toBe(0.7);
});

for (const [theme, lang] of LOOKS) {
  test(`axe finds nothing in ${theme}, ${lang}, with every part open`, async ({ lab, page }) => {
    await lab.open(`theme=${theme}&lang=${lang}&preset=johansson-2000-non-minimum-phase`);
    await lab.axe();
    await lab.id('pin').click();
    await lab.id('load-kind').selectOption('leak1');
    await lab.type('gamma1-number', '7');
    for (const summary of await page.locator('section details.more > summary').all()) await summary.click();
    await lab.id('manual1').check();
    await lab.settle();
    await lab.axe();
  });
}

test('a gain of 0 opens a loop, and the page says so', async ({ lab }) => {
  await lab.open('lang=en');
  await lab.type('gain1-number', '0');
  await expect(lab.id('gain1-number')).not.toHaveAttribute('aria-invalid', 'true');
  await expect(lab.id('open1')).toBeVisible();
  await expect(lab.id('open2')).toBeHidden();
  expect(await lab.text('stability')).toContain('Closed loop stable');
  await lab.clean();
  await lab.id('gain1-number').fill('0.0001');
  await expect(lab.id('gain1-number')).toHaveAttribute('aria-invalid', 'true');
  await lab.type('gain1-number', '2');
  await expect(lab.id('open1')).toBeHidden();
});

test('screen readers hear the results of a change once, when it has come to rest', async ({ lab, page }) => {
  await lab.open('view=full&lang=en');
  const region = lab.id('live-region');
  await page.waitForTimeout(1500);
  await expect(region).toBeEmpty();
  await page.evaluate(() => {
    window.heard = [];
    const region = document.querySelector('[data-testid=live-region]');
    new MutationObserver(() => window.heard.push(region.textContent)).observe(region, { childList: true, characterData: true, subtree: true });
  });
  await lab.id('gamma1').focus();
  for (let k = 0; k < 3; k += 1) {
    await page.keyboard.press('PageDown');
    await lab.settle();
  }
  await expect(region).toContainText('γ₁ + γ₂ = ');
  await expect(region).toContainText('pole');
  const heard = await page.evaluate(() => window.heard.filter(Boolean));
  expect(heard).toHaveLength(1);
  // What has not changed is not told, and neither is a new language.
  await lab.id('language').selectOption('es');
  await page.waitForTimeout(1500);
  await expect(region).toBeEmpty();
  expect(await page.locator('[data-result][role=status]').count()).toBe(0);
});
