//! The state of the laboratory: what all benches share, and the document and results of the home bench.
//!
//! A control edits [`Lab::scenario`]; the [pace](super::pace) takes the change up.

use std::ops::Deref;
use std::sync::Arc;

use leptos::prelude::*;

use super::canvas;
use super::format::NumberStyle;
use super::pace::Pace;
use super::results::{Results, run_all};
use super::start::{Bench, Control, StartFlags};
use super::texts::Language;
use quadtank::literature::DisplayUnit;
use quadtank::study::quadruple_tank::Setup;
use quadtank_figure::{Palette, Style};
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{Document, Scenario, ScenarioError};

/// Something to tell at the top of the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// The link or file was not usable; the bench shows what it showed before.
    Refused(ScenarioError),
    /// The browser could not read the file.
    NotRead,
    /// The link is on the clipboard.
    Copied,
    /// The clipboard is out of reach: here is the link.
    CopyByHand(String),
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

/// What all benches share, and the document and results of the home bench.
pub struct State {
    /// The document that all of it follows from.
    pub scenario: RwSignal<Scenario>,
    /// The results for the charts, new in every frame.
    pub charts: Results,
    /// The same for words, numbers and the drawing, once the charts are on the screen.
    pub words: Results,
    /// Words and numbers are being told.
    telling: Trigger,
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
    /// The bench that is shown.
    pub bench: RwSignal<Bench>,
    /// The document of the relay-tuning bench.
    pub tuning: RwSignal<TuningScenario>,
    /// The document of the model-free bench.
    pub model_free: RwSignal<ModelFreeScenario>,
    /// Owns what stays when benches change.
    owner: Owner,
    /// The setups of the pinned runs that are computed.
    pinned: StoredValue<Vec<Setup>>,
}

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
        let lab = Self(Box::leak(Box::new(State {
            charts,
            words: charts.shared(),
            telling: Trigger::new(),
            unit: Memo::new(move |_| scenario.with(|s| s.setup.plant.display_unit())).into(),
            scenario,
            language: RwSignal::new(language),
            dark: RwSignal::new(dark),
            notice: RwSignal::new(None),
            bench: RwSignal::new(flags.bench),
            tuning: RwSignal::new(TuningScenario::default()),
            flags: StoredValue::new(flags),
            model_free: RwSignal::new(ModelFreeScenario::default()),
            owner: Owner::current().unwrap_or_default(),
            pinned: StoredValue::new(pinned),
        })));
        lab.follow(lab.scenario, move || lab.compute(), move || lab.words.follow(lab.charts));
        lab
    }

    /// Follows a document; whenever its words are told, so are the values of its controls.
    pub fn follow<T: Send + Sync + 'static>(
        self,
        document: RwSignal<T>,
        compute: impl Fn() -> Option<Box<dyn FnOnce()>> + 'static,
        tell: impl Fn() + 'static,
    ) {
        let tell = move || {
            tell();
            self.telling.notify();
        };
        Pace::follow(document, compute, tell);
    }

    /// A value as the page shows it: it changes with the words, not in every frame. Handlers read the value itself.
    pub fn told<T: Clone + Send + Sync + 'static>(self, value: Signal<T>) -> Signal<T> {
        Signal::derive(move || {
            self.follow_words();
            value.get_untracked()
        })
    }

    /// The same, and at once when the control that shows it is `moved` itself.
    pub fn told_or<T: Clone + Send + Sync + 'static>(self, moved: Trigger, value: Signal<T>) -> Signal<T> {
        Signal::derive(move || {
            moved.track();
            self.follow_words();
            value.get_untracked()
        })
    }

    fn follow_words(self) {
        self.telling.track();
        self.language.track();
    }

    /// The state of a bench. It is made when the bench is shown for the first time and stays.
    pub fn kept<S: Clone + Send + Sync + 'static>(self, start: fn(Self) -> S) -> S {
        self.owner.with(|| {
            use_context().unwrap_or_else(|| {
                let state = start(self);
                provide_context(state.clone());
                state
            })
        })
    }

    /// The id of a bench: that of the page while it is shown.
    pub fn id_of(self, bench: Bench) -> Option<String> {
        (self.bench.get() == bench).then(|| "bench".to_owned())
    }

    /// Changes the run that is worked on.
    pub fn edit(self, change: impl FnOnce(&mut Setup)) {
        self.scenario.update(|s| change(&mut s.setup));
    }

    /// Replaces the whole document, as a link or a file does, and shows its bench.
    pub fn open(self, outcome: Result<Document, ScenarioError>) {
        match outcome {
            Ok(Document::Quadruple(scenario)) => {
                self.scenario.set(scenario);
                self.bench.set(Bench::QuadrupleTank);
            }
            Ok(Document::Tuning(scenario)) => {
                self.tuning.set(scenario);
                self.bench.set(Bench::RelayTuning);
            }
            Ok(Document::ModelFree(scenario)) => {
                self.model_free.set(scenario);
                self.bench.set(Bench::ModelFree);
            }
            Err(error) => return self.notice.set(Some(Notice::Refused(error))),
        }
        self.notice.set(None);
    }

    /// A part of the setup, for controls.
    pub fn part<T>(self, read: impl Fn(&Setup) -> T + Send + Sync + 'static) -> Signal<T>
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

    /// Computes what changed; what it returns hands that to the panels.
    fn compute(self) -> Option<Box<dyn FnOnce()>> {
        let after = self.scenario.try_get_untracked()?;
        let before = self.charts.setup.get_untracked();
        let theory = (!same_theory(&before, &after.setup))
            .then(|| Arc::new(quadtank::study::quadruple_tank::analyse(&after.setup)));
        let run = (*before != after.setup).then(|| {
            // A run may take megabytes: the last one goes before the next is made. Words may still hold the one they tell.
            *self.charts.run.write_untracked() = self.words.run.get_untracked();
            Arc::new(quadtank::study::quadruple_tank::run(&after.setup))
        });
        let pinned = self.pinned.with_value(|pinned| *pinned != after.pinned).then(|| run_all(&after.pinned));
        Some(Box::new(move || {
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
                self.pinned.set_value(after.pinned);
                self.charts.pinned.set(pinned);
            }
        }))
    }
}

/// Theory does not depend on the experiment.
fn same_theory(a: &Setup, b: &Setup) -> bool {
    a.plant == b.plant && a.valves == b.valves && a.operating_point == b.operating_point && a.controller == b.controller
}
