//! Relay tuning without a screen: what a session finds, as JSON, CSV or a picture.

use clap::ValueEnum;
use quadtank::control::{IsaPid, ParallelPid};
use quadtank::linear::{Closure, Complex, LinearError, Loci, LoopStability};
use quadtank::sim::{Halt, LoopTrace, StepFigures};
use quadtank::study::relay_tuning::{
    Comparison, DesignRoot, Designed, PlantStudy, SteadyState, TestSpec, Tested, Tuning, TuningSetup, tune,
};
use quadtank::tuning::{
    Corner, CurveDistance, CurvePoint, GainLimit, RelayReading, RelayVerdict, TestAndSettings, TuningError,
    dynamic_relative_gain,
};
use quadtank_figure::{
    Chart, CurveChart, LociChart, LoopsChart, LoopsRecord, Pen, Size, Style, characteristic_loci, critical_curve,
    to_svg, two_loops,
};
use quadtank_scenario::tuning::{record_to_csv, response_to_csv, warnings};
use serde_json::{Value, json};

/// What can be drawn of a session.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Picture {
    /// The relay test over time
    Test,
    /// The critical curve in normalised gains, with estimates
    Curve,
    /// Both characteristic loci of the design, and at the critical gains
    Loci,
    /// Outputs and inputs after a step of the references
    Response,
}

/// Why a record ends before its time.
const TOO_MUCH_WORK: &str = "not computed to its end, because the plant is too quick for so long a record: shorten the \
                             duration, lengthen the step, or leave out quick poles";

fn complex(value: Complex) -> Value {
    json!({ "re": value.re, "im": value.im })
}

