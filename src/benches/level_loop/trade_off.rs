//! The trade-off: the variance of the level against that of the outflow, with every known tuning a click away.

use leptos::prelude::*;
use quadtank::literature::andreis::{PublishedMethod, PublishedObjective};
use quadtank::study::level_loop::{PiTuning, PublishedTuning, TradeOff, TradeOffPoint, trade_off};
use quadtank_figure::Frame;

use super::flags::{locks, panels};
use super::pictures::{self, TradeOffEntry, method_name};
use super::rules::suggested;
use super::sentences::variance;
use super::session::{Session, use_session};
use crate::lab::Lab;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, PointButton, Text};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::variance, terms::tight, terms::averaging];

/// The trade-off.
#[component]
pub fn TradeOffCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let names = Memo::new(move |_| tunings(session));
    let found = Memo::new(move |_| {
        let setup = session.throttled.setup.get();
        let tunings: Vec<PiTuning> = names.with(|names| names.iter().map(|(_, tuning)| *tuning).collect());
        trade_off(&setup, &tunings)
    });
    let entries = Memo::new(move |_| entries(&found.get(), &names.get()));
    let picture = pictures::trade_off(session, found, entries);
    let for_menu = picture.clone();
    let title = say!(lab, level.trade_off);
    let summary = Signal::derive(move || present(session));
    view! {
        <Card name="trade-off" panel=panels::TRADE_OFF title terms=TERMS beside=move || view! { <ChartMenu picture=for_menu file="trade-off" title /> }>
            <div class="chart">
                <ChartCanvas picture frames summary name="trade-off-chart" />
                <svg class="over">
                    <For each=move || entries.get() key=|entry| (entry.name.clone(), entry.at.0.to_bits(), entry.at.1.to_bits()) let(entry)>
                        <Point entry frames />
                    </For>
                </svg>
            </div>
            <p class="sentence" data-testid="trade-off-sentence">{summary}</p>
        </Card>
    }
}

#[component]
fn Point(entry: TradeOffEntry, frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let TradeOffEntry { place, name, tuning, at } = entry;
    let label = Signal::derive(move || {
        let style = lab.number_style();
        let (gain, time) = (style.significant(tuning.gain, 3), style.significant(tuning.integral_time_s, 4));
        tr!(lab, level.take_point, name = &name, gain = gain, time = time)
    });
    let choose = move |()| {
        if !lab.locks(locks::GAINS) {
            session.edit(|s| s.set_pi_tuning(tuning));
        }
    };
    view! { <PointButton id=format!("trade-{place}") label at=Signal::stored(at) on_choose=choose frames /> }
}

/// The reference, the published tunings and those of the rules, each tuning once.
fn tunings(session: Session) -> Vec<(String, PiTuning)> {
    let lab = session.lab;
    let setup = session.throttled.setup.get();
    let published = setup.published_tunings().into_iter().map(|one| (published_name(lab, one), one.tuning));
    let rules = suggested(session).into_iter().map(|(name, tuning)| (ruled_name(lab, name), tuning));
    let reference = std::iter::once((tr!(lab, level.reference_point), setup.reference));
    published.chain(rules).chain(reference).fold(Vec::new(), |mut known: Vec<(String, PiTuning)>, next| {
        if known.iter().all(|(_, tuning)| *tuning != next.1) {
            known.push(next);
        }
        known
    })
}

/// How a published tuning was found and what for: the source has some methods for either objective, and the rules have their names.
fn published_name(lab: Lab, PublishedTuning { method, objective, .. }: PublishedTuning) -> String {
    let name = match method {
        PublishedMethod::Skogestad | PublishedMethod::Lambda => {
            tr!(lab, level.printed_tuning, name = method_name(lab, method))
        }
        _ => method_name(lab, method),
    };
    match (method, objective) {
        (PublishedMethod::Current, _) => name,
        (_, PublishedObjective::Tight) => format!("{name}, {}", tr!(lab, level.tight)),
        (_, PublishedObjective::Averaging) => format!("{name}, {}", tr!(lab, level.averaging)),
    }
}

/// The name of what a rule suggests, told from the printed tunings by the rule of the same name.
fn ruled_name(lab: Lab, name: &str) -> String {
    let is_printed_too =
        [PublishedMethod::Skogestad, PublishedMethod::Lambda].iter().any(|&method| method_name(lab, method) == name);
    if is_printed_too { tr!(lab, level.ruled_tuning, name = name) } else { name.to_owned() }
}

fn entries(found: &TradeOff, names: &[(String, PiTuning)]) -> Vec<TradeOffEntry> {
    let of = |(place, ((name, tuning), point)): (usize, (&(String, PiTuning), &Option<TradeOffPoint>))| {
        let point = (*point)?;
        let at = (point.outflow, point.level);
        (at.0 > 0.0 && at.1 > 0.0).then(|| TradeOffEntry { place, name: name.clone(), tuning: *tuning, at })
    };
    names.iter().zip(&found.points).enumerate().filter_map(of).collect()
}

/// Where the present tuning stands.
fn present(session: Session) -> String {
    let lab = session.lab;
    let text = session.throttled.with_answer(|answer| {
        let (level, outflow) = (answer.figures.level.variance, answer.figures.outflow.variance);
        tr!(lab, level.present_point, level = variance(lab, level), outflow = variance(lab, outflow))
    });
    text.unwrap_or_default()
}
