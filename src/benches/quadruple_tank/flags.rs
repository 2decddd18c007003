//! What the start flags `panels=` and `lock=` name on the home bench.

use crate::lab::Lab;
use crate::session::Panel;
use crate::texts::tr;

/// The cards, in their order on the page.
pub mod panels {
    use crate::session::Panel;

    /// The drawing of the rig.
    pub const PROCESS: Panel = Panel("process");
    /// The valve plane.
    pub const VALVES: Panel = Panel("valves");
    /// Poles and zeros.
    pub const ZEROS: Panel = Panel("zeros");
    /// The relative gain array.
    pub const RGA: Panel = Panel("rga");
    /// The decentralised controller.
    pub const CONTROLLER: Panel = Panel("controller");
    /// The experiment.
    pub const EXPERIMENT: Panel = Panel("experiment");
    /// The interpolation constraint.
    pub const WHY: Panel = Panel("why");
    /// The responses.
    pub const RESPONSES: Panel = Panel("responses");

    /// All of them.
    pub const ALL: &[Panel] = &[PROCESS, VALVES, ZEROS, RGA, CONTROLLER, EXPERIMENT, WHY, RESPONSES];
}

/// What a card is called.
pub fn panel_title(lab: Lab, panel: Panel) -> String {
    match panel {
        panels::PROCESS => tr!(lab, process.title),
        panels::VALVES => tr!(lab, valves.title),
        panels::ZEROS => tr!(lab, zeros.title),
        panels::RGA => tr!(lab, rga.title),
        panels::CONTROLLER => tr!(lab, pi.title),
        panels::EXPERIMENT => tr!(lab, experiment.title),
        panels::WHY => tr!(lab, why.title),
        panels::RESPONSES => tr!(lab, responses.title),
        Panel(other) => other.to_owned(),
    }
}

/// Groups of controls that can be disabled.
pub mod locks {
    use crate::session::Lock;

    /// The choice of the rig.
    pub const PRESET: Lock = Lock("preset");
    /// γ1 and γ2.
    pub const VALVES: Lock = Lock("valves");
    /// The operating point.
    pub const VOLTAGES: Lock = Lock("voltages");
    /// Which pump each loop drives.
    pub const PAIRING: Lock = Lock("pairing");
    /// K and Ti.
    pub const GAINS: Lock = Lock("gains");
    /// The rest of the controller.
    pub const SAMPLING: Lock = Lock("sampling");
    /// The experiment.
    pub const EXPERIMENT: Lock = Lock("experiment");

    /// All of them.
    pub const ALL: &[Lock] = &[PRESET, VALVES, VOLTAGES, PAIRING, GAINS, SAMPLING, EXPERIMENT];
}
