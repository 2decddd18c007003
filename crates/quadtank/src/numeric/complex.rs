/// Complex number: poles, zeros (1/s), gains.
pub type Complex = nalgebra::Complex<f64>;

/// The square root with a real part that is not negative, to the last digit but one. That of num-complex goes through an angle
/// and loses digits near the negative real axis.
pub fn square_root(z: Complex) -> Complex {
    let long = (0.5 * (z.re.abs() + z.norm())).sqrt();
    if long == 0.0 {
        return Complex::ZERO;
    }
    let short = 0.5 * z.im / long;
    if z.re < 0.0 { Complex::new(short.abs(), long.copysign(z.im)) } else { Complex::new(long, short) }
}

/// |x| as `√(re² + im²)`, faster than `hypot`; overflows and underflows where the square does.
#[inline]
pub fn modulus(x: Complex) -> f64 {
    x.norm_sqr().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_of_the_root_is_the_number() {
        for (re, im) in [(0.3, -2.0), (-1.5, 40.0), (0.0, 1e-3), (-2.0, 0.0), (3.0, -1e-9), (-3.0, 1e-9), (0.0, 0.0)] {
            let z = Complex::new(re, im);
            let root = square_root(z);
            assert!((root - z.sqrt()).norm() < 1e-15 * z.norm().sqrt() + f64::MIN_POSITIVE, "{z}");
            assert!((root * root - z).norm() <= 4e-16 * z.norm() && root.re >= 0.0, "{z}");
        }
    }
}
