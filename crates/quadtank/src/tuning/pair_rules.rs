//! Rules that make a pair of PI or PID controllers from the transfer functions of a plant.

use thiserror::Error;

use super::{Design, ModelRule, ProcessModel, TuningError, TuningRule, poles_off_the_origin, ultimate_point_of};
use crate::control::{IsaPid, PidMatrix};
use crate::linear::{Complex, LinearError, LoopStability, TransferFunction, TransferMatrix};

/// A rule that makes controllers of loops 1 and 2 from a plant whose loop i drives input i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairRule {
    /// Each loop from the ultimate point of its element alone.
    Ultimate(TuningRule),
    /// BLT, biggest log modulus tuning (Luyben 1986, Ind. Eng. Chem. Process Des. Dev. 25, 654–660): the settings of Ziegler and
    /// Nichols (1942) with all gains divided and all integral times multiplied by one factor, with which the biggest closed-loop log
    /// modulus of the pair is 4 dB.
    Blt,
    /// SIMC (Skogestad 2003, J. Process Control 13, 291–309): each element as a first-order model by the half rule, with the closed-loop
    /// time constant τc = θ of a tight loop.
    Simc,
    /// PID by internal model control (Rivera, Morari and Skogestad 1986, Ind. Eng. Chem. Process Des. Dev. 25, 252–265) of the same
    /// model: `K = (2 τ + θ)/(k (2 λ + θ))`, `Ti = τ + θ/2`, `Td = τ θ/(2 τ + θ)`, with λ the larger of 0.8 θ and 0.1 τ.
    Imc,
}

/// Why a rule makes no controllers of a plant.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum PairRuleError {
    /// The element of a loop has no ultimate point.
    #[error("element {number}{number} has no ultimate point: no gain makes the loop oscillate")]
    NoUltimatePoint {
        /// Number of the loop, 1 or 2.
        number: usize,
    },
    /// The element of a loop has poles or zeros that no first-order model with dead time has.
    #[error(
        "element {number}{number} has complex poles or zeros in the left half-plane, which the half rule does not reduce"
    )]
    NotReducible {
        /// Number of the loop.
        number: usize,
    },
    /// An element integrates, and the rule needs a gain at rest.
    #[error("element {number}{number} integrates, and the rule needs a gain at rest")]
    Integrating {
        /// Number of the loop.
        number: usize,
    },
    /// The model of an element has no dead time, so that nothing limits the gain.
    #[error("the model of element {number}{number} has no dead time, so that nothing limits the gain")]
    NoDeadTime {
        /// Number of the loop.
        number: usize,
    },
    /// No factor up to the largest one brings the log modulus down.
    #[error("the log modulus stays above {target_db} dB with factors up to {largest_factor}")]
    NotDetuned {
        /// The log modulus wanted (dB).
        target_db: f64,
        /// The largest factor tried.
        largest_factor: f64,
    },
    /// What is wrong with the plant.
    #[error(transparent)]
    Plant(#[from] TuningError),
}

impl From<LinearError> for PairRuleError {
    fn from(error: LinearError) -> Self {
        Self::Plant(error.into())
    }
}

/// 2 dB for each of two loops.
const LOG_MODULUS_DB: f64 = 4.0;
/// Largest factor of the BLT method; Luyben's examples need 2 to 5.
const LARGEST_FACTOR: f64 = 1024.0;
/// Halvings of the logarithm of the factor, which leave less than 1e-6 of it.
const HALVINGS: u32 = 20;
/// Imaginary part, relative to the magnitude, below which a pole is real: rounding parts n equal poles by about the n-th root of ε, which
/// is 1e-4 for four.
const REAL: f64 = 1e-3;
/// λ of internal model control relative to dead time and time constant.
const IMC_LAMBDA: [f64; 2] = [0.8, 0.1];

