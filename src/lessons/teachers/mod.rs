//! The page for who teaches.

mod builder;
mod codes;
mod package;

use std::sync::Arc;

use leptos::prelude::*;
use quadtank_lesson::{Answer, LESSON_IDS, Lesson, NumberTask, Step, TaskKind, Tolerance};

use builder::{Builder, FrameSize, frame_of, title_of};
use codes::ReadCodes;
pub use package::LessonFiles;

use super::catalogue::OwnFile;
use super::classroom::tongue;
use super::finish::start_link;
use super::place::{SidePage, lesson_address};
use super::{is_for_here, load};
use crate::download::is_single_file;
use crate::lab::{Lab, use_lab};
use crate::share;
use crate::texts::{say, tr};
use crate::widgets::is_open;

/// The page of the document about lesson files, beside the laboratory.
const FORMAT: &str = "lessons.html";

/// Everything for a course: lessons with answers, embeds, codes of reports.
#[component]
pub fn Teachers() -> impl IntoView {
    let lab = use_lab();
    let lessons = load::all();
    let to_scenes = move |event| {
        if is_for_here(&event) {
            share::go_to_page(lab, SidePage::Scenes);
        }
    };
    view! {
        <main class="side-page teachers" id="bench" tabindex="-1" data-testid="teachers">
            <h2>{say!(lab, lesson.teachers)}</h2>
            <p class="lead">{say!(lab, lesson.teachers_lead)}</p>
            <Builder lessons />
            <section>
                <h3>{say!(lab, lesson.grades)}</h3>
                <p>{move || if is_single_file() { tr!(lab, lesson.grades_single) } else { tr!(lab, lesson.grades_lead) }}</p>
                <p>{say!(lab, lesson.grades_code)}</p>
            </section>
            <ReadCodes lessons />
            <section>
                <h3>{say!(lab, lesson.projector)}</h3>
                <p>{say!(lab, lesson.projector_lead)}</p>
                <p><a class="button" href=SidePage::Scenes.address() on:click=to_scenes>{say!(lab, scenes.see)}</a></p>
            </section>
            <section>
                <h3>{say!(lab, lesson.own)}</h3>
                <p>{say!(lab, lesson.own_lead)}</p>
                // The single file has no page beside it.
                {(!is_single_file()).then(|| view! {
                    <p><a href=FORMAT target="_blank" rel="noopener" data-testid="to-format">{say!(lab, lesson.format)}</a></p>
                })}
                <OwnFile />
            </section>
            <Answers lessons />
        </main>
    }
}

/// The lessons with outcomes, misconceptions and, behind a click, their answers.
#[component]
fn Answers(lessons: RwSignal<Vec<Option<Arc<Lesson>>>>) -> impl IntoView {
    let lab = use_lab();
    let section = move |index: usize| {
        lessons.with(|lessons| lessons[index].clone().map(|lesson| guide(lab, lessons, index, lesson)))
    };
    view! {
        <section>
            <h3>{say!(lab, lesson.list)}</h3>
            {(0..LESSON_IDS.len()).map(|index| view! { <div>{move || section(index)}</div> }).collect_view()}
        </section>
    }
}

#[allow(clippy::needless_pass_by_value, reason = "the answers are made later and hold the lesson")]
fn guide(lab: Lab, lessons: &[Option<Arc<Lesson>>], index: usize, lesson: Arc<Lesson>) -> impl IntoView + use<> {
    let language = tongue(lab, &lesson);
    let list = |texts: &[quadtank_lesson::Text]| {
        texts.iter().map(|text| view! { <li>{text.shown(language).to_owned()}</li> }).collect_view()
    };
    let address = lesson_address(&lesson.id);
    let query = format!("{address}&embed=1&lang={}", lab.language.get().tag());
    let embed = frame_of(&query, lesson.title.shown(language), FrameSize::USUAL);
    // The numbers are computed when they are asked for.
    let asked = RwSignal::new(false);
    let lesson = Arc::clone(&lesson);
    let about = Arc::clone(&lesson);
    let files = (!is_single_file()).then(|| view! { <p class="links"><LessonFiles lesson=Arc::clone(&lesson) /></p> });
    let answers = move || {
        asked.get().then(|| {
            view! {
                <ul class="answers">{answers_of(lab, &lesson)}</ul>
                <h4>{tr!(lab, lesson.starts)}</h4>
                <ul data-testid="starts">{starts_of(lab, &lesson)}</ul>
            }
        })
    };
    let lesson = about;
    view! {
        <details data-testid=format!("guide-{}", lesson.id)>
            <summary>
                <b>{format!("{}. {}", index + 1, lesson.title.shown(language))}</b> " "
                <span class="remark">{tr!(lab, lesson.minutes, minutes = lesson.minutes)}</span>
            </summary>
            {lessons_before(lab, lessons, &lesson)}
            <h4>{tr!(lab, lesson.outcomes)}</h4>
            <ul>{list(&lesson.outcomes)}</ul>
            <h4>{tr!(lab, lesson.misconceptions)}</h4>
            <ul>{list(&lesson.misconceptions)}</ul>
            <p class="remark">{lesson.source.clone()}</p>
            <p><a href=address>{tr!(lab, lesson.open_lesson)}</a></p>
            {files}
            <h4>{tr!(lab, lesson.embed)}</h4>
            <textarea readonly rows="2" class="code" aria-label=tr!(lab, lesson.embed) prop:value=embed></textarea>
            <details on:toggle=move |event| asked.set(is_open(&event))>
                <summary>{tr!(lab, lesson.answers)}</summary>
                {answers}
            </details>
        </details>
    }
}

