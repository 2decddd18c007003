//! The valve plane: γ1 across, γ2 upwards, shaded by the right-most zero, with a point to drag.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::preset::{chosen, name_of};
use super::session::{Session, holds_levels, turn_valves, use_session};
use super::{pictures, sentences};
use crate::lab::Notice;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Nudge, PointButton, PointHandle, Sentence, Text, first_frame};
use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::ValveMap;
use quadtank_figure::Frame;

/// Steps of the arrow keys between shut and open.
const STEPS: f64 = 100.0;
/// Step of the arrow keys.
pub const STEP: f64 = 1.0 / STEPS;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::gamma, terms::zero, terms::minimum_phase, terms::right_half_plane];

/// The valve plane.
#[component]
pub fn ValvePlaneCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::valve_plane(session, false);
    let on_paper = pictures::valve_plane(session, true);
    let for_menu = on_paper.clone();
    let title = say!(lab, valves.title);
    let summary = Signal::derive(move || summary(session));
    let hint = (!lab.locks(locks::VALVES)).then(|| view! { <span class="remark">{say!(lab, valves.remark)}</span> });
    let beside = move || view! { {hint}<ChartMenu picture=for_menu file="valve-plane" title /> };
    view! {
        <Card name="plane" panel=panels::VALVES title terms=TERMS beside>
            <div class="chart square">
                <ChartCanvas picture on_paper frames summary name="valve-plane" />
                <Overlay frames />
            </div>
            <Sentence id="valves-sentence" text=Signal::derive(move || sentences::of_rightmost(session)) />
        </Card>
    }
}

/// The plane as a small map of the easy and the hard side.
#[component]
pub fn ValveMapCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::valve_map(session, false);
    view! {
        <Card name="map" title=say!(lab, explore.valves) terms=TERMS beside=move || view! { <HoldSwitch /> }>
            <div class="chart square">
                <ChartCanvas
                    picture
                    on_paper=pictures::valve_map(session, true)
                    frames
                    summary=Signal::derive(move || summary(session))
                    name="valve-map"
                />
                <Overlay frames />
            </div>
        </Card>
    }
}

/// What stays while valves are turned.
#[component]
pub fn HoldSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <label class="check small">
            <input
                type="checkbox"
                data-testid="hold-levels"
                prop:checked=move || holds_levels(session)
                on:change=move |event| session.own.holds_levels.set(Some(event_target_checked(&event)))
            />
            {say!(lab, explore.hold)}
        </label>
    }
}

fn summary(session: Session) -> String {
    let lab = session.lab;
    let [g1, g2] = session.throttled.setup.with(|s| s.valves);
    let style = lab.number_style();
    let map = session.throttled.setup.with(|s| ValveMap::of(s).ok());
    let line = pictures::name_of_boundary(lab, map.map_or(1.0, |map| map.singular_sum()));
    tr!(lab, valves.summary, line = line, gamma1 = style.fixed(g1, 2), gamma2 = style.fixed(g2, 2))
}

/// What lies over the picture: guides, published points and the point to drag.
#[component]
fn Overlay(frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    // The overlay stands from the start and moves with the picture: rebuilding it would take the focus from the handle.
    view! {
        <svg class="over" aria-hidden="false">
            <path class="guide" d=guides(use_session(), frames)></path>
            <PublishedPoints frames />
            <SettingHandle frames />
        </svg>
    }
}

/// From the point to both axes.
fn guides(session: Session, frames: RwSignal<Vec<Frame>>) -> Signal<String> {
    let [gamma_1, gamma_2] = [0, 1].map(|valve| session.part(move |s| s.valves[valve]));
    Signal::derive(move || {
        let frame = first_frame(frames);
        let (left, bottom) = (frame.plot.left, frame.plot.bottom());
        let (x, y) = frame.to_px((gamma_1.get(), gamma_2.get()));
        format!("M{left} {y}H{x}M{x} {bottom}V{y}")
    })
}

/// Valve settings of the same source, to take over with a click; rig and tuning stay.
#[component]
fn PublishedPoints(frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let session = use_session();
    let rig = chosen(session);
    let points = move || {
        let source = rig.get().map(|id| id.preset().source);
        PresetId::ALL
            .into_iter()
            .filter(|id| Some(id.preset().source) == source)
            .map(|id| view! { <PublishedPoint id frames /> })
            .collect_view()
    };
    view! { {points} }
}

#[component]
fn PublishedPoint(id: PresetId, frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let valves = id.preset().plant.valves;
    let short = match id {
        PresetId::JohanssonMinimumPhase | PresetId::CocotaMinimumPhase => "P−",
        PresetId::JohanssonNonMinimumPhase | PresetId::CocotaNonMinimumPhase => "P+",
        PresetId::JunqueiraA => "a",
        PresetId::JunqueiraB => "b",
        PresetId::Seville => "HD-MPC",
        PresetId::Quanser => "Quanser",
        PresetId::MpcTools => "MPCtools",
        PresetId::Dtu => "DTU",
    };
    let label = Signal::derive(move || {
        let style = lab.number_style();
        let (gamma1, gamma2) = (style.fixed(valves[0], 2), style.fixed(valves[1], 2));
        tr!(lab, valves.published, name = name_of(lab, id), gamma1 = gamma1, gamma2 = gamma2)
    });
    let choose = move || {
        if !lab.locks(locks::VALVES) {
            turn_valves(session, valves);
            if !lab.locks(locks::PRESET) {
                lab.notice.set(Some(Notice::ValvesOf(id)));
            }
        }
    };
    view! {
        <PointButton
            id=format!("point-{}", id.name())
            label
            text=short
            at=Signal::stored(valves.into())
            on_choose=move |()| choose()
            frames
        />
    }
}

/// The point: dragged by mouse, pen or finger, moved by the arrow keys.
#[component]
fn SettingHandle(frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let [gamma_1, gamma_2] = [0, 1].map(|valve| session.part(move |s| s.valves[valve]));
    let set = move |(g1, g2): (f64, f64)| turn_valves(session, [g1, g2].map(on_grid));
    let spoken = move || {
        let style = lab.number_style();
        format!("γ₁ {}, γ₂ {}", style.fixed(gamma_1.get(), 2), style.fixed(gamma_2.get(), 2))
    };
    let on_nudge = move |by: Nudge| {
        let moved = |gamma: f64, steps: f64| gamma + STEP * (steps + by.page);
        set((moved(gamma_1.get_untracked(), by.right), moved(gamma_2.get_untracked(), by.up)));
    };
    view! {
        <PointHandle
            id="valve-handle"
            label=say!(lab, valves.handle)
            at=Signal::derive(move || (gamma_1.get(), gamma_2.get()))
            value=gamma_1
            limits=(0.0, 1.0)
            spoken=Signal::derive(spoken)
            locked=lab.locks(locks::VALVES)
            on_move=set
            on_nudge
            frames
        />
    }
}

/// The nearest valve fraction that a handle can be set to.
pub fn on_grid(gamma: f64) -> f64 {
    (gamma.clamp(0.0, 1.0) * STEPS).round() / STEPS
}
