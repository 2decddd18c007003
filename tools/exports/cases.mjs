// Experiments that go the ways of an exported script that no preset goes: each a preset or a document, with values that are set.

const P_MINUS = 'johansson-2000-minimum-phase';
const P_PLUS = 'johansson-2000-non-minimum-phase';
const COCOTA_MINUS = 'cocota-2009-minimum-phase';
const COCOTA_PLUS = 'cocota-2009-non-minimum-phase';

const first = 'setup.controller.loops[0]';
const second = 'setup.controller.loops[1]';
const step = (level, time_s, size) => ({ level, time_s, size });
const leak = (time_s, tank, area) => ({ time_s, load: { leak: { tank, area } } });
const flow = (time_s, pump, flow) => ({ time_s, load: { pump_flow: { pump, flow } } });

export const CASES = [
  { name: 'a rig of its own with everything', document: 'crates/quadtank-scenario/tests/data/everything-acts.json', set: {} },
  {
    name: 'a name and a note that would end a comment',
    preset: P_MINUS,
    set: { 'setup.experiment.duration_s': 200 },
    label: {
      name: '"""\nraise SystemExit(1)\r%{\n#= */ coding: utf-7 \\',
      note: "''' \u2028error('not reached')\n%}\nexit(1) ...\n",
    },
  },
  {
    name: 'levels that are not at rest, with tanks that taper',
    preset: COCOTA_MINUS,
    set: {
      'setup.operating_point': { state: { levels: [0.12, 0.19, 0.04, 0.08], pump_voltage: [5.5, 6] } },
      'setup.experiment.duration_s': 400,
    },
  },
  {
    name: 'swapped pairing, weights, no anti-windup',
    preset: P_PLUS,
    set: {
      'setup.controller.pairing': 'swapped',
      [`${first}.gain`]: 0.5,
      [`${first}.set_point_weight`]: 0.3,
      [`${second}.gain`]: 0.3,
      [`${second}.anti_windup`]: 'off',
    },
  },
  {
    name: 'manual mode, beyond a limit too',
    preset: COCOTA_MINUS,
    set: {
      [`${first}.mode`]: { manual: { output: 9, until_s: 200 } },
      [`${second}.mode`]: { manual: { output: 20, until_s: 150.5 } },
    },
  },
  {
    name: 'loads and leaks between samples',
    preset: P_MINUS,
    set: {
      'setup.experiment.load_steps': [
        leak(700.25, 2, 1.5e-6),
        flow(400, 1, -4e-6),
        leak(900.5, 0, 2e-6),
        flow(900.75, 0, 3e-6),
        leak(900.75, 3, 1e-6),
      ],
    },
  },
  {
    name: 'pumps, valves and outlets that change',
    preset: P_MINUS,
    set: {
      'setup.experiment.load_steps': [
        { time_s: 200.25, load: { pump_gain: { pump: 0, change: -0.2 } } },
        { time_s: 300, load: { valve: { valve: 1, change: -0.1 } } },
        { time_s: 500.5, load: { outlet: { tank: 3, change: -1 } } },
        { time_s: 900, load: { outlet: { tank: 3, change: 1 } } },
      ],
    },
  },
  { name: 'levels as operating point', preset: COCOTA_PLUS, set: { 'setup.operating_point': { levels: [0.12, 0.14] } } },
  {
    name: 'tanks overflow and come down again',
    preset: P_MINUS,
    set: {
      'setup.valves': [0.43, 0.34],
      'setup.experiment.set_point_steps': [step(0, 100, 0.09), step(0, 1000, -0.06)],
    },
  },
  { name: 'full at the start, singular', preset: P_MINUS, set: { 'setup.valves': [0.3, 0.7] } },
  { name: 'a tank runs dry', preset: P_MINUS, set: { 'setup.experiment.set_point_steps': [step(0, 100, -0.12)] } },
  {
    name: 'an upper tank almost dry',
    preset: P_MINUS,
    set: { 'setup.valves': [0.9999, 0.6], 'setup.experiment.duration_s': 300 },
  },
  { name: 'unstable, slowly', preset: P_PLUS, set: { 'setup.controller.pairing': 'swapped' } },
  { name: 'unstable, held by limits and walls', preset: P_PLUS, set: { [`${second}.gain`]: 2.7 } },
  { name: 'singular steady state', preset: P_MINUS, set: { 'setup.valves': [0.6, 0.4] } },
  { name: 'singular at every frequency', preset: P_MINUS, set: { 'setup.valves': [1, 0] } },
  { name: 'both upper tanks dry', preset: P_MINUS, set: { 'setup.valves': [1, 1] } },
  { name: 'one upper tank dry', preset: P_MINUS, set: { 'setup.valves': [1, 0.6] } },
  { name: 'no finite zero', preset: P_MINUS, set: { 'setup.valves': [0, 0.6] } },
  { name: 'one pump off', preset: P_MINUS, set: { 'setup.operating_point': { pump_voltage: [3, 0] } } },
  { name: 'no water at all', preset: P_MINUS, set: { 'setup.operating_point': { pump_voltage: [0, 0] } } },
  {
    name: 'inflow into the upper tanks',
    document: 'crates/quadtank-scenario/tests/data/inflow-into-upper-tanks.json',
    set: {},
  },
  { name: 'levels of its own at the start', document: 'crates/quadtank-scenario/tests/data/initial-levels.json', set: {} },
  { name: 'a pump by hand', document: 'crates/quadtank-scenario/tests/data/pump-sequence.json', set: {} },
  {
    name: 'both pumps by hand, beyond a limit too',
    preset: COCOTA_MINUS,
    set: {
      'setup.experiment.pump_voltage_steps': [
        { pump: 0, time_s: 50.3, voltage: 9 },
        { pump: 1, time_s: 20, voltage: 30 },
        { pump: 1, time_s: 200, voltage: 7 },
      ],
    },
  },
  {
    name: 'hoses that delay the pumps',
    document: 'crates/quadtank-scenario/tests/data/hoses.json',
    set: {},
  },
  {
    name: 'valves whose fractions depend on the flow',
    document: 'crates/quadtank-scenario/tests/data/flow-dependent-valves.json',
    set: {},
  },
  { name: 'one loop open', preset: P_MINUS, set: { [`${second}.gain`]: 0 } },
  { name: 'a real sensor', preset: COCOTA_MINUS, set: { 'setup.experiment.measurement.quantised': true } },
  {
    name: 'coarse samples, an end between two',
    preset: COCOTA_PLUS,
    set: { 'setup.controller.sampling_time_s': 40, 'setup.experiment.duration_s': 2330 },
  },
];
