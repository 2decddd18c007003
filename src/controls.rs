//! The controls of the benches as data: what they read and write of a document.
//!
//! A number is a constant that says how it is read, written, limited and shown; [`ParamRow`] makes the view of any of them.

use leptos::prelude::*;

use super::lab::Lab;
use super::session::{Bench, Lock, Session, SetupOf};
use super::shown::ShownUnit;
use super::widgets::{NumberField, Scale, Segmented, SliderField};
use quadtank_scenario::params::{self, Param};
use quadtank_scenario::{BenchDocument, Limits};

/// Range of a slider as a function of the setup, in the shown unit.
type Range<S> = fn(&S) -> (f64, f64);

/// A number of a setup, or a pair of alike ones: an index of 0 or 1 says which.
pub struct ParamControl<S> {
    /// Names for tests: of the slider, and of the number field beside it or alone.
    pub ids: [(&'static str, &'static str); 2],
    /// Symbol or short text.
    pub label: fn(Lab, usize) -> String,
    /// What it is, for screen readers.
    pub name: fn(Lab, usize) -> String,
    /// Path of its row in the table of parameters, whose limits it has; empty for a number that is not in the document.
    pub path: fn(&S, usize) -> &'static str,
    /// Reads it, in the unit of the row.
    pub read: fn(&S, usize) -> f64,
    /// Writes it, in the unit of the row.
    pub write: fn(&mut S, usize, f64),
    /// What other numbers of the setup leave of the limits of the row.
    pub within: fn(&S, usize) -> Limits,
    /// Smallest allowed magnitude, where the sign is free but zero is not allowed.
    pub smallest: f64,
    /// Travel of the slider; `None` for a number field alone.
    pub travel: Option<Range<S>>,
    /// How keys and slider move it; `None` for the scale of the row, in steps of 0.01 if it is linear.
    pub scale: Option<Scale>,
    /// Decimals shown; `None` for three significant digits.
    pub digits: Option<usize>,
    /// How many decimals more the unit of a setup asks for, with steps as much smaller; `None` where it never does.
    pub finer: Option<fn(&S) -> usize>,
    /// The shown unit; `None` for that of the row.
    pub shown_unit: Option<fn(&S) -> ShownUnit>,
    /// Classes: the colours of the loops.
    pub class: [&'static str; 2],
    /// What it has to be a multiple of; 0 for any value.
    pub grid: fn(&S) -> f64,
    /// What locks it.
    pub lock: Lock,
    /// Whether there is anything to set; `None` where there always is.
    pub matters: Option<fn(&S) -> bool>,
}

impl<S> ParamControl<S> {
    /// What most controls have in common, disabled with the group of their bench.
    pub const fn locked_by(lock: Lock) -> Self {
        Self {
            ids: [("", ""); 2],
            label: |_, _| String::new(),
            name: |_, _| String::new(),
            path: |_, _| "",
            read: |_, _| 0.0,
            write: |_, _, _| (),
            within: |_, _| Limits::NONE,
            smallest: 0.0,
            travel: None,
            scale: None,
            digits: None,
            finer: None,
            shown_unit: None,
            class: [""; 2],
            grid: |_| 0.0,
            lock,
            matters: None,
        }
    }

    /// The row of the table of parameters.
    fn row(&self, setup: &S, index: usize) -> Option<&'static Param> {
        let path = (self.path)(setup, index);
        let row = Param::at(path);
        debug_assert!(row.is_some() || path.is_empty(), "no row for {path}");
        row
    }

    /// The values that are allowed now, in the unit of the row.
    pub fn limits(&self, setup: &S, index: usize) -> Limits {
        let row = self.row(setup, index).map_or(Limits::NONE, |row| row.limits);
        row.intersection((self.within)(setup, index))
    }

    fn scale(&self, setup: &S, index: usize) -> Scale {
        self.scale.unwrap_or_else(|| match self.row(setup, index).map(|row| row.scale) {
            Some(params::Scale::Logarithmic) => Scale::Logarithmic,
            Some(params::Scale::Linear) | None => Scale::Linear(0.01),
        })
    }

    /// Shown units in one of the row.
    fn shown_per_unit(&self, setup: &S) -> f64 {
        self.shown_unit.map_or(1.0, |unit| unit(setup).per_unit)
    }

    fn shown(&self, setup: &S, index: usize) -> f64 {
        (self.read)(setup, index) * self.shown_per_unit(setup)
    }

