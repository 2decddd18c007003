use serde::{Deserialize, Serialize};

use super::{cocota, dtu, johansson, junqueira, mpctools, quanser, seville};
use crate::control::Pairing;
use crate::plant::QuadrupleTank;

/// The published rigs. The names are those of the scenario document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum PresetId {
    /// Johansson (2000), minimum-phase setting P−.
    #[serde(rename = "johansson-2000-minimum-phase")]
    JohanssonMinimumPhase,
    /// Johansson (2000), non-minimum-phase setting P+.
    #[serde(rename = "johansson-2000-non-minimum-phase")]
    JohanssonNonMinimumPhase,
    /// Cocota (2009), minimum-phase setting P−, tank 2 trapezoidal.
    #[serde(rename = "cocota-2009-minimum-phase")]
    CocotaMinimumPhase,
    /// Cocota (2009), non-minimum-phase setting P+, tank 2 trapezoidal.
    #[serde(rename = "cocota-2009-non-minimum-phase")]
    CocotaNonMinimumPhase,
    /// Junqueira, Neves and Angelico, case a: γ = 0.6, minimum phase.
    #[serde(rename = "junqueira-case-a")]
    JunqueiraA,
    /// Junqueira, Neves and Angelico, case b: γ = 0.4, non-minimum phase.
    #[serde(rename = "junqueira-case-b")]
    JunqueiraB,
    /// Alvarado et al. (2011), the four-tank benchmark of the HD-MPC project in Seville.
    #[serde(rename = "seville-hd-mpc")]
    Seville,
    /// The coupled tanks of Quanser, with the numbers of `MPCtools` and jMPC.
    #[serde(rename = "quanser-mpctools")]
    Quanser,
    /// The nonlinear example of `MPCtools`, on Johansson's rig.
    #[serde(rename = "mpctools-nonlinear")]
    MpcTools,
    /// The modified four-tank system of a course at DTU, with inflow into the upper tanks.
    #[serde(rename = "dtu-modified-four-tank")]
    Dtu,
}

impl PresetId {
    /// All of them: the rigs of the laboratory's own sources by year, then those of other researchers.
    pub const ALL: [Self; 10] = [
        Self::JohanssonMinimumPhase,
        Self::JohanssonNonMinimumPhase,
        Self::CocotaMinimumPhase,
        Self::CocotaNonMinimumPhase,
        Self::JunqueiraA,
        Self::JunqueiraB,
        Self::Seville,
        Self::Quanser,
        Self::MpcTools,
        Self::Dtu,
    ];

    /// The name in the scenario document.
    pub const fn name(self) -> &'static str {
        match self {
            Self::JohanssonMinimumPhase => "johansson-2000-minimum-phase",
            Self::JohanssonNonMinimumPhase => "johansson-2000-non-minimum-phase",
            Self::CocotaMinimumPhase => "cocota-2009-minimum-phase",
            Self::CocotaNonMinimumPhase => "cocota-2009-non-minimum-phase",
            Self::JunqueiraA => "junqueira-case-a",
            Self::JunqueiraB => "junqueira-case-b",
            Self::Seville => "seville-hd-mpc",
            Self::Quanser => "quanser-mpctools",
            Self::MpcTools => "mpctools-nonlinear",
            Self::Dtu => "dtu-modified-four-tank",
        }
    }

    /// The preset of that [`name`](Self::name).
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|id| id.name() == name)
    }

    /// The rig with its numbers.
    pub fn preset(self) -> Preset {
        match self {
            Self::JohanssonMinimumPhase => johansson::minimum_phase(),
            Self::JohanssonNonMinimumPhase => johansson::non_minimum_phase(),
            Self::CocotaMinimumPhase => cocota::minimum_phase(),
            Self::CocotaNonMinimumPhase => cocota::non_minimum_phase(),
            Self::JunqueiraA => junqueira::case(self, 0.6),
            Self::JunqueiraB => junqueira::case(self, 0.4),
            Self::Seville => seville::preset(),
            Self::Quanser => quanser::preset(),
            Self::MpcTools => mpctools::preset(),
            Self::Dtu => dtu::preset(),
        }
    }
}

