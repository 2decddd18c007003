use quadtank::study::level_loop::{LevelLoopSetup, PiTuning, SuggestedRule, Suggestion};
use quadtank::tuning::{ModelRule, TuningError, TuningRule};
use serde::Serialize;

use super::finite;
use crate::report::Answer;

/// What a rule suggests.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SuggestionReport {
    /// The rule.
    pub rule: RuleName,
    /// Its settings, or why it has none.
    pub settings: Answer<PiReport, TuningError>,
    /// The settings moved into the box of the search; null where there are none.
    pub within_search: Option<PiReport>,
    /// Whether they had to be moved; null likewise.
    pub clipped: Option<bool>,
}

/// The name of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum RuleName {
    /// SIMC, on the model.
    Simc,
    /// Lambda tuning, on the model.
    Lambda,
    /// AMIGO, on the model.
    Amigo,
    /// Ziegler and Nichols, P, on the ultimate point.
    ZieglerNicholsP,
    /// Ziegler and Nichols, PI, on the ultimate point.
    ZieglerNicholsPi,
    /// Ziegler and Nichols, PI, in the variant of 1942, on the ultimate point.
    #[serde(rename = "ziegler-nichols-1942-pi")]
    ZieglerNichols1942Pi,
    /// Ziegler and Nichols, PID, on the ultimate point.
    ZieglerNicholsPid,
    /// Tyreus and Luyben, PI, on the ultimate point.
    TyreusLuybenPi,
    /// Tyreus and Luyben, PID, on the ultimate point.
    TyreusLuybenPid,
}

/// Settings of a PI controller; null is what is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PiReport {
    /// Gain Kp (signal per signal).
    pub gain: Option<f64>,
    /// Integral time Ti (s).
    pub integral_time_s: Option<f64>,
}

impl SuggestionReport {
    pub(super) fn all(setup: &LevelLoopSetup, suggestions: &[Suggestion]) -> Vec<Self> {
        let report = |suggestion: &Suggestion| {
            let clipped = suggestion.clipped(setup);
            Self {
                rule: suggestion.rule.into(),
                settings: Answer::of(&suggestion.settings, |settings| PiReport::from(*settings)),
                within_search: clipped.map(|(settings, _)| settings.into()),
                clipped: clipped.map(|(_, clipped)| clipped),
            }
        };
        suggestions.iter().map(report).collect()
    }
}

impl From<SuggestedRule> for RuleName {
    fn from(rule: SuggestedRule) -> Self {
        match rule {
            SuggestedRule::Model(ModelRule::Simc { .. }) => Self::Simc,
            SuggestedRule::Model(ModelRule::Lambda { .. }) => Self::Lambda,
            SuggestedRule::Model(ModelRule::Amigo) => Self::Amigo,
            SuggestedRule::Ultimate(TuningRule::ZieglerNicholsP) => Self::ZieglerNicholsP,
            SuggestedRule::Ultimate(TuningRule::ZieglerNicholsPi) => Self::ZieglerNicholsPi,
            SuggestedRule::Ultimate(TuningRule::ZieglerNichols1942Pi) => Self::ZieglerNichols1942Pi,
            SuggestedRule::Ultimate(TuningRule::ZieglerNicholsPid) => Self::ZieglerNicholsPid,
            SuggestedRule::Ultimate(TuningRule::TyreusLuybenPi) => Self::TyreusLuybenPi,
            SuggestedRule::Ultimate(TuningRule::TyreusLuybenPid) => Self::TyreusLuybenPid,
        }
    }
}

impl From<PiTuning> for PiReport {
    fn from(tuning: PiTuning) -> Self {
        Self { gain: finite(tuning.gain), integral_time_s: finite(tuning.integral_time_s) }
    }
}
