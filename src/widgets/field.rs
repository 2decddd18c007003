use leptos::ev::{Event, KeyboardEvent, PointerEvent};
use leptos::prelude::*;
use web_sys::HtmlInputElement;

use super::touch_gesture::TouchGesture;
use crate::format::NumberStyle;
use crate::lab::{Lab, use_lab};
use crate::texts::tr;

/// How the travel of a slider maps to values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// Evenly, in steps of this size.
    Linear(f64),
    /// By equal ratios; for gains and times. A negative value keeps its sign and moves its magnitude.
    Logarithmic,
}

/// Positions of a logarithmic slider: fine enough that one step of the arrow keys is about 1 % of most ranges.
const POSITIONS: f64 = 600.0;

impl Scale {
    /// The same with steps that are smaller by this many powers of ten.
    #[must_use]
    pub fn finer(self, powers: usize) -> Self {
        match self {
            Self::Linear(step) => Self::Linear((0..powers).fold(step, |step, _| step / 10.0)),
            Self::Logarithmic => self,
        }
    }

    fn position(self, value: f64, min: f64, max: f64) -> f64 {
        match self {
            Self::Linear(_) => value,
            Self::Logarithmic => ((value.abs().max(min) / min).ln() / (max / min).ln() * POSITIONS).round(),
        }
    }

    fn value(self, position: f64, min: f64, max: f64, previous: f64) -> f64 {
        match self {
            Self::Linear(_) => position,
            Self::Logarithmic => {
                let magnitude = min * (max / min).powf(position / POSITIONS);
                magnitude.copysign(previous)
            }
        }
    }

    /// The value after `steps` presses of an arrow key in the number field.
    fn nudge(self, value: f64, steps: f64, min: f64, max: f64) -> f64 {
        match self {
            Self::Linear(step) => ((value / step).round() + steps) * step,
            Self::Logarithmic => self.value(self.position(value, min, max) + 3.0 * steps, min, max, value),
        }
    }
}

/// What is being typed into a number field.
#[derive(Clone)]
struct Draft {
    text: String,
    /// Why it is not taken over, if it is not.
    refused: Option<Refusal>,
    /// The value in force. The draft is void when another value takes its place.
    value: f64,
}

/// Why a text is not taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Refusal {
    /// It is no number.
    NoNumber,
    /// It is a number that is not allowed.
    NotAllowed,
}

