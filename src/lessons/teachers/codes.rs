//! Reads the codes of reports: one in detail, those of a class as a table.

use leptos::prelude::*;
use quadtank_lesson::{Report, ReportError};

use crate::download::download_text;
use crate::lab::{Lab, use_lab};
use crate::texts::{say, tr};

/// What stands in a line: a report, or why it is none.
type Line = (String, Result<Report, ReportError>);

/// A field for codes, one in a line, and what they hold.
#[component]
pub fn ReadCodes() -> impl IntoView {
    let lab = use_lab();
    let codes = RwSignal::new(String::new());
    let lines = Memo::new(move |_| codes.with(|codes| read(codes)));
    let found = move || match lines.get().as_slice() {
        [] => None,
        [(_, Ok(report))] => Some(detail(lab, report.clone()).into_any()),
        [(_, Err(_))] => Some(view! { <p class="bad">{tr!(lab, lesson.bad_code)}</p> }.into_any()),
        several => Some(class_table(lab, several).into_any()),
    };
    let save = move |_| download_text("quadtank-reports.csv", "text/csv", &lines.with_untracked(|lines| csv(lines)));
    let is_class = move || lines.with(|lines| lines.len() > 1);
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

fn read(codes: &str) -> Vec<Line> {
    let lines = codes.lines().map(str::trim).filter(|line| !line.is_empty());
    lines.map(|line| (line.to_owned(), Report::from_code(line))).collect()
}

fn detail(lab: Lab, report: Report) -> impl IntoView {
    let rows = report.tasks.into_iter().map(|task| {
        view! {
            <tr>
                <th scope="row">{task.id}</th>
                <td>{format!("{}/{}", task.points, task.of)}</td>
                <td>{task.wrong}</td>
                <td>{task.hints}</td>
            </tr>
        }
    });
    let minutes = report.seconds.div_ceil(60);
    view! {
        <p>
            <b>{report.name}</b> " · " {report.lesson} " · "
            {tr!(lab, lesson.report_line, score = report.score, minutes = minutes, seed = report.seed)}
        </p>
        <table class="plain">
            <thead>
                <tr>
                    <th scope="col">{tr!(lab, lesson.task)}</th>
                    <th scope="col">{tr!(lab, lesson.points)}</th>
                    <th scope="col">{tr!(lab, lesson.wrong_answers)}</th>
                    <th scope="col">{tr!(lab, lesson.hints)}</th>
                </tr>
            </thead>
            <tbody>{rows.collect_view()}</tbody>
        </table>
    }
}

/// A line for each report.
fn class_table(lab: Lab, lines: &[Line]) -> impl IntoView + use<> {
    let rows = lines.iter().map(|(code, report)| {
        if let Ok(report) = report {
            return view! {
                <tr>
                    <th scope="row">{report.name.clone()}</th>
                    <td>{report.lesson.clone()}</td>
                    <td>{report.score}</td>
                    <td>{report.seconds.div_ceil(60)}</td>
                </tr>
            }
            .into_any();
        }
        let start: String = code.chars().take(16).collect();
        view! {
            <tr>
                <th scope="row" class="bad">{format!("{start}…")}</th>
                <td class="bad" colspan="3">{tr!(lab, lesson.bad_code)}</td>
            </tr>
        }
        .into_any()
    });
    view! {
        <table class="plain">
            <thead>
                <tr>
                    <th scope="col">{tr!(lab, lesson.student)}</th>
                    <th scope="col">{tr!(lab, lesson.lesson)}</th>
                    <th scope="col">{tr!(lab, lesson.of_hundred)}</th>
                    <th scope="col">{tr!(lab, lesson.time_min)}</th>
                </tr>
            </thead>
            <tbody>{rows.collect_view()}</tbody>
        </table>
    }
}

/// The reports as comma-separated values, with names as in files, not as on the screen.
fn csv(lines: &[Line]) -> String {
    let row = |report: &Report| {
        let Report { lesson, fingerprint, name, seed, seconds, score, .. } = report;
        format!("{},{},{fingerprint},{score},{seconds},{seed}", field(name), field(lesson))
    };
    let rows = lines.iter().filter_map(|(_, report)| report.as_ref().ok()).map(row);
    let mut table: Vec<String> =
        std::iter::once("name,lesson,fingerprint,score,seconds,seed".to_owned()).chain(rows).collect();
    table.push(String::new());
    table.join("\n")
}

/// A text as a field (RFC 4180). A spreadsheet takes what begins with one of these signs for a formula.
fn field(text: &str) -> String {
    let guard = if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { "'" } else { "" };
    format!("\"{guard}{}\"", text.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::{csv, field, read};

    #[test]
    fn a_name_is_no_formula_and_ends_no_field() {
        assert_eq!(field("Ana \"A\" Souza"), "\"Ana \"\"A\"\" Souza\"");
        assert_eq!(field("=1+1"), "\"'=1+1\"");
    }

    #[test]
    fn a_line_that_is_no_code_is_one_among_others() {
        let lines = read("QL1-damaged\n\n  x \n");
        assert_eq!(lines.len(), 2);
        assert!(lines.iter().all(|(_, report)| report.is_err()));
        assert_eq!(csv(&lines).lines().count(), 1);
    }
}
