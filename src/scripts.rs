//! The experiment of the home bench as a script in another language, and its model as LaTeX.

use leptos::prelude::*;
use quadtank_export::{ExportError, LATEX_FILE_NAME, LATEX_MEDIA_TYPE, Language, export, latex};
use quadtank_scenario::{Document, Scenario, ScenarioError};

use super::download::download_text;
use super::lab::{Lab, Notice, use_lab};
use super::texts::{say, tr};

/// A button for each language and for LaTeX, where the bench has an experiment that can be exported.
#[component]
pub fn Scripts() -> impl IntoView {
    let lab = use_lab();
    let has_scripts = Memo::new(move |_| matches!((lab.bench.get().document)(lab), Document::Quadruple(_)));
    let button = move |language: Language| {
        let text = move || {
            if language.is_checked() {
                tr!(lab, app.script, name = language.name())
            } else {
                tr!(lab, app.script_untried, name = language.name())
            }
        };
        view! {
            <button type="button" data-testid=format!("script-{}", language.extension()) on:click=move |_| save(lab, language)>
                {text}
            </button>
        }
    };
    move || {
        has_scripts.get().then(|| {
            view! {
                {Language::ALL.map(button)}
                <button type="button" data-testid="script-tex" on:click=move |_| save_latex(lab)>{say!(lab, app.latex)}</button>
            }
        })
    }
}

/// Hands the script over under the name that its language finds it by, or says why there is none.
fn save(lab: Lab, language: Language) {
    hand_over(lab, language.file_name(), language.media_type(), |scenario| export(scenario, language));
}

/// The same of linear model and controller as LaTeX.
fn save_latex(lab: Lab) {
    hand_over(lab, LATEX_FILE_NAME, LATEX_MEDIA_TYPE, latex);
}

fn hand_over(lab: Lab, name: &str, mime: &str, write: impl Fn(&Scenario) -> Result<String, ExportError>) {
    let Document::Quadruple(scenario) = (lab.bench.get_untracked().document)(lab) else { return };
    match write(&scenario) {
        Ok(text) => download_text(name, mime, &text),
        Err(ExportError::Scenario(error)) => lab.notice.set(Some(Notice::NotWritten(error))),
        Err(ExportError::Study(error)) => {
            lab.notice.set(Some(Notice::Refused(ScenarioError::Study { setup: "setup", error })));
        }
    }
}