/// The unit in which a source prints its levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DisplayUnit {
    /// Centimetres.
    Cm,
    /// Millimetres.
    Mm,
    /// Metres.
    M,
}

/// Numbers as a source prints them, in SI, to compare with. What it does not print is absent: nothing here is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// Levels h1…h4 (m), measured or rounded: the printed parameters and inputs have another exact equilibrium.
    pub levels: [f64; 4],
    /// How many decimals of them are printed, in the unit of the source.
    pub level_decimals: usize,
    /// Time constants T1…T4 (s).
    pub time_constants_s: Option<[f64; 4]>,
    /// Transmission zeros (1/s), the smaller first.
    pub zeros: Option<[f64; 2]>,
    /// Relative gain λ11.
    pub rga_11: Option<f64>,
    /// Steady-state gain matrix, by rows (V/V).
    pub dc_gain: Option<[[f64; 2]; 2]>,
}

impl Printed {
    /// Levels (m) that are printed with some decimals, and nothing else.
    pub const fn levels(levels: [f64; 4], level_decimals: usize) -> Self {
        Self { levels, level_decimals, time_constants_s: None, zeros: None, rga_11: None, dc_gain: None }
    }
}

/// How the references of an experiment move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReferenceMoves {
    /// References 1 and 2 rise by a share of their levels at rest, each at its time (s).
    Apart([f64; 2]),
    /// Both references go to the given levels (m), at the given times (s).
    Sequence(&'static [(f64, [f64; 2])]),
}

/// Two PI loops and an experiment that moves the references. The settings are those of the source where it prints any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiExperiment {
    /// Which pump each loop drives.
    pub pairing: Pairing,
    /// K (V/V) of the loops of levels 1 and 2.
    pub gains: [f64; 2],
    /// Ti (s) of the loops of levels 1 and 2.
    pub integral_times_s: [f64; 2],
    /// Sampling time (s) of both loops.
    pub sampling_time_s: f64,
    /// How the references move.
    pub references: ReferenceMoves,
    /// When the experiment ends (s).
    pub duration_s: f64,
}

/// A published rig: the plant, the inputs at which it was run, and what the source prints about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Its name.
    pub id: PresetId,
    /// Where it was published (author and year).
    pub source: &'static str,
    /// The table that holds the parameters.
    pub table: &'static str,
    /// The unit in which the source gives levels.
    pub display_unit: DisplayUnit,
    /// The rig.
    pub plant: QuadrupleTank,
    /// Pump voltages at the published operating point (V).
    pub pump_voltage: [f64; 2],
    /// Two PI loops for it.
    pub pi: PiExperiment,
    /// What the source prints, where it prints anything.
    pub printed: Option<Printed>,
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn every_name_brings_its_rig_back() {
        for id in PresetId::ALL {
            assert_eq!(PresetId::from_name(id.name()), Some(id));
            assert_eq!(id.preset().id, id);
        }
        assert_eq!(PresetId::from_name("johansson-2000"), None);
    }

    #[test]
    fn documents_call_every_rig_by_its_name() {
        for id in PresetId::ALL {
            assert_eq!(serde_json::to_value(id).unwrap(), id.name());
        }
    }

    #[test]
    fn every_rig_can_rest_at_its_inputs() {
        for id in PresetId::ALL {
            let preset = id.preset();
            assert!(preset.plant.equilibrium(preset.pump_voltage).is_ok(), "{}", id.name());
        }
    }

    #[test]
    fn junqueira_rests_at_ten_centimetres() {
        for id in [PresetId::JunqueiraA, PresetId::JunqueiraB] {
            let preset = id.preset();
            let levels = preset.plant.free_equilibrium(preset.pump_voltage).levels;
            assert_relative_eq!(levels[0], 0.1, max_relative = 1e-12);
            assert_relative_eq!(levels[1], 0.1, max_relative = 1e-12);
        }
    }
}
