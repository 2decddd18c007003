use super::PublishedDisturbance;
use crate::tuning::PiTuning;

use PublishedDisturbance::{Random, SineH, SineL};
use PublishedMethod::{Current, Genetic, Gradient, Lambda, Skogestad};
use PublishedModel::{Nominal, Uncertain};
use PublishedObjective::{Averaging, Tight};

/// What a level loop is for (Andreis 2017, §2.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedObjective {
    /// The level is to stay at its set-point: least variance of the level.
    Tight,
    /// The tank is to absorb the disturbance: least variance of the outflow.
    Averaging,
}

/// Where a tuning comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedMethod {
    /// The controller as it is.
    Current,
    /// Optimised with `fmincon`.
    Gradient,
    /// Optimised with `ga`.
    Genetic,
    /// SIMC. For averaging control, where its gain is rounded up to the bound, the row of Lambda tuning is the same.
    Skogestad,
    /// Lambda tuning.
    Lambda,
}

/// Which model a variance is computed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PublishedModel {
    /// That of the plant.
    Nominal,
    /// With another area and valve, §5.1.
    Uncertain,
}

/// A row of Tables 5.1 to 5.6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedVariance {
    /// The disturbance.
    pub disturbance: PublishedDisturbance,
    /// The objective, which says what the variance is of.
    pub objective: PublishedObjective,
    /// The method.
    pub method: PublishedMethod,
    /// The model.
    pub model: PublishedModel,
    /// The controller.
    pub tuning: PiTuning,
    /// As printed: of the level (m²; the unit in print is wrong) or of the outflow ((m³/s)²).
    pub variance: f64,
}

const fn row(
    disturbance: PublishedDisturbance,
    objective: PublishedObjective,
    method: PublishedMethod,
    model: PublishedModel,
    gain: f64,
    integral_time_s: f64,
    variance: f64,
) -> PublishedVariance {
    PublishedVariance { disturbance, objective, method, model, tuning: PiTuning { gain, integral_time_s }, variance }
}