/// A number field: exact entry, arrows and Page Up/Down. It refuses what is out of range, says the limits while the refused
/// text stands, and keeps the last valid value.
#[component]
pub fn NumberField(
    /// Name for tests and for the label; unique on the page.
    id: &'static str,
    /// What the number is, for screen readers.
    #[prop(into)]
    name: Signal<String>,
    /// The value in force, in the shown unit.
    #[prop(into)]
    value: Signal<f64>,
    /// Called with a new, valid value.
    #[prop(into)]
    on_change: Callback<f64>,
    /// Smallest and largest allowed value.
    #[prop(into)]
    limits: Signal<(f64, f64)>,
    /// Travel of the arrow keys.
    #[prop(into)]
    scale: Signal<Scale>,
    /// Decimals shown; `None` for three significant digits.
    #[prop(into)]
    digits: Signal<Option<usize>>,
    /// Smallest allowed magnitude besides zero, where the sign is free.
    #[prop(default = 0.0)]
    smallest: f64,
    /// What the value has to be a multiple of; 0 for any value.
    #[prop(default = Signal::stored(0.0))]
    grid: Signal<f64>,
    /// Whether the field is locked.
    #[prop(into)]
    disabled: Signal<bool>,
    /// Tells that the value was changed here, or by the slider beside it.
    #[prop(default = Trigger::new())]
    moved: Trigger,
) -> impl IntoView {
    let lab = use_lab();
    let (shown, shown_limits) = (lab.throttled_or(moved, value), lab.throttled(limits));
    let draft = RwSignal::new(None::<Draft>);
    let typed = Signal::derive(move || draft.get().filter(|draft| draft.value.total_cmp(&shown.get()).is_eq()));
    let refusal = Signal::derive(move || typed.with(|typed| typed.as_ref().and_then(|draft| draft.refused)));
    let refused = Signal::derive(move || refusal.get().is_some());
    let style = move || lab.number_style();
    let show = move |v: f64| match digits.get() {
        Some(digits) => style().fixed(v, digits),
        None => style().significant(v, 3),
    };
    let accept = move |v: f64| {
        let (min, max) = limits.get_untracked();
        let on_grid = is_multiple(v, grid.get_untracked());
        let fits = (min..=max).contains(&v) && (v == 0.0 || v.abs() >= smallest) && on_grid;
        if fits {
            on_change.run(v);
        }
        fits
    };
    let on_input = move |event| {
        let text = event_target_value(&event);
        let refused = match NumberStyle::parse(&text) {
            None => Some(Refusal::NoNumber),
            Some(number) => (!accept(number)).then_some(Refusal::NotAllowed),
        };
        draft.set(Some(Draft { text, refused, value: value.get_untracked() }));
        moved.notify();
    };
    let on_key = move |event: KeyboardEvent| {
        if event.key() == "Escape" {
            if draft.with_untracked(Option::is_some) {
                // It is the draft that is given up, not what the page shows.
                event.stop_propagation();
                draft.set(None);
            }
            return;
        }
        let Some(steps) = steps_of(&event.key()) else { return };
        event.prevent_default();
        let (min, max) = limits.get_untracked();
        draft.set(None);
        let scale = scale.get_untracked();
        let floor = if scale == Scale::Logarithmic { min.max(max * 1e-5) } else { min };
        let step = grid.get_untracked();
        let scale = if step > 0.0 { Scale::Linear(step) } else { scale };
        accept(scale.nudge(value.get_untracked(), steps, floor, max).clamp(min, max));
        moved.notify();
    };
    let problem = move || {
        refusal.get().map(|refusal| {
            let (min, max) = shown_limits.get();
            let step = Some(grid.get()).filter(|&step| step > 0.0).map(show);
            let allowed = if smallest > 0.0 {
                let range = allowed_values(lab, show(smallest), show(max), step);
                tr!(lab, field.or_zero, range = format!("± {range}"))
            } else {
                allowed_values(lab, show(min), show(max), step)
            };
            match refusal {
                Refusal::NoNumber => tr!(lab, field.no_number, allowed = allowed),
                Refusal::NotAllowed => allowed,
            }
        })
    };
    view! {
        <input
            class="number"
            type="text"
            inputmode="decimal"
            autocomplete="off"
            data-testid=id
            aria-label=name
            title=name
            aria-invalid=move || refused.get().then(|| "true".to_owned())
            aria-describedby=move || refused.get().then(|| format!("{id}-problem"))
            prop:value=move || typed.get().map_or_else(|| show(shown.get()), |draft| draft.text)
            disabled=disabled
            on:input=on_input
            on:keydown=on_key
            on:blur=move |_| draft.set(None)
        />
        {move || {
            problem()
                .map(|text| view! { <span class="problem" role="alert" id=format!("{id}-problem")>{text}</span> })
        }}
    }
}

/// Steps that a key moves a number; `None` for a key that does something else.
fn steps_of(key: &str) -> Option<f64> {
    match key {
        "ArrowUp" => Some(1.0),
        "ArrowDown" => Some(-1.0),
        "PageUp" => Some(10.0),
        "PageDown" => Some(-10.0),
        _ => None,
    }
}

/// A range in words, with the step of which its values are multiples, where there is one.
fn allowed_values(lab: Lab, min: String, max: String, step: Option<String>) -> String {
    let range = tr!(lab, field.allowed, min = min, max = max);
    step.map_or_else(|| range.clone(), |step| format!("{range}, {}", tr!(lab, field.multiple, step = step)))
}

/// Whether a value is a whole number of steps, up to rounding; anything is where there is no step.
fn is_multiple(value: f64, step: f64) -> bool {
    let steps = value / step;
    step == 0.0 || (steps - steps.round()).abs() < 1e-6
}

