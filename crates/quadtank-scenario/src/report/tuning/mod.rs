//! What a relay-tuning session finds, version 2. Times are in the unit of the plant, frequencies in rad per unit of time.

mod design;
mod test;

use quadtank::linear::{MatrixPolesAndZeros, TransferFunction};
use quadtank::study::relay_tuning::{PlantStudy, SteadyState, Tuning, TuningSetup};
use quadtank::tuning::{Corner, CurvePoint, GainLimit, TuningError};
use serde::Serialize;

pub use design::{
    ComparisonReport, DesignReport, FiguresReport, Gains, HaltReport, LoopStabilityReport, PublishedControllersReport,
    RootReport, RuleReport,
};
pub use test::{
    DistanceReport, Found, LimitCycleReport, LoopTestReport, OscillationReport, ReadingReport, SequentialStepReport,
    Settings, TestReport, Verdict, VerdictDetail,
};

use super::{Answer, ComplexNumber, complex_numbers, rows};
use crate::tuning::{TuningWarning, warnings};

/// Why a record ends before its time.
const TOO_MUCH_WORK: &str = "not computed to its end, because the plant is too quick for so long a record: shorten the \
                             duration, lengthen the step, or leave out quick poles";

/// What follows from the plant of a session alone.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TuningAnalysisReport {
    /// G(0), by rows (outputs per input); null for an integrating element, whose gain is infinite.
    pub dc_gain: [[Option<f64>; 2]; 2],
    /// How often each element integrates, by rows (no unit).
    pub integrators: [[u32; 2]; 2],
    /// The limit of sⁿ g(s) for s → 0 of an element that integrates n times, by rows (outputs per input and unit of time to the power
    /// n): the rate of its output for a constant input. g(0) for other elements.
    pub rest_gain: [[f64; 2]; 2],
    /// Direct feedthrough G(∞) without dead times, by rows (outputs per input); 0 for strictly proper elements.
    pub feedthrough: [[f64; 2]; 2],
    /// λ11 of the relative gain array at steady state (no unit), for integrating elements its limit for s → 0; an error where that is
    /// not finite.
    pub rga_11: Answer<f64>,
    /// Niederlinski index of the diagonal pairing (no unit); null where it is not defined.
    pub niederlinski_diagonal: Option<f64>,
    /// Poles of a minimal realisation (1/unit of time); null where dead times do not leave det G(s) as a whole, and it has zeros
    /// without number.
    pub poles: Option<Vec<ComplexNumber>>,
    /// Transmission zeros (1/unit of time); null as the poles, and where det G(s) is zero at every frequency.
    pub zeros: Option<Vec<ComplexNumber>>,
    /// The boundary of the stable gains of two proportional loops, from loop 1 alone to loop 2 alone; an error where a loop has
    /// no gain of its own.
    pub critical_curve: Answer<Vec<CurvePointReport>, TuningError>,
    /// Corners of that curve, in the same order.
    pub corners: Answer<Vec<CornerReport>, TuningError>,
    /// What the session may not have been meant to say.
    pub warnings: Vec<TuningWarning>,
}

/// One direction of the critical curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CurvePointReport {
    /// Angle in the plane of the normalised gains k1 g11(0), k2 g22(0) (rad, 0 to π/2).
    pub angle_rad: f64,
    /// What bounds the gains there.
    pub limit: LimitReport,
}

/// What bounds the stable gains in a direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum LimitReport {
    /// A pair of poles on the imaginary axis: an ultimate point.
    Oscillation {
        /// Gains kc1, kc2 of the loops (inputs per output).
        gains: [f64; 2],
        /// Period Tc of the oscillation (units of time).
        period: f64,
    },
    /// A real pole at the origin: beyond it the loop drifts away without an oscillation.
    RealPole {
        /// Gains k1, k2 of the loops (inputs per output).
        gains: [f64; 2],
    },
    /// The loop closes through direct feedthrough of the plant: with these gains an eigenvalue of L(∞) is −1.
    AlgebraicLoop {
        /// Gains k1, k2 of the loops (inputs per output).
        gains: [f64; 2],
    },
    /// Nothing: every gain is stable.
    None,
}

