use quadtank::control::{Pairing, ParallelPid};
use quadtank::linear::{LociClosure, LoopStability};
use quadtank::sim::{Halt, StepMetrics};
use quadtank::study::relay_tuning::{
    ComparedControllers, Comparison, ControllerAssessment, DesignRoot, Designed, GivenPid, PlantStudy, RuleControllers,
};
use quadtank::tuning::{PlacementWarning, TuningError};
use serde::Serialize;

use super::TOO_MUCH_WORK;
use crate::report::{ComplexNumber, rows};

/// Why stability or margins are not computed.
const NOT_COMPUTED: &str = "the loci turn too often before the gain of the loop becomes small";

/// The controllers of a session: both roots of a placement of the critical point, or given ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DesignReport {
    /// Critical frequency (rad per unit of time); null with given controllers where the critical curve has no ultimate point for
    /// the importance r2 of the session.
    pub frequency: Option<f64>,
    /// G(jω) there, by rows (outputs per input); null likewise.
    pub g: Option<[[ComplexNumber; 2]; 2]>,
    /// Λ11(jω) = g11 g22/det G there (no unit); null likewise.
    pub dynamic_relative_gain_11: Option<ComplexNumber>,
    /// Root 1, with the larger controller in loop 1, and root 2; given controllers alone.
    pub roots: Vec<RootReport>,
    /// Number of the root of the response, 1 or 2; 1 for given controllers.
    pub chosen: usize,
    /// Figures of outputs 1 and 2 in the response with this root.
    pub figures: [FiguresReport; 2],
    /// Why the response ended before its time; null for a whole one.
    pub response_halted: Option<HaltReport>,
    /// What the response is compared with; null for nothing.
    pub comparison: Option<ComparisonReport>,
}

/// A pair of controllers, which is one root of a placement, the given pair, or that of a relay test, and the closed loop with it; no decoupler acts.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RootReport {
    /// Controllers of loops 1 and 2.
    pub controllers: [Gains; 2],
    /// Which input of the plant each of them drives; diagonal for a placement.
    pub pairing: Pairing,
    /// What to beware of.
    pub warnings: Vec<PlacementWarning>,
    /// Whether the loop is stable.
    pub stability: LoopStabilityReport,
    /// Why there are no margins, in words; null where there are.
    pub margins_not_computed: Option<&'static str>,
    /// Shortest distance of a locus from −1 (no unit); null where margins are not computed.
    pub distance_from_minus_one: Option<f64>,
    /// Smallest factor above 1 on all gains at which a locus reaches −1 (no unit); null where there is none or it is not computed.
    pub gain_margin: Option<f64>,
    /// Largest factor below 1 at which one does (no unit); null where there is none or it is not computed.
    pub lower_gain_margin: Option<f64>,
    /// Smallest phase lag in all loops at which a locus reaches −1 (rad); null where there is none or it is not computed.
    pub phase_margin_rad: Option<f64>,
    /// Largest singular value of the sensitivity over all frequencies, Ms (no unit); null where the loop is not stable or it is not
    /// computed.
    pub sensitivity_peak: Option<f64>,
    /// Biggest closed-loop log modulus Lc (dB); null where the loop is open or not stable, or it is not computed.
    pub biggest_log_modulus_db: Option<f64>,
    /// How the loci close.
    pub closure: LociClosure,
}

/// Controllers that are published for the plant, in the experiment of the session without a decoupler.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PublishedControllersReport {
    /// The name of their case.
    pub case: &'static str,
    /// Where they are printed.
    pub source: &'static str,
    /// Controllers of loops 1 and 2.
    pub controllers: [Gains; 2],
    /// Whether the loop is stable.
    pub stability: LoopStabilityReport,
    /// Largest singular value of the sensitivity over all frequencies, Ms (no unit); null where the loop is not stable or it is not
    /// computed.
    pub sensitivity_peak: Option<f64>,
    /// Biggest closed-loop log modulus Lc (dB); null where the loop is not stable or it is not computed.
    pub biggest_log_modulus_db: Option<f64>,
    /// Figures of outputs 1 and 2 in the response; null where it does not stay bounded.
    pub figures: Option<[FiguresReport; 2]>,
}

