// From a move of a hand to painted charts, on every bench, at full speed and with the processor slowed.
import { MEASURES, clearMeasures, dragHandle, dragSlider, inBrowser, open, readMeasures } from './browser.mjs';
import { openEmptyPage } from './empty.mjs';
import { atMost, ms, progress, quantile, table } from './report.mjs';

const MOVES = 300;
const WARM_UP = 60;
const SPEEDS = [1, 6];
const COMPUTE_BAR_MS = 1.2;
const PAINT_BAR_MS = 16.7;
const EMPTY_PAGE_BAR = 2;

// With every card: what Explore shows is a part of it.
const HOME = { query: '?view=full', computeBar: COMPUTE_BAR_MS };
const RELAY = { query: '?bench=relay-tuning&view=full' };
const MODEL_FREE = { query: '?bench=model-free&view=full' };

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

/** What is moved, and where. A choice from a list is no drag: it has no bar, and is measured at full speed only. */
const WAYS = [
  { ...HOME, way: 'slider of γ1', move: dragSlider('gamma1') },
  { ...HOME, way: 'slider of K1', move: dragSlider('gain1') },
  { ...HOME, way: 'point of the valve plane', move: dragHandle('valve-handle', [0.5, 0.5], [0.25, 0.25]) },
  // The target stays in the third quadrant, where the source places it.
  { ...RELAY, way: 'target λ (both loci, two roots, response)', move: dragHandle('target-handle', [0.47, 0.58], [0.06, 0.05]) },
  { ...RELAY, way: 'ratio d2/d1 (Wood-Berry test of 400)', move: dragSlider('ratio') },
  { ...RELAY, way: 'plant (curve of 200 directions, test, design)', move: choosePlants, isChoice: true },
  ...['a', 'b', 'c'].map((name) => ({
    ...MODEL_FREE,
    way: `Kp of case ${name} (2000 s with estimator, figures, theory)`,
    move: dragInLongRun(`free-${name}`),
  })),
];

const EMPTY = { way: 'the browser alone: a slider and two canvases on an empty page', move: dragSlider('gamma1') };

/** Moves in one way and returns the durations of what followed (ms). */
async function durations(page, session, url, slowdown, { way, query, move }) {
  progress(`${way}, ${MOVES} moves, processor slowed ${slowdown}×`);
  // Each way starts from the published setting, not from where the one before has left it.
  await session.send('Emulation.setCPUThrottlingRate', { rate: 1 });
  if (query === undefined) await openEmptyPage(page);
  else await open(page, `${url}${query}`);
  await move(page, WARM_UP);
  await session.send('Emulation.setCPUThrottlingRate', { rate: slowdown });
  await clearMeasures(page);
  await move(page, MOVES);
  const measures = await readMeasures(page);
  const missing = Object.keys(MEASURES).find((what) => measures[what].length === 0 && (query !== undefined || what === 'paint'));
  if (missing) throw new Error(`the page recorded no ${MEASURES[missing]} for the ${way}`);
  return measures;
}

/** Rows of all ways at a speed of the processor; first that of the empty page, against which the others are held. */
async function rowsAt(page, session, url, slowdown) {
  const measure = (way) => durations(page, session, url, slowdown, way);
  await open(page, url);
  // Machines are not equally quick all the time: the floor is of before and after.
  const before = await measure(EMPTY);
  const found = [];
  for (const way of WAYS.filter(({ isChoice }) => !isChoice || slowdown === 1)) found.push({ way, times: await measure(way) });
  const after = await measure(EMPTY);
  const floor = [...before.paint, ...after.paint];
  const speed = slowdown === 1 ? 'full speed' : `${slowdown}× slower`;
  return [
    [EMPTY.way, speed, floor.length, '–', '–', ms(quantile(floor, 0.5)), ms(quantile(floor, 0.95)), '1', '–', '–'],
    ...found.map(({ way, times }) => row(way, slowdown, speed, times, quantile(floor, 0.95))),
  ];
}

function row({ way, computeBar, isChoice }, slowdown, speed, { compute, paint, words }, floor) {
  const [median, high] = [0.5, 0.95].map((share) => (times) => quantile(times, share));
  const factor = high(paint) / floor;
  const bars = [];
  // The bar of compute is for a tick, the bars of painting for the 95th percentile.
  if (computeBar && slowdown === 1) bars.push(`compute ${atMost(median(compute), computeBar, 'ms')}`);
  if (!isChoice && slowdown === 1) bars.push(`painted ${atMost(high(paint), PAINT_BAR_MS, 'ms')}`);
  if (!isChoice) bars.push(atMost(factor, EMPTY_PAGE_BAR, '× empty page'));
  const times = [median(compute), high(compute), median(paint), high(paint)].map(ms);
  return [way, speed, paint.length, ...times, factor.toFixed(2), ms(high(words)), bars.join(', ') || '–'];
}

/** Compute, event to charts painted, and to words, for each way and speed. */
export async function frames({ url }) {
  return inBrowser([], async (page, session) => {
    const rows = [];
    for (const slowdown of SPEEDS) rows.push(...(await rowsAt(page, session, url, slowdown)));
    return table(
      ['in Chromium', 'processor', 'frames', 'compute, median', '95 %', 'event to charts painted, median', '95 %', '× empty page',
        'oldest event to words, 95 %', 'bars'],
      rows,
    );
  });
}
