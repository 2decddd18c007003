use crate::tuning::{ModelRule, ProcessModel, TuningError, TuningRule, UltimatePoint};

use super::{LevelLoopSetup, PiTuning};

/// A rule that suggests a tuning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SuggestedRule {
    /// One on the process model.
    Model(ModelRule),
    /// One on the ultimate point.
    Ultimate(TuningRule),
}

/// What a rule suggests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suggestion {
    /// The rule.
    pub rule: SuggestedRule,
    /// Its PI settings, or why it has none.
    pub settings: Result<PiTuning, TuningError>,
}

impl Suggestion {
    /// The settings moved into the box of the search, and whether they had to be.
    pub fn clipped(&self, setup: &LevelLoopSetup) -> Option<(PiTuning, bool)> {
        let settings = self.settings.ok()?;
        let clipped = setup.search.clip(settings);
        Some((clipped, clipped != settings))
    }
}

/// The suggestions of all rules, by a process model and an ultimate point, as far as they are known.
pub fn suggest(
    setup: &LevelLoopSetup,
    model: Option<&ProcessModel>,
    ultimate: Option<UltimatePoint>,
) -> Vec<Suggestion> {
    let closed_loop_time_s = setup.closed_loop_time_s;
    let by_model = [ModelRule::Simc { closed_loop_time_s }, ModelRule::Lambda { closed_loop_time_s }, ModelRule::Amigo];
    let by_point = [TuningRule::ZieglerNicholsPi, TuningRule::TyreusLuybenPi];
    let tuning = |gain: f64, integral_time_s: f64| PiTuning { gain, integral_time_s };
    let models = model.into_iter().flat_map(|model| {
        by_model.map(|rule| Suggestion {
            rule: SuggestedRule::Model(rule),
            settings: rule.settings(model).map(|isa| tuning(isa.gain, isa.integral_time)),
        })
    });
    let points = ultimate.into_iter().flat_map(|point| {
        by_point.map(|rule| {
            let isa = rule.settings(point);
            Suggestion { rule: SuggestedRule::Ultimate(rule), settings: Ok(tuning(isa.gain, isa.integral_time)) }
        })
    });
    models.chain(points).collect()
}