/// A 2 × 2 matrix by rows.
fn rows<T>(entry: impl Fn(usize, usize) -> T) -> [[T; 2]; 2] {
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// What follows from the plant alone.
pub fn analysis(setup: &TuningSetup) -> Result<Value, TuningError> {
    let steady_state = SteadyState::of(&setup.plant.transfer_matrix()?);
    let curve = match PlantStudy::of(&setup.plant) {
        // A loop without a gain of its own: the axes of the curve have no unit.
        Err(TuningError::Linear(error @ LinearError::SingularGain { .. })) => Err(error),
        study => Ok(study?.curve),
    };
    Ok(json!({
        "dc_gain": rows(|row, column| steady_state.dc_gain[(row, column)]),
        "rga_11": in_place(steady_state.rga_11.as_ref(), |gain| json!(gain)),
        "niederlinski_diagonal": steady_state.niederlinski_diagonal,
        "critical_curve": in_place(curve.as_ref(), |curve| curve.points.iter().map(point).collect()),
        "corners": in_place(curve.as_ref(), |curve| curve.corners.iter().map(corner).collect()),
        "warnings": warnings(setup),
    }))
}

/// An answer, or the typed reason why there is none.
fn in_place<T>(answer: Result<&T, &LinearError>, write: impl FnOnce(&T) -> Value) -> Value {
    answer.map_or_else(|error| json!(error), write)
}

fn point(point: &CurvePoint) -> Value {
    json!({ "angle_rad": point.angle, "limit": limit(&point.limit) })
}

fn corner(corner: &Corner) -> Value {
    let [slow, quick] = corner.points;
    json!({ "importance": corner.importance, "gains": slow.gains, "periods": [slow.period(), quick.period()] })
}

fn limit(limit: &GainLimit) -> Value {
    match limit {
        GainLimit::Oscillation(point) => {
            json!({ "kind": "oscillation", "gains": point.gains, "period": point.period() })
        }
        GainLimit::RealPole { gains, .. } => json!({ "kind": "real-pole", "gains": gains }),
        GainLimit::None => json!({ "kind": "none" }),
    }
}

/// What test and design find.
pub fn report(setup: &TuningSetup) -> Result<Value, TuningError> {
    let found = tune(setup)?;
    let design = found.design.as_ref().map(|design| designed(&found.study, design, setup)).transpose()?;
    let test = tested(&found.study, &found.test, &setup.test)?;
    Ok(json!({ "test": test, "design": design, "warnings": warnings(setup) }))
}

fn tested(study: &PlantStudy, test: &Tested, spec: &TestSpec) -> Result<Value, TuningError> {
    Ok(match test {
        Tested::Single(test, found) => {
            let cycle = match test.reading.oscillation {
                Some(oscillation) => study.exact_limit_cycle(spec, oscillation.period)?,
                None => None,
            };
            let found = found.map(|point| {
                json!({ "frequency": point.frequency, "modulus": point.modulus, "response": complex(point.response) })
            });
            let cycle = cycle.map(|c| json!({ "period": c.period, "amplitude": c.amplitude, "stable": c.is_stable() }));
            json!({
                "kind": "single",
                "reading": reading(&test.reading),
                "found": found,
                "exact_limit_cycle": cycle,
            })
        }
        Tested::Simultaneous(test, [by_peak, by_harmonic]) => {
            let recovered = test.reading.oscillation.map(|of| study.recover(&of)).transpose()?;
            json!({
                "kind": "simultaneous",
                "reading": reading(&test.reading),
                "distance_by_peak": by_peak.map(distance),
                "distance_by_harmonic": by_harmonic.map(distance),
                "recovered_g": recovered.map(|g| rows(|row, column| complex(g.measured[(row, column)]))),
                "exact_g": recovered.map(|g| rows(|row, column| complex(g.exact[(row, column)]))),
            })
        }
        Tested::Independent(loops) => {
            let of_loop = |(test, settings): &TestAndSettings| json!({ "reading": reading(&test.reading), "settings": settings.map(isa) });
            json!({ "kind": "independent", "loops": loops.iter().map(of_loop).collect::<Vec<_>>() })
        }
        Tested::Sequential(steps) => {
            let steps: Vec<Value> = steps
                .iter()
                .map(|step| {
                    json!({
                        "pass": step.pass,
                        "loop": step.index + 1,
                        "reading": reading(&step.test.reading),
                        "settings": step.settings.map(isa),
                    })
                })
                .collect();
            json!({ "kind": "sequential", "steps": steps })
        }
    })
}

fn reading(reading: &RelayReading) -> Value {
    let (verdict, detail) = match reading.verdict {
        RelayVerdict::Unimodal => ("unimodal", Value::Null),
        RelayVerdict::Multimodal { switches } => ("multimodal", json!({ "switches_per_period": switches })),
        RelayVerdict::NotPeriodic => ("not-periodic", Value::Null),
        RelayVerdict::Chattering { relay } => ("chattering", json!({ "loop": relay + 1 })),
        RelayVerdict::NoOscillation => ("none", Value::Null),
        RelayVerdict::Diverged => ("diverged", Value::Null),
        RelayVerdict::Unfinished { time } => ("unfinished", json!({ "time": time, "reason": TOO_MUCH_WORK })),
    };
    let oscillation = reading.oscillation.map(|o| {
        json!({
            "period": o.period,
            "amplitudes": o.loops.map(|l| l.amplitude),
            "gains_by_peak": o.loops.map(|l| l.gain_by_peak),
            "gains_by_harmonic": o.loops.map(|l| l.gain_by_harmonic),
            "turn_rad": o.loops.map(|l| l.turn),
            "is_proportional": o.is_proportional(),
        })
    });
    json!({ "verdict": verdict, "detail": detail, "oscillation": oscillation })
}

fn distance(distance: CurveDistance) -> Value {
    json!({ "excess": distance.excess, "curve_period": distance.period, "same_branch": distance.same_branch })
}

fn isa(pid: IsaPid) -> Value {
    let integral_time = pid.integral_time.is_finite().then_some(pid.integral_time);
    json!({ "gain": pid.gain, "integral_time": integral_time, "derivative_time": pid.derivative_time })
}

fn designed(study: &PlantStudy, design: &Designed, setup: &TuningSetup) -> Result<Value, TuningError> {
    let [one, two] = &design.roots;
    Ok(json!({
        "frequency": design.frequency,
        "g": rows(|row, column| complex(design.g[(row, column)])),
        "dynamic_relative_gain_11": complex(dynamic_relative_gain(&design.g)),
        "roots": [root(study, one)?, root(study, two)?],
        "chosen": setup.design.root,
        "figures": design.response.figures.map(figures),
        "response_halted": design.response.trace.halt.map(halt),
        "comparison": design.comparison.as_ref().map(comparison),
    }))
}

/// The controllers that the design is compared with, row by input, and what they do.
fn comparison(of: &Comparison) -> Value {
    json!({
        "controllers": of.controllers.0.map(|row| row.map(gains)),
        "stability": stability(of.stability),
        "figures": of.response.figures.map(figures),
        "response_halted": of.response.trace.halt.map(halt),
    })
}

fn gains(pid: ParallelPid) -> Value {
    json!({ "kp": pid.proportional, "ki": pid.integral, "kd": pid.derivative })
}

/// Why stability or margins are not computed.
const NOT_COMPUTED: &str = "the loci turn too often before the gain of the loop becomes small";

fn stability(of: LoopStability) -> Value {
    match of {
        LoopStability::Stable => json!({ "stable": true }),
        LoopStability::Unstable { poles } => json!({ "stable": false, "right_half_plane_poles": poles }),
        LoopStability::Marginal { frequency } => json!({ "stable": false, "marginal_at": frequency }),
        LoopStability::NotComputed { frequency } => {
            json!({ "stable": null, "not_computed": NOT_COMPUTED, "gain_up_to": frequency })
        }
    }
}

fn root(study: &PlantStudy, root: &DesignRoot) -> Result<Value, TuningError> {
    let margins = study.margins(root)?;
    Ok(json!({
        "controllers": root.controllers.map(gains),
        "warnings": root.warnings,
        "stability": stability(root.stability),
        "margins_not_computed": margins.is_none().then_some(NOT_COMPUTED),
        "distance_from_minus_one": margins.map(|m| m.distance),
        "gain_margin": margins.and_then(|m| m.gain_up),
        "lower_gain_margin": margins.and_then(|m| m.gain_down),
        "phase_margin_rad": margins.and_then(|m| m.phase),
        "closure": match root.closure { Closure::Separate => "separate", Closure::Joint => "joint" },
    }))
}

fn figures(of: StepFigures) -> Value {
    json!({ "overshoot": of.overshoot, "settling_time_2_percent": of.settling_time, "peak": of.peak, "iae": of.iae })
}

fn halt(halt: Halt) -> Value {
    match halt {
        Halt::Chattering { relay, time } => json!({ "kind": "chattering", "loop": relay + 1, "time": time }),
        Halt::Diverged { time } => json!({ "kind": "diverged", "time": time }),
        Halt::Full { time } => json!({ "kind": "full", "time": time, "reason": TOO_MUCH_WORK }),
    }
}

/// The record of the relay test; of several tests the last.
fn record(test: &Tested) -> Option<&LoopTrace> {
    match test {
        Tested::Single(test, _) | Tested::Simultaneous(test, _) => Some(&test.trace),
        Tested::Independent(loops) => loops.last().map(|(test, _)| &test.trace),
        Tested::Sequential(steps) => steps.last().map(|step| &step.test.trace),
    }
}

/// The response of the design, one row per sample and per arrival of what a dead time had held back, beside the one that it is
/// compared with.
pub fn response_csv(setup: &TuningSetup) -> Result<String, TuningError> {
    let found = tune(setup)?;
    Ok(found.design.as_ref().map(response_to_csv).unwrap_or_default())
}

/// The record of the relay test, one row per step, switch and arrival.
pub fn test_csv(setup: &TuningSetup) -> Result<String, TuningError> {
    Ok(record(&tune(setup)?.test).map(record_to_csv).unwrap_or_default())
}

/// Draws a picture of a session as an SVG document.
pub fn svg(setup: &TuningSetup, picture: Picture, style: &Style) -> Result<String, TuningError> {
    let found = tune(setup)?;
    let size = Size { width: 720.0, height: 560.0 };
    let empty = LoopTrace::default();
    let (title, description) = match picture {
        Picture::Test => ("Relay test", "Outputs and relay outputs of both loops over time."),
        Picture::Curve => ("Critical curve", "The boundary of the stable gains of two proportional loops."),
        Picture::Loci => ("Characteristic loci", "Both characteristic loci with the point −1 and the target."),
        Picture::Response => ("Response", "Outputs and inputs after a step of the references."),
    };
    Ok(match picture {
        Picture::Test => {
            let trace = record(&found.test).unwrap_or(&empty);
            loops_svg(&[(trace, Pen::Solid)], None, |charts| to_svg(charts, size, style, title, description))
        }
        Picture::Response => {
            let compared = found.design.as_ref().and_then(|design| design.comparison.as_ref());
            let compared = compared.map(|comparison| (&comparison.response.trace, Pen::Dotted));
            let trace = found.design.as_ref().map_or(&empty, |design| &design.response.trace);
            let records: Vec<_> = compared.into_iter().chain([(trace, Pen::Solid)]).collect();
            let references = Some(setup.response.references);
            loops_svg(&records, references, |charts| to_svg(charts, size, style, title, description))
        }
        Picture::Curve => curve(&found, |chart| to_svg(&[critical_curve(chart)], size, style, title, description)),
        Picture::Loci => {
            loci(&found, setup, |chart| to_svg(&[characteristic_loci(chart)], size, style, title, description))
        }
    })
}

fn drawn(trace: &LoopTrace, pen: Pen) -> LoopsRecord<'_> {
    LoopsRecord {
        name: if pen == Pen::Solid { "" } else { "compared" },
        time: &trace.time,
        outputs: trace.outputs.each_ref().map(Vec::as_slice),
        inputs: trace.inputs.each_ref().map(Vec::as_slice),
        switches: trace.switches.each_ref().map(Vec::as_slice),
        pen,
    }
}

