//! The charts of the bench, from the results of the session. Building them follows what they read.

use leptos::prelude::*;

use super::given::is_given;
use super::session::{Found, Session, time_unit};
use crate::texts::tr;
use crate::widgets::Picture;
use quadtank::linear::Loci;
use quadtank::sim::LoopTrace;
use quadtank::study::relay_tuning::{Designed, Tested, rule_targets};
use quadtank::tuning::{GainLimit, TuningRule};
use quadtank_figure::{CurveChart, LociChart, LoopsChart, LoopsRecord, Pen};
use quadtank_scenario::tuning::{curve_to_csv, loci_to_csv, record_to_csv, response_to_csv};

/// Importances whose rays are drawn.
const RAYS: [f64; 3] = [0.2, 1.0, 5.0];

/// The record of a relay test; of several tests that of the last.
pub fn record_of(test: &Tested) -> Option<&LoopTrace> {
    match test {
        Tested::Single(test, _) | Tested::Simultaneous(test, _) => Some(&test.trace),
        Tested::Independent(loops) => loops.last().map(|(test, _)| &test.trace),
        Tested::Sequential(steps) => steps.last().map(|step| &step.test.trace),
    }
}

/// The relay test over time, drawn up to some time or whole.
pub fn test(session: Session, window: Signal<(f64, f64)>, until: Signal<Option<f64>>) -> Picture {
    let build = move |show: &mut dyn FnMut(&mut [quadtank_figure::Chart])| {
        session.charts.test.with(|outcome| {
            let trace = outcome.as_ref().as_ref().ok().and_then(record_of);
            let records: Vec<LoopsRecord> = trace.map(|trace| drawn(trace, "", Pen::Solid, true)).into_iter().collect();
            loops(session, &records, window.get(), until.get(), None, show);
        });
    };
    let csv = move || {
        session
            .charts
            .test
            .with(|outcome| outcome.as_ref().as_ref().ok().and_then(record_of).map(record_to_csv).unwrap_or_default())
    };
    Picture::new(build, csv)
}

/// The response with the chosen root, its comparison and the pinned ones.
pub fn response(session: Session, window: Signal<(f64, f64)>) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [quadtank_figure::Chart])| {
        let pinned = session.charts.pinned.get();
        let names: Vec<String> = (1..=pinned.len()).map(|number| tr!(lab, pins.name, number = number)).collect();
        let compared = tr!(lab, relay.row_comparison);
        session.charts.design.with(|outcome| {
            let mut records: Vec<LoopsRecord> = pinned
                .iter()
                .zip(&names)
                .zip(0..)
                .filter_map(|((pinned, name), place)| {
                    Some((pinned.result.as_ref().as_ref().ok()?.as_ref()?, name, place))
                })
                .map(|(design, name, place)| drawn(&design.response.trace, name, Pen::Pinned(place), false))
                .collect();
            if let Ok(Some(Designed { response, comparison, .. })) = outcome.as_ref() {
                let comparisons = comparison.iter();
                records.extend(comparisons.map(|it| drawn(&it.response.trace, &compared, Pen::Dotted, false)));
                records.push(drawn(&response.trace, "", Pen::Solid, false));
            }
            let references = session.charts.setup.with_untracked(|s| s.response.references);
            loops(session, &records, window.get(), None, Some(references), show);
        });
    };
    let csv = move || session.charts.with_design(response_to_csv).unwrap_or_default();
    Picture::new(build, csv)
}

fn drawn<'a>(trace: &'a LoopTrace, name: &'a str, pen: Pen, marked: bool) -> LoopsRecord<'a> {
    LoopsRecord {
        name,
        time: &trace.time,
        outputs: trace.outputs.each_ref().map(Vec::as_slice),
        inputs: trace.inputs.each_ref().map(Vec::as_slice),
        switches: if marked { trace.switches.each_ref().map(Vec::as_slice) } else { [&[]; 2] },
        pen,
    }
}

fn loops(
    session: Session,
    records: &[LoopsRecord],
    window: (f64, f64),
    until: Option<f64>,
    references: Option<[f64; 2]>,
    show: &mut dyn FnMut(&mut [quadtank_figure::Chart]),
) {
    let lab = session.lab;
    // Records follow from the setup, and come anew with all of it that matters here.
    let (unit, in_volts) = session.charts.setup.with_untracked(|s| (time_unit(&s.plant), s.plant.tank().is_some()));
    let volts = if in_volts { " (V)" } else { "" };
    let time = tr!(lab, relay.axis_time, unit = unit);
    let (output, input) = (tr!(lab, relay.axis_output), tr!(lab, relay.axis_input));
    let axes = [time, format!("{output}{volts}"), format!("{input}{volts}")];
    let texts = [tr!(lab, relay.loop_name, number = 1), tr!(lab, relay.loop_name, number = 2)];
    show(&mut quadtank_figure::two_loops(&LoopsChart {
        records,
        window,
        until,
        references,
        axes: axes.each_ref().map(String::as_str),
        texts: texts.each_ref().map(String::as_str),
    }));
}

