//! Plant and loop over frequency, folded, and computed only while it is open.

use leptos::prelude::*;

use super::pictures;
use super::sentences::situation;
use super::session::{Session, use_session};
use crate::texts::{say, terms, tr};
use crate::widgets::{ChartCanvas, ChartMenu, Sentence, Terms, Text, is_open, unmarked};
use quadtank::linear::Stability;
use quadtank::study::quadruple_tank::{ClosedCurves, FrequencyCurves, ZeroSituation};
use quadtank_figure::Frame;

/// The curves of the setup in force.
pub type Curves = Memo<Option<FrequencyCurves>>;

/// The words of the view that explain themselves.
const TERMS: &[Text] =
    &[terms::singular_value, terms::sensitivity, terms::complementary, terms::peak, terms::bandwidth];

/// The fold with the view.
#[component]
pub fn FrequencyFold() -> impl IntoView {
    let session = use_session();
    let open = RwSignal::new(false);
    view! {
        <details class="more frequency" on:toggle=move |event| open.set(is_open(&event))>
            <summary data-testid="frequency-fold">{say!(session.lab, frequency.title)}</summary>
            {move || open.get().then(|| view! { <OverFrequency /> })}
        </details>
    }
}

/// Singular values of plant, sensitivity and complementary sensitivity.
#[component]
fn OverFrequency() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let curves: Curves = Memo::new(move |_| {
        let setup = session.charts.setup.get();
        session.charts.with_analysis(|analysis| FrequencyCurves::of(&setup, analysis).ok()).flatten()
    });
    let picture = pictures::over_frequency(session, curves);
    let for_menu = picture.clone();
    let sentence = Signal::derive(move || sentence(session, curves));
    let title = say!(lab, frequency.title);
    view! {
        <div class="toolbar">
            <ChartMenu picture=for_menu file="frequency" title />
            <Terms id="frequency-terms".to_owned() title terms=TERMS />
        </div>
        <div class="chart">
            <ChartCanvas
                picture
                frames
                summary=say!(lab, frequency.summary, sentence = unmarked(&sentence.get()))
                name="frequency"
                steady=true
            />
        </div>
        <Sentence id="frequency-sentence" text=sentence />
        <p class="remark">{say!(lab, frequency.remark)}</p>
    }
}

/// What the curves say: the peak, the bandwidth, and the zero that limits it, or why there is no S.
fn sentence(session: Session, curves: Curves) -> String {
    let lab = session.lab;
    let stability = session.throttled.with_analysis(|a| a.closed_loop.stability);
    let closed =
        curves.with_untracked(|curves| curves.as_ref()?.closed.as_ref().map(|closed| of_loop(session, closed)));
    let lead = match (stability, closed) {
        (None, _) => return tr!(lab, process.no_equilibrium),
        (Some(_), Some(closed)) => closed,
        (Some(Stability::Marginal), None) => tr!(lab, frequency.marginal),
        (Some(_), None) => tr!(lab, frequency.unstable),
    };
    match situation(session) {
        Some(ZeroSituation::Right(z)) => {
            let zero = lab.number_style().significant(z, 3);
            format!("{lead} {}", tr!(lab, frequency.zero, zero = zero))
        }
        _ => lead,
    }
}

fn of_loop(session: Session, closed: &ClosedCurves) -> String {
    let lab = session.lab;
    let number = |value: f64| lab.number_style().significant(value, 3);
    let peak = tr!(lab, frequency.peak, peak = number(closed.peak.value), frequency = number(closed.peak.frequency));
    let bandwidth = match closed.bandwidth {
        Some(frequency) => tr!(lab, frequency.bandwidth, frequency = number(frequency)),
        None => tr!(lab, frequency.no_bandwidth),
    };
    format!("{peak} {bandwidth}")
}
