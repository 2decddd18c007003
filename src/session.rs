//! A bench on the page: its document, its results, and how these follow the document.

use std::ops::Deref;
use std::sync::Arc;

use leptos::prelude::*;
use quadtank::study::{Quantity, Study};
use quadtank_scenario::BenchDocument;

use super::depth::Depth;
use super::history::History;
use super::lab::{Lab, use_lab};

/// A bench: a study, its document, and the cards that show it. [`BENCHES`](super::benches::BENCHES) lists them.
pub trait Bench: Sized + 'static {
    /// Its name in an address.
    const ID: &'static str;
    /// A small picture for the navigation: the path of a drawing 48 wide and 32 high.
    const PICTURE: &'static str;
    /// Class of the element that holds its cards.
    const CLASS: &'static str;
    /// How much of it can be shown at once: one picture to begin with, or every card.
    const DEPTHS: &'static [Depth] = &[Depth::Full];
    /// Whether it has a layout for an audience.
    const CAN_PRESENT: bool = false;
    /// The cards that `panels=` can name.
    const PANELS: &'static [Panel] = &[];
    /// The groups of controls that `lock=` can name.
    const LOCKS: &'static [Lock] = &[];
    /// What files and links hold.
    type Document: BenchDocument<Setup = SetupOf<Self>> + Send + Sync;
    /// What computes the results.
    type Study: Study<Setup: Send + Sync, Results: Send + Sync>;
    /// The results, each part as a signal of its own.
    type Found: Copy + Send + Sync;
    /// What the bench remembers besides, such as the unit that follows from the document.
    type Own: Copy + Send + Sync;

    /// The parts of results, see [`part_of`].
    fn found(results: RwSignal<ResultsOf<Self>>) -> Self::Found;

    /// How a unit of a quantity is written, where the document says it: what is not known to it is written as it is.
    fn unit_name(_session: Session<Self>, unit: &str) -> String {
        unit.to_owned()
    }

    /// What a card is called, for who chooses cards by name.
    fn panel_title(_lab: Lab, panel: Panel) -> String {
        panel.0.to_owned()
    }

    /// What is remembered besides.
    fn own(document: RwSignal<Self::Document>) -> Self::Own;

    /// The document that it begins with where no link or file says another: the start flags may ask for one.
    fn usual(_lab: Lab) -> Self::Document {
        Self::Document::default()
    }

    /// What the navigation calls it.
    fn title(lab: Lab) -> String;

    /// One line on what one does there.
    fn about(lab: Lab) -> String;

    /// The cards that the start flags ask for.
    fn cards(session: Session<Self>) -> AnyView;
}

/// A card of a bench, by its name in an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Panel(pub &'static str);

/// A group of controls that can be disabled, by its name in an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lock(pub &'static str);

/// The setup of a bench.
pub type SetupOf<B> = <<B as Bench>::Study as Study>::Setup;
/// The results of a bench.
pub type ResultsOf<B> = <<B as Bench>::Study as Study>::Results;

/// A result that a panel may show, or why there is none.
pub type Outcome<T, E> = Arc<Result<T, E>>;

/// A part of results as a signal, which changes when that part does: views of it leave changes of other parts alone.
pub fn part_of<R, T>(results: RwSignal<R>, part: fn(&R) -> &Arc<T>) -> Memo<Arc<T>>
where
    R: Send + Sync + 'static,
    T: Send + Sync + 'static,
{
    Memo::new_with_compare(
        move |_| results.with(|results| Arc::clone(part(results))),
        |before, after| !before.zip(after).is_some_and(|(before, after)| Arc::ptr_eq(before, after)),
    )
}

