//! The charts of the bench, from the results of the session. Building them follows what they read.

use leptos::prelude::*;
use quadtank::literature::andreis::PublishedMethod;
use quadtank::plant::level::{LevelPlant, SignalUnit};
use quadtank::study::level_loop::{ContourMap, Element, HeatedAnswer, LevelLoopAnswer, PiTuning, TradeOff};
use quadtank::tuning::{Evaluation, ProcessModel};
use quadtank_figure::{
    self, Axis, Chart, CostCell, CostMapChart, Course, Layer, LevelLoopCharts, LevelLoopTexts, LevelRunColumns,
    NamedPoint, Pen, Role, Series, Shape, StaticCurve, StepTestCharts, StepTestTexts, TradeOffChart,
};
use quadtank_scenario::level_loop::{cost_map_to_csv, run_to_csv, step_test_to_csv, trade_off_to_csv};

use super::exploration::{CELLS, Computed, Searched};
use super::session::{Session, shown};
use crate::lab::Lab;
use crate::texts::tr;
use crate::widgets::Picture;

/// Abbreviation of the unit of a signal.
pub const fn unit_of(unit: SignalUnit) -> &'static str {
    match unit {
        SignalUnit::Milliampere => "mA",
        SignalUnit::Psi => "psi",
    }
}

/// Unit of the controller output of a plant.
pub const fn output_unit(plant: &LevelPlant) -> &'static str {
    unit_of(plant.output.signal.unit)
}

/// Level, flows and controller output over time.
pub fn run(session: Session, window: Signal<(f64, f64)>) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let setup = session.charts.setup.get();
        let answer = session.charts.answer.get();
        let Ok(answer) = answer.as_ref() else { return show(&mut []) };
        let plant = setup.plant();
        let reference: Vec<f64> =
            answer.log.reference.iter().map(|&signal| plant.transmitter.level_of(signal)).collect();
        let pinned = session.charts.pinned.get();
        let pinned = pinned.iter().filter_map(|pinned| pinned.result.as_ref().as_ref().ok()).map(columns).collect();
        let unit = output_unit(&plant);
        let range = plant.output.signal;
        show(&mut quadtank_figure::level_loop(&LevelLoopCharts {
            run: columns(answer),
            reference: &reference,
            inflow: &answer.log.inflow,
            pinned,
            band: band(session),
            window_s: window.get(),
            output_range: [range.low, range.high],
            texts: LevelLoopTexts {
                axes: [&tr!(lab, chart.time), "h (cm)", "q (L/s)", &format!("m ({unit})")],
                level: &tr!(lab, level.level),
                reference: &tr!(lab, responses.reference),
                inflow: &tr!(lab, level.inflow),
                outflow: &tr!(lab, level.outflow),
                output: &tr!(lab, level.output),
                band: &tr!(lab, level.band),
            },
        }));
    };
    let csv = move || {
        let setup = session.charts.setup.get();
        session.charts.with_answer(|answer| run_to_csv(answer, &setup)).unwrap_or_default()
    };
    Picture::new(build, csv)
}

fn columns(answer: &LevelLoopAnswer) -> LevelRunColumns<'_> {
    let log = &answer.log;
    LevelRunColumns { time_s: &log.time_s, level: &log.level, outflow: &log.outflow, output: &log.output }
}

/// The band of averaging control (m).
fn band(session: Session) -> Option<[f64; 2]> {
    session.charts.setup.with(|setup| match setup.objective {
        quadtank::study::level_loop::Objective::Averaging { band } => Some(band),
        quadtank::study::level_loop::Objective::Tight => None,
    })
}

/// The step test with the model that was read from it.
pub fn test(session: Session) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let test = session.charts.test.get();
        let Ok(test) = test.as_ref() else { return show(&mut []) };
        let setup = session.charts.setup.get();
        let plant = setup.plant();
        let units = [unit_of(plant.transmitter.signal.unit), output_unit(&plant)];
        let mut marks = Vec::new();
        let style = lab.number_style();
        let shares = [0.283, 0.632].map(|share| (share, format!("{}\u{a0}%", style.fixed(100.0 * share, 1))));
        if let Ok(fit) = &test.fit {
            for (time, (share, name)) in fit.times_s.iter().flatten().zip(&shares) {
                let signal = fit.ends[0] + share * (fit.ends[1] - fit.ends[0]);
                marks.push(((setup.test.step_time_s + time, signal), name.as_str()));
            }
        }
        show(&mut quadtank_figure::step_test(&StepTestCharts {
            time_s: &test.log.time_s,
            measured: &test.log.transmitted,
            fitted: test.fitted.as_deref(),
            output: &test.log.output,
            marks,
            texts: StepTestTexts {
                axes: [&tr!(lab, chart.time), &format!("y ({})", units[0]), &format!("m ({})", units[1])],
                measured: &tr!(lab, level.measured),
                fitted: &tr!(lab, level.fitted),
            },
        }));
    };
    let csv = move || session.charts.test.with(|test| test.as_ref().as_ref().map(step_test_to_csv).unwrap_or_default());
    Picture::new(build, csv)
}