/// What a rule makes of the plant in the pairing of the session, in the experiment of the session without a decoupler.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RuleReport {
    /// The name of the rule.
    pub rule: &'static str,
    /// Why it makes no controllers; null where it does.
    pub refused: Option<String>,
    /// Controllers of loops 1 and 2, as a document gives them.
    pub controllers: Option<[GivenPid; 2]>,
    /// Whether the loop is stable.
    pub stability: Option<LoopStabilityReport>,
    /// Largest singular value of the sensitivity over all frequencies, Ms (no unit).
    pub sensitivity_peak: Option<f64>,
    /// Biggest closed-loop log modulus Lc (dB).
    pub biggest_log_modulus_db: Option<f64>,
    /// Figures of outputs 1 and 2 in the response; null where it does not stay bounded.
    pub figures: Option<[FiguresReport; 2]>,
}

/// Other controllers on the same plant, and what they do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparisonReport {
    /// The controllers, row by input, column by output.
    pub controllers: [[Gains; 2]; 2],
    /// Whether the loop is stable.
    pub stability: LoopStabilityReport,
    /// Figures of outputs 1 and 2 in the response.
    pub figures: [FiguresReport; 2],
    /// Why the response ended before its time; null for a whole one.
    pub response_halted: Option<HaltReport>,
}

/// A parallel PID controller kp + ki/s + kd s/(Tf s + 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Gains {
    /// Proportional gain (inputs per output).
    pub kp: f64,
    /// Integral gain (inputs per output and unit of time).
    pub ki: f64,
    /// Derivative gain (inputs per output, times units of time); 0 for PI.
    pub kd: f64,
    /// Time constant Tf of the derivative filter (units of time); 0 for PI.
    pub tf: f64,
}

/// Stability of a loop, by the number of encirclements of −1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum LoopStabilityReport {
    /// Poles in the right half-plane.
    Unstable {
        /// Whether the loop is stable: false.
        stable: bool,
        /// Number of poles in the right half-plane.
        right_half_plane_poles: u32,
    },
    /// A locus passes through −1, to rounding: an oscillation that stays.
    Marginal {
        /// Whether the loop is stable: false.
        stable: bool,
        /// Its frequency (rad per unit of time); 0 for a pole at the origin.
        marginal_at: f64,
    },
    /// The loop closes through direct feedthrough of the plant, and an eigenvalue of L(∞) is −1 or beyond: no signals fulfil its
    /// equations, or any lag, however short, makes them grow.
    AlgebraicLoop {
        /// Whether the loop is stable: false.
        stable: bool,
        /// Real part of that eigenvalue (no unit).
        eigenvalue_at_infinity: f64,
    },
    /// Encirclements that are too many to count.
    NotComputed {
        /// Whether the loop is stable: null.
        stable: (),
        /// Why, in words.
        not_computed: &'static str,
        /// Frequency up to which the loop has to be followed (rad per unit of time); null where its gain never becomes small.
        gain_up_to: Option<f64>,
    },
    /// No pole in the right half-plane.
    Stable {
        /// Whether the loop is stable: true.
        stable: bool,
    },
}

/// Figures of one output after a step of the references.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FiguresReport {
    /// By how much it passes its reference, as a share of it (no unit); null for a reference of 0.
    pub overshoot: Option<f64>,
    /// When it enters the band of 2 % for good (units of time); null for a reference of 0, or if it does not.
    pub settling_time_2_percent: Option<f64>,
    /// Largest distance from a reference of 0 (units of the output); null for any other.
    pub peak: Option<f64>,
    /// Integral of the absolute error (units of the output times units of time).
    pub iae: f64,
}

/// Why a response ended before its time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum HaltReport {
    /// A relay switched again and again at once.
    Chattering {
        /// Number of the loop, 1 or 2.
        #[serde(rename = "loop")]
        number: usize,
        /// When (units of time).
        time: f64,
    },
    /// An output left all bounds.
    Diverged {
        /// When (units of time).
        time: f64,
    },
    /// It took as much work as it may.
    Full {
        /// When (units of time).
        time: f64,
        /// Why, in words.
        reason: &'static str,
    },
}

impl DesignReport {
    pub(super) fn of(study: &PlantStudy, design: &Designed) -> Result<Self, TuningError> {
        let critical = design.critical;
        Ok(Self {
            frequency: critical.map(|critical| critical.frequency),
            g: critical.map(|critical| rows(&critical.g)),
            dynamic_relative_gain_11: critical.map(|critical| critical.dynamic_relative_gain_11.into()),
            roots: design.roots.iter().map(|root| RootReport::of(study, root)).collect::<Result<_, _>>()?,
            chosen: design.chosen + 1,
            figures: design.response.figures.map(FiguresReport::from),
            response_halted: design.response.trace.halt.map(HaltReport::from),
            comparison: design.comparison.as_ref().map(ComparisonReport::from),
        })
    }
}

