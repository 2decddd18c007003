use super::handler;
use leptos::prelude::*;

/// A table that is folded away, and worked out only while it is open.
pub fn folded(
    id: &'static str,
    summary: Signal<String>,
    caption: Signal<String>,
    content: Box<dyn Fn() -> String + Send + Sync>,
) -> AnyView {
    let open = RwSignal::new(false);
    let content = Signal::derive(move || if open.get() { content() } else { String::new() });
    view! {
        <details class="more" on:toggle=handler(move |_| open.update(|o| *o = !*o))>
            <summary data-testid=id>{summary}</summary>
            <div class="scroll" tabindex="0" role="region" aria-label=caption>
                <table class="plain" inner_html=content></table>
            </div>
        </details>
    }
    .into_any()
}
