// How it stands on screens of several sizes. Pictures go to the report of the run.
import { LOOKS, expect, test } from './lab.mjs';

const SIZES = [
  [1440, 900],
  [1024, 768],
  [390, 844],
  [360, 740],
];

/** Elements whose content is cut off, outside what scrolls on purpose; and texts that leave the drawing of the rig. */
const cutOff = (page) =>
  page.evaluate(() => {
    const name = (e) => `${e.tagName}.${e.getAttribute('class')} ${e.dataset.testid ?? ''} ${e.textContent.slice(0, 40)}`;
    const seen = (e) => e.checkVisibility({ contentVisibilityAuto: true, visibilityProperty: true });
    const boxes = [...document.querySelectorAll('#app *')]
      .filter((e) => seen(e) && e.clientWidth > 0 && getComputedStyle(e).display !== 'inline')
      .filter((e) => !e.closest('svg, math, select, .visually-hidden'));
    const wide = boxes.filter((e) => e.scrollWidth > e.clientWidth + 1 && !e.closest('.scroll'));
    const clips = (e) => ['hidden', 'clip'].includes(getComputedStyle(e).overflowY);
    const high = boxes.filter((e) => clips(e) && e.scrollHeight > e.clientHeight + 1);
    const paper = document.querySelector('svg.rig')?.getBoundingClientRect();
    const outside = [...document.querySelectorAll('svg.rig text')].filter((e) => {
      const box = e.getBoundingClientRect();
      return box.left < paper.left - 1 || box.right > paper.right + 1;
    });
    return [...wide, ...high, ...outside].map(name);
  });

const openAll = async (lab, page) => {
  for (const summary of await page.locator('section details.more > summary').all()) await summary.click();
  await lab.id('manual1').check();
  await lab.id('load-kind').selectOption('leak1');
  await lab.settle();
};

const BENCHES = ['quadruple-tank', 'relay-tuning', 'model-free', 'level-loop'];

for (const [width, height] of SIZES) {
  for (const [theme, lang] of LOOKS) {
    test(`${width} × ${height}, ${theme}, ${lang}: nothing is cut off`, async ({ lab, page }, info) => {
      await page.setViewportSize({ width, height });
      await lab.open(`theme=${theme}&lang=${lang}&preset=cocota-2009-non-minimum-phase`);
      const sheet = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
      expect(sheet[0]).toBeLessThanOrEqual(width);
      if (width === 1440) expect(sheet[1]).toBeLessThanOrEqual(height);
      expect(await cutOff(page)).toEqual([]);
      await info.attach('page', { body: await page.screenshot({ fullPage: true }), contentType: 'image/png' });
      for (const name of ['valve-plane', 'pole-zero', 'responses']) {
        const box = await lab.id(name).boundingBox();
        expect(box.width).toBeGreaterThan(140);
        expect(box.height).toBeGreaterThan(140);
        const picture = await lab.picture(name);
        expect(picture.ink).toBeGreaterThan(1000);
        expect(picture.colours).toBeGreaterThan(20);
      }
      await openAll(lab, page);
      expect(await cutOff(page)).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      await info.attach('page with every part open', { body: await page.screenshot({ fullPage: true }), contentType: 'image/png' });
    });
  }
}

for (const lang of ['en', 'pt-BR', 'es']) {
  test(`1440 × 900, ${lang}: every published rig has its whole page in the window`, async ({ lab, page }) => {
    await page.setViewportSize({ width: 1440, height: 900 });
    await lab.open(`lang=${lang}`);
    const presets = await lab.id('preset').locator('option').evaluateAll((options) => options.map((option) => option.value).filter(Boolean));
    expect(presets.length).toBeGreaterThan(3);
    const tooHigh = [];
    for (const preset of presets) {
      await lab.id('preset').selectOption(preset);
      await lab.settle();
      const height = await page.evaluate(() => document.documentElement.scrollHeight);
      if (height > 900) tooHigh.push(`${preset}: ${height}`);
    }
    expect(tooHigh).toEqual([]);
  });
}

