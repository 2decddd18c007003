//! What no controller can do: the interpolation constraint of a zero in the right half-plane.

use leptos::prelude::*;

use super::flags::panels;
use super::sentences::situation;
use super::session::{Session, use_session};
use crate::shown::{to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Card, Sentence};
use quadtank::study::quadruple_tank::ZeroSituation;

/// ∫ ηᵀe(t) e^(−zt) dt = ηᵀr/z for every stabilising controller.
#[component]
pub fn WhyCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let text = Signal::derive(move || match situation(session) {
        Some(ZeroSituation::Right(z)) => tr!(lab, why.right, zero = lab.number_style().significant(z, 3)),
        Some(ZeroSituation::Left(_) | ZeroSituation::Uncoupled) => tr!(lab, why.left),
        Some(ZeroSituation::Origin) => tr!(lab, why.origin),
        Some(ZeroSituation::Degenerate) => tr!(lab, why.degenerate),
        Some(ZeroSituation::NoFinite) | None => tr!(lab, why.none),
    });
    let integral = Memo::new(move |_| integral(session));
    view! {
        <Card name="why" panel=panels::WHY title=say!(lab, why.title)>
            <Sentence id="why" text />
            <div class="formula" hidden=move || integral.get().is_none()>{move || integral.get().map(formula)}</div>
        </Card>
    }
}

/// ηᵀr/z with its unit; nothing where no zero limits the loop.
fn integral(session: Session) -> Option<(String, String)> {
    let lab = session.lab;
    // At the origin rounding decides on which side the zero lies: there is nothing to divide by.
    if !matches!(situation(session), Some(ZeroSituation::Right(_))) {
        return None;
    }
    let experiment = session.throttled.setup.with(|s| s.experiment.clone());
    let integral = session.throttled.with_analysis(|a| a.interpolation_integral(&experiment)).flatten()?;
    let unit = session.own.unit.get();
    let value = lab.number_style().significant(to_shown(integral, unit), 3);
    Some((value, format!("\u{a0}{}\u{a0}s", unit_name(unit))))
}

fn formula((value, unit): (String, String)) -> impl IntoView {
    view! {
        <math>
            <msubsup><mo>"∫"</mo><mn>"0"</mn><mi>"∞"</mi></msubsup>
            <msup><mi>"η"</mi><mi>"T"</mi></msup>
            <mi>"e"</mi>
            <mo stretchy="false">"("</mo><mi>"t"</mi><mo stretchy="false">")"</mo>
            <msup><mi>"e"</mi><mrow><mo>"−"</mo><mi>"z"</mi><mi>"t"</mi></mrow></msup>
            <mi>"d"</mi><mi>"t"</mi>
            <mo>"="</mo>
            <msup><mi>"η"</mi><mi>"T"</mi></msup><mi>"r"</mi><mo>"/"</mo><mi>"z"</mi>
        </math>
        <math><mo>"="</mo><mn>{value}</mn><mtext>{unit}</mtext></math>
    }
}
