//! The charts of the home bench, from the results of the laboratory. Building them follows what they read.

use super::frequency::Curves;
use super::record::OpenRecord;
use super::session::Session;
use crate::lab::Lab;
use crate::shown::{per_metre, unit_name};
use crate::texts::tr;
use crate::widgets::Picture;
use quadtank::linear::Complex;
use quadtank::sim::{EventKind, Settling};
use quadtank::study::quadruple_tank::{Run, ValveMap};
use quadtank_figure::{
    self, Chart, ClosedLoopGains, Flag, FrequencyCharts, FrequencyTexts, JudgedStep, Levels, PoleZero, PoleZeroTexts,
    Residuals, ResponseTexts, Responses, Role, RunColumns, ValvePlane, ValvePlaneTexts,
};
use quadtank_record::Record;
use quadtank_scenario::{Scenario, frequency_to_csv, roots_to_csv, run_to_csv, valve_map_to_csv};

use leptos::prelude::*;

/// The curves of a pinned run that there is not.
const NOTHING: RunColumns = RunColumns { time_s: &[], levels: [&[]; 2], voltages: [&[]; 2] };

/// Least range of the chart of levels (m).
const MIN_LEVELS: f64 = 0.02;
/// Points on the paths of the zeros.
const PATH_POINTS: usize = 61;
/// Steps of each valve in the exported table of the plane.
const CSV_STEPS: u32 = 20;

/// The valve plane. On the screen it does not depend on the valves themselves, so that dragging the point does not repaint it; a
/// `whole` one, for files and paper, has the point.
pub fn valve_plane(session: Session, whole: bool) -> Picture {
    let lab = session.lab;
    valve_plane_with(session, whole, move || [tr!(lab, valves.minimum), tr!(lab, valves.right)])
}

/// The same as a map: its sides are named by what they are like to control.
pub fn valve_map(session: Session, whole: bool) -> Picture {
    let lab = session.lab;
    valve_plane_with(session, whole, move || [tr!(lab, explore.easy_side), tr!(lab, explore.hard_side)])
}

fn valve_plane_with(session: Session, whole: bool, sides: impl Fn() -> [String; 2] + Send + Sync + 'static) -> Picture {
    let lab = session.lab;
    let map = Memo::new(move |_| session.document.with(|s| ValveMap::of(&s.setup).ok().map(ValveMap::without_setting)));
    let csv = move || map.get().map(|m| valve_map_to_csv(&m, CSV_STEPS)).unwrap_or_default();
    let build = move |visit: &mut dyn FnMut(&mut [Chart])| {
        let Some(map) = map.get() else { return };
        let [minimum_phase, right_half_plane] = &sides();
        let singular_sum = map.singular_sum();
        let boundary = &name_of_boundary(lab, singular_sum);
        let texts = ValvePlaneTexts { gamma_1: "γ₁", gamma_2: "γ₂", boundary, minimum_phase, right_half_plane };
        visit(&mut [quadtank_figure::valve_plane(&ValvePlane {
            right_most_zero: &|valves| map.rightmost_zero(valves),
            singular_sum,
            published: &[],
            setting: whole.then(|| session.document.with(|s| s.setup.valves)),
            texts,
        })]);
    };
    Picture::new(build, csv)
}

/// Name of the line in the valve plane on which the right-most zero is at the origin, by the sum γ1 + γ2 there.
pub fn name_of_boundary(lab: Lab, singular_sum: f64) -> String {
    let sum = if singular_sum == 1.0 { "1".to_owned() } else { lab.number_style().fixed(singular_sum, 2) };
    format!("γ₁ + γ₂ = {sum}")
}

/// Poles and zeros.
pub fn pole_zero(session: Session) -> Picture {
    let lab = session.lab;
    let csv = move || session.charts.with_analysis(roots_to_csv).unwrap_or_default();
    let build = move |visit: &mut dyn FnMut(&mut [Chart])| {
        let map = session.charts.setup.with_untracked(|setup| ValveMap::of(setup));
        let zero_paths = map.map(|m| m.zero_paths(PATH_POINTS)).unwrap_or_default();
        session.charts.with_analysis(|a| {
            let zeros: Vec<Complex> = a.linear.zeros.iter().flatten().map(|z| z.value).collect();
            visit(&mut [quadtank_figure::pole_zero(&PoleZero {
                poles: &a.linear.poles,
                zeros: &zeros,
                zero_paths: &zero_paths,
                closed_loop: &a.closed_loop.poles_s,
                decimal: lab.number_style().decimal,
                texts: PoleZeroTexts {
                    real: &tr!(lab, zeros.real),
                    imaginary: &tr!(lab, zeros.imaginary),
                    poles: &tr!(lab, zeros.pole),
                    zeros: &tr!(lab, zeros.zero),
                    closed_loop: &tr!(lab, zeros.closed),
                    beyond: &tr!(lab, zeros.beyond),
                },
            })]);
        });
    };
    Picture::new(build, csv)
}

