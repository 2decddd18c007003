//! The controls of the benches as data: what they read and write of a document.
//!
//! A number is a constant that says how it is read, written, limited and shown; [`KnobRow`] makes the view of any of them.

use leptos::prelude::*;

use super::lab::Lab;
use super::session::{Bench, Session, SetupOf};
use super::start::Control;
use super::widgets::{NumberField, Scale, Segmented, SliderField};

/// A stretch of numbers that depends on a setup.
type Range<S> = fn(&S) -> (f64, f64);

/// A number of a setup, or a pair of alike ones: an index of 0 or 1 says which.
pub struct Knob<S> {
    /// Names for tests: of the slider, and of the number field beside it or alone.
    pub ids: [(&'static str, &'static str); 2],
    /// Symbol or short text.
    pub label: fn(Lab, usize) -> String,
    /// What it is, for screen readers.
    pub name: fn(Lab, usize) -> String,
    /// Reads it, in the shown unit.
    pub read: fn(&S, usize) -> f64,
    /// Writes it, from the shown unit.
    pub write: fn(&mut S, usize, f64),
    /// Smallest and largest allowed value.
    pub limits: fn(&S, usize) -> (f64, f64),
    /// Smallest allowed magnitude, where the sign is free but zero is not allowed.
    pub smallest: f64,
    /// Travel of the slider; `None` for a number field alone.
    pub travel: Option<Range<S>>,
    /// How keys and slider move it.
    pub scale: Scale,
    /// Decimals shown; `None` for three significant digits.
    pub digits: Option<usize>,
    /// The shown unit.
    pub unit: fn(&S) -> &'static str,
    /// Classes: the colours of the loops.
    pub class: [&'static str; 2],
    /// What it has to be a multiple of; 0 for any value.
    pub grid: fn(&S) -> f64,
    /// What locks it.
    pub lock: Control,
    /// Whether there is anything to set; `None` where there always is.
    pub matters: Option<fn(&S) -> bool>,
}

impl<S> Knob<S> {
    /// What most controls have in common.
    pub const PLAIN: Self = Self {
        ids: [("", ""); 2],
        label: |_, _| String::new(),
        name: |_, _| String::new(),
        read: |_, _| 0.0,
        write: |_, _, _| (),
        limits: |_, _| (0.0, 1.0),
        smallest: 0.0,
        travel: None,
        scale: Scale::Linear(0.01),
        digits: None,
        unit: |_| "",
        class: [""; 2],
        grid: |_| 0.0,
        lock: Control::Plant,
        matters: None,
    };
}

/// A slider with its number field, or a number field in a row of its own.
#[component]
pub fn KnobRow<B: Bench>(
    /// The bench whose setup it is a number of.
    session: Session<B>,
    /// The number.
    knob: &'static Knob<SetupOf<B>>,
    /// Which one of a pair.
    #[prop(optional)]
    index: usize,
) -> impl IntoView {
    let &Knob { ids, scale, digits, smallest, class, .. } = knob;
    let (id, class, lab) = (ids[index], class[index], session.lab);
    let label = Signal::derive(move || (knob.label)(lab, index));
    let unit = lab.told(Signal::derive(move || session.read(knob.unit).to_owned()));
    let Wires { name, value, on_change, limits, disabled } = wires(session, knob, index);
    let Some(travel) = knob.travel else {
        return view! {
            <div class=format!("field-row {class}")>
                <span title=name>{label}</span>
                <KnobNumber session knob index />
                <span class="unit">{unit}</span>
            </div>
        }
        .into_any();
    };
    let travel = Signal::derive(move || session.read(travel));
    view! { <SliderField id label name value on_change travel limits smallest scale digits unit class disabled /> }
        .into_any()
}

/// The number field alone, for a row of another shape.
#[component]
pub fn KnobNumber<B: Bench>(
    /// The bench whose setup it is a number of.
    session: Session<B>,
    /// The number.
    knob: &'static Knob<SetupOf<B>>,
    /// Which one of a pair.
    #[prop(optional)]
    index: usize,
) -> impl IntoView {
    let &Knob { ids, scale, digits, smallest, .. } = knob;
    let Wires { name, value, on_change, limits, disabled } = wires(session, knob, index);
    let grid = Signal::derive(move || session.read(knob.grid));
    view! { <NumberField id=ids[index].1 name value on_change limits scale digits smallest grid disabled /> }
}

/// A choice among few in a document.
#[component]
pub fn Switch<B, T>(
    /// The bench.
    session: Session<B>,
    /// What is chosen between, for screen readers.
    #[prop(into)]
    label: Signal<String>,
    /// The choices with their names for tests, and their texts.
    choices: Vec<(T, &'static str, Signal<String>)>,
    /// The choice in force.
    read: fn(&SetupOf<B>) -> T,
    /// Makes another choice.
    write: fn(&mut SetupOf<B>, T),
    /// What locks it.
    lock: Control,
) -> impl IntoView
where
    B: Bench,
    T: Copy + PartialEq + Send + Sync + 'static,
{
    let on_choose = move |choice| session.edit(|s| write(s, choice));
    let value = session.lab.told(Signal::derive(move || session.read(read)));
    view! { <Segmented label choices value on_choose disabled=session.lab.locks(lock) /> }
}

/// What connects a field with a document.
struct Wires {
    name: Signal<String>,
    value: Signal<f64>,
    on_change: Callback<f64>,
    limits: Signal<(f64, f64)>,
    disabled: Signal<bool>,
}

fn wires<B: Bench>(session: Session<B>, knob: &'static Knob<SetupOf<B>>, index: usize) -> Wires {
    let (lab, locked) = (session.lab, session.lab.locks(knob.lock));
    // No memos: fields read all but the last when the words are told or a key is pressed, and do not follow it.
    Wires {
        name: Signal::derive(move || (knob.name)(lab, index)),
        value: Signal::derive(move || session.read(|s| (knob.read)(s, index))),
        on_change: Callback::new(move |value| session.edit(|s| (knob.write)(s, index, value))),
        limits: Signal::derive(move || session.read(|s| (knob.limits)(s, index))),
        disabled: match knob.matters {
            Some(matters) => Memo::new(move |_| locked || !session.read(matters)).into(),
            None => locked.into(),
        },
    }
}
