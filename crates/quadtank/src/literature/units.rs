//! The units in which the sources print lengths, areas and volumes, in SI.

pub const CM: f64 = 1e-2;
pub const CM2: f64 = 1e-4;
pub const CM3: f64 = 1e-6;
pub const MM: f64 = 1e-3;
pub const MM2: f64 = 1e-6;
pub const MM3: f64 = 1e-9;
