use crate::linear::{LinearError, TransmissionZero};

use crate::study::LinearPlant;

/// Where the right-most transmission zero of a plant is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ZeroSituation {
    /// In the left half-plane (1/s): the plant is minimum phase.
    Left(f64),
    /// In the right half-plane (1/s).
    Right(f64),
    /// At the origin: G(0) is singular.
    Origin,
    /// Nowhere: the plant has no finite zero.
    NoFinite,
    /// Nowhere, because γ1 = γ2 = 1: nothing couples the loops.
    Uncoupled,
    /// Everywhere: det G(s) ≡ 0.
    Degenerate,
}

impl ZeroSituation {
    /// The situation of a plant with these valve fractions, incremental ones where they depend on the flow.
    pub fn of(plant: &LinearPlant, valves: [f64; 2]) -> Self {
        if valves == [1.0, 1.0] {
            return Self::Uncoupled;
        }
        match (&plant.zeros, plant.rightmost_zero(), &plant.rga_11) {
            (Err(_), ..) => Self::Degenerate,
            (Ok(_), None, _) => Self::NoFinite,
            (Ok(_), Some(_), Err(LinearError::SingularGain { .. })) => Self::Origin,
            (Ok(_), Some(zero), _) if zero.value.re > 0.0 => Self::Right(zero.value.re),
            (Ok(_), Some(zero), _) => Self::Left(zero.value.re),
        }
    }

    /// Whether this situation limits what control can do.
    pub fn limits_control(self) -> bool {
        matches!(self, Self::Right(_) | Self::Origin | Self::Degenerate)
    }
}

/// A component below this share of a unit vector counts as none.
const NO_PART: f64 = 0.05;

/// What the output direction of a zero means for the two levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroEffect {
    /// The zero is in the left half-plane and limits nothing.
    Harmless,
    /// It limits one level alone.
    OneLevel {
        /// Index of the level.
        level: usize,
    },
    /// It limits steps of both levels in opposite directions.
    Opposed,
    /// It limits steps of both levels in the same direction.
    Together,
}

impl ZeroEffect {
    /// The effect of a zero.
    pub fn of(zero: &TransmissionZero) -> Self {
        let y: [f64; 2] = [zero.output_direction[0].re, zero.output_direction[1].re];
        if zero.value.re < 0.0 {
            Self::Harmless
        } else if let Some(other) = y.iter().position(|part| part.abs() < NO_PART) {
            Self::OneLevel { level: 1 - other }
        } else if y[0] * y[1] < 0.0 {
            Self::Opposed
        } else {
            Self::Together
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::{analyse, setup_of};

    fn at(valves: [f64; 2]) -> (ZeroSituation, Option<ZeroEffect>) {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.valves = valves;
        let plant = analyse(&setup).unwrap().linear;
        (ZeroSituation::of(&plant, valves), plant.rightmost_zero().map(ZeroEffect::of))
    }

    #[test]
    fn every_part_of_the_valve_plane_has_its_situation() {
        let (situation, effect) = at([0.7, 0.6]);
        assert!(matches!(situation, ZeroSituation::Left(z) if z < 0.0) && !situation.limits_control());
        assert_eq!(effect, Some(ZeroEffect::Harmless));
        let (situation, effect) = at([0.43, 0.34]);
        assert!(matches!(situation, ZeroSituation::Right(z) if z > 0.0) && situation.limits_control());
        assert_eq!(effect, Some(ZeroEffect::Opposed));
        assert_eq!(at([0.4, 0.6]).0, ZeroSituation::Origin);
        assert_eq!(at([1.0, 1.0]).0, ZeroSituation::Uncoupled);
        assert_eq!(at([1.0, 0.0]).0, ZeroSituation::Degenerate);
    }

    /// ψᵀ G(z) = 0 gives ψ1/ψ2 ∝ −(1 − γ1)/γ1 and ψ2/ψ1 ∝ −(1 − γ2)/γ2 (Johansson 2000, §III): with γ1 small the zero limits level 1,
    /// with γ2 small level 2.
    #[test]
    fn a_nearly_closed_valve_makes_the_zero_one_of_its_own_level() {
        for (valves, level) in [([0.01, 0.9], 0), ([0.9, 0.01], 1)] {
            let (situation, effect) = at(valves);
            assert!(situation.limits_control());
            assert_eq!(effect, Some(ZeroEffect::OneLevel { level }), "{valves:?}");
        }
    }
}
