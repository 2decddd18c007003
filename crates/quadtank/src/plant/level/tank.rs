use serde::{Deserialize, Serialize};

use super::LevelError;
use super::error::within;

/// How water leaves a single tank.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Outflow {
    /// Laminar: `q = h/R` (Andreis 2017, Eq. 12; the lecture slides).
    Linear {
        /// Resistance R (s/m²).
        resistance: f64,
    },
    /// Turbulent: `q = k √h` (Andreis 2017, Eq. 6).
    SquareRoot {
        /// Coefficient k (m^2.5/s).
        coefficient: f64,
    },
    /// A pump draws the same flow at every level: the tank integrates (Andreis 2017, §2.1; Rice and Cooper 2015).
    Pumped {
        /// Flow (m³/s).
        flow: f64,
    },
}

/// A law of outflow without its parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutflowLaw {
    /// [`Outflow::Linear`].
    Linear,
    /// [`Outflow::SquareRoot`].
    SquareRoot,
    /// [`Outflow::Pumped`].
    Pumped,
}

impl OutflowLaw {
    /// The outflow of this law that carries a flow (m³/s) at a level (m), both above 0.
    pub fn through(self, level: f64, flow: f64) -> Outflow {
        match self {
            Self::Linear => Outflow::Linear { resistance: level / flow },
            Self::SquareRoot => Outflow::SquareRoot { coefficient: flow / level.sqrt() },
            Self::Pumped => Outflow::Pumped { flow },
        }
    }
}

impl Outflow {
    /// Its law.
    pub const fn law(&self) -> OutflowLaw {
        match self {
            Self::Linear { .. } => OutflowLaw::Linear,
            Self::SquareRoot { .. } => OutflowLaw::SquareRoot,
            Self::Pumped { .. } => OutflowLaw::Pumped,
        }
    }

    /// Outflow at a level (m³/s); nothing leaves an empty tank.
    #[inline]
    pub fn flow(&self, level: f64) -> f64 {
        if level <= 0.0 {
            return 0.0;
        }
        match *self {
            Self::Linear { resistance } => level / resistance,
            Self::SquareRoot { coefficient } => coefficient * level.sqrt(),
            Self::Pumped { flow } => flow,
        }
    }

    /// The same law for all flows multiplied by a factor, such as the opening of a valve.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Linear { resistance } => Self::Linear { resistance: resistance / factor },
            Self::SquareRoot { coefficient } => Self::SquareRoot { coefficient: coefficient * factor },
            Self::Pumped { flow } => Self::Pumped { flow: flow * factor },
        }
    }

    /// Resistance `R = dh/dq` at a level (s/m²): R of the linear law, `2 √h/k = 2 h/q` of the square root (Andreis 2017, Eqs. 9
    /// to 12); `None` for pumped outflow, which does not depend on level.
    pub fn resistance(&self, level: f64) -> Option<f64> {
        match *self {
            Self::Linear { resistance } => Some(resistance),
            Self::SquareRoot { coefficient } => Some(2.0 * level.max(0.0).sqrt() / coefficient),
            Self::Pumped { .. } => None,
        }
    }

    /// Level at which the tank carries a flow (m), the inverse of [`flow`](Self::flow); `None` for pumped outflow.
    pub fn level_for(&self, flow: f64) -> Option<f64> {
        match *self {
            Self::Linear { resistance } => Some(flow * resistance),
            Self::SquareRoot { coefficient } => Some((flow / coefficient).powi(2)),
            Self::Pumped { .. } => None,
        }
    }

    pub(super) fn check(&self) -> Result<(), LevelError> {
        match *self {
            Self::Linear { resistance } => within("resistance", resistance, f64::MIN_POSITIVE, f64::MAX),
            Self::SquareRoot { coefficient } => within("coefficient", coefficient, f64::MIN_POSITIVE, f64::MAX),
            Self::Pumped { flow } => within("flow", flow, 0.0, f64::MAX),
        }
    }
}

/// A prismatic tank with its outflow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LevelTank {
    /// Cross-section A (m²).
    pub area: f64,
    /// Height of the walls (m).
    pub height: f64,
    /// Outflow, with an open valve where the valve stands in the outlet.
    pub outflow: Outflow,
}

