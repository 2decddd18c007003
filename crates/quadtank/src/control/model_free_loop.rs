//! The sampled linear loop of the model-free law, with its estimator, and how small α̂ may be.

use std::array::from_fn;
use std::cmp::Ordering;

use nalgebra::{DMatrix, Matrix6, Vector4};

use super::{EstimatorError, EstimatorSettings, ModelFree, Window};
use crate::linear::{Complex, LinearError, Stability, ZeroOrderHold, eigenvalues, s_from_z};
use crate::numeric::root;
use crate::plant::Jacobian;

/// Samples of a sliding window up to which its poles are computed: each is two states.
const MAX_SLIDING_SAMPLES: usize = 30;
/// What rounding makes of a zero multiplier of a shift register of N samples is `(1e-12)^(1/N)` at most.
const SHIFTED: f64 = 1e-12;
/// Smallest α̂ that is tried, as a share of the present one.
const SMALLEST: f64 = 1e-4;

/// Poles of the linear loop of a law that does not touch its limits.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFreePoles {
    /// The poles in the s-plane (1/s), by falling real part. With a block window the loop repeats itself only from
    /// window to window, and these are `ln(μ)/T` of the multipliers μ over one window; else `ln(z)/Ts`. Multipliers at
    /// z = 0, as those of the memory of a sliding window, have no image; they are left out, with all that are zero
    /// within rounding.
    pub poles_s: Vec<Complex>,
    /// The verdict.
    pub stability: Stability,
}

/// The order of poles: by falling real part, then by falling imaginary part.
fn falling(one: &Complex, other: &Complex) -> Ordering {
    other.re.total_cmp(&one.re).then(other.im.total_cmp(&one.im))
}

/// Poles of the sampled linear loop: the plant of `jacobian` under zero-order hold with the law and its estimator. The
/// estimator is fed with what the pumps get. `power_gain` is that of the power module (V/V).
///
/// # Errors
/// [`LinearError::OutOfRange`] when the law [cannot work](ModelFree::check) or its sliding window has more than 30 samples,
/// [`LinearError::NoConvergence`] when an entry is not finite.
pub fn model_free_poles(jacobian: &Jacobian, law: &ModelFree, power_gain: f64) -> Result<ModelFreePoles, LinearError> {
    let linear = ModelFreeLoop::new(jacobian, law, power_gain)?;
    let (map, period_s) = linear.period_map();
    let nothing = linear.shifted();
    let multipliers = eigenvalues(&map)?;
    let stability = Stability::of_poles(&multipliers);
    let nonzero = multipliers.into_iter().filter(|z| z.norm() > nothing);
    let mut poles_s: Vec<Complex> = nonzero.filter_map(|z| s_from_z(z, period_s)).collect();
    poles_s.sort_by(falling);
    Ok(ModelFreePoles { poles_s, stability })
}

/// Poles (1/s) of the loop in continuous time without estimator, `u = (Kp e + Ki ∫ e dt)/α̂`. A zero of the plant in the right
/// half-plane attracts one of them.
///
/// # Errors
/// [`LinearError::NoConvergence`] when an entry is not finite.
pub fn continuous_model_free_poles(
    jacobian: &Jacobian,
    law: &ModelFree,
    power_gain: f64,
) -> Result<Vec<Complex>, LinearError> {
    let mut a = Matrix6::zeros();
    a.fixed_view_mut::<4, 4>(0, 0).copy_from(&jacobian.a);
    for (i, settings) in law.loops.iter().enumerate() {
        let pump = law.pairing.pump_of(i);
        for tank in 0..4 {
            let gain = jacobian.b[(tank, pump)] * power_gain / settings.model_gain;
            a[(tank, i)] -= gain * settings.proportional;
            a[(tank, 4 + i)] += gain * settings.integral;
        }
        a[(4 + i, i)] = -1.0;
    }
    let wet: Vec<usize> = (0..6).filter(|&k| k > 3 || !jacobian.quasi_steady[k]).collect();
    let mut poles = eigenvalues(&DMatrix::from_fn(wet.len(), wet.len(), |i, j| a[(wet[i], wet[j])]))?;
    poles.sort_by(falling);
    Ok(poles)
}

