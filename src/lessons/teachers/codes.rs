//! Reads the codes of reports: one in detail, those of a class as a table.

use std::sync::Arc;

use leptos::prelude::*;
use quadtank_lesson::{Lesson, Report, ReportError};

use crate::download::download_text;
use crate::lab::{Lab, use_lab};
use crate::lessons::classroom::tongue;
use crate::lessons::prose::inline;
use crate::tables::style;
use crate::texts::{say, tr};
use crate::widgets::TableContent;

/// What a code holds, or why it holds nothing.
type Found = Result<Report, ReportError>;
/// The lessons of the laboratory as far as their files are there, for titles and questions.
type Lessons = RwSignal<Vec<Option<Arc<Lesson>>>>;

/// A field for codes, with whatever stands around them, and what they hold.
#[component]
pub fn ReadCodes(
    /// The lessons of the laboratory.
    lessons: Lessons,
) -> impl IntoView {
    let lab = use_lab();
    let codes = RwSignal::new(String::new());
    let reports = Memo::new(move |_| codes.with(|codes| Report::all_in(codes)));
    let is_empty = move || codes.with(|codes| codes.trim().is_empty());
    let found = move || match reports.get().as_slice() {
        [] if is_empty() => None,
        [] | [Err(_)] => Some(view! { <p class="bad">{tr!(lab, lesson.bad_code)}</p> }.into_any()),
        [Ok(report)] => Some(detail(lab, lessons, report.clone()).into_any()),
        several => Some(class_table(lab, lessons, several).into_any()),
    };
    let save = move |_| {
        let separator = untrack(|| style(lab)).separator().sign();
        download_text("quadtank-reports.csv", "text/csv", &reports.with_untracked(|found| csv(found, separator)));
    };
    let is_class = move || reports.with(|reports| reports.len() > 1);
    view! {
        <section>
            <h3>{say!(lab, lesson.read_code)}</h3>
            <p>{say!(lab, lesson.read_code_lead)}</p>
            <label>
                {say!(lab, lesson.code)}
                <textarea rows="3" data-testid="read-code" on:input=move |event| codes.set(event_target_value(&event))></textarea>
            </label>
            <div role="status" data-testid="read-report">{found}</div>
            <button type="button" class="button" data-testid="reports-csv" hidden=move || !is_class() on:click=save>
                {say!(lab, lesson.save_csv)}
            </button>
        </section>
    }
}

/// The lesson with an id, if it is one of the laboratory and there.
fn lesson_of(lessons: Lessons, id: &str) -> Option<Arc<Lesson>> {
    lessons.with(|lessons| lessons.iter().flatten().find(|lesson| lesson.id == id).cloned())
}

/// The title of a lesson; of one that is not known its id.
fn title_of(lab: Lab, lessons: Lessons, id: &str) -> String {
    lesson_of(lessons, id).map_or_else(|| id.to_owned(), |lesson| lesson.title.shown(tongue(lab, &lesson)).to_owned())
}

/// How long a lesson took, in seconds where it was less than a minute.
fn time(seconds: u32) -> String {
    if seconds < 60 { format!("{seconds}\u{a0}s") } else { format!("{}\u{a0}min", seconds.div_ceil(60)) }
}

