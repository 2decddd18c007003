//! The solutions of a lesson, as its author wrote them: for who teaches, and for tests that play it.

use quadtank_scenario::Quantities;
use serde::Serialize;

use super::{Answer, Lesson, Of, StartError, Task, TaskKind, state_before, with_settings};

/// A solution of a task.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solution {
    /// The step, from 0.
    pub step: usize,
    /// The id of the task.
    pub task: String,
    /// The answer. A prediction has none, nor a number that does not exist in the state that it is asked of.
    pub answer: Option<Answer>,
    /// Of a goal on the bench: the settings that reach it.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub settings: Vec<String>,
}

/// The solutions of all tasks for a student, in their order. A model answer is in the first language of the lesson.
///
/// # Errors
/// [`StartError`] where the lesson asks for a state that there is not.
pub fn solutions(lesson: &Lesson, seed: u32) -> Result<Vec<Solution>, StartError> {
    let mut solutions = Vec::new();
    for (step, steps_tasks) in lesson.steps.iter().map(|step| &step.tasks).enumerate() {
        for (place, task) in steps_tasks.iter().enumerate() {
            let settings = match &task.kind {
                TaskKind::Achieve(goal) => goal.solution.clone(),
                _ => Vec::new(),
            };
            let answer = answer_to(lesson, [step, place], task, seed)?;
            solutions.push(Solution { step, task: task.id.clone(), answer, settings });
        }
    }
    Ok(solutions)
}

fn answer_to(lesson: &Lesson, [step, place]: [usize; 2], task: &Task, seed: u32) -> Result<Option<Answer>, StartError> {
    Ok(match &task.kind {
        TaskKind::Predict(_) => None,
        TaskKind::Choose(choose) => choose.options.iter().position(|option| option.correct).map(Answer::Choice),
        TaskKind::Number(number) => {
            let done = if number.of == Of::Start { 0 } else { place };
            let state = state_before(lesson, step, done, seed)?;
            number.answer(&Quantities::of(&with_settings(&state, &number.set)?)).map(Answer::Number)
        }
        TaskKind::Achieve(_) => Some(Answer::Bench),
        TaskKind::Order(order) => Some(Answer::Order((0..order.items.len()).collect())),
        TaskKind::Explain(explain) => {
            let tongue = lesson.languages.first();
            tongue.map(|&tongue| Answer::Text(explain.model.shown(tongue).to_owned()))
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;
    use crate::sample::lesson;

    #[test]
    fn every_solution_is_right_for_every_student() {
        let lesson = lesson();
        for seed in 0..20 {
            let solutions = solutions(&lesson, seed).unwrap();
            let tasks: Vec<(usize, &str)> = lesson.tasks().map(|(step, task)| (step, task.id.as_str())).collect();
            assert_eq!(solutions.iter().map(|found| (found.step, found.task.as_str())).collect::<Vec<_>>(), tasks);
            for (solution, (step, task)) in solutions.iter().zip(lesson.tasks()) {
                let place = lesson.steps[step].tasks.iter().position(|other| other.id == task.id).unwrap();
                let is_of_start = matches!(&task.kind, TaskKind::Number(number) if number.of == Of::Start);
                let before = state_before(&lesson, step, if is_of_start { 0 } else { place }, seed).unwrap();
                let settings = match &task.kind {
                    TaskKind::Number(number) => &number.set,
                    _ => &solution.settings,
                };
                let values = Quantities::of(&with_settings(&before, settings).unwrap());
                match &solution.answer {
                    Some(answer) => assert!(check(task, answer, &values).is_right, "{}", task.id),
                    None => assert!(matches!(task.kind, TaskKind::Predict(_)), "{}", task.id),
                }
            }
        }
    }
}
