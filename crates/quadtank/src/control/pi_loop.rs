//! The sampled linear loop of two PI laws: the plant under zero-order hold, as a state matrix and over frequency.

use nalgebra::{DMatrix, Matrix2, Matrix4, Matrix4x2};

use super::{DecentralisedPi, PiSettings};
use crate::linear::{Arithmetic, ClosedLoop, Complex, DelayedLoop, LinearError, ZeroOrderHold};
use crate::plant::Jacobian;

/// Poles, verdict and sensitivity peak of the sampled linear loop: the plant of `jacobian` under zero-order hold with
/// the two PI laws by Tustin's rule (Cocota 2009, eq. 4.2), both in automatic mode and away from their limits.
///
/// One state per tank that is not quasi-steady and one per loop. A loop with gain 0 does not act and its integral is left out.
/// `power_gain` is that of the power module (V/V). Hoses that delay the inputs are met exactly, also where a delay is no whole number of
/// samples; such a loop has no list of poles.
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry of the closed-loop matrix is not finite; [`LinearError::OutOfRange`] where a delay turns
/// the loop too often to be followed.
pub fn closed_loop(
    jacobian: &Jacobian,
    controller: &DecentralisedPi,
    power_gain: f64,
) -> Result<ClosedLoop, LinearError> {
    let pi_loop = PiLoop::new(jacobian, controller, power_gain);
    let delay_s = jacobian.input_delay_s[0].max(jacobian.input_delay_s[1]);
    if delay_s > 0.0 {
        let slowest = pi_loop.slowest_rate(jacobian);
        let scales = (controller.sampling_time_s, slowest, delay_s);
        return ClosedLoop::with_dead_time(&pi_loop, |z| pi_loop.return_ratio(z), scales);
    }
    let matrix = pi_loop.state_matrix(jacobian.quasi_steady);
    ClosedLoop::new(&matrix, controller.sampling_time_s, |z| pi_loop.return_ratio(z))
}

/// The sampled plant with its laws, over frequency. Columns are by loops, not by pumps.
#[derive(Clone, Debug)]
pub struct PiLoop<'a> {
    controller: &'a DecentralisedPi,
    /// State transition of the plant over one sample.
    transition: Matrix4<f64>,
    /// What a controller output held for one sample does to the levels within the sample in which it arrives (m/V).
    input: Matrix4x2<f64>,
    /// What it does within the next one, where it arrives between two samples (m/V).
    late: Matrix4x2<f64>,
    /// Whole samples until it arrives.
    delay: [i32; 2],
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
        let (late, delay) = (Matrix4x2::zeros(), [0; 2]);
        let mut pi_loop = Self { controller, transition: hold.transition, input, late, delay, sensor };
        for i in 0..2 {
            pi_loop.delay_input(i, jacobian, power_gain);
        }
        pi_loop
    }

    /// Takes the hose of the pump of a loop into account: `u(t − θ)` with `θ = d Ts + τ` is `u[k − d − 1]` until τ after a sample, and
    /// `u[k − d]` from then on (Åström and Wittenmark 1997, §2.3).
    #[expect(clippy::cast_possible_truncation, reason = "the number of samples in a delay")]
    fn delay_input(&mut self, i: usize, jacobian: &Jacobian, power_gain: f64) {
        let (pump, sampling_time_s) = (self.controller.pairing.pump_of(i), self.controller.sampling_time_s);
        let delay_s = jacobian.input_delay_s[pump];
        let samples = (delay_s / sampling_time_s + WHOLE).floor();
        let rest_s = delay_s - samples * sampling_time_s;
        self.delay[i] = samples as i32;
        if rest_s > WHOLE * sampling_time_s {
            let [before, after] = [rest_s, sampling_time_s - rest_s].map(|time| ZeroOrderHold::new(&jacobian.a, time));
            let flow = jacobian.b.column(pump) * power_gain;
            self.input.set_column(i, &(after.response * flow));
            self.late.set_column(i, &(after.transition * (before.response * flow)));
        }
    }

    /// The slowest rate of the plant and of the integrals (1/s).
    fn slowest_rate(&self, jacobian: &Jacobian) -> f64 {
        let plant = jacobian.a.diagonal();
        let integrals = self.controller.loops.iter().map(|settings| settings.integral_time_s.recip());
        let rates = plant.iter().map(|rate| rate.abs()).filter(|&rate| rate > 0.0).chain(integrals);
        rates.fold(f64::INFINITY, f64::min)
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
        let (earlier, delay) = (z.inv(), self.delay.map(|samples| z.powi(-samples)));
        Matrix2::from_fn(|lower, input| {
            let upper = lower + 2;
            let arriving = |tank: usize| earlier * self.late[(tank, input)] + self.input[(tank, input)];
            let above = arriving(upper) / (z - self.transition[(upper, upper)]);
            let flow = above * self.transition[(lower, upper)] + arriving(lower);
            flow * self.sensor[lower] / (z - self.transition[(lower, lower)]) * law[input] * delay[input]
        })
    }

    /// An element of the plant over the delay of its input, as a function of w = 1/z. A dry tank has none: its sensor is left out.
    fn element<T: Arithmetic>(&self, lower: usize, input: usize, w: T) -> T {
        let upper = lower + 2;
        let lag = |tank: usize| w / (T::real(1.0) - T::real(self.transition[(tank, tank)]) * w);
        let arriving = |tank: usize| T::real(self.input[(tank, input)]) + T::real(self.late[(tank, input)]) * w;
        if self.sensor[lower] == 0.0 {
            return T::real(0.0);
        }
        let fall = self.transition[(lower, upper)];
        let from_above = if fall == 0.0 { T::real(0.0) } else { arriving(upper) * lag(upper) * T::real(fall) };
        (from_above + arriving(lower)) * lag(lower) * T::real(self.sensor[lower])
    }
}

