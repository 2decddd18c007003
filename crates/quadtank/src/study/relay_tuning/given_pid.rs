use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::control::{IsaPid, ParallelPid, SeriesPid};

/// How the numbers of a given controller are meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PidForm {
    /// ISA or standard, without interaction: `K (1 + 1/(Ti s) + Td s)`.
    #[default]
    Isa,
    /// Series or interacting: `K′ (1 + 1/(Ti′ s)) (1 + Td′ s)`.
    Series,
    /// Parallel: `kp + ki/s + kd s`.
    Parallel,
}

impl PidForm {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Isa, Self::Series, Self::Parallel];
}

/// A PI or PID controller that is given, in one of three forms. In each the derivative part `kd s` of the parallel form is filtered,
/// `kd s/(Tf s + 1)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GivenPid {
    /// The form; ISA where it is absent.
    #[serde(default, skip_serializing_if = "is_isa")]
    pub form: PidForm,
    /// Gain K or K′, of either sign; 0 leaves the loop open. In parallel form the proportional gain kp.
    pub gain: f64,
    /// Integral time Ti or Ti′; absent without integral action, and in parallel form.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub integral_time: Option<f64>,
    /// Derivative time Td or Td′; 0 for PI, and in parallel form.
    #[serde(default)]
    pub derivative_time: f64,
    /// Integral gain ki of the parallel form; 0 in the others.
    #[serde(default, skip_serializing_if = "crate::numeric::is_zero")]
    pub integral_gain: f64,
    /// Derivative gain kd of the parallel form; 0 in the others.
    #[serde(default, skip_serializing_if = "crate::numeric::is_zero")]
    pub derivative_gain: f64,
    /// Time constant Tf of the derivative filter; a hundredth of the derivative time kd/kp where it is absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filter_time: Option<f64>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks by reference")]
fn is_isa(form: &PidForm) -> bool {
    *form == PidForm::Isa
}

/// Why a controller has no other form.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum FormError {
    /// Its zeros are complex, so that no two factors have them: Ti < 4 Td.
    #[error("with Ti = {integral_time} below 4 Td = {} its zeros are complex, and no series form has them", 4.0 * derivative_time)]
    ComplexZeros {
        /// Ti of the ISA form.
        integral_time: f64,
        /// Td of the ISA form.
        derivative_time: f64,
    },
    /// It has no proportional part, which the other forms multiply everything with.
    #[error("without a proportional gain only the parallel form is possible")]
    NoProportionalPart,
    /// Its gains have different signs, so that a time of the other form would be negative.
    #[error("a time of the other form would be {time}, because the gains have different signs")]
    NegativeTime {
        /// That time.
        time: f64,
    },
}

impl GivenPid {
    /// Time constant of the derivative filter in force; 0 without derivative action.
    pub fn filter_in_force(self) -> f64 {
        ParallelPid::from(self).filter_time()
    }

    /// Whether it does nothing, so that its loop is open.
    pub fn is_open(self) -> bool {
        let ParallelPid { proportional, integral, derivative, .. } = self.into();
        [proportional, integral, derivative] == [0.0; 3]
    }

    /// Whether it has derivative action, and so something to filter.
    pub fn has_derivative(self) -> bool {
        ParallelPid::from(self).derivative != 0.0
    }

    /// The same controller in another form.
    ///
    /// # Errors
    /// [`FormError`] where the other form does not have it.
    pub fn in_form(self, form: PidForm) -> Result<Self, FormError> {
        if form == self.form {
            return Ok(self);
        }
        let filter_time = self.filter_time;
        if self.is_open() {
            return Ok(Self { form, filter_time, ..Self::default() });
        }
        let parallel = ParallelPid::from(self);
        if form == PidForm::Parallel {
            let ParallelPid { proportional, integral, derivative, .. } = parallel;
            let gains = Self { gain: proportional, integral_gain: integral, derivative_gain: derivative, ..self };
            return Ok(Self { form, integral_time: None, derivative_time: 0.0, ..gains });
        }
        let isa = match self.form {
            PidForm::Isa | PidForm::Series => self.as_isa(),
            PidForm::Parallel => IsaPid::from_parallel(parallel).ok_or(FormError::NoProportionalPart)?,
        };
        if let Some(time) = [isa.integral_time, isa.derivative_time].into_iter().find(|&time| time < 0.0) {
            return Err(FormError::NegativeTime { time });
        }
        let IsaPid { gain, integral_time, derivative_time } = match form {
            PidForm::Series => as_series(isa)?,
            PidForm::Isa | PidForm::Parallel => isa,
        };
        let integral_time = Some(integral_time).filter(|time| time.is_finite());
        Ok(Self { form, gain, integral_time, derivative_time, integral_gain: 0.0, derivative_gain: 0.0, filter_time })
    }

