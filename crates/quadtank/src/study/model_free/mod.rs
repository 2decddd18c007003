//! The study of the model-free bench: the law of Junqueira, Neves and Angelico on a tank with still or moving valves.

mod answer;
mod claims;
mod mend;
mod quantities;
mod results;
mod setup;
mod verdict;

pub use answer::{ModelFreeAnalysis, ModelFreeAnswer, PredictedLoss, analyse_model_free, run_analysed, run_model_free};
pub use claims::{CheckedClaim, Claim, ClaimFigures, LONG_RUN_S, Standing, check_claims};
pub use mend::{ModelFreeMend, mend_model_free};
pub use results::{ModelFreeStudy, Results};
pub use setup::{ModelFreeSetup, StartSpec};
pub use verdict::{LossBy, ModelFreeVerdict};
