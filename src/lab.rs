//! The state of the laboratory that all benches share.

use std::ops::Deref;

use leptos::prelude::*;

use super::benches::BenchEntry;
use super::canvas;
use super::depth::Depth;
use super::format::NumberStyle;
use super::frames::FrameScheduler;
use super::lessons::{LoadError, SidePage};
use super::session::{Bench, Lock, Panel, Session};
use super::start::StartFlags;
use super::texts::Language;
use super::widgets::Picture;
use quadtank::literature::PresetId;
use quadtank_figure::{Palette, Style};
use quadtank_scenario::{CsvStyle, Document, ScenarioError, Scenes};

/// For an audience charts are so much larger as the window is wider than this (CSS px), within limits.
const PRESENTED_AT_PX: f64 = 860.0;
const MAX_MAGNIFIED: f64 = 2.0;

/// A notice at the top of the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// The link or file was not usable; the bench shows what it showed before.
    Refused(ScenarioError),
    /// What is shown could not be written as a link or file.
    NotWritten(ScenarioError),
    /// A new edition of the site is at hand.
    NewEdition,
    /// A lesson cannot be shown.
    NoLesson(LoadError),
    /// The browser could not read the file.
    NotRead,
    /// Parts of the address were not understood: which.
    NotUnderstood(Vec<String>),
    /// The link is on the clipboard.
    Copied,
    /// The link is on the clipboard, but leads to a file of this computer.
    CopiedFileLink,
    /// The clipboard is out of reach: here is the link.
    CopyByHand(String),
    /// A table is on the clipboard.
    TableCopied,
    /// The clipboard is out of reach, so a table is not on it.
    TableNotCopied,
    /// The browser remembers the link of the last experiment.
    Continue(String),
    /// What is shown was added to the scenes, as which.
    SceneAdded(usize),
    /// A scene was removed from these.
    SceneRemoved(Scenes),
    /// A link or file brought other scenes than these.
    ScenesReplaced(Scenes),
    /// What was loaded, by its name; it can be undone.
    Loaded(String),
    /// A rig was handed to relays with a dead time of its own (s), without which no relay would swing it.
    DeadTimeAdded(f64),
    /// The valves of a published rig were taken over; its tuning is an action of its own.
    ValvesOf(PresetId),
    /// The browser keeps nothing of this page: it is in a sandbox. An embedded page can hand its experiment to the whole laboratory.
    NotKept { is_embedded: bool },
}

/// The state of the laboratory, which lives as long as the page. A handle of one pointer: views hold many of them, and what
/// they hold is copied through all layers of Leptos.
#[derive(Clone, Copy)]
pub struct Lab(&'static State);

impl Deref for Lab {
    type Target = State;

    fn deref(&self) -> &State {
        self.0
    }
}

/// What all benches share.
pub struct State {
    /// The benches of this page.
    pub benches: &'static [BenchEntry],
    /// The bench that is shown.
    pub bench: RwSignal<&'static BenchEntry>,
    /// Throttled texts are being updated.
    texts_update: Trigger,
    /// The language of the texts.
    pub language: RwSignal<Language>,
    /// Separator and decimal sign of CSV; `None` for those of the language.
    pub csv_style: RwSignal<Option<CsvStyle>>,
    /// Whether the theme is dark.
    pub dark: RwSignal<bool>,
    /// The notice at the top of the page.
    pub notice: RwSignal<Option<Notice>>,
    /// How much of a bench is shown at once.
    pub depth: RwSignal<Depth>,
    /// Whether the page is shown to an audience: large, and without what surrounds the bench.
    presents: RwSignal<bool>,
    /// The card that fills the window, by its name, where one does.
    pub large: RwSignal<Option<&'static str>>,
    /// The page that is shown in place of the benches, if one is.
    pub side: RwSignal<Option<SidePage>>,
    /// Whether a pointer is pressed and moves, on whatever it is.
    pub is_dragging: RwSignal<bool>,
    /// The scenes of a lecture.
    pub scenes: RwSignal<Scenes>,
    /// The scene that is shown, by its place, while a lecture is going on.
    pub scene: RwSignal<Option<usize>>,
    /// The stop of the tour that is shown, while there is one.
    pub tour: RwSignal<Option<usize>>,
    /// Whether the site works without a network.
    pub offline: RwSignal<bool>,
    /// What a lesson shows of the bench beside it, while one is taken.
    pub stage: RwSignal<Option<Stage>>,
    /// How much of a bench is shown when the page begins, which says what a bench begins with.
    pub first_depth: Depth,
    /// Whether it was said that nothing is kept.
    pub told_not_kept: StoredValue<bool>,
    /// How the page was started.
    pub flags: StoredValue<StartFlags>,
    /// The pictures of the page, in the order in which they were made.
    figures: StoredValue<Vec<Figure>>,
    /// Owns what stays when benches change.
    owner: Owner,
}

/// What a lesson shows of a bench.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stage {
    /// The bench.
    pub bench: &'static str,
    /// The cards that are shown, in their order.
    pub panels: Vec<&'static str>,
    /// The groups of controls that are disabled.
    pub locks: Vec<&'static str>,
    /// Whether more cards come once the tasks are done.
    pub is_covered: bool,
}

