use serde::{Deserialize, Serialize};

use crate::numeric::larger;

/// Horizontal cross-section of a tank as a function of level, `A(h) = area_at_empty + area_slope h` (m²).
///
/// `area_slope` is 0 for a prismatic tank and `b tan θ` for a trapezoidal one (Cocota 2009, eq. 2.28).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CrossSection {
    /// Cross-section at level 0 (m²).
    pub area_at_empty: f64,
    /// Growth of the cross-section per metre of level (m²/m); 0 for a prismatic tank.
    pub area_slope: f64,
}

impl CrossSection {
    /// The same cross-section `area` (m²) at every level.
    pub const fn prismatic(area: f64) -> Self {
        Self { area_at_empty: area, area_slope: 0.0 }
    }

    /// A tank of breadth `b` (m) whose bottom has the length `c` (m) and one of whose end walls leans outwards by the
    /// angle `θ` (rad) from the vertical: `A(h) = b (c + h tan θ)` (Cocota 2009, eq. 2.28).
    pub fn trapezoidal(breadth: f64, bottom_length: f64, wall_angle_rad: f64) -> Self {
        let (sine, cosine) = wall_angle_rad.sin_cos();
        Self { area_at_empty: breadth * bottom_length, area_slope: breadth * sine / cosine }
    }

    /// Area of the water surface at `level` (m²); below the bottom the tank goes on as it is at the bottom.
    #[inline]
    pub fn area(&self, level: f64) -> f64 {
        self.area_at_empty + self.area_slope * larger(level, 0.0)
    }

    /// Water held up to `level` (m³), the integral of [`area`](Self::area).
    pub fn volume(&self, level: f64) -> f64 {
        let level = larger(level, 0.0);
        level * (self.area_at_empty + 0.5 * self.area_slope * level)
    }
}

/// The hole through which a tank drains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Outlet {
    /// Geometric area `a` (m²).
    pub area: f64,
    /// Loss coefficient `k_l` by which the area is multiplied (Cocota 2009, eq. 2.32); 1 for an ideal outlet.
    pub loss_coefficient: f64,
}

impl Outlet {
    /// `k_l a` (m²), the area that stands in Torricelli's law (Cocota 2009, eqs. 2.32, 2.33).
    #[inline]
    pub fn effective_area(&self) -> f64 {
        self.loss_coefficient * self.area
    }
}

/// One tank with its outlet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Tank {
    /// Cross-section as a function of level.
    pub section: CrossSection,
    /// The drain.
    pub outlet: Outlet,
    /// Height of the walls (m): water above it overflows.
    pub height: f64,
}

impl Tank {
    /// Flow through the outlet at `level` (m³/s), `k_l a √(2 g h)` (Cocota 2009, eqs. 2.26, 2.32); 0 at or below the
    /// bottom.
    #[inline]
    pub fn outflow(&self, level: f64, gravity: f64) -> f64 {
        self.outlet.effective_area() * torricelli_speed(level, gravity)
    }

    /// Change of [`outflow`](Self::outflow) with level (m²/s), `k_l a √(g/(2h))`; infinite at the bottom.
    pub fn outflow_slope(&self, level: f64, gravity: f64) -> f64 {
        self.outlet.effective_area() * (gravity / (2.0 * level.max(0.0))).sqrt()
    }

    /// Level at which the outlet carries `flow` (m), `(q/(k_l a))²/(2 g)`, the inverse of [`outflow`](Self::outflow);
    /// 0 without flow, infinite for a plugged outlet. Walls are ignored.
    pub fn level_for_outflow(&self, flow: f64, gravity: f64) -> f64 {
        if flow > 0.0 { (flow / self.outlet.effective_area()).powi(2) / (2.0 * gravity) } else { 0.0 }
    }
}

/// Speed of water that leaves a hole under `level` (m/s), `√(2 g h)` (Torricelli; Cocota 2009, eq. 2.22).
#[inline]
pub(super) fn torricelli_speed(level: f64, gravity: f64) -> f64 {
    (2.0 * gravity * level.max(0.0)).sqrt()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// The trapezoidal test tank of Cocota (2009, ch. 2).
    fn trapezoid() -> CrossSection {
        CrossSection::trapezoidal(0.078, 0.076, 23.5_f64.to_radians())
    }

    #[test]
    fn trapezoid_area_and_volume_follow_eq_2_28() {
        let (b, c, h, tan) = (0.078, 0.076, 0.389, 23.5_f64.to_radians().tan());
        assert_relative_eq!(trapezoid().area(h), b * (c + h * tan), max_relative = 1e-15);
        assert_relative_eq!(trapezoid().volume(h), b * c * h + b * h * h * tan / 2.0, max_relative = 1e-15);
        // "About 4.8 l" for a tank of the height of the rectangular one.
        assert!((trapezoid().volume(h) - 4.8e-3).abs() < 0.1e-3);
    }

    #[test]
    fn below_the_bottom_the_section_is_that_of_the_bottom() {
        assert_eq!(trapezoid().area(-0.1), trapezoid().area(0.0));
        assert_eq!(trapezoid().volume(-0.1), 0.0);
    }

    #[test]
    fn volume_is_the_integral_of_area() {
        let (section, h, dh) = (trapezoid(), 0.2, 1e-5);
        let slope = (section.volume(h + dh) - section.volume(h - dh)) / (2.0 * dh);
        assert_relative_eq!(slope, section.area(h), max_relative = 1e-9);
    }

    #[test]
    fn nothing_flows_from_an_empty_tank() {
        let outlet = Outlet { area: 37.4e-6, loss_coefficient: 0.68 };
        let tank = Tank { section: trapezoid(), outlet, height: 0.395 };
        assert_eq!(tank.outflow(0.0, 9.81), 0.0);
        assert_eq!(tank.outflow(-0.1, 9.81), 0.0);
        assert_eq!(tank.level_for_outflow(0.0, 9.81), 0.0);
        assert_eq!(tank.level_for_outflow(-1e-6, 9.81), 0.0);
        assert_eq!(tank.outflow_slope(0.0, 9.81), f64::INFINITY);
    }

    #[test]
    fn a_plugged_tank_has_no_finite_level_under_inflow() {
        let outlet = Outlet { area: 0.0, loss_coefficient: 1.0 };
        let tank = Tank { section: CrossSection::prismatic(1e-2), outlet, height: 0.2 };
        assert_eq!(tank.level_for_outflow(0.0, 9.81), 0.0);
        assert_eq!(tank.level_for_outflow(1e-6, 9.81), f64::INFINITY);
    }
}
