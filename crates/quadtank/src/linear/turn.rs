//! Functions of complex numbers without the trigonometry of the standard library, see [`sine_cosine`].

use super::Complex;
use crate::scalar::sine_cosine;

/// e^(j angle).
pub fn turn(angle: f64) -> Complex {
    let (sine, cosine) = sine_cosine(angle);
    Complex::new(cosine, sine)
}

/// e^z.
pub fn exponential(z: Complex) -> Complex {
    turn(z.im) * z.re.exp()
}

/// The square root with a real part that is not negative.
pub fn square_root(z: Complex) -> Complex {
    let long = (0.5 * (z.re.abs() + z.norm())).sqrt();
    if long == 0.0 {
        return Complex::ZERO;
    }
    let short = 0.5 * z.im / long;
    if z.re < 0.0 { Complex::new(short.abs(), long.copysign(z.im)) } else { Complex::new(long, short) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_those_of_the_library() {
        for (re, im) in [(0.3, -2.0), (-1.5, 40.0), (0.0, 1e-3), (-2.0, 0.0), (3.0, -1e-9), (-3.0, 1e-9), (0.0, 0.0)] {
            let z = Complex::new(re, im);
            assert!((exponential(z) - z.exp()).norm() < 4e-16 * z.exp().norm());
            // The root of the library goes through an angle and is less exact.
            let root = square_root(z);
            assert!((root - z.sqrt()).norm() < 1e-15 * z.norm().sqrt() + f64::MIN_POSITIVE, "{z}");
            assert!((root * root - z).norm() <= 4e-16 * z.norm() && root.re >= 0.0, "{z}");
        }
    }
}