    /// Rounding of the unit does not lead out of the limits.
    fn set_shown(&self, setup: &mut S, index: usize, shown: f64) {
        let value = self.limits(setup, index).clamp(shown / self.shown_per_unit(setup));
        (self.write)(setup, index, value);
    }

    fn shown_limits(&self, setup: &S, index: usize) -> (f64, f64) {
        let (limits, shown_per_unit) = (self.limits(setup, index), self.shown_per_unit(setup));
        (limits.min * shown_per_unit, limits.max * shown_per_unit)
    }
}

/// A slider with its number field, or a number field in a row of its own.
#[component]
pub fn ParamRow<B: Bench>(
    /// The bench whose setup it is a number of.
    session: Session<B>,
    /// The number.
    control: &'static ParamControl<SetupOf<B>>,
    /// Which one of a pair.
    #[prop(optional)]
    index: usize,
    /// What a change does in place of setting the number alone; it is given the shown number.
    #[prop(optional)]
    act: Option<Callback<f64>>,
) -> impl IntoView {
    let &ParamControl { ids, smallest, class, .. } = control;
    let (id, class, lab) = (ids[index], class[index], session.lab);
    let label = Signal::derive(move || (control.label)(lab, index));
    let Binding { name, value, on_change, limits, scale, digits, disabled } = bind(session, control, index);
    let on_change = act.unwrap_or(on_change);
    let unit = unit_text(session, control, index);
    let Some(travel) = control.travel else {
        return view! {
            <div class=format!("field-row {class}")>
                <span title=name>{label}</span>
                <ParamNumber session control index />
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
pub fn ParamNumber<B: Bench>(
    /// The bench whose setup it is a number of.
    session: Session<B>,
    /// The number.
    control: &'static ParamControl<SetupOf<B>>,
    /// Which one of a pair.
    #[prop(optional)]
    index: usize,
) -> impl IntoView {
    let &ParamControl { ids, smallest, .. } = control;
    let Binding { name, value, on_change, limits, scale, digits, disabled } = bind(session, control, index);
    let grid = Signal::derive(move || session.read(control.grid));
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
    lock: Lock,
) -> impl IntoView
where
    B: Bench,
    T: Copy + PartialEq + Send + Sync + 'static,
{
    let on_choose = move |choice| session.edit(|s| write(s, choice));
    let value = session.lab.throttled(Signal::derive(move || session.read(read)));
    view! { <Segmented label choices value on_choose disabled=session.lab.locks(lock) /> }
}

/// Signals and callbacks that bind a field to a document.
struct Binding {
    name: Signal<String>,
    value: Signal<f64>,
    on_change: Callback<f64>,
    limits: Signal<(f64, f64)>,
    scale: Signal<Scale>,
    digits: Signal<Option<usize>>,
    disabled: Signal<bool>,
}

fn bind<B: Bench>(session: Session<B>, control: &'static ParamControl<SetupOf<B>>, index: usize) -> Binding {
    let (lab, locked) = (session.lab, session.lab.locks(control.lock));
    let scale = session.document.with_untracked(|document| control.scale(document.setup(), index));
    let finer = control.finer.map(|finer| Memo::new(move |_| session.read(finer)));
    // No memos: fields read the next four when texts are updated or a key is pressed, and do not follow them.
    Binding {
        name: Signal::derive(move || (control.name)(lab, index)),
        value: Signal::derive(move || session.read(|s| control.shown(s, index))),
        on_change: Callback::new(move |shown| session.edit(|s| control.set_shown(s, index, shown))),
        limits: Signal::derive(move || session.read(|s| control.shown_limits(s, index))),
        scale: finer.map_or_else(|| Signal::stored(scale), |finer| Signal::derive(move || scale.finer(finer.get()))),
        digits: finer.map_or_else(
            || Signal::stored(control.digits),
            |finer| Signal::derive(move || control.digits.map(|digits| digits + finer.get())),
        ),
        disabled: match control.matters {
            Some(matters) => Memo::new(move |_| locked || !session.read(matters)).into(),
            None => locked.into(),
        },
    }
}

/// The name of the shown unit.
fn unit_text<B: Bench>(session: Session<B>, control: &ParamControl<SetupOf<B>>, index: usize) -> Signal<String> {
    match control.shown_unit {
        Some(unit) => session.lab.throttled(Signal::derive(move || session.read(unit).name.to_owned())),
        // Looked up once: a path that depends on the setup has a shown unit.
        None => session.document.with_untracked(|document| {
            let row = control.row(document.setup(), index);
            Signal::stored(row.map_or("", |row| row.unit).to_owned())
        }),
    }
}
