//! The map of a cost and a search in it, as far as they are computed: what takes longer than a frame.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank::sim::level::LevelRunError;
use quadtank::study::level_loop::{ContourMap, ContourSettings, LevelLoopSetup, LevelSearch, PiTuning, SearchMethod};
use quadtank::tuning::search::GeneticSettings;

use super::session::Session;
use crate::slices::Slices;
use crate::timing::now_ms;

/// Cells along each side of the map.
pub const CELLS: usize = 40;
/// Shown again after so long at the earliest (ms): painting the map takes as long as a hundred of its cells.
const BETWEEN_PICTURES_MS: f64 = 250.0;

/// What is being computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// The map.
    Map,
    /// A search.
    Search(Method),
}

/// A method of search, by its name alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Steepest descent.
    Gradient,
    /// Nelder and Mead.
    NelderMead,
    /// Genetic.
    Genetic,
}

/// Something that was computed of a setup, with the time that it took (ms).
#[derive(Clone)]
pub struct Computed<T> {
    /// What, as far as it is.
    pub value: T,
    /// Of what.
    pub setup: Arc<LevelLoopSetup>,
    /// How long it has taken (ms), the pauses for the browser included.
    pub took_ms: f64,
}

/// A search with its method.
#[derive(Clone)]
pub struct Searched {
    /// The method.
    pub method: Method,
    /// The search.
    pub search: LevelSearch,
}

/// The map and the last search. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Exploration {
    /// The map, as far as it is computed.
    pub map: RwSignal<Option<Computed<ContourMap>>>,
    /// The last search, as far as it has come.
    pub search: RwSignal<Option<Computed<Searched>>>,
    /// What is being computed.
    pub work: RwSignal<Option<Work>>,
    /// Why nothing was computed.
    pub refusal: RwSignal<Option<LevelRunError>>,
    slices: StoredValue<Option<Slices>, LocalStorage>,
}

impl Exploration {
    /// Nothing computed yet.
    pub fn new() -> Self {
        Self {
            map: RwSignal::new(None),
            search: RwSignal::new(None),
            work: RwSignal::new(None),
            refusal: RwSignal::new(None),
            slices: StoredValue::new_local(None),
        }
    }

    /// Ends what is being computed; what there is stays.
    pub fn cancel(self) {
        self.slices.set_value(None);
        self.work.set(None);
    }

    /// The map of a setup, where it is the one that was computed.
    pub fn map_of(self, setup: &LevelLoopSetup) -> Option<Computed<ContourMap>> {
        self.map.with(|map| map.as_ref().filter(|map| map.setup.has_same_problem(setup)).cloned())
    }

    /// The search of a setup, likewise.
    pub fn search_of(self, setup: &LevelLoopSetup) -> Option<Computed<Searched>> {
        self.search.with(|search| search.as_ref().filter(|search| search.setup.has_same_problem(setup)).cloned())
    }
}

/// Computes the map of the present setup.
pub fn start_map(session: Session) {
    let setup = Arc::new(session.document.with_untracked(|document| document.level_loop.clone()));
    let map = ContourMap::new(&setup, ContourSettings { size: [CELLS; 2] });
    start(session, Work::Map, session.own.exploration.map, setup, map, |map| map.advance(1));
}

/// Searches the best tuning of the present setup from the present one.
pub fn start_search(session: Session, method: Method) {
    let setup = Arc::new(session.document.with_untracked(|document| document.level_loop.clone()));
    let from = setup.pi_tuning().unwrap_or(PiTuning { gain: 1.0, integral_time_s: 100.0 });
    let spec = match method {
        Method::Gradient => SearchMethod::Gradient(from),
        Method::NelderMead => SearchMethod::NelderMead(from),
        Method::Genetic => SearchMethod::Genetic(GeneticSettings::default()),
    };
    let search = LevelSearch::new(&setup, spec).map(|search| Searched { method, search });
    let advance = |searched: &mut Searched| searched.search.advance(1);
    start(session, Work::Search(method), session.own.exploration.search, setup, search, advance);
}

/// Advances a computation until it is done, and shows it from time to time.
fn start<T: Clone + Send + Sync + 'static>(
    session: Session,
    work: Work,
    shown: RwSignal<Option<Computed<T>>>,
    setup: Arc<LevelLoopSetup>,
    begun: Result<T, LevelRunError>,
    advance: fn(&mut T) -> bool,
) {
    let exploration = session.own.exploration;
    exploration.cancel();
    exploration.refusal.set(begun.as_ref().err().copied());
    let Ok(value) = begun else { return };
    exploration.work.set(Some(work));
    let state = StoredValue::new_local(value);
    let begin = now_ms();
    let mut last_shown = begin;
    let step = move || state.try_update_value(advance).unwrap_or(false);
    let after_slice = move |is_last: bool| {
        let now = now_ms();
        if is_last || now - last_shown >= BETWEEN_PICTURES_MS {
            last_shown = now;
            if let Some(value) = state.try_get_value() {
                shown.set(Some(Computed { value, setup: Arc::clone(&setup), took_ms: now - begin }));
            }
        }
        if is_last {
            exploration.work.set(None);
        }
    };
    exploration.slices.set_value(Some(Slices::start(step, after_slice)));
}
