use std::borrow::Cow;

use super::Axis;

/// A chart as plain data: two axes and what is drawn between them, from the back to the front. Nothing here knows
/// pixels or colours; [`layout`](super::layout) and [`Palette`](super::Palette) add those.
///
/// Series borrow their columns from whoever owns them (a trajectory, say), so a chart is cheap to build anew for every
/// frame; a chart of owned columns is a `Chart<'static>`.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart<'a> {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, from the back to the front.
    pub layers: Vec<Layer<'a>>,
    /// Explanation of lines and markers above the plot; empty where the page around the chart explains them.
    pub legend: Vec<Entry>,
    /// Share of the height among the charts of a figure.
    pub weight: f64,
    /// Whether the plot is as high as wide.
    pub square: bool,
}

impl<'a> Chart<'a> {
    /// A chart without content.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self { x, y, layers: Vec::new(), legend: Vec::new(), weight: 1.0, square: false }
    }

    /// What stays while curves move: axes, legend, and what stands for something fixed.
    pub fn ground(&self) -> Chart<'static> {
        let layers = self.layers.iter().filter_map(Layer::ground).collect();
        Chart { x: self.x.clone(), y: self.y.clone(), layers, legend: self.legend.clone(), ..*self }
    }

    /// Whether `ground` is that of this chart.
    pub fn has_ground(&self, ground: &Chart) -> bool {
        (self.weight, self.square) == (ground.weight, ground.square)
            && (&self.x, &self.y, &self.legend) == (&ground.x, &ground.y, &ground.legend)
            && self.layers.iter().filter(|layer| layer.is_ground()).eq(&ground.layers)
    }

    /// The series among the layers, from the back to the front.
    pub fn series(&self) -> impl Iterator<Item = &Series<'a>> {
        self.layers.iter().filter_map(|layer| match layer {
            Layer::Line(series) => Some(series),
            _ => None,
        })
    }
}

/// One thing that is drawn in a chart. What lies outside the plot rectangle is cut off.
#[derive(Clone, Debug, PartialEq)]
pub enum Layer<'a> {
    /// Smooth shading of the whole plane.
    Field(Field),
    /// Shading cell by cell.
    Cells(Cells),
    /// A rectangle in a pale shade of its role; bounds may be infinite, so half-planes and bands are regions too.
    Region {
        /// Left and right bound.
        x: (f64, f64),
        /// Lower and upper bound.
        y: (f64, f64),
        /// What it stands for.
        role: Role,
    },
    /// A curve.
    Line(Series<'a>),
    /// A straight line across the plot, upright at a value of x.
    Upright {
        /// Where.
        x: f64,
        /// What it stands for.
        role: Role,
        /// How it is drawn.
        pen: Pen,
    },
    /// A straight line across the plot, level at a value of y.
    Level {
        /// Where.
        y: f64,
        /// What it stands for.
        role: Role,
        /// How it is drawn.
        pen: Pen,
    },
    /// A mark at a point.
    Marker(Marker),
    /// A word at a point.
    Label(Label),
    /// Words beside points, out of each other's way.
    Names(Names),
    /// Words of a letter or two in the margin to the right, each at the height of its point and apart from the others.
    Ends(Vec<Name>),
}

impl Layer<'_> {
    /// Whether it is a shade, which lies under the grid.
    pub(super) fn is_shade(&self) -> bool {
        matches!(self, Self::Field(_) | Self::Cells(_) | Self::Region { .. })
    }

    /// Whether it stays while other things move: shades, and what was.
    pub(super) fn is_ground(&self) -> bool {
        self.is_shade() || matches!(self, Self::Line(Series { pen: Pen::Faded | Pen::Pinned(_), .. }))
    }

    /// The same with columns of its own, if it is of the ground.
    fn ground(&self) -> Option<Layer<'static>> {
        match self {
            Self::Field(field) => Some(Layer::Field(field.clone())),
            Self::Cells(cells) => Some(Layer::Cells(cells.clone())),
            &Self::Region { x, y, role } => Some(Layer::Region { x, y, role }),
            Self::Line(series) if self.is_ground() => Some(Layer::Line(series.detached())),
            _ => None,
        }
    }
}

/// What a thing in a chart stands for; decides its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// Loop 1 with its level, reference and pump.
    Loop1,
    /// Loop 2 with its level, reference and pump.
    Loop2,
    /// Left half-plane, minimum phase.
    MinimumPhase,
    /// Right half-plane: a zero or a pole on the wrong side.
    RightHalfPlane,
    /// Poles of the closed loop.
    ClosedLoop,
    /// Anything else.
    Neutral,
    /// Anything else, in the background.
    Muted,
}

impl Role {
    /// The role of loop 1 or 2, by index 0 or 1.
    pub fn of_loop(index: usize) -> Self {
        if index == 0 { Self::Loop1 } else { Self::Loop2 }
    }
}

/// How a line is drawn. The meaning is the same in every chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pen {
    /// What happens: the nonlinear plant.
    Solid,
    /// The same, so broad that its edges are seen where another curve lies on it.
    Broad,
    /// What the linear model says.
    Dotted,
    /// What is wanted: references; and limits.
    Dashed,
    /// What it is compared with.
    Faded,
    /// A pinned run, by its index: a pale line whose dashes depend on the index.
    Pinned(u8),
    /// A thin line that only guides the eye.
    Hair,
    /// The path of a mark: broad and pale.
    Trail,
}

