use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::control::IsaPid;
use crate::linear::Complex;

/// The ultimate point of a loop: the gain at which it oscillates for ever, and the period of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UltimatePoint {
    /// Ultimate gain Kc (plant input per plant output), with the sign of the plant gain.
    pub gain: f64,
    /// Ultimate period Tc (unit of time of the plant).
    pub period: f64,
}

impl UltimatePoint {
    /// Frequency (rad per unit of time).
    pub fn frequency(&self) -> f64 {
        TAU / self.period
    }
}

/// A rule that makes controller settings of an ultimate point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TuningRule {
    /// Ziegler and Nichols, P (Campestrini 2006, Table 1).
    ZieglerNicholsP,
    /// Ziegler and Nichols, PI, in the variant 0.4 Kc, 0.8 Tc (Campestrini 2006, Table 1).
    ZieglerNicholsPi,
    /// Ziegler and Nichols, PI, in the original variant 0.45 Kc, Tc/1.2 (Ziegler and Nichols 1942, Trans. ASME 64, 759–768), which
    /// Luyben (1986) starts from.
    #[serde(rename = "ziegler-nichols-1942-pi")]
    ZieglerNichols1942Pi,
    /// Ziegler and Nichols, PID (Campestrini 2006, Table 1).
    ZieglerNicholsPid,
    /// Tyreus and Luyben, PI (Campestrini 2006, Table 2).
    TyreusLuybenPi,
    /// Tyreus and Luyben, PID (Campestrini 2006, Table 2).
    TyreusLuybenPid,
}

impl TuningRule {
    /// All rules.
    pub const ALL: [Self; 6] = [
        Self::ZieglerNicholsP,
        Self::ZieglerNicholsPi,
        Self::ZieglerNichols1942Pi,
        Self::ZieglerNicholsPid,
        Self::TyreusLuybenPi,
        Self::TyreusLuybenPid,
    ];

    /// K/Kc, Ti/Tc and Td/Tc.
    const fn ratios(self) -> (f64, f64, f64) {
        match self {
            Self::ZieglerNicholsP => (0.5, f64::INFINITY, 0.0),
            Self::ZieglerNicholsPi => (0.4, 0.8, 0.0),
            Self::ZieglerNichols1942Pi => (0.45, 1.0 / 1.2, 0.0),
            Self::ZieglerNicholsPid => (0.6, 0.5, 0.125),
            Self::TyreusLuybenPi => (1.0 / 3.2, 2.2, 0.0),
            Self::TyreusLuybenPid => (1.0 / 2.2, 2.2, 1.0 / 6.3),
        }
    }

    /// The settings for an ultimate point.
    pub fn settings(self, point: UltimatePoint) -> IsaPid {
        let (gain, integral, derivative) = self.ratios();
        IsaPid {
            gain: gain * point.gain,
            integral_time: integral * point.period,
            derivative_time: derivative * point.period,
        }
    }

    /// Where the rule moves the ultimate point of every loop: from −1 to
    /// `−(K/Kc) (1 + j (2π Td/Tc − Tc/(2π Ti)))` (Campestrini 2006, Table 4).
    pub fn target(self) -> Complex {
        let (gain, integral, derivative) = self.ratios();
        Complex::new(1.0, TAU * derivative - 1.0 / (TAU * integral)) * -gain
    }
}
