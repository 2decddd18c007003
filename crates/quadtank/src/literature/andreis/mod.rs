//! Andreis (2017): assessment and tuning of level controllers. The plant (after Garcia 2005), its operating points, disturbances and
//! controllers, and the printed variances.

mod commercial;
mod disturbances;
mod features;
mod indices;
mod rig;
mod summaries;
mod tables;

pub use commercial::{COMMERCIAL_CONTROLLERS, CommercialController};
pub use disturbances::PublishedDisturbance;
pub use features::{FEATURES, FEATURES_WINDOW_S, PublishedFeatures};
pub use indices::{
    AndreisRemark, HUNDREDTHS, INDICES, PublishedIndex, PublishedWrongIndex, WRONG_INDICES, remarks_on_equation,
    remarks_on_table,
};
pub use rig::{
    CURRENT_TUNING, NOMINAL_INFLOW, NOMINAL_LEVEL, STEP_TEST_INFLOW, UNCERTAIN_AREA, UNCERTAIN_VALVE_COEFFICIENT,
    VALVE_COEFFICIENT, plant, uncertain_plant,
};
pub use summaries::{CHANGES, PublishedChange, PublishedRanks, PublishedVerdict, RANKS, VERDICTS};
pub use tables::{PublishedMethod, PublishedModel, PublishedObjective, PublishedVariance, VARIANCES};
