// Measures what DESIGN sets bars for, and prints it as Markdown: the core on the host, the site in Chromium, its size.
// With --write the tables go into docs/benchmarks.md, with the machine.
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import { join, relative } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import { serve } from './serve.mjs';

const SITE = 'dist';
const SINGLE = 'quadtank.html';
const REPORT = 'docs/benchmarks.md';
const MOVES = 300;
const WARM_UP = 60;
const LONG_RUN = 10_000;
const MEASURES = { compute: 'quadtank:compute', paint: 'quadtank:paint', words: 'quadtank:words' };
const LABELS = { compute: 'compute', paint: 'event to charts painted', words: 'oldest event to words' };
// Compute has no bar of its own when throttled, words never: they follow when the charts are on the screen.
const HOME_BARS = { 1: { compute: 2, paint: 16.7 }, 6: { paint: 50 } };
const TRANSFER_BAR_KB = 800;

const progress = (text) => console.error(`bench: ${text}`);

// ---- The core on the host -------------------------------------------------------------------------------------------

/** Runs the criterion benches; resolves with their medians (ns) and the confidence intervals of these. */
async function nativeFigures() {
  progress('the core, natively (cargo bench)');
  const start = Date.now();
  await new Promise((resolve, reject) => {
    const args = ['bench', '--locked', '--quiet', '--package', 'quadtank-scenario', '--bench', 'core'];
    const child = spawn('cargo', args, { stdio: ['ignore', 'ignore', 'inherit'] });
    child.on('close', (code) => (code === 0 ? resolve() : reject(new Error(`cargo bench ended with ${code}`))));
  });
  // Folders of benches that are no more are older than this run.
  return files('target/criterion')
    .filter((file) => file.endsWith('/new/estimates.json') && statSync(file).mtimeMs >= start)
    .map((file) => {
      const { full_id: name } = JSON.parse(readFileSync(file.replace('estimates.json', 'benchmark.json'), 'utf8'));
      const { point_estimate: median, confidence_interval: interval } = JSON.parse(readFileSync(file, 'utf8')).median;
      return { name, median, low: interval.lower_bound, high: interval.upper_bound };
    })
    .sort((one, other) => one.name.localeCompare(other.name));
}

// ---- The site in Chromium -------------------------------------------------------------------------------------------

const playwright = createRequire(new URL('../tests/e2e/package.json', import.meta.url))('@playwright/test');

/** Opens the laboratory in a new browser, hands it to `work` and closes it. */
async function inLaboratory(url, flags, work) {
  const browser = await playwright.chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', ...flags],
  });
  try {
    const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
    page.on('pageerror', (error) => progress(`the page reports ${error}`));
    // The memory of the module is not public; it passes by here.
    await page.addInitScript(() => {
      for (const name of ['instantiate', 'instantiateStreaming']) {
        const original = WebAssembly[name];
        WebAssembly[name] = async (...args) => {
          const result = await original.apply(WebAssembly, args);
          globalThis.wasmMemory = (result.instance ?? result).exports.memory;
          return result;
        };
      }
    });
    await page.goto(url);
    await page.locator('#bench:not(.outline)').waitFor();
    return await work(page, await page.context().newCDPSession(page), browser.version());
  } finally {
    await browser.close();
  }
}

/** Drags the thumb of a slider to and fro with the mouse. */
const dragSlider = (name) => async (page, moves) => {
  const slider = page.getByTestId(name);
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await slider.boundingBox();
  // Away from the ends, where a tank runs dry and there is less to compute.
  const to = (move) => page.mouse.move(x + width * (0.5 + 0.35 * Math.sin(move / 17)), y + height / 2);
  await to(0);
  await page.mouse.down();
  for (let move = 0; move < moves; move += 1) await to(move);
  await page.mouse.up();
  await page.waitForTimeout(300);
};

/** Sets the slider of γ1 by script, once in each animation frame: quick, but an event of a script waits for the next frame. */
const moveSlider = (page, moves) =>
  page.getByTestId('gamma1').evaluate(async (slider, count) => {
    const [min, max] = [Number(slider.min), Number(slider.max)];
    for (let move = 0; move < count; move += 1) {
      // Away from the ends, where a tank runs dry and there is less to compute.
      const share = 0.5 + 0.4 * Math.sin(move / 17);
      slider.value = String(min + share * (max - min));
      slider.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise(requestAnimationFrame);
    }
    await new Promise((done) => setTimeout(done, 300));
  }, moves);

