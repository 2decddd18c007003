// The core on the host.
import { spawn } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { files, progress, table } from './report.mjs';

const time = (ns) => (ns < 1e3 ? `${ns.toFixed(0)} ns` : ns < 1e6 ? `${(ns / 1e3).toFixed(2)} µs` : `${(ns / 1e6).toFixed(3)} ms`);

function cargoBench() {
  return new Promise((resolve, reject) => {
    const args = ['bench', '--locked', '--quiet', '--package', 'quadtank-scenario', '--bench', 'core'];
    const child = spawn('cargo', args, { stdio: ['ignore', 'ignore', 'inherit'] });
    child.on('close', (code) => (code === 0 ? resolve() : reject(new Error(`cargo bench ended with ${code}`))));
  });
}

/** Runs the criterion benches: their medians and the confidence intervals of these. */
export async function native() {
  progress('the core, natively (cargo bench)');
  const start = Date.now();
  await cargoBench();
  const rows = files('target/criterion')
    // Folders of benches that are no more are older than this run.
    .filter((file) => file.endsWith('/new/estimates.json') && statSync(file).mtimeMs >= start)
    .map((file) => {
      const { full_id: name } = JSON.parse(readFileSync(file.replace('estimates.json', 'benchmark.json'), 'utf8'));
      const { point_estimate: median, confidence_interval: interval } = JSON.parse(readFileSync(file, 'utf8')).median;
      return [name, time(median), `${time(interval.lower_bound)} … ${time(interval.upper_bound)}`];
    })
    .sort(([one], [other]) => one.localeCompare(other));
  return table(['core, native', 'median', '95 % confidence'], rows);
}