test('in the colours of the reader charts keep their ground, and what is chosen stays told', async ({ lab, page }) => {
  await page.emulateMedia({ forcedColors: 'active' });
  await lab.open('lang=en');
  const [chart, handles, chosen, other] = await page.evaluate(() => {
    const plane = document.querySelector('[data-testid=valve-plane]').closest('.chart');
    const [chosen, other] = [true, false].map((is) => document.querySelector(`.segmented button[aria-pressed="${is}"]`));
    return [plane, plane.querySelector('svg'), chosen, other].map((element) => getComputedStyle(element).backgroundColor);
  });
  // The handles lie over the picture: a ground of their own would hide it.
  expect(handles).toBe('rgba(0, 0, 0, 0)');
  expect(chart).toBe('rgb(255, 255, 255)');
  expect(chosen).not.toBe(other);
});

for (const [width, height] of [[1440, 900], [1920, 1080]]) {
  for (const lang of ['en', 'pt-BR']) {
    test(`${width} × ${height}, ${lang}: pictures keep their size while sentences change`, async ({ lab, page }) => {
      await page.setViewportSize({ width, height });
      await lab.open(`lang=${lang}`);
      const heights = new Set();
      for (const [one, two] of [[0.7, 0.6], [0.5, 0.5], [0.46, 0.5], [0.3, 0.4], [0, 0.5], [1, 1], [1, 0], [0.02, 0.9]]) {
        await lab.type('gamma1-number', String(one));
        await lab.type('gamma2-number', String(two));
        const boxes = await Promise.all(['valve-plane', 'pole-zero'].map((name) => lab.id(name).boundingBox()));
        heights.add(boxes.map((box) => box.height).join(' '));
      }
      expect([...heights]).toHaveLength(1);
    });
  }
}

test('the five steps of the level loop are on one screen in every language', async ({ lab, page }) => {
  await page.setViewportSize({ width: 1440, height: 900 });
  for (const lang of ['en', 'pt-BR', 'es']) {
    await lab.open(`bench=level-loop&lang=${lang}`);
    const cards = ['process', 'experiment', 'course', 'step-test', 'trade-off', 'tuning', 'assessment'];
    for (const card of cards) {
      const box = await page.locator(`section.card.${card}`).boundingBox();
      expect(box.y + box.height, `${lang}: ${card}`).toBeLessThanOrEqual(900);
    }
    expect(await cutOff(page)).toEqual([]);
  }
  await lab.axe();
});

test('on a phone the text of a lesson scrolls with the page, and the picture that matters stays in sight', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(`${lab.origin}/?lesson=two-valves-one-zero&step=2&lang=en`);
  await lab.ready();
  const picture = page.locator('section.card.responses');
  for (const place of ['top', 'bottom']) {
    await page.evaluate((end) => window.scrollTo(0, end ? document.documentElement.scrollHeight : 0), place === 'bottom');
    const box = await picture.boundingBox();
    expect(box.y, place).toBeGreaterThan(0);
    expect(box.y, place).toBeLessThan(600);
  }
  // Nothing of the text is behind a scroll bar of its own.
  expect(await page.evaluate(() => { const text = document.querySelector('.lesson-text'); return text.scrollHeight - text.clientHeight; })).toBeLessThanOrEqual(1);
  await expect(lab.id('lesson-next')).toBeInViewport();
  await lab.axe();
});

test('on a phone the responses stand between the valves and the controller, and are seen while the point moves', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await lab.open();
  const tops = [];
  for (const card of ['process', 'plane', 'responses', 'pi', 'experiment', 'zeros', 'rga', 'why']) {
    tops.push((await page.locator(`section.card.${card}`).boundingBox()).y);
  }
  expect(tops).toEqual([...tops].sort((a, b) => a - b));
  const [plane, responses] = [await lab.id('valve-plane').boundingBox(), await lab.id('responses').boundingBox()];
  expect(responses.y + responses.height - plane.y).toBeLessThan(844);
});

for (const lang of ['en', 'pt-BR']) {
  test(`${lang}: the name of a changed rig is not cut off`, async ({ lab, page }) => {
    await lab.open(`lang=${lang}`);
    const select = lab.id('preset');
    const names = await select.locator('option').evaluateAll((options) => options.map((option) => option.value));
    for (const name of names) {
      await lab.preset(name);
      await lab.type('gamma1-number', lang === 'en' ? '0.41' : '0,41');
      const [shown, needed] = await select.evaluate((box) => {
        const width = () => box.getBoundingClientRect().width;
        const shown = width();
        box.style.cssText = 'max-width: none; flex: none';
        const needed = width();
        box.style.cssText = '';
        return [shown, needed];
      });
      expect(needed, name).toBeLessThanOrEqual(shown + 0.5);
    }
  });
}