/** Drags a handle around a place of its drawing, given with the radii as shares of the drawing. */
const dragHandle = (name, [x, y], [across, up]) => async (page, moves) => {
  const handle = page.getByTestId(name);
  const plane = await handle.evaluate((point) => {
    const { x, y, width, height } = point.closest('svg').getBoundingClientRect();
    return { x, y, width, height };
  });
  const at = await handle.boundingBox();
  await page.mouse.move(at.x + at.width / 2, at.y + at.height / 2);
  await page.mouse.down();
  for (let move = 0; move < moves; move += 1) {
    const right = plane.x + plane.width * (x + across * Math.cos(move / 23));
    const down = plane.y + plane.height * (y + up * Math.sin(move / 17));
    await page.mouse.move(right, down);
  }
  await page.mouse.up();
  await page.waitForTimeout(300);
};

/** Chooses one plant after the other. */
async function choosePlants(page, moves) {
  for (let move = 0; move < moves / 10; move += 1) {
    await page.getByTestId('plant').selectOption(['process-two', 'wood-berry'][move % 2]);
    await page.waitForTimeout(150);
  }
}

/** Drags a slider of the model-free bench after a case and its long run were chosen. */
const dragInLongRun = (name) => async (page, moves) => {
  for (const button of [name, 'free-long']) await page.getByTestId(button).click();
  await dragSlider('free-kp')(page, moves);
};

const clearMeasures = (page) => page.evaluate(() => performance.clearMeasures());

const readMeasures = (page) =>
  page.evaluate(
    (names) =>
      Object.fromEntries(
        Object.entries(names).map(([key, name]) => [key, performance.getEntriesByName(name, 'measure').map((m) => m.duration)]),
      ),
    MEASURES,
  );

const RELAY = '?bench=relay-tuning';

/** What the browser alone needs: a page with one slider and two canvases as large as those of the home bench, four curves on each. */
const EMPTY_PAGE = `<!doctype html><body>
  <canvas width="240" height="240"></canvas><canvas width="840" height="260"></canvas><br>
  <input type="range" min="0" max="1" step="0.001" data-testid="gamma1">`;

/** The page follows its slider as the laboratory does, and measures the same. */
const followSlider = () => {
  const slider = document.querySelector('input');
  const contexts = [...document.querySelectorAll('canvas')].map((canvas) => canvas.getContext('2d'));
  const [POINTS, CURVES] = [200, 4];
  const paint = (context) => {
    const { width, height } = context.canvas;
    context.clearRect(0, 0, width, height);
    context.lineWidth = 2;
    for (let curve = 0; curve < CURVES; curve += 1) {
      context.beginPath();
      for (let k = 0; k <= POINTS; k += 1) {
        const wave = Math.sin(k / 20 + curve + 5 * slider.valueAsNumber);
        context.lineTo((k / POINTS) * width, height * (0.5 + 0.4 * wave));
      }
      context.stroke();
    }
  };
  let since;
  slider.addEventListener('input', () => {
    if (since !== undefined) return;
    since = performance.now();
    requestAnimationFrame(() => {
      contexts.forEach(paint);
      const start = since;
      since = undefined;
      setTimeout(() => performance.measure('quadtank:paint', { start }));
    });
  });
};

