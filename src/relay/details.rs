//! What is folded away: the plant at the ultimate frequency, and the controllers in other forms.

use leptos::prelude::*;

use super::session::Session;
use crate::texts::{say, tr};
use crate::widgets::{folded, html};
use quadtank::control::{IsaPid, ParallelPid, SeriesPid};
use quadtank::linear::Complex;
use quadtank::tuning::{Oscillation, TuningError};
use quadtank_scenario::tuning::{Study, Tested};

/// What the test tells besides.
pub fn of_test(session: Session) -> AnyView {
    let lab = session.lab;
    let summary = say!(lab, relay.details);
    folded(
        "test-details",
        summary,
        summary,
        Box::new(move || {
            let found = session.words.study.with(|study| {
                session.words.test.with(|test| match (study.as_ref(), test.as_ref()) {
                    (Ok(study), Ok(Tested::Simultaneous(test, _))) => {
                        test.reading.oscillation.and_then(|of| responses(session, study, &of).ok())
                    }
                    _ => None,
                })
            });
            found.unwrap_or_else(|| html::element("caption", "", &html::escape(tr!(lab, relay.details_none))))
        }),
    )
}

/// The four responses at the ultimate frequency, recovered and of the model (Campestrini 2006, eqs. 122 and 123).
fn responses(session: Session, study: &Study, oscillation: &Oscillation) -> Result<String, TuningError> {
    let lab = session.lab;
    let style = lab.number_style();
    let found = study.recover(oscillation)?;
    let complex = |value: Complex| {
        let sign = if value.im < 0.0 { "−" } else { "+" };
        format!("{} {sign} {}j", style.significant(value.re, 4), style.significant(value.im.abs(), 4))
    };
    let names = [
        tr!(lab, relay.details_response).to_owned(),
        tr!(lab, relay.details_found).to_owned(),
        tr!(lab, relay.details_exact).to_owned(),
    ];
    let row = |(row, column): (usize, usize)| {
        let name = format!("g{}{}", ["₁", "₂"][row], ["₁", "₂"][column]);
        html::row("", &name, &[complex(found.measured[(row, column)]), complex(found.exact[(row, column)])])
    };
    let rows: String = [(0, 0), (1, 0), (0, 1), (1, 1)].map(row).concat();
    Ok(html::table(tr!(lab, relay.details), &names, &rows))
}

/// The controllers of both roots in ISA and in series form (Campestrini 2006, eqs. 9 to 11).
pub fn of_controllers(session: Session) -> AnyView {
    let lab = session.lab;
    let summary = say!(lab, relay.forms);
    folded(
        "gains-forms",
        summary,
        summary,
        Box::new(move || {
            let names = [tr!(lab, relay.col_root), "K", "Ti", "Td", "K′", "Ti′", "Td′"].map(str::to_owned);
            let rows = session.words.with_design(|design| {
                let of_root = |(k, controllers): (usize, [ParallelPid; 2])| {
                    let of_loop =
                        |(i, pid)| forms(session, &format!("{k}, p{}", ["₁", "₂"][i]), ["loop1", "loop2"][i], pid);
                    controllers.into_iter().enumerate().map(of_loop).collect::<String>()
                };
                [1, 2]
                    .into_iter()
                    .zip(design.roots.each_ref().map(|root| root.controllers))
                    .map(of_root)
                    .collect::<String>()
            });
            html::table(tr!(lab, relay.forms), &names, &rows.unwrap_or_default())
        }),
    )
}

fn forms(session: Session, name: &str, class: &str, pid: ParallelPid) -> String {
    let style = session.lab.number_style();
    let isa = IsaPid::from_parallel(pid);
    let series = isa.and_then(SeriesPid::from_isa);
    let isa = isa.map(|isa| [isa.gain, isa.integral_time, isa.derivative_time]);
    let series = series.map(|series| [series.gain, series.integral_time, series.derivative_time]);
    let text = |value: Option<f64>| {
        value.filter(|value| value.is_finite()).map_or_else(|| "–".to_owned(), |value| style.significant(value, 4))
    };
    let numbers = [isa, series].map(|form| form.map_or([None; 3], |form| form.map(Some)));
    html::row(class, name, &numbers.concat().into_iter().map(text).collect::<Vec<_>>())
}