/// A slider with a number field beside it.
#[component]
pub fn SliderField(
    /// Name for tests; the number field is called `{id}-number`.
    id: (&'static str, &'static str),
    /// Short label, a symbol.
    #[prop(into)]
    label: Signal<String>,
    /// What the number is, for screen readers.
    #[prop(into)]
    name: Signal<String>,
    /// The value in force, in the shown unit.
    #[prop(into)]
    value: Signal<f64>,
    /// Called with a new, valid value.
    #[prop(into)]
    on_change: Callback<f64>,
    /// Smallest and largest value of the slider.
    #[prop(into)]
    travel: Signal<(f64, f64)>,
    /// Smallest and largest value that the number field accepts; the travel where not given.
    #[prop(optional, into)]
    limits: Option<Signal<(f64, f64)>>,
    /// Smallest magnitude that the number field accepts.
    #[prop(default = 0.0)]
    smallest: f64,
    /// Travel to value.
    #[prop(into)]
    scale: Signal<Scale>,
    /// Decimals shown; `None` for three significant digits.
    #[prop(into)]
    digits: Signal<Option<usize>>,
    /// Unit behind the number.
    #[prop(into)]
    unit: Signal<String>,
    /// Further classes: the colour of a loop.
    #[prop(optional)]
    class: &'static str,
    /// Whether the control is locked.
    #[prop(optional, into)]
    disabled: Signal<bool>,
) -> impl IntoView {
    let lab = use_lab();
    let moved = Trigger::new();
    let (shown, shown_travel) = (lab.throttled_or(moved, value), lab.throttled(travel));
    let position = move || {
        let (min, max) = shown_travel.get();
        scale.get().position(shown.get(), min, max)
    };
    let take = move |text: String| {
        let (min, max) = travel.get_untracked();
        if let Some(at) = NumberStyle::parse(&text) {
            let (lowest, highest) = limits.unwrap_or(travel).get_untracked();
            on_change.run(scale.get_untracked().value(at, min, max, value.get_untracked()).clamp(lowest, highest));
            moved.notify();
        }
    };
    let gesture = TouchGesture::new();
    let on_input = move |event: Event| {
        if !gesture.is_undecided() {
            take(event_target_value(&event));
        }
    };
    let commit = move |event: PointerEvent| {
        if gesture.decide() {
            take(event_target::<HtmlInputElement>(&event).value());
        }
    };
    let on_pointer_move = move |event: PointerEvent| {
        if gesture.is_sideways(&event) {
            commit(event);
        }
    };
    // The page scrolls: what the finger touched in passing goes back to its value.
    let on_cancel = move |event: PointerEvent| {
        if gesture.decide() {
            event_target::<HtmlInputElement>(&event).set_value(&untrack(position).to_string());
        }
    };
    let range = move || match scale.get() {
        Scale::Linear(step) => (shown_travel.get().0, shown_travel.get().1, step),
        Scale::Logarithmic => (0.0, POSITIONS, 1.0),
    };
    let spoken = move || {
        let style = lab.number_style();
        let number = digits.get().map_or_else(|| style.significant(shown.get(), 3), |d| style.fixed(shown.get(), d));
        format!("{number} {}", unit.get())
    };
    view! {
        // The row stands in a box because browsers lay no item of a grid or flexible box out alone.
        <div>
            <div class=format!("row travel {class}")>
                <label for=id.0 title=name>{label}</label>
                <input
                    type="range"
                    id=id.0
                    data-testid=id.0
                    aria-label=name
                    aria-valuetext=spoken
                    min=move || range().0.to_string()
                    max=move || range().1.to_string()
                    step=move || range().2.to_string()
                    prop:value=move || position().to_string()
                    disabled=disabled
                    on:input=on_input
                    on:pointerdown=move |event| gesture.begin(&event)
                    on:pointermove=on_pointer_move
                    on:pointerup=commit
                    on:pointercancel=on_cancel
                />
                <NumberField id=id.1 name value on_change limits=limits.unwrap_or(travel) scale digits smallest disabled moved />
                <span class="unit">{unit}</span>
            </div>
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithmic_slider_returns_to_its_value_and_keeps_the_sign() {
        let s = Scale::Logarithmic;
        for v in [0.01, 0.12, 1.0, 99.0] {
            let back = s.value(s.position(v, 0.01, 100.0), 0.01, 100.0, -v);
            assert!((back + v).abs() < 0.01 * v, "{v} became {back}");
        }
    }

    #[test]
    fn a_linear_nudge_lands_on_the_grid() {
        assert!((Scale::Linear(0.01).nudge(0.431, 1.0, 0.0, 1.0) - 0.44).abs() < 1e-12);
    }
}