/// The gains of the critical point that the placement starts from, on the axes of the curve.
pub fn chosen_point(found: Found) -> Option<(f64, f64)> {
    let gains = found.with_design(|design| Some(design.critical?.gains)).flatten()?;
    found.study.with(|study| study.as_ref().as_ref().ok().map(|study| study.normalised(gains)))
}

/// The critical curve with what the test found. `chosen` is followed instead of the design, which changes more often.
pub fn curve(session: Session, chosen: Signal<Option<(f64, f64)>>) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [quadtank_figure::Chart])| {
        let (study, test, chosen) = (session.charts.study.get(), session.charts.test.get(), chosen.get());
        let Ok(study) = study.as_ref() else { return };
        let place = |limit: &GainLimit| match limit {
            GainLimit::Oscillation(point) => study.normalised(point.gains),
            GainLimit::RealPole { gains, .. } | GainLimit::AlgebraicLoop { gains, .. } => study.normalised(*gains),
            GainLimit::None => (f64::NAN, f64::NAN),
        };
        let (x, y): (Vec<f64>, Vec<f64>) = study.curve.points.iter().map(|point| place(&point.limit)).unzip();
        let corners = study.curve.corners.iter().map(|corner| study.normalised(corner.points[0].gains));
        let corners: Vec<(f64, f64)> = corners.collect();
        let oscillation = match test.as_ref() {
            Ok(Tested::Simultaneous(test, _)) => test.reading.oscillation,
            _ => None,
        };
        let estimate = |gains: Option<[f64; 2]>| gains.map(|gains| study.normalised(gains)).into_iter();
        let harmonic: Vec<(f64, f64)> = estimate(oscillation.and_then(|o| o.gains_by_harmonic())).collect();
        let peak: Vec<(f64, f64)> = estimate(oscillation.and_then(|o| o.gains_by_peak())).collect();
        let style = lab.number_style();
        let rays = RAYS.map(|ray| (ray, format!("r₂ = {}", style.significant(ray, 1))));
        show(&mut [quadtank_figure::critical_curve(&CurveChart {
            curve: [&x, &y],
            corners: &corners,
            estimates: [&harmonic, &peak],
            rays: &rays,
            chosen,
            axes: ["k₁ g₁₁(0)", "k₂ g₂₂(0)"],
            texts: [
                &tr!(lab, relay.curve),
                &tr!(lab, relay.by_harmonic),
                &tr!(lab, relay.by_peak),
                &tr!(lab, relay.corner),
            ],
        })]);
    };
    let csv = move || {
        let study = session.charts.study.get();
        study.as_ref().as_ref().map(|study| curve_to_csv(&study.curve)).unwrap_or_default()
    };
    Picture::new(build, csv)
}

/// Both loci at the critical gains and with the controllers at work.
pub fn loci(session: Session) -> Picture {
    let lab = session.lab;
    let build = move |show: &mut dyn FnMut(&mut [quadtank_figure::Chart])| {
        session.charts.design.with(|outcome| {
            let columns = match outcome.as_ref() {
                Ok(Some(design)) => design.loci.each_ref().map(columns),
                _ => Default::default(),
            };
            let [before, after] =
                columns.each_ref().map(|loci| loci.each_ref().map(|parts| parts.each_ref().map(Vec::as_slice)));
            let (target, is_given) = session.charts.setup.with(|s| (s.design.target, is_given(s)));
            let rules = rule_targets().map(|(rule, at)| ((at.re, at.im), short_name(rule)));
            // Given controllers have no target.
            let (target, rules) = if is_given { (None, &[][..]) } else { (Some(target.into()), &rules[..]) };
            let names = [1, 2].map(|number| tr!(lab, relay.locus, number = number));
            show(&mut [quadtank_figure::characteristic_loci(&LociChart {
                loci: after,
                before,
                target,
                rules,
                axes: ["Re λ", "Im λ"],
                texts: [&names[0], &names[1], &tr!(lab, relay.before)],
            })]);
        });
    };
    let csv = move || session.charts.with_design(|design| loci_to_csv(&design.loci[1])).unwrap_or_default();
    Picture::new(build, csv)
}

/// Real and imaginary parts of both loci.
fn columns(loci: &Loci) -> [[Vec<f64>; 2]; 2] {
    loci.branches.each_ref().map(|branch| {
        let (re, im) = branch.iter().map(|x| (x.re, x.im)).unzip();
        [re, im]
    })
}

/// The initials of a rule with its action.
pub fn short_name(rule: TuningRule) -> &'static str {
    match rule {
        TuningRule::ZieglerNicholsP => "ZN P",
        TuningRule::ZieglerNicholsPi => "ZN PI",
        TuningRule::ZieglerNichols1942Pi => "ZN 1942 PI",
        TuningRule::ZieglerNicholsPid => "ZN PID",
        TuningRule::TyreusLuybenPi => "TL PI",
        TuningRule::TyreusLuybenPid => "TL PID",
    }
}
