// Two thousand random events leave no error, no NaN and a flat heap. And the transfer stays small.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync } from 'node:zlib';
import { expect, test } from './lab.mjs';
import { SITE } from './server.mjs';

const EVENTS = 2000;
const ROUNDS = 10;

/** Small, seeded and good enough (mulberry32). */
function random(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** A round of events inside the page: sliders, fields, keys, clicks, each in a frame of its own now and then. */
const round = (page, numbers) =>
  page.evaluate(async (numbers) => {
    const KEYS = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Home', 'End', '+', '-', '0', 'Escape'];
    const TEXTS = ['0', '1', '-3', '1e9', '0.001', '', 'x', '12,5', '400'];
    const AVOID = /^(share|save|open|single-file|open-input|play|.*-(csv|svg|png))$/;
    for (const n of numbers) {
      const all = [...document.querySelectorAll('input, select, button, [role=slider], [role=button], summary')].filter(
        (e) => !e.disabled && !AVOID.test(e.dataset.testid ?? ''),
      );
      const element = all[Math.floor(n * 7919 * all.length) % all.length];
      const pick = (list) => list[Math.floor(n * 104729) % list.length];
      if (element.type === 'range') {
        element.value = String(Number(element.min) + ((n * 31) % 1) * (Number(element.max) - Number(element.min)));
        element.dispatchEvent(new Event('input', { bubbles: true }));
      } else if (element.classList.contains('number')) {
        element.value = pick(TEXTS);
        element.dispatchEvent(new Event('input', { bubbles: true }));
        element.dispatchEvent(new Event('blur'));
      } else if (element.tagName === 'SELECT') {
        element.selectedIndex = Math.floor(n * 1013) % element.options.length;
        element.dispatchEvent(new Event('change', { bubbles: true }));
      } else if (element.getAttribute('role') === 'slider') {
        element.dispatchEvent(new KeyboardEvent('keydown', { key: pick(KEYS), shiftKey: n > 0.5, bubbles: true, cancelable: true }));
      } else {
        element.dispatchEvent(new MouseEvent('click', { bubbles: true, cancelable: true }));
      }
      if (n < 0.3) await new Promise(requestAnimationFrame);
    }
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  }, numbers);

test('2,000 random events leave no error, no NaN and a flat heap', async ({ lab, page }) => {
  test.setTimeout(300_000);
  await lab.open();
  const next = random(20260101);
  const client = await page.context().newCDPSession(page);
  await client.send('Performance.enable');
  const heap = async () => {
    await client.send('HeapProfiler.collectGarbage');
    const { metrics } = await client.send('Performance.getMetrics');
    const read = (name) => metrics.find((m) => m.name === name).value;
    return { bytes: read('JSHeapUsedSize'), listeners: read('JSEventListeners'), nodes: read('Nodes') };
  };
  let warm;
  for (let k = 0; k < ROUNDS; k += 1) {
    await round(page, Array.from({ length: EVENTS / ROUNDS }, next));
    await lab.clean();
    if (k === 3) warm = await heap();
  }
  // Back to the same state before the last measurement, so that like is compared with like.
  const end = await heap();
  console.log(`heap after ${0.4 * EVENTS} events ${warm.bytes}, after ${EVENTS} ${end.bytes}`);
  expect(end.bytes).toBeLessThan(warm.bytes * 1.3 + 500_000);
  expect(end.nodes).toBeLessThan(warm.nodes * 2 + 2000);
});

// The bar is 300 KB and is not reached yet (docs/benchmarks.md says what was measured). Until it is, this number only goes
// down.
const REACHED = 380_000;

test('the whole site does not grow beyond what was reached', async () => {
  const files = readdirSync(SITE).filter((name) => name !== 'quadtank.html' && !name.startsWith('.'));
  const sizes = files.map((name) => brotliCompressSync(readFileSync(join(SITE, name))).length);
  const total = sizes.reduce((a, b) => a + b, 0);
  expect(total).toBeLessThanOrEqual(REACHED);
});