    /// The ISA form of an ISA or series controller.
    fn as_isa(self) -> IsaPid {
        let Self { gain, derivative_time, .. } = self;
        match self.integral_time {
            Some(integral_time) if self.form == PidForm::Series => {
                SeriesPid { gain, integral_time, derivative_time }.into()
            }
            // Without integral action both forms are the same.
            time => IsaPid { gain, integral_time: time.unwrap_or(f64::INFINITY), derivative_time },
        }
    }
}

/// The numbers of the series form.
fn as_series(isa: IsaPid) -> Result<IsaPid, FormError> {
    if isa.integral_time == f64::INFINITY {
        return Ok(isa);
    }
    let IsaPid { integral_time, derivative_time, .. } = isa;
    let series = SeriesPid::from_isa(isa).ok_or(FormError::ComplexZeros { integral_time, derivative_time })?;
    let SeriesPid { gain, integral_time, derivative_time } = series;
    Ok(IsaPid { gain, integral_time, derivative_time })
}

impl From<GivenPid> for ParallelPid {
    fn from(pid: GivenPid) -> Self {
        match pid.form {
            PidForm::Isa | PidForm::Series => Self { filter: pid.filter_time, ..pid.as_isa().into() },
            PidForm::Parallel => Self {
                proportional: pid.gain,
                integral: pid.integral_gain,
                derivative: pid.derivative_gain,
                filter: pid.filter_time,
            },
        }
    }
}

impl From<IsaPid> for GivenPid {
    fn from(IsaPid { gain, integral_time, derivative_time }: IsaPid) -> Self {
        let integral_time = Some(integral_time).filter(|time| time.is_finite());
        Self { gain, integral_time, derivative_time, ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::linear::Complex;

    fn pid(form: PidForm, gain: f64, integral_time: f64, derivative_time: f64) -> GivenPid {
        GivenPid { form, gain, integral_time: Some(integral_time), derivative_time, ..GivenPid::default() }
    }

    #[test]
    fn a_series_controller_is_its_two_factors_and_has_the_other_forms() {
        // 2 (1 + 1/(5 s)) (1 + 2 s): K = 2.8, Ti = 7, Td = 10/7.
        let series = pid(PidForm::Series, 2.0, 5.0, 2.0);
        let s = Complex::new(0.0, 0.3);
        let expected = (Complex::ONE + (s * 5.0).inv()) * (Complex::ONE + s * 2.0) * 2.0;
        let isa = series.in_form(PidForm::Isa).unwrap();
        assert_relative_eq!(isa.gain, 2.8, max_relative = 1e-14);
        assert_relative_eq!(isa.integral_time.unwrap(), 7.0, max_relative = 1e-14);
        for form in PidForm::ALL {
            let same = series.in_form(form).unwrap();
            assert_eq!(same.form, form);
            assert_relative_eq!((ParallelPid::from(same).ideal_at(0.3) - expected).norm(), 0.0, epsilon = 1e-14);
            assert_relative_eq!(same.filter_in_force(), 0.1 / 7.0, max_relative = 1e-12);
            let back = same.in_form(PidForm::Series).unwrap();
            assert_relative_eq!(back.integral_time.unwrap(), 5.0, max_relative = 1e-12);
            assert_relative_eq!(back.derivative_time, 2.0, max_relative = 1e-12);
        }
    }

    #[test]
    fn what_has_no_other_form_says_why() {
        let fault = FormError::ComplexZeros { integral_time: 3.9, derivative_time: 1.0 };
        assert_eq!(pid(PidForm::Isa, 1.0, 3.9, 1.0).in_form(PidForm::Series), Err(fault));
        assert!(pid(PidForm::Isa, 1.0, 4.0, 1.0).in_form(PidForm::Series).is_ok());
        let parallel = |gain, integral_gain, derivative_gain| GivenPid {
            form: PidForm::Parallel,
            gain,
            integral_gain,
            derivative_gain,
            ..GivenPid::default()
        };
        let alone = parallel(0.0, 0.5, 0.0);
        assert_eq!(alone.in_form(PidForm::Isa), Err(FormError::NoProportionalPart));
        assert_eq!((alone.is_open(), ParallelPid::from(alone).integral), (false, 0.5));
        assert_eq!(parallel(2.0, -0.5, 0.0).in_form(PidForm::Isa), Err(FormError::NegativeTime { time: -4.0 }));
        // PD and open loops have every form.
        for form in PidForm::ALL {
            let pd = GivenPid { gain: 2.0, derivative_time: 3.0, ..GivenPid::default() }.in_form(form).unwrap();
            assert_eq!(
                (ParallelPid::from(pd).derivative, pd.in_form(PidForm::Isa).unwrap().integral_time),
                (6.0, None)
            );
            assert!(GivenPid::default().in_form(form).unwrap().is_open());
        }
    }

    #[test]
    fn a_document_of_the_old_kind_is_written_as_it_was() {
        let old = r#"{"gain":1.5,"integral_time":8.0,"derivative_time":0.0}"#;
        let read: GivenPid = serde_json::from_str(old).unwrap();
        assert_eq!((read.form, serde_json::to_string(&read).unwrap()), (PidForm::Isa, old.to_owned()));
    }
}
