//! Messages between the laboratory in a frame and the page around it (`docs/embedding.md`).
//!
//! What the laboratory says goes only to the origins of the flag `origins`, and only what comes from them is heard. Its height and
//! that it is ready tell nothing about a student, so they go to any parent.

use js_sys::{Object, Reflect};
use leptos::ev;
use leptos::prelude::*;
use leptos::wasm_bindgen::JsCast;
use leptos::wasm_bindgen::JsValue;
use leptos::wasm_bindgen::closure::Closure;
use quadtank_scenario::document_from_link;

use super::lab::Lab;
use super::lessons::Classroom;

/// The field that names the kind of a message.
const KIND: &str = "quadtank";
/// Any origin.
const ANY: &str = "*";

/// Begins to talk to the page around, where there is one.
pub fn talk(lab: Lab, room: Classroom) {
    if parent().is_none() {
        return;
    }
    let on_message = window_event_listener(ev::message, move |event| hear(lab, &event));
    on_cleanup(move || on_message.remove());
    follow_height(lab);
    say_to(ANY, "ready", &[("version", env!("CARGO_PKG_VERSION").into())]);
    // Without an origin that may hear, nothing of a student is even put together.
    if lab.flags.with_value(|flags| flags.origins.is_empty()) {
        return;
    }
    // A link takes a millisecond, so it is made as often as texts are, not in every frame of a drag.
    Effect::new(move |before: Option<Option<String>>| {
        let bench = lab.bench.get();
        lab.track_texts();
        let link = untrack(|| (bench.link)(lab)).ok();
        if let Some(link) = link.as_ref().filter(|link| before.flatten().as_ref() != Some(link)) {
            tell(lab, "state", &[("state", link.into())]);
        }
        link
    });
    Effect::new(move || {
        let (Some(given), Some(lesson)) = (room.given.get(), room.lesson.get_untracked()) else { return };
        let about =
            [("lesson", lesson.id.clone().into()), ("task", given.task.into()), ("right", given.is_right.into())];
        tell(lab, "answer", &about);
    });
    let score = Memo::new(move |_| {
        let lesson = room.lesson.get()?;
        let (score, is_complete) =
            room.progress.with(|progress| progress.as_ref().map(|p| (p.score(&lesson), p.is_complete(&lesson))))?;
        Some((lesson.id.clone(), score, is_complete))
    });
    Effect::new(move || {
        if let Some((lesson, score, is_complete)) = score.get() {
            let about = [("lesson", lesson.into()), ("score", score.into()), ("complete", is_complete.into())];
            tell(lab, "score", &about);
        }
    });
}

/// The page around, if there is one.
fn parent() -> Option<web_sys::Window> {
    let parent = window().parent().ok().flatten()?;
    (parent != window()).then_some(parent)
}

/// Says something to the origins that the address allows.
fn tell(lab: Lab, kind: &str, about: &[(&str, JsValue)]) {
    lab.flags.with_value(|flags| flags.origins.iter().for_each(|origin| say_to(origin, kind, about)));
}

fn say_to(origin: &str, kind: &str, about: &[(&str, JsValue)]) {
    let message = Object::new();
    // A plain object takes every field.
    let _ = Reflect::set(&message, &KIND.into(), &kind.into());
    for (name, value) in about {
        let _ = Reflect::set(&message, &(*name).into(), value);
    }
    if let Some(parent) = parent() {
        let _ = parent.post_message(&message, origin);
    }
}

/// Opens the state that an allowed page sends. Anything else is not for the laboratory.
fn hear(lab: Lab, event: &web_sys::MessageEvent) {
    if !lab.flags.with_value(|flags| flags.origins.contains(&event.origin())) {
        return;
    }
    let field = |name: &str| Reflect::get(&event.data(), &name.into()).ok().and_then(|value| value.as_string());
    if field(KIND).as_deref() == Some("open")
        && let Some(state) = field("state")
    {
        lab.open(document_from_link(&state));
    }
}

/// Tells the page around how high the content is, whenever that changes.
fn follow_height(lab: Lab) {
    let Some(body) = document().body() else { return };
    let asks_for_lesson = lab.flags.with_value(|flags| flags.lesson.is_some());
    // What was told last, and whether it was of a lesson.
    let last = StoredValue::new(None::<(i32, bool)>);
    let tell = Closure::<dyn Fn()>::new(move || {
        let is_lesson = lab.stage.with_untracked(Option::is_some);
        let before = last.get_value();
        let height = if is_lesson {
            // From step to step it only grows, so that the page around does not jump.
            let reached = before.filter(|(_, was_lesson)| *was_lesson).map_or(0, |(height, _)| height);
            lesson_height(lab).map(|height| height.max(reached))
        } else {
            // A frame as high as the bench that stands there until the lesson has arrived would stay so.
            (before.is_some() || !asks_for_lesson).then(|| body.scroll_height())
        };
        if let Some(height) = height.filter(|height| before != Some((*height, is_lesson))) {
            last.set_value(Some((height, is_lesson)));
            say_to(ANY, "height", &[("height", height.into())]);
        }
    });
    if let Ok(observer) = web_sys::ResizeObserver::new(tell.as_ref().unchecked_ref()) {
        // The places of the benches are there once the page is: a bench beside a lesson may be lower than the lesson.
        Effect::new(move || elements("body, .desk > div").iter().for_each(|element| observer.observe(element)));
    }
    // It lives as long as the page.
    tell.forget();
}

/// The height that a frame with a lesson needs so that the bench does not scroll, within limits, where the page around gives it. The text
/// fills the frame, however high that is, and scrolls; on a narrow screen the bench does so too.
fn lesson_height(lab: Lab) -> Option<i32> {
    /// Text and bench stand beside each other (`style/lessons.css`).
    const SIDE_BY_SIDE: &str = "(min-width: 860px)";
    /// Least and largest height: that of a new frame of the web component, and of a large window (CSS px).
    const HEIGHTS_PX: (i32, i32) = (720, 1200);
    let is_wide = window().match_media(SIDE_BY_SIDE).ok().flatten().is_some_and(|query| query.matches());
    if !is_wide || !lab.flags.with_value(|flags| flags.grows) {
        return None;
    }
    let height_of = |selector| elements(selector).first().map(web_sys::Element::client_height);
    let around = document().body()?.scroll_height() - height_of(".desk")?;
    Some((around + height_of(".desk > div:not([hidden])")?).clamp(HEIGHTS_PX.0, HEIGHTS_PX.1))
}

fn elements(selector: &str) -> Vec<web_sys::Element> {
    let Ok(found) = document().query_selector_all(selector) else { return Vec::new() };
    (0..found.length()).filter_map(|index| found.get(index)?.dyn_into().ok()).collect()
}
