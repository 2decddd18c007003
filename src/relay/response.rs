//! Step 4: the response to a step of a reference, beside that of other controllers and of pinned sessions.

use leptos::prelude::*;

use super::card::{Step, card};
use super::controls::{choice, symbol};
use super::errors;
use super::pictures;
use super::readout::{readout, surface};
use super::session::{Session, time_unit, use_session};
use super::timeline::timeline;
use crate::controls::segmented;
use crate::start::Control;
use crate::texts::{say, tr};
use crate::widgets::html::option;
use crate::widgets::{DataTable, ZoomButtons, figures, handler, html};
use quadtank::linear::LoopStability;
use quadtank::sim::Halt;
use quadtank::tuning::PublishedPlant;
use quadtank_figure::Frame;
use quadtank_scenario::tuning::{CompareSpec, DecouplerSpec, StepResponse, TuningPlant, TuningScenario};

const DECOUPLERS: [(&str, DecouplerSpec); 5] = [
    ("none", DecouplerSpec::None),
    ("static", DecouplerSpec::Static),
    ("dynamic", DecouplerSpec::Dynamic),
    ("first-output", DecouplerSpec::FirstOutput),
    ("second-output", DecouplerSpec::SecondOutput),
];
const COMPARISONS: [(&str, CompareSpec); 4] = [
    ("nothing", CompareSpec::Nothing),
    ("ziegler-nichols", CompareSpec::ZieglerNichols),
    ("tyreus-luyben", CompareSpec::TyreusLuyben),
    ("full", CompareSpec::Full),
];

/// The response.
pub fn response_card() -> AnyView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = timeline(session.part(|s| s.response.duration), 1.0);
    let picture = pictures::response(session, axis.window);
    let values = readout(session, axis.cursor, move |show| {
        session.words.with_design(|design| show(&design.response.trace));
    });
    let ids = ["response-zoom-in", "response-zoom-out", "response-zoom-reset"];
    let label = say!(lab, relay.response_cursor);
    card(Step {
        name: "response",
        number: 4,
        title: say!(lab, relay.response),
        toolbar: view! { <div class="toolbar"><Pins /><ZoomButtons axis ids /></div> }.into_any(),
        frames,
        place: "chart",
        overlay: surface("response-surface", axis, frames, label, values),
        settings: settings(session),
        verdict: Signal::derive(move || sentence(session)),
        below: vec![view! { <DataTable picture=picture.clone() id="response-table" /> }.into_any()],
        picture,
    })
}

#[component]
fn Pins() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let none = Signal::derive(move || lab.tuning.with(|s| s.pinned.is_empty()));
    let pin = move |_| {
        lab.tuning.update(|s| {
            let setup = s.tuning.clone();
            s.pinned.push(setup);
            if s.pinned.len() > TuningScenario::MAX_PINNED {
                s.pinned.remove(0);
            }
        });
    };
    view! {
        <button type="button" class="button small" data-testid="response-pin" on:click=handler(pin)>{say!(lab, responses.pin)}</button>
        <button type="button" class="button small" data-testid="response-unpin" hidden=none on:click=handler(move |_| lab.tuning.update(|s| s.pinned.clear()))>{say!(lab, responses.unpin)}</button>
    }
}

fn settings(session: Session) -> AnyView {
    let lab = session.lab;
    let lock = Control::Experiment;
    let decoupler = move |name: String| {
        if let Some(&(_, chosen)) = DECOUPLERS.iter().find(|(known, _)| *known == name) {
            session.edit(|s| s.design.decoupler = chosen);
        }
    };
    let comparison = move |name: String| {
        if let Some(&(_, chosen)) = COMPARISONS.iter().find(|(known, _)| *known == name) {
            session.edit(|s| s.response.compare = chosen);
        }
    };
    let steps = vec![("step1", symbol("r = [1 0]")), ("step2", symbol("r = [0 1]"))];
    let table = Signal::derive(move || table(session));
    vec![
        segmented(
            session,
            say!(lab, relay.step_of),
            steps,
            |s| usize::from(s.response.references[1] != 0.0),
            |s, k| s.response.references = [[1.0, 0.0], [0.0, 1.0]][k],
            lock,
        ),
        choice("decoupler", say!(lab, relay.decoupler), decouplers(session), decoupler, lock),
        choice("compare", say!(lab, relay.compare), comparisons(session), comparison, lock),
        figures("response-figures", say!(lab, relay.response_caption), table),
    ]
    .into_any()
}

fn decouplers(session: Session) -> Signal<String> {
    let lab = session.lab;
    Signal::derive(move || {
        let chosen = session.words.setup.with(|s| s.design.decoupler);
        let text = |spec| match spec {
            DecouplerSpec::None => tr!(lab, relay.decoupler_none),
            DecouplerSpec::Static => tr!(lab, relay.decoupler_static),
            DecouplerSpec::Dynamic => tr!(lab, relay.decoupler_dynamic),
            DecouplerSpec::FirstOutput => tr!(lab, relay.decoupler_first),
            DecouplerSpec::SecondOutput => tr!(lab, relay.decoupler_second),
        };
        DECOUPLERS.iter().map(|&(name, spec)| option(name, text(spec), spec == chosen)).collect()
    })
}

