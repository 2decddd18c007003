//! The name and the note of an experiment.

use leptos::prelude::*;
use quadtank_scenario::Label;

use super::lab::{Lab, use_lab};
use super::texts::say;
use super::widgets::{TextField, limited};

/// Fields for name and note of the experiment on the bench that is shown.
#[component]
pub fn NameFields() -> impl IntoView {
    let lab = use_lab();
    let label = move || (lab.bench.get().label)(lab);
    let change = move |change: &dyn Fn(&mut Label)| {
        let mut label = untrack(label);
        change(&mut label);
        (lab.bench.get_untracked().set_label)(lab, label);
    };
    let rename = move |name: String| change(&|label| label.name.clone_from(&name));
    let note = move |event| {
        let note = limited(&event_target_value(&event), Label::MAX_NOTE);
        change(&|label| label.note.clone_from(&note));
    };
    view! {
        <TextField
            id="experiment-name"
            label=say!(lab, naming.name)
            value=Signal::derive(move || label().name)
            max=Label::MAX_NAME
            on_change=rename
        />
        <label class="text">
            {say!(lab, naming.note)}
            <textarea
                class="text-field"
                rows="3"
                maxlength=Label::MAX_NOTE
                data-testid="experiment-note"
                prop:value=move || label().note
                on:change=note
            ></textarea>
        </label>
    }
}

/// The name in the header, where there is one.
#[component]
pub fn ExperimentName() -> impl IntoView {
    let lab = use_lab();
    let label = Memo::new(move |_| (lab.bench.get().label)(lab));
    view! {
        <span class="experiment-name" data-testid="shown-name" title=move || label.get().note hidden=move || label.with(|l| l.name.is_empty())>
            {move || label.get().name}
        </span>
    }
}

/// What a file of the experiment is called: its name in letters that every file system takes, before `usual`.
pub fn file_name(lab: Lab, usual: &str) -> String {
    let name = untrack(|| (lab.bench.get_untracked().label)(lab)).name;
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let slug = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    if slug.is_empty() { usual.to_owned() } else { format!("{slug}-{usual}") }
}
