use quadtank_scenario::{Document, ScenarioError, document_from_link, published_document};
use thiserror::Error;

use super::{Lesson, Step, TaskKind, Variation};

/// Why a step has no state to begin with.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum StartError {
    /// No published rig or case has this name.
    #[error("unknown rig or case `{0}`; `quadtank presets` and `quadtank cases` list them")]
    UnknownPreset(String),
    /// Neither the step nor one before it says a state.
    #[error("no step up to this one says a state of the bench")]
    NoState,
    /// A start has settings only.
    #[error("a start has a `preset` or a `link`, which settings can change")]
    NoSource,
    /// A start says two states.
    #[error("a start has either a `preset` or a `link`")]
    TwoStates,
    /// The state is that of another bench.
    #[error("the state is not one of the bench {0}")]
    OtherBench(String),
    /// The state is not allowed.
    #[error("{0}")]
    Refused(#[from] ScenarioError),
}

/// The state with which a step begins for a student, or `None` where the bench stays as it is.
///
/// # Errors
/// [`StartError`] where the lesson asks for a state that there is not.
pub fn start_of(lesson: &Lesson, step: &Step, seed: u32) -> Result<Option<Document>, StartError> {
    let Some(start) = &step.start else { return Ok(None) };
    let document = match (&start.preset, &start.link) {
        (Some(name), None) => published_document(name).ok_or_else(|| StartError::UnknownPreset(name.clone()))?,
        (None, Some(link)) => document_from_link(link.rsplit_once('#').map_or(link.as_str(), |(_, state)| state))?,
        (Some(_), Some(_)) => return Err(StartError::TwoStates),
        (None, None) => return Err(StartError::NoSource),
    };
    if document.bench() != lesson.bench {
        return Err(StartError::OtherBench(lesson.bench.clone()));
    }
    let settings: Vec<String> = start.set.iter().cloned().chain(variations(lesson, step, seed)).collect();
    Ok(Some(with_settings(&document, &settings)?))
}

/// The state when the first `tasks` tasks of a step are done, and the steps before it, with the solutions of the lesson.
///
/// # Errors
/// [`StartError`] where the lesson asks for a state that there is not.
pub fn state_before(lesson: &Lesson, step: usize, tasks: usize, seed: u32) -> Result<Document, StartError> {
    let mut state = None;
    for (index, played) in lesson.steps.iter().enumerate().take(step + 1) {
        state = start_of(lesson, played, seed)?.or(state);
        let done = if index == step { tasks } else { played.tasks.len() };
        for task in played.tasks.iter().take(done) {
            if let (TaskKind::Achieve(goal), Some(before)) = (&task.kind, &state) {
                state = Some(with_settings(before, &goal.solution)?);
            }
        }
    }
    state.ok_or(StartError::NoState)
}

/// The settings that a student gets by the seed.
fn variations(lesson: &Lesson, step: &Step, seed: u32) -> Vec<String> {
    let setting = |variation: &Variation| {
        let value = variation.among.get(chosen(lesson, variation, seed)?)?;
        Some(format!("{}={value}", variation.path))
    };
    step.vary.iter().filter_map(setting).collect()
}

/// Which of the values of a variation a student gets.
fn chosen(lesson: &Lesson, variation: &Variation, seed: u32) -> Option<usize> {
    shuffled(variation.among.len(), seed, &format!("{} {}", lesson.id, variation.path)).first().copied()
}

/// Which of all the numbers that vary a student gets: equal for students with the same lesson.
pub(super) fn variant(lesson: &Lesson, seed: u32) -> Vec<Option<usize>> {
    lesson.steps.iter().flat_map(|step| &step.vary).map(|variation| chosen(lesson, variation, seed)).collect()
}

/// A document with settings such as `setup.valves[0]=0.4`.
///
/// # Errors
/// [`ScenarioError`] for a setting that there is not, or that is not allowed.
pub fn with_settings(document: &Document, settings: &[String]) -> Result<Document, ScenarioError> {
    document.with_settings(settings.iter().map(String::as_str))
}

/// The numbers below `count` in an order that follows from the seed and a name: the same student always sees the same.
pub fn shuffled(count: usize, seed: u32, name: &str) -> Vec<usize> {
    let mut state = super::fingerprint::checksum(name.as_bytes()) ^ seed.wrapping_mul(0x9e37_79b9);
    let mut next = move || {
        // The finaliser of MurmurHash3 (Appleby) over a counter.
        state = state.wrapping_add(0x9e37_79b9);
        let mut mixed = state;
        mixed = (mixed ^ (mixed >> 16)).wrapping_mul(0x85eb_ca6b);
        mixed = (mixed ^ (mixed >> 13)).wrapping_mul(0xc2b2_ae35);
        mixed ^ (mixed >> 16)
    };
    let mut order: Vec<usize> = (0..count).collect();
    for last in (1..count).rev() {
        order.swap(last, next() as usize % (last + 1));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::shuffled;

    #[test]
    fn students_get_all_values_about_equally_often_and_always_the_same() {
        let mut counts = [0; 4];
        for seed in 0..400 {
            let order = shuffled(4, seed, "lesson setup.valves[0]");
            assert_eq!(order, shuffled(4, seed, "lesson setup.valves[0]"));
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, [0, 1, 2, 3]);
            counts[order[0]] += 1;
        }
        assert!(counts.iter().all(|count| (60..140).contains(count)), "{counts:?}");
    }
}
