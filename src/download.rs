//! Files that the page hands to its reader, and links on the clipboard.

use leptos::prelude::{document, window};
use leptos::wasm_bindgen::closure::Closure;
use leptos::wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, HtmlCanvasElement, Url};

/// Whether the page is the one-file build, which has nothing beside it to download.
pub fn is_single_file() -> bool {
    document().document_element().is_some_and(|root| root.has_attribute("data-single"))
}

/// Hands over a text as a file.
pub fn download_text(name: &str, mime: &str, text: &str) {
    download_part(name, mime, &JsValue::from_str(text));
}

/// Hands over bytes as a file.
pub fn download_bytes(name: &str, mime: &str, bytes: &[u8]) {
    download_part(name, mime, &js_sys::Uint8Array::from(bytes));
}

fn download_part(name: &str, mime: &str, part: &JsValue) {
    let parts = js_sys::Array::of1(part);
    let kind = BlobPropertyBag::new();
    kind.set_type(mime);
    if let Ok(blob) = Blob::new_with_str_sequence_and_options(&parts, &kind) {
        download(name, &blob);
    }
}

/// Hands over a canvas as a PNG file.
pub fn download_canvas(name: &str, canvas: &HtmlCanvasElement) {
    let name = name.to_owned();
    let save = Closure::once_into_js(move |blob: Option<Blob>| {
        if let Some(blob) = blob {
            download(&name, &blob);
        }
    });
    let _ = canvas.to_blob(save.unchecked_ref());
}

fn download(name: &str, blob: &Blob) {
    let Ok(url) = Url::create_object_url_with_blob(blob) else { return };
    if let Ok(Ok(anchor)) = document().create_element("a").map(JsCast::dyn_into::<HtmlAnchorElement>) {
        anchor.set_href(&url);
        anchor.set_download(name);
        anchor.click();
    }
    // Revoked too early, the address would be gone before the browser has taken its copy.
    gloo_timers::callback::Timeout::new(1000, move || {
        let _ = Url::revoke_object_url(&url);
    })
    .forget();
}

/// Puts a text on the clipboard, then says whether that worked. Where there is no clipboard (an insecure origin, a
/// sandboxed frame) it did not.
pub fn copy(text: &str, then: impl FnOnce(bool) + 'static) {
    let navigator = window().navigator();
    // The typed accessor assumes a clipboard; on an insecure origin there is none.
    let has_clipboard =
        js_sys::Reflect::get(&navigator, &"clipboard".into()).is_ok_and(|clipboard| clipboard.is_object());
    if !has_clipboard || !frame_may_write() {
        then(false);
        return;
    }
    let written = navigator.clipboard().write_text(text);
    leptos::task::spawn_local(async move {
        then(wasm_bindgen_futures::JsFuture::from(written).await.is_ok());
    });
}

/// Whether the frame around the page lets it write to the clipboard. Trying without permission would leave an error in the
/// console; a browser that has no such policy is simply tried.
fn frame_may_write() -> bool {
    let Ok(policy) = js_sys::Reflect::get(&leptos::prelude::document(), &"featurePolicy".into()) else { return true };
    let Ok(allows) = js_sys::Reflect::get(&policy, &"allowsFeature".into()) else { return true };
    match allows.dyn_into::<js_sys::Function>() {
        Ok(allows) => allows.call1(&policy, &"clipboard-write".into()).is_ok_and(|answer| answer.is_truthy()),
        Err(_) => true,
    }
}
