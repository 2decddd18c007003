// The home tick beside the same tick in python-control and SciPy (benches/peer_tick.py), on the same positions of γ1.
import { execFileSync } from 'node:child_process';
import { python } from '../python.mjs';
import { clearMeasures, inBrowser, open, readMeasures, setSlider } from './browser.mjs';
import { atLeast, ms, progress, quantile, table } from './report.mjs';

const SCRIPT = 'benches/peer_tick.py';
const RATIO_BAR = 150;
/** A tick of the peer is so long that it needs fewer. */
const ROUNDS = { laboratory: 10, peer: 2 };
/** Two runs by different methods have to agree to this share of the step, or the peer computes something else. */
const SAME_RUN = 1e-4;

/** The slider to the right and back, where the rig stays minimum-phase and the published loops stable; no position twice in a row. */
const there = Array.from({ length: 21 }, (_, k) => (0.6 + 0.01 * k).toFixed(2));
const round = [...there, ...there.slice(1, -1).reverse()];
const positions = (rounds) => Array.from({ length: rounds }, () => round).flat();

const ROWS = [
  ['the same, python-control + SciPy (`odeint` from sample to sample)', 'tick_odeint', RATIO_BAR],
  ['the same, nonlinear run by Runge-Kutta in plain Python instead of SciPy', 'tick_runge_kutta'],
  ['not the same: continuous PI laws, `solve_ivp` from step to step', 'tick_continuous'],
];

/** Durations of the computation of each tick in the page (ms). */
const laboratoryTicks = (url) =>
  inBrowser([], async (page) => {
    await open(page, `${url}?view=full`);
    await setSlider(page, 'gamma1', positions(2));
    await clearMeasures(page);
    await setSlider(page, 'gamma1', positions(ROUNDS.laboratory));
    return (await readMeasures(page)).compute;
  });

function peerTicks() {
  const interpreter = python(progress);
  progress('the home tick in python-control and SciPy');
  const found = JSON.parse(execFileSync(interpreter, [SCRIPT, ...positions(ROUNDS.peer)], { encoding: 'utf8' }));
  const difference = found.answers.difference_of_step.runge_kutta;
  if (!(difference < SAME_RUN)) throw new Error(`the runs of ${SCRIPT} differ by ${difference} of the step`);
  return found;
}

/** One tick here and there, and the ratio. */
export async function peer({ url }) {
  progress('the home tick in the page');
  const own = await laboratoryTicks(url);
  const { times, versions, ticks } = peerTicks();
  const median = quantile(own, 0.5);
  const rows = ROWS.map(([name, key, bar]) => {
    const ratio = times[key].median_ms / median;
    return [name, ticks, ms(times[key].median_ms), ms(times[key].p95_ms), `${ratio.toFixed(0)} ×`, bar ? atLeast(ratio, bar, '×') : '–'];
  });
  const parts = ['theory', 'linear', 'odeint', 'runge_kutta', 'continuous', 'metrics'];
  return [
    table(
      ['one tick of the home bench, γ1 from 0.60 to 0.80', 'ticks', 'median', '95 %', 'of the laboratory', 'bar'],
      [['the laboratory, compute, in Chromium', own.length, ms(median), ms(quantile(own, 0.95)), '1', '–'], ...rows],
    ),
    `Python ${versions.python}, ${['control', 'scipy', 'numpy'].map((name) => `${name} ${versions[name]}`).join(', ')}. Parts of its tick, ` +
      `medians of processor time: ${parts.map((part) => `${part} ${ms(times[part].median_ms)}`).join(', ')}.`,
  ].join('\n\n');
}