/// A bench with its state, which stays when another one is shown. A handle of one pointer, as [`Lab`].
pub struct Session<B: Bench>(&'static State<B>);

impl<B: Bench> Clone for Session<B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B: Bench> Copy for Session<B> {}

impl<B: Bench> Deref for Session<B> {
    type Target = State<B>;

    fn deref(&self) -> &State<B> {
        self.0
    }
}

/// The document of a bench and what follows from it.
pub struct State<B: Bench> {
    /// What all benches share.
    pub lab: Lab,
    /// The document that all of it follows from. A control edits it; the [frame scheduler](super::frames) takes the change up.
    pub document: RwSignal<B::Document>,
    /// The results for charts, new in every frame.
    pub charts: B::Found,
    /// The same for sentences, tables and drawings: throttled, and once the charts are on the screen.
    pub throttled: B::Found,
    /// What the bench remembers besides.
    pub own: B::Own,
    /// The steps that can be undone.
    history: RwSignal<History<B::Document>>,
    results: RwSignal<ResultsOf<B>>,
    throttled_results: RwSignal<ResultsOf<B>>,
}

/// The session of a bench on this page.
pub fn use_session<B: Bench>() -> Session<B> {
    use_lab().session()
}

impl<B: Bench> Session<B> {
    /// A session that shows `document`, computed at once.
    pub(super) fn start(lab: Lab, document: B::Document) -> Self {
        let found = B::Study::update(document.setup(), document.pinned(), None);
        let (results, throttled_results) = (RwSignal::new(found.clone()), RwSignal::new(found));
        let history = RwSignal::new(History::new(document.clone()));
        let document = RwSignal::new(document);
        let session = Self(Box::leak(Box::new(State {
            lab,
            document,
            charts: B::found(results),
            throttled: B::found(throttled_results),
            own: B::own(document),
            history,
            results,
            throttled_results,
        })));
        let update_texts = move || session.throttled_results.set(session.results.get_untracked());
        lab.follow(document, move || session.compute(), update_texts);
        session
    }

    /// Computes the results of the changed document; the returned closure publishes them to the views.
    fn compute(self) -> Option<Box<dyn FnOnce()>> {
        let update = |document: &B::Document| {
            self.results.with_untracked(|last| B::Study::update(document.setup(), document.pinned(), Some(last)))
        };
        let found = self.document.try_with_untracked(update)?;
        Some(Box::new(move || self.results.set(found)))
    }

    /// Takes the document up as a step that can be undone.
    pub fn record(self) {
        self.document.with_untracked(|document| self.history.update(|history| history.record(document)));
    }

    /// Undoes the last recorded step.
    pub fn undo(self) {
        if let Some(before) = self.history.try_update(History::undo).flatten() {
            self.document.set(before);
        }
    }

    /// Does again what was undone last.
    pub fn redo(self) {
        if let Some(after) = self.history.try_update(History::redo).flatten() {
            self.document.set(after);
        }
    }

    /// Whether there is a step to undo, and one to do again.
    pub fn can_undo_redo(self) -> (bool, bool) {
        self.history.with(|history| (history.can_undo(), history.can_redo()))
    }

    /// What `read` makes of the setup.
    pub fn read<T>(self, read: impl FnOnce(&SetupOf<B>) -> T) -> T {
        self.document.with(|document| read(document.setup()))
    }

    /// Changes the setup.
    pub fn edit(self, change: impl FnOnce(&mut SetupOf<B>)) {
        self.document.update(|document| change(document.setup_mut()));
    }

    /// A quantity by its name and its unit, of the results of the last frame; follows them.
    pub fn quantity(self, name: &str) -> Option<(f64, &'static str)> {
        let quantity = Quantity::find(B::Study::QUANTITIES, name)?;
        let value = self.results.with(|results| quantity.value(results))?;
        Some((value, quantity.unit))
    }

    /// A part of the setup, for controls.
    pub fn part<T>(self, read: impl Fn(&SetupOf<B>) -> T + Send + Sync + 'static) -> Signal<T>
    where
        T: PartialEq + Send + Sync + 'static,
    {
        Memo::new(move |_| self.read(&read)).into()
    }

    /// A part of the setup as texts show it, see [`Lab::throttled`].
    pub fn throttled_part<T>(self, read: fn(&SetupOf<B>) -> T) -> Signal<T>
    where
        T: Send + Sync + 'static,
    {
        Signal::derive(move || self.throttled_results.with(|results| read(B::Study::setup_of(results))))
    }
}
