use serde::{Deserialize, Serialize};

use super::{cocota, johansson, junqueira};
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
}

impl PresetId {
    /// All of them, in the order of publication.
    pub const ALL: [Self; 6] = [
        Self::JohanssonMinimumPhase,
        Self::JohanssonNonMinimumPhase,
        Self::CocotaMinimumPhase,
        Self::CocotaNonMinimumPhase,
        Self::JunqueiraA,
        Self::JunqueiraB,
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
}

/// Numbers as a source prints them, in SI, to compare with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// Levels h1…h4 (m), measured or rounded: the printed parameters and inputs have another exact equilibrium.
    pub levels: [f64; 4],
    /// Time constants T1…T4 (s).
    pub time_constants_s: [f64; 4],
    /// Transmission zeros (1/s), the smaller first.
    pub zeros: [f64; 2],
    /// Relative gain λ11.
    pub rga_11: f64,
    /// Steady-state gain matrix, by rows (V/V), where it is printed.
    pub dc_gain: Option<[[f64; 2]; 2]>,
}

/// Two PI loops and an experiment that steps one reference after the other. The settings are those of the source where it prints any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiExperiment {
    /// Which pump each loop drives.
    pub pairing: Pairing,
    /// K (V/V) of the loops of levels 1 and 2.
    pub gains: [f64; 2],
    /// Ti (s) of the loops of levels 1 and 2.
    pub integral_times_s: [f64; 2],
    /// When references 1 and 2 step (s).
    pub step_times_s: [f64; 2],
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
