//! The study of the level-loop bench: test, model, rules, run, indices, trade-off and the map of a cost.

mod answer;
mod choices;
mod contour;
mod controller_kind;
mod element;
mod findings;
mod heated;
mod mends;
mod proportional_test;
mod published;
mod quantities;
mod results;
mod search;
mod setup;
mod step_test;
mod suggestions;
mod summaries;
mod trade_off;

pub use crate::tuning::PiTuning;
pub use answer::{LevelLoopAnswer, LevelLoopError, run_level_loop};
pub use choices::{OwnDisturbance, PublishedTuning};
pub use contour::{ContourMap, ContourSettings};
pub use controller_kind::ControllerKind;
pub use element::{Element, ElementCurve};
pub use findings::Finding;
pub use heated::{HEATED_STEPS_S, HeatedAnswer, heated_tank};
pub use mends::{Mend, mend_loop, mend_run, mend_start};
pub use proportional_test::run_proportional_test;
pub use published::{
    COMPARED_TABLES, Compared, ComparedFeatures, ComparedQuantity, ComparedTable, compare_features, compare_table,
    published_setup,
};
pub use results::{LevelLoopStudy, PlantAnswer, Results};
pub use search::{LevelSearch, SearchMethod};
pub use setup::{Harris, LevelLoopSetup, LevelPlantSpec, ModelError, ModelSource, Objective, SearchSpec, StepTestSpec};
pub use step_test::{ModelMatch, StepTestAnswer, StepTestError, run_step_test};
pub use suggestions::{SuggestedRule, Suggestion, suggest};
pub use summaries::{ComparedSummary, SUMMARY_TABLES, SummaryEntry, SummaryRow, compare_summary};
pub use trade_off::{TradeOff, TradeOffPoint, trade_off};
