//! How the runs did, as a table.

use leptos::prelude::*;

use super::session::{Session, use_session};
use crate::shown::{length_digits, per_metre, to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Figures, Row, TableContent};
use quadtank::sim::{LoopMetrics, Settling};

/// Integrals below this, in the shown unit, are what rounding leaves of a run at rest.
const ROUNDING: f64 = 1e-7;

/// Metrics of the nonlinear run and of the pinned ones.
#[component]
pub fn MetricsTable() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! { <Figures name="metrics" caption=say!(lab, responses.metrics)>{move || content(session)}</Figures> }
}

fn content(session: Session) -> impl IntoView {
    let lab = session.lab;
    let unit = unit_name(session.own.unit.get());
    let columns = vec![
        tr!(lab, responses.run),
        tr!(lab, responses.rise),
        tr!(lab, responses.settling_2),
        tr!(lab, responses.settling_5),
        tr!(lab, responses.overshoot),
        tr!(lab, responses.undershoot),
        tr!(lab, responses.other, unit = unit),
        tr!(lab, responses.iae, unit = unit),
        tr!(lab, responses.ise, unit = unit),
        tr!(lab, responses.itae, unit = unit),
        tr!(lab, responses.variation),
        tr!(lab, responses.saturated),
    ];
    view! { <TableContent caption=tr!(lab, responses.metrics) columns rows=rows(session) /> }
}

fn rows(session: Session) -> Vec<AnyView> {
    let lab = session.lab;
    let mut rows = Vec::new();
    session.throttled.run.with(|outcome| {
        let Ok(run) = outcome.as_ref() else { return };
        for (k, metrics) in run.metrics.iter().enumerate() {
            let name = tr!(lab, responses.row, number = k + 1);
            rows.push(row(session, name, k, metrics));
        }
    });
    session.throttled.pinned.with(|runs| {
        for (at, pinned) in runs.iter().enumerate() {
            let Ok(run) = pinned.result.as_ref() else { continue };
            for (k, metrics) in run.metrics.iter().enumerate() {
                let name = tr!(lab, responses.row_pinned, run = at + 1, number = k + 1);
                rows.push(row(session, name, k, metrics));
            }
        }
    });
    rows
}

fn row(session: Session, name: String, index: usize, metrics: &LoopMetrics) -> AnyView {
    view! { <Row class=["loop1", "loop2"][index] name figures=figures(session, metrics) /> }.into_any()
}

fn figures(session: Session, m: &LoopMetrics) -> [String; 11] {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.own.unit.get();
    let none = || "–".to_owned();
    let time = |t: Option<f64>| t.map_or_else(none, |t| style.significant(t, 3));
    let settling = |s: Option<Settling>| match s {
        None => none(),
        Some(Settling::Never) => tr!(lab, responses.never),
        Some(Settling::After { time_s }) => style.significant(time_s, 3),
    };
    let percent = |share: Option<f64>| share.map_or_else(none, |s| format!("{}\u{a0}%", style.fixed(100.0 * s, 1)));
    // What rounding alone adds up to is nothing.
    let sum = |value: f64| style.significant(if value < ROUNDING { 0.0 } else { value }, 3);
    [
        time(m.rise_time_s),
        settling(m.settling_2_percent),
        settling(m.settling_5_percent),
        percent(m.overshoot),
        percent(m.undershoot),
        m.step_time_s.map_or_else(none, |_| style.fixed(to_shown(m.other_peak, unit), length_digits(unit))),
        sum(to_shown(m.iae, unit)),
        sum(m.ise * per_metre(unit).powi(2)),
        sum(to_shown(m.itae, unit)),
        style.fixed(m.total_variation, 2),
        style.fixed(m.saturated_s, 0),
    ]
}
