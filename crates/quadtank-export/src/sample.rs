//! A document for tests.

use quadtank_scenario::{Scenario, from_json};

/// A document in which everything acts: a rig of its own, manual mode, both loads, noise, a real sensor.
pub fn everything_acts() -> Scenario {
    from_json(include_str!("../../quadtank-scenario/tests/data/everything-acts.json")).expect("a valid document")
}
