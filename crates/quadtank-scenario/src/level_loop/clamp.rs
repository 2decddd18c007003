use quadtank::sim::level::LevelController;

use crate::limits;

/// Clamps the settings of a controller to the limits of the document, which a conversion from another kind may exceed.
#[must_use]
pub fn within_limits(mut controller: LevelController) -> LevelController {
    match &mut controller {
        LevelController::Manual { .. } => {}
        LevelController::Pi { gain, integral_time_s, .. } => {
            *gain = clamped_gain(*gain);
            *integral_time_s = limits::LEVEL_TIME_S.clamp(*integral_time_s);
        }
        LevelController::Pid { proportional, integral, derivative, filter_time_s } => {
            for gain in [proportional, integral, derivative] {
                *gain = clamped_gain(*gain);
            }
            *filter_time_s = limits::LEVEL_TIME_S.clamp(*filter_time_s);
        }
        LevelController::Sampled { settings, sampling_time_s } => {
            settings.gain = clamped_gain(settings.gain);
            settings.integral_time_s = limits::LEVEL_TIME_S.clamp(settings.integral_time_s);
            *sampling_time_s = limits::LEVEL_STEP_S.clamp(*sampling_time_s);
        }
    }
    controller
}

/// A loop without a controller stays without.
fn clamped_gain(gain: f64) -> f64 {
    if gain == 0.0 { 0.0 } else { limits::with_sign_of(gain, limits::LEVEL_GAIN_MAGNITUDE).clamp(gain) }
}

#[cfg(test)]
mod tests {
    use quadtank::study::level_loop::{ControllerKind, LevelLoopSetup, PiTuning};

    use super::*;
    use crate::document::BenchDocument;
    use crate::level_loop::LevelLoopScenario;

    const KEPT: PiTuning = PiTuning { gain: 2.0, integral_time_s: 120.0 };

    #[test]
    fn whatever_kind_follows_whatever_kind_the_document_stays_valid() {
        let gains = [0.0, 1e-9, 3.0, 1e4, -1e-9, -1e4];
        let times = [1e-3, 120.0, 1e6];
        let pi = gains.into_iter().flat_map(|gain| times.map(|time| LevelController::pi(gain, time)));
        let pid = gains.into_iter().flat_map(|proportional| {
            gains.map(|integral| LevelController::Pid { proportional, integral, derivative: 0.0, filter_time_s: 1.0 })
        });
        for controller in pi.chain(pid).chain([LevelController::off()]) {
            for [first, second] in ControllerKind::ALL.into_iter().flat_map(|a| ControllerKind::ALL.map(|b| [a, b])) {
                let mut setup = LevelLoopSetup { controller: controller.clone(), ..LevelLoopSetup::default() };
                for kind in [first, second] {
                    setup.set_controller_kind(kind, KEPT);
                    setup.controller = within_limits(setup.controller);
                    let found = LevelLoopScenario::from(setup.clone()).validate();
                    assert_eq!(found, Ok(()), "{controller:?} {first:?} {second:?}");
                }
            }
        }
    }
}
