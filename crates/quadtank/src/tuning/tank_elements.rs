use crate::linear::{LinearError, TransferFunction, TransferMatrix};
use crate::plant::Jacobian;

/// The linear model of the quadruple tank as transfer functions, from pump voltages (V) to measured levels (V), in seconds:
/// one lag where a pump feeds a lower tank, two where its water passes an upper one (Johansson 2000, eq. 2). The
/// outflow of a quasi-steady tank equals its inflow. The hose of each pump is a dead time.
///
/// # Errors
/// None for a model of a plant; the type is that of [`TransferFunction::new`].
pub fn tank_transfer_matrix(jacobian: &Jacobian) -> Result<TransferMatrix, LinearError> {
    let Jacobian { a, b, c, quasi_steady, input_delay_s: delay, drift: _ } = jacobian;
    let time = |tank: usize| -1.0 / a[(tank, tank)];
    let none = || TransferFunction::lags(0.0, &[], 0.0);
    let own = |i: usize| {
        if quasi_steady[i] {
            none()
        } else {
            TransferFunction::lags(c[(i, i)] * b[(i, i)] * time(i), &[time(i)], delay[i])
        }
    };
    let across = |i: usize| {
        let (upper, other) = (i + 2, 1 - i);
        if quasi_steady[i] {
            none()
        } else if quasi_steady[upper] {
            TransferFunction::lags(c[(i, i)] * b[(i, other)] * time(i), &[time(i)], delay[other])
        } else {
            let gain = c[(i, i)] * a[(i, upper)] * b[(upper, other)] * time(i) * time(upper);
            TransferFunction::lags(gain, &[time(i), time(upper)], delay[other])
        }
    };
    Ok(TransferMatrix([[own(0)?, across(0)?], [across(1)?, own(1)?]]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{Complex, StateSpace};
    use crate::literature::PresetId;

    #[test]
    fn elements_of_the_tank_are_those_of_its_state_space() {
        for preset in PresetId::ALL.map(PresetId::preset) {
            for valves in [preset.plant.valves, [0.0, 0.4], [1.0, 1.0]] {
                let plant = preset.plant.with_valves(valves);
                let jacobian = plant.linearise(&plant.free_equilibrium(preset.pump_voltage));
                let (a, b, c) = jacobian.reduced();
                let model = StateSpace::strictly_proper(a, b, c).unwrap();
                let transfer = tank_transfer_matrix(&jacobian).unwrap();
                for w in [1e-3, 0.02, 0.5] {
                    let (found, expected) = (transfer.at(Complex::new(0.0, w)), model.frequency_response(w).unwrap());
                    let size = expected.norm();
                    for i in 0..4 {
                        let at = (i / 2, i % 2);
                        assert!((found[at] - expected[at]).norm() <= 1e-12 * size, "{valves:?}, {w}, {at:?}");
                    }
                }
            }
        }
    }
}
