use gloo_timers::future::TimeoutFuture;
use leptos::mount::mount_to;
use leptos::prelude::*;
use quadtank_lab::{BENCHES, BenchEntry, Laboratory};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Event, EventInit, HtmlElement, HtmlInputElement};

/// Marks of the page for words that are still to follow the charts.
const UNTOLD: [&str; 2] = ["quadtank:untold-a", "quadtank:untold-b"];
/// Longest wait for the words (ms), and the time between two looks.
const PATIENCE_MS: u32 = 10_000;
const LOOK_MS: u32 = 20;

/// The laboratory in an element of its own, as a visitor of an address meets it. It leaves the page when it is dropped.
pub struct Page {
    root: HtmlElement,
    _mounted: Box<dyn std::any::Any>,
}

impl Page {
    /// Opens the laboratory with a query such as `bench=relay-tuning&lang=en`.
    pub async fn open(query: &str) -> Self {
        Self::with(&BENCHES, query).await
    }

    /// Opens a laboratory with other benches.
    pub async fn with(benches: &'static [BenchEntry], query: &str) -> Self {
        let history = window().history().expect("a page has a history");
        history
            .replace_state_with_url(&JsValue::NULL, "", Some(&format!("?{query}")))
            .expect("a query is a valid address");
        let root: HtmlElement = document().create_element("div").expect("a div").unchecked_into();
        document().body().expect("a page has a body").append_child(&root).expect("an element can be added");
        let mounted = Box::new(mount_to(root.clone(), move || view! { <Laboratory benches /> }));
        let page = Self { root, _mounted: mounted };
        page.settle().await;
        page
    }

    /// Waits until what was asked for is computed, painted and said.
    pub async fn settle(&self) {
        let performance = window().performance().expect("a browser has a clock");
        for _ in 0..PATIENCE_MS / LOOK_MS {
            TimeoutFuture::new(LOOK_MS).await;
            if UNTOLD.iter().all(|mark| performance.get_entries_by_name(mark).length() == 0) {
                return;
            }
        }
        panic!("the words did not follow within {PATIENCE_MS} ms");
    }

    fn element(&self, id: &str) -> HtmlElement {
        let found = self.root.query_selector(&format!("[data-testid=\"{id}\"]")).expect("a valid selector");
        found.unwrap_or_else(|| panic!("no element is called {id}")).unchecked_into()
    }

    /// The text of an element, with plain spaces.
    pub fn text(&self, id: &str) -> String {
        self.element(id).text_content().unwrap_or_default().replace('\u{a0}', " ").replace('\u{2060}', "")
    }

    /// The first number in the text of an element.
    pub fn number(&self, id: &str) -> f64 {
        let text = self.text(id).replace('−', "-");
        let is_part = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
        let number = text.split(|c| !is_part(c)).find_map(|part| part.parse().ok());
        number.unwrap_or_else(|| panic!("{id} says no number: {text}"))
    }

    /// Moves a slider, or types into a field, and waits for what follows.
    pub async fn set(&self, id: &str, value: &str) {
        let input: HtmlInputElement = self.element(id).unchecked_into();
        input.set_value(value);
        for name in ["input", "change"] {
            let bubbling = EventInit::new();
            bubbling.set_bubbles(true);
            let event = Event::new_with_event_init_dict(name, &bubbling).expect("an event can be made");
            input.dispatch_event(&event).expect("an event can be sent");
        }
        self.settle().await;
    }

    /// Whether a control cannot be used.
    pub fn is_disabled(&self, id: &str) -> bool {
        self.element(id).has_attribute("disabled")
    }

    /// Presses a button and waits for what follows.
    pub async fn press(&self, id: &str) {
        self.element(id).click();
        self.settle().await;
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        self.root.remove();
    }
}
