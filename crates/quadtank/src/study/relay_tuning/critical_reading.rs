use crate::linear::Margins;
use crate::tuning::{CriticalPoint, GainLimit, TuningError, importance_direction};

use super::{Designed, LoopPeaks, Results};

/// Importances below this, and above its reciprocal, are on the axes.
const SMALLEST_IMPORTANCE: f64 = 1e-6;

/// What is sought along the critical curve and the loci for the texts of a session. It takes as long as a whole design, so it is
/// not part of the [`Results`] of every frame.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalReading {
    /// Magnitude of the importance r2 of the critical point that is chosen; `None` where it is 0/0, as for gains of zero.
    pub importance: Option<f64>,
    /// What bounds the gains in the direction of that importance, or of equal importance where there is none.
    pub limit: GainLimit,
    /// The point of the curve that is nearest to the chosen one.
    pub on_curve: Option<CriticalPoint>,
    /// How far from −1 the loci of the chosen root stay; `None` where there is no design, and where the search is beyond its bound
    /// on work.
    pub margins: Option<Margins>,
    /// The peaks of the loop with that root; `None` where there is no design.
    pub peaks: Option<LoopPeaks>,
}

impl CriticalReading {
    /// The reading of results.
    ///
    /// # Errors
    /// The error of the study of the plant; as [`Design::new`](crate::tuning::Design::new).
    pub fn of(results: &Results) -> Result<Self, TuningError> {
        let study = results.study.as_ref().as_ref().map_err(|&error| error)?;
        let importance = results.setup.importance().ok().filter(|r| !r.is_nan()).map(f64::abs);
        // A gain of zero has a direction too: nearly that of the axis.
        let direction = importance.map_or(1.0, |r| r.clamp(SMALLEST_IMPORTANCE, SMALLEST_IMPORTANCE.recip()));
        let design = results.design.as_ref().as_ref().ok().and_then(Option::as_ref);
        let root = design.map(Designed::chosen_root);
        let critical = design.and_then(|design| design.critical);
        Ok(Self {
            importance,
            limit: study.search.limit(importance_direction(&study.rest_gain, direction)),
            on_curve: critical.and_then(|critical| study.search.nearest(critical.gains)),
            margins: root.map(|root| study.margins(root)).transpose()?.flatten(),
            peaks: root.map(|root| study.peaks(root)).transpose()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;
    use crate::study::relay_tuning::{CriticalSpec, RelayTuningStudy, TuningSetup};

    fn reading(setup: &TuningSetup) -> CriticalReading {
        CriticalReading::of(&RelayTuningStudy::update(setup, &[], None)).unwrap()
    }

    #[test]
    fn a_point_of_the_curve_is_its_own_nearest_point() {
        let mut setup = TuningSetup::default();
        setup.design.critical = CriticalSpec::Importance(1.0);
        let found = reading(&setup);
        let GainLimit::Oscillation(limit) = found.limit else { panic!("{:?}", found.limit) };
        let on_curve = found.on_curve.unwrap();
        assert!((on_curve.frequency / limit.frequency - 1.0).abs() < 1e-6);
        assert!(found.importance == Some(1.0) && found.margins.is_some());
    }

    #[test]
    fn gains_of_zero_have_no_importance() {
        let mut setup = TuningSetup::default();
        setup.design.critical = CriticalSpec::Point { gains: [0.0, 0.0], period: 10.0 };
        assert_eq!(reading(&setup).importance, None);
    }
}
