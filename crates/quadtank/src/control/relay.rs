use std::f64::consts::PI;

use crate::linear::Complex;

/// How much a relay excites and where it switches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relay {
    /// Amplitude d of the output (unit of the plant input), positive; the sign of the gain of the loop is `reversed`.
    pub amplitude: f64,
    /// Half width ε of the hysteresis, in units of the control error; 0 for an ideal relay.
    pub hysteresis: f64,
    /// Mean of both output values (unit of the plant input).
    pub bias: f64,
    /// For a loop with negative gain: a positive error lowers the input.
    pub reversed: bool,
}

impl Relay {
    /// An ideal relay for a loop whose gain has the sign of `gain`.
    pub fn ideal(amplitude: f64, gain: f64) -> Self {
        Self { amplitude, hysteresis: 0.0, bias: 0.0, reversed: gain < 0.0 }
    }

    /// The output for `u = bias + d sign(e)`, by what the relay takes the sign of the error to be (Campestrini 2006, eq. 12
    /// with e = r − y).
    pub fn output(&self, positive: bool) -> f64 {
        let up = positive != self.reversed;
        self.bias + if up { self.amplitude } else { -self.amplitude }
    }

    /// The error at which a relay switches next.
    pub fn threshold(&self, positive: bool) -> f64 {
        if positive { -self.hysteresis } else { self.hysteresis }
    }

    /// `−1/N(a) = −(π/4d) (√(a² − ε²) + j ε)` of an oscillation with amplitude a ≥ ε at the relay, without the sign of the
    /// loop (Campestrini 2006, eq. 46 for ε = 0).
    pub fn critical_locus(&self, amplitude: f64) -> Complex {
        let reach = (amplitude * amplitude - self.hysteresis * self.hysteresis).max(0.0).sqrt();
        Complex::new(reach, self.hysteresis) * (-PI / (4.0 * self.amplitude))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_4, SQRT_2};

    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn relays_switch_at_their_hysteresis_and_follow_the_sign_of_the_loop() {
        let relay = Relay { amplitude: 2.0, hysteresis: 0.1, bias: 0.5, reversed: false };
        assert_eq!((relay.output(true), relay.output(false)), (2.5, -1.5));
        assert_eq!((relay.threshold(true), relay.threshold(false)), (-0.1, 0.1));
        assert_eq!(Relay { reversed: true, ..relay }.output(true), -1.5);
        assert_relative_eq!(relay.critical_locus(0.1 * SQRT_2).re, relay.critical_locus(0.1 * SQRT_2).im);
        assert_relative_eq!(Relay::ideal(1.0, 1.0).critical_locus(3.0).re, -3.0 * FRAC_PI_4);
    }

    #[test]
    fn the_critical_locus_is_the_negative_inverse_of_the_describing_function() {
        let relay = Relay { amplitude: 2.0, hysteresis: 0.3, bias: 0.0, reversed: false };
        // N(a) = 4d/(πa) e^(−j asin(ε/a)).
        let (amplitude, phase) = (0.5, (0.3_f64 / 0.5).asin());
        let describing = Complex::from_polar(8.0 / (PI * amplitude), -phase);
        assert_relative_eq!((relay.critical_locus(amplitude) + describing.inv()).norm(), 0.0, epsilon = 1e-15);
        // Within its hysteresis a relay does not switch: the locus stays at its beginning.
        assert_eq!(relay.critical_locus(0.1), relay.critical_locus(0.3));
        assert!(
            !Relay::ideal(1.0, 2.0).reversed && Relay::ideal(1.0, -2.0).reversed && !Relay::ideal(1.0, 0.0).reversed
        );
    }
}
