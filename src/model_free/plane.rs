//! Where the valves stand at the shown moment, and what that makes of the zero, the relative gain and the pairing.

use leptos::prelude::*;

use super::pictures;
use super::sentences;
use super::session::Session;
use crate::texts::{say, tr};
use crate::widgets::{ChartCanvas, ChartMenu, card as card_of, first_frame, remark, sentence};
use quadtank_figure::Frame;

/// The plane of the valves with their way.
pub fn card(session: Session) -> AnyView {
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let title = say!(lab, valves.title);
    let over = Signal::derive(move || {
        let frame = first_frame(frames);
        let at = |valves: [f64; 2]| frame.to_px(valves.into());
        let points: Vec<String> =
            pictures::way(session).into_iter().map(at).map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let Some((x, y)) = session.shown().map(|shown| at(shown.plant.valves)) else { return String::new() };
        format!(
            "<polyline class=\"way\" points=\"{}\"/><circle class=\"dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\"/>",
            points.join(" ")
        )
    });
    let summary = Signal::derive(move || {
        let style = lab.number_style();
        let [one, two] = session.shown().map_or([f64::NAN; 2], |shown| shown.plant.valves);
        tr!(lab, valves.summary, gamma1 = style.fixed(one, 2), gamma2 = style.fixed(two, 2)).to_string()
    });
    let beside = view! { <ChartMenu picture=pictures::plane(session, true) file="free-valve-plane" title /> };
    let chart = view! {
        <div class="chart square">
            <ChartCanvas picture=pictures::plane(session, false) frames summary name="free-valve-plane" />
            <svg class="over handles" aria-hidden="true" data-testid="free-way" inner_html=over></svg>
        </div>
    };
    card_of("valve-way", title, vec![beside.into_any()], vec![chart.into_any()])
}

/// The s-plane of the moment with its numbers.
pub fn zeros(session: Session) -> AnyView {
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let title = say!(lab, zeros.title);
    let picture = pictures::zeros(session);
    let words = Signal::derive(move || sentences::of_moment(session));
    let summary = Signal::derive(move || words.get().replace("**", ""));
    let menu = view! { <ChartMenu picture=picture.clone() file="free-poles-and-zeros" title /> };
    let chart = view! {
        <div class="chart">
            <ChartCanvas picture frames summary name="free-pole-zero" />
        </div>
    };
    let beside = vec![remark(say!(lab, free.of_moment)), menu.into_any()];
    card_of("moment-zeros", title, beside, vec![chart.into_any(), sentence("free-moment", words)])
}
