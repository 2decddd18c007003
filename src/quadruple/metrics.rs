//! How the runs did, as a table.

use leptos::prelude::*;

use crate::lab::Lab;
use crate::shown::{length_digits, per_metre, to_shown, unit_name};
use crate::texts::tr;
use crate::widgets::html::{cells, element, escape, headings};
use quadtank::sim::{LoopMetrics, Settling};

/// A row of the table: its name, the class of its colour, its figures.
struct Row {
    name: String,
    class: &'static str,
    metrics: LoopMetrics,
}

/// Integrals below this, in the shown unit, are what rounding leaves of a run at rest.
const ROUNDING: f64 = 1e-7;

/// Metrics of the nonlinear run and of the pinned ones.
pub fn table(lab: Lab) -> String {
    let unit = unit_name(lab.unit.get());
    let columns = [
        tr!(lab, responses.run).to_owned(),
        tr!(lab, responses.rise).to_owned(),
        tr!(lab, responses.settling_2).to_owned(),
        tr!(lab, responses.settling_5).to_owned(),
        tr!(lab, responses.overshoot).to_owned(),
        tr!(lab, responses.undershoot).to_owned(),
        tr!(lab, responses.other, unit = unit),
        tr!(lab, responses.iae, unit = unit),
        tr!(lab, responses.ise, unit = unit),
        tr!(lab, responses.itae, unit = unit),
        tr!(lab, responses.variation).to_owned(),
        tr!(lab, responses.saturated).to_owned(),
    ];
    let caption = element("caption", "class=\"visually-hidden\"", &escape(tr!(lab, responses.metrics)));
    let rows: String = rows(lab).iter().map(|row| row_html(lab, row)).collect();
    caption + &element("thead", "", &headings(&columns)) + &element("tbody", "", &rows)
}

fn rows(lab: Lab) -> Vec<Row> {
    let class = |k: usize| ["loop1", "loop2"][k];
    let mut rows = Vec::new();
    lab.words.run.with(|outcome| {
        let Ok(run) = outcome.as_ref() else { return };
        for (k, &metrics) in run.metrics.iter().enumerate() {
            let name = tr!(lab, responses.row, number = k + 1).to_string();
            rows.push(Row { name, class: class(k), metrics });
        }
    });
    lab.words.pinned.with(|runs| {
        for (at, outcome) in runs.iter().enumerate() {
            let Ok(run) = outcome.as_ref() else { continue };
            for (k, &metrics) in run.metrics.iter().enumerate() {
                let name = tr!(lab, responses.row_pinned, run = at + 1, number = k + 1).to_string();
                rows.push(Row { name, class: class(k), metrics });
            }
        }
    });
    rows
}

fn row_html(lab: Lab, row: &Row) -> String {
    let style = lab.number_style();
    let unit = lab.unit.get();
    let m = row.metrics;
    let none = || "–".to_owned();
    let time = |t: Option<f64>| t.map_or_else(none, |t| style.significant(t, 3));
    let settling = |s: Option<Settling>| match s {
        None => none(),
        Some(Settling::Never) => tr!(lab, responses.never).to_string(),
        Some(Settling::After { time_s }) => style.significant(time_s, 3),
    };
    let percent = |share: Option<f64>| share.map_or_else(none, |s| format!("{}\u{a0}%", style.fixed(100.0 * s, 1)));
    // What rounding alone adds up to is nothing.
    let sum = |value: f64| style.significant(if value < ROUNDING { 0.0 } else { value }, 3);
    let figures = [
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
    ];
    let name = element("th", &format!("scope=\"row\" class=\"{}\"", row.class), &escape(&row.name));
    element("tr", "", &(name + &cells(&figures)))
}
