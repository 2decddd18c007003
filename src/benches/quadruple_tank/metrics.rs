//! How the runs did: figures of the first step and of each step within its window, and apart from them the costs of the whole run.

use leptos::prelude::*;

use super::session::{Session, use_session};
use crate::errors::of_no_response;
use crate::shown::{length_digits, per_metre, to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Figure, Figures, Folded, ReasonedRow, Row, TableContent};
use quadtank::sim::{LoopMetrics, NoResponse, ReferenceStepResponse, Settling, StepFigures};
use quadtank::study::quadruple_tank::Run;

/// Integrals below this, in the shown unit, are what rounding leaves of a run at rest.
const ROUNDING: f64 = 1e-7;
/// Decimals of the time of a step that is between two seconds.
const TIME_DECIMALS: usize = 2;

/// Figures of the step, costs, and what to know of both.
#[component]
pub fn MetricsTable() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let (of_step, of_run) = (say!(lab, responses.step_figures), say!(lab, responses.run_costs));
    view! {
        <h3>{of_step}</h3>
        <Figures name="metrics" caption=of_step>{move || step_table(session)}</Figures>
        <Folded
            id="each-step"
            summary=say!(lab, responses.each_step)
            caption=say!(lab, responses.each_step)
            content=move || each_step_table(session)
        />
        <h3>{of_run}</h3>
        <Figures name="costs" caption=of_run>{move || cost_table(session)}</Figures>
        <p class="remark" data-testid="metrics-note">{move || note(session)}</p>
    }
}

fn step_table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let columns = [tr!(lab, responses.run)].into_iter().chain(columns_of_step(session)).collect();
    let row = |name: String, k: usize, metrics: &LoopMetrics| {
        let figures = figures_of_step(session, k, &metrics.first_step());
        view! { <ReasonedRow class=["loop1", "loop2"][k] name figures /> }.into_any()
    };
    view! { <TableContent caption=tr!(lab, responses.step_figures) columns rows=rows(session, row) /> }
}

/// A row for each step of the references in the present run.
fn each_step_table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let unit = unit_name(session.own.unit.get());
    let of_step =
        [tr!(lab, responses.run), tr!(lab, responses.step_time), tr!(lab, responses.step_change, unit = unit)];
    let columns = of_step.into_iter().chain(columns_of_step(session)).collect();
    let steps = session
        .throttled
        .run
        .with(|outcome| outcome.as_ref().as_ref().map_or_else(|_| Vec::new(), |run| run.steps.clone()));
    let rows = steps.iter().map(|step| step_row(session, step)).collect();
    view! { <TableContent caption=tr!(lab, responses.each_step) columns rows /> }
}

fn step_row(session: Session, step: &ReferenceStepResponse) -> AnyView {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.own.unit.get();
    let level = |metres: f64| style.fixed(to_shown(metres, unit), length_digits(unit));
    let time = style.fixed(step.time_s, if step.time_s.fract() == 0.0 { 0 } else { TIME_DECIMALS });
    let change = format!("{} → {}", level(step.from), level(step.to));
    let mut figures = vec![Figure::Shown(time), Figure::Shown(change)];
    figures.extend(figures_of_step(session, step.level, &step.figures));
    let name = tr!(lab, responses.row, number = step.level + 1);
    view! { <ReasonedRow class=["loop1", "loop2"][step.level] name figures /> }.into_any()
}

fn columns_of_step(session: Session) -> [String; 8] {
    let lab = session.lab;
    let unit = unit_name(session.own.unit.get());
    [
        tr!(lab, responses.rise),
        tr!(lab, responses.settling_2),
        tr!(lab, responses.settling_5),
        tr!(lab, responses.overshoot),
        tr!(lab, responses.undershoot),
        tr!(lab, responses.other, unit = unit),
        tr!(lab, responses.iae, unit = unit),
        tr!(lab, responses.window),
    ]
}

fn cost_table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let unit = unit_name(session.own.unit.get());
    let columns = vec![
        tr!(lab, responses.run),
        tr!(lab, responses.iae, unit = unit),
        tr!(lab, responses.ise, unit = unit),
        tr!(lab, responses.itae, unit = unit),
        tr!(lab, responses.variation),
        tr!(lab, responses.saturated),
    ];
    let row = |name: String, k: usize, metrics: &LoopMetrics| {
        view! { <Row class=["loop1", "loop2"][k] name figures=costs_of_run(session, metrics) /> }.into_any()
    };
    view! { <TableContent caption=tr!(lab, responses.run_costs) columns rows=rows(session, row) /> }
}

