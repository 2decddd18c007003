//! Poles and zeros in the s-plane.

use leptos::prelude::*;

use super::{pictures, sentences};
use crate::lab::{Lab, use_lab};
use crate::texts::{say, tr};
use crate::widgets::{ChartCanvas, ChartMenu, card, remark, sentence};
use quadtank::linear::Complex;
use quadtank_figure::Frame;

/// Open-loop poles, transmission zeros with their path, and closed-loop poles.
pub fn poles_and_zeros_card() -> AnyView {
    let lab = use_lab();
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::pole_zero(lab);
    let title = say!(lab, zeros.title);
    let summary = Signal::derive(move || summary(lab));
    let beside = vec![
        remark(say!(lab, zeros.remark)),
        view! { <ChartMenu picture=picture.clone() file="poles-and-zeros" title /> }.into_any(),
    ];
    let content = vec![
        view! { <div class="chart"><ChartCanvas picture frames summary name="pole-zero" /></div> }.into_any(),
        sentence("zeros-sentence", Signal::derive(move || sentences::of_direction(lab))),
    ];
    card("zeros", title, beside, content)
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
