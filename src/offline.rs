//! The laboratory without a network: the service worker keeps the site, and the page says so.

use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use leptos::wasm_bindgen::closure::Closure;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::lab::{Lab, Notice};

/// The service worker.
const WORKER: &str = "offline.js";

/// Keeps the site for the next time, where the browser allows it. The single file needs nothing, and a frame is not the place.
pub fn keep_site(lab: Lab) {
    let is_single = document().document_element().is_some_and(|root| root.has_attribute("data-single"));
    if is_single || lab.flags.with_value(|flags| flags.embed) || !window().is_secure_context() {
        return;
    }
    let Some(workers) = workers() else { return };
    let was_kept = workers.controller().is_some();
    spawn_local(async move {
        let Ok(registration) = JsFuture::from(workers.register(WORKER)).await else { return };
        let Ok(registration) = registration.dyn_into::<web_sys::ServiceWorkerRegistration>() else { return };
        lab.offline.set(was_kept);
        if registration.waiting().is_some() && was_kept {
            lab.notice.set(Some(Notice::NewEdition));
        }
        if let Some(worker) = registration.installing() {
            let changed = worker.clone();
            let on_change = Closure::<dyn Fn()>::new(move || {
                if changed.state() == web_sys::ServiceWorkerState::Installed {
                    lab.offline.set(true);
                    if was_kept {
                        lab.notice.set(Some(Notice::NewEdition));
                    }
                }
            });
            worker.set_onstatechange(Some(on_change.as_ref().unchecked_ref()));
            // It lives as long as the page.
            on_change.forget();
        }
    });
}

/// What keeps the site. Not there in private windows of some browsers; in a sandbox the mere question is an error.
fn workers() -> Option<web_sys::ServiceWorkerContainer> {
    let navigator = window().navigator();
    js_sys::Reflect::get(&navigator, &"serviceWorker".into()).ok()?.dyn_into().ok()
}

/// Begins with the new edition at once.
pub fn begin_anew() {
    spawn_local(async move {
        let Some(workers) = workers() else { return };
        let registration = JsFuture::from(workers.get_registration()).await;
        let waiting = registration
            .ok()
            .and_then(|found| found.dyn_into::<web_sys::ServiceWorkerRegistration>().ok())
            .and_then(|registration| registration.waiting());
        if let Some(worker) = waiting {
            let _ = worker.post_message(&"begin".into());
        }
        let _ = window().location().reload();
    });
}