impl PairRule {
    /// The rules that are compared: all but the P controller of Ziegler and Nichols, which leaves an offset.
    pub const ALL: [Self; 8] = [
        Self::Ultimate(TuningRule::ZieglerNicholsPi),
        Self::Ultimate(TuningRule::ZieglerNichols1942Pi),
        Self::Ultimate(TuningRule::ZieglerNicholsPid),
        Self::Ultimate(TuningRule::TyreusLuybenPi),
        Self::Ultimate(TuningRule::TyreusLuybenPid),
        Self::Blt,
        Self::Simc,
        Self::Imc,
    ];

    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ultimate(TuningRule::ZieglerNicholsP) => "ziegler-nichols-p",
            Self::Ultimate(TuningRule::ZieglerNicholsPi) => "ziegler-nichols-pi",
            Self::Ultimate(TuningRule::ZieglerNichols1942Pi) => "ziegler-nichols-1942-pi",
            Self::Ultimate(TuningRule::ZieglerNicholsPid) => "ziegler-nichols-pid",
            Self::Ultimate(TuningRule::TyreusLuybenPi) => "tyreus-luyben-pi",
            Self::Ultimate(TuningRule::TyreusLuybenPid) => "tyreus-luyben-pid",
            Self::Blt => "blt",
            Self::Simc => "simc",
            Self::Imc => "imc",
        }
    }

    /// The settings of both loops, in the unit of time of the plant.
    ///
    /// # Errors
    /// [`PairRuleError`] for a plant of which the rule makes nothing.
    ///
    /// # Examples
    /// ```
    /// use quadtank::literature::campestrini::PublishedPlant;
    /// use quadtank::tuning::PairRule;
    ///
    /// // Luyben (1986) prints 0.375, 8.29 and −0.075, 23.6 for the column of Wood and Berry.
    /// let [first, second] = PairRule::Blt.settings(&PublishedPlant::WoodBerry.transfer_matrix()?)?;
    /// assert!((first.gain - 0.375).abs() < 0.005 && (first.integral_time - 8.29).abs() < 0.1);
    /// assert!((second.gain + 0.075).abs() < 0.001 && (second.integral_time - 23.6).abs() < 0.3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn settings(self, plant: &TransferMatrix) -> Result<[IsaPid; 2], PairRuleError> {
        let [[g11, _], [_, g22]] = &plant.0;
        let each =
            |of: &dyn Fn(&TransferFunction, usize) -> Result<IsaPid, PairRuleError>| Ok([of(g11, 1)?, of(g22, 2)?]);
        match self {
            Self::Ultimate(rule) => each(&|element, number| from_ultimate_point(element, number, rule)),
            Self::Blt => detuned(
                plant,
                each(&|element, number| from_ultimate_point(element, number, TuningRule::ZieglerNichols1942Pi))?,
            ),
            Self::Simc => each(&|element, number| {
                let model = reduced(element, number)?;
                let rule = ModelRule::Simc { closed_loop_time_s: model.dead_time_s() };
                rule.settings(&model).map_err(|_| PairRuleError::NoDeadTime { number })
            }),
            Self::Imc => each(&|element, number| {
                let model = reduced(element, number)?;
                internal_model_control(&model).ok_or(PairRuleError::Integrating { number })
            }),
        }
    }
}

fn from_ultimate_point(element: &TransferFunction, number: usize, rule: TuningRule) -> Result<IsaPid, PairRuleError> {
    let point = ultimate_point_of(element)?.ok_or(PairRuleError::NoUltimatePoint { number })?;
    Ok(rule.settings(point))
}

