//! The charts of the level loop: any numbers are painted, and pictures of plausible ones to look at.

use proptest::prelude::*;
use quadtank_figure::{
    Chart, CostCell, CostMapChart, LevelLoopCharts, LevelLoopTexts, LevelRunColumns, NamedPoint, Palette, Role, Shape,
    Size, StaticCurve, StepTestCharts, StepTestTexts, Style, TradeOffChart, cost_map, level_loop, static_curve,
    step_test, to_svg, trade_off,
};
use roxmltree::{Document, Node};

use crate::fixture::{SIZE, STYLE};
use crate::properties::{check, number, size};
use crate::recorder::{Drawn, record};

const LOOP_TEXTS: LevelLoopTexts = LevelLoopTexts {
    axes: ["time (s)", "level (cm)", "flow (L/s)", "output (%)"],
    level: "level",
    reference: "set-point",
    inflow: "supply",
    outflow: "outflow",
    output: "output",
    band: "band",
};
const TEST_TEXTS: StepTestTexts =
    StepTestTexts { axes: ["time (s)", "transmitter (%)", "output (%)"], measured: "measured", fitted: "model" };

fn point(name: &str, at: (f64, f64), role: Role, shape: Shape) -> NamedPoint<'_> {
    NamedPoint { name, at, role, shape }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn any_run_of_a_level_loop_is_painted(
        rows in prop::collection::vec((number(), number(), number()), 0..30),
        pinned in prop::collection::vec((number(), number(), number()), 0..30),
        (band, window, range) in ((number(), number()), (number(), number()), (number(), number())),
        size in size(),
    ) {
        let column = |rows: &[(f64, f64, f64)], pick: fn(&(f64, f64, f64)) -> f64| rows.iter().map(pick).collect::<Vec<_>>();
        let columns = |rows: &[(f64, f64, f64)]| [column(rows, |row| row.0), column(rows, |row| row.1), column(rows, |row| row.2)];
        let ([time, one, two], [pinned_time, three, _]) = (columns(&rows), columns(&pinned));
        let run = LevelRunColumns { time_s: &time, level: &one, outflow: &two, output: &one };
        let other = LevelRunColumns { time_s: &pinned_time, level: &three, outflow: &three, output: &[] };
        let charts = level_loop(&LevelLoopCharts {
            run,
            reference: &two,
            inflow: &one,
            pinned: vec![other, run],
            band: Some(band.into()),
            window_s: window,
            output_range: range.into(),
            texts: LOOP_TEXTS,
        });
        check(&charts, size, 8)?;
        let marks = rows.iter().map(|row| ((row.0, row.1), "63.2 %")).collect();
        let (measured, fitted, output) = (&one, Some(&two[..]), &three);
        check(&step_test(&StepTestCharts { time_s: &time, measured, fitted, output, marks, texts: TEST_TEXTS }), size, 8)?;
    }

    #[test]
    fn any_tunings_are_painted(
        values in prop::collection::vec((number(), number()), 0..30),
        (gains, times_s, present) in ((number(), number()), (number(), number()), (number(), number())),
        (columns, rows) in (0..8_usize, 0..8_usize),
        size in size(),
    ) {
        let (x, y): (Vec<f64>, Vec<f64>) = values.iter().copied().unzip();
        let points: Vec<_> = values.iter().take(6).map(|&at| point("rule", at, Role::Loop1, Shape::Ring)).collect();
        let (present, axes) = (Some(present), ["x", "y"]);
        check(&[trade_off(&TradeOffChart { curve: (&x, &y), points: points.clone(), present, axes })], size, 8)?;
        check(&[static_curve(&StaticCurve { x: &x, y: &y, at: present, axes })], size, 8)?;
        let others = [CostCell::Violates, CostCell::None, CostCell::Pending];
        let cells: Vec<_> = x.iter().map(|&cost| CostCell::Cost(cost)).chain(others).collect();
        let map = CostMapChart {
            gains,
            times_s,
            size: [columns, rows],
            cells: &cells,
            paths: vec![("simplex", values.clone()), ("gradient", Vec::new())],
            population: values.clone(),
            points,
            present,
            axes,
        };
        check(&[cost_map(&map)], size, 8)?;
    }
}