fn detail(lab: Lab, lessons: Lessons, report: Report) -> impl IntoView {
    let lesson = lesson_of(lessons, &report.lesson);
    let rows = report.tasks.into_iter().map(|task| {
        let known = lesson.as_ref().and_then(|lesson| {
            let (step, found) = lesson.tasks().find(|(_, known)| known.id == task.id)?;
            Some(format!("{}. {}", step + 1, found.question.shown(tongue(lab, lesson))))
        });
        let points = match (task.of, task.solved, task.wrong) {
            (_, false, 0) => tr!(lab, lesson.not_answered),
            (0, ..) => tr!(lab, lesson.not_marked),
            _ => format!("{}/{}", task.points, task.of),
        };
        let testid = format!("of-{}", task.id);
        view! {
            <tr data-testid=testid>
                <th scope="row">{inline(&known.unwrap_or(task.id))}</th>
                <td>{points}</td>
                <td>{task.wrong}</td>
                <td>{task.hints}</td>
            </tr>
        }
        .into_any()
    });
    let rows = rows.collect();
    let title = title_of(lab, lessons, &report.lesson);
    let columns =
        vec![tr!(lab, lesson.task), tr!(lab, lesson.points), tr!(lab, lesson.wrong_answers), tr!(lab, lesson.hints)];
    view! {
        <p>
            <b>{report.name}</b> " · " {title.clone()} " · "
            {tr!(lab, lesson.report_line, score = report.score, time = time(report.seconds), seed = report.seed)}
        </p>
        <table class="plain"><TableContent caption=title columns rows /></table>
    }
}

/// A line for each code; one that is there twice is marked.
fn class_table(lab: Lab, lessons: Lessons, found: &[Found]) -> impl IntoView + use<> {
    let rows = found.iter().enumerate().map(|(place, report)| {
        let Ok(report) = report else {
            return view! {
                <tr>
                    <th scope="row" class="bad">{place + 1}</th>
                    <td class="bad" colspan="3">{tr!(lab, lesson.bad_code)}</td>
                </tr>
            }
            .into_any();
        };
        let is_again = found[..place].iter().flatten().any(|before| before == report);
        view! {
            <tr>
                <th scope="row">
                    {report.name.clone()} {is_again.then(|| view! { " " <span class="bad">{tr!(lab, lesson.again)}</span> })}
                </th>
                <td>{title_of(lab, lessons, &report.lesson)}</td>
                <td>{report.score}</td>
                <td>{time(report.seconds)}</td>
            </tr>
        }
        .into_any()
    });
    let columns =
        vec![tr!(lab, lesson.student), tr!(lab, lesson.lesson), tr!(lab, lesson.of_hundred), tr!(lab, lesson.time)];
    view! { <table class="plain"><TableContent caption=tr!(lab, lesson.report) columns rows=rows.collect() /></table> }
}

/// The reports as values with this separator, with names as in files, not as on the screen.
fn csv(found: &[Found], separator: char) -> String {
    let row = |report: &Report| {
        let Report { lesson, fingerprint, name, seed, seconds, score, .. } = report;
        let [fingerprint, score] = [fingerprint.clone(), score.to_string()];
        [field(name), field(lesson), fingerprint, score, seconds.to_string(), seed.to_string()]
    };
    let damaged = || ["damaged", "", "", "", "", ""].map(str::to_owned);
    let head = ["name", "lesson", "fingerprint", "score", "seconds", "seed"].map(str::to_owned);
    let rows = found.iter().map(|report| report.as_ref().map_or_else(|_| damaged(), row));
    std::iter::once(head).chain(rows).map(|cells| cells.join(&separator.to_string()) + "\n").collect()
}

/// A text as a field (RFC 4180). A spreadsheet takes what begins with one of these signs for a formula.
fn field(text: &str) -> String {
    let guard = if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { "'" } else { "" };
    format!("\"{guard}{}\"", text.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use quadtank_lesson::Report;

    use super::{csv, field, time};

    #[test]
    fn a_name_is_no_formula_and_ends_no_field() {
        assert_eq!(field("Ana \"A\" Souza"), "\"Ana \"\"A\"\" Souza\"");
        assert_eq!(field("=1+1"), "\"'=1+1\"");
    }

    #[test]
    fn a_damaged_code_is_a_line_of_the_table_too() {
        assert_eq!(csv(&Report::all_in("QL1-x QL1-y"), ',').lines().skip(1).collect::<Vec<_>>(), ["damaged,,,,,"; 2]);
    }

    #[test]
    fn a_short_time_is_in_seconds() {
        assert_eq!([3, 59, 60, 61].map(time), ["3\u{a0}s", "59\u{a0}s", "1\u{a0}min", "2\u{a0}min"]);
    }
}
