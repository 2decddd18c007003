//! What a program reads of a session: comma-separated values, a point as decimal separator, in the unit of time of the plant.

use quadtank::linear::Loci;
use quadtank::sim::LoopTrace;
use quadtank::tuning::{CriticalCurve, GainLimit};

use quadtank::study::relay_tuning::Designed;

use crate::csv_table::line;

/// A record: one row per sample, switch, and arrival of what a dead time had held back.
pub fn record_to_csv(trace: &LoopTrace) -> String {
    let mut text = "time,output_1,output_2,input_1,input_2\n".to_owned();
    let ([y1, y2], [u1, u2]) = (&trace.outputs, &trace.inputs);
    for (row, &time) in trace.time.iter().enumerate() {
        line(&mut text, [time, y1[row], y2[row], u1[row], u2[row]].map(Some));
    }
    text
}

/// A response, beside that of the controllers it is compared with, if there are any. Their records may have rows at different times
/// (arrivals of what a dead time had held back, an early end): where one has no row, its cells are empty.
pub fn response_to_csv(design: &Designed) -> String {
    let trace = &design.response.trace;
    let Some(compared) = design.comparison.as_ref().map(|comparison| &comparison.response.trace) else {
        return record_to_csv(trace);
    };
    let mut text = "time,output_1,output_2,input_1,input_2,\
        compared_output_1,compared_output_2,compared_input_1,compared_input_2\n"
        .to_owned();
    let cells = |trace: &LoopTrace, row: Option<usize>| {
        let columns = trace.outputs.iter().chain(&trace.inputs);
        columns.map(|column| row.map(|row| column[row])).collect::<Vec<_>>()
    };
    let mut next = [0; 2];
    loop {
        let times = [(trace, next[0]), (compared, next[1])].map(|(of, row)| of.time.get(row).copied());
        let Some(time) = times.into_iter().flatten().reduce(f64::min) else { return text };
        let rows = [0, 1].map(|k| (times[k] == Some(time)).then_some(next[k]));
        line(&mut text, [vec![Some(time)], cells(trace, rows[0]), cells(compared, rows[1])].concat());
        next = [0, 1].map(|k| next[k] + usize::from(rows[k].is_some()));
    }
}

/// The critical curve: gains in every direction, and the period where they oscillate.
pub fn curve_to_csv(curve: &CriticalCurve) -> String {
    let mut text = "angle_rad,gain_1,gain_2,period\n".to_owned();
    for point in &curve.points {
        let (gains, period) = match point.limit {
            GainLimit::Oscillation(at) => (at.gains.map(Some), Some(at.period())),
            GainLimit::RealPole { gains, .. } | GainLimit::AlgebraicLoop { gains, .. } => (gains.map(Some), None),
            GainLimit::None => ([None; 2], None),
        };
        line(&mut text, [Some(point.angle), gains[0], gains[1], period]);
    }
    text
}

/// Both characteristic loci over their frequencies.
pub fn loci_to_csv(loci: &Loci) -> String {
    let mut text = "frequency_rad,real_1,imaginary_1,real_2,imaginary_2\n".to_owned();
    let [one, two] = &loci.branches;
    for ((&frequency, a), b) in loci.frequency.iter().zip(one).zip(two) {
        line(&mut text, [frequency, a.re, a.im, b.re, b.im].map(Some));
    }
    text
}
