// What every test starts from. `test` opens no page by itself; call `lab.open()`.
//
// - The site is served under a strict content security policy (server.mjs).
// - A console message of any kind, a page error or a failed request fails the test at its end.
// - `lab.text(id)` and `lab.number(id)` read what a data-testid shows; numbers understand − and the decimal comma.
// - `lab.clean()` asserts that nothing on the page reads NaN, Infinity, undefined or null, in no attribute either, and that
//   the number of each slider lies in its range; `lab.axe()` that axe finds nothing.
// - `lab.provoked(/…/)` takes away the complaints that a test provoked on purpose.
import AxeBuilder from '@axe-core/playwright';
import { test as base, expect } from '@playwright/test';
import { serve } from './server.mjs';

export { expect };

/** Each theme and two languages once: colours are a matter of the theme, the width of words one of the language. */
export const LOOKS = [['light', 'en'], ['dark', 'pt-BR']];

export class Lab {
  constructor(page, origin, complaints) {
    this.page = page;
    this.origin = origin;
    this.complaints = complaints;
  }

  /** Listens to a page; also one that a test opens by itself. */
  watch(page) {
    page.on('console', (message) => this.complaints.push(`console ${message.type()}: ${message.text()}`));
    page.on('pageerror', (error) => this.complaints.push(`error: ${error.message}`));
    page.on('requestfailed', (request) => this.complaints.push(`failed: ${request.url()}`));
  }

  /**
   * Opens the laboratory with a query (`preset=…&lang=…`) and a fragment, and waits until it runs: with every card, unless the
   * query says how much is shown.
   */
  async open(query = '', fragment = '') {
    if (!/(^|&)(view=|embed=1|panels=)/.test(query)) query = query ? `${query}&view=full` : 'view=full';
    await this.page.goto(`${this.origin}/?${query}${fragment ? `#${fragment}` : ''}`);
    await this.ready();
  }

  /** Unfolds the rest of the header, where it is folded: on a phone. */
  async unfoldHeader() {
    if (await this.id('header-more').isVisible()) await this.id('header-more').click();
  }

  async ready(page = this.page) {
    await page.locator('#bench:not(.outline)').waitFor();
    await this.settle(page);
  }

  /** Waits until what was asked for is computed and painted, and the words have followed. */
  async settle(page = this.page) {
    await page.evaluate(async () => {
      const task = () => new Promise((done) => setTimeout(done, 0));
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      do await task();
      while (performance.getEntriesByType('mark').some((mark) => mark.name.startsWith('quadtank:untold')));
    });
  }

  /** Goes to another bench by the menu. */
  async bench(name) {
    await this.id('benches').locator('summary').click();
    await this.id(`bench-${name}`).click();
    await this.settle();
  }

  id(name) {
    return this.page.getByTestId(name);
  }

  async text(name) {
    // A space that does not break, and the mark that forbids a break, are a matter of lines.
    return (await this.id(name).textContent()).replaceAll('\u00a0', ' ').replaceAll('\u2060', '').trim();
  }

  async number(name) {
    return numberIn(await this.text(name));
  }

  async value(name) {
    return numberIn(await this.id(name).inputValue());
  }

  /** Types into a number field and leaves it. */
  async type(name, text) {
    await this.id(name).fill(text);
    await this.id(name).blur();
    await this.settle();
  }

  async preset(name) {
    await this.id('preset').selectOption(name);
    await this.settle();
  }

  /** Middle of an element on the page. */
  async middle(name) {
    const box = await this.id(name).boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  }

  /** How much of a picture is painted, on both its canvases: pixels, colours, and a text that changes with any pixel. */
  async picture(name) {
    return this.id(name).evaluate((canvas) => {
      // Read from a copy: reading the canvas itself makes Chromium warn and changes how it paints.
      const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
      const context = copy.getContext('2d', { willReadFrequently: true });
      for (const sheet of canvas.parentElement.querySelectorAll('canvas')) context.drawImage(sheet, 0, 0);
      const pixels = new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer);
      let ink = 0;
      let hash = 0;
      const colours = new Set();
      for (const pixel of pixels) {
        if (pixel >>> 24) ink += 1;
        hash = (Math.imul(hash, 31) + pixel) | 0;
        colours.add(pixel);
      }
      return { ink, colours: colours.size, hash };
    });
  }

  async clean() {
    const text = await this.page.locator('body').innerText();
    expect(text).not.toMatch(/NaN|Infinity|undefined|\bnull\b|\binf\b/);
    // The packed documents of links are letters of any kind.
    const packed = ['href', 'value'];
    const attributes = await this.page.evaluate(
      (packed) =>
        [...document.querySelectorAll('*')].flatMap((element) =>
          [...element.attributes]
            .filter(({ name, value }) => !packed.includes(name) && /NaN|Infinity|undefined|\binf\b/.test(value))
            .map(({ name, value }) => `${element.tagName} ${name}="${value}"`),
        ),
      packed,
    );
    expect(attributes).toEqual([]);
    const sliders = await this.page.evaluate(() =>
      [...document.querySelectorAll('[role=slider]')]
        .map((slider) => [slider.dataset.testid, ...['min', 'now', 'max'].map((part) => slider.getAttribute(`aria-value${part}`))])
        .filter(([, min, now, max]) => !(Number(min) <= Number(now) && Number(now) <= Number(max))),
    );
    expect(sliders).toEqual([]);
  }

  /** Takes away the complaints that a test provoked on purpose. Each pattern has to match some; all others stay. */
  provoked(...patterns) {
    for (const pattern of patterns) {
      const others = this.complaints.filter((complaint) => !pattern.test(complaint));
      expect(others.length, `a complaint like ${pattern} among ${this.complaints}`).toBeLessThan(this.complaints.length);
      this.complaints.splice(0, this.complaints.length, ...others);
    }
  }

  /** Takes away complaints that the browser may or may not utter, depending on its pace. */
  tolerate(pattern) {
    this.complaints.splice(0, this.complaints.length, ...this.complaints.filter((complaint) => !pattern.test(complaint)));
  }

  async axe() {
    // In the middle of a transition a button has a colour that it does not keep.
    await this.page.evaluate(() => Promise.allSettled(document.getAnimations().map((animation) => animation.finished)));
    // A run that gathers what was found on a second page, and all that was passed, takes 2.4 s; this one 0.7 s (2026-11-28).
    const { violations } = await new AxeBuilder({ page: this.page }).setLegacyMode(true).options({ resultTypes: ['violations'] }).analyze();
    expect(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(' | ')}`)).toEqual([]);
  }
}

export function numberIn(text) {
  const found = text.replaceAll('−', '-').replaceAll(',', '.').match(/[+-]?\d+(\.\d+)?/);
  return found ? Number(found[0]) : Number.NaN;
}

export const test = base.extend({
  site: [
    async ({}, use) => {
      const site = await serve();
      await use(site);
      site.close();
    },
    { scope: 'worker' },
  ],
  complaints: async ({}, use) => {
    const complaints = [];
    await use(complaints);
    expect(complaints).toEqual([]);
  },
  lab: async ({ page, site, complaints }, use) => {
    const lab = new Lab(page, site.origin, complaints);
    lab.watch(page);
    await use(lab);
  },
});
