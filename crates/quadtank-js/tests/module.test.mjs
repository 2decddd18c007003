// The package as `tools/module.sh` builds it, in Node.js, beside the command line of the same source.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, test } from 'node:test';
import { pathToFileURL } from 'node:url';

const ROOT = resolve(import.meta.dirname, '../../..');
const PACKAGE = join(ROOT, 'target/npm/quadtank');
const COMMAND = join(process.env.CARGO_TARGET_DIR ?? join(ROOT, 'target'), 'debug/quadtank');

// As a project has it: by its name, from node_modules.
const project = mkdtempSync(join(tmpdir(), 'quadtank-'));
cpSync(PACKAGE, join(project, 'node_modules/quadtank'), { recursive: true });
after(() => rmSync(project, { recursive: true }));

const quadtank = await import(pathToFileURL(join(PACKAGE, 'node.js')));
assert.throws(() => quadtank.analyse({}), /call `await init\(\)` first/);
await quadtank.default();

/** What the command line answers to a document. */
function command(document, ...words) {
  const { status, stdout, stderr } = spawnSync(COMMAND, words, { input: JSON.stringify(document), encoding: 'utf8', maxBuffer: 1 << 28 });
  return { status, stdout, message: stderr.replace(/^quadtank: (standard input: )?/, '').trim() };
}

/** Whether two reports have the same shape and words, and numbers that are equal but for the rounding of transcendental functions. */
function assertSame(one, other, place = '') {
  if (typeof one === 'number' && typeof other === 'number') {
    assert.ok(Math.abs(one - other) <= 1e-9 * Math.max(1, Math.abs(one)), `${place}: ${one}, ${other}`);
  } else if (one !== null && typeof one === 'object' && other !== null) {
    assert.deepEqual(Object.keys(one), Object.keys(other), place);
    for (const key of Object.keys(one)) assertSame(one[key], other[key], `${place}.${key}`);
  } else {
    assert.equal(one, other, place);
  }
}

const DOCUMENTS = ['johansson-2000-non-minimum-phase', 'table-6-row-1', 'wood-berry-blt', 'junqueira-b-s3', 'andreis-sine-l'];

for (const name of DOCUMENTS) {
  test(`reports about ${name} are those of the command line`, () => {
    const document = quadtank.published(name);
    assertSame(quadtank.analyse(document), JSON.parse(command(document, 'analyse', '-').stdout));
    assertSame(quadtank.simulate(document), JSON.parse(command(document, 'simulate', '-', '--format', 'json').stdout));
    const tuned = command(document, 'tune', '-');
    if (tuned.status === 0) assertSame(quadtank.tune(document), JSON.parse(tuned.stdout));
    else assert.throws(() => quadtank.tune(document), { message: tuned.message });
    const csv = command(document, 'simulate', '-', '--decimal', 'comma').stdout.split('\n');
    const own = quadtank.simulateCsv(document, { decimal: 'comma' }).split('\n');
    assert.deepEqual([own.length, own[0]], [csv.length, csv[0]]);
    assert.ok(quadtank.plot(document).startsWith('<svg'));
    // Objects and text are the same, and so is what comes back from a link.
    assert.deepEqual(quadtank.analyse(JSON.stringify(document)), quadtank.analyse(document));
    assert.deepEqual(quadtank.fromLink(quadtank.link(document)), document);
  });
}

test('a test of each loop alone is told with what its settings do together', () => {
  const document = quadtank.published('table-6-row-1');
  document.tuning.test.kind = 'independent';
  const { test: found } = quadtank.tune(document);
  assert.deepEqual(found.pair.controllers.map(({ kp }) => kp.toPrecision(9)), found.loops.map(({ settings }) => settings.gain.toPrecision(9)));
  assert.ok('stable' in found.pair.stability);
});

