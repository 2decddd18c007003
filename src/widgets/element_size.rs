//! The size of an element, followed.

use js_sys::Array;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use leptos::wasm_bindgen::prelude::Closure;
use web_sys::{Element, ResizeObserver, ResizeObserverEntry};

use quadtank_figure::Size;

/// Keeps `size` at the size of the content of an element until the owner is disposed of.
pub fn follow_size(element: &Element, size: RwSignal<Size>) {
    let on_resize = Closure::<dyn FnMut(Array)>::new(move |entries: Array| {
        if let Some(rect) = entries.get(0).dyn_ref().map(ResizeObserverEntry::content_rect) {
            let _ = size.try_set(Size { width: rect.width(), height: rect.height() });
        }
    });
    // Fails only in a browser that has no such observer, and none that runs this module lacks it.
    if let Ok(observer) = ResizeObserver::new(on_resize.as_ref().unchecked_ref()) {
        observer.observe(element);
        let kept = StoredValue::new_local((observer, on_resize));
        on_cleanup(move || kept.with_value(|(observer, _)| observer.disconnect()));
    }
}
