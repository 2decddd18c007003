// Tables in Markdown, and their place in docs/benchmarks.md.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import { join } from 'node:path';

const REPORT = 'docs/benchmarks.md';
const [OPEN, CLOSE] = ['<!-- written by make bench BENCH=--write -->', '<!-- end -->'];
const QUIET_PERCENT = 90;

export const progress = (text) => console.error(`bench: ${text}`);

/** Every file in a folder and the folders in it, but for node modules. */
export const files = (folder) =>
  readdirSync(folder, { withFileTypes: true })
    .filter(({ name }) => name !== 'node_modules')
    .flatMap((entry) => (entry.isDirectory() ? files(join(folder, entry.name)) : [join(folder, entry.name)]));

export function quantile(values, share) {
  const sorted = [...values].sort((one, other) => one - other);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

/** A table; the first column is text, the others are numbers. */
export const table = (head, rows) =>
  [head, head.map((_, column) => (column === 0 ? '---' : '--:')), ...rows].map((row) => `| ${row.join(' | ')} |`).join('\n');

export const kb = (bytes) => `${(bytes / 1000).toFixed(1)} KB`;
export const ms = (time) => `${time.toFixed(2)} ms`;

/** A bar, and whether it is missed. */
export const atMost = (value, bar, unit) => `≤ ${bar} ${unit}${value <= bar ? '' : ' **missed**'}`;
export const atLeast = (value, bar, unit) => `≥ ${bar} ${unit}${value >= bar ? '' : ' **missed**'}`;

/** Share (%) of the last seconds in which the processors had nothing to do: figures of a busy machine are worth little. */
async function idleShare() {
  const times = () => os.cpus().map((cpu) => cpu.times);
  const sum = (all, kinds) => all.flatMap((one) => kinds.map((kind) => one[kind])).reduce((total, time) => total + time, 0);
  const before = times();
  await new Promise((done) => setTimeout(done, 3000));
  const after = times();
  const passed = (kinds) => sum(after, kinds) - sum(before, kinds);
  return (100 * passed(['idle'])) / passed(Object.keys(before[0]));
}

/** The machine, its versions and how quiet it is, in a line. */
export async function machine() {
  const version = (program) => execFileSync(program, ['--version'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }).trim();
  const system = readFileSync('/etc/os-release', 'utf8').match(/^PRETTY_NAME="(.*)"/m)?.[1] ?? os.platform();
  const chromium = version(process.env.CHROMIUM).match(/[\d.]+/)?.[0];
  const [{ model }] = os.cpus();
  const memory = `${Math.round(os.totalmem() / 2 ** 30)} GiB`;
  const idle = Math.round(await idleShare());
  if (idle < QUIET_PERCENT) progress(`something else is running: the processors are only ${idle} % idle`);
  const date = new Date().toISOString().slice(0, 10);
  return `${os.cpus().length} × ${model}, ${memory}, ${system}; Chromium ${chromium}; ${version('rustc')}; ${date}; ${idle} % idle before.`;
}

/** Puts results between the marks of the report; the text around them stays. */
export function write(results) {
  const [before, rest] = readFileSync(REPORT, 'utf8').split(OPEN);
  const after = rest?.split(CLOSE)[1];
  if (after === undefined) throw new Error(`${REPORT} has no place marked for the results: ${OPEN} … ${CLOSE}`);
  writeFileSync(REPORT, `${before}${OPEN}\n\n${results}\n\n${CLOSE}${after}`);
  progress(`written to ${REPORT}`);
}
