//! What was done on a bench, step by step, so that it can be undone and done again.

use quadtank_scenario::BenchDocument;

/// Most steps that can be undone. A document is a few kilobytes, so this is well below a megabyte; with the longest record as its
/// experiment it has one megabyte.
const MAX_STEPS: usize = 200;

/// Whether two documents are different experiments, be it by name: where the cursor stands does not matter.
pub fn is_other_experiment<D: BenchDocument>(one: &D, other: &D) -> bool {
    one.setup() != other.setup() || one.pinned() != other.pinned() || one.label() != other.label()
}

/// The documents of a bench in the order of its changes. A step is a change of a setup, of what is pinned, or of the name: where the cursor
/// stands and what is zoomed into goes with the document, but is no step of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct History<D> {
    past: Vec<D>,
    present: D,
    future: Vec<D>,
}

impl<D: BenchDocument> History<D> {
    /// A history that begins with a document.
    pub const fn new(document: D) -> Self {
        Self { past: Vec::new(), present: document, future: Vec::new() }
    }

    /// Takes a document up: a new step if it holds another experiment, after which nothing can be done again.
    pub fn record(&mut self, document: &D) {
        let is_step = is_other_experiment(document, &self.present);
        let before = std::mem::replace(&mut self.present, document.clone());
        if is_step {
            if self.past.len() == MAX_STEPS {
                self.past.remove(0);
            }
            self.past.push(before);
            self.future.clear();
        }
    }

    /// Goes back one step; the document of then, or `None` at the beginning.
    pub fn undo(&mut self) -> Option<D> {
        let before = self.past.pop()?;
        self.future.push(std::mem::replace(&mut self.present, before));
        Some(self.present.clone())
    }

    /// Takes the last undoing back; the document after it, or `None` where nothing was undone.
    pub fn redo(&mut self) -> Option<D> {
        let after = self.future.pop()?;
        self.past.push(std::mem::replace(&mut self.present, after));
        Some(self.present.clone())
    }

    /// Whether there is a step to undo.
    pub const fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is a step to do again.
    pub const fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use quadtank_scenario::Scenario;

    use super::*;

    fn with_valve(gamma: f64) -> Scenario {
        let mut document = Scenario::default();
        document.setup.valves[0] = gamma;
        document
    }

    #[test]
    fn steps_are_undone_and_done_again() {
        let mut history = History::new(with_valve(0.7));
        history.record(&with_valve(0.5));
        history.record(&with_valve(0.3));
        assert_eq!(history.undo(), Some(with_valve(0.5)));
        assert_eq!(history.undo(), Some(with_valve(0.7)));
        assert_eq!(history.undo(), None);
        assert_eq!(history.redo(), Some(with_valve(0.5)));
        assert!(history.can_undo() && history.can_redo());
    }

    #[test]
    fn a_new_step_forgets_what_was_undone() {
        let mut history = History::new(with_valve(0.7));
        history.record(&with_valve(0.5));
        history.undo();
        history.record(&with_valve(0.2));
        assert!(!history.can_redo());
        assert_eq!(history.undo(), Some(with_valve(0.7)));
    }

    #[test]
    fn a_cursor_is_no_step_but_comes_back_with_its_document() {
        let mut history = History::new(with_valve(0.7));
        let mut looked_at = with_valve(0.7);
        looked_at.view.cursor_s = Some(120.0);
        history.record(&looked_at);
        assert!(!history.can_undo());
        history.record(&with_valve(0.5));
        assert_eq!(history.undo(), Some(looked_at));
    }

    #[test]
    fn the_same_document_again_keeps_what_was_undone() {
        let mut history = History::new(with_valve(0.7));
        history.record(&with_valve(0.5));
        history.undo();
        history.record(&with_valve(0.7));
        assert_eq!(history.redo(), Some(with_valve(0.5)));
    }

    #[test]
    fn the_oldest_steps_are_forgotten_beyond_the_most() {
        let mut history = History::new(with_valve(0.0));
        let last = MAX_STEPS + 5;
        for step in 1..=last {
            history.record(&with_valve(step as f64 / 1000.0));
        }
        let undone = std::iter::from_fn(|| history.undo()).collect::<Vec<_>>();
        assert_eq!(undone.len(), MAX_STEPS);
        assert_eq!(undone.last(), Some(&with_valve(0.005)));
    }
}
