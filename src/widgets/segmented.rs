use leptos::prelude::*;

/// A choice of one among few, as a row of buttons.
#[component]
pub fn Segmented<T>(
    /// What is chosen between, for screen readers.
    #[prop(into)]
    label: Signal<String>,
    /// The choices with their texts, and the name by which tests find each button.
    choices: Vec<(T, &'static str, Signal<String>)>,
    /// The choice in force.
    #[prop(into)]
    value: Signal<T>,
    /// Called with the new choice.
    #[prop(into)]
    on_choose: Callback<T>,
    /// The choice that carries a tag, with the text of that.
    #[prop(optional, into)]
    tag: Option<Signal<Option<(T, String)>>>,
    /// Whether the choice is locked.
    #[prop(into)]
    disabled: Signal<bool>,
) -> impl IntoView
where
    T: Copy + PartialEq + Send + Sync + 'static,
{
    let buttons = choices
        .into_iter()
        .map(|(choice, name, text)| {
            let tag = move || {
                let of_this = tag.and_then(|tag| tag.get()).filter(|(tagged, _)| *tagged == choice);
                of_this.map(|(_, text)| view! { " "<span class="tag">{text}</span> })
            };
            view! {
                <button
                    type="button"
                    data-testid=name
                    aria-pressed=move || (value.get() == choice).to_string()
                    disabled=disabled
                    on:click=move |_| on_choose.run(choice)
                >
                    {text}
                    {tag}
                </button>
            }
        })
        .collect_view();
    view! { <div class="segmented" role="group" aria-label=label title=label>{buttons}</div> }
}