/// A chart of a card, registered so that the handout can print it.
#[derive(Clone)]
pub struct Figure {
    /// Its charts.
    pub picture: Picture,
    /// What it says.
    pub summary: Signal<String>,
    /// Whether it can be seen.
    pub is_shown: Signal<bool>,
}

/// The laboratory of this page.
pub fn use_lab() -> Lab {
    expect_context()
}

impl Lab {
    /// A laboratory with these benches, of which the first is shown if the flags name none.
    pub fn new(
        benches: &'static [BenchEntry],
        language: Language,
        dark: bool,
        depth: Depth,
        flags: StartFlags,
    ) -> Self {
        Self(Box::leak(Box::new(State {
            benches,
            bench: RwSignal::new(flags.bench.unwrap_or(&benches[0])),
            texts_update: Trigger::new(),
            language: RwSignal::new(language),
            csv_style: RwSignal::new(None),
            dark: RwSignal::new(dark),
            notice: RwSignal::new(None),
            depth: RwSignal::new(depth),
            presents: RwSignal::new(false),
            large: RwSignal::new(None),
            side: RwSignal::new(flags.page),
            is_dragging: RwSignal::new(false),
            scenes: RwSignal::new(Scenes::default()),
            scene: RwSignal::new(None),
            tour: RwSignal::new(None),
            offline: RwSignal::new(false),
            stage: RwSignal::new(None),
            first_depth: depth,
            told_not_kept: StoredValue::new(false),
            flags: StoredValue::new(flags),
            figures: StoredValue::new(Vec::new()),
            owner: Owner::current().unwrap_or_default(),
        })))
    }