/** What is moved, where, and what has to be met at which slowdown (ms); bars of compute are for the median. */
const WAYS = [
  { way: 'the browser alone: a slider and two canvases on an empty page', move: dragSlider('gamma1'), bars: { 1: {}, 6: {} }, isEmpty: true },
  { way: 'slider of γ1', query: '', move: dragSlider('gamma1'), bars: HOME_BARS },
  { way: 'slider of K1', query: '', move: dragSlider('gain1'), bars: HOME_BARS },
  { way: 'point of the valve plane', query: '', move: dragHandle('valve-handle', [0.5, 0.5], [0.25, 0.25]), bars: HOME_BARS },
  // The target stays in the third quadrant, where the source places it.
  // Twice both loci at 600 frequencies, and all else that follows from λ, within the bar of one pair of loci.
  { way: 'target λ (both loci, two roots, response)', query: RELAY, move: dragHandle('target-handle', [0.47, 0.58], [0.06, 0.05]), bars: { 1: { compute: 3, paint: 16.7 } } },
  { way: 'ratio d2/d1 (Wood-Berry test of 400)', query: RELAY, move: dragSlider('ratio'), bars: { 1: { compute: 20 } } },
  { way: 'plant (curve of 200 directions, test, design)', query: RELAY, move: choosePlants, bars: { 1: { compute: 50 } } },
  ...['a', 'b', 'c'].map((name) => ({
    way: `Kp of case ${name} (2000 s with estimator, figures, theory)`,
    query: '?bench=model-free',
    move: dragInLongRun(`free-${name}`),
    bars: { 1: { compute: 3, paint: 16.7 } },
  })),
];

/** Compute, event to charts painted and to words (ms) of each way that has bars, at a speed of the processor. */
async function frameFigures(url, slowdown) {
  return inLaboratory(url, [], async (page, session, version) => {
    const rows = [];
    for (const { way, query, move, bars, isEmpty } of WAYS.filter(({ bars }) => bars[slowdown])) {
      progress(`${MOVES} moves of the ${way}, processor slowed ${slowdown}×`);
      // Each way starts from the published setting, not from where the one before has left it.
      await session.send('Emulation.setCPUThrottlingRate', { rate: 1 });
      if (isEmpty) {
        await page.setContent(EMPTY_PAGE);
        await page.evaluate(followSlider);
      } else {
        await page.goto(`${url}${query}`);
        await page.locator('#bench:not(.outline)').waitFor();
      }
      await move(page, WARM_UP);
      await session.send('Emulation.setCPUThrottlingRate', { rate: slowdown });
      await clearMeasures(page);
      await move(page, MOVES);
      const measures = await readMeasures(page);
      for (const [what, times] of Object.entries(measures)) {
        if (isEmpty && what !== 'paint') continue;
        if (times.length === 0) throw new Error(`the page recorded no ${MEASURES[what]}`);
        const [median, high] = [quantile(times, 0.5), quantile(times, 0.95)];
        rows.push({ way, slowdown, what, frames: times.length, median, high, bar: bars[slowdown][what] });
      }
    }
    return { rows, version };
  });
}

/** Memory of the page (bytes) before and after a long lecture. */
async function memoryFigures(url) {
  progress(`${LONG_RUN} slider moves for the memory`);
  return inLaboratory(url, ['--disable-frame-rate-limit'], async (page, session) => {
    const memory = async () => {
      await session.send('HeapProfiler.collectGarbage');
      const { usedSize } = await session.send('Runtime.getHeapUsage');
      return { wasm: await page.evaluate(() => globalThis.wasmMemory.buffer.byteLength), heap: usedSize };
    };
    // The first moves fill caches and let the compiler work.
    await moveSlider(page, LONG_RUN / 10);
    await clearMeasures(page);
    const before = await memory();
    await moveSlider(page, LONG_RUN);
    await clearMeasures(page);
    return { before, after: await memory() };
  });
}

// ---- Its size -------------------------------------------------------------------------------------------------------

/** Size (bytes) of every file of the site: as it is, as plain static hosts send it (gzip 6), and after brotli. */
const sizes = () =>
  files(SITE).map((file) => {
    const bytes = readFileSync(file);
    const brotli = brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } });
    const gzip = gzipSync(bytes, { level: 6 });
    return { name: relative(SITE, file), plain: bytes.length, gzip: gzip.length, brotli: brotli.length };
  });

// ---- Tables ---------------------------------------------------------------------------------------------------------

const files = (folder) =>
  readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? files(join(folder, entry.name)) : [join(folder, entry.name)],
  );

