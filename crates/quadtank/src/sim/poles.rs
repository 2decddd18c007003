use serde::Serialize;

use crate::control::DecentralisedPi;
use crate::linear::{Complex, LinearError, eigenvalues};
use crate::plant::Jacobian;

use super::open_loop::OpenLoop;

/// `1 − |z|` below which a pole counts as on the unit circle. A slow but stable pole at this distance would take 30
/// years at one sample per second; rounding moves a simple pole at z = 1 by less than 1e-12.
pub const UNIT_CIRCLE_TOLERANCE: f64 = 1e-9;

/// Whether the sampled linear closed loop is stable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Stability {
    /// Every pole is inside the unit circle.
    Stable,
    /// A pole is on the unit circle, to rounding.
    Marginal,
    /// A pole is outside the unit circle.
    Unstable,
}

impl Stability {
    /// The verdict on a loop with these poles (z-plane).
    pub(super) fn of(poles_z: &[Complex]) -> Self {
        let radius = spectral_radius(poles_z);
        if radius > 1.0 + UNIT_CIRCLE_TOLERANCE {
            Self::Unstable
        } else if radius < 1.0 - UNIT_CIRCLE_TOLERANCE {
            Self::Stable
        } else {
            Self::Marginal
        }
    }

    /// How far the poles (z-plane) stay inside the circle of a stable loop; positive for one that is stable.
    pub(super) fn slack(poles_z: &[Complex]) -> f64 {
        1.0 - UNIT_CIRCLE_TOLERANCE - spectral_radius(poles_z)
    }
}

fn spectral_radius(poles_z: &[Complex]) -> f64 {
    poles_z.iter().map(|z| z.norm()).fold(0.0, f64::max)
}

/// The poles of the sampled linear closed loop.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedLoop {
    /// Poles of the sampled loop (z-plane), by falling modulus.
    pub poles_z: Vec<Complex>,
    /// The same mapped to the s-plane, `s = ln(z)/Ts` (1/s); a pole at z = 0 has no image and is left
    /// out, one at z = 1 to rounding is at 0.
    pub poles_s: Vec<Complex>,
    /// The verdict.
    pub stability: Stability,
    /// Peak Ms of the largest singular value of the sensitivity at the outputs, over all frequencies up to Nyquist;
    /// `None` when the loop is not stable. 1.2 to 2 is usual for a loop that keeps its distance from instability.
    pub sensitivity_peak: Option<f64>,
}

impl ClosedLoop {
    /// The pole that decides how fast the loop forgets or grows: the one with the largest real part (1/s).
    pub fn slowest(&self) -> Option<Complex> {
        self.poles_s.iter().copied().max_by(|x, y| x.re.total_cmp(&y.re))
    }
}

