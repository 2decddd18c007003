//! The controls of the bench as data: what they read and write of the session.

use leptos::prelude::*;

use super::session::{Session, time_unit};
use crate::app::lab::use_lab;
use crate::app::start::Control;
use crate::app::widgets::{Choice, NumberField, Scale, Segmented, SliderField};
use crate::scenario::tuning::TuningSetup;

/// A number of the session.
pub struct Knob {
    /// Name for tests, and that of the number field beside a slider.
    pub id: (&'static str, &'static str),
    /// Symbol.
    pub label: &'static str,
    /// What it is, for screen readers.
    pub name: Signal<String>,
    /// Reads it.
    pub read: fn(&TuningSetup) -> f64,
    /// Writes it.
    pub write: fn(&mut TuningSetup, f64),
    /// Smallest and largest allowed value.
    pub limits: (f64, f64),
    /// Travel of the slider; `None` for a number field alone.
    pub travel: Option<(f64, f64)>,
    /// How keys and slider move it.
    pub scale: Scale,
    /// Whether it is a time of the plant.
    pub is_time: bool,
    /// Class of its colour.
    pub class: &'static str,
    /// What locks it.
    pub lock: Control,
}

/// A slider or a number field.
pub fn knob(session: Session, knob: &Knob) -> AnyView {
    let &Knob { id, label, name, read, write, limits, travel, scale, is_time, class, lock } = knob;
    let value = session.part(read);
    // A count has no decimals.
    let digits = (scale == Scale::Linear(1.0)).then_some(0);
    let on_change = Callback::new(move |v: f64| session.edit(|s| write(s, v)));
    let disabled = session.locks(lock);
    let unit =
        Signal::derive(move || if is_time { session.words.setup.with(|s| time_unit(&s.plant)) } else { "" }.to_owned());
    match travel {
        Some(travel) => view! {
            <SliderField id label=label.to_owned() name value on_change travel limits=Signal::from(limits) scale digits unit class disabled />
        }
        .into_any(),
        None => view! {
            <div class=format!("field-row {class}")>
                <span>{label}</span>
                <NumberField id=id.0 name value on_change limits scale digits disabled />
                <span class="unit">{unit}</span>
            </div>
        }
        .into_any(),
    }
}

/// A choice among few: texts with their names for tests.
pub fn segmented(
    session: Session,
    label: Signal<String>,
    choices: Vec<(&'static str, Signal<String>)>,
    read: fn(&TuningSetup) -> usize,
    write: fn(&mut TuningSetup, usize),
    lock: Control,
) -> AnyView {
    let choices = choices.into_iter().enumerate().map(|(index, (name, text))| (index, name, text)).collect();
    let on_choose = Callback::new(move |index| session.edit(|s| write(s, index)));
    let value = Signal::derive(move || session.words.setup.with(|setup| read(setup)));
    let disabled = session.locks(lock);
    view! { <Segmented<usize> label choices value on_choose disabled /> }.into_any()
}

/// A choice among many.
pub fn choice(
    id: &'static str,
    name: Signal<String>,
    options: Signal<String>,
    on_choose: impl Fn(String) + Send + Sync + 'static,
    lock: Control,
) -> AnyView {
    let on_choose = Callback::new(on_choose);
    view! { <Choice id name options on_choose disabled=use_lab().locks(lock) /> }.into_any()
}

/// A text that is the same in all languages.
pub fn symbol(text: &'static str) -> Signal<String> {
    Signal::derive(move || text.to_owned())
}