fn comparisons(session: Session) -> Signal<String> {
    let lab = session.lab;
    Signal::derive(move || {
        let (chosen, plant) = session.words.setup.with(|s| (s.response.compare, s.plant.clone()));
        // The full controller is known for one plant only.
        let has_full = plant == TuningPlant::Published(PublishedPlant::WoodBerry);
        let text = |spec| match spec {
            CompareSpec::Nothing => tr!(lab, relay.compare_nothing),
            CompareSpec::ZieglerNichols => tr!(lab, relay.compare_zn),
            CompareSpec::TyreusLuyben => tr!(lab, relay.compare_tl),
            CompareSpec::Full => tr!(lab, relay.compare_full),
        };
        let shown = COMPARISONS.iter().filter(|(_, spec)| *spec != CompareSpec::Full || has_full);
        shown.map(|&(name, spec)| option(name, text(spec), spec == chosen)).collect()
    })
}

/// How the step went, and whether all is well.
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let found = session.words.design.get();
    let setup = session.words.setup.get();
    let design = match found.as_ref() {
        Ok(Some(design)) => design,
        Ok(None) => return (false, tr!(lab, relay.no_point).to_owned()),
        Err(error) => return (false, errors::sentence(lab, error)),
    };
    let decoupled = setup.design.decoupler != DecouplerSpec::None;
    let stepped = usize::from(setup.response.references[1] != 0.0);
    let [own, other] = [design.response.figures[stepped], design.response.figures[1 - stepped]];
    let (good, mut text) = if design.response.is_bounded {
        let percent = |share: f64| format!("{}\u{a0}%", style.fixed(100.0 * share, 1));
        let overshoot = own.overshoot.map_or_else(|| "–".to_owned(), percent);
        let cross = style.significant(other.peak.unwrap_or(0.0), 3);
        let (number, other) = (stepped + 1, 2 - stepped);
        match own.settling_time {
            Some(time) => {
                let (time, unit) = (style.significant(time, 3), time_unit(&setup.plant));
                (
                    true,
                    tr!(
                        lab,
                        relay.response_settles,
                        number = number,
                        time = time,
                        unit = unit,
                        overshoot = overshoot,
                        other = other,
                        cross = cross
                    )
                    .to_string(),
                )
            }
            None => (false, tr!(lab, relay.response_never, number = number, other = other, cross = cross).to_string()),
        }
    } else if let Some(Halt::Full { time }) = design.response.trace.halt {
        let time = style.significant(time, 3);
        (false, tr!(lab, relay.response_unfinished, time = time, unit = time_unit(&setup.plant)).to_string())
    } else {
        (false, tr!(lab, relay.response_unstable).to_owned())
    };
    if decoupled {
        text = text + " " + tr!(lab, relay.decoupled);
    }
    if design.response.trace.limited.contains(&true) {
        text = text + " " + tr!(lab, relay.pump_limit);
    }
    if let Some(comparison) = &design.comparison {
        let sentence = match comparison.stability {
            LoopStability::Stable => tr!(lab, relay.rival_stable),
            LoopStability::NotComputed { .. } => tr!(lab, relay.rival_not_computed),
            LoopStability::Unstable { .. } | LoopStability::Marginal { .. } => tr!(lab, relay.rival_unstable),
        };
        text = text + " " + sentence;
    }
    (good, text)
}

/// Figures of both outputs: of the session, its comparison, and the pinned ones.
fn table(session: Session) -> String {
    let lab = session.lab;
    let unit = session.words.setup.with(|s| time_unit(&s.plant));
    let names = [
        tr!(lab, relay.col_output).to_owned(),
        tr!(lab, relay.col_overshoot).to_owned(),
        tr!(lab, relay.col_settling, unit = unit).to_string(),
        tr!(lab, relay.col_cross).to_owned(),
        "IAE".to_owned(),
    ];
    let mut rows = String::new();
    session.words.with_design(|design| {
        rows += &rows_of(session, &design.response);
        if let Some(comparison) = &design.comparison {
            rows += &(group(tr!(lab, relay.row_rival)) + &rows_of(session, &comparison.response));
        }
    });
    for (k, outcome) in session.words.pinned.get().iter().enumerate() {
        if let Ok(Some(design)) = outcome.as_ref() {
            rows += &(group(&tr!(lab, relay.row_pinned, number = k + 1)) + &rows_of(session, &design.response));
        }
    }
    html::table(tr!(lab, relay.response_caption), &names, &rows)
}

/// A line above the rows of a response that is not the one at work.
fn group(name: &str) -> String {
    html::element("tr", "", &html::element("th", "scope=\"rowgroup\" colspan=\"5\"", &html::escape(name)))
}

fn rows_of(session: Session, response: &StepResponse) -> String {
    let style = session.lab.number_style();
    let number = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| style.significant(v, 3));
    let percent =
        |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| format!("{}\u{a0}%", style.fixed(100.0 * v, 1)));
    let row = |k: usize| {
        let of = response.is_bounded.then(|| response.figures[k]);
        let cells = [
            percent(of.and_then(|of| of.overshoot)),
            number(of.and_then(|of| of.settling_time)),
            number(of.and_then(|of| of.peak)),
            number(of.map(|of| of.iae)),
        ];
        html::row(["loop1", "loop2"][k], ["y₁", "y₂"][k], &cells)
    };
    row(0) + &row(1)
}
