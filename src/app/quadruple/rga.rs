//! The relative gain array, the pairing it suggests, and the formula with the live numbers.

use leptos::prelude::*;

use crate::app::lab::{Lab, use_lab};
use crate::app::texts::{say, tr};
use crate::app::widgets::rich;
use crate::interaction::{PairingReason, PairingVerdict};
use crate::scenario::Analysis;

/// The relative gain array.
#[component]
pub fn RelativeGainCard() -> impl IntoView {
    let lab = use_lab();
    let verdict = move || lab.words.with_analysis(|a| a.verdict);
    let warm = move || matches!(verdict(), Some(PairingVerdict::None(_)) | None);
    view! {
        <section class="card rga" aria-labelledby="rga-title">
            <header>
                <h2 id="rga-title">{say!(lab, rga.title)}</h2>
                <span class="remark">{say!(lab, rga.remark)}</span>
            </header>
            <Gains />
            <Formula />
            <div class=move || if warm() { "verdict warm" } else { "verdict" }.to_owned() role="status" data-testid="rga-verdict">
                <p>{move || rich(&verdict().map_or_else(|| tr!(lab, process.no_equilibrium).to_string(), |v| of_verdict(lab, v)))}</p>
            </div>
            <p class="remark" data-testid="niederlinski">{move || of_niederlinski(lab)}</p>
        </section>
    }
}

/// Λ as a table; rows and columns sum to 1, so one number makes it.
#[component]
fn Gains() -> impl IntoView {
    let lab = use_lab();
    let rga = move || lab.words.with_analysis(Analysis::rga).flatten();
    let chosen = move |row: usize, column: usize| match lab.words.with_analysis(|a| a.verdict) {
        Some(PairingVerdict::Diagonal(_)) => row == column,
        Some(PairingVerdict::Swapped(_)) => row != column,
        _ => false,
    };
    let cell = move |row: usize, column: usize| {
        let gain = move || rga().map(|gains| gains[row][column]);
        let class = move || {
            let sign = if gain().is_some_and(|g| g > 0.0) { "positive" } else { "negative" };
            if chosen(row, column) { format!("{sign} chosen") } else { sign.to_owned() }
        };
        let text = move || gain().map_or_else(|| "∞".to_owned(), |g| lab.number_style().fixed(g, 2));
        let note = move || {
            chosen(row, column)
                .then(|| view! { <span class="visually-hidden">{format!(" ({})", tr!(lab, rga.suggested))}</span> })
        };
        view! { <td class=class><span data-testid=format!("lambda-{}{}", row + 1, column + 1)>{text}</span>{note}</td> }
    };
    let heading = move |column: usize| view! { <th scope="col">{say!(lab, rga.pump, number = column + 1)}</th> };
    let row = move |row: usize| {
        view! {
            <tr>
                <th scope="row">{say!(lab, rga.level, number = row + 1)}</th>
                {cell(row, 0)}
                {cell(row, 1)}
            </tr>
        }
    };
    view! {
        <table class="gains">
            <caption class="visually-hidden">{say!(lab, rga.table)}</caption>
            <thead><tr><td></td>{heading(0)}{heading(1)}</tr></thead>
            <tbody>{row(0)}{row(1)}</tbody>
        </table>
    }
}

/// λ11 = γ1γ2/(γ1+γ2−1) with the numbers in it (Cocota 2009, eq. 4.10).
#[component]
fn Formula() -> impl IntoView {
    let lab = use_lab();
    let number = move |v: f64| lab.number_style().fixed(v, 2);
    let value = move || lab.words.with_analysis(|a| a.rga_11.ok()).flatten().map_or_else(|| "∞".to_owned(), number);
    let formula = move || {
        let [g1, g2] = lab.words.setup.with(|s| s.valves);
        let (first, second, below, value) = (number(g1), number(g2), number(g1 + g2 - 1.0), value());
        let gamma = |k: u8| format!("<msub><mi>γ</mi><mn>{k}</mn></msub>");
        let (one, two) = (gamma(1), gamma(2));
        format!(
            "<math><msub><mi>λ</mi><mn>11</mn></msub><mo>=</mo>\
             <mfrac><mrow>{one}{two}</mrow><mrow>{one}<mo>+</mo>{two}<mo>−</mo><mn>1</mn></mrow></mfrac><mo>=</mo>\
             <mfrac><mrow><mn>{first}</mn><mo>·</mo><mn>{second}</mn></mrow><mn>{below}</mn></mfrac><mo>=</mo>\
             <mn data-testid=\"lambda\">{value}</mn></math>"
        )
    };
    view! { <div class="formula" inner_html=formula></div> }
}

fn of_verdict(lab: Lab, verdict: PairingVerdict) -> String {
    let style = lab.number_style();
    if let PairingVerdict::None(PairingReason::EqualRelativeGains) = verdict {
        return tr!(lab, rga.equal).to_owned();
    }
    let (lead, reason) = match verdict {
        PairingVerdict::Diagonal(reason) => (tr!(lab, rga.diagonal), reason),
        PairingVerdict::Swapped(reason) => (tr!(lab, rga.swapped), reason),
        PairingVerdict::None(reason) => (tr!(lab, rga.none), reason),
    };
    let rest = match reason {
        PairingReason::OnlyPositiveRelativeGain { relative_gain } => {
            tr!(lab, rga.only_positive, other = style.fixed(1.0 - relative_gain, 2)).to_string()
        }
        PairingReason::RelativeGainCloserToOne { relative_gain } => {
            tr!(lab, rga.closer, gain = style.fixed(relative_gain, 2)).to_string()
        }
        PairingReason::EqualRelativeGains => String::new(),
        PairingReason::SingularGain => tr!(lab, rga.singular).to_string(),
    };
    format!("{lead}{rest}")
}

fn of_niederlinski(lab: Lab) -> String {
    let number = |index: Option<f64>| index.map_or_else(|| "–".to_owned(), |n| lab.number_style().fixed(n, 2));
    lab.words
        .with_analysis(|a| {
            let [diagonal, swapped] = a.niederlinski.map(number);
            tr!(lab, rga.niederlinski, diagonal = diagonal, swapped = swapped).to_string()
        })
        .unwrap_or_default()
}
