use quadtank_scenario::{Document, ScenarioError, document_from_link, published_document};
use thiserror::Error;

use super::{Lesson, Step};

/// Why a step has no state to begin with.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum StartError {
    /// No published rig or case has this name.
    #[error("unknown rig or case `{0}`")]
    UnknownPreset(String),
    /// Neither the step nor one before it says a state.
    #[error("no step up to this one says a state of the bench")]
    NoState,
    /// The state is that of another bench.
    #[error("the state is one of another bench than `{0}`")]
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
        _ => return Err(StartError::NoState),
    };
    if document.bench() != lesson.bench {
        return Err(StartError::OtherBench(lesson.bench.clone()));
    }
    let settings: Vec<String> = start.set.iter().cloned().chain(variations(lesson, step, seed)).collect();
    Ok(Some(with_settings(&document, &settings)?))
}

/// The state in which a step would begin after the solutions of all steps before; `None` where the lesson says no state.
pub fn reference_state(lesson: &Lesson, index: usize, seed: u32) -> Option<Document> {
    let mut present = None;
    for (place, step) in lesson.steps.iter().enumerate().take(index + 1) {
        if let Ok(Some(start)) = start_of(lesson, step, seed) {
            present = Some(start);
        }
        if place == index {
            break;
        }
        for task in &step.tasks {
            if let (super::TaskKind::Achieve(goal), Some(state)) = (&task.kind, &present) {
                present = with_settings(state, &goal.solution).ok().or(present);
            }
        }
    }
    present
}

/// The settings that a student gets by the seed.
fn variations(lesson: &Lesson, step: &Step, seed: u32) -> Vec<String> {
    let place = |path: &str| format!("{} {path}", lesson.id);
    let chosen = |path: &str, count: usize| shuffled(count, seed, &place(path)).first().copied();
    let setting = |variation: &super::Variation| {
        let value = variation.among.get(chosen(&variation.path, variation.among.len())?)?;
        Some(format!("{}={value}", variation.path))
    };
    step.vary.iter().filter_map(setting).collect()
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