/// A point of the trade-off that can be taken up.
#[derive(Clone, PartialEq)]
pub struct TradeOffEntry {
    /// Its place among the known tunings.
    pub place: usize,
    /// Its short name.
    pub name: String,
    /// The tuning.
    pub tuning: PiTuning,
    /// Variances of outflow and level.
    pub at: (f64, f64),
}

/// The variance of the level against that of the outflow, with the known tunings.
pub fn trade_off(session: Session, found: Memo<TradeOff>, entries: Memo<Vec<TradeOffEntry>>) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        found.with(|found| {
            let (outflow, level): (Vec<f64>, Vec<f64>) =
                found.curve.iter().map(|point| (point.outflow, point.level)).unzip();
            let present =
                session.charts.with_answer(|answer| (answer.figures.outflow.variance, answer.figures.level.variance));
            let entries = entries.get();
            let points = entries.iter().map(|entry| NamedPoint {
                name: &entry.name,
                at: entry.at,
                role: Role::Neutral,
                shape: Shape::Point,
            });
            show(&mut [quadtank_figure::trade_off(&TradeOffChart {
                curve: (&outflow, &level),
                points: points.collect(),
                present,
                axes: [&tr!(lab, level.axis_variance_outflow), &tr!(lab, level.axis_variance_level)],
            })]);
        });
    };
    Picture::new(build, move || found.with(trade_off_to_csv))
}

/// The cost over gain and integral time, with the way of the last search.
pub fn cost_map(
    session: Session,
    map: Memo<Option<Shown<ContourMap>>>,
    search: Memo<Option<Shown<Searched>>>,
) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let setup = session.charts.setup.get();
        let [gains, times] = setup.search.axes().map(|axis| (axis.low, axis.high));
        let (size, cells): ([usize; 2], Vec<CostCell>) = map.with(|map| match map {
            Some(Shown(map)) => {
                (map.value.size(), map.value.cells().iter().map(|evaluation| cell(evaluation.as_ref())).collect())
            }
            None => ([CELLS; 2], vec![CostCell::Pending; CELLS * CELLS]),
        });
        let way = tr!(lab, level.way);
        let (mut paths, mut population) = (Vec::new(), Vec::new());
        search.with(|search| {
            let Some(Shown(search)) = search else { return };
            let point = |[gain, time]: [f64; 2]| (gain, time);
            paths.push((&way[..], search.value.search.path().iter().map(|at| point(at.point)).collect()));
            population = search.value.search.population().into_iter().map(point).collect();
        });
        show(&mut [quadtank_figure::cost_map(&CostMapChart {
            gains,
            times_s: times,
            size,
            cells: &cells,
            paths,
            population,
            points: Vec::new(),
            present: setup.pi_tuning().map(|tuning| (tuning.gain, tuning.integral_time_s)),
            axes: [&tr!(lab, level.axis_gain), &tr!(lab, level.axis_time)],
        })]);
    };
    let csv = move || map.with(|map| map.as_ref().map(|map| cost_map_to_csv(&map.0.value)).unwrap_or_default());
    Picture::new(build, csv)
}

/// Something computed in slices, compared by how far it is.
#[derive(Clone)]
pub struct Shown<T>(pub Computed<T>);

impl<T> PartialEq for Shown<T> {
    fn eq(&self, other: &Self) -> bool {
        self.0.took_ms == other.0.took_ms && std::sync::Arc::ptr_eq(&self.0.setup, &other.0.setup)
    }
}

fn cell(evaluation: Option<&Evaluation>) -> CostCell {
    match evaluation {
        None => CostCell::Pending,
        Some(Evaluation::Cost(cost)) => CostCell::Cost(*cost),
        Some(Evaluation::Violates(_)) => CostCell::Violates,
        Some(Evaluation::NoRun(_)) => CostCell::None,
    }
}

/// The static curve of an element at the shown moment.
pub fn element(session: Session) -> Picture {
    let lab = session.lab;
    let curve = move || {
        let element = session.own.element.get()?;
        let (_, plant, signals) = shown(session)?;
        Some((element, element.curve(&plant, &signals)?, plant))
    };
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let Some((element, curve, plant)) = curve() else { return show(&mut []) };
        let axes = element_axes(lab, element, &plant);
        let scale = element_scale(element);
        let scaled = |column: &[f64], by: f64| -> Vec<f64> { column.iter().map(|value| by * value).collect() };
        let (x, y) = (scaled(&curve.input, scale.0), scaled(&curve.output, scale.1));
        show(&mut [quadtank_figure::static_curve(&StaticCurve {
            x: &x,
            y: &y,
            at: Some((scale.0 * curve.at.0, scale.1 * curve.at.1)),
            axes: [&axes[0], &axes[1]],
        })]);
    };
    let csv = move || {
        let Some((element, curve, plant)) = curve() else { return String::new() };
        let axes = element_axes(lab, element, &plant);
        let scale = element_scale(element);
        let rows = curve.input.iter().zip(&curve.output).map(|(x, y)| format!("{},{}\n", scale.0 * x, scale.1 * y));
        format!("{},{}\n", axes[0], axes[1]) + &rows.collect::<String>()
    };
    Picture::new(build, csv)
}

