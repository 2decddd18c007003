use leptos::prelude::*;

/// An option of a [`Select`].
#[derive(Clone, PartialEq)]
pub struct Choice<T> {
    /// What it stands for.
    pub value: T,
    /// Its name in the page, different for each choice.
    pub name: String,
    /// Its text.
    pub text: String,
}

impl<T> Choice<T> {
    /// A choice of a `value`.
    pub fn new(value: T, name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { value, name: name.into(), text: text.into() }
    }
}

/// A choice of one among many.
#[component]
pub fn Select<T>(
    /// Name for tests.
    id: &'static str,
    /// What is chosen, for screen readers; nothing where a label says it.
    #[prop(optional, into)]
    name: Option<Signal<String>>,
    /// The id that a label refers to.
    #[prop(optional)]
    labelled: Option<&'static str>,
    /// What to know about the choice in force.
    #[prop(optional, into)]
    title: Option<Signal<String>>,
    /// What can be chosen.
    #[prop(into)]
    choices: Signal<Vec<Choice<T>>>,
    /// What is chosen.
    #[prop(into)]
    chosen: Signal<T>,
    /// Called with another choice.
    #[prop(into)]
    on_choose: Callback<T>,
    /// Whether the choice is locked.
    disabled: bool,
) -> impl IntoView
where
    T: Clone + PartialEq + Send + Sync + 'static,
{
    // Both may be updated without a change; the options of the page then stay as they are.
    let (choices, chosen) = (Memo::new(move |_| choices.get()), Memo::new(move |_| chosen.get()));
    let choose = move |event| {
        let name = event_target_value(&event);
        let value = choices
            .with_untracked(|all| all.iter().find(|choice| choice.name == name).map(|choice| choice.value.clone()));
        if let Some(value) = value {
            on_choose.run(value);
        }
    };
    view! {
        <select id=labelled data-testid=id aria-label=name title=title disabled=disabled on:change=choose>
            // Keyed, because the browser remembers a choice with its option: one that is reused would take it along.
            <For each=move || choices.get() key=|choice| (choice.name.clone(), choice.text.clone()) let(choice)>
                <option value=choice.name prop:selected=move || chosen.with(|chosen| *chosen == choice.value)>
                    {choice.text}
                </option>
            </For>
        </select>
    }
}
