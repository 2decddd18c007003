use super::{PublishedDisturbance, PublishedMethod, PublishedModel, PublishedObjective};
use crate::assess::IndexVerdict;

use IndexVerdict::{Fair, Keep, Retune};
use PublishedDisturbance::{Random, SineH, SineL};
use PublishedMethod::{Genetic, Gradient, Lambda, Skogestad};
use PublishedModel::{Nominal, Uncertain};
use PublishedObjective::{Averaging, Tight};

/// Ticks of a row of Table 5.7 or 5.8 with one model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PublishedRanks {
    /// The disturbance.
    pub disturbance: PublishedDisturbance,
    /// The objective: Table 5.7 is tight, 5.8 averaging control.
    pub objective: PublishedObjective,
    /// The model.
    pub model: PublishedModel,
    /// Ticks in the order of [`PublishedRanks::METHODS`]: 4 for the best, 0 (a cross in print) for what is worse than the current tuning.
    pub ticks: [u32; 4],
}

impl PublishedRanks {
    /// The methods in the order of the columns.
    pub const METHODS: [PublishedMethod; 4] = [Gradient, Genetic, Skogestad, Lambda];
}

const fn ranks(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    model: PublishedModel,
    ticks: [u32; 4],
) -> PublishedRanks {
    PublishedRanks { disturbance, objective, model, ticks }
}

/// Tables 5.7 (tight) and 5.8 (averaging), as printed.
pub const RANKS: [PublishedRanks; 12] = [
    ranks(SineL, Tight, Nominal, [3, 4, 1, 2]),
    ranks(SineL, Tight, Uncertain, [3, 4, 1, 2]),
    ranks(SineH, Tight, Nominal, [3, 4, 2, 0]),
    ranks(SineH, Tight, Uncertain, [3, 4, 2, 0]),
    ranks(Random, Tight, Nominal, [3, 4, 0, 0]),
    ranks(Random, Tight, Uncertain, [3, 4, 0, 0]),
    ranks(SineL, Averaging, Nominal, [3, 4, 2, 2]),
    ranks(SineL, Averaging, Uncertain, [4, 2, 3, 3]),
    ranks(SineH, Averaging, Nominal, [4, 3, 2, 2]),
    ranks(SineH, Averaging, Uncertain, [4, 3, 2, 2]),
    ranks(Random, Averaging, Nominal, [4, 3, 2, 2]),
    ranks(Random, Averaging, Uncertain, [3, 4, 2, 2]),
];

/// An entry of Table 5.15: what the model error does to the variances of a disturbance, in the mean of the four methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedChange {
    /// The disturbance.
    pub disturbance: PublishedDisturbance,
    /// The objective, which says what the variance is of.
    pub objective: PublishedObjective,
    /// Change (%); positive where the variance with the uncertain model is larger.
    pub percent: f64,
}

const fn change(disturbance: PublishedDisturbance, objective: PublishedObjective, percent: f64) -> PublishedChange {
    PublishedChange { disturbance, objective, percent }
}

/// Table 5.15.
pub const CHANGES: [PublishedChange; 6] = [
    change(SineL, Tight, 47.0),
    change(SineH, Tight, -20.0),
    change(Random, Tight, -21.0),
    change(SineL, Averaging, -15.0),
    change(SineH, Averaging, -15.0),
    change(Random, Averaging, -14.0),
];

/// An entry of Table 5.16: whether the current controller needs another tuning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PublishedVerdict {
    /// The disturbance.
    pub disturbance: PublishedDisturbance,
    /// The objective.
    pub objective: PublishedObjective,
    /// The model of the optimised tuning.
    pub model: PublishedModel,
    /// The author's verdict. "Not so well tuned" is [`IndexVerdict::Fair`].
    pub verdict: IndexVerdict,
}

const fn verdict(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    model: PublishedModel,
    verdict: IndexVerdict,
) -> PublishedVerdict {
    PublishedVerdict { disturbance, objective, model, verdict }
}

/// Table 5.16, whose signs stand here by the words of the text around it.
pub const VERDICTS: [PublishedVerdict; 12] = [
    verdict(SineL, Tight, Nominal, Retune),
    verdict(SineL, Tight, Uncertain, Retune),
    verdict(SineH, Tight, Nominal, Keep),
    verdict(SineH, Tight, Uncertain, Fair),
    verdict(Random, Tight, Nominal, Keep),
    verdict(Random, Tight, Uncertain, Fair),
    verdict(SineL, Averaging, Nominal, Retune),
    verdict(SineL, Averaging, Uncertain, Retune),
    verdict(SineH, Averaging, Nominal, Retune),
    verdict(SineH, Averaging, Uncertain, Retune),
    verdict(Random, Averaging, Nominal, Retune),
    verdict(Random, Averaging, Uncertain, Retune),
];