/// Singular values over frequency.
pub fn over_frequency(session: Session, curves: Curves) -> Picture {
    let lab = session.lab;
    let csv = move || curves.with(|curves| curves.as_ref().map(frequency_to_csv).unwrap_or_default());
    let build = move |visit: &mut dyn FnMut(&mut [Chart])| {
        curves.with(|curves| {
            let Some(curves) = curves else { return };
            let style = lab.number_style();
            let peak = curves.closed.as_ref().map(|closed| format!("Ms = {}", style.significant(closed.peak.value, 3)));
            visit(&mut quadtank_figure::over_frequency(&FrequencyCharts {
                frequencies: &curves.frequencies,
                plant: columns(&curves.plant),
                closed: curves.closed.as_ref().map(|closed| ClosedLoopGains {
                    sensitivity: columns(&closed.sensitivity),
                    complementary: columns(&closed.complementary),
                    peak: (closed.peak.frequency, closed.peak.value),
                    bandwidth: closed.bandwidth,
                }),
                zero: curves.zero,
                texts: FrequencyTexts {
                    frequency: &tr!(lab, frequency.axis),
                    plant: &tr!(lab, frequency.plant),
                    closed: &tr!(lab, frequency.closed),
                    largest: &tr!(lab, frequency.largest),
                    smallest: &tr!(lab, frequency.smallest),
                    peak: peak.as_deref().unwrap_or_default(),
                    bandwidth: "ωB",
                    zero: "z",
                },
            }));
        });
    };
    Picture::new(build, csv)
}

fn columns(both: &[Vec<f64>; 2]) -> [&[f64]; 2] {
    both.each_ref().map(Vec::as_slice)
}

/// Levels alone, as far as a replay has come.
pub fn levels(session: Session) -> Picture {
    let lab = session.lab;
    let csv = move || session.charts.run.with(|run| run.as_ref().as_ref().map(run_to_csv).unwrap_or_default());
    let build = move |visit: &mut dyn FnMut(&mut [Chart])| {
        let run = session.charts.run.get();
        let Ok(run) = run.as_ref() else { return };
        let unit = session.own.unit.get();
        let names = [1, 2].map(|k| tr!(lab, responses.level, number = k));
        let references = [1, 2].map(|k| format!("{} {k}", tr!(lab, responses.reference)));
        let flags = flags(lab, run);
        visit(&mut [quadtank_figure::levels(&Levels {
            run: RunColumns::of(&run.nonlinear),
            references: [&run.nonlinear.references[0], &run.nonlinear.references[1]],
            until_s: session.own.playback.get(),
            flags: &flags,
            level_scale: per_metre(unit),
            least_range: MIN_LEVELS,
            time: &tr!(lab, chart.time),
            level: &tr!(lab, responses.level_axis, unit = unit_name(unit)),
            names: [&names[0], &names[1]],
            reference_names: [&references[0], &references[1]],
        })]);
    };
    Picture::new(build, csv)
}

/// Most events that have a flag: more would hide the curves.
const MAX_FLAGS: usize = 4;

/// What the response charts show of a record.
fn columns_of(record: &Record) -> RunColumns<'_> {
    let Record { time_s, levels: [level_1, level_2, ..], pump_voltage, .. } = record;
    RunColumns { time_s, levels: [level_1, level_2], voltages: pump_voltage.each_ref().map(Vec::as_slice) }
}

/// When levels settled, tanks ran over or dry, and pumps came to a limit.
fn flags(lab: Lab, run: &Run) -> Vec<Flag> {
    let settled = run.metrics.iter().enumerate().filter_map(|(k, m)| {
        let (None, Some(step_s), Some(Settling::After { time_s })) =
            (m.no_response, m.step_time_s, m.settling_2_percent)
        else {
            return None;
        };
        let text = tr!(lab, explore.settled, time = lab.number_style().significant(time_s, 2));
        Some(Flag { time_s: step_s + time_s, text, role: Role::of_loop(k) })
    });
    let events = run.nonlinear.events.iter().take(MAX_FLAGS).map(|event| {
        let text = match event.kind {
            EventKind::Overflow { tank } => tr!(lab, chart.flag_overflow, tank = tank + 1),
            EventKind::Empty { tank } => tr!(lab, chart.flag_empty, tank = tank + 1),
            EventKind::Saturated { pump } => tr!(lab, chart.flag_saturated, pump = pump + 1),
        };
        Flag { time_s: event.time_s, text, role: Role::RightHalfPlane }
    });
    settled.chain(events).collect()
}

