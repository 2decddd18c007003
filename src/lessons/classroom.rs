//! The lesson that is taken: its step, what was answered, and the bench beside it.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::Arc;

use leptos::prelude::*;
use quadtank_lesson::{
    Answer, Lesson, Of, Progress, Record, Step, Task, TaskKind, Tongue, Values, Verdict, check, start_of, with_settings,
};
use quadtank_scenario::{Difference, Document, Quantities};

use super::course;
use super::kept;
use super::remarks::{Given, Remark};
use crate::benches::BenchEntry;
use crate::lab::{Lab, Stage};
use crate::session::Lock;
use crate::share::{kept_reference, lesson_reference, show_address};

/// The class room of this page. A handle of one pointer, as [`Lab`].
#[derive(Clone, Copy)]
pub struct Classroom(&'static State);

impl Deref for Classroom {
    type Target = State;

    fn deref(&self) -> &State {
        self.0
    }
}

/// What the class room holds.
pub struct State {
    lab: Lab,
    /// The lesson that is taken.
    pub lesson: RwSignal<Option<Arc<Lesson>>>,
    /// Its name in an address: an id, or the path of a file.
    name: StoredValue<String>,
    /// What was done in it.
    pub progress: RwSignal<Option<Progress>>,
    /// Whether the report is shown in place of a step.
    pub at_end: RwSignal<bool>,
    /// What was said last about each task of the open step.
    pub said: RwSignal<Vec<Remark>>,
    /// The last answer since the page was opened.
    pub given: RwSignal<Option<Given>>,
    /// What the open step has set otherwise than the bench stood before.
    pub changed: RwSignal<Vec<Difference>>,
    /// The state with which the step began.
    start: StoredValue<Option<Document>>,
    /// The states with which the steps began so far, by their places.
    starts: StoredValue<BTreeMap<usize, Document>>,
    /// The bench that was shown before the lessons, and what they put something else in place of: it comes back after them.
    before: StoredValue<Option<&'static BenchEntry>>,
    put_aside: StoredValue<Vec<(&'static BenchEntry, Document)>>,
    /// Whether the student has turned to another step.
    turned: StoredValue<bool>,
    /// When the clock of the lesson was read last (s).
    read_at_s: StoredValue<f64>,
}

/// The class room of this page.
pub fn use_classroom() -> Classroom {
    expect_context()
}

/// The bench as it stands, for tasks about it; follows its results.
pub struct Present(pub Lab);

impl Values for Present {
    fn value(&self, name: &str) -> Option<(f64, &'static str)> {
        (self.0.bench.get().quantity)(self.0, name)
    }
}

impl Classroom {
    /// A class room without a lesson.
    pub fn new(lab: Lab) -> Self {
        Self(Box::leak(Box::new(State {
            lab,
            lesson: RwSignal::new(None),
            name: StoredValue::new(String::new()),
            progress: RwSignal::new(None),
            at_end: RwSignal::new(false),
            said: RwSignal::new(Vec::new()),
            given: RwSignal::new(None),
            changed: RwSignal::new(Vec::new()),
            start: StoredValue::new(None),
            starts: StoredValue::new(BTreeMap::new()),
            before: StoredValue::new(None),
            put_aside: StoredValue::new(Vec::new()),
            turned: StoredValue::new(false),
            read_at_s: StoredValue::new(0.0),
        })))
    }

    /// Begins a lesson that an address calls `name`, or goes on with it at `step` or where it was left.
    pub fn begin(self, name: String, lesson: Lesson, step: Option<usize>) {
        self.keep();
        self.name.set_value(name);
        let progress = course::resumed(&lesson)
            .or_else(|| kept::read(&lesson))
            .unwrap_or_else(|| Progress::new(&lesson, kept::new_seed()));
        let step = step.filter(|step| *step < lesson.steps.len()).unwrap_or(progress.step);
        self.put_aside(&lesson.bench);
        self.read_at_s.set_value(now_s());
        self.start.set_value(None);
        self.starts.set_value(BTreeMap::new());
        batch(|| {
            self.at_end.set(false);
            self.progress.set(Some(progress));
            self.lesson.set(Some(Arc::new(lesson)));
        });
        self.open(step);
    }

    /// Puts the work on a bench aside, once, before a lesson takes the bench.
    fn put_aside(self, id: &str) {
        if self.before.with_value(Option::is_none) {
            self.before.set_value(Some(self.lab.bench.get_untracked()));
        }
        let is_aside = self.put_aside.with_value(|aside| aside.iter().any(|(bench, _)| bench.id == id));
        if let Some(bench) = self.lab.benches.iter().find(|bench| bench.id == id && !is_aside) {
            (bench.record)(self.lab);
            let document = (bench.document)(self.lab);
            self.put_aside.update_value(|aside| aside.push((bench, document)));
        }
    }

    /// Whether the open lesson has this name in an address.
    pub fn is_in(self, name: &str) -> bool {
        self.lesson.with_untracked(Option::is_some) && self.name.with_value(|taken| taken == name)
    }

    /// Opens a step: brings the bench into its state, and shows its cards.
    pub fn open(self, index: usize) {
        let Some(lesson) = self.lesson.get_untracked() else { return };
        let Some(step) = lesson.steps.get(index) else { return };
        let seed = self.progress.with_untracked(|progress| progress.as_ref().map_or(0, |progress| progress.seed));
        let kept = self.start.with_value(Option::is_some);
        // A step that keeps the state of the one before has none when the lesson begins with it.
        let known = self.starts.with_value(|starts| starts.get(&index).cloned());
        let start = match start_of(&lesson, step, seed) {
            // Whoever goes back finds the state of then.
            Ok(None) if known.is_some() => known,
            Ok(None) if !kept => quadtank_lesson::state_before(&lesson, index, 0, seed).ok(),
            start => start.ok().flatten(),
        };
        self.said.set(step.tasks.iter().filter_map(|task| Remark::before(task, &self.record(&task.id))).collect());
        self.at_end.set(false);
        self.progress.update(|progress| {
            if let Some(progress) = progress {
                progress.step = index;
            }
        });
        let document = || (self.lab.bench.get_untracked().document)(self.lab);
        let before = kept.then(document);
        if let Some(document) = start {
            self.lab.open(Ok(document));
        }
        self.lab.large.set(None);
        let present = document();
        self.changed.set(before.map(|before| before.differences(&present)).unwrap_or_default());
        self.starts.update_value(|starts| {
            starts.insert(index, present.clone());
        });
        self.start.set_value(Some(present));
        self.set_stage(&lesson, step);
        show_address(&self.name.with_value(|name| lesson_reference(name, index)));
        self.keep();
    }

    /// Shows the cards of a step; those that give the answer away come when its tasks are done.
    fn set_stage(self, lesson: &Lesson, step: &Step) {
        let Some(bench) = self.lab.benches.iter().find(|bench| bench.id == lesson.bench) else { return };
        let is_done = |task: &Task| self.record(&task.id).is_done();
        let reveals = step.tasks.iter().all(is_done);
        let is_shown = |name: &&String| reveals || !step.reveal.contains(name);
        let panel = |name: &String| bench.panels.iter().find(|panel| panel.0 == name).map(|panel| panel.0);
        let is_locked = |lock: &&Lock| step.lock.iter().any(|name| name == lock.0);
        let stage = Stage {
            bench: bench.id,
            panels: step.panels.iter().filter(is_shown).filter_map(panel).collect(),
            is_covered: !reveals && !step.reveal.is_empty(),
            locks: bench.locks.iter().filter(is_locked).map(|lock| lock.0).collect(),
        };
        if self.lab.stage.with_untracked(|shown| shown.as_ref() != Some(&stage)) {
            self.lab.stage.set(Some(stage));
        }
        self.lab.bench.set(bench);
    }

    /// Whether the student has turned to another step, who then begins to read at its title.
    pub fn turned(self) -> bool {
        self.turned.get_value()
    }

    /// Turns to another step.
    pub fn turn_to(self, index: usize) {
        self.turned.set_value(true);
        self.open(index);
    }

    /// Brings the bench back into the state with which the step began.
    pub fn start_over(self) {
        if let Some(document) = self.start.get_value() {
            self.lab.open(Ok(document));
        }
    }

    /// The step that is open, and its place.
    pub fn step(self) -> Option<(usize, Step)> {
        let index = self.progress.with(|progress| progress.as_ref().map(|progress| progress.step))?;
        self.lesson.with(|lesson| Some((index, lesson.as_ref()?.steps.get(index)?.clone())))
    }

    /// What was done with a task; not followed.
    fn record(self, task: &str) -> Record {
        self.progress.with_untracked(|progress| progress.as_ref().map(|p| p.record(task)).unwrap_or_default())
    }

    /// What was done with a task.
    pub fn followed_record(self, task: &str) -> Record {
        self.progress.with(|progress| progress.as_ref().map(|p| p.record(task)).unwrap_or_default())
    }

    /// Marks an answer and keeps it.
    pub fn answer(self, task: &Task, answer: Answer) -> Verdict {
        let verdict = match &task.kind {
            // The results on the screen may still be those of the state before, so a goal is marked on the document itself.
            TaskKind::Achieve(_) => check(task, &answer, &self.values_of(Of::Present, &[])),
            _ => untrack(|| self.marked(task, &answer)),
        };
        if matches!(task.kind, TaskKind::Achieve(_)) && !verdict.is_right {
            return verdict;
        }
        let state = (self.lab.bench.get_untracked().link)(self.lab).ok();
        self.change(task, |record| {
            if !record.is_done() {
                record.take(task, answer, verdict);
                record.state = state;
            }
        });
        self.say(Remark { task: task.id.clone(), feedback: verdict.feedback, verdict: Some(verdict.is_right) });
        self.given.set(Some(Given { task: task.id.clone(), is_right: verdict.is_right }));
        verdict
    }

    /// Marks an answer without taking it up; follows the bench where the task is about it.
    pub fn marked(self, task: &Task, answer: &Answer) -> Verdict {
        match &task.kind {
            TaskKind::Number(number) if number.of == Of::Start || !number.set.is_empty() => {
                check(task, answer, &self.values_of(number.of, &number.set))
            }
            _ => check(task, answer, &Present(self.lab)),
        }
    }

    /// The right number of a task in its unit.
    pub fn right_number(self, number: &quadtank_lesson::NumberTask) -> Option<f64> {
        untrack(|| number.answer(&self.values_of(number.of, &number.set)))
    }

    fn values_of(self, of: Of, settings: &[String]) -> Quantities {
        let present = || (self.lab.bench.get_untracked().document)(self.lab);
        let state = match of {
            Of::Start => self.start.get_value().unwrap_or_else(present),
            Of::Present => present(),
        };
        Quantities::of(&with_settings(&state, settings).unwrap_or(state))
    }

    /// Whether the bench is not any more in the state with which the step began.
    pub fn has_tried(self) -> bool {
        let present = (self.lab.bench.get_untracked().document)(self.lab);
        self.start.with_value(|start| start.as_ref() != Some(&present))
    }

    /// Brings the bench to a solution of a goal, which then gives no points.
    pub fn show_solution(self, task: &Task) {
        let TaskKind::Achieve(goal) = &task.kind else { return };
        self.change(task, |record| record.shown = true);
        self.say(Remark { task: task.id.clone(), feedback: None, verdict: None });
        if let Some(state) = self.start.get_value()
            && let Ok(solved) = with_settings(&state, &goal.solution)
        {
            self.lab.open(Ok(solved));
        }
    }

    /// Takes one more hint of a task.
    pub fn take_hint(self, task: &Task) {
        self.change(task, |record| {
            record.hints = (record.hints + 1).min(u32::try_from(task.hints.len()).unwrap_or(u32::MAX));
        });
    }

    fn change(self, task: &Task, change: impl FnOnce(&mut Record)) {
        self.progress.update(|progress| {
            if let Some(progress) = progress {
                change(progress.records.entry(task.id.clone()).or_default());
            }
        });
        if let (Some(lesson), Some((_, step))) = (self.lesson.get_untracked(), untrack(|| self.step())) {
            self.set_stage(&lesson, &step);
        }
        self.keep();
    }

    /// Reads the clock and keeps what was done.
    pub fn keep(self) {
        let now = now_s();
        let spent = (now - self.read_at_s.get_value()).clamp(0.0, 120.0);
        self.read_at_s.set_value(now);
        let Some(lesson) = self.lesson.get_untracked() else { return };
        self.progress.update_untracked(|progress| {
            if let Some(progress) = progress {
                progress.seconds += spent;
            }
        });
        self.progress.with_untracked(|progress| {
            if let Some(progress) = progress {
                kept::write(progress);
                course::commit(&lesson, progress);
            }
        });
    }

    /// The page goes: what was done is handed over. A page that the browser only lays aside may come back and go on, and a session
    /// that has ended cannot begin again.
    pub fn close(self, may_come_back: bool) {
        self.keep();
        if !may_come_back {
            course::finish();
        }
    }

    /// Leaves the lesson for the bench that was shown before.
    pub fn leave(self) {
        if let Some(bench) = self.end() {
            self.lab.bench.set(bench);
            show_address(&kept_reference(self.lab, bench));
        }
    }

    /// Ends the lesson, if one is taken: what lay aside is back on its benches. The bench that was shown before.
    pub fn end(self) -> Option<&'static BenchEntry> {
        self.keep();
        course::finish();
        self.lab.stage.set(None);
        self.lesson.set(None);
        self.progress.set(None);
        self.start.set_value(None);
        for (_, document) in self.put_aside.try_update_value(std::mem::take).unwrap_or_default() {
            self.lab.open(Ok(document));
        }
        self.before.try_update_value(Option::take).flatten()
    }
}

/// The language in which a lesson is shown.
pub fn tongue(lab: Lab, lesson: &Lesson) -> Tongue {
    lesson.tongue(Tongue::of_tag(lab.language.get().tag()).unwrap_or(Tongue::En))
}

fn now_s() -> f64 {
    js_sys::Date::now() / 1000.0
}
