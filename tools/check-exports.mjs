// Exports the presets and the cases of tools/exports in every language that can be run here, runs the scripts, which hold their figures
// against those of the laboratory, and prints how far they agree. `ONLY=text` runs those alone whose names have the text.
import { execFile, execFileSync } from 'node:child_process';
import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { promisify } from 'node:util';
import { CASES } from './exports/cases.mjs';
import { python } from './python.mjs';

const FOLDER = 'target/exports';
const QUADTANK = `${process.env.CARGO_TARGET_DIR ?? 'target'}/debug/quadtank`;
/** A script takes some seconds; a run of this length hangs (ms). */
const TIME_LIMIT = 900_000;

const run = promisify(execFile);
const tell = (text) => console.log(`exports: ${text}`);
const quadtank = (...args) => execFileSync(QUADTANK, args, { encoding: 'utf8', maxBuffer: 1e8 });

function isInstalled(program, args) {
  try {
    execFileSync(program, args, { stdio: 'ignore' });
    return true;
  } catch {
    return false;
  }
}

/** How to run a script of each language in its folder, and what keeps it from being run here. */
const LANGUAGES = [
  {
    id: 'python',
    file: 'experiment.py',
    program: () => `${process.cwd()}/${python(tell)}`,
    args: ['-W', 'error', 'experiment.py'],
  },
  {
    id: 'octave',
    file: 'quadtank_experiment.m',
    program: () => (isInstalled('octave-cli', ['--quiet', '--eval', "pkg('load', 'control')"]) ? 'octave-cli' : undefined),
    args: ['--quiet', '--no-init-file', '--no-history', '--eval', 'quadtank_experiment'],
    missing: 'Octave with its package control is not installed, so no script in MATLAB/Octave is run',
  },
];

function documents() {
  const presets = quadtank('presets').split('\n').filter(Boolean).map((line) => line.split(/\s+/)[0]);
  const plain = presets.map((preset) => ({ name: preset, preset, set: {} }));
  return [...plain, ...CASES].map(({ name, preset, document, set, label }, index) => {
    const number = String(index + 1).padStart(2, '0');
    const file = document ?? `${FOLDER}/${number}.json`;
    if (preset) writeFileSync(file, JSON.stringify({ ...JSON.parse(quadtank('presets', preset)), label }));
    const settings = Object.entries(set).flatMap(([path, value]) => ['--set', `${path}=${JSON.stringify(value)}`]);
    return { name, file, settings, number };
  });
}

/** Runs one script. The largest difference of figures of theory and that of levels of the run, as shares of their scales. */
async function check(language, program, { file, settings, number }) {
  const folder = `${FOLDER}/${language.id}-${number}`;
  mkdirSync(folder, { recursive: true });
  writeFileSync(`${folder}/${language.file}`, quadtank('export', file, '--as', language.id, ...settings));
  const start = Date.now();
  const options = { cwd: folder, timeout: TIME_LIMIT, env: { ...process.env, OPENBLAS_NUM_THREADS: '1' } };
  const { stdout } = await run(program, language.args, options);
  if (!/^agrees$/m.test(stdout)) throw new Error(stdout);
  const found = [...stdout.matchAll(/^(.*): figures \d+, largest difference (\S+) of the scale$/gm)];
  const largest = (isRun) => Math.max(0, ...found.filter(([, what]) => (what === 'levels of the run') === isRun).map(([, , d]) => +d));
  return { theory: largest(false), run: largest(true), seconds: (Date.now() - start) / 1000 };
}

/** Runs all scripts of a language, some at a time, and prints a line for each in the order in which they end. */
async function checkAll(language, program, documents) {
  const pending = [...documents];
  const counts = { passed: 0, failed: 0 };
  const worker = async () => {
    for (let document; (document = pending.shift()); ) {
      try {
        const { theory, run, seconds } = await check(language, program, document);
        const figures = `theory ${theory.toExponential(1)}, run ${run.toExponential(1)}, ${seconds.toFixed(1)} s`;
        console.log(`${language.id.padEnd(7)} ${document.number} ${document.name}: ${figures}`);
        counts.passed += 1;
      } catch (error) {
        console.log(`${language.id.padEnd(7)} ${document.number} ${document.name}: FAILED\n${error.message}`);
        counts.failed += 1;
      }
    }
  };
  await Promise.all(Array.from({ length: availableParallelism() }, worker));
  return counts;
}

const CARGO = ['build', '--quiet', '--locked', '-p', 'quadtank-cli'];
execFileSync('cargo', CARGO, { stdio: 'inherit' });
rmSync(FOLDER, { recursive: true, force: true });
mkdirSync(FOLDER, { recursive: true });
const all = documents().filter(({ name }) => name.includes(process.env.ONLY ?? ''));
const total = { passed: 0, failed: 0 };
for (const language of LANGUAGES) {
  const program = language.program();
  if (!program) {
    tell(`SKIPPED: ${language.missing}`);
    continue;
  }
  const { passed, failed } = await checkAll(language, program, all);
  total.passed += passed;
  total.failed += failed;
}
tell('differences are shares of the scale that each script states; 1e-6 is allowed. Julia is exported, but not run here.');
console.log(`${total.passed} passed, ${total.failed} failed`);
process.exitCode = total.failed === 0 ? 0 : 1;
