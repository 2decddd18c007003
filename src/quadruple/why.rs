//! What no controller can do: the interpolation constraint of a zero in the right half-plane.

use leptos::prelude::*;

use super::sentences::{ZeroSituation, situation};
use crate::lab::{Lab, use_lab};
use crate::shown::{to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{card, sentence};

/// ∫ ηᵀe(t) e^(−zt) dt = ηᵀr/z for every stabilising controller.
pub fn why_card() -> AnyView {
    let lab = use_lab();
    let text = Signal::derive(move || match situation(lab) {
        Some(ZeroSituation::Right(z)) => tr!(lab, why.right, zero = lab.number_style().significant(z, 3)).to_string(),
        Some(ZeroSituation::Left(_) | ZeroSituation::Uncoupled) => tr!(lab, why.left).to_string(),
        Some(ZeroSituation::Origin) => tr!(lab, why.origin).to_string(),
        Some(ZeroSituation::Degenerate) => tr!(lab, why.degenerate).to_string(),
        Some(ZeroSituation::NoFinite) | None => tr!(lab, why.none).to_string(),
    });
    let formula = Signal::derive(move || formula(lab).unwrap_or_default());
    let no_formula = Signal::derive(move || formula.with(String::is_empty));
    let content = vec![
        sentence("why", text),
        view! { <div class="formula" hidden=no_formula inner_html=formula></div> }.into_any(),
    ];
    card("why", say!(lab, why.title), Vec::new(), content)
}

fn formula(lab: Lab) -> Option<String> {
    // At the origin rounding decides on which side the zero lies: there is nothing to divide by.
    if !matches!(situation(lab), Some(ZeroSituation::Right(_))) {
        return None;
    }
    let experiment = lab.words.setup.with(|s| s.experiment.clone());
    let integral = lab.words.with_analysis(|a| a.interpolation_integral(&experiment)).flatten()?;
    let unit = lab.unit.get();
    let value = lab.number_style().significant(to_shown(integral, unit), 3);
    let unit = unit_name(unit);
    Some(format!(
        "<math><msubsup><mo>∫</mo><mn>0</mn><mi>∞</mi></msubsup><msup><mi>η</mi><mi>T</mi></msup><mi>e</mi>\
         <mo stretchy=\"false\">(</mo><mi>t</mi><mo stretchy=\"false\">)</mo>\
         <msup><mi>e</mi><mrow><mo>−</mo><mi>z</mi><mi>t</mi></mrow></msup><mi>d</mi><mi>t</mi><mo>=</mo>\
         <mfrac><mrow><msup><mi>η</mi><mi>T</mi></msup><mi>r</mi></mrow><mi>z</mi></mfrac></math>\
         <math><mo>=</mo><mn>{value}</mn><mtext>\u{a0}{unit}\u{a0}s</mtext></math>"
    ))
}
