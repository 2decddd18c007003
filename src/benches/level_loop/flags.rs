//! What the start flags `panels=` and `lock=` name on the level-loop bench.

use crate::lab::Lab;
use crate::session::Panel;
use crate::texts::tr;

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

/// What a card is called.
pub fn panel_title(lab: Lab, panel: Panel) -> String {
    match panel {
        panels::PROCESS => tr!(lab, level.loop_title),
        panels::EXPERIMENT => tr!(lab, level.experiment),
        panels::RESPONSES => tr!(lab, level.course),
        panels::TEST => tr!(lab, level.test_title),
        panels::TRADE_OFF => tr!(lab, level.trade_off),
        panels::CONTROLLER => tr!(lab, level.tuning_title),
        panels::ASSESSMENT => tr!(lab, level.assess_title),
        panels::MAP => tr!(lab, level.map_title),
        panels::FORMS => tr!(lab, level.forms),
        panels::PUBLISHED => tr!(lab, level.published),
        panels::HEATED => tr!(lab, level.heated),
        Panel(other) => other.to_owned(),
    }
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
