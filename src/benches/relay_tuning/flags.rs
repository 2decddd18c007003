//! What the start flags `panels=` and `lock=` name on the relay-tuning bench.

use crate::lab::Lab;
use crate::session::Panel;
use crate::texts::tr;

/// The cards, in their order on the page.
pub mod panels {
    use crate::session::Panel;

    /// The plant and its published cases.
    pub const PLANT: Panel = Panel("plant");
    /// The relay test.
    pub const TEST: Panel = Panel("test");
    /// The critical curve.
    pub const CURVE: Panel = Panel("curve");
    /// The characteristic loci with their target.
    pub const PLACEMENT: Panel = Panel("placement");
    /// The response of the design.
    pub const RESPONSES: Panel = Panel("responses");

    /// All of them.
    pub const ALL: &[Panel] = &[PLANT, TEST, CURVE, PLACEMENT, RESPONSES];
}

/// What a card is called.
pub fn panel_title(lab: Lab, panel: Panel) -> String {
    match panel {
        panels::PLANT => tr!(lab, relay.plant),
        panels::TEST => tr!(lab, relay.test),
        panels::CURVE => tr!(lab, relay.curve),
        panels::PLACEMENT => tr!(lab, relay.placement),
        panels::RESPONSES => tr!(lab, relay.response),
        Panel(other) => other.to_owned(),
    }
}

/// Groups of controls that can be disabled.
pub mod locks {
    use crate::session::Lock;

    /// The plant that is tuned, with the published cases.
    pub const PLANT: Lock = Lock("plant");
    /// The relay test.
    pub const TEST: Lock = Lock("test");
    /// The critical point.
    pub const POINT: Lock = Lock("point");
    /// The target of the placement, method, action and root.
    pub const TARGET: Lock = Lock("target");
    /// The step.
    pub const EXPERIMENT: Lock = Lock("experiment");

    /// All of them.
    pub const ALL: &[Lock] = &[PLANT, TEST, POINT, TARGET, EXPERIMENT];
}
