//! The sampled linear loop: plant under zero-order hold and two PI laws, as a state matrix and over frequency.

use nalgebra::{DMatrix, Matrix2, Matrix4, Matrix4x2};

use crate::control::{DecentralisedPi, PiSettings};
use crate::linear::{Complex, ZeroOrderHold};
use crate::plant::Jacobian;

/// The loop, cut open at the outputs of the controllers. Columns are by loops, not by pumps.
pub(super) struct OpenLoop<'a> {
    controller: &'a DecentralisedPi,
    /// State transition of the plant over one sample.
    transition: Matrix4<f64>,
    /// What a controller output held for one sample does to the levels (m/V).
    input: Matrix4x2<f64>,
    /// Gain of the level sensors; 0 for a tank that is dry (V/m).
    sensor: [f64; 2],
}

impl<'a> OpenLoop<'a> {
    pub(super) fn new(jacobian: &Jacobian, controller: &'a DecentralisedPi, power_gain: f64) -> Self {
        let hold = ZeroOrderHold::new(&jacobian.a, controller.sampling_time_s);
        let by_pump = hold.response * jacobian.b * power_gain;
        let input = Matrix4x2::from_fn(|tank, i| by_pump[(tank, controller.pairing.pump_of(i))]);
        let sensor = [jacobian.c[(0, 0)], jacobian.c[(1, 1)]];
        Self { controller, transition: hold.transition, input, sensor }
    }

    /// State matrix of the closed loop without the tanks that are `quasi_steady`. States are levels (m), then one integral per
    /// loop that acts, `s = I − K Ts/(2 Ti) e` (V), with which Tustin's rule reads `c = K (1 + Ts/(2 Ti)) e + s` and
    /// `s⁺ = s + K Ts/Ti e`.
    pub(super) fn closed(&self, quasi_steady: [bool; 4]) -> DMatrix<f64> {
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

    /// `L(z)`, outputs by inputs of the loops. Only the tank above stands between an input and a lower tank.
    pub(super) fn loop_gain(&self, z: Complex) -> Matrix2<Complex> {
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
