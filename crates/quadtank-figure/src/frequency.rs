use super::{Anchor, Axis, Chart, Course, Entry, Label, Layer, Marker, Pen, Role, Sample, Series, Shape};

/// Decades of the gain of the plant that are shown at most.
const MAX_DECADES: i32 = 4;
/// Gains of the loop that are shown: two decades below 1, and above it as far as the peak goes.
const MIN_GAIN: f64 = 0.01;
/// Room above the highest gain.
const ROOM: f64 = 2.0;

/// What the charts over frequency show: singular values, each the largest and the smallest of all directions.
#[derive(Clone, Copy, Debug)]
pub struct FrequencyCharts<'a> {
    /// Frequencies (rad/s), rising.
    pub frequencies: &'a [f64],
    /// Of the plant (V/V).
    pub plant: [&'a [f64]; 2],
    /// Of the loop; `None` for one that is not stable.
    pub closed: Option<ClosedLoopGains<'a>>,
    /// Distance from the origin (1/s) of a zero in the right half-plane.
    pub zero: Option<f64>,
    /// Words.
    pub texts: FrequencyTexts<'a>,
}

/// The gains of a stable loop over the same frequencies.
#[derive(Clone, Copy, Debug)]
pub struct ClosedLoopGains<'a> {
    /// Of the sensitivity S.
    pub sensitivity: [&'a [f64]; 2],
    /// Of the complementary sensitivity T.
    pub complementary: [&'a [f64]; 2],
    /// Frequency and value of the peak of S.
    pub peak: (f64, f64),
    /// Frequency up to which feedback helps.
    pub bandwidth: Option<f64>,
}

/// The words of the charts over frequency.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrequencyTexts<'a> {
    /// Name and unit of the axis of frequencies.
    pub frequency: &'a str,
    /// Name and unit of the gain of the plant.
    pub plant: &'a str,
    /// Name of the gains of the loop.
    pub closed: &'a str,
    /// What a whole line is.
    pub largest: &'a str,
    /// What a dotted line is.
    pub smallest: &'a str,
    /// What stands beside the peak.
    pub peak: &'a str,
    /// What stands beside the bandwidth.
    pub bandwidth: &'a str,
    /// What stands beside the zero.
    pub zero: &'a str,
}

/// Charts for one figure with a common logarithmic axis: singular values of the plant above, of S and T of its loop below. Without
/// a stable loop there is the plant alone.
pub fn over_frequency<'a>(spec: &FrequencyCharts<'a>) -> Vec<Chart<'a>> {
    let mut charts: Vec<Chart> =
        [Some(plant(spec)), spec.closed.map(|closed| loop_gains(spec, &closed))].into_iter().flatten().collect();
    if let Some((last, others)) = charts.split_last_mut() {
        last.x.label.push_str(spec.texts.frequency);
        for chart in others {
            chart.x.numbered = false;
        }
    }
    charts
}

fn frequency_axis(spec: &FrequencyCharts) -> Axis {
    let (first, last) = (spec.frequencies.first(), spec.frequencies.last());
    Axis::logarithmic("", (first.copied().unwrap_or(1.0), last.copied().unwrap_or(10.0)))
}

fn plant<'a>(spec: &FrequencyCharts<'a>) -> Chart<'a> {
    let values = || spec.plant.into_iter().flatten().copied().filter(|value| *value > 0.0 && value.is_finite());
    let decade = |value: f64| value.log10();
    let top = values().reduce(f64::max).map_or(1, |value| whole(decade(value).ceil()));
    let bottom = values().reduce(f64::min).map_or(0, |value| whole(decade(value).floor()));
    let bottom = bottom.clamp(top - MAX_DECADES, top - 1);
    let mut chart = Chart::new(
        frequency_axis(spec),
        Axis::logarithmic(spec.texts.plant, (power_of_ten(bottom), power_of_ten(top))),
    );
    chart.layers.extend(curves(spec, "G", Role::Neutral, spec.plant));
    chart.layers.extend(zero(spec, chart.y.range));
    let entry = |pen, text: &str| Entry { sample: Sample::Line(pen), role: Role::Neutral, text: text.to_owned() };
    chart.legend = vec![entry(Pen::Solid, spec.texts.largest), entry(Pen::Dotted, spec.texts.smallest)];
    chart
}

