//! The heated tank of the lecture slides, exact and by steps.

use leptos::prelude::*;
use quadtank::literature::level_slides;
use quadtank::study::level_loop::{HEATED_STEPS_S, HeatedAnswer, heated_tank};
use quadtank_figure::Frame;

use super::flags::panels;
use super::pictures;
use super::session::use_session;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Scale, SliderField, Text, Verdict, marked};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::step_size];

/// Level and temperature over the step of the method.
#[component]
pub fn HeatedCard() -> impl IntoView {
    let lab = use_session().lab;
    let hours = |seconds: f64| seconds / level_slides::HOUR;
    let step = RwSignal::new(0.5);
    let found = Memo::new(move |_| heated_tank(step.get() * level_slides::HOUR).ok());
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::heated(lab, found);
    let for_menu = picture.clone();
    let title = say!(lab, level.heated);
    let sentence = Signal::derive(move || {
        let style = lab.number_style();
        found.with(|found| {
            let Some(found) = found else { return tr!(lab, level.heated_none) };
            let (level, temperature) =
                (style.significant(found.level_error, 2), style.significant(found.temperature_error, 2));
            if found.diverges() {
                tr!(lab, level.heated_diverges, level = level)
            } else {
                tr!(lab, level.heated_error, level = level, temperature = temperature)
            }
        })
    });
    view! {
        <Card name="heated" panel=panels::HEATED title terms=TERMS beside=move || view! { <ChartMenu picture=for_menu file="heated-tank" title /> }>
            <SliderField
                id=("heated-step", "heated-step-number")
                label="Δt".to_owned()
                name=say!(lab, level.step_size)
                value=step
                on_change=move |hours: f64| step.set(hours)
                travel=Signal::stored((hours(HEATED_STEPS_S[0]), hours(HEATED_STEPS_S[1])))
                scale=Scale::Logarithmic
                digits=None
                unit="h".to_owned()
            />
            <div class="chart"><ChartCanvas picture frames summary=sentence name="heated-chart" steady=true /></div>
            <Verdict id="heated-verdict" warm=Signal::derive(move || found.with(|f| f.as_ref().is_none_or(HeatedAnswer::diverges)))>
                {move || marked(&sentence.get())}
            </Verdict>
            <p class="remark">{say!(lab, level.heated_remark)}</p>
        </Card>
    }
}