impl LevelTank {
    /// The linear model around a level (Andreis 2017, Eqs. 13 to 23, 64 to 69).
    pub fn linearise(&self, level: f64) -> TankModel {
        TankModel { capacitance: self.area, resistance: self.outflow.resistance(level) }
    }

    pub(super) fn check(&self) -> Result<(), LevelError> {
        within("area", self.area, f64::MIN_POSITIVE, f64::MAX)?;
        within("height", self.height, f64::MIN_POSITIVE, f64::MAX)?;
        self.outflow.check()
    }
}

/// A tank around a level: `dΔh/dt = Δq_in/C − Δh/(R C)`, so `H/Q_in = R/(R C s + 1)` (Andreis 2017, Eqs. 15 to 23, 64 to 69).
///
/// Equations 25 and 26 of that source multiply R by a process gain once more; they are not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TankModel {
    /// Capacitance `C = dV/dh` (m²), the cross-section.
    pub capacitance: f64,
    /// Resistance R (s/m²), the gain from inflow to level; `None` for a tank that integrates.
    pub resistance: Option<f64>,
}

impl TankModel {
    /// Time constant `τ = R C` (s) (Andreis 2017, Eq. 22); `None` for a tank that integrates.
    pub fn time_constant(&self) -> Option<f64> {
        Some(self.resistance? * self.capacitance)
    }

    /// Deviation of the level (m), `time` (s) after a step of the inflow (m³/s): the solution of Eq. 7 of the lecture slides.
    pub fn step_response(&self, inflow_step: f64, time: f64) -> f64 {
        match self.resistance {
            Some(resistance) => -resistance * inflow_step * (-time / (resistance * self.capacitance)).exp_m1(),
            None => inflow_step * time / self.capacitance,
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const LAWS: [Outflow; 3] = [
        Outflow::Linear { resistance: 382.2 },
        Outflow::SquareRoot { coefficient: 0.03 },
        Outflow::Pumped { flow: 0.01 },
    ];

    #[test]
    fn another_law_carries_the_same_flow_at_its_level() {
        for law in [OutflowLaw::Linear, OutflowLaw::SquareRoot, OutflowLaw::Pumped] {
            let outflow = law.through(0.8, 0.02);
            assert_eq!(outflow.law(), law);
            assert_relative_eq!(outflow.flow(0.8), 0.02, max_relative = 1e-15);
        }
    }

    #[test]
    fn resistance_is_the_slope_of_level_over_flow() {
        for law in LAWS {
            let slope = (law.flow(0.8 + 1e-6) - law.flow(0.8 - 1e-6)) / 2e-6;
            let expected = law.resistance(0.8).map_or(0.0, f64::recip);
            assert!((slope - expected).abs() < 1e-9 * (1.0 + expected), "{law:?}");
        }
    }

    #[test]
    fn an_opening_scales_flow_at_every_level_and_levels_invert_it() {
        for law in LAWS {
            assert_relative_eq!(law.scaled(0.3).flow(0.7), 0.3 * law.flow(0.7), max_relative = 1e-14);
            assert_eq!((law.flow(0.0), law.flow(-0.1)), (0.0, 0.0));
            if let Some(level) = law.level_for(law.flow(0.7)) {
                assert_relative_eq!(level, 0.7, max_relative = 1e-14);
            }
        }
        assert_eq!(Outflow::Pumped { flow: 0.01 }.level_for(0.01), None);
    }

    #[test]
    fn the_tangent_cuts_the_axis_of_level_at_minus_the_level() {
        // The construction of Andreis (2017, Fig. 2.4) with the curve of level over outflow; at 0 for the linear law.
        let [linear, root, pumped] = LAWS.map(|law| Some(0.8 - law.resistance(0.8)? * law.flow(0.8)));
        assert!(linear.unwrap().abs() < 1e-15);
        assert_relative_eq!(root.unwrap(), -0.8, max_relative = 1e-14);
        assert_eq!(pumped, None);
    }

    #[test]
    fn a_pumped_tank_integrates() {
        let model = LevelTank { area: 0.5, height: 2.0, outflow: LAWS[2] }.linearise(1.0);
        assert_eq!((model.resistance, model.time_constant()), (None, None));
        assert_relative_eq!(model.step_response(1e-3, 50.0), 0.1, max_relative = 1e-14);
    }
}
