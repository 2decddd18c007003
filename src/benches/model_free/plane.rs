//! Where the valves stand at the shown moment, and what that makes of the zero, the relative gain and the pairing.

use leptos::prelude::*;

use super::flags::panels;
use super::pictures;
use super::sentences;
use super::session::{Session, shown, use_session};
use crate::benches::quadruple_tank::name_of_boundary;
use crate::texts::{say, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Sentence, first_frame, unmarked};
use quadtank_figure::Frame;

/// The plane of the valves with their path.
#[component]
pub fn ValvePlaneCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let title = say!(lab, valves.title);
    let summary = Signal::derive(move || {
        let style = lab.number_style();
        let [one, two] = shown(session).map_or([f64::NAN; 2], |shown| shown.plant.valves);
        let line = name_of_boundary(lab, pictures::map(session).singular_sum());
        tr!(lab, valves.summary, line = line, gamma1 = style.fixed(one, 2), gamma2 = style.fixed(two, 2))
    });
    let beside = move || view! { <ChartMenu picture=pictures::plane(session, true) file="free-valve-plane" title /> };
    view! {
        <Card name="valve-way" panel=panels::VALVES title beside>
            <div class="chart square">
                <ChartCanvas picture=pictures::plane(session, false) on_paper=pictures::plane(session, true) frames summary name="free-valve-plane" />
                <svg class="over handles" aria-hidden="true" data-testid="free-way">{move || valve_path(session, frames)}</svg>
            </div>
        </Card>
    }
}

/// The path of the valves, and where they stand.
fn valve_path(session: Session, frames: RwSignal<Vec<Frame>>) -> Option<impl IntoView> {
    let frame = first_frame(frames);
    let at = |valves: [f64; 2]| frame.to_px(valves.into());
    let (x, y) = at(shown(session)?.plant.valves);
    let points = pictures::valve_path(session).into_iter().map(at).map(|(x, y)| format!("{x:.1},{y:.1}"));
    let points = points.collect::<Vec<_>>().join(" ");
    Some(view! {
        <polyline class="way" points=points />
        <circle class="dot" cx=format!("{x:.1}") cy=format!("{y:.1}") r="6" />
    })
}

/// The s-plane of the moment with its numbers.
#[component]
pub fn ZerosCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let title = say!(lab, zeros.title);
    let picture = pictures::zeros(session);
    let for_menu = picture.clone();
    let words = Signal::derive(move || sentences::of_moment(session));
    let beside = move || {
        view! {
            <span class="remark">{say!(lab, free.of_moment)}</span>
            <ChartMenu picture=for_menu file="free-poles-and-zeros" title />
        }
    };
    view! {
        <Card name="moment-zeros" panel=panels::ZEROS title beside>
            <div class="chart">
                <ChartCanvas
                    picture
                    frames
                    summary=Signal::derive(move || unmarked(&words.get()))
                    name="free-pole-zero"
                />
            </div>
            <Sentence id="free-moment" text=words />
        </Card>
    }
}
