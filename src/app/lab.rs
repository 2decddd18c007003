//! The state of the laboratory and the way of one change through it.
//!
//! A control edits [`Lab::scenario`]. That asks for one animation frame; in it, what the change touched is computed once
//! (however many events came in between), the results are set, and the charts that show them repaint, all before the
//! browser shows the frame. Words, numbers and the drawing follow as soon as that frame is on the screen: they cost the
//! browser more than the charts do, and nobody reads while dragging. Reading, computing, painting and telling never mix.

use std::sync::Arc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;

use super::canvas;
use super::format::NumberStyle;
use super::results::{Results, run_all};
use super::start::{Control, StartFlags};
use super::texts::Language;
use super::timing::Stopwatch;
use crate::figure::{Palette, Style};
use crate::plant::DisplayUnit;
use crate::scenario::{self, Scenario, ScenarioError, Setup};

/// Something to tell at the top of the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// The link or file was not usable; the bench shows what it showed before.
    Refused(ScenarioError),
    /// The link is on the clipboard.
    Copied,
    /// The clipboard is out of reach: here is the link.
    CopyByHand(String),
}

/// The state of the laboratory. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
pub struct Lab {
    /// The document that all of it follows from.
    pub scenario: RwSignal<Scenario>,
    /// The results for the charts, new in every frame.
    pub charts: Results,
    /// The same for words, numbers and the drawing, once the charts are on the screen.
    pub words: Results,
    /// The unit in which levels are shown.
    pub unit: Signal<DisplayUnit>,
    /// The language of the texts.
    pub language: RwSignal<Language>,
    /// Whether the theme is dark.
    pub dark: RwSignal<bool>,
    /// What to tell at the top of the page.
    pub notice: RwSignal<Option<Notice>>,
    /// How the page was started.
    pub flags: StoredValue<StartFlags>,
    backstage: StoredValue<Backstage, LocalStorage>,
}

/// What no view shows.
#[derive(Default)]
struct Backstage {
    stopwatch: Stopwatch,
    /// What comes after the frame. Kept, not forgotten: a forgotten timer is never freed.
    next: Option<Timeout>,
    /// What comes after the words.
    told: Option<Timeout>,
    /// The setups of the pinned runs that are computed.
    pinned: Vec<Setup>,
}

/// Words that have to wait come when nothing has changed for so long (ms).
const PAUSE_MS: u32 = 40;

/// The laboratory of this page.
pub fn use_lab() -> Lab {
    expect_context()
}

impl Lab {
    /// A laboratory that shows `scenario`, computed at once.
    pub fn new(scenario: Scenario, language: Language, dark: bool, flags: StartFlags) -> Self {
        let charts = Results::of(&scenario);
        let pinned = scenario.pinned.clone();
        let scenario = RwSignal::new(scenario);
        let lab = Self {
            charts,
            words: charts.shared(),
            unit: Memo::new(move |_| scenario.with(|s| s.setup.display_unit())).into(),
            scenario,
            language: RwSignal::new(language),
            dark: RwSignal::new(dark),
            notice: RwSignal::new(None),
            flags: StoredValue::new(flags),
            backstage: StoredValue::new_local(Backstage { pinned, ..Backstage::default() }),
        };
        Effect::new(move || {
            lab.scenario.track();
            lab.request_frame();
        });
        lab
    }

    /// Changes the run that is worked on.
    pub fn edit(self, change: impl FnOnce(&mut Setup)) {
        self.scenario.update(|s| change(&mut s.setup));
    }

    /// Replaces the whole document, as a link or a file does.
    pub fn open(self, outcome: Result<Scenario, ScenarioError>) {
        match outcome {
            Ok(scenario) => {
                self.scenario.set(scenario);
                self.notice.set(None);
            }
            Err(error) => self.notice.set(Some(Notice::Refused(error))),
        }
    }

    /// A part of the setup, for controls.
    pub fn part<T>(self, read: impl Fn(&Setup) -> T + Send + Sync + 'static) -> Signal<T>
    where
        T: PartialEq + Send + Sync + 'static,
    {
        self.boxed_part(Box::new(read))
    }

    /// Compiled once for each kind of part rather than for each part.
    fn boxed_part<T>(self, read: Box<dyn Fn(&Setup) -> T + Send + Sync>) -> Signal<T>
    where
        T: PartialEq + Send + Sync + 'static,
    {
        let scenario = self.scenario;
        Memo::new(move |_| scenario.with(|s| read(&s.setup))).into()
    }

    /// Whether a group of controls is disabled.
    pub fn locks(self, control: Control) -> bool {
        self.flags.with_value(|f| f.locks(control))
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

    fn request_frame(self) {
        if self.backstage.try_update_value(|b| b.stopwatch.begin()) == Some(true) {
            request_animation_frame(move || self.frame());
        }
    }

    /// One frame: compute what changed since the last one, hand it to the panels, and note how long it took.
    fn frame(self) {
        let Some(after) = self.scenario.try_get_untracked() else { return };
        let before = self.charts.setup.get_untracked();
        self.backstage.update_value(|b| b.stopwatch.start_computing());
        let theory = (!same_theory(&before, &after.setup)).then(|| Arc::new(scenario::analyse(&after.setup)));
        let run = (*before != after.setup).then(|| {
            // A run may take megabytes: the last one goes before the next is made. Words may still hold the one they tell.
            self.charts.run.update_untracked(|last| *last = self.words.run.get_untracked());
            Arc::new(scenario::run(&after.setup))
        });
        let pinned = self.backstage.with_value(|b| b.pinned != after.pinned).then(|| run_all(&after.pinned));
        self.backstage.update_value(|b| b.stopwatch.stop_computing());
        if run.is_some() {
            self.charts.setup.set(Arc::new(after.setup));
        }
        if let Some(theory) = theory {
            self.charts.analysis.set(theory);
        }
        if let Some(run) = run {
            self.charts.run.set(run);
        }
        if let Some(pinned) = pinned {
            self.backstage.update_value(|b| b.pinned = after.pinned);
            self.charts.pinned.set(pinned);
        }
        // A task after this frame: by then the charts are painted.
        self.after(0, Self::painted);
    }

    /// The charts are on the screen: the words follow, at once if it is time for them.
    fn painted(self) {
        let told_now = self.backstage.try_update_value(|b| {
            b.stopwatch.end();
            b.stopwatch.are_words_due()
        });
        match told_now {
            Some(true) => self.tell(),
            // The next frame replaces this timer and decides anew.
            Some(false) => self.after(PAUSE_MS, Self::tell),
            None => {}
        }
    }

    fn after(self, delay_ms: u32, next: fn(Self)) {
        let timer = Timeout::new(delay_ms, move || next(self));
        self.backstage.try_update_value(|b| b.next = Some(timer));
    }

    fn tell(self) {
        self.backstage.try_update_value(|b| b.stopwatch.tell());
        self.words.follow(self.charts);
        let told = Timeout::new(0, move || self.told());
        self.backstage.try_update_value(|b| b.told = Some(told));
    }

    fn told(self) {
        // Asking for a height lays the new words out now, not within the next frame of the charts.
        if let Some(page) = document().body() {
            page.offset_height();
        }
        self.backstage.try_update_value(|b| b.stopwatch.told());
    }
}

/// Theory does not depend on the experiment.
fn same_theory(a: &Setup, b: &Setup) -> bool {
    a.plant == b.plant && a.valves == b.valves && a.operating_point == b.operating_point && a.controller == b.controller
}
