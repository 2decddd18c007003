//! Result of a fit: estimates with standard errors, warnings on parameters that cannot be told apart, and a button to apply them.

use leptos::prelude::*;
use quadtank_record::{Estimate, FitReport, Parameter};

use super::fit_view::Found;
use super::flags::locks;
use super::session::Session;
use crate::lab::Lab;
use crate::shown::{to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Cells, Figures, Folded, TableContent};

/// The estimates, and a button that applies them to the rig.
pub fn result(session: Session, found: &Found) -> impl IntoView + use<> {
    let lab = session.lab;
    let (report, rig) = (found.fit.report(), found.before.plant());
    let first = found.fit.levels_before();
    let rows = {
        let report = report.clone();
        move || {
            let row = |estimate: &Estimate| {
                let before = value(session, estimate.parameter, estimate.parameter.of(&rig, &first));
                let bound =
                    if estimate.is_at_bound { format!(" ({})", tr!(lab, record.fit_bound)) } else { String::new() };
                let after = format!("{}{bound}", value(session, estimate.parameter, estimate.value));
                let error = estimate
                    .standard_error
                    .map_or_else(|| "–".to_owned(), |error| value(session, estimate.parameter, error));
                let texts = vec![before, after, error];
                view! { <tr><th scope="row">{name(lab, estimate.parameter)}</th><Cells texts /></tr> }.into_any()
            };
            report.estimates.iter().map(row).collect::<Vec<_>>()
        }
    };
    let heads = move || {
        vec![
            tr!(lab, record.fit_parameter),
            tr!(lab, record.fit_before),
            tr!(lab, record.fit_after),
            tr!(lab, record.fit_error),
        ]
    };
    let correlation = {
        let report = report.clone();
        move || correlation(lab, &report)
    };
    let is_known = report.correlation.is_some() && report.estimates.len() > 1;
    let told = Signal::derive(move || told(session, &report));
    let fit = found.fit.clone();
    let taken = RwSignal::new(false);
    let take = move |_| {
        session.edit(|present| *present = fit.setup(present));
        taken.set(true);
    };
    view! {
        <p role="status" data-testid="fit-told">{told}</p>
        <Figures name="fit-table" caption=say!(lab, record.fit_title)>
            {move || view! { <TableContent caption=tr!(lab, record.fit_title) columns=heads() rows=rows() /> }}
        </Figures>
        <p class="remark">{say!(lab, record.fit_error_hint)}</p>
        {is_known.then(|| view! {
            <Folded id="fit-correlation" summary=say!(lab, record.fit_correlation) caption=say!(lab, record.fit_correlation) content=correlation>
                <p class="remark">{say!(lab, record.fit_correlation_hint)}</p>
            </Folded>
        })}
        <p class="links">
            <button type="button" class="button small strong" data-testid="fit-take" disabled=lab.locks(locks::PRESET) on:click=take>{say!(lab, record.fit_take)}</button>
            <span class="remark" role="status">{move || taken.get().then(|| tr!(lab, record.fit_taken))}</span>
        </p>
    }
}

/// The correlation of each pair of estimates.
fn correlation(lab: Lab, report: &FitReport) -> impl IntoView + use<> {
    let names: Vec<String> = report.estimates.iter().map(|estimate| name(lab, estimate.parameter)).collect();
    let row = |(name, coefficients): (&String, &Vec<f64>)| {
        let texts = coefficients.iter().map(|&r| lab.number_style().fixed(r, 2)).collect::<Vec<_>>();
        view! { <tr><th scope="row">{name.clone()}</th><Cells texts /></tr> }.into_any()
    };
    let rows = names.iter().zip(report.correlation.iter().flatten()).map(row).collect::<Vec<_>>();
    let columns = std::iter::once(tr!(lab, record.fit_parameter)).chain(names).collect::<Vec<_>>();
    view! { <TableContent caption=tr!(lab, record.fit_correlation) columns rows /> }
}

/// Improvement of the simulation, and parameters that the record cannot tell apart.
fn told(session: Session, report: &FitReport) -> String {
    let lab = session.lab;
    let [before, after] = report.rmse.map(|rmse| length(session, rmse));
    let name_of = |index: usize| name(lab, report.estimates[index].parameter);
    let mut parts = vec![tr!(lab, record.fit_done, values = report.values, before = before, after = after)];
    parts.extend((!report.converged).then(|| tr!(lab, record.fit_unfinished)));
    if report.correlation.is_none() {
        parts.push(tr!(lab, record.fit_singular));
    } else {
        parts.extend(
            report
                .alike
                .iter()
                .map(|&[one, other]| tr!(lab, record.fit_alike, one = name_of(one), other = name_of(other))),
        );
        let vague: Vec<String> = report.vague.iter().map(|&index| name_of(index)).collect();
        parts.extend((!vague.is_empty()).then(|| tr!(lab, record.fit_vague, names = vague.join(", "))));
    }
    parts.join(" ")
}

/// A length as the page shows it.
pub fn length(session: Session, metres: f64) -> String {
    let unit = session.own.unit.get();
    format!("{}\u{a0}{}", session.lab.number_style().significant(to_shown(metres, unit), 3), unit_name(unit))
}

/// A value of a parameter as the page shows it: flows in cm³/s, areas in cm².
pub fn value(session: Session, parameter: Parameter, value: f64) -> String {
    let style = session.lab.number_style();
    match parameter {
        Parameter::Valve(_) => style.significant(value, 3),
        Parameter::PumpGain(_) => format!("{}\u{a0}cm³/(s\u{a0}V)", style.significant(1e6 * value, 4)),
        Parameter::OutletArea(_) => format!("{}\u{a0}cm²", style.significant(1e4 * value, 4)),
        Parameter::LevelOffset(_) | Parameter::StartLevel(_) => length(session, value),
        Parameter::PumpDelay(_) => format!("{}\u{a0}s", style.significant(value, 3)),
    }
}

/// Name of a parameter on the page.
pub fn name(lab: Lab, parameter: Parameter) -> String {
    match parameter {
        Parameter::Valve(index) => tr!(lab, record.p_gamma, number = index + 1),
        Parameter::PumpGain(index) => tr!(lab, record.p_k, number = index + 1),
        Parameter::OutletArea(index) => tr!(lab, record.p_a, number = index + 1),
        Parameter::LevelOffset(index) => tr!(lab, record.p_offset, number = index + 1),
        Parameter::PumpDelay(index) => tr!(lab, record.p_delay, number = index + 1),
        Parameter::StartLevel(index) => tr!(lab, record.p_start, number = index + 1),
    }
}