/// Tables 5.1 to 5.6. The row of the current controller is that of the plant in both halves of a table.
pub const VARIANCES: [PublishedVariance; 48] = [
    // Table 5.1
    row(SineL, Tight, Current, Nominal, 10.0, 2500.0, 3.501_6e-4),
    row(SineL, Tight, Gradient, Nominal, 93.7, 2999.7, 4.552_0e-6),
    row(SineL, Tight, Gradient, Uncertain, 91.2, 2999.7, 6.811_3e-6),
    row(SineL, Tight, Genetic, Nominal, 93.6, 3484.7, 4.551_8e-6),
    row(SineL, Tight, Genetic, Uncertain, 100.0, 2306.7, 6.630_9e-6),
    row(SineL, Tight, Skogestad, Nominal, 17.4, 23.5, 1.651_3e-4),
    row(SineL, Tight, Skogestad, Uncertain, 17.4, 23.5, 2.491_4e-4),
    row(SineL, Tight, Lambda, Nominal, 100.0, 588.0, 5.038_9e-6),
    row(SineL, Tight, Lambda, Uncertain, 100.0, 588.0, 7.038_5e-6),
    // Table 5.2
    row(SineL, Averaging, Current, Nominal, 10.0, 2500.0, 1.713_5e-5),
    row(SineL, Averaging, Gradient, Nominal, 0.2, 2999.7, 2.599_6e-7),
    row(SineL, Averaging, Gradient, Uncertain, 0.2, 2999.7, 2.200_9e-7),
    row(SineL, Averaging, Genetic, Nominal, 0.2, 4112.4, 2.597_9e-7),
    row(SineL, Averaging, Genetic, Uncertain, 0.2, 349.7, 2.245_2e-7),
    row(SineL, Averaging, Skogestad, Nominal, 0.2, 588.0, 2.626_8e-7),
    row(SineL, Averaging, Skogestad, Uncertain, 0.2, 588.0, 2.223_8e-7),
    // Table 5.3
    row(SineH, Tight, Current, Nominal, 10.0, 2500.0, 4.513_9e-5),
    row(SineH, Tight, Gradient, Nominal, 5.0, 2999.7, 4.248_6e-5),
    row(SineH, Tight, Gradient, Uncertain, 5.5, 2999.7, 3.517_0e-5),
    row(SineH, Tight, Genetic, Nominal, 5.0, 1021.5, 4.253_6e-5),
    row(SineH, Tight, Genetic, Uncertain, 5.5, 3974.0, 3.516_4e-5),
    row(SineH, Tight, Skogestad, Nominal, 17.4, 23.5, 5.691_1e-5),
    row(SineH, Tight, Skogestad, Uncertain, 17.4, 23.5, 4.493_3e-5),
    row(SineH, Tight, Lambda, Nominal, 100.0, 588.0, 3.234_6e-4),
    row(SineH, Tight, Lambda, Uncertain, 100.0, 588.0, 2.445_2e-4),
    // Table 5.4
    row(SineH, Averaging, Current, Nominal, 10.0, 2500.0, 3.768_1e-7),
    row(SineH, Averaging, Gradient, Nominal, 0.2, 2999.7, 8.013_0e-9),
    row(SineH, Averaging, Gradient, Uncertain, 0.2, 2999.7, 6.828_2e-9),
    row(SineH, Averaging, Genetic, Nominal, 0.2, 1735.8, 8.029_9e-9),
    row(SineH, Averaging, Genetic, Uncertain, 0.2, 1177.3, 6.859_1e-9),
    row(SineH, Averaging, Skogestad, Nominal, 0.2, 588.0, 8.112_7e-9),
    row(SineH, Averaging, Skogestad, Uncertain, 0.2, 588.0, 6.913_0e-9),
    // Table 5.5
    row(Random, Tight, Current, Nominal, 10.0, 2500.0, 9.306_1e-6),
    row(Random, Tight, Gradient, Nominal, 4.4, 2999.7, 9.093_6e-6),
    row(Random, Tight, Gradient, Uncertain, 4.9, 2999.7, 7.544_0e-6),
    row(Random, Tight, Genetic, Nominal, 4.4, 4990.7, 9.086_0e-6),
    row(Random, Tight, Genetic, Uncertain, 4.9, 4764.4, 7.538_1e-6),
    row(Random, Tight, Skogestad, Nominal, 17.4, 23.5, 1.159_5e-5),
    row(Random, Tight, Skogestad, Uncertain, 17.4, 23.5, 9.612_1e-6),
    row(Random, Tight, Lambda, Nominal, 100.0, 588.0, 6.328_5e-5),
    row(Random, Tight, Lambda, Uncertain, 100.0, 588.0, 4.155_2e-5),
    // Table 5.6
    row(Random, Averaging, Current, Nominal, 10.0, 2500.0, 1.577_2e-7),
    row(Random, Averaging, Gradient, Nominal, 0.2, 2999.7, 1.972_5e-9),
    row(Random, Averaging, Gradient, Uncertain, 0.2, 2999.7, 1.685_0e-9),
    row(Random, Averaging, Genetic, Nominal, 0.2, 2924.4, 1.972_6e-9),
    row(Random, Averaging, Genetic, Uncertain, 0.2, 3592.0, 1.684_2e-9),
    row(Random, Averaging, Skogestad, Nominal, 0.2, 588.0, 1.998_5e-9),
    row(Random, Averaging, Skogestad, Uncertain, 0.2, 588.0, 1.708_7e-9),
];

impl PublishedVariance {
    /// Number of the table, 1 to 6 for 5.1 to 5.6.
    pub const fn table(&self) -> u32 {
        let first = match self.disturbance {
            SineL => 1,
            SineH => 3,
            Random => 5,
        };
        match self.objective {
            Tight => first,
            Averaging => first + 1,
        }
    }

    /// The row of a table; `None` where the source has none.
    pub fn find(
        disturbance: PublishedDisturbance,
        objective: PublishedObjective,
        method: PublishedMethod,
        model: PublishedModel,
    ) -> Option<&'static Self> {
        let is = |row: &&Self| {
            (row.disturbance, row.objective, row.method, row.model) == (disturbance, objective, method, model)
        };
        VARIANCES.iter().find(is)
    }
}
