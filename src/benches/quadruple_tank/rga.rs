//! The relative gain array, the pairing it suggests, and the formula with the live numbers.

use leptos::prelude::*;

use super::flags::panels;
use super::sentences;
use super::session::{Session, use_session};
use crate::texts::{say, terms, tr};
use crate::widgets::{Caption, Card, Text, Verdict, marked};
use quadtank::interaction::{PairingReason, PairingVerdict};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::relative_gain, terms::pairing, terms::niederlinski];

/// The relative gain array.
#[component]
pub fn RelativeGainCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let found = move || session.throttled.with_analysis(|a| a.linear.verdict);
    let text = move || found().map_or_else(|| tr!(lab, process.no_equilibrium), |v| of_verdict(session, v));
    let warm = Signal::derive(move || matches!(found(), Some(PairingVerdict::None(_)) | None));
    let about = move || view! { <span class="remark">{say!(lab, rga.remark)}</span> };
    view! {
        <Card name="rga" panel=panels::RGA title=say!(lab, rga.title) terms=TERMS beside=about>
            <table class="gains">{move || gains(session)}</table>
            <div class="formula">{move || formula(session)}</div>
            <Verdict id="rga-verdict" warm><p>{move || marked(&text())}</p></Verdict>
            <p class="remark" data-testid="niederlinski">{move || of_niederlinski(session)}</p>
        </Card>
    }
}

/// Λ as a table; rows and columns sum to 1, so one number makes it.
fn gains(session: Session) -> impl IntoView {
    let lab = session.lab;
    let pump = |column: usize| view! { <th scope="col">{tr!(lab, rga.pump, number = column + 1)}</th> };
    let row = |row: usize| {
        view! {
            <tr>
                <th scope="row">{tr!(lab, rga.level, number = row + 1)}</th>
                {gain(session, row, 0)}
                {gain(session, row, 1)}
            </tr>
        }
    };
    view! {
        <Caption text=tr!(lab, rga.table) />
        <thead><tr><td></td>{pump(0)}{pump(1)}</tr></thead>
        <tbody>{row(0)}{row(1)}</tbody>
    }
}

/// One relative gain; of the suggested pairing it is marked.
fn gain(session: Session, row: usize, column: usize) -> impl IntoView {
    let lab = session.lab;
    let gain = session.throttled.with_analysis(|a| a.linear.rga()).flatten().map(|gains| gains[row][column]);
    let chosen = match session.throttled.with_analysis(|a| a.linear.verdict) {
        Some(PairingVerdict::Diagonal(_)) => row == column,
        Some(PairingVerdict::Swapped(_)) => row != column,
        _ => false,
    };
    let sign = if gain.is_some_and(|g| g > 0.0) { "positive" } else { "negative" };
    let text = gain.map_or_else(|| unbounded(session), |g| lab.number_style().at_least(g, 2));
    let note = chosen.then(|| format!(" ({})", tr!(lab, rga.suggested)));
    view! {
        <td class=if chosen { format!("{sign} chosen") } else { sign.to_owned() }>
            <span data-testid=format!("lambda-{}{}", row + 1, column + 1)>{text}</span>
            {note.map(|note| view! { <span class="visually-hidden">{note}</span> })}
        </td>
    }
}

/// A relative gain that there is not: beyond all bounds, or 0/0 where the plant is singular at every frequency.
fn unbounded(session: Session) -> String {
    let is_degenerate = session.throttled.with_analysis(|a| a.linear.zeros.is_err()) == Some(true);
    if is_degenerate { "–" } else { "∞" }.to_owned()
}

/// λ11 = γ1γ2/(γ1+γ2−1) with the numbers in it (Cocota 2009, eq. 4.10), of incremental fractions where they depend on the flow.
fn formula(session: Session) -> impl IntoView {
    let lab = session.lab;
    let number = |v: f64| lab.number_style().at_least(v, 2);
    let value =
        session.throttled.with_analysis(|a| a.linear.rga_11.ok()).flatten().map_or_else(|| unbounded(session), number);
    let ([g1, g2], depends_on_flow) = sentences::valves_of_model(session);
    let [first, second] = [g1, g2].map(|gamma| lab.number_style().fixed(gamma, 2));
    let below = number(g1 + g2 - 1.0);
    let symbol = if depends_on_flow { "γ̃" } else { "γ" };
    let gamma = |k: &'static str| view! { <msub><mi>{symbol}</mi><mn>{k}</mn></msub> };
    let by_valves = || {
        view! {
            <mo>"="</mo>
            <mfrac>
                <mrow>{gamma("1")}{gamma("2")}</mrow>
                <mrow>{gamma("1")}<mo>"+"</mo>{gamma("2")}<mo>"−"</mo><mn>"1"</mn></mrow>
            </mfrac>
            <mo>"="</mo>
            <mfrac>
                <mrow><mn>{first}</mn><mo>"·"</mo><mn>{second}</mn></mrow>
                <mn>{below}</mn>
            </mfrac>
        }
    };
    let is_by_valves = session.throttled.setup.with(|s| s.has_relative_gain_of_valves());
    view! {
        <math>
            <msub><mi>"λ"</mi><mn>"11"</mn></msub>
            {is_by_valves.then(by_valves)}
        </math>
        // By itself, so that the line can break before it in a narrow card.
        " "
        <math><mo>"="</mo><mn data-testid="lambda">{value}</mn></math>
    }
}

fn of_verdict(session: Session, verdict: PairingVerdict) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    if let PairingVerdict::None(PairingReason::EqualRelativeGains) = verdict {
        return tr!(lab, rga.equal);
    }
    let (lead, reason) = match verdict {
        PairingVerdict::Diagonal(reason) => (tr!(lab, rga.diagonal), reason),
        PairingVerdict::Swapped(reason) => (tr!(lab, rga.swapped), reason),
        PairingVerdict::None(reason) => (tr!(lab, rga.none), reason),
    };
    let rest = match reason {
        PairingReason::OnlyPositiveRelativeGain { relative_gain } => {
            tr!(lab, rga.only_positive, other = style.at_least(1.0 - relative_gain, 2))
        }
        PairingReason::RelativeGainCloserToOne { relative_gain } => {
            tr!(lab, rga.closer, gain = style.fixed(relative_gain, 2))
        }
        PairingReason::EqualRelativeGains => String::new(),
        PairingReason::SingularGain => tr!(lab, rga.singular),
    };
    let is_large = session.throttled.with_analysis(|a| a.linear.has_large_relative_gains()) == Some(true);
    format!("{lead}{rest}{}", if is_large { tr!(lab, rga.large) } else { String::new() })
}

fn of_niederlinski(session: Session) -> String {
    let lab = session.lab;
    let number = |index: Option<f64>| index.map_or_else(|| "–".to_owned(), |n| lab.number_style().at_least(n, 2));
    session
        .throttled
        .with_analysis(|a| {
            let [diagonal, swapped] = a.linear.niederlinski.map(number);
            tr!(lab, rga.niederlinski, diagonal = diagonal, swapped = swapped)
        })
        .unwrap_or_default()
}
