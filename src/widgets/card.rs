use leptos::prelude::*;

use super::html::rich;

/// A card: its title with what stands beside it, and its content. Its class names it.
pub fn card(name: &'static str, title: Signal<String>, beside: Vec<AnyView>, content: Vec<AnyView>) -> AnyView {
    let heading = format!("{name}-title");
    let labelled_by = heading.clone();
    view! {
        <section class=format!("card {name}") aria-labelledby=labelled_by>
            <header><h2 id=heading>{title}</h2>{beside}</header>
            {content}
        </section>
    }
    .into_any()
}

/// A grey remark beside a title.
pub fn remark(text: Signal<String>) -> AnyView {
    view! { <span class="remark">{text}</span> }.into_any()
}

/// A sentence under a picture.
pub fn sentence(id: &'static str, text: Signal<String>) -> AnyView {
    let html = Signal::derive(move || rich(&text.get()));
    view! { <p class="sentence" data-testid=id inner_html=html></p> }.into_any()
}

/// What came out, as HTML, and whether it is a warning.
pub fn verdict(id: String, warm: Signal<bool>, html: Signal<String>) -> AnyView {
    let class = Signal::derive(move || if warm.get() { "verdict warm" } else { "verdict" }.to_owned());
    view! { <div class=class role="status" data-testid=id inner_html=html></div> }.into_any()
}

/// A table that may be wider than its place.
pub fn figures(name: &'static str, caption: Signal<String>, content: Signal<String>) -> AnyView {
    view! {
        <div class="scroll" tabindex="0" role="region" aria-label=caption>
            <table class="plain" data-testid=name inner_html=content></table>
        </div>
    }
    .into_any()
}