function quantile(values, share) {
  const sorted = [...values].sort((one, other) => one - other);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

const table = (head, rows) =>
  [head, head.map((_, column) => (column === 0 ? '---' : '--:')), ...rows].map((row) => `| ${row.join(' | ')} |`).join('\n');

const kb = (bytes) => (bytes / 1000).toFixed(1);
const ms = (time) => time.toFixed(2);
const time = (ns) => (ns < 1e3 ? `${ns.toFixed(0)} ns` : ns < 1e6 ? `${(ns / 1e3).toFixed(2)} µs` : `${(ns / 1e6).toFixed(3)} ms`);
const against = (value, bar, unit) => (bar === undefined ? '–' : `≤ ${bar} ${unit}${value <= bar ? '' : ' **missed**'}`);

const nativeTable = (figures) =>
  table(
    ['core, native', 'median', '95 % confidence'],
    figures.map(({ name, median, low, high }) => [name, time(median), `${time(low)} … ${time(high)}`]),
  );

const frameTable = (rows) =>
  table(
    ['in Chromium', 'processor', 'frames', 'median', '95th percentile', 'bar'],
    rows.map(({ way, slowdown, what, frames, median, high, bar }) => {
      // The bar of compute is for a tick, the bar of painting for the 95th percentile.
      const judged = what === 'compute' ? median : high;
      const speed = slowdown === 1 ? 'full speed' : `${slowdown}× slower`;
      return [`${way}: ${LABELS[what]}`, speed, frames, `${ms(median)} ms`, `${ms(high)} ms`, against(judged, bar, 'ms')];
    }),
  );

const memoryTable = ({ before, after }) =>
  table(
    [`memory over ${LONG_RUN} slider moves`, 'before', 'after'],
    [['wasm', before.wasm, after.wasm], ['JavaScript heap', before.heap, after.heap]].map(([name, ...bytes]) => [
      name,
      ...bytes.map((count) => `${kb(count)} KB`),
    ]),
  );

function sizeTable(all) {
  const site = all.filter(({ name }) => name !== SINGLE).sort((one, other) => other.gzip - one.gzip);
  const sum = (key) => site.reduce((total, file) => total + file[key], 0);
  const total = { plain: sum('plain'), gzip: sum('gzip'), brotli: sum('brotli') };
  const row = (name, { plain, gzip, brotli }, bar) => [name, ...[plain, gzip, brotli].map((size) => `${kb(size)} KB`), bar];
  const single = all.filter(({ name }) => name === SINGLE);
  return table(
    ['file', 'plain', 'gzip 6', 'brotli 11', 'bar'],
    [
      ...site.map((file) => row(file.name, file, '')),
      row('**the whole site**', total, against(total.gzip / 1000, TRANSFER_BAR_KB, 'KB')),
      ...single.map((file) => row(`${file.name} (apart)`, file, '')),
    ],
  );
}

function machine(chromium) {
  const system = readFileSync('/etc/os-release', 'utf8').match(/^PRETTY_NAME="(.*)"/m)?.[1] ?? os.platform();
  const rustc = execFileSync('rustc', ['--version'], { encoding: 'utf8' }).trim();
  const [{ model }] = os.cpus();
  const memory = `${Math.round(os.totalmem() / 2 ** 30)} GiB`;
  return `${os.cpus().length} × ${model}, ${memory}, ${system}; Chromium ${chromium}; ${rustc}; ${new Date().toISOString().slice(0, 10)}.`;
}

// ---- The run --------------------------------------------------------------------------------------------------------

const native = await nativeFigures();
const server = await serve(0);
const url = `http://127.0.0.1:${server.address().port}/`;
const full = await frameFigures(url, 1);
const slow = await frameFigures(url, 6);
const memory = await memoryFigures(url);
server.close();

const results = [
  machine(full.version),
  frameTable([...full.rows, ...slow.rows]),
  memoryTable(memory),
  nativeTable(native),
  sizeTable(sizes()),
].join('\n\n');
console.log(results);

if (process.argv.includes('--write')) {
  const [open, close] = ['<!-- written by make bench BENCH=--write -->', '<!-- end -->'];
  const page = existsSync(REPORT) ? readFileSync(REPORT, 'utf8') : `# Benchmarks\n\n${open}\n${close}\n`;
  const [before, rest] = page.split(open);
  const after = rest?.split(close)[1];
  if (after === undefined) throw new Error(`${REPORT} has no place marked for the results: ${open} … ${close}`);
  mkdirSync('docs', { recursive: true });
  writeFileSync(REPORT, `${before}${open}\n\n${results}\n\n${close}${after}`);
  progress(`written to ${REPORT}`);
}
