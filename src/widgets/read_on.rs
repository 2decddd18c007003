use leptos::prelude::*;

use crate::download::is_single_file;
use crate::lab::use_lab;
use crate::texts::say;

/// The page of the document about the model, beside the laboratory.
pub const MODEL: &str = "model.html";

/// A link to the document about the model, beside the experiment; the single file does not have it.
#[component]
pub fn ReadOn(
    /// The section, as its address names it; empty for the beginning.
    #[prop(optional)]
    section: &'static str,
) -> impl IntoView {
    let lab = use_lab();
    let address = if section.is_empty() { MODEL.to_owned() } else { format!("{MODEL}#{section}") };
    (!is_single_file()).then(|| {
        view! { <a class="read-on" href=address target="_blank" rel="noopener">{say!(lab, lesson.read_on)}</a> }
    })
}
