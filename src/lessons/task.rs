//! A task: its question, how it is answered, what is said about the answer, its hints.

use std::sync::Arc;

use leptos::html::Div;
use leptos::prelude::*;
use quadtank_lesson::{Answer, Feedback, Lesson, Task, TaskKind, Text, Tongue, feedback_text, points_of};

use web_sys::{ScrollIntoViewOptions, ScrollLogicalPosition};

use super::answers::{Choices, GoalList, NumberAnswer, Ordering, Words};
use super::classroom::{tongue, use_classroom};
use super::panel::shown;
use super::prose::{Prose, inline, written};
use crate::lab::use_lab;
use crate::texts::{say, tr};

/// A task of the open step.
#[component]
pub fn TaskView(lesson: Arc<Lesson>, task: Task, index: usize) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let question = shown(lab, &lesson, task.question.clone());
    let task = Arc::new(task);
    let id = task.id.clone();
    let answer = match task.kind.clone() {
        TaskKind::Predict(predict) => {
            let options = predict.options.into_iter().map(|text| shown(lab, &lesson, text)).collect();
            view! { <Choices task=Arc::clone(&task) options /> }.into_any()
        }
        TaskKind::Choose(choose) => {
            let options = choose.options.into_iter().map(|option| shown(lab, &lesson, option.text)).collect();
            view! { <Choices task=Arc::clone(&task) options /> }.into_any()
        }
        TaskKind::Number(number) => view! { <NumberAnswer task=Arc::clone(&task) number /> }.into_any(),
        TaskKind::Achieve(goal) => {
            let labels = goal.conditions.iter().map(|condition| shown(lab, &lesson, condition.label.clone())).collect();
            view! { <GoalList task=Arc::clone(&task) goal labels /> }.into_any()
        }
        TaskKind::Order(order) => {
            let items = order.items.into_iter().map(|item| shown(lab, &lesson, item)).collect();
            view! { <Ordering task=Arc::clone(&task) items /> }.into_any()
        }
        TaskKind::Explain(_) => view! { <Words task=Arc::clone(&task) /> }.into_any(),
    };
    let counts_attempts = task.kind.counts_attempts();
    let points = {
        let task = Arc::clone(&task);
        move || {
            let record = room.followed_record(&task.id);
            let reached = points_of(&task, &record);
            match (task.points, record.is_done()) {
                (0, _) => tr!(lab, lesson.not_marked),
                (of, true) => tr!(lab, lesson.reached, points = reached, of = of),
                (of, false) if counts_attempts => tr!(lab, lesson.worth_each, count = of as usize),
                (of, false) => tr!(lab, lesson.worth, count = of as usize),
            }
        }
    };
    view! {
        <section class="task" data-testid=format!("task-{id}") data-step=index>
            <fieldset>
                <legend><Prose text=question /></legend>
                {answer}
            </fieldset>
            <Hints lesson=Arc::clone(&lesson) task=Arc::clone(&task) />
            <Said lesson task />
            <p class="points">{points}</p>
        </section>
    }
}

