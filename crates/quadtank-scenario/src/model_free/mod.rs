//! The document of a run under the model-free law, version 3, and what follows from it.

mod answer;
mod claims;
mod csv;
mod document;
mod published;
mod validate;
mod verdict;

pub use answer::{ModelFreeAnalysis, ModelFreeAnswer, Moment, PredictedLoss, analyse_model_free, run_model_free};
pub use claims::{CheckedClaim, Claim, LONG_RUN_S, Standing, check_claims};
pub use document::{ModelFreeScenario, ModelFreeSetup, StartSpec};
pub use published::{PublishedExperiment, PublishedValves, published_model_free};
pub use verdict::{LossBy, ModelFreeVerdict};
