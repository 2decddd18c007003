//! The home bench: its document, its results as signals, and the unit of its levels.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::literature::DisplayUnit;
use quadtank::study::quadruple_tank::{
    Analysis, OperatingPointSpec, QuadrupleTankStudy, Results, Run, Setup, first_experiment, held_operating_point,
    setup_of,
};
use quadtank::study::{PinnedResults, StudyError};
use quadtank_scenario::Scenario;

use super::flags::{self, locks, panels};
use super::record::OpenRecord;
use crate::depth::Depth;
use crate::lab::Lab;
use crate::session::{self, Bench, Lock, Outcome, Panel, part_of};
use crate::texts::tr;

/// The home bench: from two valves to the step response.
pub struct QuadrupleTank;

/// The session of the home bench.
pub type Session = session::Session<QuadrupleTank>;

/// The results, for the views that show them.
#[derive(Clone, Copy)]
pub struct Found {
    /// The setup that the results are of. Views read this one, so that they change when results come, not before.
    pub setup: Memo<Arc<Setup>>,
    /// What theory says.
    pub analysis: Memo<Outcome<Analysis, StudyError>>,
    /// What happens.
    pub run: Memo<Outcome<Run, StudyError>>,
    /// The pinned runs, in the order of the document.
    pub pinned: Memo<PinnedResults<Setup, Result<Run, StudyError>>>,
}

impl Found {
    /// What `read` makes of the analysis, if there is one.
    pub fn with_analysis<T>(self, read: impl FnOnce(&Analysis) -> T) -> Option<T> {
        self.analysis.with(|outcome| outcome.as_ref().as_ref().ok().map(read))
    }
}

/// What follows from the document alone.
#[derive(Clone, Copy)]
pub struct Own {
    /// The unit in which levels are shown.
    pub unit: Memo<DisplayUnit>,
    /// A record of a rig over the responses.
    pub record: RwSignal<Option<OpenRecord>>,
    /// Where a replay of the run stands (s).
    pub playback: RwSignal<Option<f64>>,
    /// Whether the levels at rest are held when valves are turned, instead of the pump voltages, where one has chosen.
    pub holds_levels: RwSignal<Option<bool>>,
    /// What is held while valves are turned.
    pub held: StoredValue<Option<Held>>,
}

/// What is held while valves are turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// The lower levels when it began (m).
    levels: [f64; 2],
    /// The pump voltages then (V), for valves with which no pumps hold these levels.
    voltages: [f64; 2],
    /// The operating point that was set last.
    point: OperatingPointSpec,
}

impl Bench for QuadrupleTank {
    const ID: &'static str = "quadruple-tank";
    const PICTURE: &'static str =
        "M8 4v10h10v-10M30 4v10h10v-10M8 18v10h10v-10M30 18v10h10v-10M13 14v4M35 14v4M9 24h8M31 22h8";
    const CLASS: &'static str = "bench";
    const PANELS: &'static [Panel] = panels::ALL;
    const LOCKS: &'static [Lock] = locks::ALL;
    type Document = Scenario;
    type Study = QuadrupleTankStudy;
    type Found = Found;
    type Own = Own;
    const DEPTHS: &'static [Depth] = &Depth::ALL;
    const CAN_PRESENT: bool = true;

    fn found(results: RwSignal<Results>) -> Found {
        Found {
            setup: part_of(results, |results| &results.setup),
            analysis: part_of(results, |results| &results.analysis),
            run: part_of(results, |results| &results.run),
            pinned: part_of(results, |results| &results.pinned),
        }
    }

    fn panel_title(lab: Lab, panel: Panel) -> String {
        flags::panel_title(lab, panel)
    }

    fn own(document: RwSignal<Scenario>) -> Own {
        Own {
            unit: Memo::new(move |_| document.with(|document| document.setup.plant.display_unit())),
            record: RwSignal::new(None),
            playback: RwSignal::new(None),
            holds_levels: RwSignal::new(None),
            held: StoredValue::new(None),
        }
    }

    fn usual(lab: Lab) -> Scenario {
        match lab.flags.with_value(|flags| flags.preset) {
            Some(id) => Scenario::from(setup_of(id)),
            None if lab.first_depth == Depth::Explore => Scenario::from(first_experiment()),
            None => Scenario::default(),
        }
    }

    fn title(lab: Lab) -> String {
        tr!(lab, app.quadruple_tank)
    }

    fn about(lab: Lab) -> String {
        tr!(lab, app.quadruple_tank_about)
    }

    fn cards(session: Session) -> AnyView {
        super::cards(session).into_any()
    }
}

/// Whether the levels at rest are held when valves are turned. Explore does unless told otherwise, so that an overflow is not taken
/// for the effect of the zero; elsewhere the voltages stay, with which the rigs are published.
pub fn holds_levels(session: Session) -> bool {
    session.own.holds_levels.get().unwrap_or_else(|| session.lab.shown_depth() == Depth::Explore)
}

/// Turns the valves.
pub fn turn_valves(session: Session, valves: [f64; 2]) {
    let holds = untrack(|| holds_levels(session));
    if !holds {
        release_levels(session);
    }
    session.edit(|s| {
        let held = session.own.held.get_value().filter(|held| held.point == s.operating_point).or_else(|| {
            // A state of one's own stays: nothing of it is held, nor released.
            let is_rest = !matches!(s.operating_point, OperatingPointSpec::State(_));
            let point = s.operating_point().ok().filter(|_| is_rest)?;
            let levels = [point.levels[0], point.levels[1]];
            Some(Held { levels, voltages: point.pump_voltage, point: s.operating_point })
        });
        s.valves = valves;
        if let Some(held) = held.filter(|_| holds) {
            s.operating_point = held_operating_point(s, held.levels, held.voltages);
            session.own.held.set_value(Some(Held { point: s.operating_point, ..held }));
        }
    });
}

/// From now on the pump voltages stay that hold the levels now, if turning the valves held these.
pub fn release_levels(session: Session) {
    let is_held = |s: &Setup| session.own.held.get_value().is_some_and(|held| held.point == s.operating_point);
    let voltages = session.document.with_untracked(|document| {
        let setup = &document.setup;
        is_held(setup).then(|| setup.operating_point().ok()).flatten().map(|point| point.pump_voltage)
    });
    session.own.held.set_value(None);
    if let Some(voltages) = voltages {
        session.edit(|s| s.operating_point = OperatingPointSpec::PumpVoltage(voltages));
    }
}

/// The session of this page.
pub fn use_session() -> Session {
    session::use_session()
}
