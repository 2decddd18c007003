use std::borrow::Cow;

use quadtank::sim::Trajectory;

use super::ends::{Ends, names};
use super::flag::{Flag, flags};
use super::judged::JudgedStep;
use super::range::{extent, range};
use super::{Axis, Chart, Course, Entry, Layer, Pen, Role, Sample, Series};

/// A level chart never shows less than this share of the height of the walls, so that noise does not look like a step.
const MIN_SHARE: f64 = 0.05;
/// Least range of a voltage chart (V).
const MIN_VOLTAGE: f64 = 1.0;
/// The columns of a run, all of the length of `time_s`.
#[derive(Clone, Copy, Debug)]
pub struct RunColumns<'a> {
    /// Time (s), rising.
    pub time_s: &'a [f64],
    /// Levels 1 and 2 (m).
    pub levels: [&'a [f64]; 2],
    /// Pump voltages 1 and 2, each held until the next time (V).
    pub voltages: [&'a [f64]; 2],
}

impl<'a> RunColumns<'a> {
    /// The columns of a run that responses show.
    pub fn of(run: &'a Trajectory) -> Self {
        let Trajectory { time_s, levels: [level_1, level_2, ..], pump_voltage, .. } = run;
        Self { time_s, levels: [level_1, level_2], voltages: pump_voltage.each_ref().map(Vec::as_slice) }
    }
}

/// What the response charts show.
#[derive(Clone, Debug)]
pub struct Responses<'a> {
    /// The nonlinear plant.
    pub nonlinear: RunColumns<'a>,
    /// References 1 and 2 at the times of the nonlinear run (m).
    pub references: [&'a [f64]; 2],
    /// The linear model.
    pub linear: Option<RunColumns<'a>>,
    /// A record of a rig, behind all else, with its name. Signals that were not recorded are empty.
    pub recorded: Option<(RunColumns<'a>, &'a str)>,
    /// Pinned runs with their names.
    pub pinned: Vec<(RunColumns<'a>, &'a str)>,
    /// Levels are shown in metres times this: 100 for centimetres.
    pub level_scale: f64,
    /// Height of the walls of tanks 1 and 2 (m).
    pub walls: [f64; 2],
    /// Lowest and highest voltage of the pumps (V).
    pub voltage_limits: (f64, f64),
    /// The time that is shown (s); all of it if `None`.
    pub window_s: Option<(f64, f64)>,
    /// What happened when.
    pub flags: &'a [Flag],
    /// Reference steps whose responses have metrics.
    pub steps: &'a [JudgedStep],
    /// Words.
    pub texts: ResponseTexts<'a>,
}

/// The words of the response charts. The legend shows those that are not empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct ResponseTexts<'a> {
    /// Name and unit of the time axis.
    pub time: &'a str,
    /// Name and unit of the level axis.
    pub level: &'a str,
    /// Name and unit of the voltage axis.
    pub voltage: &'a str,
    /// Names of levels 1 and 2, for the table.
    pub levels: [&'a str; 2],
    /// Names of references 1 and 2, for the table.
    pub references: [&'a str; 2],
    /// Names of pumps 1 and 2, for the table.
    pub voltages: [&'a str; 2],
    /// What a dashed line is.
    pub reference: &'a str,
    /// What a dotted line is.
    pub linear: &'a str,
}

/// Two charts for one figure with a common time axis: levels with their references above, pump voltages below.
///
/// The level range is that of the nonlinear run and its references; the other runs may stretch it once over to either
/// side, but not beyond the walls. A run that diverges therefore leaves the chart instead of flattening the rest.
pub fn responses<'a>(spec: &Responses<'a>) -> [Chart<'a>; 2] {
    let texts = &spec.texts;
    let time = spec.window_s.or_else(|| extent(spec.nonlinear.time_s)).unwrap_or((0.0, 1.0));
    let (low, high) = level_range(spec, time);
    let level_range = (low * spec.level_scale, high * spec.level_scale);
    let level = Axis::rounded(texts.level, level_range, 6);
    let mut levels = Chart::new(Axis::new("", time), level);
    levels.x.numbered = false;
    levels.weight = 2.2;
    levels.layers = level_layers(spec);
    levels.layers.extend(flags(spec.flags, low * spec.level_scale, time));
    levels.legend = legend(spec);
    let voltage = Axis::rounded(texts.voltage, voltage_range(spec, time), 3);
    let mut voltages = Chart::new(Axis::new(texts.time, time), voltage);
    voltages.layers = voltage_layers(spec, voltages.y.span());
    [levels, voltages]
}

/// The runs with their pens, from the back to the front.
fn runs<'a>(spec: &Responses<'a>) -> impl Iterator<Item = (RunColumns<'a>, Pen, &'a str)> {
    let recorded = spec.recorded.map(|(run, name)| (run, Pen::Trail, name));
    let pinned = (0..).zip(&spec.pinned).map(|(place, &(run, name))| (run, Pen::Pinned(place), name));
    let linear = spec.linear.map(|run| (run, Pen::Dotted, spec.texts.linear));
    recorded.into_iter().chain(pinned).chain([(spec.nonlinear, Pen::Solid, "")]).chain(linear)
}

fn level_layers<'a>(spec: &Responses<'a>) -> Vec<Layer<'a>> {
    let line = |index: usize, pen, course, x: &'a [f64], y: &'a [f64], name| {
        let role = Role::of_loop(index);
        Layer::Line(Series { name, role, pen, course, x: x.into(), y: y.into(), y_scale: spec.level_scale })
    };
    let mut layers: Vec<_> = spec.steps.iter().map(|step| step.band(spec.level_scale)).collect();
    for (run, pen, which) in runs(spec) {
        if pen == Pen::Solid {
            for (index, reference) in spec.references.into_iter().enumerate() {
                let name = spec.texts.references[index].into();
                layers.push(line(index, Pen::Dashed, Course::Held, run.time_s, reference, name));
            }
        }
        for (index, level) in run.levels.into_iter().enumerate() {
            let name = qualified(spec.texts.levels[index], which, pen);
            layers.push(line(index, pen, Course::Straight, run.time_s, level, name));
        }
    }
    let RunColumns { time_s, levels, .. } = spec.nonlinear;
    let (scale, window) = (spec.level_scale, spec.window_s);
    layers.extend(spec.steps.iter().filter_map(|step| step.word(&spec.nonlinear, scale)));
    layers.extend(names(&Ends { x: time_s, y: levels, scale, names: spec.texts.levels, window }));
    layers
}