/// An overshoot as a share of its step, in words.
fn overshoot(lab: Lab, share: f64) -> String {
    tr!(lab, chart.flag_overshoot, percent = lab.number_style().significant(100.0 * share, 2))
}

/// What the simulation leaves of the levels of the record that is open.
pub fn residuals(session: Session) -> Picture {
    let lab = session.lab;
    let build = move |visit: &mut dyn FnMut(&mut [Chart])| {
        let (opened, run) = (session.own.record.get(), session.throttled.run.get());
        let (Some(record), Ok(run)) = (opened.as_ref().and_then(OpenRecord::record), run.as_ref()) else { return };
        let [level_1, level_2] = quadtank_record::residuals(record, &run.nonlinear);
        let unit = session.own.unit.get();
        let names = [1, 2].map(|k| tr!(lab, responses.level, number = k));
        visit(&mut [quadtank_figure::residuals(&Residuals {
            time_s: &record.time_s,
            levels: [&level_1, &level_2],
            level_scale: per_metre(unit),
            time: &tr!(lab, chart.time),
            residual: &tr!(lab, record.residual_axis, unit = unit_name(unit)),
            names: [&names[0], &names[1]],
        })]);
    };
    Picture::new(build, String::new)
}

/// Levels and pump voltages.
pub fn responses(session: Session) -> Picture {
    let lab = session.lab;
    let window = Memo::new(move |_| session.document.with(Scenario::shown_time_s));
    let hide_linear = Memo::new(move |_| session.document.with(|s| s.view.hide_linear));
    let csv = move || session.charts.run.with(|run| run.as_ref().as_ref().map(run_to_csv).unwrap_or_default());
    let build = move |visit: &mut dyn FnMut(&mut [Chart])| {
        let (run, pinned) = (session.charts.run.get(), session.charts.pinned.get());
        let Ok(run) = run.as_ref() else { return };
        let unit = session.own.unit.get();
        let level = tr!(lab, responses.level_axis, unit = unit_name(unit));
        let number = |text: &dyn Fn(usize) -> String| [text(1), text(2)];
        let levels = number(&|k| tr!(lab, responses.level, number = k));
        let pumps = number(&|k| tr!(lab, responses.pump, number = k));
        let references = [1, 2].map(|k| format!("{} {k}", tr!(lab, responses.reference)));
        let plant = session.charts.setup.with_untracked(|setup| setup.plant());
        let [pump_1, pump_2] = plant.pumps;
        let names: Vec<String> = (1..=pinned.len()).map(|run| tr!(lab, pins.name, number = run)).collect();
        // One that has no run leaves its dashes to no other.
        let pinned = pinned.iter().zip(&names).map(|(pinned, name)| {
            let columns = pinned.result.as_ref().as_ref().map_or(NOTHING, |run| RunColumns::of(&run.nonlinear));
            (columns, name.as_str())
        });
        let opened = session.own.record.get();
        let (record, measured) = (opened.as_ref().and_then(OpenRecord::record), tr!(lab, record.curve));
        visit(&mut quadtank_figure::responses(&Responses {
            recorded: record.map(|record| (columns_of(record), measured.as_str())),
            nonlinear: RunColumns::of(&run.nonlinear),
            references: [&run.nonlinear.references[0], &run.nonlinear.references[1]],
            linear: (!hide_linear.get()).then(|| RunColumns::of(&run.linear)),
            pinned: pinned.collect(),
            flags: &flags(lab, run),
            steps: &JudgedStep::all(&run.steps, |share| overshoot(lab, share)),
            level_scale: per_metre(unit),
            walls: [plant.tanks[0].height, plant.tanks[1].height],
            voltage_limits: (pump_1.voltage_min.min(pump_2.voltage_min), pump_1.voltage_max.max(pump_2.voltage_max)),
            window_s: window.get(),
            texts: ResponseTexts {
                time: &tr!(lab, chart.time),
                level: &level,
                voltage: &tr!(lab, responses.pump_axis),
                levels: [&levels[0], &levels[1]],
                references: [&references[0], &references[1]],
                voltages: [&pumps[0], &pumps[1]],
                reference: &tr!(lab, responses.reference),
                linear: &tr!(lab, responses.linear),
            },
        }));
    };
    Picture::new(build, csv)
}
