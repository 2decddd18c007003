//! Stands in for the crate `wasm-streams`.
//!
//! Leptos brings server functions along, and with them `wasm-streams`, whose classes are exported to JavaScript: no linker
//! may drop them, though nothing here calls a server. That is 11 KB of code and a fifth of the glue script. What is left
//! here is the interface that `server_fn` compiles against; nobody calls it, and a stream from it is empty.

use futures_util::stream::{self, Stream};
use wasm_bindgen::JsValue;

/// A stream of the browser.
#[derive(Debug)]
pub struct ReadableStream(web_sys::ReadableStream);

impl ReadableStream {
    /// Wraps a stream of the browser.
    pub fn from_raw(raw: web_sys::ReadableStream) -> Self {
        Self(raw)
    }

    /// The stream of the browser.
    pub fn into_raw(self) -> web_sys::ReadableStream {
        self.0
    }

    /// Would hand a stream to the browser; this one gets nothing.
    pub fn from_stream(_stream: impl Stream<Item = Result<JsValue, JsValue>> + 'static) -> Self {
        Self(JsValue::UNDEFINED.into())
    }

    /// Would read the stream; there is nothing in it.
    pub fn into_stream(self) -> impl Stream<Item = Result<JsValue, JsValue>> {
        stream::empty()
    }
}