/// A delay that is a whole number of samples to this share of one is a whole number.
const WHOLE: f64 = 1e-9;

/// `det(I + L)` times `1 − w` for each loop that acts, whose law has its pole there: with `L = G K`, columns by loops.
impl DelayedLoop for PiLoop<'_> {
    fn terms<T: Arithmetic>(&self, w: T) -> [T; 4] {
        let difference = T::real(1.0) - w;
        let parts = self.controller.loops.map(|settings| {
            let integral = self.controller.sampling_time_s / (2.0 * settings.integral_time_s);
            // Tustin's rule, (z + 1)/(z − 1) = (1 + w)/(1 − w).
            let law = (difference + (T::real(1.0) + w) * T::real(integral)) * T::real(settings.gain);
            if settings.gain == 0.0 { (T::real(1.0), T::real(0.0)) } else { (difference, law) }
        });
        let [(own_1, law_1), (own_2, law_2)] = parts;
        let g = [0, 1].map(|lower| [0, 1].map(|input| self.element(lower, input, w)));
        let determinant = g[0][0] * g[1][1] - g[0][1] * g[1][0];
        [own_1 * own_2, g[0][0] * law_1 * own_2, g[1][1] * law_2 * own_1, determinant * law_1 * law_2]
    }

    fn delays(&self) -> [f64; 4] {
        let [first, second] = self.delay.map(f64::from);
        [0.0, first, second, first + second]
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
    use crate::linear::{SensitivityGains, Stability, StateSpace, singular_values};
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
        assert!(closed.rightmost_pole().unwrap().norm() < 1e-9);
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

    /// Moduli of the poles of the sampled loop by its state matrix, with each output of the last samples as a state.
    fn moduli_by_brute_force(jacobian: &Jacobian, controller: &DecentralisedPi, power_gain: f64) -> f64 {
        let ts = controller.sampling_time_s;
        let model = |duration: f64| {
            let (a, b, c) = jacobian.reduced();
            StateSpace::strictly_proper(a, b, c).unwrap().sampled(duration).unwrap()
        };
        let whole =
            jacobian.input_delay_s.map(|delay| (1..=1000_u32).take_while(|&k| f64::from(k) * ts <= delay).count());
        let rest = [0, 1].map(|pump: usize| jacobian.input_delay_s[pump] - whole[pump] as f64 * ts);
        let steps = whole.map(|samples| samples + 1);
        let tanks = model(ts).a.nrows();
        let n = tanks + 2 + steps[0] + steps[1];
        let mut matrix = DMatrix::<f64>::zeros(n, n);
        matrix.view_mut((0, 0), (tanks, tanks)).copy_from(&model(ts).a);
        let c = model(ts).c;
        let mut place = tanks + 2;
        for pump in 0..2 {
            let lp = (0..2).find(|&i| controller.pairing.pump_of(i) == pump).unwrap();
            let settings = controller.loops[lp];
            let share = ts / settings.integral_time_s;
            // u = K (1 + Ts/(2 Ti)) e + s, s+ = s + K Ts/Ti e, e = −C x.
            let mut output = DMatrix::<f64>::zeros(1, n);
            for state in 0..tanks {
                output[(0, state)] = -settings.gain * (1.0 + share / 2.0) * c[(lp, state)];
                matrix[(tanks + lp, state)] = -settings.gain * share * c[(lp, state)];
            }
            output[(0, tanks + lp)] = 1.0;
            matrix[(tanks + lp, tanks + lp)] = 1.0;
            // u[k − 1] … u[k − d − 1] at place …; u[k − d] is the output itself for d = 0.
            let d = steps[pump] - 1;
            let held = |age: usize| -> DMatrix<f64> {
                if age == 0 {
                    return output.clone();
                }
                let mut row = DMatrix::zeros(1, n);
                row[(0, place + age - 1)] = 1.0;
                row
            };
            let (early, late) = (model(ts - rest[pump]), model(rest[pump].max(1e-12)));
            let first = early.b.column(pump) * power_gain;
            let second = &early.a * late.b.column(pump) * power_gain;
            let fed = first * held(d) + second * held(d + 1) * f64::from(u8::from(rest[pump] > 0.0));
            let mut rows = matrix.view_mut((0, 0), (tanks, n));
            rows += fed;
            matrix.row_mut(place).copy_from(&output.row(0));
            for age in 1..steps[pump] {
                matrix[(place + age, place + age - 1)] = 1.0;
            }
            place += steps[pump];
        }
        crate::linear::eigenvalues(&matrix).unwrap().iter().map(|z| z.norm()).fold(0.0, f64::max)
    }

    #[test]
    fn a_delayed_loop_is_judged_as_by_all_its_poles() {
        let mut seen = [0, 0];
        for (id, delays, gains, sampling_time_s) in [
            (PresetId::JohanssonMinimumPhase, [3.0, 7.5], [1.0, 3.0], 1.0),
            (PresetId::JohanssonMinimumPhase, [40.0, 0.0], [0.1, 2.0], 2.0),
            (PresetId::JohanssonMinimumPhase, [0.0, 61.3], [0.3, 3.0], 3.0),
            (PresetId::CocotaMinimumPhase, [12.0, 12.0], [0.3, 4.0], 1.5),
            (PresetId::JohanssonNonMinimumPhase, [25.0, 10.0], [0.3, 3.0], 5.0),
        ] {
            let mut preset = id.preset();
            for (pump, delay) in preset.plant.pumps.iter_mut().zip(delays) {
                pump.delay_s = delay;
            }
            let jacobian = preset.plant.linearise(&preset.plant.free_equilibrium(preset.pump_voltage));
            for step in 0..=16 {
                let gain = gains[0] + (gains[1] - gains[0]) * f64::from(step) / 16.0;
                let gains = preset.pi.gains.map(|own| own * gain);
                let controller =
                    DecentralisedPi { sampling_time_s, ..law(preset.pi.pairing, gains, preset.pi.integral_times_s) };
                let radius = moduli_by_brute_force(&jacobian, &controller, preset.plant.power_gain);
                let found = closed_loop(&jacobian, &controller, preset.plant.power_gain).unwrap();
                let expected = if radius < 1.0 { Stability::Stable } else { Stability::Unstable };
                assert_eq!(found.stability, expected, "{id:?} {delays:?} {gain}: {radius}");
                seen[usize::from(radius < 1.0)] += 1;
                let Some(peak) = found.sensitivity_peak else { continue };
                let pi_loop = PiLoop::new(&jacobian, &controller, preset.plant.power_gain);
                let nyquist = std::f64::consts::PI / sampling_time_s;
                let dense = (1..=40_000)
                    .map(|k| SensitivityGains::of(&pi_loop.at(nyquist * f64::from(k) / 40_000.0)).sensitivity[0]);
                // A grid of 40,000 points finds the peak to some 1e-6, the search to 1e-5.
                assert_relative_eq!(peak.value, dense.fold(0.0, f64::max), max_relative = 1e-4);
            }
        }
        assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
    }

    #[test]
    fn a_delay_that_vanishes_changes_nothing() {
        let preset = PresetId::JohanssonMinimumPhase.preset();
        let mut jacobian = preset.plant.linearise(&preset.plant.free_equilibrium(preset.pump_voltage));
        let controller = law(preset.pi.pairing, preset.pi.gains, preset.pi.integral_times_s);
        let without = closed_loop(&jacobian, &controller, 1.0).unwrap();
        jacobian.input_delay_s = [1e-7; 2];
        let with = closed_loop(&jacobian, &controller, 1.0).unwrap();
        assert!(with.has_dead_time && with.poles_z.is_empty());
        assert_eq!(with.stability, without.stability);
        let [with, without] = [with, without].map(|closed| closed.sensitivity_peak.unwrap().value);
        assert_relative_eq!(with, without, max_relative = 1e-5);
    }
}