#[test]
fn a_map_is_painted_with_few_rectangles_and_belongs_to_the_ground() {
    let mut cells = costs();
    let chart = cost_map(&map(&cells, (2.0, 80.0)));
    let blocks =
        record(std::slice::from_ref(&chart), SIZE, &STYLE).iter().filter(|d| matches!(d, Drawn::Block { .. })).count();
    assert!((12..600).contains(&blocks), "{blocks} rectangles for 1600 cells");
    let moved = cost_map(&map(&cells, (3.0, 60.0)));
    let ground = chart.ground();
    assert!(moved.has_ground(&ground), "the map stays while a tuning is dragged");
    cells[0] = CostCell::Pending;
    assert!(!cost_map(&map(&cells, (2.0, 80.0))).has_ground(&ground));
}

#[test]
fn a_map_has_a_path_for_every_shade() {
    let cells = costs();
    let svg = to_svg(&[cost_map(&map(&cells, (2.0, 80.0)))], SIZE, &STYLE, "", "");
    let document = Document::parse(&svg).expect("well-formed");
    let cells = document.descendants().find(|node| node.attribute("class") == Some("cells")).expect("cells");
    let paths = cells.children().filter(Node::is_element).count();
    assert!((10..=14).contains(&paths), "{paths} paths for 12 shades, a warm one and its hatching");
    assert!(document.descendants().any(|node| node.text() == Some("simplex")));
}

const NODES: usize = 40;

/// A flat valley that bends, a forbidden corner, one without runs, and some cells that are still to come.
fn costs() -> Vec<CostCell> {
    let cell = |row: usize, column: usize| {
        let (gain, time) = (column as f64 / 39.0, row as f64 / 39.0);
        if gain > 0.75 && time < 0.45 - 0.8 * (1.0 - gain) {
            return CostCell::Violates;
        }
        if gain + 0.2 * time > 1.12 {
            return CostCell::None;
        }
        if row > 36 && !column.is_multiple_of(4) {
            return CostCell::Pending;
        }
        let valley = (gain - 0.55 - 0.3 * (time - 0.5) * (time - 0.5)).abs();
        CostCell::Cost((36.0 * valley * valley + 0.2 * (1.0 - time)).exp())
    };
    (0..NODES).flat_map(|row| (0..NODES).map(move |column| cell(row, column))).collect()
}

fn map(cells: &[CostCell], present: (f64, f64)) -> CostMapChart<'_> {
    let walk = |k: i32| (0.3 * 1.22f64.powi(k), 15.0 * (1.0 + 0.12 * f64::from(k * k)));
    let spread = |k: i32| (1.0 * 1.09f64.powi(k * 7 % 30), 20.0 * 1.1f64.powi(k * 11 % 34));
    CostMapChart {
        gains: (0.1, 20.0),
        times_s: (5.0, 1000.0),
        size: [NODES, NODES],
        cells,
        paths: vec![
            ("simplex", (0..12).map(walk).collect()),
            ("gradient", vec![(10.0, 600.0), (6.0, 590.0), (3.0, 450.0), (2.6, 250.0), (2.4, 180.0)]),
        ],
        population: (0..30).map(spread).collect(),
        points: vec![
            point("SIMC", (2.2, 90.0), Role::Loop1, Shape::Point),
            point("Lambda", (1.9, 100.0), Role::Loop2, Shape::Cross),
            point("Ziegler–Nichols", (9.0, 30.0), Role::ClosedLoop, Shape::Ring),
            point("AMIGO", (2.3, 120.0), Role::RightHalfPlane, Shape::Diamond),
            point("outside", (90.0, 90.0), Role::MinimumPhase, Shape::Point),
        ],
        present: Some(present),
        axes: ["gain Kp (%/%)", "integral time Ti (s)"],
    }
}

