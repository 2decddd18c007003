//! A run that begins at rest and in which nothing happens stays there, to rounding, whatever the gains of its loops.

use proptest::prelude::*;
use quadtank::control::LoopMode;
use quadtank::literature::DisplayUnit;
use quadtank::plant::OperatingPoint;
use quadtank::sim::Trajectory;
use quadtank::study::quadruple_tank::{OperatingPointSpec, PlantSpec, Setup, run};
use quadtank_scenario::limits;

/// Largest departure of a level from where it began, as a share of it, or of 1 µm where that is more.
fn departure(run: &Trajectory, start: &OperatingPoint) -> f64 {
    let of_tank = |(column, &level): (&Vec<f64>, &f64)| {
        column.iter().map(|h| (h - level).abs()).fold(0.0, f64::max) / level.max(1e-6)
    };
    run.levels.iter().zip(&start.levels).map(of_tank).fold(0.0, f64::max)
}

/// A setup in which nothing happens: both loops automatic, pumps within their limits, every wall well above its level.
fn resting(mut setup: Setup, shares: [f64; 2], by_levels: bool) -> Setup {
    setup.experiment = setup.experiment.without_noise();
    setup.experiment.measurement.quantised = false;
    setup.experiment.initial_levels = None;
    for settings in &mut setup.controller.loops {
        settings.mode = LoopMode::Automatic;
    }
    let mut rig = setup.plant();
    let voltage = [0, 1].map(|i| {
        let pump = rig.pumps[i];
        pump.voltage_min + shares[i] * (pump.voltage_max - pump.voltage_min)
    });
    let levels = rig.free_equilibrium(voltage).levels;
    for (tank, level) in rig.tanks.iter_mut().zip(levels) {
        tank.height = f64::max(1.5 * level, tank.height);
    }
    setup.plant = PlantSpec::Parameters { rig, display_unit: DisplayUnit::Cm };
    setup.operating_point = if by_levels {
        OperatingPointSpec::Levels([levels[0], levels[1]])
    } else {
        OperatingPointSpec::PumpVoltage(voltage)
    };
    setup
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn random_rigs_at_rest_do_not_leave_it(
        setup in crate::random::setup(0),
        shares in [0.01..0.99, 0.01..0.99],
        by_levels in any::<bool>(),
        sign in any::<bool>(),
    ) {
        let mut setup = resting(setup, shares, by_levels);
        for gain in [None, Some(1000.0)] {
            if let Some(gain) = gain {
                for settings in &mut setup.controller.loops {
                    settings.gain = if sign { gain } else { -gain };
                }
            }
            // Where the plant is singular or its levels cannot be held there is no rest, and no laboratory is that high.
            let Ok(start) = setup.operating_point() else { return Ok(()) };
            if start.levels.iter().any(|&level| level > limits::LEVEL.max) {
                return Ok(());
            }
            let left = departure(&run(&setup).unwrap().nonlinear, &start);
            // What rounding leaves of a level.
            prop_assert!(left <= 4.0 * f64::EPSILON, "{left:.1e} with gains {gain:?}");
        }
    }
}