/// Shown units in those of the curve: cm for m, L/s for m³/s.
const fn element_scale(element: Element) -> (f64, f64) {
    match element {
        Element::Transmitter => (100.0, 1.0),
        Element::Outlet => (100.0, 1000.0),
        Element::Converter | Element::Actuator | Element::Valve => (1.0, 1.0),
    }
}

fn element_axes(lab: Lab, element: Element, plant: &LevelPlant) -> [String; 2] {
    let output = output_unit(plant);
    let pressure = plant.converter.map_or(output, |converter| unit_of(converter.output.unit));
    match element {
        Element::Transmitter => {
            let unit = unit_of(plant.transmitter.signal.unit);
            [tr!(lab, level.axis_level), tr!(lab, level.axis_measured, unit = unit)]
        }
        Element::Converter => {
            [tr!(lab, level.axis_output, unit = output), tr!(lab, level.axis_pressure, unit = pressure)]
        }
        Element::Actuator => [tr!(lab, level.axis_pressure, unit = pressure), tr!(lab, level.axis_travel)],
        Element::Valve => [tr!(lab, level.axis_travel), tr!(lab, level.axis_opening)],
        Element::Outlet => [tr!(lab, level.axis_level), tr!(lab, level.axis_outflow)],
    }
}

/// Level and temperature of the heated tank, in steps and exact.
pub fn heated(lab: Lab, found: Memo<Option<HeatedAnswer>>) -> Picture {
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        found.with(|found| {
            let Some(found) = found else { return show(&mut []) };
            let hours: Vec<f64> = found.run.time_s.iter().map(|time| time / 3600.0).collect();
            let line = |name: String, role, pen, y: &[f64]| {
                Layer::Line(Series {
                    name: name.into(),
                    role,
                    pen,
                    course: Course::Straight,
                    x: hours.clone().into(),
                    y: y.to_vec().into(),
                    y_scale: 1.0,
                })
            };
            let chart = |label: String, y: &[f64]| {
                let ends = |pick: fn(f64, f64) -> f64| y.iter().copied().filter(|y| y.is_finite()).reduce(pick);
                let range = (ends(f64::min).unwrap_or(0.0), ends(f64::max).unwrap_or(1.0));
                Chart::new(Axis::new(tr!(lab, level.axis_hours), (0.0, 10.0)), Axis::rounded(label, range, 5))
            };
            let mut level = chart(tr!(lab, level.axis_level_m), &found.run.level);
            level.layers = vec![
                line(tr!(lab, level.exact), Role::Neutral, Pen::Dotted, &found.exact_level),
                line(tr!(lab, level.by_steps), Role::Loop1, Pen::Solid, &found.run.level),
            ];
            level.x.numbered = false;
            let mut temperature = chart(tr!(lab, level.axis_temperature), &found.run.temperature);
            temperature.layers =
                vec![line(tr!(lab, level.temperature), Role::Loop2, Pen::Solid, &found.run.temperature)];
            show(&mut [level, temperature]);
        });
    };
    let csv = move || {
        found.with(|found| {
            let Some(found) = found else { return String::new() };
            let run = &found.run;
            let rows = (0..run.time_s.len()).map(|row| {
                let (time, level, exact) = (run.time_s[row], run.level[row], found.exact_level[row]);
                format!("{time},{level},{exact},{}\n", run.temperature[row])
            });
            "time_s,level_m,exact_level_m,temperature_k\n".to_owned() + &rows.collect::<String>()
        })
    };
    Picture::new(build, csv)
}

/// The short name of a published way of tuning.
pub fn method_name(lab: Lab, method: PublishedMethod) -> String {
    match method {
        PublishedMethod::Current => tr!(lab, level.method_current),
        PublishedMethod::Gradient => tr!(lab, level.method_gradient),
        PublishedMethod::Genetic => tr!(lab, level.method_genetic),
        PublishedMethod::Skogestad => "SIMC".to_owned(),
        PublishedMethod::Lambda => "Lambda".to_owned(),
    }
}

/// A process model as a transfer function in one line.
pub fn model_text(lab: Lab, model: &ProcessModel) -> String {
    let style = lab.number_style();
    let number = |value: f64| style.significant(value, 3);
    match *model {
        ProcessModel::SelfRegulating { gain, time_constant_s, dead_time_s } => {
            tr!(lab, level.model_self, gain = number(gain), time = number(time_constant_s), dead = number(dead_time_s))
        }
        ProcessModel::Integrating { slope, dead_time_s } => {
            tr!(lab, level.model_integrating, slope = number(slope), dead = number(dead_time_s))
        }
    }
}
