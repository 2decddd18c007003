use crate::tuning::PiTuning;

/// Features of the level and the outflow under Sine L from 50 to 150 s, in the order of Tables 5.19 and 5.20: minimum, maximum, range,
/// variance, mean, standard deviation. Both tables print the same numbers, with their columns swapped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedFeatures {
    /// The tuning.
    pub tuning: PiTuning,
    /// Of the level (m, m²).
    pub level: [f64; 6],
    /// Of the outflow (m³/s, (m³/s)²).
    pub outflow: [f64; 6],
}

/// The stretch of the run that they are of (s), both ends included.
pub const FEATURES_WINDOW_S: [f64; 2] = [50.0, 150.0];

/// The tight tuning, then the averaging one.
pub const FEATURES: [PublishedFeatures; 2] = [
    PublishedFeatures {
        tuning: PiTuning { gain: 93.7, integral_time_s: 2999.7 },
        level: [0.9935, 1.0072, 0.0137, 1.3512e-5, 1.0, 0.0037],
        outflow: [0.0081, 0.0270, 0.0188, 4.0022e-5, 0.0170, 0.0063],
    },
    PublishedFeatures {
        tuning: PiTuning { gain: 0.2, integral_time_s: 2999.7 },
        level: [0.9493, 1.1184, 0.1691, 0.0026, 1.0370, 0.0511],
        outflow: [0.0164, 0.0185, 0.0021, 3.6628e-7, 0.0175, 6.0521e-4],
    },
];