fn voltage_layers<'a>(spec: &Responses<'a>, (bottom, top): (f64, f64)) -> Vec<Layer<'a>> {
    let limits = [spec.voltage_limits.0, spec.voltage_limits.1];
    // At the edge of the plot a limit would only look like a smudge.
    let limits = limits.into_iter().filter(|&limit| bottom < limit && limit < top);
    let mut layers: Vec<_> = limits.map(|y| Layer::Level { y, role: Role::Muted, pen: Pen::Dashed }).collect();
    for (run, pen, which) in runs(spec) {
        for (index, voltage) in run.voltages.into_iter().enumerate() {
            layers.push(Layer::Line(Series {
                name: qualified(spec.texts.voltages[index], which, pen),
                role: Role::of_loop(index),
                pen,
                course: Course::Held,
                x: run.time_s.into(),
                y: voltage.into(),
                y_scale: 1.0,
            }));
        }
    }
    let RunColumns { time_s, voltages, .. } = spec.nonlinear;
    let window = spec.window_s;
    layers.extend(names(&Ends { x: time_s, y: voltages, scale: 1.0, names: spec.texts.voltages, window }));
    layers
}

/// The name of a curve, with the run in parentheses unless it is the main one; without a word for the run, none.
fn qualified<'a>(name: &'a str, which: &str, pen: Pen) -> Cow<'a, str> {
    match (pen, which) {
        (Pen::Solid, _) => name.into(),
        (_, "") => "".into(),
        _ => format!("{name} ({which})").into(),
    }
}

/// The runs that stretch a range but do not make it.
fn beside<'a>(spec: &Responses<'a>) -> impl Iterator<Item = RunColumns<'a>> {
    let others = spec.pinned.iter().chain(&spec.recorded);
    spec.linear.into_iter().chain(others.map(|&(run, _)| run))
}

/// Range of the levels (m).
fn level_range(spec: &Responses, time: (f64, f64)) -> (f64, f64) {
    let main = spec.nonlinear.levels.into_iter().chain(spec.references);
    let wall = spec.walls.into_iter().filter(|wall| wall.is_finite()).fold(0.0, f64::max);
    let beside = beside(spec).map(|run| (run.time_s, run.levels));
    range(time, spec.nonlinear.time_s, main, beside, (0.0, wall), MIN_SHARE * wall)
}

/// Range of the voltages (V).
fn voltage_range(spec: &Responses, time: (f64, f64)) -> (f64, f64) {
    let beside = beside(spec).map(|run| (run.time_s, run.voltages));
    let main = spec.nonlinear.voltages.into_iter();
    range(time, spec.nonlinear.time_s, main, beside, spec.voltage_limits, MIN_VOLTAGE)
}

fn legend(spec: &Responses) -> Vec<Entry> {
    let texts = &spec.texts;
    let entry = |pen, role, text: &str| Entry { sample: Sample::Line(pen), role, text: text.into() };
    // The levels have their names at their curves.
    let mut legend = vec![entry(Pen::Dashed, Role::Muted, texts.reference)];
    legend.extend(spec.linear.map(|_| entry(Pen::Dotted, Role::Muted, texts.linear)));
    legend.extend(spec.recorded.map(|(_, name)| entry(Pen::Trail, Role::Muted, name)));
    let pinned = (0..).zip(&spec.pinned);
    legend.extend(pinned.map(|(place, (_, name))| entry(Pen::Pinned(place), Role::Muted, name)));
    legend.retain(|entry| !entry.text.is_empty());
    legend
}
