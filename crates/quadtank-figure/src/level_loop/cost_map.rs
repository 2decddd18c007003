use super::super::{Axis, Cell, Cells, Chart, Layer, Name, Names, Pen, Role, Shape};
use super::{NamedPoint, between, curve, mark, marks, words};

/// Steps of the shading from the best cost to the worst: few enough that their edges are contours.
const BANDS: f64 = 12.0;
/// Lines of paths, one after the other, so that they differ without colour.
const PENS: [Pen; 3] = [Pen::Solid, Pen::Dashed, Pen::Dotted];

/// What a cell of the map shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CostCell {
    /// The cost.
    Cost(f64),
    /// A constraint is broken.
    Violates,
    /// There is no run.
    None,
    /// It is not computed yet.
    Pending,
}

/// What the map shows.
#[derive(Clone, Debug)]
pub struct CostMapChart<'a> {
    /// First and last gain of the cells.
    pub gains: (f64, f64),
    /// First and last integral time (s).
    pub times_s: (f64, f64),
    /// Number of gains and of integral times, each evenly in the logarithm.
    pub size: [usize; 2],
    /// The cells, gains first.
    pub cells: &'a [CostCell],
    /// Paths of searches (gain, integral time), with their names.
    pub paths: Vec<(&'a str, Vec<(f64, f64)>)>,
    /// Candidates of a search.
    pub population: Vec<(f64, f64)>,
    /// Tunings.
    pub points: Vec<NamedPoint<'a>>,
    /// The present tuning.
    pub present: Option<(f64, f64)>,
    /// Names with units of the axes: gain, integral time.
    pub axes: [&'a str; 2],
}

/// The cost over gain and integral time, both logarithmic: the deeper the better, in steps of the logarithm of the cost between the best
/// and the worst. What breaks a constraint is hatched; where there is no cost, there is no shade.
pub fn cost_map<'a>(spec: &CostMapChart<'a>) -> Chart<'a> {
    let [columns, rows] = spec.size;
    let mut chart = Chart::new(
        Axis::logarithmic(spec.axes[0], around(spec.gains, columns)),
        Axis::logarithmic(spec.axes[1], around(spec.times_s, rows)),
    );
    let cells = shaded(spec.cells.get(..columns.saturating_mul(rows)).unwrap_or(spec.cells));
    chart.layers.push(Layer::Cells(Cells { x: spec.gains, y: spec.times_s, columns, cells }));
    chart.layers.extend(spec.population.iter().map(|&at| mark(at, Shape::Dot, Role::Neutral)));
    let mut names: Vec<Name> = words(&spec.points).collect();
    for ((name, path), pen) in spec.paths.iter().zip(PENS.into_iter().cycle()) {
        let (x, y): (Vec<f64>, Vec<f64>) = path.iter().copied().unzip();
        chart.layers.push(curve("", Role::Neutral, pen, x, y));
        let (Some(&first), Some(&last)) = (path.first(), path.last()) else { continue };
        chart.layers.push(mark(first, Shape::Dot, Role::Neutral));
        chart.layers.push(mark(last, Shape::Diamond, Role::Neutral));
        names.push(Name { at: last, text: (*name).to_owned(), role: Role::Neutral, bold: false });
    }
    chart.layers.extend(marks(&spec.points));
    chart.layers.extend(spec.present.map(|at| mark(at, Shape::Handle, Role::Neutral)));
    let paths = spec.paths.iter().flat_map(|(_, path)| between(path));
    chart.layers.push(Layer::Names(Names { names, around: paths.chain(spec.present).collect(), on_ground: false }));
    chart
}

/// The range of cells around nodes: half a cell more to either side.
fn around((first, last): (f64, f64), count: usize) -> (f64, f64) {
    let half = (last / first).powf(0.5 / (count.max(2) - 1) as f64);
    (first / half, last * half)
}

/// The cells with their shades. A cost of nothing is as good as the best.
fn shaded(cells: &[CostCell]) -> Vec<Cell> {
    let finite = cells.iter().filter_map(|cell| match cell {
        CostCell::Cost(cost) if cost.is_finite() && *cost > 0.0 => Some(cost.ln()),
        _ => None,
    });
    let (best, worst) =
        finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(best, worst), cost| (best.min(cost), worst.max(cost)));
    let shade = |cost: f64| {
        let share = if worst > best { (cost.ln() - best) / (worst - best) } else { 0.0 };
        let band = (BANDS * share.max(0.0)).floor().min(BANDS - 1.0);
        1.0 - band / (BANDS - 1.0)
    };
    let cell = |cell: &CostCell| match *cell {
        CostCell::Cost(cost) if cost.is_finite() => Cell::Shade(shade(cost)),
        CostCell::Violates => Cell::Hatched,
        CostCell::Cost(_) | CostCell::None | CostCell::Pending => Cell::Empty,
    };
    cells.iter().map(cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_cost_is_the_deepest_and_steps_are_those_of_the_logarithm() {
        let costs = [1.0, 1.01, 10.0, 100.0, f64::INFINITY, f64::NAN, 0.0, -1.0];
        let mut cells: Vec<CostCell> = costs.into_iter().map(CostCell::Cost).collect();
        cells.extend([CostCell::Violates, CostCell::None, CostCell::Pending]);
        let [best, like_best, middle, worst, infinite, nan, zero, negative, broken, none, pending] = shaded(&cells)[..]
        else {
            panic!("a cell for each")
        };
        assert_eq!((best, like_best, worst), (Cell::Shade(1.0), Cell::Shade(1.0), Cell::Shade(0.0)));
        assert!(matches!(middle, Cell::Shade(shade) if (shade - 0.5).abs() < 0.1));
        assert_eq!([infinite, nan, none, pending], [Cell::Empty; 4]);
        assert_eq!((broken, zero), (Cell::Hatched, Cell::Shade(1.0)));
        assert_eq!(negative, Cell::Shade(1.0));
        assert_eq!(shaded(&[CostCell::Cost(7.0); 2]), [Cell::Shade(1.0); 2]);
    }

    #[test]
    fn the_axes_end_half_a_cell_beyond_the_nodes() {
        let cells = [CostCell::Pending; 6];
        let chart = cost_map(&CostMapChart {
            gains: (1.0, 100.0),
            times_s: (10.0, 1000.0),
            size: [3, 2],
            cells: &cells,
            paths: vec![("simplex", vec![(1.0, 10.0), (3.0, 200.0)]), ("gradient", Vec::new())],
            population: vec![(2.0, 20.0)],
            points: Vec::new(),
            present: Some((5.0, 100.0)),
            axes: ["Kp", "Ti"],
        });
        let near = |a: (f64, f64), b: (f64, f64)| (a.0 / b.0 - 1.0).abs() < 1e-9 && (a.1 / b.1 - 1.0).abs() < 1e-9;
        assert!(near(chart.x.range, (10f64.powf(-0.5), 10f64.powf(2.5))), "{:?}", chart.x.range);
        assert!(near(chart.y.range, (1.0, 1e4)), "{:?}", chart.y.range);
        assert!(matches!(&chart.layers[0], Layer::Cells(cells) if cells.columns == 3 && cells.cells.len() == 6));
    }
}
