//! The benches and their list: all that the rest of the page knows of them.

pub mod handover;
mod level_loop;
mod model_free;
mod quadruple_tank;
mod relay_tuning;

use leptos::prelude::*;
use quadtank_scenario::{BenchDocument, Document, Entry, Label, ScenarioError, entries, to_json, to_link};

use super::depth::Depth;
use super::history::is_other_experiment;
use super::lab::Lab;
use super::session::{Bench, Lock, Panel, Session};
pub use level_loop::LevelLoop;
pub use model_free::ModelFree;
pub use quadruple_tank::{QuadrupleTank, load, name_of};
pub use relay_tuning::RelayTuning;

/// All benches in the order of the navigation; the first is the home bench.
pub static BENCHES: [BenchEntry; 4] = [
    BenchEntry::of::<QuadrupleTank>(),
    BenchEntry::of::<RelayTuning>(),
    BenchEntry::of::<ModelFree>(),
    BenchEntry::of::<LevelLoop>(),
];

/// A bench in the list: what the page does with any of them.
pub struct BenchEntry {
    /// Its name in an address.
    pub id: &'static str,
    /// Class of the element that holds its cards.
    pub class: &'static str,
    /// How much of it can be shown at once.
    pub depths: &'static [Depth],
    /// Whether it has a layout for an audience.
    pub can_present: bool,
    /// The cards that `panels=` can name.
    pub panels: &'static [Panel],
    /// The groups of controls that `lock=` can name.
    pub locks: &'static [Lock],
    /// What the navigation calls it.
    pub title: fn(Lab) -> String,
    /// What a card of it is called.
    pub panel_title: fn(Lab, Panel) -> String,
    /// One line on what one does there.
    pub about: fn(Lab) -> String,
    /// A small picture: the path of a drawing 48 wide and 32 high.
    pub picture: &'static str,
    /// The cards that the start flags ask for.
    pub cards: fn(Lab) -> AnyView,
    /// Opens a document; gives one of another bench back.
    pub open: fn(Lab, Document) -> Option<Document>,
    /// Follows the document.
    pub track: fn(Lab),
    /// Takes the document up as a step that can be undone.
    pub record: fn(Lab),
    /// Undoes the last step.
    pub undo: fn(Lab),
    /// Does again what was undone last.
    pub redo: fn(Lab),
    /// Whether there is a step to undo, and one to do again.
    pub can_undo_redo: fn(Lab) -> (bool, bool),
    /// Begins again with the document that the bench has without a link.
    pub reset: fn(Lab),
    /// Whether the document holds another experiment than that, wherever its cursor stands.
    pub is_changed: fn(Lab) -> bool,
    /// What the experiment is called, and a note on it; follows the document.
    pub label: fn(Lab) -> Label,
    /// Gives it another name and note.
    pub set_label: fn(Lab, Label),
    /// All numbers and choices of its setup.
    pub entries: fn(Lab) -> Vec<Entry>,
    /// A quantity by its name, with its unit; follows the results of each frame.
    pub quantity: fn(Lab, &str) -> Option<(f64, &'static str)>,
    /// How a unit of a quantity is written.
    pub unit_name: fn(Lab, &str) -> String,
    /// The document.
    pub document: fn(Lab) -> Document,
    /// The document as a file has it.
    pub json: fn(Lab) -> Result<String, ScenarioError>,
    /// The document as a link has it.
    pub link: fn(Lab) -> Result<String, ScenarioError>,
}

impl BenchEntry {
    /// The entry of a bench.
    pub const fn of<B: Bench>() -> Self {
        Self {
            id: B::ID,
            class: B::CLASS,
            depths: B::DEPTHS,
            can_present: B::CAN_PRESENT,
            panels: B::PANELS,
            locks: B::LOCKS,
            title: B::title,
            panel_title: B::panel_title,
            about: B::about,
            picture: B::PICTURE,
            cards: |lab| B::cards(lab.session()),
            open: |lab, document| {
                let document = B::Document::try_from(document);
                document.map(|document| lab.open_in::<B>(document)).err()
            },
            track: |lab| session::<B>(lab).document.track(),
            record: |lab| session::<B>(lab).record(),
            undo: |lab| session::<B>(lab).undo(),
            redo: |lab| session::<B>(lab).redo(),
            can_undo_redo: |lab| session::<B>(lab).can_undo_redo(),
            reset: |lab| session::<B>(lab).document.set(B::usual(lab)),
            is_changed: |lab| {
                let usual = B::usual(lab);
                session::<B>(lab).document.with_untracked(|document| is_other_experiment(document, &usual))
            },
            label: |lab| session::<B>(lab).document.with(|document| document.label().clone()),
            set_label: |lab, label| session::<B>(lab).document.update(|document| *document.label_mut() = label),
            entries: |lab| session::<B>(lab).document.with_untracked(entries),
            quantity: |lab, name| session::<B>(lab).quantity(name),
            unit_name: |lab, unit| B::unit_name(session::<B>(lab), unit),
            document: |lab| session::<B>(lab).document.get_untracked().into(),
            json: |lab| session::<B>(lab).document.with_untracked(to_json),
            link: |lab| session::<B>(lab).document.with_untracked(to_link),
        }
    }
}

impl BenchEntry {
    /// What is shown of it where `chosen` is asked for: all of it where it has no such choice.
    pub fn depth(&self, chosen: Depth) -> Depth {
        if self.depths.contains(&chosen) { chosen } else { Depth::Full }
    }
}

fn session<B: Bench>(lab: Lab) -> Session<B> {
    lab.session()
}

impl PartialEq for BenchEntry {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}
