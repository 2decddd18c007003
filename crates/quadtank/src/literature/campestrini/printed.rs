//! What Campestrini (2006) prints for a case, and what is to be known about the print.

use super::{PublishedCase, PublishedPlacement, USOL};

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

/// A printed number with its symbol in the source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrintedNumber {
    /// Symbol of the source.
    pub symbol: &'static str,
    /// As printed.
    pub value: f64,
    /// Decimals of the print.
    pub decimals: u8,
}

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

    /// The printed numbers of the case; those of a critical point for Tables 7 and 13, of controllers for most others.
    pub fn printed(self) -> Vec<PrintedNumber> {
        let named = |names: &[&'static str], numbers: &[f64], decimals: &[u8]| -> Vec<PrintedNumber> {
            let decimals = |k: usize| decimals[k.min(decimals.len() - 1)];
            let figures = names.iter().zip(numbers).enumerate();
            figures.map(|(k, (&symbol, &value))| PrintedNumber { symbol, value, decimals: decimals(k) }).collect()
        };
        let (_, _, numbers) =
            PRINTED.iter().find(|(table, row, _)| (*table, *row) == (self.table, self.row)).unwrap_or(&PRINTED[0]);
        match self.table {
            3 => named(&["Kc", "Tc", "kp", "ki"], numbers, &[2, 2, 3]),
            88 => named(&["kp11", "ki11", "kp12", "ki12", "kp21", "ki21", "kp22", "ki22"], numbers, &[3]),
            4 => named(&["Re λ", "Im λ"], numbers, &[2, if self.row == 3 { 3 } else { 2 }]),
            7 | 13 => {
                let importance = numbers[0];
                let decimals = u8::from(importance < 1.0 || self.table == 7);
                let PublishedPlacement { critical_gains: [kc1, kc2], critical_period, .. } = self.placement();
                let point = [importance, kc1, kc2, critical_period];
                named(&["r2", "kc1", "kc2", "Tc"], &point, &[decimals, 3, 3, 2])
            }
            0 => {
                let [kp, ti, td] = USOL.printed_pid;
                named(&["Kc", "kp", "ti", "td"], &[USOL.printed_gain, kp, ti, td], &[1, 0])
            }
            _ => named(&["kp1", "ki1", "kd1", "kp2", "ki2", "kd2"], numbers, &[3]),
        }
    }
}
