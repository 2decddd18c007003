// Types of the module. Units are SI. The whole documents are described by `quadtank schema`, reports by `quadtank schema --report`.

/** A document of any bench: 1 the quadruple tank, 2 relay tuning, 3 model-free control, 4 a level loop. */
export interface Document {
  version: 1 | 2 | 3 | 4;
  [field: string]: any;
}

/** A document of the quadruple tank. */
export interface Scenario extends Document {
  version: 1;
  setup: {
    plant: any;
    /** Valve fractions γ1 and γ2, 0 to 1. */
    valves: [number, number];
    /** Voltages (V) or levels of tanks 1 and 2 (m) at rest, or all levels and both voltages of a state that may not be at rest. */
    operating_point:
      | { pump_voltage: [number, number] }
      | { levels: [number, number] }
      | { state: { levels: [number, number, number, number]; pump_voltage: [number, number] } };
    controller: {
      pairing: 'diagonal' | 'swapped';
      loops: [PiSettings, PiSettings];
      /** Ts (s). */
      sampling_time_s: number;
    };
    experiment: any;
  };
}

export interface PiSettings {
  /** K (V/V). */
  gain: number;
  /** Ti (s). */
  integral_time_s: number;
  /** b. */
  set_point_weight: number;
  anti_windup: 'off' | { back_calculation: { tracking_ratio: number } };
  mode: 'automatic' | { manual: { output: number; until_s: number } };
}

export interface Complex {
  re: number;
  im: number;
}

/** A transmission zero (1/s) with its directions, which have length 1. */
export interface Zero {
  value: Complex;
  input_direction: Complex[];
  output_direction: Complex[];
}

/** Why theory has no answer; it stands in the place of the answer. */
export type TheoryError = string | Record<string, unknown>;

/** What linear theory says about a run of the quadruple tank. */
export interface AnalysisReport {
  /** Levels (m) and pump voltages (V), walls and limits ignored. */
  operating_point: { levels: [number, number, number, number]; pump_voltage: [number, number] };
  /** Where the walls (m) or the pumps (V) do not allow it. */
  out_of_range: unknown[];
  /** How fast the levels leave an operating point that is not at rest by themselves (m/s); absent at rest. */
  drift?: [number, number, number, number];
  /** How the valves divide flows: what goes to the lower tank of the flow, and of a small change of it; absent where they divide any flow alike. */
  flow_fractions?: { of_flow: [number, number]; incremental: [number, number] };
  /** T1 to T4 (s); null for a tank that is dry. */
  time_constants_s: (number | null)[];
  /** The linear model without dry tanks, by rows. */
  model: { a: number[][]; b: number[][]; c: number[][]; d: number[][] };
  /** Poles (1/s). */
  poles: Complex[];
  /** Transmission zeros, by rising real part. */
  zeros: Zero[] | TheoryError;
  /** G(0), by rows (V/V). */
  dc_gain: [[number, number], [number, number]];
  /** λ11 of the relative gain array at steady state. */
  rga_11: number | TheoryError;
  /** Niederlinski index of both pairings. */
  niederlinski: { diagonal: number | null; swapped: number | null };
  /** Which pairing is suggested, and by which rule. */
  suggestion: { pairing: 'diagonal' | 'swapped' | 'none'; reason: { rule: string; relative_gain?: number } };
  /** The sampled closed loop with the controller of the document. */
  closed_loop: {
    stability: 'stable' | 'marginal' | 'unstable';
    poles_z: Complex[];
    poles_s: Complex[];
    sensitivity_peak: number | null;
    /** Its frequency (rad/s). */
    sensitivity_peak_frequency: number | null;
    guaranteed_margins: { gain_min: number; gain_max: number | null; phase_rad: number } | null;
  };
}

/** A run by columns of equal length. */
export interface Trajectory {
  /** Time (s). */
  time_s: number[];
  /** Levels h1 to h4 (m). */
  levels: [number[], number[], number[], number[]];
  /** References of levels 1 and 2 (m). */
  references: [number[], number[]];
  /** Outputs of loops 1 and 2, limited (V). */
  controller_output: [number[], number[]];
  /** Voltages of pumps 1 and 2 (V). */
  pump_voltage: [number[], number[]];
  /** What happened, each kind once, when it first began. */
  events: { time_s: number; kind: Record<string, { tank?: number; pump?: number }> }[];
}

/** Figures of a loop; null where there is no step to judge. */
export interface LoopMetrics {
  step_time_s: number | null;
  window_s: number | null;
  no_response: unknown;
  rise_time_s: number | null;
  settling_2_percent: unknown;
  settling_5_percent: unknown;
  /** Share of the step. */
  overshoot: number | null;
  undershoot: number | null;
  window_iae: number | null;
  other_peak: number;
  iae: number;
  ise: number;
  itae: number;
  total_variation: number;
  saturated_s: number;
}

