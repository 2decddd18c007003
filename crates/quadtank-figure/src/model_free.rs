//! The course of a run under the model-free law: what is controlled above, what that does to the rest below.

use super::{Axis, Chart, Course, Entry, Layer, Pen, Role, Sample, Series};

/// Room above and below the curves, as a share of their range.
const ROOM: f64 = 0.05;
/// Heights of the four charts beside each other.
const WEIGHTS: [f64; 4] = [2.0, 1.6, 1.2, 1.2];

/// What the charts show. All columns of a chart have the rows of their `time`.
#[derive(Clone, Debug)]
pub struct ModelFreeCourse<'a> {
    /// Time of the rows (s).
    pub time_s: &'a [f64],
    /// Levels h1…h4 (m).
    pub levels: [&'a [f64]; 4],
    /// References 1 and 2 (m).
    pub references: [&'a [f64]; 2],
    /// Voltages of pumps 1 and 2 (V).
    pub voltages: [&'a [f64]; 2],
    /// Time, and levels 1 and 2 (m), of the same experiment with another controller.
    pub comparison: Option<(&'a [f64], [&'a [f64]; 2])>,
    /// Time of the samples (s).
    pub sample_time_s: &'a [f64],
    /// φ̂ of both loops at the samples (m/s).
    pub estimates: [&'a [f64]; 2],
    /// φ of both loops from each sample on (m/s).
    pub true_values: [&'a [f64]; 2],
    /// The time that is shown (s).
    pub window_s: (f64, f64),
    /// Words.
    pub texts: ModelFreeTexts<'a>,
}

/// The words of the charts.
#[derive(Clone, Copy, Debug, Default)]
pub struct ModelFreeTexts<'a> {
    /// Names with units of the axes: time, lower levels, upper levels, voltages, φ.
    pub axes: [&'a str; 5],
    /// What a dashed line is.
    pub reference: &'a str,
    /// What a faded line is.
    pub comparison: &'a str,
    /// What a solid line of the lowest chart is.
    pub estimate: &'a str,
    /// What a dotted line of the lowest chart is.
    pub true_value: &'a str,
}

/// Centimetres in a metre: levels are shown in cm, φ in cm/s, as the source does.
const SHOWN: f64 = 100.0;

/// Four charts with one time axis: lower levels with their references, upper levels, pump voltages, φ̂ with φ.
pub fn model_free_course<'a>(spec: &ModelFreeCourse<'a>) -> [Chart<'a>; 4] {
    let ModelFreeCourse { time_s, levels, references, voltages, sample_time_s, texts, .. } = *spec;
    let line = |name: &'a str, index: usize, pen, course, x: &'a [f64], y: &'a [f64], y_scale| {
        let role = Role::of_loop(index);
        Layer::Line(Series { name: name.into(), role, pen, course, x: x.into(), y: y.into(), y_scale })
    };
    // Set-points alike make both loops do the same: the first is seen beneath the second.
    let pen_of = |pen, index| if pen == Pen::Solid && index == 0 { Pen::Broad } else { pen };
    let pair = |names: [&'a str; 2], pen, course, x, columns: [&'a [f64]; 2], scale| {
        [0, 1].map(|i| line(names[i], i, pen_of(pen, i), course, x, columns[i], scale))
    };
    let (straight, held) = (Course::Straight, Course::Held);
    let mut lower = Vec::new();
    lower.extend(pair(["r₁", "r₂"], Pen::Dashed, held, time_s, references, SHOWN));
    if let Some((time, columns)) = spec.comparison {
        lower.extend(pair(["", ""], Pen::Faded, straight, time, columns, SHOWN));
    }
    lower.extend(pair(["h₁", "h₂"], Pen::Solid, straight, time_s, [levels[0], levels[1]], SHOWN));
    let upper = pair(["h₃", "h₄"], Pen::Solid, straight, time_s, [levels[2], levels[3]], SHOWN);
    let pumps = pair(["v₁", "v₂"], Pen::Solid, held, time_s, voltages, 1.0);
    let mut phi = Vec::new();
    phi.extend(pair(["φ₁", "φ₂"], Pen::Dotted, straight, sample_time_s, spec.true_values, SHOWN));
    phi.extend(pair(["φ̂₁", "φ̂₂"], Pen::Solid, held, sample_time_s, spec.estimates, SHOWN));
    let [mut first, mut second, mut third, mut fourth] =
        [lower, upper.into(), pumps.into(), phi].map(|layers| chart_of(layers, spec.window_s));
    for (chart, (label, weight)) in
        [&mut first, &mut second, &mut third, &mut fourth].into_iter().zip(texts.axes[1..].iter().zip(WEIGHTS))
    {
        (*label).clone_into(&mut chart.y.label);
        chart.weight = weight;
        chart.x.numbered = false;
    }
    texts.axes[0].clone_into(&mut fourth.x.label);
    fourth.x.numbered = true;
    let entry = |sample, role, text: &str| Entry { sample: Sample::Line(sample), role, text: text.to_owned() };
    let loops = |texts: [&str; 2]| {
        let [one, two] = texts;
        vec![entry(Pen::Broad, Role::Loop1, one), entry(Pen::Solid, Role::Loop2, two)]
    };
    first.legend = loops(["h₁", "h₂"]);
    first.legend.push(entry(Pen::Dashed, Role::Muted, texts.reference));
    first.legend.extend(spec.comparison.map(|_| entry(Pen::Faded, Role::Muted, texts.comparison)));
    second.legend = loops(["h₃", "h₄"]);
    third.legend = loops(["v₁", "v₂"]);
    fourth.legend =
        vec![entry(Pen::Solid, Role::Muted, texts.estimate), entry(Pen::Dotted, Role::Muted, texts.true_value)];
    [first, second, third, fourth]
}

/// A chart whose value axis holds all that is in sight but what is faded.
fn chart_of(layers: Vec<Layer>, window: (f64, f64)) -> Chart {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for layer in &layers {
        let Layer::Line(series) = layer else { continue };
        if series.pen == Pen::Faded {
            continue;
        }
        let first = series.x.partition_point(|&time| time < window.0);
        let end = series.x.partition_point(|&time| time <= window.1).max(first);
        for &y in series.y.get(first..end).unwrap_or_default().iter().filter(|y| y.is_finite()) {
            (low, high) = (low.min(y * series.y_scale), high.max(y * series.y_scale));
        }
    }
    let room = ROOM * (high - low);
    // There is no water, and no voltage, below nothing.
    let bottom = if low >= 0.0 { (low - room).max(0.0) } else { low - room };
    let mut chart = Chart::new(Axis::new("", window), Axis::rounded("", (bottom, high + room), 5));
    chart.layers = layers;
    chart
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_is_always_in_sight() {
        let (time, low, high) = ([0.0, 1.0, 2.0], [0.1, 0.1, 0.1], [0.1, 0.2, 0.3]);
        let spec = ModelFreeCourse {
            time_s: &time,
            levels: [&low, &low, &low, &high],
            references: [&low, &low],
            voltages: [&low, &high],
            comparison: Some((&time, [&high, &high])),
            sample_time_s: &time,
            estimates: [&low, &low],
            true_values: [&high, &high],
            window_s: (0.0, 1.0),
            texts: ModelFreeTexts::default(),
        };
        let charts = model_free_course(&spec);
        let names = |chart: &Chart| chart.series().map(|series| series.name.to_string()).collect::<Vec<_>>();
        assert_eq!(names(&charts[1]), ["h₃", "h₄"]);
        // Up to the end of the window, in centimetres.
        assert!((20.0..=25.0).contains(&charts[1].y.range.1), "{:?}", charts[1].y.range);
        // A comparison may leave the chart; the time axis is numbered once.
        assert!(charts[0].y.range.1 < 20.0);
        assert_eq!(charts.each_ref().map(|chart| chart.x.numbered), [false, false, false, true]);
    }
}
