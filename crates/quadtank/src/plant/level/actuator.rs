use serde::{Deserialize, Serialize};

use super::LevelError;
use super::error::within;

/// Travel of a valve over the pressure of its actuator, linear between points and constant beyond the ends.
///
/// A curve that falls belongs to a valve that air closes, such as Table B.1 of Andreis (2017).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct ActuatorCurve(
    /// Pairs of pressure and travel (0 to 1), by rising pressure.
    pub Vec<[f64; 2]>,
);

impl ActuatorCurve {
    /// Travel at a pressure.
    pub fn travel(&self, pressure: f64) -> f64 {
        match self.segment(pressure) {
            Some(([p, x], [q, y])) => x + (y - x) / (q - p) * (pressure - p),
            None if pressure < self.0.first().map_or(0.0, |point| point[0]) => {
                self.0.first().map_or(0.0, |point| point[1])
            }
            None => self.0.last().map_or(0.0, |point| point[1]),
        }
    }

    /// dX/dp at a pressure, of the segment above it at a point of the curve; 0 beyond the ends.
    pub fn slope(&self, pressure: f64) -> f64 {
        self.segment(pressure).map_or(0.0, |([p, x], [q, y])| (y - x) / (q - p))
    }

    /// Pressure for a travel by the inverse of the active segment (Andreis 2017, Eq. 86); `None` for a travel that the curve
    /// does not reach. Where the curve is flat the lowest pressure is meant.
    pub fn pressure(&self, travel: f64) -> Option<f64> {
        self.0.windows(2).find_map(|pair| {
            let ([p, x], [q, y]) = (pair[0], pair[1]);
            let inside = travel >= x.min(y) && travel <= x.max(y);
            inside.then(|| if x == y { p } else { p + (travel - x) * (q - p) / (y - x) })
        })
    }

    /// The ends of the segment that a pressure is in.
    fn segment(&self, pressure: f64) -> Option<([f64; 2], [f64; 2])> {
        self.0.windows(2).find(|pair| pressure >= pair[0][0] && pressure < pair[1][0]).map(|pair| (pair[0], pair[1]))
    }

    fn check(&self) -> Result<(), LevelError> {
        let points = &self.0;
        let rises = points.first().map_or(0.0, |first| points[points.len() - 1][1] - first[1]);
        for (index, point) in points.iter().enumerate() {
            within("travel", point[1], 0.0, 1.0)?;
            within("pressure", point[0], -f64::MAX, f64::MAX)?;
            let fits = index == 0 || {
                let before = points[index - 1];
                point[0] > before[0] && (point[1] - before[1]) * rises >= 0.0
            };
            if !fits {
                return Err(LevelError::ActuatorCurve { index });
            }
        }
        if points.len() < 2 || rises == 0.0 { Err(LevelError::ActuatorCurve { index: points.len() }) } else { Ok(()) }
    }
}

/// A pneumatic actuator: a lag, then its static curve (Andreis 2017, Eqs. 79, 80 and Table B.1).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Actuator {
    /// Time constant of the pressure (s); 0 for an actuator that follows at once.
    pub lag_s: f64,
    /// Travel over pressure.
    pub curve: ActuatorCurve,
}

impl Actuator {
    pub(super) fn check(&self) -> Result<(), LevelError> {
        within("lag_s", self.lag_s, 0.0, f64::MAX)?;
        self.curve.check()
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Andreis (2017), Table B.1.
    fn table() -> ActuatorCurve {
        ActuatorCurve(vec![[3.0, 1.0], [6.0, 0.8], [9.0, 0.5], [12.0, 0.2], [15.0, 0.0]])
    }

    #[test]
    fn the_curve_is_linear_between_its_points_and_constant_beyond() {
        let travels = [2.0, 3.0, 4.5, 6.0, 7.5, 13.5, 15.0, 20.0].map(|pressure| table().travel(pressure));
        for (found, expected) in travels.into_iter().zip([1.0, 1.0, 0.9, 0.8, 0.65, 0.1, 0.0, 0.0]) {
            assert_relative_eq!(found, expected, epsilon = 1e-14);
        }
        assert_eq!([2.0, 16.0].map(|pressure| table().slope(pressure)), [0.0, 0.0]);
        assert_relative_eq!(table().slope(6.0), -0.1, max_relative = 1e-14);
    }

    #[test]
    fn pressure_inverts_travel_and_says_what_it_cannot_reach() {
        for travel in [0.0, 0.1, 0.2, 0.35, 0.8, 0.95, 1.0] {
            assert_relative_eq!(table().travel(table().pressure(travel).unwrap()), travel, epsilon = 1e-14);
        }
        assert_eq!((table().pressure(1.1), table().pressure(-0.1)), (None, None));
    }

    #[test]
    fn curves_that_turn_back_are_refused_where_they_do() {
        let actuator = |points: &[[f64; 2]]| Actuator { lag_s: 0.0, curve: ActuatorCurve(points.to_vec()) }.check();
        assert_eq!(actuator(&[[3.0, 0.0], [15.0, 1.0]]), Ok(()));
        assert_eq!(
            actuator(&[[3.0, 1.0], [6.0, 0.5], [9.0, 0.6], [15.0, 0.0]]),
            Err(LevelError::ActuatorCurve { index: 2 })
        );
        assert_eq!(actuator(&[[3.0, 1.0], [3.0, 0.0]]), Err(LevelError::ActuatorCurve { index: 1 }));
        assert_eq!(actuator(&[]), Err(LevelError::ActuatorCurve { index: 0 }));
        assert_eq!(actuator(&[[3.0, 0.5], [15.0, 0.5]]), Err(LevelError::ActuatorCurve { index: 2 }));
        assert!(matches!(
            actuator(&[[3.0, f64::NAN], [15.0, 1.0]]),
            Err(LevelError::OutOfRange { field: "travel", .. })
        ));
    }
}
