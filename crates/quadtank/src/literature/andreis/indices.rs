use super::{PublishedDisturbance, PublishedMethod, PublishedModel, PublishedObjective};

use PublishedDisturbance::{Random, SineH, SineL};
use PublishedMethod::{Genetic, Gradient};
use PublishedObjective::{Averaging, Tight};

/// Indices of a row of Tables 5.9, 5.10, 5.12 and 5.13: the variance of an optimised tuning over that of the current one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedIndex {
    /// Number of the table, 9 for 5.9.
    pub table: u32,
    /// The disturbance.
    pub disturbance: PublishedDisturbance,
    /// The objective.
    pub objective: PublishedObjective,
    /// How the tuning was optimised.
    pub method: PublishedMethod,
    /// The index with the nominal and the uncertain model, and their difference, as printed.
    pub printed: [f64; 3],
}

const fn row(
    table: u32,
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    method: PublishedMethod,
    printed: [f64; 3],
) -> PublishedIndex {
    PublishedIndex { table, disturbance, objective, method, printed }
}

/// Tables 5.9, 5.10, 5.12 and 5.13.
pub const INDICES: [PublishedIndex; 12] = [
    row(9, SineL, Tight, Gradient, [0.0130, 0.0195, 0.0065]),
    row(9, SineH, Tight, Gradient, [0.9412, 0.7791, 0.1621]),
    row(9, Random, Tight, Gradient, [0.9772, 0.8106, 0.1665]),
    row(10, SineL, Tight, Genetic, [0.0130, 0.0189, 0.0059]),
    row(10, SineH, Tight, Genetic, [0.9423, 0.7790, 0.1633]),
    row(10, Random, Tight, Genetic, [0.9763, 0.8100, 0.1663]),
    row(12, SineL, Averaging, Gradient, [0.0152, 0.0128, 0.0023]),
    row(12, SineH, Averaging, Gradient, [0.0213, 0.0181, 0.0031]),
    row(12, Random, Averaging, Gradient, [0.0125, 0.0107, 0.0018]),
    row(13, SineL, Averaging, Genetic, [0.0152, 0.0131, 0.0021]),
    row(13, SineH, Averaging, Genetic, [0.0213, 0.0182, 0.0031]),
    row(13, Random, Averaging, Genetic, [0.0125, 0.0107, 0.0018]),
];

/// Tables 5.11 and 5.14: hundredths of quality, the same for both methods, in the order of the disturbances.
pub const HUNDREDTHS: [(u32, PublishedObjective, [u32; 3]); 2] = [(11, Tight, [1, 94, 98]), (14, Averaging, [2, 2, 1])];

/// A row of Tables 5.17 and 5.18: variances of the variable that is not the objective, and the index that they would give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedWrongIndex {
    /// The disturbance.
    pub disturbance: PublishedDisturbance,
    /// The objective of the tuning; the index is that of the other one.
    pub objective: PublishedObjective,
    /// Variance under the current, the gradient and the genetic tuning.
    pub variances: [f64; 3],
    /// Index of the gradient and the genetic tuning.
    pub indices: [f64; 2],
}

const fn wrong(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    variances: [f64; 3],
    indices: [f64; 2],
) -> PublishedWrongIndex {
    PublishedWrongIndex { disturbance, objective, variances, indices }
}

/// Tables 5.17 (tight) and 5.18 (averaging).
pub const WRONG_INDICES: [PublishedWrongIndex; 6] = [
    wrong(SineL, Tight, [1.7135e-5, 1.3360e-5, 1.3358e-5], [0.7797, 0.7796]),
    wrong(SineH, Tight, [3.7681e-7, 1.2737e-7, 1.2798e-7], [0.3380, 0.3397]),
    wrong(Random, Tight, [1.5772e-7, 4.1563e-8, 4.1517e-8], [0.2635, 0.2632]),
    wrong(SineL, Averaging, [3.5016e-4, 1.6463e-3, 1.6450e-3], [4.7015, 4.6978]),
    wrong(SineH, Averaging, [4.5139e-5, 6.5681e-5, 6.5811e-5], [1.4551, 1.4580]),
    wrong(Random, Averaging, [9.3061e-6, 1.4464e-5, 1.4466e-5], [1.5543, 1.5544]),
];

