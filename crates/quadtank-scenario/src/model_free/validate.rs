use crate::limits::{self, Limits};
use crate::{ScenarioError, validate};

use quadtank::study::model_free::ModelFreeSetup;

/// Checks what has to hold between the numbers of the setup at a path.
pub fn setup(setup: &ModelFreeSetup, at: &str) -> Result<(), ScenarioError> {
    validate::plant(&setup.plant, &format!("{at}.plant"))?;
    // What the law knows of its loop has no dead time.
    validate::each(&setup.plant.rig().pumps, &format!("{at}.plant.parameters.rig.pumps"), |pump, at| {
        Limits::new(0.0, 0.0).check(&format!("{at}.delay_s"), pump.delay_s)
    })?;
    validate::each(&setup.valves, &format!("{at}.valves"), validate::valve)?;
    validate::law(&setup.controller, &format!("{at}.controller"))?;
    let sampling_time_s = setup.controller.sampling_time_s;
    if let Some(compare) = &setup.compare {
        validate::pi_loops(compare, &format!("{at}.compare"))?;
        // Its samples are no more than those of the law.
        let limits = Limits { min: sampling_time_s.min(1.0), ..limits::SAMPLING_TIME_S };
        limits.check(&format!("{at}.compare.sampling_time_s"), compare.sampling_time_s)?;
    }
    validate::initial_levels(&setup.experiment, &setup.plant, at)?;
    validate::duration(&setup.experiment, sampling_time_s, at)?;
    let frequency = limits::valve_frequency(setup.experiment.duration_s);
    validate::each(&setup.valves, &format!("{at}.valves"), |valve, at| {
        frequency.check(&format!("{at}.sine.frequency"), valve.angular_frequency())
    })
}
