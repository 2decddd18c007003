use nalgebra::Complex;

use super::{Anchor, Axis, Chart, Course, Entry, Label, Layer, Marker, Pen, Role, Sample, Series, Shape, signed};

/// A zero or a closed-loop pole farther out than this many times the fastest open-loop pole is only pointed at.
const REACH: f64 = 5.0;
/// Zeros closer than this share of the axis have their numbers on different sides.
const CLOSE: f64 = 0.5;
/// Significant digits of the numbers beside zeros.
const DIGITS: usize = 3;

/// What the pole-zero chart shows, in 1/s.
#[derive(Clone, Copy, Debug)]
pub struct PoleZero<'a> {
    /// Poles of the open loop.
    pub poles: &'a [Complex<f64>],
    /// Transmission zeros.
    pub zeros: &'a [Complex<f64>],
    /// The path of each zero as a valve moves.
    pub zero_paths: &'a [Vec<Complex<f64>>],
    /// Poles of the closed loop.
    pub closed_loop: &'a [Complex<f64>],
    /// Decimal separator of the reader's language.
    pub decimal: char,
    /// Words.
    pub texts: PoleZeroTexts<'a>,
}

/// The words of the pole-zero chart. The legend shows those of the last four that are not empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct PoleZeroTexts<'a> {
    /// Name and unit of the real axis.
    pub real: &'a str,
    /// Name and unit of the imaginary axis.
    pub imaginary: &'a str,
    /// Poles of the open loop.
    pub poles: &'a str,
    /// Transmission zeros.
    pub zeros: &'a str,
    /// Poles of the closed loop.
    pub closed_loop: &'a str,
    /// What an arrow at the edge stands for; only there where there is one.
    pub beyond: &'a str,
}

/// Poles and zeros in the s-plane, the right half tinted. The range holds all of them, except those so far out that
/// the rest would shrink to a point: they become arrows at the edge.
pub fn pole_zero(spec: &PoleZero) -> Chart<'static> {
    let (real, imaginary) = ranges(spec);
    let mut chart =
        Chart::new(Axis::rounded(spec.texts.real, real, 6), Axis::rounded(spec.texts.imaginary, imaginary, 4));
    let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
    chart.layers.push(Layer::Region { x: (0.0, f64::INFINITY), y: everywhere, role: Role::RightHalfPlane });
    chart.layers.push(Layer::Level { y: 0.0, role: Role::Muted, pen: Pen::Hair });
    chart.layers.push(Layer::Upright { x: 0.0, role: Role::Muted, pen: Pen::Hair });
    chart.layers.extend(spec.zero_paths.iter().flat_map(|path| by_half_plane(path)));
    chart.layers.extend(spec.closed_loop.iter().map(|&pole| mark(pole, Shape::Diamond, Role::ClosedLoop)));
    chart.layers.extend(spec.poles.iter().map(|&pole| mark(pole, Shape::Cross, Role::Neutral)));
    chart.layers.extend(spec.zeros.iter().map(|&zero| mark(zero, Shape::Ring, side(zero))));
    chart.layers.extend(numbers(spec, chart.x.range));
    chart.legend = legend(&spec.texts, is_beyond(spec, &chart));
    chart
}

/// Whether something is outside the axes.
fn is_beyond(spec: &PoleZero, chart: &Chart) -> bool {
    let within = |v: f64, (low, high): (f64, f64)| (low..=high).contains(&v);
    let finite = |value: &&Complex<f64>| value.re.is_finite() && value.im.is_finite();
    let all = spec.poles.iter().chain(spec.zeros).chain(spec.closed_loop).filter(finite);
    all.into_iter().any(|value| !within(value.re, chart.x.range) || !within(value.im, chart.y.range))
}

fn side(value: Complex<f64>) -> Role {
    match value.re {
        re if re > 0.0 => Role::RightHalfPlane,
        re if re < 0.0 => Role::MinimumPhase,
        _ => Role::Neutral,
    }
}