test('what a finger has to hit is large enough', async ({ lab, page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await lab.open();
  await lab.unfoldHeader();
  await openAll(lab, page);
  // 24 CSS px each way (WCAG 2.2, 2.5.8). A checkbox is hit by its whole label.
  const small = await page.evaluate(() =>
    [...document.querySelectorAll('button, select, input, summary, a, [role=slider], [role=button]')]
      .filter((e) => e.checkVisibility({ contentVisibilityAuto: true, visibilityProperty: true }))
      .map((e) => ({ name: e.dataset.testid ?? e.textContent, box: (e.closest('label') ?? e).getBoundingClientRect() }))
      .filter(({ box }) => box.height < 24 || box.width < 24)
      .map(({ name, box }) => `${name}: ${box.width} × ${box.height}`),
  );
  expect(small).toEqual([]);
});

for (const lang of ['en', 'pt-BR', 'es']) {
  test(`1440 × 900, ${lang}: the first screen is whole on every bench`, async ({ lab, page }) => {
    await page.setViewportSize({ width: 1440, height: 900 });
    for (const bench of BENCHES) {
      await lab.open(`bench=${bench}&view=explore&lang=${lang}`);
      expect(await page.evaluate(() => document.querySelector('#bench, main').getBoundingClientRect().bottom), bench).toBeLessThanOrEqual(900);
    }
  });
}

test('the screenshots of the README', async ({ lab, page }) => {
  const path = (name) => `${process.env.QUADTANK_SCREENSHOTS ?? 'test-results'}/${name}.png`;
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await lab.open('lang=en&view=explore');
  await page.screenshot({ path: path('explore') });
  await lab.open('lang=en&view=lab&preset=johansson-2000-non-minimum-phase');
  await lab.id('pin').click();
  await lab.id('pairing-swapped').click();
  await lab.type('gain1-number', '0.3');
  await lab.type('integral1-number', '170');
  await lab.type('gain2-number', '0.28');
  await lab.type('integral2-number', '160');
  expect(await lab.text('stability')).toContain('stable');
  await page.screenshot({ path: path('lab') });
});

for (const [width, height, views] of [[1024, 768, ['full']], [390, 844, ['explore', 'full']]]) {
  test(`every menu and every box with words opens in the window of ${width} × ${height}`, async ({ lab, page }) => {
    await page.setViewportSize({ width, height });
    for (const [bench, view] of BENCHES.flatMap((bench) => views.map((view) => [bench, view]))) {
      await lab.open(`bench=${bench}&view=${view}&lang=pt-BR`);
      await lab.unfoldHeader();
      const menus = page.locator('details.menu > summary:visible');
      for (let k = 0; k < (await menus.count()); k += 1) {
        await menus.nth(k).click();
        await lab.settle();
        const places = await page.evaluate(() =>
          [...document.querySelectorAll('details.menu[open] > :is(div, nav)')].map((menu) => {
            const { left, right } = menu.getBoundingClientRect();
            return { left, right, words: menu.textContent.slice(0, 30) };
          }),
        );
        expect(places, `${bench} ${view} menu ${k}`).toHaveLength(1);
        expect(places[0].left, places[0].words).toBeGreaterThanOrEqual(0);
        expect(places[0].right, places[0].words).toBeLessThanOrEqual(width);
        await page.keyboard.press('Escape');
      }
    }
  });
}

test('with the mouse a field for a number is 32 px high', async ({ lab, page }) => {
  for (const query of [...BENCHES.map((bench) => `bench=${bench}&view=full`), 'view=lab']) {
    await lab.open(query);
    const heights = await page.locator('main input.number:visible').evaluateAll((fields) => fields.map((field) => field.getBoundingClientRect().height));
    expect(heights.length, query).toBeGreaterThan(3);
    expect(Math.min(...heights), query).toBeGreaterThanOrEqual(32);
  }
});

test.describe('by touch', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  for (const lang of ['en', 'pt-BR', 'es']) {
    test(`${lang}: two rows of the header leave the first screen to the rig, and the rest unfolds`, async ({ lab, page }) => {
      for (const bench of BENCHES) {
        await lab.open(`bench=${bench}&view=explore&lang=${lang}`);
        expect((await page.locator('header.top').boundingBox()).height, bench).toBeLessThan(120);
        await expect(lab.id('share')).toBeHidden();
        await lab.id('header-more').tap();
        for (const name of ['share', 'file-menu', 'language', 'theme']) await expect(lab.id(name)).toBeInViewport();
      }
      await lab.axe();
      await lab.id('header-more').tap();
      await expect(lab.id('share')).toBeHidden();
    });
  }

  test('what is pressed is 44 px high', async ({ lab, page }) => {
    for (const [bench, view] of BENCHES.flatMap((bench) => [[bench, 'explore'], [bench, 'full']])) {
      await lab.open(`bench=${bench}&view=${view}`);
      await lab.unfoldHeader();
      const low = await page.evaluate(() => {
        const pressed = 'main :is(button, summary, select, input:not([type=checkbox], [type=radio], [type=file])), .top :is(button, a.button, summary, select)';
        return [...document.querySelectorAll(pressed)]
          .filter((element) => element.checkVisibility({ visibilityProperty: true, opacityProperty: true }))
          // Words with an area of their own around them, buttons of drawings, and what enlarges a card by the mouse.
          .filter((element) => !element.closest('.terms, svg, .enlarge, .visually-hidden, .skip'))
          .map((element) => [element.getBoundingClientRect().height, `${element.className} ${element.dataset.testid} ${element.textContent.slice(0, 20)}`])
          .filter(([height]) => height < 43.5);
      });
      expect(low, `${bench} ${view}`).toEqual([]);
    }
  });
});

