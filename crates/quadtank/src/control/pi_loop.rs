//! The sampled linear loop of two PI laws: the plant under zero-order hold, as a state matrix and over frequency.

use nalgebra::{DMatrix, Matrix2, Matrix4, Matrix4x2};

use super::{DecentralisedPi, PiSettings};
use crate::linear::{ClosedLoop, Complex, LinearError, ZeroOrderHold};
use crate::plant::Jacobian;

/// Poles, verdict and sensitivity peak of the sampled linear loop: the plant of `jacobian` under zero-order hold with
/// the two PI laws by Tustin's rule (Cocota 2009, eq. 4.2), both in automatic mode and away from their limits.
///
/// One state per tank that is not quasi-steady and one per loop. A loop with gain 0 does not act and its integral is left out.
/// `power_gain` is that of the power module (V/V).
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry of the closed-loop matrix is not finite.
pub fn closed_loop(
    jacobian: &Jacobian,
    controller: &DecentralisedPi,
    power_gain: f64,
) -> Result<ClosedLoop, LinearError> {
    let pi_loop = PiLoop::new(jacobian, controller, power_gain);
    let matrix = pi_loop.state_matrix(jacobian.quasi_steady);
    ClosedLoop::new(&matrix, controller.sampling_time_s, |z| pi_loop.return_ratio(z))
}

/// The sampled plant with its laws, over frequency. Columns are by loops, not by pumps.
#[derive(Clone, Debug)]
pub struct PiLoop<'a> {
    controller: &'a DecentralisedPi,
    /// State transition of the plant over one sample.
    transition: Matrix4<f64>,
    /// What a controller output held for one sample does to the levels (m/V).
    input: Matrix4x2<f64>,
    /// Gain of the level sensors; 0 for a tank that is dry (V/m).
    sensor: [f64; 2],
}

impl<'a> PiLoop<'a> {
    /// The loop that [`closed_loop`] judges.
    pub fn new(jacobian: &Jacobian, controller: &'a DecentralisedPi, power_gain: f64) -> Self {
        let hold = ZeroOrderHold::new(&jacobian.a, controller.sampling_time_s);
        let by_pump = hold.response * jacobian.b * power_gain;
        let input = Matrix4x2::from_fn(|tank, i| by_pump[(tank, controller.pairing.pump_of(i))]);
        let sensor = [jacobian.c[(0, 0)], jacobian.c[(1, 1)]];
        Self { controller, transition: hold.transition, input, sensor }
    }

    /// State matrix of the closed loop without the tanks that are `quasi_steady`. States are levels (m), then one integral per
    /// loop that acts, `s = I − K Ts/(2 Ti) e` (V), with which Tustin's rule reads `c = K (1 + Ts/(2 Ti)) e + s` and
    /// `s⁺ = s + K Ts/Ti e`.
    fn state_matrix(&self, quasi_steady: [bool; 4]) -> DMatrix<f64> {
        let wet: Vec<usize> = (0..4).filter(|&tank| !quasi_steady[tank]).collect();
        let acting: Vec<usize> = (0..2).filter(|&i| self.controller.loops[i].gain != 0.0).collect();
        let n = wet.len();
        let share = |i: usize| self.controller.sampling_time_s / self.controller.loops[i].integral_time_s;
        let gain = |i: usize| self.controller.loops[i].gain * self.sensor[i];
        DMatrix::from_fn(n + acting.len(), n + acting.len(), |row, column| match (wet.get(row), wet.get(column)) {
            (Some(&to), Some(&from)) => {
                let feedback =
                    if from < 2 { gain(from) * (1.0 + share(from) / 2.0) * self.input[(to, from)] } else { 0.0 };
                self.transition[(to, from)] - feedback
            }
            (Some(&to), None) => self.input[(to, acting[column - n])],
            (None, Some(&from)) if from == acting[row - n] => -gain(from) * share(from),
            (None, None) if row == column => 1.0,
            (None, _) => 0.0,
        })
    }

    /// L at a frequency (rad/s) up to Nyquist, on the unit circle.
    pub fn at(&self, frequency: f64) -> Matrix2<Complex> {
        self.return_ratio(Complex::cis(frequency * self.controller.sampling_time_s))
    }

    /// `L(z) = G(z) K(z)`, cut open at the measured signals. Only the tank above stands between an input and a lower tank.
    fn return_ratio(&self, z: Complex) -> Matrix2<Complex> {
        let settings = &self.controller.loops;
        let law = settings.map(|settings| tustin_pi(&settings, self.controller.sampling_time_s, z));
        Matrix2::from_fn(|lower, input| {
            let upper = lower + 2;
            let above = self.input[(upper, input)] / (z - self.transition[(upper, upper)]);
            let flow = above * self.transition[(lower, upper)] + self.input[(lower, input)];
            flow * self.sensor[lower] / (z - self.transition[(lower, lower)]) * law[input]
        })
    }
}

/// `K (1 + Ts/(2 Ti) (z + 1)/(z − 1))` (Cocota 2009, eq. 4.2).
fn tustin_pi(settings: &PiSettings, sampling_time_s: f64, z: Complex) -> Complex {
    let integral = sampling_time_s / (2.0 * settings.integral_time_s);
    ((z + 1.0) / (z - 1.0) * integral + 1.0) * settings.gain
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::{AntiWindup, LoopMode, Pairing, PiSettings};
    use crate::linear::{Stability, StateSpace, singular_values};
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
            let peak = closed.sensitivity_peak.unwrap().value;
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
