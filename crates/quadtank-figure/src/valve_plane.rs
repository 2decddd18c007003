use super::{Anchor, Axis, Chart, Course, Field, Label, Layer, Marker, Pen, Role, Series, Shape};

/// Steps of the shading along each axis.
const STEPS: u32 = 40;

/// The setting whose zero is shaded halfway to the full colour: about half the reciprocal time constant of the upper tanks shows both
/// sides, because zeros to the left hardly pass that reciprocal and those to the right have no bound.
const TYPICAL_SETTING: [f64; 2] = [0.3, 0.3];
/// What is shaded halfway where that setting has no zero (1/s).
const USUAL_ZERO: f64 = 1.0;

/// What the valve plane shows.
pub struct ValvePlane<'a> {
    /// Right-most transmission zero at the valve fractions γ1, γ2 (1/s); `None` where there is none that is finite.
    pub right_most_zero: &'a dyn Fn([f64; 2]) -> Option<f64>,
    /// The sum γ1 + γ2 at which it crosses into the right half-plane: 1, but where fractions depend on the flow.
    pub singular_sum: f64,
    /// Published settings: name, γ1, γ2.
    pub published: &'a [(&'a str, [f64; 2])],
    /// The present setting, for pictures; on screen it is a handle laid over the chart.
    pub setting: Option<[f64; 2]>,
    /// Words.
    pub texts: ValvePlaneTexts<'a>,
}

/// The words of the valve plane.
#[derive(Clone, Copy, Debug, Default)]
pub struct ValvePlaneTexts<'a> {
    /// Name of γ1, with its unit if it has one.
    pub gamma_1: &'a str,
    /// Name of γ2.
    pub gamma_2: &'a str,
    /// Beside the line on which the right-most zero is at the origin.
    pub boundary: &'a str,
    /// Above that line.
    pub minimum_phase: &'a str,
    /// Below it.
    pub right_half_plane: &'a str,
}

/// The plane of the two valves (Johansson 2000): shaded by the right-most zero, which crosses into the right
/// half-plane where γ1 + γ2 falls below 1, or below the sum that takes its place.
pub fn valve_plane(spec: &ValvePlane) -> Chart<'static> {
    let mut chart = Chart::new(Axis::new(spec.texts.gamma_1, (0.0, 1.0)), Axis::new(spec.texts.gamma_2, (0.0, 1.0)));
    chart.square = true;
    chart.layers.push(Layer::Field(shading(spec)));
    let ends = boundary(spec.singular_sum);
    chart.layers.extend(ends.map(|ends| line(Role::Neutral, Pen::Solid, ends)));
    chart.layers.extend(words(&spec.texts, ends));
    for &(name, [x, y]) in spec.published {
        chart.layers.push(mark((x, y), Shape::Point));
        chart.layers.push(word((x, y), (8.0, 0.0), Anchor::Left, name));
    }
    if let Some([x, y]) = spec.setting {
        chart.layers.push(line(Role::Neutral, Pen::Dotted, [(0.0, y), (x, y)]));
        chart.layers.push(line(Role::Neutral, Pen::Dotted, [(x, y), (x, 0.0)]));
        chart.layers.push(mark((x, y), Shape::Handle));
    }
    chart
}

/// The plane with the path of the valves, γ1 and γ2 in order of time.
pub fn with_valve_path<'a>(mut plane: Chart<'a>, way: &[[f64; 2]]) -> Chart<'a> {
    plane.layers.push(Layer::Line(Series {
        name: "γ(t)".into(),
        role: Role::Neutral,
        pen: Pen::Solid,
        course: Course::Straight,
        x: way.iter().map(|valves| valves[0]).collect(),
        y: way.iter().map(|valves| valves[1]).collect(),
        y_scale: 1.0,
    }));
    plane
}

fn shading(spec: &ValvePlane) -> Field {
    let node = |step: u32| f64::from(step) / f64::from(STEPS);
    let halfway = (spec.right_most_zero)(TYPICAL_SETTING).unwrap_or(USUAL_ZERO).abs().max(f64::MIN_POSITIVE);
    let shade = |row: u32, column: u32| shade(spec, halfway, [node(column), node(row)]);
    let shades = (0..=STEPS).flat_map(|row| (0..=STEPS).map(move |column| shade(row, column)));
    Field { x: (0.0, 1.0), y: (0.0, 1.0), columns: STEPS as usize + 1, shades: shades.collect() }
}

/// From −1 for a zero far to the left to 1 for one far to the right, ½ for the zero `halfway` (1/s). Without a finite zero the side of the line counts.
fn shade(spec: &ValvePlane, halfway: f64, gammas: [f64; 2]) -> f64 {
    let below_line = spec.singular_sum - gammas.iter().sum::<f64>();
    match (spec.right_most_zero)(gammas).filter(|zero| zero.is_finite()) {
        Some(zero) => zero / (zero.abs() + halfway),
        None if below_line == 0.0 => 0.0,
        None => below_line.signum(),
    }
}

/// Ends of the line γ1 + γ2 = `sum` within the plane; `None` where it misses the plane.
fn boundary(sum: f64) -> Option<[(f64, f64); 2]> {
    let (least, most) = ((sum - 1.0).max(0.0), sum.min(1.0));
    (least < most).then_some([(least, most), (most, least)])
}

/// The names of the line, beside its upper end, and of both sides that the plane has.
fn words(texts: &ValvePlaneTexts, ends: Option<[(f64, f64); 2]>) -> impl Iterator<Item = Layer<'static>> {
    let of_line = ends.map(|[upper, _]| {
        // Beside the line on the side that has the room.
        let (offset, anchor) = if upper.0 < 0.5 { ((39.0, 28.0), Anchor::Left) } else { ((14.0, 28.0), Anchor::Right) };
        word(upper, offset, anchor, texts.boundary)
    });
    let of_sides = [
        word((1.0, 1.0), (-6.0, 11.0), Anchor::Right, texts.minimum_phase),
        word((0.0, 0.08), (6.0, 0.0), Anchor::Left, texts.right_half_plane),
    ];
    of_line.into_iter().chain(of_sides)
}

fn word(at: (f64, f64), offset: (f64, f64), anchor: Anchor, text: &str) -> Layer<'static> {
    Layer::Label(Label {
        at,
        offset,
        anchor,
        text: text.into(),
        role: Role::Neutral,
        bold: false,
        on_ground: false,
        opposite: None,
    })
}

fn mark(at: (f64, f64), shape: Shape) -> Layer<'static> {
    Layer::Marker(Marker { at, shape, role: Role::Neutral, points_beyond: false })
}

fn line(role: Role, pen: Pen, [from, to]: [(f64, f64); 2]) -> Layer<'static> {
    Layer::Line(Series {
        name: "".into(),
        role,
        pen,
        course: Course::Straight,
        x: vec![from.0, to.0].into(),
        y: vec![from.1, to.1].into(),
        y_scale: 1.0,
    })
}
