//! Poles and zeros in the s-plane.

use leptos::prelude::*;

use super::session::{Session, use_session};
use super::{pictures, sentences};
use crate::texts::{say, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Sentence};
use quadtank::linear::Complex;
use quadtank_figure::Frame;

/// Open-loop poles, transmission zeros with their path, and closed-loop poles.
#[component]
pub fn PolesAndZerosCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::pole_zero(session);
    let title = say!(lab, zeros.title);
    let for_menu = picture.clone();
    let beside = move || {
        view! {
            <span class="remark">{say!(lab, zeros.remark)}</span>
            <ChartMenu picture=for_menu file="poles-and-zeros" title />
        }
    };
    view! {
        <Card name="zeros" title beside>
            <div class="chart">
                <ChartCanvas picture frames summary=Signal::derive(move || summary(session)) name="pole-zero" />
            </div>
            <Sentence id="zeros-sentence" text=Signal::derive(move || sentences::of_direction(session)) />
        </Card>
    }
}

fn summary(session: Session) -> String {
    let lab = session.lab;
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
    session
        .throttled
        .with_analysis(|a| {
            tr!(
                lab,
                zeros.summary,
                poles = list(&mut a.linear.poles.iter().copied()),
                zeros = list(&mut a.linear.zeros.iter().flatten().map(|z| z.value)),
                closed = list(&mut a.closed_loop.poles_s.iter().copied().filter(|z| z.im >= 0.0))
            )
        })
        .unwrap_or_default()
}
