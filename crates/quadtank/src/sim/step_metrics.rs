use super::two_loops::LoopTrace;

/// Share of the reference within which an output has settled.
const BAND: f64 = 0.02;

/// A reference below this share of the largest output is none: shares of it would be rounding errors of the output.
const MIN_REFERENCE: f64 = 1e-9;

/// What a run says of one output. A reference of next to nothing, at most 1e-9 of the largest output, is one of 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepMetrics {
    /// By how much it passes its reference, as a share of it; `None` for a reference of 0.
    pub overshoot: Option<f64>,
    /// When it enters the band of 2 % for good; `None` for a reference of 0, or if it does not within the run.
    pub settling_time: Option<f64>,
    /// Largest distance from a reference of 0; `None` for any other.
    pub peak: Option<f64>,
    /// Integral of the absolute error.
    pub iae: f64,
}

impl LoopTrace {
    /// Figures of both outputs for references that stepped at the start.
    pub fn step_metrics(&self, references: [f64; 2]) -> [StepMetrics; 2] {
        [0, 1].map(|i| self.figures_of(&self.outputs[i], references[i]))
    }

    fn figures_of(&self, outputs: &[f64], reference: f64) -> StepMetrics {
        let rows = || self.time.iter().copied().zip(outputs.iter().copied());
        let pairs = rows().zip(rows().skip(1));
        let iae = pairs.map(|((t, y), (u, z))| 0.5 * (u - t) * ((y - reference).abs() + (z - reference).abs())).sum();
        let peak = outputs.iter().map(|y| y.abs()).fold(0.0, f64::max);
        if reference.abs() <= MIN_REFERENCE * peak || reference == 0.0 {
            return StepMetrics { overshoot: None, settling_time: None, peak: Some(peak), iae };
        }
        let overshoot = outputs.iter().map(|y| y / reference - 1.0).fold(0.0, f64::max);
        let outside = |y: f64| (y - reference).abs() > BAND * reference.abs();
        let settled = self.halt.is_none() && outputs.last().is_some_and(|&y| !outside(y));
        let last = outputs.iter().rposition(|&y| outside(y));
        let settling_time = settled.then(|| last.map_or(0.0, |row| self.time[row + 1]));
        StepMetrics { overshoot: Some(overshoot), settling_time, peak: None, iae }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn figures_of_a_short_run() {
        let trace = LoopTrace {
            time: vec![0.0, 1.0, 2.0, 3.0, 4.0],
            outputs: [vec![0.0, 2.4, 1.8, 2.01, 2.0], vec![0.0, -0.3, 0.1, 0.0, 0.0]],
            ..LoopTrace::default()
        };
        let [first, second] = trace.step_metrics([2.0, 0.0]);
        assert_relative_eq!(first.overshoot.unwrap(), 0.2, max_relative = 1e-14);
        assert_eq!((first.settling_time, first.peak), (Some(3.0), None));
        assert_relative_eq!(first.iae, 1.2 + 0.3 + 0.105 + 0.005, max_relative = 1e-12);
        assert_eq!((second.peak, second.overshoot, second.settling_time), (Some(0.3), None, None));
        let unsettled = LoopTrace { outputs: [vec![0.0, 1.0, 2.0, 2.0, 2.5], vec![0.0; 5]], ..trace };
        assert_eq!(unsettled.step_metrics([2.0, 0.0])[0].settling_time, None);
    }

    #[test]
    fn a_reference_too_small_to_tell_from_zero_is_zero() {
        let outputs = vec![0.0, 0.5, -0.25, 0.0];
        let trace =
            LoopTrace { time: vec![0.0, 1.0, 2.0, 3.0], outputs: [outputs, vec![0.0; 4]], ..LoopTrace::default() };
        for reference in [5e-324, 1e-300, -4e-10] {
            let [first, _] = trace.step_metrics([reference, 0.0]);
            assert_eq!((first.peak, first.overshoot, first.settling_time), (Some(0.5), None, None));
        }
        assert!(trace.step_metrics([6e-10, 0.0])[0].overshoot.is_some_and(f64::is_finite));
    }
}