/// Smallest α̂ (m/(s V)) of a single lower tank without drain: below `b Ts (2 Kp + Ki Ts)/4`, with b the slope of the level per
/// volt (m/(s V)), the sampled loop swings from sample to sample with growing amplitude. Of that, `b Kp Ts/2` is by far the
/// larger part.
pub fn smallest_model_gain_of_integrator(slope: f64, proportional: f64, integral: f64, sampling_time_s: f64) -> f64 {
    slope * sampling_time_s * (2.0 * proportional + integral * sampling_time_s) / 4.0
}

/// Smallest α̂ (m/(s V)), the same in both loops, with which the linear loop is stable, down from that of the first loop; `None`
/// when it is not stable to begin with, or still stable with a ten-thousandth of it.
///
/// # Errors
/// As [`model_free_poles`].
pub fn smallest_model_gain(jacobian: &Jacobian, law: &ModelFree, power_gain: f64) -> Result<Option<f64>, LinearError> {
    // Positive where the loop is stable.
    let slack = |gain: f64| {
        let mut law = *law;
        law.loops.iter_mut().for_each(|settings| settings.model_gain = gain);
        let (map, _) = ModelFreeLoop::new(jacobian, &law, power_gain)?.period_map();
        Ok::<_, LinearError>(Stability::slack(&eigenvalues(&map)?))
    };
    let mut stable = law.loops[0].model_gain;
    let mut at_stable = slack(stable)?;
    if at_stable <= 0.0 {
        return Ok(None);
    }
    loop {
        let smaller = stable / 2.0;
        let at_smaller = slack(smaller)?;
        if at_smaller <= 0.0 {
            // What is no number there has no crossing between.
            let found = root(|gain| slack(gain).unwrap_or(f64::NAN), (smaller, at_smaller), (stable, at_stable));
            return Ok(Some(found));
        }
        if smaller < SMALLEST * law.loops[0].model_gain {
            return Ok(None);
        }
        (stable, at_stable) = (smaller, at_smaller);
    }
}

fn unusable(error: EstimatorError) -> LinearError {
    match error {
        EstimatorError::ModelGain { value } => LinearError::OutOfRange { field: "model_gain", value },
        EstimatorError::WindowTooShort { window_s, .. }
        | EstimatorError::WindowTooLong { window_s, .. }
        | EstimatorError::WindowNotWhole { window_s, .. } => {
            LinearError::OutOfRange { field: "window_s", value: window_s }
        }
    }
}

/// The loop as linear steps, in deviations from a point of rest.
struct ModelFreeLoop<'a> {
    law: &'a ModelFree,
    hold: ZeroOrderHold,
    /// What an output of loop i held for one sample does to the levels (m/V).
    input: [Vector4<f64>; 2],
    /// Tanks that hold water.
    wet: Vec<usize>,
    /// Loops with integral action: the integral of another one is no part of the loop.
    integrating: Vec<usize>,
    /// The estimators with their weights, where there are any.
    estimator: Option<(EstimatorSettings, [Vec<[f64; 2]>; 2])>,
}

/// Levels (m), integrals (m s), and what the estimators remember.
struct State {
    levels: Vector4<f64>,
    integrals: [f64; 2],
    memory: Vec<f64>,
}

impl<'a> ModelFreeLoop<'a> {
    fn new(jacobian: &Jacobian, law: &'a ModelFree, power_gain: f64) -> Result<Self, LinearError> {
        law.check().map_err(unusable)?;
        let hold = ZeroOrderHold::new(&jacobian.a, law.sampling_time_s);
        let by_pump = hold.response * jacobian.b * power_gain;
        let weights = |settings: EstimatorSettings| {
            let of_loop = |i: usize| settings.weights(law.loops[i].model_gain, law.sampling_time_s);
            let weights = [of_loop(0).map_err(unusable)?, of_loop(1).map_err(unusable)?];
            let count = weights[0].len() - 1;
            if settings.window == Window::Sliding && count > MAX_SLIDING_SAMPLES {
                return Err(LinearError::OutOfRange { field: "window_s", value: settings.window_s });
            }
            Ok((settings, weights))
        };
        Ok(Self {
            law,
            hold,
            input: from_fn(|i| by_pump.column(law.pairing.pump_of(i)).into_owned()),
            wet: (0..4).filter(|&tank| !jacobian.quasi_steady[tank]).collect(),
            integrating: (0..2).filter(|&i| law.loops[i].integral != 0.0).collect(),
            estimator: law.estimator.map(weights).transpose()?,
        })
    }

