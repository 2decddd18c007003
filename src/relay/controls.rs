//! The controls of the bench as data: what they read and write of the session.

use leptos::prelude::*;

use super::session::{Session, time_unit};
use crate::controls::{Document, Knob};
use crate::lab::Lab;
use quadtank::study::relay_tuning::TuningSetup;

impl Document for Session {
    type Setup = TuningSetup;

    fn lab(self) -> Lab {
        self.lab
    }

    fn read<T>(self, read: impl FnOnce(&TuningSetup) -> T) -> T {
        self.lab.tuning.with(|s| read(&s.tuning))
    }

    fn write(self, change: impl FnOnce(&mut TuningSetup)) {
        self.edit(change);
    }
}

/// What numbers that are times of the plant have in common.
pub const TIME: Knob<TuningSetup> = Knob { unit: |s| time_unit(&s.plant), ..Knob::PLAIN };

/// A text that is the same in all languages.
pub fn symbol(text: &'static str) -> Signal<String> {
    Signal::stored(text.to_owned())
}
