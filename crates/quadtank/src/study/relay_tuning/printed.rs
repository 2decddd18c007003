//! What Campestrini (2006) prints for a case, beside what follows from the same plant and point.

use std::f64::consts::TAU;

use crate::control::{ParallelPid, PidMatrix};
use crate::linear::Complex;
use crate::literature::campestrini::{
    PrintedNumber, PublishedCase, PublishedPlacement, RULES, USOL, wood_berry_full_controller,
};
use crate::tuning::{Design, TuningError, TuningRule, UltimatePoint, importance};

use super::{PlantStudy, TuningSetup};

/// A printed number and the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedFigure {
    /// As printed.
    pub printed: PrintedNumber,
    /// Computed from the printed plant and critical point.
    pub computed: f64,
}

/// Share by which digits of a printed period move what is computed from it.
const PERIOD_SHARE: f64 = 5e-4;

impl PrintedFigure {
    /// Whether the computed number is the printed one: within half a unit of its last digit and what the digits of the printed
    /// period leave open.
    pub fn agrees(&self) -> bool {
        let PrintedNumber { value, decimals, .. } = self.printed;
        let half_unit = 0.5 * 0.1_f64.powi(decimals.into());
        (self.computed - value).abs() <= half_unit * 1.000_001 + PERIOD_SHARE * value.abs()
    }
}

/// Printed numbers of a case beside computed ones; `study` is that of its plant.
///
/// # Errors
/// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`].
pub fn printed_figures(case: PublishedCase, study: &PlantStudy) -> Result<Vec<PrintedFigure>, TuningError> {
    let pairs = case.printed().into_iter().zip(computed(case, study)?);
    Ok(pairs.map(|(printed, computed)| PrintedFigure { printed, computed }).collect())
}

fn computed(case: PublishedCase, study: &PlantStudy) -> Result<Vec<f64>, TuningError> {
    let gains = |pids: &[ParallelPid]| pids.iter().flat_map(|k| [k.proportional, k.integral]).collect();
    Ok(match case.table {
        3 => locus_settings(study, case.row)?.to_vec(),
        88 => gains(wood_berry_full_controller().0.as_flattened()),
        4 => {
            let target = RULES[case.row - 1].0.target();
            vec![target.re, target.im]
        }
        0 => {
            let settings = TuningRule::TyreusLuybenPi.settings(USOL.ultimate_point());
            let derivative = TuningRule::TyreusLuybenPid.settings(USOL.ultimate_point()).derivative_time;
            vec![USOL.ultimate_point().gain, settings.gain, settings.integral_time, derivative]
        }
        7 | 13 => point_on_curve(case, study).map_or_else(Vec::new, Vec::from),
        _ => {
            let setup = TuningSetup::published(case);
            let design = study.design(&setup)?;
            design.map_or_else(Vec::new, |design| {
                let chosen = &design.chosen_root().controllers;
                chosen.iter().flat_map(|k| [k.proportional, k.integral, k.derivative]).collect()
            })
        }
    })
}

/// r2 of the printed gains, and the point of the curve in their direction: gains and period.
fn point_on_curve(case: PublishedCase, study: &PlantStudy) -> Option<[f64; 4]> {
    let PublishedPlacement { critical_gains: gains, .. } = case.placement();
    let point = study.search.nearest(gains)?;
    Some([importance(&study.rest_gain, gains), point.gains[0], point.gains[1], point.period()])
}

/// Kc and Tc of a locus of G alone, and PI settings by 0.45 Kc and 0.8 Tc (Campestrini 2006, Table 3): of locus 1 the crossing
/// that the printed period is near to.
fn locus_settings(study: &PlantStudy, row: usize) -> Result<[f64; 4], TuningError> {
    let unit = ParallelPid { proportional: 1.0, ..ParallelPid::default() };
    let design = Design::new(&study.plant, PidMatrix::decentralised([unit; 2]))?;
    let (printed_gain, printed_period) = [(0.97, 3.54), (-0.37, 10.70)][row - 1];
    let crossings = design.loci()?.real_crossings(|w| design.ratio(w));
    let points = crossings.iter().map(|at| UltimatePoint { gain: -at.value.re.recip(), period: TAU / at.frequency });
    let same_sign = points.filter(|point| point.gain * printed_gain > 0.0);
    let distance = |point: &UltimatePoint| (point.period - printed_period).abs();
    let nearest = same_sign.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let UltimatePoint { gain, period } = nearest.unwrap_or(UltimatePoint { gain: f64::NAN, period: f64::NAN });
    let proportional = 0.45 * gain;
    Ok([gain, period, proportional, proportional / (0.8 * period)])
}

/// The target of a rule, for markers in the plane of the loci.
pub fn rule_targets() -> [(TuningRule, Complex); 4] {
    RULES.map(|(rule, _)| (rule, rule.target()))
}
