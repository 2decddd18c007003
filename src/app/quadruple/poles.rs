//! Poles and zeros in the s-plane.

use leptos::prelude::*;

use super::pictures;
use super::sentences::{self};
use crate::app::lab::{Lab, use_lab};
use crate::app::texts::{say, tr};
use crate::app::widgets::html::rich;
use crate::app::widgets::{ChartCanvas, ChartMenu};
use crate::figure::Frame;
use crate::linear::Complex;

/// Open-loop poles, transmission zeros with their path, and closed-loop poles.
#[component]
pub fn PolesAndZerosCard() -> impl IntoView {
    let lab = use_lab();
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::pole_zero(lab);
    let title = say!(lab, zeros.title);
    let summary = Signal::derive(move || summary(lab));
    view! {
        <section class="card zeros" aria-labelledby="zeros-title">
            <header>
                <h2 id="zeros-title">{title}</h2>
                <span class="remark">{say!(lab, zeros.remark)}</span>
                <ChartMenu picture=picture.clone() file="poles-and-zeros" title />
            </header>
            <div class="chart">
                <ChartCanvas picture frames summary name="pole-zero" />
            </div>
            <p class="sentence" data-testid="zeros-sentence" inner_html=Signal::derive(move || rich(&sentences::of_direction(lab)))></p>
        </section>
    }
}

fn summary(lab: Lab) -> String {
    let style = lab.number_style();
    let list = |numbers: &mut dyn Iterator<Item = Complex>| {
        let texts: Vec<String> = numbers
            .map(|z| {
                let real = style.significant(z.re, 3);
                if z.im.abs() > 1e-3 * z.norm() {
                    format!("{real} ± {}i", style.significant(z.im.abs(), 3))
                } else {
                    real
                }
            })
            .collect();
        if texts.is_empty() { "–".to_owned() } else { texts.join("; ") }
    };
    lab.words
        .with_analysis(|a| {
            tr!(
                lab,
                zeros.summary,
                poles = list(&mut a.poles.iter().copied()),
                zeros = list(&mut a.zeros.iter().flatten().map(|z| z.value)),
                closed = list(&mut a.closed_loop.poles_s.iter().copied().filter(|z| z.im >= 0.0))
            )
            .to_string()
        })
        .unwrap_or_default()
}
