use crate::control::Pairing;
use crate::interaction::{PairingVerdict, niederlinski, recommend_pairing, relative_gain_array};
use crate::linear::{Complex, LinearError, StateSpace, TransmissionZero, place_nearest_at_origin, transmission_zeros};
use crate::plant::Jacobian;

/// What linear theory says of the quadruple tank around a point, at rest or not.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearPlant {
    /// The linear model without dry tanks: inputs pump voltages, outputs measured signals.
    pub model: StateSpace,
    /// Poles (1/s).
    pub poles: Vec<Complex>,
    /// Transmission zeros, by rising real part, one of them exactly zero where G(0) is singular; an error where the plant is singular
    /// for every s.
    pub zeros: Result<Vec<TransmissionZero>, LinearError>,
    /// G(0), by rows (V/V).
    pub dc_gain: [[f64; 2]; 2],
    /// λ11 of the relative gain array at steady state; an error where G(0) is singular.
    pub rga_11: Result<f64, LinearError>,
    /// Niederlinski index of the diagonal and of the swapped pairing; `None` where a paired gain is 0, and where G(0) is singular,
    /// because its sign is rounding there.
    pub niederlinski: [Option<f64>; 2],
    /// Which pairing is suggested, and by which rule.
    pub verdict: PairingVerdict,
}

/// Relative gains above 5 to 10 make a plant hard to control (Skogestad and Postlethwaite 2005, §3.4).
const LARGE_RELATIVE_GAIN: f64 = 5.0;

impl LinearPlant {
    /// The linear plant with this Jacobian.
    ///
    /// # Errors
    /// [`LinearError`] when the model has no poles or no steady-state gain. Questions that only singular plants leave open are
    /// answered by an error in place.
    pub fn of(jacobian: &Jacobian) -> Result<Self, LinearError> {
        let (a, b, c) = jacobian.reduced();
        let model = StateSpace::strictly_proper(a, b, c)?;
        let gain = model.dc_gain()?;
        let rga_11 = relative_gain_array(&gain).map(|array| array[(0, 0)]);
        let mut zeros = transmission_zeros(&model);
        if let (Ok(zeros), Err(LinearError::SingularGain { .. })) = (&mut zeros, &rga_11) {
            place_nearest_at_origin(zeros);
        }
        Ok(Self {
            poles: model.poles()?,
            zeros,
            dc_gain: [[gain[(0, 0)], gain[(0, 1)]], [gain[(1, 0)], gain[(1, 1)]]],
            niederlinski: if rga_11.is_ok() { niederlinski(&gain) } else { [None; 2] },
            rga_11,
            verdict: recommend_pairing(&gain),
            model,
        })
    }

    /// The relative gain array by rows; its rows and columns sum to 1. `None` where G(0) is singular.
    pub fn rga(&self) -> Option<[[f64; 2]; 2]> {
        let lambda = *self.rga_11.as_ref().ok()?;
        Some([[lambda, 1.0 - lambda], [1.0 - lambda, lambda]])
    }

    /// Whether relative gains are so large that some directions need far more input than others: the plant is hard to control.
    pub fn has_large_relative_gains(&self) -> bool {
        self.rga_11.is_ok_and(|gain| gain.abs() > LARGE_RELATIVE_GAIN)
    }

    /// The pairing that the relative gains suggest; `None` where they suggest none.
    pub fn advised_pairing(&self) -> Option<Pairing> {
        match self.verdict {
            PairingVerdict::Diagonal(_) => Some(Pairing::Diagonal),
            PairingVerdict::Swapped(_) => Some(Pairing::Swapped),
            PairingVerdict::None(_) => None,
        }
    }

    /// Niederlinski index of a pairing.
    pub fn niederlinski_of(&self, pairing: Pairing) -> Option<f64> {
        let [diagonal, swapped] = self.niederlinski;
        match pairing {
            Pairing::Diagonal => diagonal,
            Pairing::Swapped => swapped,
        }
    }

    /// The right-most transmission zero, which limits the loops.
    pub fn rightmost_zero(&self) -> Option<&TransmissionZero> {
        self.zeros.as_ref().ok()?.last()
    }
}
