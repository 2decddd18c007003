//! Step 4: the response to a step of a reference, beside that of other controllers and of pinned sessions.

use leptos::prelude::*;

use super::errors;
use super::flags::{locks, panels};
use super::mends;
use super::pictures;
use super::readout::{Surface, readout};
use super::session::{Session, time_unit, use_session};
use super::step::Step;
use super::timeline::timeline;
use crate::benches::handover::{self, HandOver};
use crate::controls::Switch;
use crate::lab::Lab;
use crate::pinned::{PinButtons, PinnedSetups};
use crate::texts::{say, symbol, terms, tr};
use crate::widgets::{Choice, DataTable, Figure, Figures, ReasonedRow, Select, TableContent, Text, ZoomButtons};
use quadtank::linear::LoopStability;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::sim::Halt;
use quadtank::study::handover::rig_under;
use quadtank::study::relay_tuning::{CompareSpec, DecouplerSpec, StepResponse, TuningPlant, TuningSetup};
use quadtank_figure::Frame;
use quadtank_scenario::tuning::TuningScenario;

/// The references whose steps can be looked at.
const FIRST: [f64; 2] = [1.0, 0.0];
const SECOND: [f64; 2] = [0.0, 1.0];

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::decoupler, terms::overshoot];

/// The response.
#[component]
pub fn ResponseCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = timeline(session.part(|s| s.response.duration), 1.0);
    let picture = pictures::response(session, axis.window);
    let for_table = picture.clone();
    let values = readout(session, axis.cursor, move |show| {
        session.throttled.with_design(|design| show(&design.response.trace));
    });
    let ids = ["response-zoom-in", "response-zoom-out", "response-zoom-reset"];
    let label = say!(lab, relay.response_cursor);
    view! {
        <Step
            name="response"
            panel=panels::RESPONSES
            number=4
            terms=TERMS
            title=say!(lab, relay.response)
            toolbar=move || view! { <div class="toolbar"><PinButtons session ids=("response-pin", "response-unpin") max=TuningScenario::MAX_PINNED /><ZoomButtons axis ids /></div> }
            picture
            frames
            overlay=move || view! { <Surface id="response-surface" axis frames label readout=values /> }
            verdict=Signal::derive(move || sentence(session))
            offers=Signal::derive(move || mends::of_design(session, "mend-response"))
            below=move || view! { <PinnedSetups session id="response-pinned" text=pinned_text restore /> <DataTable picture=for_table id="response-table" /> }
        >
            <Settings />
        </Step>
    }
}

/// Where the locus of a pinned session was moved to, and with which controllers, or the gains of given ones.
fn pinned_text(session: Session, pinned: &TuningSetup) -> String {
    let style = session.lab.number_style();
    if let Some(controllers) = pinned.design.controllers {
        let [one, two] = controllers.map(|pid| style.significant(pid.gain, 3));
        return tr!(session.lab, relay.pinned_given, one = one, two = two);
    }
    let [real, imaginary] = pinned.design.target;
    let sign = if imaginary < 0.0 { "−" } else { "+" };
    let action = if pinned.design.action == quadtank::tuning::Action::Pi { "PI" } else { "PID" };
    format!("{action} · λ {} {sign} {}j", style.fixed(real, 2), style.fixed(imaginary.abs(), 2))
}

/// Takes a pinned session up in the present step.
fn restore(present: &mut TuningSetup, pinned: &TuningSetup) {
    *present = TuningSetup { response: present.response, ..pinned.clone() };
}

#[component]
fn Settings() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, relay.step_of)
            choices=vec![(FIRST, "step1", symbol("r = [1 0]")), (SECOND, "step2", symbol("r = [0 1]"))]
            read=|s| if s.response.references[1] == 0.0 { FIRST } else { SECOND }
            write=|s, references| s.response.references = references
            lock=locks::EXPERIMENT
        />
        <Select
            id="decoupler"
            name=say!(lab, relay.decoupler)
            choices=Signal::derive(move || decouplers(lab))
            chosen=Signal::derive(move || session.throttled.setup.with(|s| s.design.decoupler))
            on_choose=move |chosen| session.edit(|s| s.design.decoupler = chosen)
            disabled=lab.locks(locks::EXPERIMENT)
        />
        <Select
            id="compare"
            name=say!(lab, relay.compare)
            choices=Signal::derive(move || comparisons(session))
            chosen=Signal::derive(move || session.throttled.setup.with(|s| s.response.compare))
            on_choose=move |chosen| session.edit(|s| s.response.compare = chosen)
            disabled=lab.locks(locks::EXPERIMENT)
        />
        <ToRig />
        <Figures name="response-figures" caption=say!(lab, relay.response_caption)>{move || table(session)}</Figures>
    }
}

/// Takes the controllers to the rig, where they are PI controllers of one.
#[component]
fn ToRig() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let rig = move || {
        session.throttled.setup.with(|setup| session.throttled.with_design(|design| rig_under(setup, design)).flatten())
    };
    let known = Memo::new(move |_| rig().is_some());
    let act = Callback::new(move |()| {
        if let Some(rig) = untrack(rig) {
            handover::to_rig(lab, rig);
        }
    });
    view! {
        <HandOver id="to-rig" name=say!(lab, handover.rig) is_possible=known act />
    }
}

