use std::f64::consts::TAU;

use super::UltimatePoint;
use super::critical::rate_range;
use crate::linear::{Complex, LinearError, TransferFunction};
use crate::numeric::root;

/// Points of the grid on which a change of sign is sought.
const POINTS: i32 = 600;

/// The ultimate point of a single loop with proportional control: the first crossing of the negative real axis by `G(jω)`, within two
/// decades of its slowest and quickest parts; `None` where there is none. The gain has the sign of that of the process.
///
/// # Errors
/// [`LinearError::NoConvergence`] as [`TransferFunction::poles`].
pub fn ultimate_point_of(process: &TransferFunction) -> Result<Option<UltimatePoint>, LinearError> {
    let Some((slowest, quickest)) = rate_range([process])? else { return Ok(None) };
    let (low, high) = (0.01 * slowest, 100.0 * quickest);
    let at = |w: f64| process.at(Complex::new(0.0, w));
    // A process with negative gain is that of the other sign with a controller of the other sign.
    let sign = process.rest_gain().signum();
    let side = |w: f64| sign * at(w).im;
    let frequency = |k: i32| low * (high / low).powf(f64::from(k) / f64::from(POINTS));
    for k in 1..=POINTS {
        let (before, after) = (frequency(k - 1), frequency(k));
        let (at_before, at_after) = (side(before), side(after));
        if at_before < 0.0 && at_after >= 0.0 {
            let found = root(side, (before, at_before), (after, at_after));
            let value = sign * at(found).re;
            if value < 0.0 {
                return Ok(Some(UltimatePoint { gain: -sign / value, period: TAU / found }));
            }
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn a_triple_lag_oscillates_at_a_gain_of_eight() {
        for gain in [2.0, -2.0] {
            let point = ultimate_point_of(&TransferFunction::lags(gain, &[1.0; 3], 0.0).unwrap()).unwrap().unwrap();
            assert_relative_eq!(point.gain, 8.0 / gain, max_relative = 1e-9);
            assert_relative_eq!(point.period, TAU / 3.0_f64.sqrt(), max_relative = 1e-9);
        }
        assert_eq!(ultimate_point_of(&TransferFunction::lags(2.0, &[1.0], 0.0).unwrap()), Ok(None));
        assert_eq!(ultimate_point_of(&TransferFunction::lags(2.0, &[], 0.0).unwrap()), Ok(None));
    }

    #[test]
    fn an_integrator_with_two_lags_and_one_with_dead_time() {
        // K'/(s (T1 s + 1)(T2 s + 1)) crosses at ω² = 1/(T1 T2) with Ku = (T1 + T2)/(K' T1 T2).
        let integrator = TransferFunction::new(vec![0.02], vec![0.0, 1.0], 0.0).unwrap();
        let lagged = integrator.times(&TransferFunction::lags(1.0, &[5.0, 0.5], 0.0).unwrap());
        let point = ultimate_point_of(&lagged).unwrap().unwrap();
        assert_relative_eq!(point.period, TAU * 2.5_f64.sqrt(), max_relative = 1e-9);
        assert_relative_eq!(point.gain, 5.5 / (0.02 * 2.5), max_relative = 1e-9);
        let delayed = integrator.times(&TransferFunction::lags(1.0, &[], 3.0).unwrap());
        let point = ultimate_point_of(&delayed).unwrap().unwrap();
        assert_relative_eq!(point.period, 12.0, max_relative = 1e-9);
    }
}
