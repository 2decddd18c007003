//! Long work in slices, between which the browser paints and answers.

use std::cell::Cell;
use std::rc::Rc;

use js_sys::Promise;
use leptos::wasm_bindgen::JsValue;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::MessageChannel;

use super::timing::now_ms;

/// How long a slice takes at most, but for its last step (ms): two of them and the browser share a frame.
const SLICE_MS: f64 = 6.0;

/// Work that goes on until it is done or this handle is dropped.
pub struct Slices {
    is_dropped: Rc<Cell<bool>>,
}

impl Drop for Slices {
    fn drop(&mut self) {
        self.is_dropped.set(true);
    }
}

impl Slices {
    /// Calls `step` until it says that nothing is left, and `after_slice` after each slice with whether that was the last.
    pub fn start(mut step: impl FnMut() -> bool + 'static, mut after_slice: impl FnMut(bool) + 'static) -> Self {
        let is_dropped = Rc::new(Cell::new(false));
        let stop = Rc::clone(&is_dropped);
        spawn_local(async move {
            let mut goes_on = true;
            while goes_on {
                wait_for_browser().await;
                if stop.get() {
                    return;
                }
                let begin = now_ms();
                while goes_on && now_ms() - begin < SLICE_MS {
                    goes_on = step();
                }
                after_slice(!goes_on);
            }
        });
        Self { is_dropped }
    }
}

/// Waits until the browser has done what it has to do. A message to oneself comes after that; a timer, the usual means, waits for 4 ms
/// besides, which makes a map of 40 slices a third slower. Without message channels it does not wait.
async fn wait_for_browser() {
    let Ok(channel) = MessageChannel::new() else { return };
    let message = Promise::new(&mut |resolve, _| {
        channel.port1().set_onmessage(Some(&resolve));
        // Only a closed channel refuses a message.
        let _ = channel.port2().post_message(&JsValue::NULL);
    });
    // A promise that only ever resolves.
    let _ = JsFuture::from(message).await;
    channel.port1().close();
}
