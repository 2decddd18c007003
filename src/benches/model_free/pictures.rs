//! The charts of the bench, from the results of the session. Building them follows what they read.

use leptos::prelude::*;

use super::session::{Session, shown};
use crate::benches::quadruple_tank::name_of_boundary;
use crate::texts::tr;
use crate::widgets::Picture;
use quadtank::linear::Complex;
use quadtank::study::quadruple_tank::ValveMap;
use quadtank_figure::{
    self, Chart, ModelFreeCourse, ModelFreeTexts, PoleZero, PoleZeroTexts, ValvePlane, ValvePlaneTexts, with_valve_path,
};
use quadtank_scenario::model_free::{roots_to_csv, run_to_csv};
use quadtank_scenario::valve_map_to_csv;

/// Steps of each valve in the exported table of the plane.
const CSV_STEPS: u32 = 20;
/// How much of the path of the valves is drawn behind them (s), and the time between its points (s).
const TRAIL_S: f64 = 60.0;
const TRAIL_STEP_S: f64 = 0.25;

/// Levels, voltages and φ over time.
pub fn course(session: Session, window: Signal<(f64, f64)>) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let answer = session.charts.answer.get();
        let Ok(answer) = answer.as_ref() else { return show(&mut []) };
        let (run, phi) = (&answer.run.trajectory, &answer.run);
        let sample_time_s: Vec<f64> = run.time_s.iter().copied().step_by(phi.rows_per_sample).collect();
        let comparison =
            answer.comparison.as_ref().map(|(pi, _)| (&pi.time_s[..], [&pi.levels[0][..], &pi.levels[1][..]]));
        show(&mut quadtank_figure::model_free_course(&ModelFreeCourse {
            time_s: &run.time_s,
            levels: run.levels.each_ref().map(Vec::as_slice),
            references: run.references.each_ref().map(Vec::as_slice),
            voltages: run.pump_voltage.each_ref().map(Vec::as_slice),
            comparison,
            sample_time_s: &sample_time_s,
            estimates: phi.estimates.each_ref().map(Vec::as_slice),
            true_values: phi.true_values.each_ref().map(Vec::as_slice),
            window_s: window.get(),
            texts: ModelFreeTexts {
                axes: [
                    &tr!(lab, chart.time),
                    &tr!(lab, free.axis_lower),
                    &tr!(lab, free.axis_upper),
                    &tr!(lab, responses.pump_axis),
                    &tr!(lab, free.axis_phi),
                ],
                reference: &tr!(lab, responses.reference),
                comparison: &tr!(lab, free.with_pi),
                estimate: &tr!(lab, free.estimate),
                true_value: &tr!(lab, free.true_value),
            },
        }));
    };
    let csv = move || {
        let setup = session.charts.setup.get();
        session.charts.with_answer(|answer| run_to_csv(answer, &setup)).unwrap_or_default()
    };
    Picture::new(build, csv)
}

/// The map under the valve plane: at the voltages that hold the last references or, where there are none, in the middle of
/// what the pumps can do.
pub fn map(session: Session) -> ValveMap {
    let plant = session.charts.setup.get().plant_at(0.0);
    let voltage = session.charts.analysis.with(|a| a.rest.as_ref().ok().map(|rest| rest.pump_voltage));
    ValveMap::at(plant, voltage).without_setting()
}

/// The plane of the valves; `whole` with their path and where they stand, for files.
pub fn plane(session: Session, whole: bool) -> Picture {
    let lab = session.lab;
    let map = Memo::new(move |_| map(session));
    let csv = move || map.with(|map| valve_map_to_csv(map, CSV_STEPS));
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let map = map.get();
        let plane = quadtank_figure::valve_plane(&ValvePlane {
            right_most_zero: &|valves| map.rightmost_zero(valves),
            singular_sum: map.singular_sum(),
            published: &[],
            setting: shown(session).filter(|_| whole).map(|shown| shown.plant.valves),
            texts: ValvePlaneTexts {
                gamma_1: "γ₁",
                gamma_2: "γ₂",
                boundary: &name_of_boundary(lab, map.singular_sum()),
                minimum_phase: &tr!(lab, valves.minimum),
                right_half_plane: &tr!(lab, valves.right),
            },
        });
        show(&mut [if whole { with_valve_path(plane, &valve_path(session)) } else { plane }]);
    };
    Picture::new(build, csv)
}

/// γ1, γ2 up to the shown moment.
pub fn valve_path(session: Session) -> Vec<[f64; 2]> {
    let Some(end) = shown(session).map(|shown| shown.time_s) else { return Vec::new() };
    let from = (end - TRAIL_S).max(0.0);
    session.throttled.setup.with(|setup| {
        let times = (0u32..).map(|k| from + TRAIL_STEP_S * f64::from(k)).take_while(|&time| time < end);
        times.chain([end]).map(|time| setup.valves.map(|valve| valve.at(time))).collect()
    })
}

/// Poles and zeros as they are at the shown moment.
pub fn zeros(session: Session) -> Picture {
    let lab = session.lab;
    let csv = move || {
        shown(session).and_then(|shown| shown.theory.ok()).map(|plant| roots_to_csv(&plant)).unwrap_or_default()
    };
    let build = move |show: &mut dyn FnMut(&mut [Chart])| {
        let Some(Ok(plant)) = shown(session).map(|shown| shown.theory) else { return show(&mut []) };
        let zeros: Vec<Complex> = plant.zeros.iter().flatten().map(|zero| zero.value).collect();
        show(&mut [quadtank_figure::pole_zero(&PoleZero {
            poles: &plant.poles,
            zeros: &zeros,
            zero_paths: &[],
            closed_loop: &[],
            decimal: lab.number_style().decimal,
            texts: PoleZeroTexts {
                real: &tr!(lab, zeros.real),
                imaginary: &tr!(lab, zeros.imaginary),
                poles: &tr!(lab, zeros.pole),
                zeros: &tr!(lab, zeros.zero),
                closed_loop: "",
                beyond: &tr!(lab, zeros.beyond),
            },
        })]);
    };
    Picture::new(build, csv)
}