/// Charts of records with their pens, the one that counts last, as SVG.
fn loops_svg(records: &[(&LoopTrace, Pen)], references: Option<[f64; 2]>, draw: impl Fn(&[Chart]) -> String) -> String {
    let end = records.last().and_then(|(trace, _)| trace.time.last());
    let window = (0.0, end.copied().unwrap_or(1.0));
    let (axes, texts) = (["time", "output", "input"], ["loop 1", "loop 2"]);
    let records: Vec<_> = records.iter().map(|&(trace, pen)| drawn(trace, pen)).collect();
    draw(&two_loops(&LoopsChart { records: &records, window, references, axes, texts }))
}

fn curve<T>(found: &Tuning, draw: impl Fn(&CurveChart) -> T) -> T {
    let normal = |gains: [f64; 2]| found.study.normalised(gains);
    let point = |limit: &GainLimit| match limit {
        GainLimit::Oscillation(point) => normal(point.gains),
        GainLimit::RealPole { gains, .. } => normal(*gains),
        GainLimit::None => (f64::NAN, f64::NAN),
    };
    let (x, y): (Vec<f64>, Vec<f64>) = found.study.curve.points.iter().map(|at| point(&at.limit)).unzip();
    let corners: Vec<(f64, f64)> =
        found.study.curve.corners.iter().map(|corner| normal(corner.points[0].gains)).collect();
    let oscillation = match &found.test {
        Tested::Simultaneous(test, _) => test.reading.oscillation,
        Tested::Single(..) | Tested::Independent(_) | Tested::Sequential(_) => None,
    };
    let harmonic: Vec<(f64, f64)> = oscillation.and_then(|o| o.gains_by_harmonic()).map(normal).into_iter().collect();
    let peak: Vec<(f64, f64)> = oscillation.and_then(|o| o.gains_by_peak()).map(normal).into_iter().collect();
    let chosen = found.design.as_ref().map(|design| normal(design.critical_gains));
    draw(&CurveChart {
        curve: [&x, &y],
        corners: &corners,
        estimates: [&harmonic, &peak],
        rays: &[(1.0, "r2 = 1".to_owned())],
        chosen,
        axes: ["k1 g11(0)", "k2 g22(0)"],
        texts: ["critical curve", "relay test, first harmonics", "relay test, peaks", "corner"],
    })
}

fn loci<T>(found: &Tuning, setup: &TuningSetup, draw: impl Fn(&LociChart) -> T) -> T {
    // Real and imaginary parts of both loci.
    let columns = |loci: &Loci| -> [[Vec<f64>; 2]; 2] {
        loci.branches.each_ref().map(|branch| {
            let (re, im) = branch.iter().map(|x| (x.re, x.im)).unzip();
            [re, im]
        })
    };
    let [before, after] =
        found.design.as_ref().map_or_else(Default::default, |design| design.loci.each_ref().map(columns));
    let [re, im] = setup.design.target;
    draw(&LociChart {
        loci: after.each_ref().map(|parts| parts.each_ref().map(Vec::as_slice)),
        before: before.each_ref().map(|parts| parts.each_ref().map(Vec::as_slice)),
        target: (re, im),
        rules: &[],
        axes: ["real part", "imaginary part"],
        texts: ["locus 1", "locus 2", "at the critical gains"],
    })
}
