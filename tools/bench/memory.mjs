// Memory of the page before and after a long lecture.
import { clearMeasures, inBrowser, open, setSlider } from './browser.mjs';
import { kb, progress, table } from './report.mjs';

const MOVES = 10_000;

/** Positions of the slider of γ1, to and fro, away from the ends, where a tank runs dry and there is less to compute. */
const positions = (moves) => Array.from({ length: moves }, (_, move) => 0.5 + 0.4 * Math.sin(move / 17));

/** The memory of the module is not public; it passes by here. */
const catchMemory = () => {
  for (const name of ['instantiate', 'instantiateStreaming']) {
    const original = WebAssembly[name];
    WebAssembly[name] = async (...args) => {
      const result = await original.apply(WebAssembly, args);
      globalThis.wasmMemory = (result.instance ?? result).exports.memory;
      return result;
    };
  }
};

/** Memory before and after many moves of a slider. */
export async function memory({ url }) {
  progress(`${MOVES} slider moves for the memory`);
  return inBrowser(['--disable-frame-rate-limit'], async (page, session) => {
    await page.addInitScript(catchMemory);
    await open(page, `${url}?view=full`);
    const now = async () => {
      await session.send('HeapProfiler.collectGarbage');
      const { usedSize } = await session.send('Runtime.getHeapUsage');
      return { wasm: await page.evaluate(() => globalThis.wasmMemory.buffer.byteLength), heap: usedSize };
    };
    // The first moves fill caches and let the compiler work.
    await setSlider(page, 'gamma1', positions(MOVES / 10));
    await clearMeasures(page);
    const before = await now();
    await setSlider(page, 'gamma1', positions(MOVES));
    await clearMeasures(page);
    const after = await now();
    return table(
      [`memory over ${MOVES} slider moves`, 'before', 'after'],
      [['wasm', 'wasm'], ['JavaScript heap', 'heap']].map(([name, key]) => [name, kb(before[key]), kb(after[key])]),
    );
  });
}