fn decouplers(lab: Lab) -> Vec<Choice<DecouplerSpec>> {
    vec![
        Choice::new(DecouplerSpec::None, "none", tr!(lab, relay.decoupler_none)),
        Choice::new(DecouplerSpec::Static, "static", tr!(lab, relay.decoupler_static)),
        Choice::new(DecouplerSpec::Dynamic, "dynamic", tr!(lab, relay.decoupler_dynamic)),
        Choice::new(DecouplerSpec::FirstOutput, "first-output", tr!(lab, relay.decoupler_first)),
        Choice::new(DecouplerSpec::SecondOutput, "second-output", tr!(lab, relay.decoupler_second)),
    ]
}

fn comparisons(session: Session) -> Vec<Choice<CompareSpec>> {
    let lab = session.lab;
    let mut choices = vec![
        Choice::new(CompareSpec::Nothing, "nothing", tr!(lab, relay.compare_nothing)),
        Choice::new(CompareSpec::ZieglerNichols, "ziegler-nichols", tr!(lab, relay.compare_zn)),
        Choice::new(CompareSpec::TyreusLuyben, "tyreus-luyben", tr!(lab, relay.compare_tl)),
    ];
    // The full controller is known for one plant only.
    if session.throttled.setup.with(|s| s.plant == TuningPlant::Published(PublishedPlant::WoodBerry)) {
        choices.push(Choice::new(CompareSpec::Full, "full", tr!(lab, relay.compare_full)));
    }
    choices
}

/// How the step went, and whether all is well.
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let found = session.throttled.design.get();
    let setup = session.throttled.setup.get();
    let design = match found.as_ref() {
        Ok(Some(design)) => design,
        Ok(None) => return (false, tr!(lab, relay.no_point)),
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
                    ),
                )
            }
            None => (false, tr!(lab, relay.response_never, number = number, other = other, cross = cross)),
        }
    } else if let Some(Halt::Full { time }) = design.response.trace.halt {
        let time = style.significant(time, 3);
        (false, tr!(lab, relay.response_unfinished, time = time, unit = time_unit(&setup.plant)))
    } else {
        (false, tr!(lab, relay.response_unstable))
    };
    if decoupled {
        text = text + " " + &tr!(lab, relay.decoupled);
    }
    if design.response.trace.limited.contains(&true) {
        text = text + " " + &tr!(lab, relay.pump_limit);
    }
    if let Some(comparison) = &design.comparison {
        let sentence = match comparison.stability {
            LoopStability::Stable => tr!(lab, relay.comparison_stable),
            LoopStability::NotComputed { .. } => tr!(lab, relay.comparison_not_computed),
            LoopStability::Unstable { .. } | LoopStability::Marginal { .. } | LoopStability::AlgebraicLoop { .. } => {
                tr!(lab, relay.comparison_unstable)
            }
        };
        text = text + " " + &sentence;
    }
    (good, text)
}

/// Figures of both outputs: of the session, its comparison, and the pinned ones.
fn table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let unit = session.throttled.setup.with(|s| time_unit(&s.plant));
    let columns = vec![
        tr!(lab, relay.col_output),
        tr!(lab, relay.col_overshoot),
        tr!(lab, relay.col_settling, unit = unit),
        tr!(lab, relay.col_cross),
        "IAE".to_owned(),
    ];
    let mut rows = Vec::new();
    session.throttled.with_design(|design| {
        rows.extend(rows_of(session, &design.response));
        if let Some(comparison) = &design.comparison {
            rows.push(group(tr!(lab, relay.row_comparison)));
            rows.extend(rows_of(session, &comparison.response));
        }
    });
    for (k, pinned) in session.throttled.pinned.get().iter().enumerate() {
        if let Ok(Some(design)) = pinned.result.as_ref() {
            let same = session.throttled.setup.with(|s| s.plant.has_same_time_unit(&pinned.setup.plant));
            rows.push(group(if same {
                tr!(lab, pins.name, number = k + 1)
            } else {
                tr!(lab, relay.row_pinned_other, number = k + 1)
            }));
            rows.extend(rows_of(session, &design.response));
        }
    }
    view! { <TableContent caption=tr!(lab, relay.response_caption) columns rows /> }
}

/// A line above the rows of a response that is not the one at work.
fn group(name: String) -> AnyView {
    view! { <tr><th scope="rowgroup" colspan="5">{name}</th></tr> }.into_any()
}

fn rows_of(session: Session, response: &StepResponse) -> [AnyView; 2] {
    let lab = session.lab;
    let style = lab.number_style();
    let number = |v: f64| style.significant(v, 3);
    let percent = |v: f64| format!("{}\u{a0}%", style.fixed(100.0 * v, 1));
    let or_why = |text: Option<String>, why: String| text.map_or(Figure::None(why), Figure::Shown);
    [0, 1].map(|k| {
        let of = response.figures[k];
        let does_not_step = || tr!(lab, relay.why_no_step, number = k + 1);
        let why_not_settled =
            if of.overshoot.is_some() { tr!(lab, relay.why_not_settled, number = k + 1) } else { does_not_step() };
        let figures = if response.is_bounded {
            vec![
                or_why(of.overshoot.map(percent), does_not_step()),
                or_why(of.settling_time.map(number), why_not_settled),
                or_why(of.peak.map(number), tr!(lab, relay.why_no_peak, number = k + 1)),
                Figure::Shown(number(of.iae)),
            ]
        } else {
            vec![Figure::None(tr!(lab, relay.why_unbounded)); 4]
        };
        view! { <ReasonedRow class=["loop1", "loop2"][k] name=["y₁", "y₂"][k] figures /> }.into_any()
    })
}
