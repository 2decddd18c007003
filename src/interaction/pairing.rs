use serde::Serialize;

use crate::linear::StateSpace;

/// Which pairing the rules suggest, and why.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
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
