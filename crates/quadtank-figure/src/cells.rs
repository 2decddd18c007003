//! A grid of shaded cells as rectangles and hatching.

use super::trace::{Px, clipped};
use super::{Cell, Cells, Frame, Rect};

/// Equal neighbours of a row as one rectangle, corner to corner (CSS px).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Block {
    /// How it is filled.
    pub cell: Cell,
    /// Upper left corner.
    pub from: Px,
    /// Lower right corner.
    pub to: Px,
}

/// The edges between cells along both axes (CSS px), one more than there are cells.
struct Edges {
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Edges {
    fn of(cells: &Cells, frame: &Frame) -> Option<Self> {
        let plot = &frame.plot;
        let rows = cells.cells.len().checked_div(cells.columns)?;
        let x = edges((frame.x_px(cells.x.0), frame.x_px(cells.x.1)), cells.columns, (plot.left, plot.right()))?;
        let y = edges((frame.y_px(cells.y.0), frame.y_px(cells.y.1)), rows, (plot.bottom(), plot.top))?;
        Some(Self { x, y })
    }
}

/// Edges halfway between nodes; a single cell takes all there is.
fn edges((first, last): Px, count: usize, all: Px) -> Option<Vec<f64>> {
    if count < 2 {
        return (count == 1).then(|| vec![all.0, all.1]);
    }
    let step = (last - first) / (count - 1) as f64;
    let edge = |k: usize| first + (k as f64 - 0.5) * step;
    step.is_finite().then(|| (0..=count).map(edge).collect())
}

/// What to fill, one shade after the other, so that a backend can fill all of a shade at once. Edges are on whole pixels: between two
/// that are not, the background would shine through.
pub(super) fn blocks(cells: &Cells, frame: &Frame) -> Vec<Block> {
    let Some(edges) = Edges::of(cells, frame) else { return Vec::new() };
    let mut blocks: Vec<Block> = Vec::new();
    for (row, line) in cells.cells.chunks_exact(cells.columns).enumerate() {
        let mut column = 0;
        for run in line.chunk_by(|a, b| a == b) {
            let (first, end) = (column, column + run.len());
            column = end;
            if run[0] != Cell::Empty {
                blocks.extend(block(
                    run[0],
                    &frame.plot,
                    (edges.x[first], edges.y[row]),
                    (edges.x[end], edges.y[row + 1]),
                ));
            }
        }
    }
    blocks.sort_by(|a, b| depth(a.cell).total_cmp(&depth(b.cell)));
    blocks
}

fn depth(cell: Cell) -> f64 {
    match cell {
        Cell::Empty | Cell::Hatched => -1.0,
        Cell::Shade(depth) => depth,
    }
}

fn block(cell: Cell, plot: &Rect, a: Px, b: Px) -> Option<Block> {
    let x = |x: f64| x.clamp(plot.left, plot.right()).round();
    let y = |y: f64| y.clamp(plot.top, plot.bottom()).round();
    let (from, to) = ((x(a.0.min(b.0)), y(a.1.min(b.1))), (x(a.0.max(b.0)), y(a.1.max(b.1))));
    (from.0 < to.0 && from.1 < to.1).then_some(Block { cell, from, to })
}

/// The hatching: a line from corner to corner of each hatched cell, whole along a diagonal of them.
pub(super) fn hatching(cells: &Cells, frame: &Frame) -> Vec<[Px; 2]> {
    let Some(edges) = Edges::of(cells, frame) else { return Vec::new() };
    let columns = cells.columns;
    let rows = edges.y.len() - 1;
    let is_hatched = |row: usize, column: usize| {
        row < rows && column < columns && cells.cells.get(row * columns + column) == Some(&Cell::Hatched)
    };
    let mut lines = Vec::new();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let continues = row > 0 && column > 0 && is_hatched(row - 1, column - 1);
        if continues || !is_hatched(row, column) {
            continue;
        }
        let length = (0..rows).take_while(|&step| is_hatched(row + step, column + step)).count();
        let corner = |step: usize| (edges.x[column + step], edges.y[row + step]);
        lines.extend(clipped(&frame.plot, corner(0), corner(length)).map(|(from, to)| [from, to]));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Chart, Size, layout};

    const E: Cell = Cell::Empty;
    const H: Cell = Cell::Hatched;
    const A: Cell = Cell::Shade(0.5);
    const B: Cell = Cell::Shade(1.0);

    /// Cells around 1, 10 and 100, a third of the plot each way.
    fn grid(cells: [[Cell; 3]; 3]) -> (Cells, Frame) {
        let range = (10f64.powf(-0.5), 10f64.powf(2.5));
        let chart = Chart::new(Axis::logarithmic("", range), Axis::logarithmic("", range));
        let frame = layout(&[chart], Size { width: 400.0, height: 300.0 })[0];
        (Cells { x: (1.0, 100.0), y: (1.0, 100.0), columns: 3, cells: cells.concat() }, frame)
    }

    #[test]
    fn equal_neighbours_of_a_row_are_one_rectangle() {
        let (cells, frame) = grid([[B, B, A], [A, A, A], [E, H, B]]);
        let blocks = blocks(&cells, &frame);
        assert_eq!(blocks.iter().map(|block| block.cell).collect::<Vec<_>>(), [H, A, A, B, B]);
        let Block { from, to, .. } = blocks[2];
        assert_eq!((from.0, to.0), (frame.plot.left, frame.plot.right()));
        assert!((to.1 - from.1 - frame.plot.height / 3.0).abs() <= 1.0);
        let third = frame.plot.left + frame.plot.width / 3.0;
        assert!((blocks[3].to.0 - third * 2.0 + frame.plot.left).abs() <= 1.0 && blocks[3].to.1 == frame.plot.bottom());
        assert!(blocks.iter().all(|block| block.from.0.fract() == 0.0 && block.to.1.fract() == 0.0));
    }

    #[test]
    fn hatching_goes_on_along_a_diagonal() {
        let (cells, frame) = grid([[H, H, A], [A, H, H], [A, A, H]]);
        let lines = hatching(&cells, &frame);
        assert_eq!(lines.len(), 2);
        let (from, to) = (lines[0][0], lines[0][1]);
        assert!((from.0 - frame.plot.left).abs() < 1e-6 && (from.1 - frame.plot.bottom()).abs() < 1e-6);
        assert!((to.0 - frame.plot.right()).abs() < 1e-6 && (to.1 - frame.plot.top).abs() < 1e-6);
    }

    #[test]
    fn a_grid_without_sense_is_nothing() {
        let (cells, frame) = grid([[B; 3]; 3]);
        for grid in [
            Cells { columns: 0, ..cells.clone() },
            Cells { cells: Vec::new(), ..cells.clone() },
            Cells { columns: 10, ..cells.clone() },
            Cells { x: (f64::NAN, 1.0), ..cells.clone() },
            Cells { x: (-1.0, 1.0), ..cells.clone() },
            Cells { x: (1e9, 1e12), ..cells.clone() },
        ] {
            assert!(blocks(&grid, &frame).is_empty() && hatching(&grid, &frame).is_empty(), "{grid:?}");
        }
        let one = Cells { columns: 1, cells: vec![H], ..cells };
        assert_eq!((blocks(&one, &frame).len(), hatching(&one, &frame).len()), (1, 1));
    }
}
