//! What the levels do: their curves, drawn as time passes, and one sentence.

use std::time::Duration;

use leptos::leptos_dom::helpers::TimeoutHandle;
use leptos::prelude::*;

use super::super::session::{Session, use_session};
use super::super::set_points::SetPoints;
use super::super::{pictures, responses};
use crate::texts::{say, terms};
use crate::widgets::{Card, ChartCanvas, Playback, Sentence, Text, TimeBar, unmarked};
use quadtank::study::quadruple_tank::fitted_duration_s;
use quadtank_figure::Frame;

/// How long a change has to rest until the time axis is fitted to it: sooner than it is kept as a step, so that both are one.
const RESTED: Duration = Duration::from_millis(250);

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::reference, terms::rise, terms::overshoot];

/// The levels of the run.
#[component]
pub fn LevelsCard(replay: Playback) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    fit_time(session);
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::levels(session);
    let sentence = Signal::derive(move || responses::sentence(session));
    view! {
        <Card name="levels" title=say!(lab, explore.levels) terms=TERMS beside=move || view! { <TimeBar playback=replay id="replay" lab /> }>
            <div class="chart">
                <ChartCanvas picture frames summary=say!(lab, responses.summary, sentence = unmarked(&sentence.get())) name="levels" steady=true />
                <SetPoints frames />
            </div>
            <Sentence id="levels-sentence" text=sentence status=true />
        </Card>
    }
}

/// Makes the run so long that its levels are seen to settle, once a change rests.
fn fit_time(session: Session) {
    let setup =
        session.part(|s| (s.plant, s.valves, s.operating_point, s.controller, s.experiment.set_point_steps.clone()));
    let waiting = StoredValue::new_local(None::<TimeoutHandle>);
    let fit = move || {
        let fitted = session.document.with_untracked(|document| fitted_duration_s(&document.setup));
        if session.document.with_untracked(|document| document.setup.experiment.duration_s) != fitted {
            session.edit(|s| s.experiment.duration_s = fitted);
        }
    };
    // What a link or the last visit brings stays as it is.
    let mut is_known = false;
    Effect::new(move || {
        // `track` alone does not compute the memo, and a memo that was never computed does not notify.
        setup.with(|_| ());
        if std::mem::replace(&mut is_known, true) {
            if let Some(last) = waiting.get_value() {
                last.clear();
            }
            waiting.set_value(set_timeout_with_handle(fit, RESTED).ok());
        }
    });
    on_cleanup(move || {
        if let Some(last) = waiting.try_get_value().flatten() {
            last.clear();
        }
    });
}
