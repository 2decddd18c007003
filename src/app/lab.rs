//! The state of the laboratory and the way of one change through it.
//!
//! A control edits [`Lab::scenario`]. That asks for one animation frame; in it, what the change touched is computed once
//! (however many events came in between), the results are set, and the charts that show them repaint, all before the
//! browser shows the frame. Reading, computing and painting never mix.

use std::sync::Arc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;

use super::canvas;
use super::format::NumberStyle;
use super::start::{Control, StartFlags};
use super::texts::Language;
use super::timing::Stopwatch;
use crate::figure::{Palette, Style};
use crate::plant::DisplayUnit;
use crate::scenario::{self, Analysis, Run, Scenario, ScenarioError, Setup};

/// A result that a panel may show, or why there is none.
pub type Outcome<T> = Arc<Result<T, ScenarioError>>;

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
    /// The setup that the results are of. Charts read this one, so that they paint when results come, not before.
    pub computed: RwSignal<Arc<Setup>>,
    /// What theory says.
    pub analysis: RwSignal<Outcome<Analysis>>,
    /// What happens.
    pub run: RwSignal<Outcome<Run>>,
    /// The pinned runs, in the order of the scenario.
    pub pinned: RwSignal<Arc<Vec<Outcome<Run>>>>,
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
    computed_pinned: StoredValue<Vec<Setup>>,
    stopwatch: StoredValue<Stopwatch>,
    after_frame: StoredValue<Option<Timeout>, LocalStorage>,
}

/// The laboratory of this page.
pub fn use_lab() -> Lab {
    expect_context()
}

impl Lab {
    /// A laboratory that shows `scenario`, computed at once.
    pub fn new(scenario: Scenario, language: Language, dark: bool, flags: StartFlags) -> Self {
        let (analysis, run) = (scenario::analyse(&scenario.setup), scenario::run(&scenario.setup));
        let (computed, pinned) = (scenario.setup.clone(), scenario.pinned.clone());
        let scenario = RwSignal::new(scenario);
        let lab = Self {
            analysis: RwSignal::new(Arc::new(analysis)),
            run: RwSignal::new(Arc::new(run)),
            pinned: RwSignal::new(run_all(&pinned)),
            computed: RwSignal::new(Arc::new(computed)),
            computed_pinned: StoredValue::new(pinned),
            unit: Memo::new(move |_| scenario.with(|s| s.setup.display_unit())).into(),
            scenario,
            language: RwSignal::new(language),
            dark: RwSignal::new(dark),
            notice: RwSignal::new(None),
            flags: StoredValue::new(flags),
            stopwatch: StoredValue::new(Stopwatch::default()),
            after_frame: StoredValue::new_local(None),
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
        if self.stopwatch.try_update_value(Stopwatch::begin) == Some(true) {
            request_animation_frame(move || self.frame());
        }
    }

    /// One frame: compute what changed since the last one, hand it to the panels, and note how long it took.
    fn frame(self) {
        let Some(after) = self.scenario.try_get_untracked() else { return };
        let before = self.computed.get_untracked();
        self.stopwatch.update_value(Stopwatch::start_computing);
        let theory = (!same_theory(&before, &after.setup)).then(|| Arc::new(scenario::analyse(&after.setup)));
        let run = (*before != after.setup).then(|| Arc::new(scenario::run(&after.setup)));
        let pinned = self.computed_pinned.with_value(|p| *p != after.pinned).then(|| run_all(&after.pinned));
        self.stopwatch.update_value(Stopwatch::stop_computing);
        if run.is_some() {
            self.computed.set(Arc::new(after.setup));
        }
        if let Some(theory) = theory {
            self.analysis.set(theory);
        }
        if let Some(run) = run {
            self.run.set(run);
        }
        if let Some(pinned) = pinned {
            self.computed_pinned.set_value(after.pinned);
            self.pinned.set(pinned);
        }
        let stopwatch = self.stopwatch;
        // A task after this frame: by then the panels have repainted.
        let after = Timeout::new(0, move || {
            stopwatch.try_update_value(Stopwatch::end);
        });
        // Kept, not forgotten: a forgotten timer is never freed.
        self.after_frame.set_value(Some(after));
    }
}

/// Theory does not depend on the experiment.
fn same_theory(a: &Setup, b: &Setup) -> bool {
    a.plant == b.plant && a.valves == b.valves && a.operating_point == b.operating_point && a.controller == b.controller
}

fn run_all(setups: &[Setup]) -> Arc<Vec<Outcome<Run>>> {
    Arc::new(setups.iter().map(|s| Arc::new(scenario::run(s))).collect())
}
