//! What Campestrini (2006) prints for a case, beside what follows from the same plant and point.

use std::f64::consts::TAU;

use quadtank::control::{ParallelPid, PidMatrix};
use quadtank::linear::Complex;
use quadtank::tuning::{Design, TuningError, TuningRule, USOL, UltimatePoint, importance, wood_berry_full_controller};

use super::published::RULES;
use super::{CriticalSpec, PublishedCase, Study};

/// A printed number and the computed one.
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedFigure {
    /// Symbol of the source.
    pub symbol: &'static str,
    /// As printed.
    pub printed: f64,
    /// Decimals of the print.
    pub decimals: u8,
    /// Computed from the printed plant and critical point.
    pub computed: f64,
}

/// Share by which digits of a printed period move what is computed from it.
const PERIOD_SHARE: f64 = 5e-4;

impl PrintedFigure {
    /// Whether the computed number is the printed one: within half a unit of its last digit and what the digits of the printed
    /// period leave open.
    pub fn agrees(&self) -> bool {
        let half_unit = 0.5 * 0.1_f64.powi(self.decimals.into());
        (self.computed - self.printed).abs() <= half_unit * 1.000_001 + PERIOD_SHARE * self.printed.abs()
    }
}

/// The printed numbers of tables and rows: of Tables 7 and 13 r2, else what the names in [`PublishedCase::printed`] say.
const PRINTED: [(u32, usize, &[f64]); 37] = [
    (0, 1, &[]),
    (3, 1, &[0.97, 3.54, 0.437, 0.154]),
    (3, 2, &[-0.37, 10.70, -0.167, -0.019]),
    (88, 1, &[0.487, 0.168, -0.272, -0.078, 0.120, 0.035, -0.217, -0.034]),
    (4, 1, &[-0.4, 0.08]),
    (4, 2, &[-0.6, -0.28]),
    (4, 3, &[-0.31, 0.023]),
    (4, 4, &[-0.45, -0.42]),
    (5, 1, &[0.178, 0.017, 0.0, -0.118, -0.011, 0.0]),
    (6, 1, &[0.567, 0.336, 0.239, -0.102, -0.018, -0.144]),
    (6, 2, &[0.155, 0.085, 0.070, -0.400, -0.076, -0.530]),
    (7, 1, &[10.0]),
    (7, 2, &[1.0]),
    (7, 3, &[0.3]),
    (7, 4, &[0.2]),
    (8, 1, &[0.162, 0.004, 0.0, -0.107, -0.003, 0.0]),
    (8, 2, &[0.138, 0.016, 0.0, -0.091, -0.011, 0.0]),
    (9, 1, &[0.250, 0.037, 0.420, -0.165, -0.026, -0.277]),
    (10, 1, &[0.025, 0.029, 0.0, -0.128, -0.009, 0.0]),
    (10, 2, &[0.013, 0.026, 0.0, -0.114, -0.015, 0.0]),
    (11, 1, &[0.582, 0.223, 0.379, -0.087, -0.014, -0.136]),
    (11, 2, &[0.143, 0.063, 0.082, -0.312, -0.043, -0.559]),
    (12, 1, &[0.106, 0.032, 0.087, -0.144, -0.014, -0.382]),
    (12, 2, &[0.093, 0.031, 0.069, -0.151, -0.016, -0.365]),
    (12, 3, &[0.098, 0.032, 0.076, -0.149, -0.015, -0.372]),
    (12, 4, &[0.101, 0.032, 0.080, -0.148, -0.014, -0.376]),
    (13, 1, &[4.0]),
    (13, 2, &[100.0]),
    (13, 3, &[0.5]),
    (14, 1, &[0.812, 1.723, 0.0, 0.169, 0.359, 0.0]),
    (14, 2, &[0.931, 1.537, 0.0, 0.194, 0.320, 0.0]),
    (14, 3, &[1.171, 0.765, 0.0, 0.244, 0.159, 0.0]),
    (14, 4, &[1.573, 1.347, 0.0, 0.328, 0.281, 0.0]),
    (15, 1, &[-0.101, 0.630, 0.0, 0.721, 0.385, 0.0]),
    (15, 2, &[-0.096, 0.741, 0.0, 0.850, -0.035, 0.0]),
    (16, 1, &[0.087, 1.600, 0.001, 1.165, 1.148, 0.296]),
    (16, 2, &[0.114, 1.792, 0.002, 1.196, 1.058, 0.338]),
];

/// Printed numbers of a case, with their symbols and decimals.
type Printed = Vec<(&'static str, f64, u8)>;

/// Why a printed number differs, or what the print does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrintedRemark {
    /// Table 3: the gain of locus 1 belongs to another period, and 0.45 Kc is used.
    OtherPeriod,
    /// Equation 88: A21 has lost its sign.
    LostSign,
    /// Table 4: the numbers in print are rounded.
    Rounded,
    /// Table 5: the point is a little outside the curve; its controllers are nearly those of the rule.
    NearRule,
    /// Tables 6 and 11: the critical point is not stated.
    UnstatedPoint,
    /// Table 7, points 1 and 2: r2 is another one by the definition of the source.
    OtherImportance,
    /// Table 7, point 4: at the corner; the text prints another period for it.
    Corner,
    /// The frequencies of the text are periods over 2π.
    PeriodsAsFrequencies,
    /// Table 9: ki2 is a slip.
    Slip,
    /// Table 11: with the target of the rule unrounded.
    UnroundedTarget,
    /// Tables 12 and 16: the last heading should be kd2.
    Heading,
    /// Table 15, point 2: unstable, as the source says, because of the sign of ki2.
    Unstable,
    /// The solvents column: td is ten times too large, and kp is that of the PI row.
    Usol,
}

