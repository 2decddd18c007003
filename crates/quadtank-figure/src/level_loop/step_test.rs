use super::super::range::{extent, join, range};
use super::super::{Axis, Chart, Course, Entry, Layer, Name, Names, Pen, Role, Sample, Series, Shape};
use super::{curve, mark};

/// An axis never shows less than this share of the largest value, so that rounding does not look like a step.
const MIN_SHARE: f64 = 1e-3;
/// Points of the curve that words keep off.
const AROUND: usize = 60;

/// What the charts of a step test show.
#[derive(Clone, Debug)]
pub struct StepTestCharts<'a> {
    /// Time (s), rising.
    pub time_s: &'a [f64],
    /// What the transmitter tells, as a signal.
    pub measured: &'a [f64],
    /// What the model says of it.
    pub fitted: Option<&'a [f64]>,
    /// Output of the controller, as a signal.
    pub output: &'a [f64],
    /// Points that were read from the curve (s, signal), with their names.
    pub marks: Vec<((f64, f64), &'a str)>,
    /// Words.
    pub texts: StepTestTexts<'a>,
}

/// The words of these charts. The legend shows those that are not empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct StepTestTexts<'a> {
    /// Names with units of the axes: time, measured, output.
    pub axes: [&'a str; 3],
    /// Name of the measured signal.
    pub measured: &'a str,
    /// Name of what the model says.
    pub fitted: &'a str,
}

/// Two charts with one time axis: the answer with that of the model upon it, and the output that steps.
///
/// The answer and its marks are in sight; a model that is far from it leaves the chart.
pub fn step_test<'a>(spec: &StepTestCharts<'a>) -> [Chart<'a>; 2] {
    let StepTestCharts { time_s, measured, output, texts, .. } = spec;
    let time = extent(time_s).unwrap_or((0.0, 1.0));
    let value_range = |column: &'a [f64], fitted: Option<&'a [f64]>| {
        let least = extent(column).map_or(0.0, |(low, high)| MIN_SHARE * low.abs().max(high.abs()));
        let everything = (f64::NEG_INFINITY, f64::INFINITY);
        range(time, time_s, [column].into_iter(), fitted.map(|y| (*time_s, [y])).into_iter(), everything, least)
    };
    let marks = spec.marks.iter().filter(|((x, y), _)| x.is_finite() && y.is_finite());
    let measured_range = marks.clone().map(|&((_, y), _)| (y, y)).fold(value_range(measured, spec.fitted), join);
    let mut answer = Chart::new(Axis::new("", time), Axis::rounded(texts.axes[1], measured_range, 6));
    answer.x.numbered = false;
    answer.weight = 2.2;
    answer.layers.push(curve(texts.measured, Role::Loop1, Pen::Solid, *time_s, *measured));
    answer.layers.extend(spec.fitted.map(|y| curve(texts.fitted, Role::Neutral, Pen::Dotted, *time_s, y)));
    answer.layers.extend(marks.clone().map(|&(at, _)| mark(at, Shape::Point, Role::Neutral)));
    let names = marks.map(|&(at, name)| Name { at, text: name.to_owned(), role: Role::Neutral, bold: false }).collect();
    let stride = (time_s.len() / AROUND).max(1);
    let around = time_s.iter().copied().zip(measured.iter().copied()).step_by(stride).collect();
    answer.layers.push(Layer::Names(Names { names, around, on_ground: true }));
    let entry = |pen, role, text: &str| Entry { sample: Sample::Line(pen), role, text: text.to_owned() };
    answer.legend = vec![entry(Pen::Solid, Role::Loop1, texts.measured)];
    answer.legend.extend(spec.fitted.map(|_| entry(Pen::Dotted, Role::Neutral, texts.fitted)));
    answer.legend.retain(|entry| !entry.text.is_empty());

    let mut cause =
        Chart::new(Axis::new(texts.axes[0], time), Axis::rounded(texts.axes[2], value_range(output, None), 3));
    let (x, y) = ((*time_s).into(), (*output).into());
    let (role, pen, course) = (Role::Neutral, Pen::Solid, Course::Held);
    cause.layers.push(Layer::Line(Series { name: texts.axes[2].into(), role, pen, course, x, y, y_scale: 1.0 }));
    [answer, cause]
}

#[cfg(test)]
mod tests {
    use super::super::super::table;
    use super::*;

    const TIME: [f64; 3] = [0.0, 1.0, 2.0];

    fn spec<'a>(fitted: Option<&'a [f64]>, marks: Vec<((f64, f64), &'a str)>) -> StepTestCharts<'a> {
        let texts = StepTestTexts { axes: ["time", "y", "u"], measured: "measured", fitted: "fitted" };
        StepTestCharts {
            time_s: &TIME,
            measured: &[50.0, 55.0, 60.0],
            fitted,
            output: &[40.0, 45.0, 45.0],
            marks,
            texts,
        }
    }

    #[test]
    fn the_model_is_dotted_over_what_was_measured_and_all_is_in_the_table() {
        let charts = step_test(&spec(Some(&[50.0, 56.0, 61.0]), vec![((0.6, 52.8), "28.3 %")]));
        let pens: Vec<Pen> = charts[0].series().map(|series| series.pen).collect();
        assert_eq!(pens, [Pen::Solid, Pen::Dotted]);
        assert_eq!(table(&charts, 10).columns, ["time", "measured", "fitted", "u"]);
        assert_eq!(charts.each_ref().map(|chart| chart.x.numbered), [false, true]);
    }

    #[test]
    fn a_model_that_is_far_off_does_not_flatten_the_answer_and_marks_are_in_sight() {
        let [alone, _] = step_test(&spec(None, Vec::new()));
        let [wild, _] = step_test(&spec(Some(&[50.0, 1e6, -1e6]), Vec::new()));
        assert!(alone.y.range.0 <= 50.0 && alone.y.range.1 >= 60.0);
        assert!(wild.y.range.1 - wild.y.range.0 <= 4.0 * (alone.y.range.1 - alone.y.range.0));
        let [marked, _] = step_test(&spec(None, vec![((1.0, 70.0), "tangent"), ((f64::NAN, 1.0), "none")]));
        assert!(marked.y.range.1 >= 70.0);
    }
}