fn loop_gains<'a>(spec: &FrequencyCharts<'a>, closed: &ClosedLoopGains<'a>) -> Chart<'a> {
    let gains = [closed.sensitivity[0], closed.complementary[0]];
    let highest = gains.into_iter().flatten().copied().filter(|value| value.is_finite()).fold(1.0, f64::max);
    let range = (MIN_GAIN, ROOM * highest);
    let x = frequency_axis(spec);
    let (left, right) = x.span();
    let mut chart = Chart::new(x, Axis::logarithmic(spec.texts.closed, range));
    chart.layers.push(Layer::Level { y: 1.0, role: Role::Muted, pen: Pen::Hair });
    chart.layers.extend(zero(spec, range));
    if let Some(at) = closed.bandwidth {
        chart.layers.push(Layer::Upright { x: at, role: Role::Muted, pen: Pen::Dashed });
        chart.layers.push(beside((at, range.0), (-4.0, -8.0), Anchor::Right, spec.texts.bandwidth, Role::Muted));
    }
    chart.layers.extend(curves(spec, "T", Role::ClosedLoop, closed.complementary));
    chart.layers.extend(curves(spec, "S", Role::Neutral, closed.sensitivity));
    let (frequency, value) = closed.peak;
    let at = (frequency, value);
    chart.layers.push(Layer::Marker(Marker { at, shape: Shape::Ring, role: Role::Neutral, points_beyond: false }));
    // In the outer quarters its words would leave the plot.
    let share = (frequency / left).ln() / (right / left).ln();
    let (offset, anchor) = match share {
        share if share < 0.25 => ((0.0, -12.0), Anchor::Left),
        share if share > 0.75 => ((0.0, -12.0), Anchor::Right),
        _ => ((0.0, -12.0), Anchor::Middle),
    };
    chart.layers.push(beside(at, offset, anchor, spec.texts.peak, Role::Neutral));
    let entry = |role, text: &str| Entry { sample: Sample::Line(Pen::Solid), role, text: text.to_owned() };
    chart.legend = vec![entry(Role::Neutral, "S"), entry(Role::ClosedLoop, "T")];
    chart.weight = 1.3;
    chart
}

/// The largest singular value whole, the smallest one dotted.
fn curves<'a>(spec: &FrequencyCharts<'a>, name: &str, role: Role, values: [&'a [f64]; 2]) -> [Layer<'a>; 2] {
    let line = |pen, which: &str, y: &'a [f64]| {
        let name = format!("{name}: {which}").into();
        let x = spec.frequencies.into();
        Layer::Line(Series { name, role, pen, course: Course::Straight, x, y: y.into(), y_scale: 1.0 })
    };
    let [largest, smallest] = values;
    [line(Pen::Dotted, spec.texts.smallest, smallest), line(Pen::Solid, spec.texts.largest, largest)]
}

fn zero(spec: &FrequencyCharts, (bottom, _): (f64, f64)) -> Vec<Layer<'static>> {
    let Some(at) = spec.zero else { return Vec::new() };
    let (role, pen) = (Role::RightHalfPlane, Pen::Dashed);
    vec![Layer::Upright { x: at, role, pen }, beside((at, bottom), (4.0, -8.0), Anchor::Left, spec.texts.zero, role)]
}

fn beside(at: (f64, f64), offset: (f64, f64), anchor: Anchor, text: &str, role: Role) -> Layer<'static> {
    Layer::Label(Label {
        at,
        offset,
        anchor,
        text: text.to_owned(),
        role,
        bold: true,
        on_ground: false,
        opposite: None,
    })
}

/// The exponent of a gain, which is far from the limits of its type.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of a finite f64 fits i32")]
fn whole(exponent: f64) -> i32 {
    exponent as i32
}

fn power_of_ten(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREQUENCIES: [f64; 3] = [0.001, 0.03, 1.0];

    fn spec(closed: bool) -> FrequencyCharts<'static> {
        FrequencyCharts {
            frequencies: &FREQUENCIES,
            plant: [&[4.0, 2.0, 1e-7], &[0.5, 0.1, 0.0]],
            closed: closed.then_some(ClosedLoopGains {
                sensitivity: [&[0.1, 1.7, 1.0], &[0.05, 0.9, 1.0]],
                complementary: [&[1.0, 1.2, 0.01], &[1.0, 0.4, 0.001]],
                peak: (0.03, 1.7),
                bandwidth: Some(0.01),
            }),
            zero: Some(0.013),
            texts: FrequencyTexts {
                frequency: "frequency",
                peak: "Ms",
                bandwidth: "ωB",
                zero: "z",
                ..Default::default()
            },
        }
    }

    #[test]
    fn the_lowest_chart_alone_names_the_frequencies() {
        let charts = over_frequency(&spec(true));
        assert_eq!(charts.len(), 2);
        assert_eq!((charts[0].x.numbered, charts[0].x.label.as_str()), (false, ""));
        assert_eq!((charts[1].x.numbered, charts[1].x.label.as_str()), (true, "frequency"));
        assert_eq!(charts[0].x.range, charts[1].x.range);
        // At most four decades of the plant, and room above the peak.
        assert_eq!(charts[0].y.range, (1e-3, 10.0));
        assert_eq!(charts[1].y.range, (0.01, 2.0 * 1.7));
    }

    #[test]
    fn peak_bandwidth_and_zero_are_marked_and_an_unstable_loop_leaves_the_plant() {
        let words = |chart: &Chart| {
            let text = |layer: &Layer| match layer {
                Layer::Label(label) => Some((label.text.clone(), label.at)),
                _ => None,
            };
            chart.layers.iter().filter_map(text).collect::<Vec<_>>()
        };
        let charts = over_frequency(&spec(true));
        let word = |text: &str, at| (text.to_owned(), at);
        assert_eq!(words(&charts[1]), [word("z", (0.013, 0.01)), word("ωB", (0.01, 0.01)), word("Ms", (0.03, 1.7))]);
        let alone = over_frequency(&spec(false));
        assert_eq!(alone.len(), 1);
        assert_eq!((alone[0].x.numbered, words(&alone[0])), (true, vec![word("z", (0.013, 1e-3))]));
    }
}