/** A step of a reference, and how its loop answered it. */
export interface StepAnswer {
  /** Index of the loop, 0 or 1. */
  level: number;
  time_s: number;
  /** The reference before and after the step (m). */
  from: number;
  to: number;
  window_s: number | null;
  no_response: unknown;
  rise_time_s: number | null;
  settling_2_percent: unknown;
  settling_5_percent: unknown;
  /** Share of the step. */
  overshoot: number | null;
  undershoot: number | null;
  window_iae: number | null;
  other_peak: number;
}

/** What happens in a run of the quadruple tank. */
export interface RunReport {
  metrics: [LoopMetrics, LoopMetrics];
  linear_metrics: [LoopMetrics, LoopMetrics];
  steps: StepAnswer[];
  linear_steps: StepAnswer[];
  judged_without_noise: boolean;
  nonlinear: Trajectory;
  linear: Trajectory;
}

/** A report about a document of another bench. */
export type Report = Record<string, any>;

/** How the settings of a level loop are searched. */
export interface SearchOptions {
  method?: 'nelder-mead' | 'gradient' | 'genetic';
  /** Of the genetic search. */
  seed?: number;
  /** Of the genetic search, 4 to 1000. */
  population?: number;
  /** Of the genetic search, 1 to 1000. */
  generations?: number;
}

/** Signs of a table; with a decimal comma, if nothing is said, semicolons stand between columns. */
export interface TableOptions {
  separator?: 'comma' | 'semicolon' | 'tab';
  decimal?: 'point' | 'comma';
}

export interface PlotOptions {
  /** Of the quadruple tank: responses (the default), valve-plane, pole-zero, frequency; of relay tuning: loci (the default), curve, test,
   * response; of model-free control: run; of a level loop: run (the default), step-test, trade-off, cost-map. */
  chart?:
    | 'responses' | 'valve-plane' | 'pole-zero' | 'frequency'
    | 'loci' | 'curve' | 'test' | 'response'
    | 'run' | 'step-test' | 'trade-off' | 'cost-map';
  theme?: 'light' | 'dark';
}

/** The WebAssembly of the module: its address, a response with it, or its bytes. */
export type Source = URL | string | Response | ArrayBuffer | ArrayBufferView;

/**
 * Loads the laboratory; everything else needs it first. Without an argument its WebAssembly is taken from beside the module.
 * The policy of a page has to allow 'wasm-unsafe-eval'.
 */
export default function init(source?: Source | Promise<Source>): Promise<void>;

// Every function takes a document as an object or as JSON text. What is wrong with it is thrown as an Error, whose message begins with
// the place: `setup.valves[0]: 1.5 is outside 0 to 1`.

/** What linear theory says: equilibrium, model, poles, zeros with directions, relative gain, closed loop. */
export function analyse(document: Scenario): AnalysisReport;
export function analyse(document: Document | string): Report;

/** The run: trajectories, events and metrics. */
export function simulate(document: Scenario): RunReport;
export function simulate(document: Document | string): Report;

/** The run as a table, with the unit of each column in its name. */
export function simulateCsv(document: Document | string, options?: TableOptions): string;

/** Relay test and design of a relay-tuning session, or a search for the settings of a level loop. */
export function tune(document: Document | string, options?: SearchOptions): Report;

/** Quantities by their names, such as `zero.rightmost`; null where one does not exist. */
export function quantities<Name extends string>(document: Document | string, names: Name[]): Record<Name, number | null>;

/** A picture as SVG. */
export function plot(document: Document | string, options?: PlotOptions): string;

/** What the document may not have been meant to say. */
export function warnings(document: Document | string): string[];

/** The document of a published rig or case. */
export function published(
  name:
    | 'johansson-2000-minimum-phase' | 'johansson-2000-non-minimum-phase'
    | 'cocota-2009-minimum-phase' | 'cocota-2009-non-minimum-phase'
    | 'junqueira-case-a' | 'junqueira-case-b'
    | 'seville-hd-mpc' | 'quanser-mpctools' | 'mpctools-nonlinear' | 'dtu-modified-four-tank',
): Scenario;
export function published(name: string): Document;

/** The names of all published rigs and cases. */
export function publishedNames(): string[];

/** The text that stands for a document in a link: `https://…/#lab=` and this. */
export function link(document: Document | string): string;

/** The document in the text of a link. */
export function fromLink(link: string): Document;
