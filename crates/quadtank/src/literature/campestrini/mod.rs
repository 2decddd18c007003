//! Campestrini (2006): relay tuning of plants with two loops. Two plants, the cases of its tables, the numbers it prints for them,
//! and the record of a solvents column.

mod cases;
mod plants;
mod printed;
mod usol;

pub use cases::{PublishedCase, PublishedPlacement, RULES};
pub use plants::{PublishedPlant, wood_berry_full_controller};
pub use printed::{PrintedNumber, PrintedRemark};
pub use usol::{USOL, UsolRecord};