/// Writes the charts into the directory `PICTURES`, light and dark.
#[test]
#[ignore = "writes pictures to look at"]
fn pictures() {
    let Ok(directory) = std::env::var("PICTURES") else { return };
    let write = |name: &str, charts: &[Chart], size: Size| {
        for (theme, palette) in [("light", Palette::LIGHT), ("dark", Palette::DARK)] {
            let svg = to_svg(charts, size, &Style { palette, ..STYLE }, name, "");
            std::fs::write(format!("{directory}/{name}-{theme}.svg"), svg).expect("a directory to write to");
        }
    };
    let time: Vec<f64> = (0..=600).map(f64::from).collect();
    let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|&t| f(t)).collect::<Vec<f64>>();
    let inflow = of(&|t| 0.0012 + 0.0002 * (t / 30.0).sin());
    let run = |lag: f64| {
        let level = of(&|t| 0.5 + 0.02 * lag * ((t - 10.0 * lag) / 30.0).sin() + if t > 300.0 { 0.02 } else { 0.0 });
        let outflow = of(&|t| 0.0012 + 0.0002 / (1.0 + lag) * ((t - 20.0 * lag) / 30.0).sin());
        (level, outflow, of(&|t| 50.0 + 20.0 / (1.0 + lag) * ((t - 20.0 * lag) / 30.0).sin()))
    };
    let runs = [run(1.0), run(0.4), run(2.0)];
    let columns = |k: usize| {
        let (level, outflow, output) = &runs[k];
        LevelRunColumns { time_s: &time, level, outflow, output }
    };
    let reference = of(&|t| if t < 300.0 { 0.5 } else { 0.52 });
    let loop_spec = LevelLoopCharts {
        run: columns(0),
        reference: &reference,
        inflow: &inflow,
        pinned: vec![columns(1), columns(2)],
        band: None,
        window_s: (0.0, 600.0),
        output_range: [0.0, 100.0],
        texts: LOOP_TEXTS,
    };
    write("loop", &level_loop(&loop_spec), Size { width: 640.0, height: 520.0 });
    let banded = LevelLoopCharts { band: Some([0.4, 0.6]), output_range: [45.0, 55.0], pinned: vec![], ..loop_spec };
    write("loop-band", &level_loop(&banded), Size { width: 360.0, height: 460.0 });

    let measured = of(&|t| 50.0 + if t < 60.0 { 0.0 } else { 8.0 * (1.0 - (-(t - 60.0) / 90.0).exp()).powi(2) });
    let fitted = of(&|t| 50.0 + if t < 90.0 { 0.0 } else { 8.0 * (1.0 - (-(t - 90.0) / 110.0).exp()) });
    let output = of(&|t| if t < 60.0 { 40.0 } else { 45.0 });
    let marks = vec![((130.0, 52.26), "28.3 %"), ((200.0, 55.06), "63.2 %")];
    let test = StepTestCharts {
        time_s: &time,
        measured: &measured,
        fitted: Some(&fitted),
        output: &output,
        marks,
        texts: TEST_TEXTS,
    };
    write("step-test", &step_test(&test), Size { width: 520.0, height: 380.0 });

    let share = |k: i32| f64::from(k) / 16.0;
    let x: Vec<f64> = (0..17).map(|k| 2e-10 * 10f64.powf(2.4 * share(k))).collect();
    let y: Vec<f64> = (0..17).map(|k| 3e-2 * 10f64.powf(-2.6 * share(k).sqrt()) + 5e-5).collect();
    let points = vec![
        point("present", (2e-9, 6e-4), Role::Loop1, Shape::Point),
        point("SIMC", (2.4e-9, 5.0e-4), Role::Loop1, Shape::Ring),
        point("Lambda", (2.6e-9, 5.6e-4), Role::Loop2, Shape::Diamond),
        point("AMIGO", (2.2e-9, 4.6e-4), Role::ClosedLoop, Shape::Cross),
        point("averaging", (3e-10, 1.2e-2), Role::MinimumPhase, Shape::Point),
        point("Ziegler–Nichols", (4.5e-8, 1.4e-4), Role::RightHalfPlane, Shape::Point),
        point("runs away", (1.0, 1.0), Role::RightHalfPlane, Shape::Point),
    ];
    let axes = ["variance of the outflow ((m³/s)²)", "variance of the level (m²)"];
    let chart = trade_off(&TradeOffChart { curve: (&x, &y), points, present: Some((1e-9, 1.4e-3)), axes });
    write("trade-off", &[chart], Size { width: 460.0, height: 360.0 });

    let cells = costs();
    write("map", &[cost_map(&map(&cells, (2.0, 60.0)))], Size { width: 520.0, height: 420.0 });
    write("map-small", &[cost_map(&map(&cells, (2.0, 60.0)))], Size { width: 320.0, height: 300.0 });

    let opening: Vec<f64> = (0..=50).map(|k| 2.0 * f64::from(k)).collect();
    let flow: Vec<f64> = opening.iter().map(|x| 3.2 * 30f64.powf(x / 100.0 - 1.0)).collect();
    let axes = ["valve opening (%)", "flow (L/s)"];
    let chart = static_curve(&StaticCurve { x: &opening, y: &flow, at: Some((62.0, 3.2 * 30f64.powf(-0.38))), axes });
    write("static", &[chart], Size { width: 340.0, height: 260.0 });
}