/** Sizes of text outside of drawings and formulas that are not on the scale, with where they are. */
const offScale = (page) =>
  page.evaluate(() => {
    const scale = ['12px', '14px', '16px', '20px', '28px'];
    const isHtml = (element) => element.namespaceURI === 'http://www.w3.org/1999/xhtml';
    const hasText = (element) =>
      [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim()) || element.matches('input, select, textarea');
    return [...document.querySelectorAll('body *')]
      .filter((element) => isHtml(element) && hasText(element) && element.checkVisibility())
      .map((element) => [element, getComputedStyle(element).fontSize])
      .filter(([, size]) => !scale.includes(size))
      .map(([element, size]) => `${size}: ${element.tagName} ${element.className} ${element.textContent.slice(0, 30)}`);
  });

for (const [width, height] of [[1440, 900], [390, 844]]) {
  test(`${width} × ${height}: all text has a size of the scale`, async ({ lab, page }) => {
    await page.setViewportSize({ width, height });
    const benches = BENCHES.flatMap((bench) => ['explore', 'full'].map((view) => `bench=${bench}&view=${view}`));
    const others = ['view=lab', 'lesson=two-valves-one-zero', 'page=lessons', 'page=teachers', 'page=glossary'];
    for (const query of [...benches, ...others]) {
      await page.goto(`${lab.origin}/?${query}&lang=en`);
      await page.locator('#bench:not(.outline)').waitFor({ state: 'attached' });
      await lab.settle();
      expect(await offScale(page), query).toEqual([]);
    }
    await lab.clean();
  });
}

test('for a projector the page is larger, laid out as in a smaller window, and its address follows', async ({ lab, page }) => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.goto(`${lab.origin}/?scale=1.5&lang=en&view=full`);
  const frame = page.frameLocator('iframe.enlarged');
  await frame.locator('#bench:not(.outline)').waitFor();
  const [wide, high] = await frame.locator('html').evaluate(() => [innerWidth, innerHeight]);
  expect(Math.abs(wide - 960) + Math.abs(high - 600)).toBeLessThanOrEqual(2);
  const { width, height } = await page.locator('iframe.enlarged').boundingBox();
  expect(Math.abs(width - 1440) + Math.abs(height - 900)).toBeLessThanOrEqual(2);
  await frame.getByTestId('gamma1-number').fill('0.52');
  await frame.getByTestId('gamma1-number').blur();
  await expect(page).toHaveURL(/[?&]scale=1\.5.*#lab=/);
  await page.reload();
  await expect(frame.getByTestId('gamma1-number')).toHaveValue('0.52');
});
