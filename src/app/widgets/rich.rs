use leptos::prelude::*;

/// A sentence in which the parts between `**` are bold. The only markup that the texts know.
pub fn rich(text: &str) -> Vec<AnyView> {
    text.split("**")
        .enumerate()
        .map(|(k, part)| {
            let part = part.to_owned();
            if k % 2 == 1 { view! { <b>{part}</b> }.into_any() } else { part.into_any() }
        })
        .collect()
}