impl RootReport {
    pub(super) fn of(study: &PlantStudy, root: &DesignRoot) -> Result<Self, TuningError> {
        let (margins, peaks) = (study.margins(root)?, study.peaks(root)?);
        Ok(Self {
            controllers: root.controllers.map(Gains::from),
            pairing: root.pairing,
            warnings: root.warnings.clone(),
            stability: root.stability.into(),
            margins_not_computed: margins.is_none().then_some(NOT_COMPUTED),
            distance_from_minus_one: margins.map(|margins| margins.distance),
            gain_margin: margins.and_then(|margins| margins.gain_up),
            lower_gain_margin: margins.and_then(|margins| margins.gain_down),
            phase_margin_rad: margins.and_then(|margins| margins.phase),
            sensitivity_peak: peaks.sensitivity.map(|peak| peak.value),
            biggest_log_modulus_db: peaks.log_modulus.map(|peak| peak.value),
            closure: root.closure,
        })
    }
}

impl From<&RuleControllers> for RuleReport {
    fn from(ruled: &RuleControllers) -> Self {
        let judged = ruled.outcome.as_ref().ok().map(|(_, judged)| judged);
        Self {
            rule: ruled.rule.name(),
            refused: ruled.outcome.as_ref().err().map(ToString::to_string),
            controllers: ruled.outcome.ok().map(|(controllers, _)| controllers),
            stability: judged.map(|judged| judged.stability.into()),
            sensitivity_peak: judged.and_then(|judged| Some(judged.peaks.sensitivity?.value)),
            biggest_log_modulus_db: judged.and_then(|judged| Some(judged.peaks.log_modulus?.value)),
            figures: judged.filter(|judged| judged.is_bounded).map(|judged| judged.figures.map(FiguresReport::from)),
        }
    }
}

impl From<&ComparedControllers> for PublishedControllersReport {
    fn from(compared: &ComparedControllers) -> Self {
        let ComparedControllers { published, judged } = compared;
        let ControllerAssessment { stability, peaks, figures, is_bounded } = judged;
        Self {
            case: published.name(),
            source: published.source(),
            controllers: published.gains().map(Gains::from),
            stability: (*stability).into(),
            sensitivity_peak: peaks.sensitivity.map(|peak| peak.value),
            biggest_log_modulus_db: peaks.log_modulus.map(|peak| peak.value),
            figures: is_bounded.then(|| figures.map(FiguresReport::from)),
        }
    }
}

impl From<&Comparison> for ComparisonReport {
    fn from(comparison: &Comparison) -> Self {
        Self {
            controllers: comparison.controllers.0.map(|row| row.map(Gains::from)),
            stability: comparison.stability.into(),
            figures: comparison.response.figures.map(FiguresReport::from),
            response_halted: comparison.response.trace.halt.map(HaltReport::from),
        }
    }
}

impl From<ParallelPid> for Gains {
    fn from(pid: ParallelPid) -> Self {
        Self { kp: pid.proportional, ki: pid.integral, kd: pid.derivative, tf: pid.filter_time() }
    }
}

impl From<LoopStability> for LoopStabilityReport {
    fn from(stability: LoopStability) -> Self {
        match stability {
            LoopStability::Stable => Self::Stable { stable: true },
            LoopStability::Unstable { poles } => Self::Unstable { stable: false, right_half_plane_poles: poles },
            LoopStability::Marginal { frequency } => Self::Marginal { stable: false, marginal_at: frequency },
            LoopStability::AlgebraicLoop { eigenvalue } => {
                Self::AlgebraicLoop { stable: false, eigenvalue_at_infinity: eigenvalue }
            }
            LoopStability::NotComputed { frequency } => Self::NotComputed {
                stable: (),
                not_computed: NOT_COMPUTED,
                gain_up_to: frequency.is_finite().then_some(frequency),
            },
        }
    }
}

impl From<StepMetrics> for FiguresReport {
    fn from(figures: StepMetrics) -> Self {
        Self {
            overshoot: figures.overshoot,
            settling_time_2_percent: figures.settling_time,
            peak: figures.peak,
            iae: figures.iae,
        }
    }
}

impl From<Halt> for HaltReport {
    fn from(halt: Halt) -> Self {
        match halt {
            Halt::Chattering { relay, time } => Self::Chattering { number: relay + 1, time },
            Halt::Diverged { time } => Self::Diverged { time },
            Halt::Full { time } => Self::Full { time, reason: TOO_MUCH_WORK },
        }
    }
}