    /// Modulus below which a multiplier counts as zero.
    fn shifted(&self) -> f64 {
        match &self.estimator {
            Some((settings, weights)) if settings.window == Window::Sliding => {
                SHIFTED.powf(1.0 / (weights[0].len() - 1) as f64)
            }
            _ => 0.0,
        }
    }

    /// The matrix that takes the state over one period, and the length of that (s).
    fn period_map(&self) -> (DMatrix<f64>, f64) {
        let (memory, samples) = match &self.estimator {
            None => (0, 1),
            // φ̂ of both loops, just renewed. The output before that has no weight in the window that begins.
            Some((settings, weights)) if settings.window == Window::Block => (2, weights[0].len() - 1),
            // What the estimates of both loops for the samples to come already have.
            Some((_, weights)) => (2 * (weights[0].len() - 1), 1),
        };
        let wet = self.wet.len();
        let before = wet + self.integrating.len();
        let order = before + memory;
        let mut map = DMatrix::zeros(order, order);
        for column in 0..order {
            let unit = |k: usize| if k == column { 1.0 } else { 0.0 };
            let mut levels = Vector4::zeros();
            for (k, &tank) in self.wet.iter().enumerate() {
                levels[tank] = unit(k);
            }
            let mut integrals = [0.0; 2];
            for (k, &i) in self.integrating.iter().enumerate() {
                integrals[i] = unit(wet + k);
            }
            let mut state = State { levels, integrals, memory: (0..memory).map(|k| unit(before + k)).collect() };
            match &self.estimator {
                None => drop(self.sample(&mut state, [0.0; 2])),
                Some((settings, weights)) if settings.window == Window::Block => self.block(&mut state, weights),
                Some((_, weights)) => self.slide(&mut state, weights),
            }
            let integrals = self.integrating.iter().map(|&i| state.integrals[i]);
            let after = self.wet.iter().map(|&tank| state.levels[tank]).chain(integrals).chain(state.memory);
            for (row, value) in after.enumerate() {
                map[(row, column)] = value;
            }
        }
        (map, samples as f64 * self.law.sampling_time_s)
    }

    /// One sample with the estimates `phi`; returns the outputs of both loops.
    fn sample(&self, state: &mut State, phi: [f64; 2]) -> [f64; 2] {
        let output = from_fn(|i| {
            let settings = &self.law.loops[i];
            let error = -state.levels[i];
            state.integrals[i] += self.law.sampling_time_s * error;
            (-phi[i] + settings.proportional * error + settings.integral * state.integrals[i]) / settings.model_gain
        });
        state.levels = self.hold.transition * state.levels + self.input[0] * output[0] + self.input[1] * output[1];
        output
    }

    /// A whole block window: φ̂ is held while the sums for the next one grow.
    fn block(&self, state: &mut State, weights: &[Vec<[f64; 2]>; 2]) {
        let phi = [state.memory[0], state.memory[1]];
        let mut output = [0.0; 2];
        let mut next = [0.0; 2];
        for (n, (first, second)) in weights[0].iter().zip(&weights[1]).enumerate() {
            if n > 0 {
                output = self.sample(state, phi);
            }
            for (i, weight) in [first, second].into_iter().enumerate() {
                next[i] += weight[0] * state.levels[i] + weight[1] * output[i];
            }
        }
        state.memory = next.to_vec();
    }

