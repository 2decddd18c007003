//! What the start flags `panels=` and `lock=` name on the level-loop bench.

/// The cards, in their order on the page.
pub mod panels {
    use crate::session::Panel;

    /// The loop with its instruments.
    pub const PROCESS: Panel = Panel("process");
    /// What is done to the loop.
    pub const EXPERIMENT: Panel = Panel("experiment");
    /// The run.
    pub const RESPONSES: Panel = Panel("responses");
    /// The step test and the model that is read from it.
    pub const TEST: Panel = Panel("test");
    /// The variance of the level against that of the outflow.
    pub const TRADE_OFF: Panel = Panel("trade-off");
    /// Objective and tuning.
    pub const CONTROLLER: Panel = Panel("controller");
    /// Indices and margins.
    pub const ASSESSMENT: Panel = Panel("assessment");
    /// The cost over gain and integral time, and the searches in it.
    pub const MAP: Panel = Panel("map");
    /// Forms of PI controllers and the limits of commercial ones.
    pub const FORMS: Panel = Panel("forms");
    /// Published tables.
    pub const PUBLISHED: Panel = Panel("published");
    /// The heated tank.
    pub const HEATED: Panel = Panel("heated");

    /// All of them.
    pub const ALL: &[Panel] =
        &[PROCESS, EXPERIMENT, RESPONSES, TEST, TRADE_OFF, CONTROLLER, ASSESSMENT, MAP, FORMS, PUBLISHED, HEATED];
}

/// Groups of controls that can be disabled.
pub mod locks {
    use crate::session::Lock;

    /// The plant.
    pub const PLANT: Lock = Lock("plant");
    /// The step test.
    pub const TEST: Lock = Lock("test");
    /// The experiment and where it starts.
    pub const EXPERIMENT: Lock = Lock("experiment");
    /// The objective.
    pub const OBJECTIVE: Lock = Lock("objective");
    /// The controller and its gains.
    pub const GAINS: Lock = Lock("gains");

    /// All of them.
    pub const ALL: &[Lock] = &[PLANT, TEST, EXPERIMENT, OBJECTIVE, GAINS];
}
