// Runs every suite, also after one has failed, and ends with the total that the suites themselves report and the time of each.
// `--quick` runs format, lints and native tests only.
import { spawn } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { resolve } from 'node:path';

const PLAYWRIGHT_REPORT = resolve('target/playwright.json');

/** Counts in the output of cargo and of the wasm test runner: one line for each test binary. */
function cargoCounts(output) {
  const lines = [...output.matchAll(/^test result: .*?(\d+) passed; (\d+) failed;/gm)];
  return lines.reduce((sum, [, passed, failed]) => add(sum, { passed: +passed, failed: +failed }), none());
}

/** Counts in the report of Playwright. A test that was interrupted, did not run or passed only at a retry is no pass. */
function playwrightCounts() {
  const { expected, unexpected, flaky, skipped } = JSON.parse(readFileSync(PLAYWRIGHT_REPORT, 'utf8')).stats;
  return { passed: expected, failed: unexpected + flaky + skipped };
}

const CARGO = ['--locked', '--color', 'never'];

/** Counts of the test runner of Node.js in its TAP report. */
function nodeCounts(output) {
  const count = (word) => Number(output.match(new RegExp(`^# ${word} (\\d+)$`, 'm'))[1]);
  return { passed: count('pass'), failed: count('fail') + count('cancelled') + count('skipped') + count('todo') };
}

// A step without `counts` is a check: it can fail, but it holds no tests. `quick` steps are those of `make check`.
const STEPS = [
  { name: 'format', quick: true, run: ['cargo', 'fmt', '--all', '--check'] },
  {
    name: 'lints',
    quick: true,
    run: ['cargo', 'clippy', ...CARGO, '--quiet', '--workspace', '--all-targets', '--', '-D', 'warnings'],
  },
  {
    name: 'native tests',
    quick: true,
    run: ['cargo', 'test', ...CARGO, '--quiet', '--workspace', '--no-fail-fast'],
    counts: cargoCounts,
  },
  {
    name: 'documentation',
    run: ['cargo', 'doc', ...CARGO, '--quiet', '--workspace', '--no-deps'],
    variables: { RUSTDOCFLAGS: '-D warnings' },
  },
  { name: 'licences', run: ['node', 'tools/licences.mjs'] },
  // In one run, so that cargo gives both the same features and compiles the core once.
  {
    name: 'page in headless Chromium and published tables as WebAssembly',
    run: [
      ...['cargo', 'test', ...CARGO, '--target', 'wasm32-unknown-unknown', '--no-fail-fast'],
      ...['--package', 'quadtank-lab', '--test', 'browser', '--package', 'quadtank', '--test', 'published'],
    ],
    counts: cargoCounts,
  },
  { name: 'release build', run: ['tools/build.sh'] },
  { name: 'JavaScript module', run: ['tools/module.sh', '--beside-page'] },
  {
    name: 'the module in Node.js',
    run: ['node', '--test', '--test-reporter=tap', 'crates/quadtank-js/tests/'],
    counts: nodeCounts,
  },
  {
    name: 'end-to-end tests',
    run: ['npx', '--no-install', 'playwright', 'test', '--reporter=list,json'],
    in: 'tests/e2e',
    counts: playwrightCounts,
  },
];
const chosen = process.argv.includes('--quick') ? STEPS.filter((step) => step.quick) : STEPS;

const none = () => ({ passed: 0, failed: 0 });
const add = (one, other) => ({ passed: one.passed + other.passed, failed: one.failed + other.failed });

/** Runs a step; its output is shown as it comes and returned without colours. */
function execute({ run: [program, ...args], in: folder = '.', variables = {} }) {
  return new Promise((done) => {
    const child = spawn(program, args, { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'], env: { ...environment, ...variables } });
    let output = '';
    for (const stream of [child.stdout, child.stderr]) {
      stream.setEncoding('utf8').on('data', (text) => {
        output += text;
        process.stdout.write(text);
      });
    }
    child.on('error', (error) => done({ ok: false, output: `${error}\n` }));
    child.on('close', (code) => done({ ok: code === 0, output: output.replace(/\x1b\[[\d;?]*[A-Za-z]/g, '') }));
  });
}

/** What the report of a suite says; nothing where there is no report. */
function countsOf(step, output) {
  try {
    return step.counts?.(output) ?? none();
  } catch {
    return none();
  }
}

/** What a step counts for. A check that fails, or a suite that fails without a failed test, is one failure. */
function judge(step, { ok, output }) {
  const counts = countsOf(step, output);
  const ranNothing = step.counts !== undefined && counts.passed + counts.failed === 0;
  const silent = counts.failed === 0 && (!ok || ranNothing);
  return { ...(silent ? add(counts, { passed: 0, failed: 1 }) : counts), ranNothing };
}

// Chromedriver looks in the usual places; a browser from elsewhere has to be named to it.
const environment = { ...process.env, CI: process.env.CI ?? '1', PLAYWRIGHT_JSON_OUTPUT_NAME: PLAYWRIGHT_REPORT };
rmSync(PLAYWRIGHT_REPORT, { force: true });
if (process.env.CHROMIUM && !process.env.CHROMIUM.startsWith('/usr/bin/')) {
  const capabilities = JSON.parse(readFileSync('webdriver.json', 'utf8'));
  capabilities['goog:chromeOptions'].binary = process.env.CHROMIUM;
  mkdirSync('target', { recursive: true });
  writeFileSync('target/webdriver.json', JSON.stringify(capabilities));
  environment.WASM_BINDGEN_TEST_WEBDRIVER_JSON = `${process.cwd()}/target/webdriver.json`;
}

let total = none();
const report = [];
for (const step of chosen) {
  console.log(`\n== ${step.name}: ${step.run.join(' ')}`);
  const start = Date.now();
  const result = await execute(step);
  const counts = judge(step, result);
  total = add(total, counts);
  const seconds = `${Math.round((Date.now() - start) / 1000)} s`.padStart(6);
  const verdict = counts.ranNothing && result.ok ? 'ran no test' : step.counts ? `${counts.passed} passed, ${counts.failed} failed` : result.ok ? 'ok' : 'FAILED';
  report.push(`${seconds}  ${step.name}: ${verdict}`);
}

console.log(`\n== all suites\n${report.join('\n')}`);
console.log(`${total.passed} passed, ${total.failed} failed`);
process.exitCode = total.failed === 0 ? 0 : 1;
