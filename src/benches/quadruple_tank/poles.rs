//! Poles and zeros in the s-plane.

use leptos::prelude::*;

use super::experiment::FIRST_STEP_AT_S;
use super::flags::{locks, panels};
use super::session::{Session, use_session};
use super::{pictures, sentences};
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Sentence, Text};
use quadtank::linear::Complex;
use quadtank::sim::SetPointStep;
use quadtank::study::quadruple_tank::{Direction, ZeroEffect, direction_steps, fitted_duration_s};
use quadtank_figure::Frame;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::pole, terms::zero, terms::right_half_plane, terms::closed_loop, terms::direction];

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
        <Card name="zeros" panel=panels::ZEROS title terms=TERMS beside>
            <div class="chart">
                <ChartCanvas picture frames summary=Signal::derive(move || summary(session)) name="pole-zero" />
            </div>
            <Sentence id="zeros-sentence" text=Signal::derive(move || sentences::of_direction(session)) />
            <DirectionButtons />
        </Card>
    }
}

/// Where a zero limits both levels: steps along its direction, and across it. Not where steps are fixed.
#[component]
fn DirectionButtons() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_limited = move || {
        let zero = session.throttled.with_analysis(|a| a.linear.rightmost_zero().map(ZeroEffect::of)).flatten();
        matches!(zero, Some(ZeroEffect::Opposed | ZeroEffect::Together | ZeroEffect::OneLevel { .. }))
    };
    let button = move |id: &'static str, text: Signal<String>, direction: Direction| {
        view! {
            <button type="button" class="button small" data-testid=id on:click=move |_| try_direction(session, direction)>
                {text}
            </button>
        }
    };
    (!lab.locks(locks::EXPERIMENT)).then(|| {
        view! {
            // It keeps its place, so that the picture keeps its size.
            <div class=move || if is_limited() { "toolbar" } else { "toolbar unseen" }>
                {button("try-easy", say!(lab, zeros.try_easy), Direction::Easy)}
                {button("try-hard", say!(lab, zeros.try_hard), Direction::Hard)}
            </div>
        }
    })
}

/// How far the levels are asked to go in all when a direction is tried (m).
const TRIED: f64 = 0.02;

/// Asks both levels at once to go along a direction of the right-most zero, at the time of the first step there is.
fn try_direction(session: Session, direction: Direction) {
    let sizes = untrack(|| {
        session.charts.with_analysis(|a| a.linear.rightmost_zero().map(|zero| direction_steps(zero, direction, TRIED)))
    });
    let Some(sizes) = sizes.flatten() else { return };
    session.edit(|s| {
        let steps = &s.experiment.set_point_steps;
        let time_s = steps.iter().map(|step| step.time_s).reduce(f64::min).unwrap_or(FIRST_STEP_AT_S);
        let step = |level: usize| SetPointStep { level, time_s, size: sizes[level] };
        s.experiment.set_point_steps = vec![step(0), step(1)];
        s.experiment.duration_s = fitted_duration_s(s);
    });
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
            if a.closed_loop.has_dead_time {
                return tr!(
                    lab,
                    zeros.summary_delayed,
                    poles = list(&mut a.linear.poles.iter().copied()),
                    zeros = list(&mut a.linear.zeros.iter().flatten().map(|z| z.value))
                );
            }
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
