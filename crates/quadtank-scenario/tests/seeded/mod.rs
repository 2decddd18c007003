//! A noisy run whose figures must be the same wherever it is computed.

use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::{run, setup_of};

/// Total variation of the first controller output of the default experiment with noise of 0.1 mm from seed 2000 (V), as
/// computed on x86-64. Other noise gives other digits from the second on.
pub const TOTAL_VARIATION: f64 = 55.799_134_384_238_58;

/// The same, computed here.
pub fn total_variation() -> f64 {
    let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
    setup.experiment.measurement.noise_std = 1e-4;
    setup.experiment.measurement.seed = 2000;
    run(&setup).expect("the published experiment runs").metrics[0].total_variation
}

/// Rounding of 3000 samples, and no more.
pub const TOLERANCE: f64 = 1e-9;
