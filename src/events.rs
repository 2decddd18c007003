//! Where events of the browser happen.

use leptos::wasm_bindgen::JsCast;
use web_sys::{Element, Event};

/// Whether the element of an event is one of those that a CSS selector names.
pub fn is_at(event: &Event, selector: &str) -> bool {
    let element = event.target().and_then(|target| target.dyn_into::<Element>().ok());
    element.is_some_and(|element| element.matches(selector).unwrap_or(false))
}