test('a broken document is an Error with the message of the command line', () => {
  const scenario = (change) => Object.assign(quadtank.published('johansson-2000-minimum-phase'), change);
  const { setup } = scenario();
  for (const document of [
    scenario({ setup: { ...setup, valves: [1.5, 0.3] } }),
    scenario({ setup: { ...setup, valves: [Number.NaN, 0.3] } }),
    scenario({ setup: { ...setup, valves: [0.5, 0.5], operating_point: { levels: [0.1, 0.1] } } }),
    scenario({ extra: 1 }),
    scenario({ version: 99 }),
    {},
    [],
    null,
  ]) {
    const { status, message } = command(document, 'analyse', '-');
    assert.equal(status, 2);
    assert.throws(() => quadtank.analyse(document), { name: 'Error', message });
  }
  assert.throws(() => quadtank.analyse('{ "version": 1,5 }'), /decimal comma \(line 1/);
  assert.throws(() => quadtank.analyse(undefined), TypeError);
  assert.throws(() => quadtank.analyse('['.repeat(100_000)), { name: 'Error' });
  assert.throws(() => quadtank.published('nothing'), /`nothing`; publishedNames\(\) lists them/);
  assert.throws(() => quadtank.fromLink('q1.cut'), /damaged or cut off/);
  assert.throws(() => quadtank.plot(scenario(), { chart: 'loci' }), /^Error: chart: unknown variant `loci`/);
  assert.throws(() => quadtank.tune(quadtank.published('andreis-sine-l'), { population: 2 }), /^Error: population: 2 is outside 4 to 1000$/);
  // After all of this it still answers.
  assert.equal(quadtank.quantities(scenario(), ['zero.rightmost'])['zero.rightmost'] < 0, true);
});

test('every published name is a document that the module reads', () => {
  for (const name of quadtank.publishedNames()) assert.ok(quadtank.link(quadtank.published(name)).startsWith('q'), name);
});

test('the types have the fields of the reports, and every function', () => {
  const types = readFileSync(join(PACKAGE, 'index.d.ts'), 'utf8');
  const fields = (name) => {
    const body = types.split(`export interface ${name} {`)[1].split('\n}')[0];
    return [...body.matchAll(/^ {2}(\w+)\??:/gm)].map(([, field]) => field);
  };
  const document = quadtank.published('johansson-2000-minimum-phase');
  const run = quadtank.simulate(document);
  // Away from rest, with valves that depend on the flow, the report has all of its fields.
  const rig = new URL('../../quadtank-scenario/tests/data/flow-dependent-valves.json', import.meta.url);
  const away = JSON.parse(readFileSync(rig, 'utf8'));
  away.setup.operating_point = { state: { levels: [0.124, 0.127, 0.018, 0.014], pump_voltage: [3, 3] } };
  for (const field of ['drift', 'flow_fractions']) assert.equal(field in quadtank.analyse(document), false);
  for (const [name, value] of Object.entries({
    AnalysisReport: quadtank.analyse(away),
    RunReport: run,
    Trajectory: run.nonlinear,
    LoopMetrics: run.metrics[0],
    StepAnswer: run.steps[0],
    PiSettings: document.setup.controller.loops[0],
  })) {
    assert.deepEqual(fields(name), Object.keys(value), name);
  }
  const functions = [...types.matchAll(/^export (?:default )?function (\w+)/gm)].map(([, name]) => name);
  const exported = Object.keys(quadtank).map((name) => (name === 'default' ? 'init' : name));
  assert.deepEqual([...new Set(functions)].sort(), exported.sort());
});

test('the package is complete, and answers by its name', () => {
  const { version, files } = JSON.parse(readFileSync(join(PACKAGE, 'package.json'), 'utf8'));
  assert.equal(execFileSync(COMMAND, ['--version'], { encoding: 'utf8' }).trim(), `quadtank ${version}`);
  for (const file of files) readFileSync(join(PACKAGE, file));
  const script = `import init, { analyse, published } from 'quadtank'; await init(); console.log(analyse(published('cocota-2009-minimum-phase')).rga_11);`;
  const found = execFileSync(process.execPath, ['--input-type=module', '-e', script], { cwd: project, encoding: 'utf8' });
  assert.ok(Number(found) > 1, found);
});
