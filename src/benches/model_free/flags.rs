//! What the start flags `panels=` and `lock=` name on the model-free bench.

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
    /// The zero in the course of the run.
    pub const ZEROS: Panel = Panel("zeros");
    /// The run.
    pub const RESPONSES: Panel = Panel("responses");
    /// The case and its experiment.
    pub const EXPERIMENT: Panel = Panel("experiment");
    /// The law, and the PI loops beside it.
    pub const CONTROLLER: Panel = Panel("controller");
    /// What the paper claims.
    pub const CLAIMS: Panel = Panel("claims");

    /// All of them.
    pub const ALL: &[Panel] = &[PROCESS, VALVES, ZEROS, RESPONSES, EXPERIMENT, CONTROLLER, CLAIMS];
}

/// What a card is called.
pub fn panel_title(lab: Lab, panel: Panel) -> String {
    match panel {
        panels::PROCESS => tr!(lab, process.title),
        panels::VALVES => tr!(lab, valves.title),
        panels::ZEROS => tr!(lab, zeros.title),
        panels::RESPONSES => tr!(lab, free.course),
        panels::EXPERIMENT => tr!(lab, free.case),
        panels::CONTROLLER => tr!(lab, free.law),
        panels::CLAIMS => tr!(lab, free.claims),
        Panel(other) => other.to_owned(),
    }
}

/// Groups of controls that can be disabled.
pub mod locks {
    use crate::session::Lock;

    /// The valves, and the case.
    pub const VALVES: Lock = Lock("valves");
    /// The experiment.
    pub const EXPERIMENT: Lock = Lock("experiment");
    /// The gains of the laws.
    pub const GAINS: Lock = Lock("gains");
    /// Sampling and estimator.
    pub const SAMPLING: Lock = Lock("sampling");
    /// Which pump each loop drives.
    pub const PAIRING: Lock = Lock("pairing");

    /// All of them.
    pub const ALL: &[Lock] = &[VALVES, EXPERIMENT, GAINS, SAMPLING, PAIRING];
}
