//! What is folded away: the plant at the ultimate frequency, and the controllers in other forms.

use leptos::prelude::*;

use super::placement::of_loop;
use super::session::{Session, use_session};
use crate::texts::{say, tr};
use crate::widgets::{Folded, Row, TableContent, marked};
use quadtank::linear::Complex;
use quadtank::study::relay_tuning::{ControllerForms, RecoveredResponse, Tested};

/// Further results of the relay test, folded away.
#[component]
pub fn TestDetails() -> impl IntoView {
    let session = use_session();
    let summary = say!(session.lab, relay.details);
    view! { <Folded id="test-details" summary caption=summary content=move || test_content(session) /> }
}

fn test_content(session: Session) -> AnyView {
    if let Some(verdict) = verdict_on_pair(session) {
        return view! { <caption>{marked(&verdict)}</caption> }.into_any();
    }
    let found = session.throttled.study.with(|study| {
        session.throttled.test.with(|test| match (study.as_ref(), test.as_ref()) {
            (Ok(study), Ok(Tested::Simultaneous(test, _))) => {
                test.reading.oscillation.and_then(|of| study.recover(&of).ok())
            }
            _ => None,
        })
    });
    match found {
        Some(found) => responses(session, &found).into_any(),
        None => view! { <caption>{tr!(session.lab, relay.details_none)}</caption> }.into_any(),
    }
}

/// Stability and margins of the closed loop with the settings of an independent or a sequential test; `None` for other tests.
fn verdict_on_pair(session: Session) -> Option<String> {
    let lab = session.lab;
    session.throttled.study.with(|study| {
        session.throttled.test.with(|test| {
            let (study, test) = (study.as_ref().as_ref().ok()?, test.as_ref().as_ref().ok()?);
            if !matches!(test, Tested::Independent(_) | Tested::Sequential(_)) {
                return None;
            }
            let Some(pair) = study.pair_of_test(test).ok()? else { return Some(tr!(lab, relay.pair_none)) };
            let (margins, peaks) = (study.margins(&pair).ok().flatten(), study.peaks(&pair).ok());
            let verdict = of_loop(lab, pair.stability, margins, peaks);
            Some(tr!(lab, relay.pair_verdict, verdict = verdict))
        })
    })
}

/// The four responses at the ultimate frequency, recovered and of the model (Campestrini 2006, eqs. 122 and 123).
fn responses(session: Session, found: &RecoveredResponse) -> impl IntoView + use<> {
    let lab = session.lab;
    let style = lab.number_style();
    let complex = |value: Complex| {
        let sign = if value.im < 0.0 { "−" } else { "+" };
        format!("{} {sign} {}j", style.significant(value.re, 4), style.significant(value.im.abs(), 4))
    };
    let columns = vec![tr!(lab, relay.details_response), tr!(lab, relay.details_found), tr!(lab, relay.details_exact)];
    let row = |(row, column): (usize, usize)| {
        let name = format!("g{}{}", ["₁", "₂"][row], ["₁", "₂"][column]);
        let figures = [complex(found.measured[(row, column)]), complex(found.exact[(row, column)])];
        view! { <Row name figures /> }.into_any()
    };
    let rows = [(0, 0), (1, 0), (0, 1), (1, 1)].map(row).into();
    view! { <TableContent caption=tr!(lab, relay.details) columns rows /> }
}

/// The controllers of both roots, or the given ones, in ISA and in series form (Campestrini 2006, eqs. 9 to 11).
#[component]
pub fn OtherForms() -> impl IntoView {
    let session = use_session();
    let summary = say!(session.lab, relay.forms);
    view! { <Folded id="gains-forms" summary caption=summary content=move || forms(session) /> }
}

fn forms(session: Session) -> impl IntoView {
    let lab = session.lab;
    let columns = [&*tr!(lab, relay.col_root), "K", "Ti", "Td", "K′", "Ti′", "Td′"].map(str::to_owned).to_vec();
    let rows = session.throttled.with_design(|design| {
        let mut rows = Vec::new();
        let is_alone = design.roots.len() == 1;
        for (k, root) in (1..).zip(&design.roots) {
            for (i, &forms) in root.forms.iter().enumerate() {
                let number = if is_alone { String::new() } else { format!("{k}, ") };
                let name = format!("{number}p{}", ["₁", "₂"][i]);
                let figures = figures_of_forms(session, forms);
                rows.push(view! { <Row class=["loop1", "loop2"][i] name figures /> }.into_any());
            }
        }
        rows
    });
    view! { <TableContent caption=tr!(lab, relay.forms) columns rows=rows.unwrap_or_default() /> }
}

/// K, Ti, Td of the ISA form, then of the series form.
fn figures_of_forms(session: Session, ControllerForms { isa, series }: ControllerForms) -> Vec<String> {
    let style = session.lab.number_style();
    let isa = isa.map(|isa| [isa.gain, isa.integral_time, isa.derivative_time]);
    let series = series.map(|series| [series.gain, series.integral_time, series.derivative_time]);
    let text = |value: Option<f64>| {
        value.filter(|value| value.is_finite()).map_or_else(|| "–".to_owned(), |value| style.significant(value, 4))
    };
    let numbers = [isa, series].map(|form| form.map_or([None; 3], |form| form.map(Some)));
    numbers.concat().into_iter().map(text).collect()
}
