//! The lesson inside a learning management system: SCORM 1.2 (ADL, Run-Time Environment, 2001).
//!
//! The system offers an object `API` in a window around this one. Nothing it does may stop the lesson: each call can fail, and then
//! the lesson goes on without it.

use std::cell::RefCell;

use js_sys::{Array, Function, Reflect};
use leptos::prelude::window;
use leptos::wasm_bindgen::{JsCast, JsValue};
use quadtank_lesson::{Lesson, Progress, points_of};

/// How many windows up the object is looked for.
const FARTHEST: usize = 10;

thread_local! {
    static COURSE: RefCell<Option<Course>> = const { RefCell::new(None) };
}

/// A session with the system.
struct Course {
    api: JsValue,
    begun_at_s: f64,
    /// Whether the student only looks at what was done: then nothing is written.
    is_review: bool,
}

impl Course {
    fn call(&self, function: &str, arguments: &[&str]) -> Option<String> {
        let function: Function = Reflect::get(&self.api, &function.into()).ok()?.dyn_into().ok()?;
        let arguments: Array = arguments.iter().map(|argument| JsValue::from_str(argument)).collect();
        let answer = Reflect::apply(&function, &self.api, &arguments).ok()?;
        // Systems answer with text, but some with true or false.
        answer.as_string().or_else(|| answer.as_bool().map(|answer| answer.to_string()))
    }

    fn get(&self, element: &str) -> String {
        self.call("LMSGetValue", &[element]).unwrap_or_default()
    }

    fn set(&self, element: &str, value: &str) {
        if !self.is_review {
            let _ = self.call("LMSSetValue", &[element, value]);
        }
    }
}

/// Finds the system, if there is one, and begins a session.
pub fn begin() {
    let Some(api) = find() else { return };
    let mut course = Course { api, begun_at_s: js_sys::Date::now() / 1000.0, is_review: false };
    if course.call("LMSInitialize", &[""]).as_deref() != Some("true") {
        return;
    }
    // An empty mode, as some systems answer, is the normal one.
    course.is_review = course.get("cmi.core.lesson_mode") == "review";
    if matches!(course.get("cmi.core.lesson_status").as_str(), "" | "not attempted") {
        course.set("cmi.core.lesson_status", "incomplete");
    }
    // Said at once: a page that the browser lays aside may never get to say it.
    course.set("cmi.core.exit", "suspend");
    COURSE.set(Some(course));
}

/// Whether there is a system, which keeps what is done.
pub fn is_there() -> bool {
    COURSE.with_borrow(Option::is_some)
}

/// What the system kept of a lesson.
pub fn resumed(lesson: &Lesson) -> Option<Progress> {
    let text = COURSE.with_borrow(|course| course.as_ref().map(|course| course.get("cmi.suspend_data")))?;
    Progress::from_suspend_data(&text, lesson)
}

/// The name of the student, as the system knows it.
pub fn student() -> Option<String> {
    let name = COURSE.with_borrow(|course| course.as_ref().map(|course| course.get("cmi.core.student_name")))?;
    (!name.trim().is_empty()).then_some(name)
}

/// Hands over what was done so far.
pub fn commit(lesson: &Lesson, progress: &Progress) {
    COURSE.with_borrow(|course| {
        let Some(course) = course.as_ref().filter(|course| !course.is_review) else { return };
        let set = |element: &str, value: &str| course.set(element, value);
        set("cmi.core.score.min", "0");
        set("cmi.core.score.max", "100");
        set("cmi.core.score.raw", &progress.score(lesson).to_string());
        let status = if progress.is_complete(lesson) { "completed" } else { "incomplete" };
        set("cmi.core.lesson_status", status);
        set("cmi.core.lesson_location", &progress.step.to_string());
        set("cmi.core.session_time", &session_time(js_sys::Date::now() / 1000.0 - course.begun_at_s));
        set("cmi.suspend_data", &progress.to_suspend_data());
        for (index, (_, task)) in lesson.tasks().enumerate() {
            let record = progress.record(&task.id);
            let objective = |field: &str| format!("cmi.objectives.{index}.{field}");
            set(&objective("id"), &task.id);
            let score =
                (100 * points_of(task, &record)).checked_div(task.points).unwrap_or(100 * u32::from(record.solved));
            set(&objective("score.raw"), &score.to_string());
            let status = match (record.is_done(), record.solved) {
                (true, true) => "completed",
                (true, false) => "failed",
                _ => "incomplete",
            };
            set(&objective("status"), status);
        }
        let _ = course.call("LMSCommit", &[""]);
    });
}

/// Ends the session.
pub fn finish() {
    if let Some(course) = COURSE.take() {
        let _ = course.call("LMSFinish", &[""]);
    }
}

/// The object of the system: in this window, in one around it, or in the one that opened it. A window of another origin refuses.
fn find() -> Option<JsValue> {
    let here: JsValue = window().into();
    let opener = Reflect::get(&here, &"opener".into()).ok().filter(JsValue::is_object);
    upwards(here).or_else(|| upwards(opener?))
}

fn upwards(mut place: JsValue) -> Option<JsValue> {
    for _ in 0..FARTHEST {
        if let Ok(api) = Reflect::get(&place, &"API".into())
            && api.is_object()
        {
            return Some(api);
        }
        let parent = Reflect::get(&place, &"parent".into()).ok()?;
        if parent == place || !parent.is_object() {
            return None;
        }
        place = parent;
    }
    None
}

/// A duration as SCORM 1.2 writes it: `HHHH:MM:SS.SS`.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the time is clamped to 9,999 hours")]
fn session_time(seconds: f64) -> String {
    let hundredths = (seconds.clamp(0.0, 9999.0 * 3600.0) * 100.0).round() as u64;
    let (minutes, rest) = (hundredths / 6000, hundredths % 6000);
    format!("{:04}:{:02}:{:02}.{:02}", minutes / 60, minutes % 60, rest / 100, rest % 100)
}

#[cfg(test)]
mod tests {
    use super::session_time;

    #[test]
    fn a_session_time_has_hours_minutes_and_hundredths() {
        assert_eq!(session_time(0.0), "0000:00:00.00");
        assert_eq!(session_time(3725.5), "0001:02:05.50");
        assert_eq!(session_time(59.999), "0000:01:00.00");
    }
}