/// A row for each loop of the run, then of the pinned ones.
fn rows(session: Session, row: impl Fn(String, usize, &LoopMetrics) -> AnyView) -> Vec<AnyView> {
    let lab = session.lab;
    let mut rows = Vec::new();
    let mut add = |run: &Run, name: &dyn Fn(usize) -> String| {
        rows.extend(run.metrics.iter().enumerate().map(|(k, metrics)| row(name(k + 1), k, metrics)));
    };
    session.throttled.run.with(|outcome| {
        if let Ok(run) = outcome.as_ref() {
            add(run, &|number| tr!(lab, responses.row, number = number));
        }
    });
    session.throttled.pinned.with(|runs| {
        for (at, pinned) in runs.iter().enumerate() {
            if let Ok(run) = pinned.result.as_ref() {
                add(run, &|number| tr!(lab, responses.row_pinned, run = at + 1, number = number));
            }
        }
    });
    rows
}

fn figures_of_step(session: Session, index: usize, m: &StepFigures) -> Vec<Figure> {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.own.unit.get();
    if let Some(reason) = m.no_response {
        return vec![Figure::None(why(session, index, reason)); 8];
    }
    let or_never = |text: Option<String>| Figure::Shown(text.unwrap_or_else(|| tr!(lab, responses.never)));
    let time = |time_s: f64| style.significant(time_s, 3);
    let settling = |settling: Option<Settling>| {
        or_never(match settling {
            Some(Settling::After { time_s }) => Some(time(time_s)),
            Some(Settling::Never) | None => None,
        })
    };
    let share =
        |share: Option<f64>| Figure::Shown(format!("{}\u{a0}%", style.fixed(100.0 * share.unwrap_or_default(), 1)));
    vec![
        or_never(m.rise_time_s.map(time)),
        settling(m.settling_2_percent),
        settling(m.settling_5_percent),
        share(m.overshoot),
        share(m.undershoot),
        Figure::Shown(style.fixed(to_shown(m.other_peak, unit), length_digits(unit))),
        Figure::Shown(sum(session, to_shown(m.window_iae.unwrap_or_default(), unit))),
        Figure::Shown(time(m.window_s.unwrap_or_default())),
    ]
}

fn costs_of_run(session: Session, m: &LoopMetrics) -> [String; 5] {
    let style = session.lab.number_style();
    let unit = session.own.unit.get();
    [
        sum(session, to_shown(m.iae, unit)),
        sum(session, m.ise * per_metre(unit).powi(2)),
        sum(session, to_shown(m.itae, unit)),
        style.fixed(m.total_variation, 2),
        style.fixed(m.saturated_s, 0),
    ]
}

/// What rounding alone adds up to is nothing.
fn sum(session: Session, value: f64) -> String {
    session.lab.number_style().significant(if value < ROUNDING { 0.0 } else { value }, 3)
}

/// Why a level (index) has no step-response figures.
pub fn why(session: Session, index: usize, reason: NoResponse) -> String {
    of_no_response(session.lab, session.own.unit.get(), index, reason)
}

/// What the runs in the tables are.
fn note(session: Session) -> String {
    let lab = session.lab;
    let mut parts = Vec::new();
    if session.throttled.run.with(|outcome| outcome.as_ref().as_ref().is_ok_and(|run| run.judged_without_noise)) {
        parts.push(tr!(lab, responses.without_noise));
    }
    let setup = session.throttled.setup.get();
    session.throttled.pinned.with(|runs| {
        if !runs.is_empty() {
            parts.push(tr!(lab, responses.pinned_same));
        }
        for (at, pinned) in runs.iter().enumerate() {
            if pinned.result.is_err() {
                parts.push(tr!(lab, responses.pinned_none, run = at + 1));
            } else if !pinned.setup.is_same_rig(&setup) {
                parts.push(tr!(lab, responses.pinned_other_rig, run = at + 1));
            }
        }
    });
    parts.join(" ")
}
