use quadtank::linear::Loci;
use quadtank::sim::LoopTrace;
use quadtank::study::relay_tuning::{Tested, Tuning, TuningSetup, tune};
use quadtank::tuning::{GainLimit, TuningError};
use quadtank_figure::{
    Chart, CurveChart, LociChart, LoopsChart, LoopsRecord, Pen, Size, Style, characteristic_loci, critical_curve,
    to_svg, two_loops,
};
use quadtank_scenario::answers::relay_record;

use crate::SessionPicture;

/// Draws a picture of a session as an SVG document.
pub fn svg(setup: &TuningSetup, picture: SessionPicture, style: &Style) -> Result<String, TuningError> {
    let found = tune(setup)?;
    let size = Size { width: 720.0, height: 560.0 };
    let empty = LoopTrace::default();
    let (title, description) = match picture {
        SessionPicture::Test => ("Relay test", "Outputs and relay outputs of both loops over time."),
        SessionPicture::Curve => ("Critical curve", "The boundary of the stable gains of two proportional loops."),
        SessionPicture::Loci => ("Characteristic loci", "Both characteristic loci with the point −1 and the target."),
        SessionPicture::Response => ("Response", "Outputs and inputs after a step of the references."),
    };
    Ok(match picture {
        SessionPicture::Test => {
            let trace = relay_record(&found.test).unwrap_or(&empty);
            loops_svg(&[(trace, Pen::Solid)], None, |charts| to_svg(charts, size, style, title, description))
        }
        SessionPicture::Response => {
            let compared = found.design.as_ref().and_then(|design| design.comparison.as_ref());
            let compared = compared.map(|comparison| (&comparison.response.trace, Pen::Dotted));
            let trace = found.design.as_ref().map_or(&empty, |design| &design.response.trace);
            let records: Vec<_> = compared.into_iter().chain([(trace, Pen::Solid)]).collect();
            let references = Some(setup.response.references);
            loops_svg(&records, references, |charts| to_svg(charts, size, style, title, description))
        }
        SessionPicture::Curve => {
            curve(&found, |chart| to_svg(&[critical_curve(chart)], size, style, title, description))
        }
        SessionPicture::Loci => {
            loci(&found, setup, |chart| to_svg(&[characteristic_loci(chart)], size, style, title, description))
        }
    })
}

fn drawn(trace: &LoopTrace, pen: Pen) -> LoopsRecord<'_> {
    LoopsRecord {
        name: if pen == Pen::Solid { "" } else { "compared" },
        time: &trace.time,
        outputs: trace.outputs.each_ref().map(Vec::as_slice),
        inputs: trace.inputs.each_ref().map(Vec::as_slice),
        switches: trace.switches.each_ref().map(Vec::as_slice),
        pen,
    }
}

/// Charts of records with their pens, the one that counts last, as SVG.
fn loops_svg(records: &[(&LoopTrace, Pen)], references: Option<[f64; 2]>, draw: impl Fn(&[Chart]) -> String) -> String {
    let end = records.last().and_then(|(trace, _)| trace.time.last());
    let window = (0.0, end.copied().unwrap_or(1.0));
    let (axes, texts) = (["time", "output", "input"], ["loop 1", "loop 2"]);
    let records: Vec<_> = records.iter().map(|&(trace, pen)| drawn(trace, pen)).collect();
    draw(&two_loops(&LoopsChart { records: &records, window, until: None, references, axes, texts }))
}

fn curve<T>(found: &Tuning, draw: impl Fn(&CurveChart) -> T) -> T {
    let normal = |gains: [f64; 2]| found.study.normalised(gains);
    let point = |limit: &GainLimit| match limit {
        GainLimit::Oscillation(point) => normal(point.gains),
        GainLimit::RealPole { gains, .. } | GainLimit::AlgebraicLoop { gains, .. } => normal(*gains),
        GainLimit::None => (f64::NAN, f64::NAN),
    };
    let (x, y): (Vec<f64>, Vec<f64>) = found.study.curve.points.iter().map(|at| point(&at.limit)).unzip();
    let corners: Vec<(f64, f64)> =
        found.study.curve.corners.iter().map(|corner| normal(corner.points[0].gains)).collect();
    let oscillation = match &found.test {
        Tested::Simultaneous(test, _) => test.reading.oscillation,
        Tested::Single(..) | Tested::Independent(_) | Tested::Sequential(_) => None,
    };
    let harmonic: Vec<(f64, f64)> = oscillation.and_then(|o| o.gains_by_harmonic()).map(normal).into_iter().collect();
    let peak: Vec<(f64, f64)> = oscillation.and_then(|o| o.gains_by_peak()).map(normal).into_iter().collect();
    let chosen = found.design.as_ref().and_then(|design| design.critical).map(|critical| normal(critical.gains));
    draw(&CurveChart {
        curve: [&x, &y],
        corners: &corners,
        estimates: [&harmonic, &peak],
        rays: &[(1.0, "r2 = 1".to_owned())],
        chosen,
        axes: ["k1 g11(0)", "k2 g22(0)"],
        texts: ["critical curve", "relay test, first harmonics", "relay test, peaks", "corner"],
    })
}

fn loci<T>(found: &Tuning, setup: &TuningSetup, draw: impl Fn(&LociChart) -> T) -> T {
    // Real and imaginary parts of both loci.
    let columns = |loci: &Loci| -> [[Vec<f64>; 2]; 2] {
        loci.branches.each_ref().map(|branch| {
            let (re, im) = branch.iter().map(|x| (x.re, x.im)).unzip();
            [re, im]
        })
    };
    let [before, after] =
        found.design.as_ref().map_or_else(Default::default, |design| design.loci.each_ref().map(columns));
    let [re, im] = setup.design.target;
    draw(&LociChart {
        loci: after.each_ref().map(|parts| parts.each_ref().map(Vec::as_slice)),
        before: before.each_ref().map(|parts| parts.each_ref().map(Vec::as_slice)),
        target: setup.design.controllers.is_none().then_some((re, im)),
        rules: &[],
        axes: ["real part", "imaginary part"],
        texts: ["locus 1", "locus 2", "at the critical gains"],
    })
}