/// What is to be known about the print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AndreisRemark {
    /// The step test ran at 0.006 m³/s, all simulations at 0.017: K/τ is 2.4 times as large there.
    OperatingPoint,
    /// Variances of the level are printed in (m³/s)²; they are m².
    UnitOfLevelVariance,
    /// Gains were rounded or cut to the box, so SIMC and Lambda tuning coincide.
    CutToBox,
    /// Neither generator nor instant of switching is printed: the random rows differ by up to 0.5 %.
    RandomSequence,
    /// The best Ti of every row is the upper bound of 6000 s, and the cost hardly knows it; 2999.7 is where `fmincon` started.
    FlatIntegralTime,
    /// The tight optimum is on the limit of stability; robustness is not looked at.
    LimitOfStability,
    /// Nothing asks for the level: the optimum is the lower bound of Kp, and no control is better still.
    NoLevelConstraint,
    /// The text says that SIMC is never better than the current tuning; with the uncertain model it is.
    SkogestadIsBetterOnce,
    /// The row Sine H, nominal, should read 4, 3, X, X.
    WrongRanking,
    /// The columns of variances hold variances of the level; the indices are those of the outflow.
    LevelVariancesInPlace,
    /// The columns of the genetic search hold values of the gradient; the indices are those of the genetic search.
    GradientValuesInPlace,
    /// The left-hand side of the worked example should be `Id_varMV`.
    WrongLabel,
    /// Equation 83 keeps G under the root; it must be ρ as in Eq. 84.
    LostDensity,
    /// Equations 25 and 26 multiply by the gain twice.
    DoubleGain,
    /// The condition of SIMC is printed as θ < τc; it is −θ < τc (Skogestad 2003).
    SimcCondition,
    /// λ = 1 s is no recommendation of the rule: without dead time it has no lower bound.
    LambdaWithoutBound,
    /// The mean change of Random and averaging control is printed as 14 %; the printed variances give 14.6 %.
    RoundedDown,
    /// The verdicts are those of the text; the signs of the table itself are not legible.
    VerdictsByTheText,
}

/// The remarks on a table of chapter 5 (1 to 20 for 5.1 to 5.20).
pub fn remarks_on_table(table: u32) -> &'static [AndreisRemark] {
    use AndreisRemark::{
        CutToBox, FlatIntegralTime, GradientValuesInPlace, LevelVariancesInPlace, LimitOfStability, NoLevelConstraint,
        RandomSequence, RoundedDown, SkogestadIsBetterOnce, UnitOfLevelVariance, VerdictsByTheText, WrongRanking,
    };
    match table {
        1 => &[UnitOfLevelVariance, LimitOfStability, FlatIntegralTime],
        2 | 4 => &[CutToBox, NoLevelConstraint, FlatIntegralTime],
        3 => &[UnitOfLevelVariance, SkogestadIsBetterOnce, FlatIntegralTime],
        5 => &[UnitOfLevelVariance, RandomSequence, FlatIntegralTime],
        6 => &[CutToBox, NoLevelConstraint, RandomSequence, FlatIntegralTime],
        7 => &[WrongRanking],
        8 => &[CutToBox],
        9 | 10 | 11 | 14 | 17 | 18 => &[RandomSequence],
        12 => &[LevelVariancesInPlace, RandomSequence],
        13 => &[GradientValuesInPlace, RandomSequence],
        15 => &[RoundedDown],
        16 => &[VerdictsByTheText],
        _ => &[],
    }
}

/// The remarks on an equation.
pub fn remarks_on_equation(equation: u32) -> &'static [AndreisRemark] {
    use AndreisRemark::{DoubleGain, LambdaWithoutBound, LostDensity, OperatingPoint, SimcCondition, WrongLabel};
    match equation {
        25 | 26 => &[DoubleGain],
        40 => &[SimcCondition],
        54 => &[WrongLabel],
        55..=59 | 62 => &[OperatingPoint],
        60 | 61 => &[OperatingPoint, LambdaWithoutBound],
        83 => &[LostDensity],
        _ => &[],
    }
}

impl PublishedIndex {
    /// The model of each printed index.
    pub const MODELS: [PublishedModel; 2] = [PublishedModel::Nominal, PublishedModel::Uncertain];
}
