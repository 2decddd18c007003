use nalgebra::DMatrix;
use serde::Serialize;

use super::relative_gain_array;

/// Relative gains closer than this are equal, and negative only beyond it: the rounding of a well-conditioned gain.
const ROUNDING: f64 = 1e-12;

/// Which pairing the rules suggest, and why.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "pairing", content = "reason", rename_all = "kebab-case")]
pub enum PairingVerdict {
    /// Level 1 – pump 1, level 2 – pump 2.
    Diagonal(PairingReason),
    /// Level 1 – pump 2, level 2 – pump 1.
    Swapped(PairingReason),
    /// No pairing can be suggested.
    None(PairingReason),
}

/// The rule that decided.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum PairingReason {
    /// The other pairing has a negative relative gain (Cocota 2009, §4.2.3: never pair on a negative relative gain).
    OnlyPositiveRelativeGain {
        /// λ of the suggested pairing.
        relative_gain: f64,
    },
    /// Both relative gains are in [0, 1]; the larger one is closer to 1 (Bristol 1966).
    RelativeGainCloserToOne {
        /// λ of the suggested pairing.
        relative_gain: f64,
    },
    /// λ11 = ½: neither pairing is better.
    EqualRelativeGains,
    /// G(0) is singular: λ11 is unbounded and no decentralised integral control exists.
    SingularGain,
}

/// Niederlinski index of both pairings of a 2 × 2 gain, diagonal first: the determinant of the gain, columns permuted so
/// that paired entries are on the diagonal, over the product of these entries (Niederlinski 1971).
///
/// Decentralised control with integral action in a pairing with a negative index is unstable, however it is tuned, if each
/// loop is stable alone.
/// `None` where a paired entry is 0, the index does not fit in f64, or the gain is not 2 × 2.
pub fn niederlinski(gain: &DMatrix<f64>) -> [Option<f64>; 2] {
    if gain.shape() != (2, 2) {
        return [None, None];
    }
    let diagonal = gain[(0, 0)] * gain[(1, 1)];
    let off_diagonal = gain[(0, 1)] * gain[(1, 0)];
    let index = |paired: f64, crossed: f64| Some((paired - crossed) / paired).filter(|index| index.is_finite());
    [index(diagonal, off_diagonal), index(off_diagonal, diagonal)]
}

/// Which pump should hold which level, from the relative gains of a steady-state gain (2 × 2, outputs by inputs).
///
/// Never pair on a negative relative gain (Cocota 2009, §4.2.3); of two gains in \[0, 1\] take the one closer to 1. For
/// the quadruple tank λ11 = γ1γ2/(γ1+γ2−1) (eq. 4.10) decides for the diagonal pairing, and λ12 =
/// (1−γ1)(1−γ2)/(1−γ1−γ2) (eq. 4.14) for the swapped one. A gain that is singular, not finite or not 2 × 2 gives no
/// pairing.
pub fn recommend_pairing(gain: &DMatrix<f64>) -> PairingVerdict {
    let array = relative_gain_array(gain).ok().filter(|array| array.shape() == (2, 2));
    let Some(array) = array else { return PairingVerdict::None(PairingReason::SingularGain) };
    let (diagonal, swapped) = (array[(0, 0)], array[(0, 1)]);
    if (diagonal - 0.5).abs() <= ROUNDING {
        return PairingVerdict::None(PairingReason::EqualRelativeGains);
    }
    let relative_gain = diagonal.max(swapped);
    let reason = if diagonal.min(swapped) < -ROUNDING {
        PairingReason::OnlyPositiveRelativeGain { relative_gain }
    } else {
        PairingReason::RelativeGainCloserToOne { relative_gain }
    };
    if diagonal > swapped { PairingVerdict::Diagonal(reason) } else { PairingVerdict::Swapped(reason) }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::dmatrix;

    use super::*;

    #[test]
    fn a_negative_relative_gain_decides() {
        // λ11 = 6/4
        let PairingVerdict::Diagonal(PairingReason::OnlyPositiveRelativeGain { relative_gain }) =
            recommend_pairing(&dmatrix![2.0, 1.0; 2.0, 3.0])
        else {
            panic!("diagonal pairing expected")
        };
        assert_relative_eq!(relative_gain, 1.5, max_relative = 1e-14);
        let PairingVerdict::Swapped(PairingReason::OnlyPositiveRelativeGain { relative_gain }) =
            recommend_pairing(&dmatrix![1.0, 2.0; 3.0, 2.0])
        else {
            panic!("swapped pairing expected")
        };
        assert_relative_eq!(relative_gain, 1.5, max_relative = 1e-14);
    }

    #[test]
    fn between_two_positive_ones_the_larger_decides() {
        // λ11 = 6/8
        let gain = dmatrix![2.0, -1.0; 2.0, 3.0];
        let reason = PairingReason::RelativeGainCloserToOne { relative_gain: 0.75 };
        assert_eq!(recommend_pairing(&gain), PairingVerdict::Diagonal(reason));
        let no_interaction = dmatrix![0.0, 1.0; 1.0, 0.0];
        let reason = PairingReason::RelativeGainCloserToOne { relative_gain: 1.0 };
        assert_eq!(recommend_pairing(&no_interaction), PairingVerdict::Swapped(reason));
    }

    #[test]
    fn undecided_and_impossible() {
        let equal = PairingVerdict::None(PairingReason::EqualRelativeGains);
        assert_eq!(recommend_pairing(&dmatrix![1.0, -1.0; 1.0, 1.0]), equal);
        let singular = PairingVerdict::None(PairingReason::SingularGain);
        for gain in [dmatrix![1.0, 1.0; 1.0, 1.0], dmatrix![f64::NAN, 1.0; 1.0, 1.0], dmatrix![1.0], dmatrix![1.0, 2.0]]
        {
            assert_eq!(recommend_pairing(&gain), singular);
        }
    }

    #[test]
    fn niederlinski_index_of_both_pairings() {
        // det = 4; 4/6 and, with the columns exchanged, −4/2.
        let [diagonal, swapped] = niederlinski(&dmatrix![2.0, 1.0; 2.0, 3.0]).map(Option::unwrap);
        assert_relative_eq!(diagonal, 2.0 / 3.0, max_relative = 1e-15);
        assert_eq!(swapped, -2.0);
        assert_eq!(niederlinski(&dmatrix![1.0, 0.0; 2.0, 3.0]), [Some(1.0), None]);
        assert_eq!(niederlinski(&dmatrix![1.0]), [None, None]);
        assert_eq!(niederlinski(&dmatrix![f64::NAN, 1.0; 1.0, 1.0]), [None, None]);
    }
}
