// Language, theme and the flags that an instructor puts into the address.
import { expect, test } from './lab.mjs';

// Words that only the English texts hold.
const ENGLISH = /\b(level|pump|valve|zero in the|step|settle|gain array|share|file|about|run|pinned|whole|noise|load|reference)\b/i;
const PORTUGUESE = /\b(nível|bomba|válvula|degrau|ganhos|compartilhar|arquivo|sobre|ruído|carga)\b/i;

test('every text is there in both languages, with the numbers as they are written there', async ({ lab, page }) => {
  await lab.open('preset=johansson-2000-non-minimum-phase');
  for (const summary of await page.locator('details > summary').all()) await summary.click();
  const english = await page.locator('body').innerText();
  expect(english).not.toMatch(PORTUGUESE);
  await lab.id('language').selectOption('pt-BR');
  await lab.settle();
  await expect(page.locator('html')).toHaveAttribute('lang', 'pt-BR');
  const portuguese = await page.locator('body').innerText();
  expect(portuguese).toMatch(PORTUGUESE);
  expect(portuguese.replace(/English|Johansson|offset|PI |feedback/g, '')).not.toMatch(ENGLISH);
  expect(await lab.text('lambda-11')).toBe('−0,64');
  expect(await lab.id('gamma1-number').inputValue()).toBe('0,43');
  await lab.clean();
  const labels = await page.locator('[aria-label]').evaluateAll((all) => all.map((e) => e.getAttribute('aria-label')).join('\n'));
  expect(labels).not.toMatch(ENGLISH);
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

for (const theme of ['light', 'dark']) {
  for (const lang of ['en', 'pt-BR']) {
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
}
