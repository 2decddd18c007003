use crate::linear::TransmissionZero;

/// The interpolation constraint of a real zero `z > 0` with output direction η: whatever stabilising controller acts, a
/// reference step `r` (any unit) at t = 0 obeys `∫₀^∞ ηᵀe(t) e^(−zt) dt = ηᵀr / z` (unit of `r` times s), because
/// `ηᵀG(z) = 0` lets nothing the controller does reach the error in this direction (Skogestad and Postlethwaite 2005,
/// §6.3; Johansson 2000, §IV).
///
/// `None` for a zero that is complex or not in the open right half-plane, where nothing is constrained.
pub fn interpolation_integral(zero: &TransmissionZero, reference: [f64; 2]) -> Option<f64> {
    let z = zero.value;
    if z.im != 0.0 || z.re <= 0.0 || zero.output_direction.len() != reference.len() {
        return None;
    }
    let along: f64 = zero.output_direction.iter().zip(reference).map(|(eta, r)| eta.re * r).sum();
    Some(along / z.re)
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;
    use crate::linear::Complex;

    fn zero(re: f64, im: f64) -> TransmissionZero {
        let direction = DVector::from_vec(vec![Complex::new(0.6, 0.0), Complex::new(-0.8, 0.0)]);
        TransmissionZero {
            value: Complex::new(re, im),
            input_direction: direction.clone(),
            output_direction: direction,
        }
    }

    #[test]
    fn the_integral_is_the_reference_along_the_direction_over_the_zero() {
        assert_eq!(interpolation_integral(&zero(0.5, 0.0), [2.0, 0.0]), Some(0.6 * 2.0 / 0.5));
        let blind = interpolation_integral(&zero(0.5, 0.0), [0.8, 0.6]).unwrap_or(f64::NAN);
        assert!(blind.abs() < 1e-15, "a step across the direction is free: {blind}");
    }

    #[test]
    fn a_zero_in_the_left_half_plane_constrains_nothing() {
        assert_eq!(interpolation_integral(&zero(-0.5, 0.0), [1.0, 0.0]), None);
        assert_eq!(interpolation_integral(&zero(0.5, 0.1), [1.0, 0.0]), None);
    }
}
