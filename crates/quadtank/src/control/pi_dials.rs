use serde::{Deserialize, Serialize};

/// How a device writes its proportional action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ProportionalDial {
    /// Gain Kp.
    Gain,
    /// Proportional band `PB = 100 %/Kp` (Andreis 2017, Eq. 39).
    Band,
}

/// How a device writes its integral action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum IntegralDial {
    /// Integral time Ti (s per repeat).
    Time,
    /// `60/Ti` repeats per minute, Ti in s.
    RepeatsPerMinute,
}

/// What the integral time of a device acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PiForm {
    /// Series, which for PI is the ISA form too: `u = Kp (e + (1/Ti) ∫ e dt)` (Andreis 2017, Eqs. 33 to 36).
    Series,
    /// Parallel: `u = Kp e + (1/Ti) ∫ e dt`, with `Ti_par = Ti_ser/Kp` (Andreis 2017, Eqs. 31, 37, 38).
    Parallel,
}

/// The way in which a device writes a PI controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PiDials {
    /// What the integral time acts on.
    pub form: PiForm,
    /// Gain or band.
    pub proportional: ProportionalDial,
    /// Time or rate.
    pub integral: IntegralDial,
}

impl PiDials {
    /// Both dials for a gain and an integral time (s) of the series form.
    ///
    /// ```
    /// use quadtank::control::{IntegralDial, PiDials, PiForm, ProportionalDial};
    ///
    /// let dials = PiDials {
    ///     form: PiForm::Parallel,
    ///     proportional: ProportionalDial::Band,
    ///     integral: IntegralDial::RepeatsPerMinute,
    /// };
    /// assert_eq!(dials.of(10.0, 2500.0), [10.0, 0.24]);
    /// ```
    pub fn of(self, gain: f64, integral_time_s: f64) -> [f64; 2] {
        let time = match self.form {
            PiForm::Series => integral_time_s,
            PiForm::Parallel => integral_time_s / gain,
        };
        [
            match self.proportional {
                ProportionalDial::Gain => gain,
                ProportionalDial::Band => 100.0 / gain,
            },
            match self.integral {
                IntegralDial::Time => time,
                IntegralDial::RepeatsPerMinute => 60.0 / time,
            },
        ]
    }

    /// Gain and integral time (s) of the series form for both dials, the inverse of [`of`](Self::of).
    pub fn settings(self, [proportional, integral]: [f64; 2]) -> [f64; 2] {
        let gain = match self.proportional {
            ProportionalDial::Gain => proportional,
            ProportionalDial::Band => 100.0 / proportional,
        };
        let time = match self.integral {
            IntegralDial::Time => integral,
            IntegralDial::RepeatsPerMinute => 60.0 / integral,
        };
        match self.form {
            PiForm::Series => [gain, time],
            PiForm::Parallel => [gain, time * gain],
        }
    }

    /// Ranges of gain and integral time (s) of the series form for ranges of both dials.
    pub fn ranges(self, proportional: [f64; 2], integral: [f64; 2]) -> [[f64; 2]; 2] {
        let corners = [0, 1].map(|i| [0, 1].map(|k| self.settings([proportional[i], integral[k]])));
        [0, 1].map(|axis| {
            let values = || corners.as_flattened().iter().map(|corner| corner[axis]);
            [values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max)]
        })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::{IsaPid, ParallelPid};

    #[test]
    fn every_way_of_writing_is_the_same_controller() {
        for form in [PiForm::Series, PiForm::Parallel] {
            for proportional in [ProportionalDial::Gain, ProportionalDial::Band] {
                for integral in [IntegralDial::Time, IntegralDial::RepeatsPerMinute] {
                    let dials = PiDials { form, proportional, integral };
                    let [gain, time] = dials.settings(dials.of(17.4, 23.5));
                    assert_relative_eq!(gain, 17.4, max_relative = 1e-14);
                    assert_relative_eq!(time, 23.5, max_relative = 1e-14);
                }
            }
        }
        // The parallel time is the reciprocal of the integral gain.
        let dials =
            PiDials { form: PiForm::Parallel, proportional: ProportionalDial::Gain, integral: IntegralDial::Time };
        let isa = IsaPid { gain: 17.4, integral_time: 23.5, derivative_time: 0.0 };
        assert_relative_eq!(dials.of(17.4, 23.5)[1], ParallelPid::from(isa).integral.recip(), max_relative = 1e-14);
    }
}
