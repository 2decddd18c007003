use crate::study::Quantity;

use super::Results;

pub const QUANTITIES: &[Quantity<Results>] = &[];