/// What is said about the last answer.
#[component]
fn Said(lesson: Arc<Lesson>, task: Arc<Task>) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let is_marked = task.kind.is_marked();
    let has_options = matches!(task.kind, TaskKind::Choose(_));
    let id = task.id.clone();
    let last = Memo::new(move |_| room.said.with(|said| said.iter().find(|remark| remark.task == id).cloned()));
    let room_for = {
        let (task, lesson) = (Arc::clone(&task), Arc::clone(&lesson));
        move || {
            let longest = longest_feedback(&task, tongue(lab, &lesson))?;
            Some(
                view! { <div class="room" aria-hidden="true"><b>{tr!(lab, lesson.wrong)}</b> " " {inline(&longest)}</div> },
            )
        }
    };
    let verdict = {
        let task = Arc::clone(&task);
        move || {
            let record = room.followed_record(&task.id);
            let verdict = last.get()?.verdict;
            Some(match (is_marked, verdict, record.shown) {
                (false, ..) => tr!(lab, lesson.recorded),
                (true, Some(true), _) => tr!(lab, lesson.right),
                // A student asks for the solution of a goal. That of a choice comes after the last wrong answer, whose remark is shown first.
                (true, _, true) if !has_options => tr!(lab, lesson.solution_shown),
                (true, Some(false), _) => tr!(lab, lesson.wrong),
                (true, None, _) => return None,
            })
        }
    };
    let lesson_of_solution = Arc::clone(&lesson);
    let words = {
        let task = Arc::clone(&task);
        move || {
            let feedback = last.get()?.feedback;
            let text = feedback_text(&task, feedback?)?.shown(tongue(lab, &lesson)).to_owned();
            let lead = matches!(feedback, Some(Feedback::Model)).then(|| tr!(lab, lesson.model));
            Some(view! { {lead.map(|lead| view! { <b>{lead}</b> " " })}{inline(&text)} })
        }
    };
    let solution = {
        let (task, lesson_of_solution) = (Arc::clone(&task), lesson_of_solution);
        move || {
            if !room.followed_record(&task.id).shown {
                return None;
            }
            match &task.kind {
                TaskKind::Number(number) => {
                    let right = room.right_number(number)?;
                    Some(tr!(lab, lesson.solution_is, value = written(lab, Some(right), &number.unit, 3)).into_any())
                }
                TaskKind::Choose(choose) => {
                    let right = choose.options.iter().find(|option| option.correct)?;
                    let why = right.feedback.shown(tongue(lab, &lesson_of_solution)).to_owned();
                    Some(view! { <b>{tr!(lab, lesson.solution_shown)}</b> " " {inline(&why)} }.into_any())
                }
                _ => None,
            }
        }
    };
    let class = move || match last.with(|last| last.as_ref().map(|remark| remark.verdict == Some(true))) {
        Some(true) => "said right",
        Some(false) => "said",
        None => "said none",
    };
    // On a phone the bench covers the lower half: what is said of an answer comes into sight.
    let element = NodeRef::<Div>::new();
    Effect::new(move |before: Option<bool>| {
        let is_said = last.with(Option::is_some);
        if before.is_some()
            && is_said
            && let Some(element) = element.get_untracked()
        {
            let options = ScrollIntoViewOptions::new();
            options.set_block(ScrollLogicalPosition::Nearest);
            element.scroll_into_view_with_scroll_into_view_options(&options);
        }
        is_said
    });
    view! {
        <div class=class role="status" node_ref=element data-testid=format!("said-{}", task.id)>
            // Its room is there from the start, so that nothing below moves.
            {room_for}
            <div><b>{verdict}</b> " " {words} " " {solution}</div>
        </div>
    }
}

/// The longest text that an answer to a task can get, but for a model answer.
fn longest_feedback(task: &Task, tongue: Tongue) -> Option<String> {
    let texts: Vec<&Text> = match &task.kind {
        TaskKind::Choose(choose) => choose.options.iter().map(|option| &option.feedback).collect(),
        TaskKind::Number(number) => number.mistakes.iter().map(|mistake| &mistake.feedback).collect(),
        TaskKind::Achieve(goal) => goal.attempts.iter().map(|attempt| &attempt.feedback).collect(),
        TaskKind::Predict(_) | TaskKind::Order(_) | TaskKind::Explain(_) => return None,
    };
    texts.into_iter().map(|text| text.shown(tongue)).max_by_key(|text| text.chars().count()).map(str::to_owned)
}

/// The hints that were taken, and the next one.
#[component]
fn Hints(lesson: Arc<Lesson>, task: Arc<Task>) -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    if task.hints.is_empty() {
        return ().into_any();
    }
    let count = task.hints.len();
    let record = {
        let id = task.id.clone();
        Memo::new(move |_| room.followed_record(&id))
    };
    let taken = {
        let (task, lesson) = (Arc::clone(&task), Arc::clone(&lesson));
        move || {
            let hints = task.hints.iter().take(record.get().hints as usize).enumerate();
            let hint = |(index, text): (usize, &quadtank_lesson::Text)| {
                let lead = tr!(lab, lesson.hint_number, number = index + 1, count = count);
                view! { <p class="hint-text"><b>{lead}</b> " " {inline(text.shown(tongue(lab, &lesson)))}</p> }
            };
            hints.map(hint).collect_view()
        }
    };
    let is_goal = matches!(task.kind, TaskKind::Achieve(_));
    let is_over = move || record.get().is_done();
    let has_more = move || !is_over() && (record.get().hints as usize) < count;
    let can_show = move || !is_over() && is_goal && record.get().hints as usize >= count;
    let take = {
        let task = Arc::clone(&task);
        move |_| room.take_hint(&task)
    };
    let show = move |_| room.show_solution(&task);
    view! {
        <div class="hints" data-testid="hints">
            {taken}
            <button type="button" class="button small" data-testid="hint" class:gone=move || !has_more() on:click=take>
                {say!(lab, lesson.hint)}
            </button>
            <button type="button" class="button small" data-testid="show-solution" hidden=move || !can_show() on:click=show>
                {say!(lab, lesson.show_solution)}
            </button>
        </div>
    }
    .into_any()
}

/// The answer that is kept of a task.
pub fn kept_answer(id: &str) -> Option<Answer> {
    let room = use_classroom();
    untrack(|| room.followed_record(id)).answer
}
