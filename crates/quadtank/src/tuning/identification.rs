//! The frequency response at the ultimate frequency without a model: a sine in one input, and what simultaneous relays
//! left of their fundamentals (Campestrini 2006, §5.4.3).

use std::f64::consts::TAU;

use nalgebra::Matrix2;

use crate::linear::{Complex, DelayedPlant, TransferMatrix};

use super::TuningError;
use super::error::positive;
use super::experiment::check_stable;
use super::relay_reading::Oscillation;

/// Steps of the held sine in a period. Its harmonics are at multiples of that frequency, where plants pass little.
const STEPS: u32 = 256;

/// `g11` and `g21` (or `g12` and `g22`) at a frequency, from a sine in one input with the other at rest, after a number of
/// periods for the transient (eq. 122).
///
/// `input` is the index of the input, 0 or 1; `frequency` in rad per unit of time of the plant. Returns g of outputs 1
/// and 2 (output/input).
///
/// # Errors
/// [`TuningError::OutOfRange`] for a frequency that is not positive; [`TuningError::UnstablePlant`]; as
/// [`DelayedPlant::new`] for a plant that is improper or of too high an order.
pub fn sine_test(
    plant: &TransferMatrix,
    input: usize,
    frequency: f64,
    periods: u32,
) -> Result<[Complex; 2], TuningError> {
    positive("frequency", frequency)?;
    check_stable(plant)?;
    let mut moving = DelayedPlant::new(&plant.paths())?;
    let step = TAU / (frequency * f64::from(STEPS));
    let (mut sent, mut received) = (Complex::ZERO, [Complex::ZERO; 2]);
    for k in 0..(periods + 1) * STEPS {
        let angle = TAU * f64::from(k % STEPS) / f64::from(STEPS);
        let mut inputs = [0.0; 2];
        inputs[input] = angle.sin();
        moving.set_inputs(inputs);
        if k >= periods * STEPS {
            let turn = Complex::cis(-angle);
            // The input is held, so its harmonic is that of a step that begins here; the output is sampled.
            let held = Complex::new(0.0, TAU / f64::from(STEPS));
            sent += turn * inputs[input] * (Complex::ONE - (-held).exp()) / held;
            for (sum, output) in received.iter_mut().zip(moving.outputs()) {
                *sum += turn * output;
            }
        }
        moving.advance(step);
    }
    Ok(received.map(|output| output / sent))
}

/// The whole of G(jω) at the frequency of simultaneous relays, from its first column by [`sine_test`] and the fundamentals of
/// the relay test: `g12 = (Y1 − g11 U1)/U2`, `g22 = (Y2 − g21 U1)/U2` (eq. 123).
pub fn complete_response(first_column: [Complex; 2], oscillation: &Oscillation) -> Matrix2<Complex> {
    let [one, two] = &oscillation.loops;
    let second = [one.output, two.output].map(|y| y / two.input);
    let share = one.input / two.input;
    Matrix2::new(
        first_column[0],
        second[0] - first_column[0] * share,
        first_column[1],
        second[1] - first_column[1] * share,
    )
}
