// Lighthouse's score for performance, on a telephone and on a desktop as it imagines them.
import { execFile, execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { promisify } from 'node:util';
import { CHROMIUM_FLAGS } from './browser.mjs';
import { atLeast, progress, quantile, table } from './report.mjs';
import { serve } from '../serve.mjs';

const VERSION = '13.5.0';
const FOLDER = 'target/lighthouse';
const RUNS = 3;
const FORMS = [
  ['mobile', [], 95],
  ['desktop', ['--preset=desktop'], 100],
];
const AUDITS = ['first-contentful-paint', 'largest-contentful-paint', 'total-blocking-time', 'cumulative-layout-shift'];

/** Lighthouse in its version; it brings so much along that it is no dependency of the tests. */
function program() {
  const manifest = `${FOLDER}/node_modules/lighthouse/package.json`;
  if (!existsSync(manifest) || JSON.parse(readFileSync(manifest, 'utf8')).version !== VERSION) {
    progress(`Lighthouse ${VERSION} into ${FOLDER}`);
    const args = ['install', '--prefix', FOLDER, '--no-audit', '--no-fund', '--no-save', '--loglevel=error', `lighthouse@${VERSION}`];
    execFileSync('npm', args, { stdio: ['ignore', 'ignore', 'inherit'] });
  }
  return `${FOLDER}/node_modules/.bin/lighthouse`;
}

// Not in step with this process, which serves the site meanwhile.
const execute = promisify(execFile);

/** One run: its score, and what Lighthouse shows of the audits. */
async function runOnce(bin, url, extra) {
  const flags = `--chrome-flags=--headless=new ${CHROMIUM_FLAGS.join(' ')}`;
  const args = [url, '--only-categories=performance', '--output=json', '--quiet', flags, ...extra];
  const env = { ...process.env, CHROME_PATH: process.env.CHROMIUM };
  const { stdout } = await execute(bin, args, { env, maxBuffer: 2 ** 26 });
  const { categories, audits, runtimeError } = JSON.parse(stdout);
  if (runtimeError) throw new Error(`Lighthouse: ${runtimeError.message}`);
  return { score: 100 * categories.performance.score, audits: AUDITS.map((name) => audits[name].displayValue) };
}

/** Median scores, with the audits of the run that has it. */
export async function lighthouse({ site }) {
  const bin = program();
  const server = await serve(0, { site, compress: true, headers: { 'cache-control': 'max-age=600' } });
  const url = `http://127.0.0.1:${server.address().port}/`;
  const rows = [];
  try {
    for (const [form, extra, bar] of FORMS) {
      progress(`Lighthouse, ${form}`);
      const runs = [];
      for (let k = 0; k < RUNS; k += 1) runs.push(await runOnce(bin, url, extra));
      const score = quantile(runs.map((one) => one.score), 0.5);
      const { audits } = runs.find((one) => one.score === score);
      rows.push([form, score.toFixed(0), ...audits, atLeast(Math.round(score), bar, 'points')]);
    }
  } finally {
    server.close();
  }
  return table([`Lighthouse ${VERSION}, median of ${RUNS}`, 'performance', 'FCP', 'LCP', 'TBT', 'CLS', 'bar'], rows);
}