/// Settings with gains divided and integral times multiplied by the factor of the BLT method; by 1 where the log modulus is not above
/// the one wanted anyway.
fn detuned(plant: &TransferMatrix, settings: [IsaPid; 2]) -> Result<[IsaPid; 2], PairRuleError> {
    // The factor of BLT and the detuning factor f of Campestrini (2006, eqs. 92, 93) are the same for PI.
    let with = |factor: f64| settings.map(|pid| pid.detuned(factor));
    let is_enough = |factor: f64| -> Result<bool, TuningError> {
        let design = Design::new(plant, PidMatrix::decentralised(with(factor).map(Into::into)))?;
        let is_stable = design.stability() == LoopStability::Stable;
        Ok(is_stable && design.biggest_log_modulus().is_some_and(|peak| peak.value <= LOG_MODULUS_DB))
    };
    if is_enough(1.0)? {
        return Ok(settings);
    }
    let (mut low, mut high) = (1.0_f64, 2.0_f64);
    while !is_enough(high)? {
        (low, high) = (high, 2.0 * high);
        if high > LARGEST_FACTOR {
            return Err(PairRuleError::NotDetuned { target_db: LOG_MODULUS_DB, largest_factor: LARGEST_FACTOR });
        }
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if is_enough(middle)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(with(high))
}

/// An element with real poles as a first-order model, or an integrator, with dead time by the half rule; zeros in the right half-plane
/// count as dead time (Skogestad 2003, Eq. 10).
fn reduced(element: &TransferFunction, number: usize) -> Result<ProcessModel, PairRuleError> {
    let fault = PairRuleError::NotReducible { number };
    let poles = poles_off_the_origin(element)?;
    let integrators = element.integrators();
    let is_lag = |pole: &Complex| pole.re < 0.0 && pole.im.abs() <= REAL * pole.norm();
    if poles.len() + integrators as usize == 0 || integrators > 1 || !poles.iter().all(is_lag) {
        return Err(fault);
    }
    let lags: Vec<f64> = poles.iter().map(|pole| -pole.re.recip()).collect();
    let zeros = TransferFunction::new(vec![1.0], element.numerator().to_vec(), 0.0).and_then(|inverse| inverse.poles());
    let zeros = zeros.map_err(|_| fault)?;
    if zeros.iter().any(|zero| zero.re <= 0.0) {
        return Err(fault);
    }
    let inverse_response: f64 = zeros.iter().map(|zero| zero.finv().re).sum();
    let (gain, dead_time) = (element.rest_gain(), element.dead_time() + inverse_response);
    Ok(match integrators {
        0 => ProcessModel::by_half_rule(gain, &lags, dead_time),
        _ => ProcessModel::integrating_by_half_rule(gain, &lags, dead_time),
    })
}

/// PID of a self-regulating model by internal model control; `None` for an integrator.
fn internal_model_control(model: &ProcessModel) -> Option<IsaPid> {
    let (gain, time, dead_time) = (model.gain()?, model.time_constant_s()?, model.dead_time_s());
    let lambda = (IMC_LAMBDA[0] * dead_time).max(IMC_LAMBDA[1] * time);
    let sum = 2.0 * time + dead_time;
    Some(IsaPid {
        gain: sum / (gain * (2.0 * lambda + dead_time)),
        integral_time: 0.5 * sum,
        derivative_time: time * dead_time / sum,
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::literature::campestrini::PublishedPlant;

    fn diagonal(element: TransferFunction) -> TransferMatrix {
        let nothing = TransferFunction::lags(0.0, &[1.0], 0.0).unwrap();
        TransferMatrix([[element.clone(), nothing.clone()], [nothing, element]])
    }

    fn first(rule: PairRule, element: TransferFunction) -> Result<IsaPid, PairRuleError> {
        rule.settings(&diagonal(element)).map(|[first, _]| first)
    }

    #[test]
    fn blt_settings_have_a_log_modulus_of_four_decibels() {
        let plant = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
        let settings = PairRule::Blt.settings(&plant).unwrap();
        let design = Design::new(&plant, PidMatrix::decentralised(settings.map(Into::into))).unwrap();
        assert_relative_eq!(design.biggest_log_modulus().unwrap().value, 4.0, max_relative = 1e-4);
        // One factor for all.
        let [one, two] = PairRule::Ultimate(TuningRule::ZieglerNichols1942Pi).settings(&plant).unwrap();
        let factor = one.gain / settings[0].gain;
        assert_relative_eq!(two.gain / settings[1].gain, factor, max_relative = 1e-12);
        assert_relative_eq!(settings[1].integral_time / two.integral_time, factor, max_relative = 1e-12);
    }

    #[test]
    fn blt_detunes_what_ziegler_and_nichols_tune_tightly() {
        // Of a slow lag with a dead time Ziegler and Nichols leave far more than 2 dB for each loop.
        let element = TransferFunction::lags(2.0, &[10.0], 1.0).unwrap();
        let plain = first(PairRule::Ultimate(TuningRule::ZieglerNichols1942Pi), element.clone()).unwrap();
        let detuned = first(PairRule::Blt, element).unwrap();
        assert!(detuned.gain < plain.gain && detuned.integral_time > plain.integral_time);
    }

    /// Skogestad (2003), case E1, `1/((s + 1)(0.2 s + 1))`: τ = 1.1 and θ = 0.1 by the half rule, PI with Kc = 5.5 and τI = 0.8.
    #[test]
    fn simc_settings_follow_the_half_rule() {
        let settings = first(PairRule::Simc, TransferFunction::lags(1.0, &[1.0, 0.2], 0.0).unwrap()).unwrap();
        assert_relative_eq!(settings.gain, 5.5, max_relative = 1e-9);
        assert_relative_eq!(settings.integral_time, 0.8, max_relative = 1e-9);
        // A zero in the right half-plane is a dead time.
        let inverse = TransferFunction::new(vec![1.0, -3.0], vec![1.0, 30.0], 1.0).unwrap();
        let settings = first(PairRule::Simc, inverse).unwrap();
        assert_relative_eq!(settings.gain, 30.0 / 8.0, max_relative = 1e-9);
    }

    #[test]
    fn internal_model_control_of_a_lag_and_a_dead_time() {
        let element = TransferFunction::lags(2.0, &[10.0], 4.0).unwrap();
        let settings = first(PairRule::Imc, element).unwrap();
        assert_relative_eq!(settings.gain, 24.0 / (2.0 * (2.0 * 3.2 + 4.0)), max_relative = 1e-9);
        assert_relative_eq!(settings.integral_time, 12.0, max_relative = 1e-9);
        assert_relative_eq!(settings.derivative_time, 40.0 / 24.0, max_relative = 1e-9);
    }

    #[test]
    fn integrating_elements_have_the_rules_for_integrators() {
        // 0.2 e^(−3 s)/s: SIMC with τc = θ is 1/(k′ 2 θ) and 8 θ; 4θ and π/(2 k′ θ) are the ultimate point.
        let element = TransferFunction::new(vec![0.2], vec![0.0, 1.0], 3.0).unwrap();
        let settings = first(PairRule::Simc, element.clone()).unwrap();
        assert_relative_eq!(settings.gain, 1.0 / (0.2 * 6.0), max_relative = 1e-12);
        assert_relative_eq!(settings.integral_time, 24.0, max_relative = 1e-12);
        let point = ultimate_point_of(&element).unwrap().unwrap();
        assert_relative_eq!(point.gain, std::f64::consts::FRAC_PI_2 / 0.6, max_relative = 1e-9);
        assert_relative_eq!(point.period, 12.0, max_relative = 1e-9);
        assert_eq!(first(PairRule::Imc, element), Err(PairRuleError::Integrating { number: 1 }));
    }

    #[test]
    fn what_a_rule_cannot_take_is_named() {
        let lag = TransferFunction::lags(1.0, &[5.0], 0.0).unwrap();
        let refused = |rule: PairRule, element: &TransferFunction| first(rule, element.clone()).unwrap_err();
        assert_eq!(refused(PairRule::Blt, &lag), PairRuleError::NoUltimatePoint { number: 1 });
        assert_eq!(refused(PairRule::Simc, &lag), PairRuleError::NoDeadTime { number: 1 });
        let resonant = TransferFunction::new(vec![1.0], vec![1.0, 0.2, 1.0], 1.0).unwrap();
        assert_eq!(refused(PairRule::Imc, &resonant), PairRuleError::NotReducible { number: 1 });
        let leading = TransferFunction::new(vec![1.0, 3.0], vec![1.0, 7.0, 10.0], 1.0).unwrap();
        assert_eq!(refused(PairRule::Simc, &leading), PairRuleError::NotReducible { number: 1 });
        // Equal poles are parted by rounding, and real all the same.
        assert!(first(PairRule::Simc, TransferFunction::lags(1.0, &[5.0; 4], 1.0).unwrap()).is_ok());
    }
}
