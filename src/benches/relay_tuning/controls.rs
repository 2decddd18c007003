//! The controls of the bench as data: what they read and write of the session.

use leptos::prelude::*;

use super::session::time_unit;
use crate::controls::ParamControl;
use quadtank::study::relay_tuning::TuningSetup;

/// What numbers that are times of the plant have in common.
pub const TIME: ParamControl<TuningSetup> = ParamControl { unit: |s| time_unit(&s.plant), ..ParamControl::PLAIN };

/// A text that is the same in all languages.
pub fn symbol(text: &'static str) -> Signal<String> {
    Signal::stored(text.to_owned())
}