/// Poles, verdict and sensitivity peak of the sampled linear loop: the plant of `jacobian` under zero-order hold with
/// the two PI laws, both in automatic mode and away from their limits.
///
/// One state per tank that is not quasi-steady and one per loop. A loop with gain 0 does not act and its integral is left out.
/// `power_gain` is that of the power module.
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry of the closed-loop matrix is not finite.
pub fn closed_loop(
    jacobian: &Jacobian,
    controller: &DecentralisedPi,
    power_gain: f64,
) -> Result<ClosedLoop, LinearError> {
    let open = OpenLoop::new(jacobian, controller, power_gain);
    let mut poles_z = eigenvalues(&open.closed(jacobian.quasi_steady))?;
    poles_z.sort_by(|x, y| y.norm().total_cmp(&x.norm()).then(y.im.total_cmp(&x.im)));
    let stability = Stability::of(&poles_z);
    let images = poles_z.iter().filter(|&&z| z != Complex::ZERO);
    // What rounding leaves of a pole at z = 1 would be told as a growth or a decay.
    let is_one = |z: &Complex| (z - Complex::ONE).norm() < UNIT_CIRCLE_TOLERANCE;
    let image = |z: &Complex| if is_one(z) { Complex::ZERO } else { z.ln() / controller.sampling_time_s };
    let poles_s: Vec<Complex> = images.map(image).collect();
    let sensitivity_peak = (stability == Stability::Stable).then(|| open.sensitivity_peak(&poles_s));
    Ok(ClosedLoop { poles_z, poles_s, stability, sensitivity_peak })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::{AntiWindup, LoopMode, Pairing, PiSettings};
    use crate::linear::{StateSpace, singular_values};
    use crate::literature::PresetId;

    fn law(pairing: Pairing, gains: [f64; 2], integral_times: [f64; 2]) -> DecentralisedPi {
        let settings = |i: usize| PiSettings {
            gain: gains[i],
            integral_time_s: integral_times[i],
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Automatic,
        };
        DecentralisedPi { pairing, loops: [settings(0), settings(1)], sampling_time_s: 1.0 }
    }

    fn jacobian(id: PresetId, valves: [f64; 2]) -> Jacobian {
        let preset = id.preset();
        let plant = preset.plant.with_valves(valves);
        plant.linearise(&plant.free_equilibrium(preset.pump_voltage))
    }

    fn closed(jacobian: &Jacobian, law: &DecentralisedPi) -> ClosedLoop {
        closed_loop(jacobian, law, 1.2).unwrap()
    }

    #[test]
    fn a_loop_around_one_tank_has_the_poles_of_its_quadratic_equation() {
        // γ = 1: two separate loops around one tank each, the upper tanks being dry.
        let jacobian = jacobian(PresetId::CocotaMinimumPhase, [1.0, 1.0]);
        let law = law(Pairing::Diagonal, [1.0, 0.0], [32.0, 32.0]);
        let (a, b) = (jacobian.a[(0, 0)], jacobian.b[(0, 0)]);
        let decay = a.exp();
        let gain = 1.2 * jacobian.c[(0, 0)] * b * (decay - 1.0) / a;
        // (z − Φ)(z − 1) + g K ((1 + r/2)(z − 1) + r) = 0 with r = Ts/Ti; the other loop does not act.
        let r = 1.0 / 32.0;
        let p = -(1.0 + decay) + gain * (1.0 + r / 2.0);
        let q = decay + gain * (r / 2.0 - 1.0);
        let expected = Complex::new(-p / 2.0, (q - p * p / 4.0).sqrt());
        let closed = closed(&jacobian, &law);
        assert_eq!(closed.poles_z.len(), 3);
        let pole = closed.poles_z.iter().find(|z| z.im > 0.0).unwrap();
        assert_relative_eq!(pole.re, expected.re, max_relative = 1e-12);
        assert_relative_eq!(pole.im, expected.im, max_relative = 1e-10);
        assert_eq!(closed.stability, Stability::Stable);
    }

    #[test]
    fn integral_action_on_a_singular_plant_is_marginal() {
        let singular = jacobian(PresetId::JohanssonMinimumPhase, [0.6, 0.4]);
        let law = law(Pairing::Diagonal, [0.1, 0.1], [100.0, 100.0]);
        let closed = closed(&singular, &law);
        assert_eq!(closed.stability, Stability::Marginal);
        assert_eq!(closed.sensitivity_peak, None);
        assert!(closed.slowest().unwrap().norm() < 1e-9);
    }

    #[test]
    fn the_wrong_pairing_is_unstable_and_the_other_is_not() {
        let jacobian = jacobian(PresetId::CocotaNonMinimumPhase, [0.43, 0.43]);
        let stability = |pairing| closed(&jacobian, &law(pairing, [1.0, 1.0], [365.0, 365.0])).stability;
        assert_eq!(stability(Pairing::Diagonal), Stability::Unstable);
        assert_eq!(stability(Pairing::Swapped), Stability::Stable);
    }

    #[test]
    fn a_law_that_is_not_a_number_is_an_error() {
        let jacobian = jacobian(PresetId::JohanssonMinimumPhase, [0.7, 0.6]);
        let law = law(Pairing::Diagonal, [f64::NAN, 1.0], [30.0, 30.0]);
        assert!(matches!(closed_loop(&jacobian, &law, 1.0), Err(LinearError::NoConvergence { .. })));
    }

    #[test]
    fn the_sensitivity_peak_is_that_of_a_fine_grid() {
        for (pairing, gains) in
            [(Pairing::Diagonal, [1.0, 1.0]), (Pairing::Diagonal, [6.0, 8.0]), (Pairing::Swapped, [0.1, -0.2])]
        {
            let jacobian = jacobian(PresetId::CocotaMinimumPhase, [0.75, 0.75]);
            let law = law(pairing, gains, [32.0, 40.0]);
            let closed = closed(&jacobian, &law);
            if closed.stability != Stability::Stable {
                continue;
            }
            let peak = closed.sensitivity_peak.unwrap();
            let (a, b, c) = jacobian.reduced();
            let plant = StateSpace::strictly_proper(a, b, c).unwrap().sampled(1.0).unwrap();
            let sensitivity = |w: f64| {
                let z = Complex::cis(w);
                let n = plant.a.nrows();
                let resolvent = (nalgebra::DMatrix::<Complex>::identity(n, n) * z - plant.a.map(Complex::from))
                    .try_inverse()
                    .unwrap();
                let g = plant.c.map(Complex::from) * resolvent * plant.b.map(Complex::from);
                let k = nalgebra::DMatrix::from_fn(2, 2, |pump, i| {
                    let PiSettings { gain, integral_time_s, .. } = law.loops[i];
                    let tustin = Complex::new(1.0, 0.0) + (z + 1.0) / (z - 1.0) / (2.0 * integral_time_s);
                    if law.pairing.pump_of(i) == pump { tustin * gain * 1.2 } else { Complex::ZERO }
                });
                let s = (nalgebra::DMatrix::<Complex>::identity(2, 2) + g * k).try_inverse().unwrap();
                singular_values(&s).unwrap()[0]
            };
            let fine = (0..=3000).map(|k| sensitivity(std::f64::consts::PI * 10_f64.powf(-f64::from(k) / 750.0)));
            let expected = fine.fold(0.0, f64::max);
            assert_relative_eq!(peak, expected, max_relative = 1e-5);
            assert!(peak >= 1.0);
        }
    }
}