    /// Follows a document. The values of its controls are updated with its throttled texts.
    pub(super) fn follow<T: Clone + PartialEq + Send + Sync + 'static>(
        self,
        document: RwSignal<T>,
        compute: impl Fn() -> Option<Box<dyn FnOnce()>> + 'static,
        update_texts: impl Fn() + 'static,
    ) {
        let update_texts = move || {
            update_texts();
            self.texts_update.notify();
        };
        FrameScheduler::follow(document, compute, update_texts);
    }

    /// A value as texts show it: updated with them, not in every frame. Handlers read the value itself.
    pub fn throttled<T: Clone + Send + Sync + 'static>(self, value: Signal<T>) -> Signal<T> {
        Signal::derive(move || {
            self.track_texts();
            value.get_untracked()
        })
    }

    /// The same, and at once when the control that shows it is `moved` itself.
    pub fn throttled_or<T: Clone + Send + Sync + 'static>(self, moved: Trigger, value: Signal<T>) -> Signal<T> {
        Signal::derive(move || {
            moved.track();
            self.track_texts();
            value.get_untracked()
        })
    }

    /// Follows the updates of throttled texts, and the language.
    pub(super) fn track_texts(self) {
        self.texts_update.track();
        self.language.track();
    }

    /// The session of a bench. It is made when the bench is shown for the first time and stays.
    pub fn session<B: Bench>(self) -> Session<B> {
        self.owner.with(|| {
            use_context().unwrap_or_else(|| {
                let session = Session::<B>::start(self, B::usual(self));
                provide_context(session);
                session
            })
        })
    }

    /// Makes a document the one of its bench.
    pub fn open_in<B: Bench>(self, document: B::Document) {
        self.owner.with(|| match use_context::<Session<B>>() {
            Some(session) => session.document.set(document),
            None => provide_context(Session::<B>::start(self, document)),
        });
    }

    /// Opens a document of a link or a file and shows its bench.
    pub fn open(self, outcome: Result<Document, ScenarioError>) {
        let mut document = match outcome {
            Ok(document) => document,
            Err(error) => return self.notice.set(Some(Notice::Refused(error))),
        };
        self.notice.set(None);
        for bench in self.benches {
            match (bench.open)(self, document) {
                None => return self.bench.set(bench),
                Some(other) => document = other,
            }
        }
    }

    /// The place of a card among those of a lesson, which says what the student sees first; nothing without a lesson.
    pub fn place_of(self, panel: Panel) -> Option<usize> {
        self.stage.with_untracked(|stage| stage.as_ref()?.panels.iter().position(|shown| *shown == panel.0))
    }

    /// Whether a card is shown.
    pub fn shows(self, panel: Panel) -> bool {
        debug_assert!(self.benches.iter().any(|bench| bench.panels.contains(&panel)), "no bench lists {panel:?}");
        match self.stage.with_untracked(|stage| stage.as_ref().map(|stage| stage.panels.contains(&panel.0))) {
            Some(is_shown) => is_shown,
            None => self.flags.with_value(|flags| flags.shows(panel)),
        }
    }

    /// Whether a group of controls is disabled.
    pub fn locks(self, lock: Lock) -> bool {
        debug_assert!(self.benches.iter().any(|bench| bench.locks.contains(&lock)), "no bench lists {lock:?}");
        match self.stage.with_untracked(|stage| stage.as_ref().map(|stage| stage.locks.contains(&lock.0))) {
            Some(is_locked) => is_locked,
            None => self.flags.with_value(|flags| flags.locks(lock)),
        }
    }

    /// Takes a picture up until the view that makes it goes.
    pub fn add_figure(self, figure: Figure) {
        let shown = figure.is_shown;
        self.figures.update_value(|figures| figures.push(figure));
        on_cleanup(move || self.figures.update_value(|figures| figures.retain(|other| other.is_shown != shown)));
    }

    /// The pictures that can be seen.
    pub fn shown_figures(self) -> Vec<Figure> {
        let is_shown = |figure: &&Figure| figure.is_shown.try_get_untracked() == Some(true);
        self.figures.with_value(|figures| figures.iter().filter(is_shown).cloned().collect())
    }

    /// How the chosen language writes numbers.
    pub fn number_style(self) -> NumberStyle {
        self.language.get().number_style()
    }

    /// How charts look in the chosen theme and language.
    pub fn chart_style(self) -> Style {
        let palette = if self.dark.get() { Palette::DARK } else { Palette::LIGHT };
        Style { palette, decimal: self.number_style().decimal, scale: canvas::FINE }
    }

    /// How much of the bench is shown.
    pub fn shown_depth(self) -> Depth {
        // The cards of a lesson are chosen by its step.
        if self.stage.with(Option::is_some) {
            return Depth::Full;
        }
        self.bench.get().depth(self.depth.get())
    }

    /// Whether the bench is shown to an audience.
    pub fn is_presenting(self) -> bool {
        self.presents.get() && self.bench.get().can_present
    }

    /// Begins or ends showing the bench to an audience.
    pub fn present(self, presents: bool) {
        // A lesson and the pages beside the benches have a layout of their own.
        let is_bench = self.side.get_untracked().is_none() && self.stage.with_untracked(Option::is_none);
        self.presents.set(presents && is_bench && self.bench.get_untracked().can_present);
    }

    /// How much larger charts are painted than usual, with their words and lines.
    pub fn magnification(self) -> f64 {
        let width = || window().inner_width().ok().and_then(|width| width.as_f64()).unwrap_or_default();
        if self.is_presenting() { (width() / PRESENTED_AT_PX).clamp(1.0, MAX_MAGNIFIED) } else { 1.0 }
    }
}