/// Lengths drawn and left out of the dashes of pinned runs (CSS px); the first is whole.
const PINNED_DASHES: [Option<(f64, f64)>; 8] = [
    None,
    Some((12.0, 3.0)),
    Some((6.0, 6.0)),
    Some((2.0, 4.0)),
    Some((18.0, 6.0)),
    Some((9.0, 2.0)),
    Some((4.0, 8.0)),
    Some((12.0, 9.0)),
];

impl Pen {
    /// Lengths drawn and left out (CSS px); `None` for a whole line.
    pub fn dash(self) -> Option<(f64, f64)> {
        match self {
            Self::Dotted => Some((1.8, 2.7)),
            Self::Dashed => Some((5.0, 3.5)),
            Self::Pinned(place) => PINNED_DASHES[usize::from(place) % PINNED_DASHES.len()],
            Self::Solid | Self::Broad | Self::Faded | Self::Hair | Self::Trail => None,
        }
    }
}

/// How a curve goes from one point to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// Straight.
    Straight,
    /// It holds its value until the next point, as the input of a sampled loop does.
    Held,
}

/// A curve: two columns of equal length (if not, the shorter counts). A point that is not finite interrupts it.
#[derive(Clone, Debug, PartialEq)]
pub struct Series<'a> {
    /// Name as shown in tables; may be empty.
    pub name: Cow<'a, str>,
    /// What it stands for.
    pub role: Role,
    /// How it is drawn.
    pub pen: Pen,
    /// From point to point.
    pub course: Course,
    /// Abscissae. Rising ones are drawn at a cost that hardly depends on their number.
    pub x: Cow<'a, [f64]>,
    /// Ordinates in the unit of their source.
    pub y: Cow<'a, [f64]>,
    /// Factor from that unit to the one of the axis.
    pub y_scale: f64,
}

impl Series<'_> {
    /// The same with columns of its own.
    fn detached(&self) -> Series<'static> {
        let owned = |column: &[f64]| Cow::Owned(column.to_vec());
        let (x, y, name) = (owned(&self.x), owned(&self.y), Cow::Owned(self.name.to_string()));
        Series { name, x, y, ..*self }
    }
}

/// A function on a rectangle, for shading: −1 is deep in the minimum-phase colour, 0 the background, +1 deep in the
/// colour of the right half-plane.
///
/// Values are sampled on a grid of nodes, row by row from below. Shading of either sign must be one interval in every
/// row, which holds for any function that is monotone in x.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Left and right end.
    pub x: (f64, f64),
    /// Lower and upper end.
    pub y: (f64, f64),
    /// Nodes in a row, at least 2.
    pub columns: usize,
    /// Shades at the nodes, `rows × columns`.
    pub shades: Vec<f64>,
}

/// A grid of shaded cells around nodes. These are evenly spaced as the axes are drawn: in the logarithm, if an axis is logarithmic.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// First and last node of a row.
    pub x: (f64, f64),
    /// First and last node of a column.
    pub y: (f64, f64),
    /// Cells in a row.
    pub columns: usize,
    /// The cells, row by row from below.
    pub cells: Vec<Cell>,
}

/// How a cell is filled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// Not at all.
    Empty,
    /// By a shade between 0, pale, and 1, deep.
    Shade(f64),
    /// By the pale warm colour, hatched: what is ruled out.
    Hatched,
}

/// A mark at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Where (x, y).
    pub at: (f64, f64),
    /// Its shape.
    pub shape: Shape,
    /// What it stands for.
    pub role: Role,
    /// Whether a point outside the plot shows as an arrow at its edge instead of nothing.
    pub points_beyond: bool,
}

/// The shape of a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// × (poles).
    Cross,
    /// ○ (zeros).
    Ring,
    /// ◆ (closed-loop poles).
    Diamond,
    /// A small ring with the background inside (published points).
    Point,
    /// A small disc (one of many).
    Dot,
    /// A large disc that can be dragged.
    Handle,
    /// ▸ (something outside the plot).
    Arrow,
}

/// A word at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Where (x, y).
    pub at: (f64, f64),
    /// Offset from there in CSS px, to the right and downwards.
    pub offset: (f64, f64),
    /// Which side of the text is there.
    pub anchor: Anchor,
    /// The text.
    pub text: String,
    /// Its colour.
    pub role: Role,
    /// Whether it is bold.
    pub bold: bool,
    /// Whether it stands on a piece of the background, so that no curve strikes it through.
    pub on_ground: bool,
    /// The y value of a second point, whose label is on the opposite side. With it the label may change sides, above its point instead of
    /// below or the other way round, where an edge of the plot would push it onto its point and the two points leave room for
    /// both labels between them; `None` for a label that stays on its side.
    pub opposite: Option<f64>,
}

/// Words beside points. Each stands where it covers the least of the words before it, of their points, and of other points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Names {
    /// The words.
    pub names: Vec<Name>,
    /// Other points that they keep off where they can.
    pub around: Vec<(f64, f64)>,
    /// Whether each stands on a piece of the background, so that no curve strikes it through.
    pub on_ground: bool,
}

/// A word beside a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The point.
    pub at: (f64, f64),
    /// The text.
    pub text: String,
    /// Its colour.
    pub role: Role,
    /// Whether it is bold.
    pub bold: bool,
}

/// Which part of a text stands at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Left,
    /// Its middle.
    Middle,
    /// Its right end.
    Right,
}

/// A line of the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The sample in front of the text.
    pub sample: Sample,
    /// What it stands for.
    pub role: Role,
    /// The text.
    pub text: String,
}

/// The sample of a legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// A piece of line.
    Line(Pen),
    /// A mark.
    Mark(Shape),
}