/// Where both loci pass −1 at different frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CornerReport {
    /// Importance r2 of loop 2 (no unit).
    pub importance: f64,
    /// Gains kc1, kc2 of the loops (inputs per output).
    pub gains: [f64; 2],
    /// Both periods of the oscillation (units of time), the longer one first.
    pub periods: [f64; 2],
}

/// What test and design of a session find.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TuningReport {
    /// The relay test.
    pub test: TestReport,
    /// The controllers; null where the critical curve has no ultimate point in the direction that a placement asks for.
    pub design: Option<DesignReport>,
    /// Controllers that are published for the plant; empty where there are none.
    pub published_controllers: Vec<PublishedControllersReport>,
    /// What each rule makes of the plant in the pairing of the session.
    pub rules: Vec<RuleReport>,
    /// What the session may not have been meant to say.
    pub warnings: Vec<TuningWarning>,
}

impl TuningAnalysisReport {
    /// What the plant of a session says.
    ///
    /// # Errors
    /// What is wrong with the plant. A loop without a gain of its own is told in place of the curve.
    pub fn of(setup: &TuningSetup) -> Result<Self, TuningError> {
        let matrix = setup.plant.transfer_matrix()?;
        let steady_state = SteadyState::of(&matrix);
        let roots = MatrixPolesAndZeros::of(&matrix)?;
        let curve = match PlantStudy::of(&setup.plant) {
            // A loop without a gain of its own: the axes of the curve have no unit.
            Err(error @ TuningError::NoOwnGain { .. }) => Err(error),
            study => Ok(study?.curve),
        };
        Ok(Self {
            dc_gain: rows(&steady_state.dc_gain.map(|gain| Some(gain).filter(|gain: &f64| gain.is_finite()))),
            integrators: matrix.0.each_ref().map(|row| row.each_ref().map(TransferFunction::integrators)),
            rest_gain: matrix.0.each_ref().map(|row| row.each_ref().map(TransferFunction::rest_gain)),
            feedthrough: rows(&matrix.feedthrough()),
            rga_11: Answer::of(&steady_state.rga_11, |gain| *gain),
            niederlinski_diagonal: steady_state.niederlinski_diagonal,
            poles: roots.as_ref().map(|roots| complex_numbers(&roots.poles)),
            zeros: roots.and_then(|roots| Some(complex_numbers(&roots.zeros?))),
            critical_curve: Answer::of(&curve, |curve| curve.points.iter().map(CurvePointReport::from).collect()),
            corners: Answer::of(&curve, |curve| curve.corners.iter().map(CornerReport::from).collect()),
            warnings: warnings(setup),
        })
    }
}

impl From<&CurvePoint> for CurvePointReport {
    fn from(point: &CurvePoint) -> Self {
        Self { angle_rad: point.angle, limit: point.limit.into() }
    }
}

impl From<GainLimit> for LimitReport {
    fn from(limit: GainLimit) -> Self {
        match limit {
            GainLimit::Oscillation(point) => Self::Oscillation { gains: point.gains, period: point.period() },
            GainLimit::RealPole { gains, .. } => Self::RealPole { gains },
            GainLimit::AlgebraicLoop { gains, .. } => Self::AlgebraicLoop { gains },
            GainLimit::None => Self::None,
        }
    }
}

impl From<&Corner> for CornerReport {
    fn from(corner: &Corner) -> Self {
        let [slow, quick] = corner.points;
        Self { importance: corner.importance, gains: slow.gains, periods: [slow.period(), quick.period()] }
    }
}

impl TuningReport {
    /// The report of what a session finds.
    ///
    /// # Errors
    /// As [`PlantStudy::margins`], [`PlantStudy::recover`] and [`PlantStudy::exact_limit_cycle`].
    pub fn of(setup: &TuningSetup, found: &Tuning) -> Result<Self, TuningError> {
        let design = |design| DesignReport::of(&found.study, design);
        let design = found.design.as_ref().map(design).transpose()?;
        let test = TestReport::of(&found.study, &found.test, &setup.test)?;
        let compared = found.study.compare_published(setup)?;
        let published_controllers = compared.iter().map(PublishedControllersReport::from).collect();
        let rules = found.study.compare_rules(setup).iter().map(RuleReport::from).collect();
        Ok(Self { test, design, published_controllers, rules, warnings: warnings(setup) })
    }
}