impl PublishedCase {
    /// What to know about the print.
    pub fn remarks(self) -> &'static [PrintedRemark] {
        use PrintedRemark::{
            Corner, Heading, LostSign, NearRule, OtherImportance, OtherPeriod, PeriodsAsFrequencies, Rounded, Slip,
            UnroundedTarget, Unstable, UnstatedPoint, Usol,
        };
        match (self.table, self.row) {
            (3, _) => &[OtherPeriod],
            (88, _) => &[LostSign],
            (4, _) => &[Rounded],
            (5, _) => &[NearRule],
            (6, _) => &[UnstatedPoint],
            (7, 1 | 2) => &[OtherImportance, PeriodsAsFrequencies],
            (7, 4) => &[Corner, PeriodsAsFrequencies],
            (7 | 13, _) => &[PeriodsAsFrequencies],
            (9, _) => &[Slip],
            (11, _) => &[UnstatedPoint, UnroundedTarget],
            (12 | 16, _) => &[Heading],
            (15, 2) => &[Unstable],
            (0, _) => &[Usol],
            _ => &[],
        }
    }

    /// Printed numbers beside computed ones; `study` is that of the plant of the case.
    ///
    /// # Errors
    /// What is wrong with the plant.
    pub fn figures(self, study: &Study) -> Result<Vec<PrintedFigure>, TuningError> {
        let printed = self.printed();
        let computed = self.computed(study)?;
        let figures = printed.into_iter().zip(computed);
        let figures = figures.map(|((symbol, printed, decimals), computed)| PrintedFigure {
            symbol,
            printed,
            decimals,
            computed,
        });
        Ok(figures.collect())
    }

    fn printed(self) -> Printed {
        let named = |names: &[&'static str], numbers: &[f64], decimals: &[u8]| -> Printed {
            let figures = names.iter().zip(numbers).enumerate();
            figures.map(|(k, (&name, &number))| (name, number, decimals[k.min(decimals.len() - 1)])).collect()
        };
        let (_, _, numbers) =
            PRINTED.iter().find(|(table, row, _)| (*table, *row) == (self.table, self.row)).unwrap_or(&PRINTED[0]);
        match self.table {
            3 => named(&["Kc", "Tc", "kp", "ki"], numbers, &[2, 2, 3]),
            88 => named(&["kp11", "ki11", "kp12", "ki12", "kp21", "ki21", "kp22", "ki22"], numbers, &[3]),
            4 => named(&["Re λ", "Im λ"], numbers, &[2, if self.row == 3 { 3 } else { 2 }]),
            7 | 13 => {
                let importance = numbers[0];
                let mut printed = vec![("r2", importance, u8::from(importance < 1.0 || self.table == 7))];
                if let CriticalSpec::Point { gains, period } = self.scenario().tuning.design.critical {
                    printed.extend(named(&["kc1", "kc2", "Tc"], &[gains[0], gains[1], period], &[3, 3, 2]));
                }
                printed
            }
            0 => {
                let [kp, ti, td] = USOL.printed_pid;
                named(&["Kc", "kp", "ti", "td"], &[USOL.printed_gain, kp, ti, td], &[1, 0])
            }
            _ => named(&["kp1", "ki1", "kd1", "kp2", "ki2", "kd2"], numbers, &[3]),
        }
    }

    fn computed(self, study: &Study) -> Result<Vec<f64>, TuningError> {
        let gains = |pids: &[ParallelPid]| pids.iter().flat_map(|k| [k.proportional, k.integral]).collect();
        Ok(match self.table {
            3 => locus_settings(study, self.row)?.to_vec(),
            88 => gains(wood_berry_full_controller().0.as_flattened()),
            4 => {
                let target = RULES[self.row - 1].0.target();
                vec![target.re, target.im]
            }
            0 => {
                let settings = TuningRule::TyreusLuybenPi.settings(USOL.ultimate_point());
                let derivative = TuningRule::TyreusLuybenPid.settings(USOL.ultimate_point()).derivative_time;
                vec![USOL.ultimate_point().gain, settings.gain, settings.integral_time, derivative]
            }
            7 | 13 => self.point_on_curve(study).map_or_else(Vec::new, Vec::from),
            _ => {
                let setup = self.scenario().tuning;
                let design = study.design(&setup)?;
                design.map_or_else(Vec::new, |design| {
                    let chosen = &design.roots[setup.design.root - 1].controllers;
                    chosen.iter().flat_map(|k| [k.proportional, k.integral, k.derivative]).collect()
                })
            }
        })
    }

    /// r2 of the printed gains, and the point of the curve in their direction: gains and period.
    fn point_on_curve(self, study: &Study) -> Option<[f64; 4]> {
        let CriticalSpec::Point { gains, .. } = self.scenario().tuning.design.critical else { return None };
        let point = study.search.nearest(gains)?;
        Some([importance(&study.dc_gain, gains), point.gains[0], point.gains[1], point.period()])
    }
}

/// Kc and Tc of a locus of G alone, and PI settings by 0.45 Kc and 0.8 Tc (Campestrini 2006, Table 3): of locus 1 the crossing
/// that the printed period is near to.
fn locus_settings(study: &Study, row: usize) -> Result<[f64; 4], TuningError> {
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
