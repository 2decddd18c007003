//! What a program reads of a session: comma-separated values, a point as decimal separator, in the unit of time of the plant.

use std::fmt::Write as _;

use crate::linear::Loci;
use crate::sim::LoopTrace;
use crate::tuning::{CriticalCurve, GainLimit};

/// A line of numbers; one that is missing is an empty cell.
fn line(text: &mut String, numbers: &[Option<f64>]) {
    for (index, number) in numbers.iter().enumerate() {
        let separator = if index == 0 { "" } else { "," };
        // Writing to a String cannot fail.
        let _ = match number {
            Some(number) => write!(text, "{separator}{number}"),
            None => write!(text, "{separator}"),
        };
    }
    text.push('\n');
}

/// A record: one row per sample, switch, and arrival of what a dead time had held back.
pub fn record_to_csv(trace: &LoopTrace) -> String {
    let mut text = "time,output_1,output_2,input_1,input_2\n".to_owned();
    let ([y1, y2], [u1, u2]) = (&trace.outputs, &trace.inputs);
    for (row, &time) in trace.time.iter().enumerate() {
        line(&mut text, &[time, y1[row], y2[row], u1[row], u2[row]].map(Some));
    }
    text
}

/// The critical curve: gains in every direction, and the period where they oscillate.
pub fn curve_to_csv(curve: &CriticalCurve) -> String {
    let mut text = "angle_rad,gain_1,gain_2,period\n".to_owned();
    for point in &curve.points {
        let (gains, period) = match point.limit {
            GainLimit::Oscillation(at) => (at.gains.map(Some), Some(at.period())),
            GainLimit::RealPole { gains, .. } => (gains.map(Some), None),
            GainLimit::None => ([None; 2], None),
        };
        line(&mut text, &[Some(point.angle), gains[0], gains[1], period]);
    }
    text
}

/// Both characteristic loci over their frequencies.
pub fn loci_to_csv(loci: &Loci) -> String {
    let mut text = "frequency_rad,real_1,imaginary_1,real_2,imaginary_2\n".to_owned();
    let [one, two] = &loci.branches;
    for ((&frequency, a), b) in loci.frequency.iter().zip(one).zip(two) {
        line(&mut text, &[frequency, a.re, a.im, b.re, b.im].map(Some));
    }
    text
}
