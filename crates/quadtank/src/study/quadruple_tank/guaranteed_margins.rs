use serde::Serialize;

/// What a stable loop tolerates in each of its two measured signals, at once and independently, as its sensitivity peak
/// Ms guarantees: `Ms/(Ms + 1) < gain < Ms/(Ms − 1)`, or a phase lag up to `2 asin(1/(2 Ms))` (Skogestad and
/// Postlethwaite 2005, "Maximum peak criteria", for one loop; for two, Ms is the peak of the largest singular value of S).
///
/// A loop may well tolerate more. Ms = 2 gives 0.67 to 2 and 29°.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GuaranteedMargins {
    /// Smallest factor on the gain.
    pub gain_min: f64,
    /// Largest factor on the gain; `None` when any factor is tolerated.
    pub gain_max: Option<f64>,
    /// Largest phase lag (rad).
    pub phase_rad: f64,
}

impl GuaranteedMargins {
    /// The margins that a sensitivity peak guarantees.
    pub fn of(sensitivity_peak: f64) -> Self {
        let ms = sensitivity_peak;
        Self {
            gain_min: ms / (ms + 1.0),
            gain_max: (ms > 1.0).then(|| ms / (ms - 1.0)),
            phase_rad: 2.0 * (0.5 / ms).min(1.0).asin(),
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn a_peak_of_two_gives_the_textbook_margins() {
        let margins = GuaranteedMargins::of(2.0);
        assert_relative_eq!(margins.gain_min, 2.0 / 3.0);
        assert_eq!(margins.gain_max, Some(2.0));
        // 28.955°, from 2 asin(1/4).
        assert_relative_eq!(margins.phase_rad.to_degrees(), 28.955, epsilon = 1e-3);
    }

    #[test]
    fn without_a_peak_any_higher_gain_is_tolerated() {
        let margins = GuaranteedMargins::of(1.0);
        assert_eq!(margins.gain_max, None);
        assert_relative_eq!(margins.phase_rad, std::f64::consts::FRAC_PI_3);
        assert!(GuaranteedMargins::of(0.1).phase_rad.is_finite());
    }
}
