//! Fields for the levels of all four tanks.

use leptos::prelude::*;
use quadtank::study::quadruple_tank::Setup;

use super::flags::locks;
use super::session::use_session;
use crate::controls::{ParamControl, ParamNumber};
use crate::shown::{ShownUnit, finer_digits, unit_name};

/// What the level of any tank has in common with others: the unit of its rig.
pub const LEVEL: ParamControl<Setup> = ParamControl {
    shown_unit: Some(|s| ShownUnit::length(s.plant.display_unit())),
    finer: Some(|s| finer_digits(s.plant.display_unit())),
    digits: Some(2),
    ..ParamControl::locked_by(locks::EXPERIMENT)
};

/// The levels of tanks 1 and 2 by the first control, of 3 and 4 by the second, under one name.
#[component]
pub fn FourLevels(controls: [&'static ParamControl<Setup>; 2], #[prop(into)] name: Signal<String>) -> impl IntoView {
    let session = use_session();
    let fields = controls.into_iter().enumerate().flat_map(|(row, control)| {
        [0, 1].map(|index| {
            let symbol = ["h₁", "h₂", "h₃", "h₄"][2 * row + index];
            view! { <span class="field"><span aria-hidden="true">{symbol}</span><ParamNumber session control index /></span> }
        })
    });
    view! {
        <div class="four-levels" role="group" aria-label=name>
            {fields.collect_view()}
            <span class="unit">{move || unit_name(session.own.unit.get())}</span>
        </div>
    }
}