    /// One sample with a window that slides: the memory holds, for each loop, what φ̂ at the next N samples already has of
    /// measurements and outputs so far, the next one first.
    fn slide(&self, state: &mut State, weights: &[Vec<[f64; 2]>; 2]) {
        let count = weights[0].len() - 1;
        let measured = [state.levels[0], state.levels[1]];
        let phi = from_fn(|i| state.memory[i * count] + weights[i][count][0] * measured[i]);
        let output = self.sample(state, phi);
        for (i, column) in state.memory.chunks_exact_mut(count).enumerate() {
            column.rotate_left(1);
            column[count - 1] = 0.0;
            for (ahead, sum) in column.iter_mut().enumerate() {
                let (of_level, of_output) = (weights[i][count - 1 - ahead][0], weights[i][count - ahead][1]);
                *sum += of_level * measured[i] + of_output * output[i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2x4, Matrix4, Matrix4x2};

    use super::*;
    use crate::control::ModelFreeSettings;

    /// Two lower tanks that have nothing to do with each other, each with a drain (1/s) and a slope of its level (m/(s V)).
    fn apart(drains: [f64; 2], slopes: [f64; 2]) -> Jacobian {
        let mut a = Matrix4::zeros();
        let mut b = Matrix4x2::zeros();
        for i in 0..2 {
            a[(i, i)] = -drains[i];
            b[(i, i)] = slopes[i];
        }
        Jacobian {
            a,
            b,
            c: Matrix2x4::identity(),
            quasi_steady: [false, false, true, true],
            input_delay_s: [0.0; 2],
            drift: Vector4::zeros(),
        }
    }

    fn loops() -> [ModelFreeSettings; 2] {
        let published = ModelFree::PUBLISHED.loops[0];
        let other = ModelFreeSettings { model_gain: 2.5e-3, proportional: 0.7, integral: 0.2, ..published };
        [published, other]
    }

    /// With the integral action as large as the rest, so that it counts.
    #[test]
    fn below_its_smallest_model_gain_an_integrator_swings() {
        for (slope, proportional, integral, sampling_time_s) in [(6e-4, 2.0, 0.05, 1.0), (3e-3, 0.4, 1.7, 0.3)] {
            let least = smallest_model_gain_of_integrator(slope, proportional, integral, sampling_time_s);
            let stability = |share: f64| {
                let model_gain = share * least;
                let one = ModelFreeSettings { model_gain, proportional, integral, ..ModelFree::PUBLISHED.loops[0] };
                let law = ModelFree { loops: [one; 2], estimator: None, sampling_time_s, ..ModelFree::PUBLISHED };
                model_free_poles(&apart([0.0; 2], [slope; 2]), &law, 1.0).unwrap().stability
            };
            assert_eq!([1.001, 0.999].map(stability), [Stability::Stable, Stability::Unstable], "{least}");
        }
    }

    /// The estimator of each loop remembers its own loop alone.
    #[test]
    fn poles_of_tanks_apart_are_those_of_each_loop() {
        let plant = apart([0.01, 0.03], [6e-4, 9e-4]);
        let [one, other] = loops();
        for estimator in
            [Window::Sliding, Window::Block].map(|window| EstimatorSettings { window, ..EstimatorSettings::PUBLISHED })
        {
            let poles = |loops: [ModelFreeSettings; 2], tanks: [usize; 2]| {
                let plant = apart(tanks.map(|k| -plant.a[(k, k)]), tanks.map(|k| plant.b[(k, k)]));
                let law = ModelFree { loops, estimator: Some(estimator), ..ModelFree::PUBLISHED };
                model_free_poles(&plant, &law, 1.0).unwrap().poles_s
            };
            let together = poles([one, other], [0, 1]);
            // Each alone comes twice here, since both tanks are then the same.
            let mut apart: Vec<Complex> = [poles([one; 2], [0; 2]), poles([other; 2], [1; 2])].concat();
            apart.sort_by(falling);
            assert_eq!(apart.len(), 2 * together.len(), "{estimator:?}");
            for pole in &together {
                let nearest = apart.iter().map(|z| (z - pole).norm()).fold(f64::INFINITY, f64::min);
                // A double eigenvalue is found to the root of the rounding error.
                assert!(nearest < 1e-6, "{estimator:?} {pole}: {nearest}");
            }
        }
    }
}
