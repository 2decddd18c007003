//! Exact limit cycles of a loop with an ideal relay, from state space (Campestrini 2006, §2.4.2).

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use crate::linear::{Complex, DiscreteStateSpace, LinearError, StateSpace, TransferFunction, eigenvalues};

/// Half periods that are tried for each decade, to find changes of sign.
const PER_DECADE: f64 = 60.0;
/// Halvings of a cell between them.
const HALVINGS: u32 = 50;
/// Points between two switches at which the output must keep its sign.
const POINTS: u32 = 400;

/// A symmetric unimodal oscillation of a relay `u = −d sign(y)` and a linear plant.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCycle {
    /// Period 2 h* (unit of time of the plant).
    pub period: f64,
    /// Peak of the output for a relay of amplitude 1.
    pub amplitude: f64,
    /// Eigenvalues of W (eq. 22), largest first: how a small disturbance grows from one switch to the next. One is always 0.
    pub multipliers: Vec<Complex>,
}

impl LimitCycle {
    /// Whether small disturbances die out.
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|m| m.norm() < 1.0)
    }

    /// Ultimate gain by the describing function, `4d/(π a)` (eq. 48).
    pub fn gain_by_peak(&self) -> f64 {
        4.0 / (PI * self.amplitude)
    }

    /// Ultimate gain by the first harmonics of input and output.
    pub fn gain_by_first_harmonic(&self, plant: &TransferFunction) -> f64 {
        plant.at(Complex::new(0.0, 2.0 * PI / self.period)).norm().recip()
    }
}

/// All unimodal limit cycles with half periods between two bounds, quickest first.
///
/// The plant must have positive gain and no dead time. Such a cycle exists exactly where `f(h) = C x*(h) = 0` (eq. 19) with
/// `x* = (e^{Ah} + I)⁻¹ ∫₀ʰ e^{As} B ds` (eq. 21) and the output keeps its sign in between (eq. 20). The integral stands for
/// `(e^{Ah} − I) A⁻¹ B`, which an integrating plant does not have.
///
/// # Errors
/// As [`TransferFunction::state_space`] and [`StateSpace::sampled`].
pub fn limit_cycles(plant: &TransferFunction, shortest: f64, longest: f64) -> Result<Vec<LimitCycle>, LinearError> {
    let model = plant.state_space()?;
    let switch = |h: f64| switching_state(&model, h);
    let output = |h: f64| Ok::<f64, LinearError>((&model.c * switch(h)?.1)[0]);
    let growth = 10.0_f64.powf(1.0 / PER_DECADE);
    let mut cycles = Vec::new();
    let (mut low, mut at_low) = (shortest, output(shortest)?);
    while low < longest {
        let high = low * growth;
        let at_high = output(high)?;
        if at_low != 0.0 && at_low.signum() != at_high.signum() {
            let (mut a, mut b) = (low, high);
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(a, b);
                if output(middle)?.signum() == at_low.signum() { a = middle } else { b = middle }
            }
            if let Some(cycle) = cycle(&model, b)? {
                cycles.push(cycle);
            }
        }
        (low, at_low) = (high, at_high);
    }
    Ok(cycles)
}

/// The sampled model over h and the state x* at a switch if the half period is h.
fn switching_state(model: &StateSpace, h: f64) -> Result<(DiscreteStateSpace, DVector<f64>), LinearError> {
    let sampled = model.sampled(h)?;
    let sum = &sampled.a + DMatrix::identity(model.order(), model.order());
    let singular = LinearError::SingularGain { reciprocal_condition: 0.0 };
    let state = sum.lu().solve(&sampled.b).ok_or(singular)?.column(0).into_owned();
    Ok((sampled, state))
}

/// The cycle with a half period at which f vanishes, if the output keeps its sign.
fn cycle(model: &StateSpace, h: f64) -> Result<Option<LimitCycle>, LinearError> {
    let (sampled, start) = switching_state(model, h)?;
    let step = model.sampled(h / f64::from(POINTS))?;
    let mut state = start.clone();
    let mut outputs = vec![0.0];
    for _ in 1..POINTS {
        // u = −1 while the output is positive.
        state = &step.a * &state - step.b.column(0);
        let output = (&model.c * &state)[0];
        if output <= 0.0 {
            return Ok(None);
        }
        outputs.push(output);
    }
    outputs.push(0.0);
    let slope = &sampled.a * (&model.a * &start - model.b.column(0));
    let along = (&model.c * &slope)[0];
    let n = model.order();
    let w = (DMatrix::identity(n, n) - &slope * &model.c / along) * &sampled.a;
    let mut multipliers = eigenvalues(&w)?;
    multipliers.sort_by(|x, y| y.norm().total_cmp(&x.norm()));
    Ok(Some(LimitCycle { period: 2.0 * h, amplitude: peak(&outputs), multipliers }))
}

/// Largest value of a smooth function, from equidistant samples: the vertex of the parabola through the highest three.
pub(super) fn peak(samples: &[f64]) -> f64 {
    let at = (0..samples.len()).max_by(|&i, &j| samples[i].total_cmp(&samples[j])).unwrap_or(0);
    let Some(&[before, top, after]) = at.checked_sub(1).and_then(|first| samples.get(first..first + 3)) else {
        return samples.get(at).copied().unwrap_or(0.0);
    };
    let (slope, bend) = (after - before, 2.0 * top - before - after);
    if bend > 0.0 { top + slope * slope / (8.0 * bend) } else { top }
}
