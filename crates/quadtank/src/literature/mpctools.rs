//! The nonlinear example of `MPCtools`: Johansson's rig with other valves.

use super::units::CM;
use super::{DisplayUnit, PiExperiment, Preset, PresetId, Printed, ReferenceMoves, johansson};
use crate::control::Pairing;
use crate::plant::QuadrupleTank;

/// The example, on [Johansson's rig](johansson::minimum_phase) at P− but for the valves. It has no PI loops: these are those of
/// [SIMC](crate::tuning::ModelRule::Simc) (Skogestad 2003, half rule, `τc = τ1`) for the swapped pairing, rounded.
pub(super) fn preset() -> Preset {
    let printed = [8.244_414_152_572_76, 19.016_295_769_199_27, 4.314_625_802_365_56, 8.806_529_390_835_85];
    let rig = johansson::minimum_phase();
    Preset {
        id: PresetId::MpcTools,
        source: "MPCtools",
        table: "nonlinear example",
        display_unit: DisplayUnit::Cm,
        plant: QuadrupleTank { valves: [0.25, 0.35], ..rig.plant },
        pump_voltage: [3.0, 3.0],
        pi: PiExperiment {
            pairing: Pairing::Swapped,
            gains: [0.40, 0.19],
            integral_times_s: [70.0, 150.0],
            sampling_time_s: 1.0,
            references: ReferenceMoves::Apart([100.0, 1600.0]),
            duration_s: 3100.0,
        },
        printed: Some(Printed::levels(printed.map(|h| h * CM), 14)),
    }
}