/// The lessons of the laboratory that should come before one; nothing where it stands alone.
fn lessons_before(lab: Lab, lessons: &[Option<Arc<Lesson>>], lesson: &Lesson) -> Option<impl IntoView + use<>> {
    let known = LESSON_IDS.into_iter().filter(|id| lesson.prerequisites.iter().any(|before| before == id));
    let rows: Vec<_> =
        known.map(|id| view! { <li><a href=lesson_address(id)>{title_of(lab, lessons, id)}</a></li> }).collect();
    (!rows.is_empty()).then(|| view! { <h4>{tr!(lab, lesson.before)}</h4> <ul>{rows}</ul> })
}

/// Links to the start states of the steps, with the numbers of seed 0.
fn starts_of(lab: Lab, lesson: &Lesson) -> impl IntoView + use<> {
    let language = tongue(lab, lesson);
    let row = |(index, step): (usize, &Step)| {
        let link = start_link(lesson, index, 0)?;
        let name = tr!(lab, lesson.step, number = index + 1, title = step.title.shown(language));
        Some(view! { <li><a href=share::state_reference(&link) target="_blank" rel="noopener">{name}</a></li> })
    };
    lesson.steps.iter().enumerate().filter_map(row).collect_view()
}

/// The tasks with their answers.
fn answers_of(lab: Lab, lesson: &Lesson) -> impl IntoView + use<> {
    let language = tongue(lab, lesson);
    // A lesson of the laboratory has a state for each step; its audit says so.
    let solutions = quadtank_lesson::solutions(lesson, 0).unwrap_or_default();
    let answers = lesson.tasks().zip(solutions).map(|((step, task), solution)| {
        let answer = match &task.kind {
            TaskKind::Choose(choose) => {
                let right = choose.options.iter().filter(|option| option.correct);
                right.map(|option| option.text.shown(language).to_owned()).collect::<Vec<_>>().join(" / ")
            }
            TaskKind::Number(number) => number_answer(lab, &lesson.steps[step], number, solution.answer.as_ref()),
            TaskKind::Achieve(_) => solution.settings.join(", "),
            TaskKind::Order(order) => {
                order.items.iter().map(|item| item.shown(language).to_owned()).collect::<Vec<_>>().join(" → ")
            }
            TaskKind::Explain(explain) => explain.model.shown(language).to_owned(),
            TaskKind::Predict(_) => return None,
        };
        let solved = matches!(task.kind, TaskKind::Achieve(_)).then(|| solved_state(lesson, step, &task.id)).flatten();
        let link = solved.map(|link| {
            view! { <a href=share::state_reference(&link) target="_blank" rel="noopener">{tr!(lab, lesson.state)}</a> }
        });
        let place = tr!(lab, lesson.place_of_task, step = step + 1, count = task.points as usize);
        Some(view! {
            <li>
                <p><span class="remark">{place}</span> " " {super::prose::inline(task.question.shown(language))}</p>
                <p class="answer">{super::prose::inline(&answer)} " " {link}</p>
            </li>
        })
    });
    answers.flatten().collect_view()
}

/// The link of the bench when a goal is reached.
fn solved_state(lesson: &Lesson, step: usize, task: &str) -> Option<String> {
    let place = lesson.steps[step].tasks.iter().position(|other| other.id == task)?;
    quadtank_lesson::state_before(lesson, step, place + 1, 0).ok()?.to_link().ok()
}

/// The number that is right for the first student.
fn number_answer(lab: Lab, step: &Step, number: &NumberTask, answer: Option<&Answer>) -> String {
    let varies = step.vary.iter().any(|variation| variation.among.len() > 1);
    let value = match answer {
        Some(Answer::Number(value)) => Some(*value),
        _ => None,
    };
    let written = super::prose::written(lab, value, &number.unit, 4);
    let style = lab.number_style();
    let margin = match number.tolerance {
        Tolerance::Relative(share) => format!("±\u{a0}{}\u{a0}%", style.significant(100.0 * share, 2)),
        Tolerance::Absolute(size) => format!("±\u{a0}{}", super::prose::written(lab, Some(size), &number.unit, 2)),
    };
    let written = format!("{written} ({margin})");
    if varies { tr!(lab, lesson.varies, value = written) } else { written }
}
