//! What the start flags `panels=` and `lock=` name on the relay-tuning bench.

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
