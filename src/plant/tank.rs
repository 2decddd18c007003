use serde::{Deserialize, Serialize};

/// Horizontal cross-section of a tank as a function of level, `A(h) = area_at_empty + area_slope h` (m²).
///
/// `area_slope` is 0 for a prismatic tank and `b tan θ` for a trapezoidal one (Cocota 2009, eq. 2.28).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CrossSection {
    /// Cross-section at level 0 (m²).
    pub area_at_empty: f64,
    /// Growth of the cross-section per metre of level (m²/m); 0 for a prismatic tank.
    pub area_slope: f64,
}

/// The hole through which a tank drains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Outlet {
    /// Geometric area `a` (m²).
    pub area: f64,
    /// Loss coefficient `k_l` by which the area is multiplied (Cocota 2009, eq. 2.32); 1 for an ideal outlet.
    pub loss_coefficient: f64,
}

/// One tank with its outlet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Tank {
    /// Cross-section as a function of level.
    pub section: CrossSection,
    /// The drain.
    pub outlet: Outlet,
    /// Height of the walls (m): water above it overflows.
    pub height: f64,
}
