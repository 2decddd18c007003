//! The experiment of the home bench as a script in another language.

use leptos::prelude::*;
use quadtank_export::{ExportError, Language, export};
use quadtank_scenario::{Document, ScenarioError};

use super::download::download_text;
use super::lab::{Lab, Notice, use_lab};
use super::texts::tr;

/// A button for each language, where the bench has an experiment that can be exported.
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
    move || has_scripts.get().then(|| Language::ALL.map(button))
}

/// Hands the script over under the name that its language finds it by, or says why there is none.
fn save(lab: Lab, language: Language) {
    let Document::Quadruple(scenario) = (lab.bench.get_untracked().document)(lab) else { return };
    match export(&scenario, language) {
        Ok(script) => download_text(language.file_name(), language.media_type(), &script),
        Err(ExportError::Scenario(error)) => lab.notice.set(Some(Notice::Refused(error))),
        Err(ExportError::Study(error)) => {
            lab.notice.set(Some(Notice::Refused(ScenarioError::Study { setup: "setup", error })));
        }
    }
}