/// Ranges of the real and of the imaginary axis, with room around.
fn ranges(spec: &PoleZero) -> ((f64, f64), (f64, f64)) {
    let finite = |value: &&Complex<f64>| value.re.is_finite() && value.im.is_finite();
    let fastest = spec.poles.iter().filter(finite).map(|pole| pole.norm()).fold(0.0, f64::max);
    let reach = if fastest > 0.0 { REACH * fastest } else { f64::INFINITY };
    let (mut low, mut high, mut top) = (0.0_f64, 0.0_f64, 0.0_f64);
    for value in spec.poles.iter().chain(spec.zeros).chain(spec.closed_loop).filter(finite) {
        if value.norm() <= reach {
            (low, high, top) = (low.min(value.re), high.max(value.re), top.max(value.im.abs()));
        }
    }
    let width = if high > low { high - low } else { 1.0 };
    // The right half-plane is always in sight, as is the imaginary axis when there is nothing to the left of it.
    let right = (high + 0.12 * width).max(0.25 * width);
    let half_height = (1.25 * top).max(0.2 * width);
    ((low - 0.12 * width, right), (-half_height, half_height))
}

fn mark(at: Complex<f64>, shape: Shape, role: Role) -> Layer<'static> {
    Layer::Marker(Marker { at: (at.re, at.im), shape, role, points_beyond: true })
}

/// The path of a zero in each half-plane, in the colour that it has there.
fn by_half_plane(path: &[Complex<f64>]) -> Vec<Layer<'static>> {
    let path_in = |role, limit: fn(f64, f64) -> f64| {
        Layer::Line(Series {
            name: "".into(),
            role,
            pen: Pen::Trail,
            course: Course::Straight,
            x: path.iter().map(|zero| limit(zero.re, 0.0)).collect(),
            y: path.iter().map(|zero| zero.im).collect(),
            y_scale: 1.0,
        })
    };
    vec![path_in(Role::MinimumPhase, f64::min), path_in(Role::RightHalfPlane, f64::max)]
}

/// The value beside each zero, in turn above and below where zeros are close together.
fn numbers(spec: &PoleZero, (low, high): (f64, f64)) -> Vec<Layer<'static>> {
    let mut previous: Option<(f64, bool)> = None;
    let label = |zero: &Complex<f64>| {
        let close = previous.filter(|(re, _)| (zero.re - re).abs() < CLOSE * (high - low));
        let above = close.is_none_or(|(_, above)| !above);
        previous = Some((zero.re, above));
        Layer::Label(Label {
            at: (zero.re, zero.im),
            offset: (0.0, if above { -15.0 } else { 15.0 }),
            anchor: Anchor::Middle,
            text: number(*zero, spec.decimal),
            role: Role::Neutral,
            bold: true,
            on_ground: false,
            opposite: None,
        })
    };
    spec.zeros.iter().filter(|zero| zero.re.is_finite() && zero.im.is_finite()).map(label).collect()
}

fn number(value: Complex<f64>, decimal: char) -> String {
    let real = signed(value.re, DIGITS, decimal);
    if value.im.abs() <= 1e-9 * value.re.abs() {
        return real;
    }
    let imaginary = signed(value.im, DIGITS, decimal);
    format!("{real} {imaginary}j")
}

fn legend(texts: &PoleZeroTexts, beyond: bool) -> Vec<Entry> {
    let entry = |shape, role, text: &str| Entry { sample: Sample::Mark(shape), role, text: text.into() };
    let mut legend = vec![
        entry(Shape::Cross, Role::Neutral, texts.poles),
        entry(Shape::Ring, Role::MinimumPhase, texts.zeros),
        entry(Shape::Diamond, Role::ClosedLoop, texts.closed_loop),
    ];
    legend.extend(beyond.then(|| entry(Shape::Arrow, Role::Muted, texts.beyond)));
    legend.retain(|entry| !entry.text.is_empty());
    legend
}
