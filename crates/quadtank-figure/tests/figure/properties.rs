use nalgebra::Complex;
use proptest::prelude::*;
use quadtank_figure::{
    Axis, Cell, Cells, Chart, Course, Layer, Name, Names, Palette, Pen, Responses, Role, RunColumns, Scale, Series,
    Size, Style, layout, responses, table, to_svg,
};
use roxmltree::Document;

use crate::fixture::{Run, plane, response_spec, s_plane};
use crate::recorder::{Drawn, record};

/// Any number, with the awkward ones more often than chance has them.
pub fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -20.0..20.0,
        1 => any::<f64>(),
        1 => prop_oneof![
            Just(0.0), Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY), Just(f64::MAX), Just(f64::MIN),
            Just(f64::MIN_POSITIVE), Just(1e-320), Just(1e300),
        ],
    ]
}

pub fn size() -> impl Strategy<Value = Size> {
    let side = prop_oneof![3 => 0.0..1500.0, 1 => number()];
    (side.clone(), side).prop_map(|(width, height)| Size { width, height })
}

/// Paints and checks what reached the backend.
pub fn check(charts: &[Chart], size: Size, scale: u32) -> Result<(), TestCaseError> {
    let style = Style { palette: Palette::DARK, decimal: ',', scale };
    let frames = layout(charts, size);
    prop_assert_eq!(frames.len(), charts.len());
    for frame in &frames {
        prop_assert!(frame.plot.width >= 1.0 && frame.plot.height >= 1.0);
        prop_assert!(frame.x.0 < frame.x.1 && frame.y.0 < frame.y.1);
    }
    let far = 2.0 * size.clamped().width.max(size.clamped().height) + 1000.0;
    for drawn in record(charts, size, &style) {
        let points = match drawn {
            Drawn::Path { points, .. } | Drawn::Polygon { points, .. } => points,
            Drawn::Block { corners, .. } => corners.to_vec(),
            Drawn::Circle { center, .. } => vec![center],
            Drawn::Text { at, .. } => vec![at],
        };
        for (x, y) in points {
            prop_assert!(x.abs() <= far && y.abs() <= far, "({x}, {y}) in a figure of {size:?}");
        }
    }
    let svg = to_svg(charts, size, &style, "t", "d");
    prop_assert!(Document::parse(&svg).is_ok(), "{}", svg);
    prop_assert!(!svg.contains("NaN") && !svg.contains("inf"));
    let table = table(charts, 20);
    prop_assert!(table.rows.iter().all(|row| row.len() == table.columns.len()) && table.rows.len() <= 21);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn any_axis_has_few_rising_ticks_inside(from in number(), to in number(), most in 0..20_usize) {
        for axis in [Axis::new("", (from, to)), Axis::rounded("", (from, to), most), Axis::logarithmic("", (from, to))] {
            let (min, max) = axis.span();
            prop_assert!(min.is_finite() && max.is_finite() && min < max);
            let ticks = axis.ticks(most);
            let slack = 1e-6 * (max - min);
            prop_assert!(ticks.len() <= most + 1);
            prop_assert!(ticks.is_sorted_by(|a, b| a.value < b.value));
            prop_assert!(ticks.iter().all(|tick| min - slack <= tick.value && tick.value <= max + slack));
        }
    }

    #[test]
    fn any_curve_is_painted_inside_any_figure(
        x in prop::collection::vec(number(), 0..60),
        y in prop::collection::vec(number(), 0..60),
        sorted in any::<bool>(),
        held in any::<bool>(),
        (x_range, y_range) in ((number(), number()), (number(), number())),
        (scale, y_scale, weight) in (1..16_u32, number(), number()),
        size in size(),
    ) {
        let mut x = x;
        if sorted {
            x.sort_by(f64::total_cmp);
        }
        let mut chart = Chart::new(Axis::new("x", x_range), Axis::new("y", y_range));
        chart.weight = weight;
        let course = if held { Course::Held } else { Course::Straight };
        for pen in [Pen::Solid, Pen::Dashed] {
            let name = "curve".into();
            let series = Series { name, role: Role::Loop1, pen, course, x: x.clone().into(), y: y.clone().into(), y_scale };
            chart.layers.push(Layer::Line(series));
        }
        let at = (y_range.0, x_range.1);
        chart.layers.push(Layer::Region { x: y_range, y: x_range, role: Role::Loop2 });
        chart.layers.push(Layer::Upright { x: at.0, role: Role::Muted, pen: Pen::Hair });
        chart.layers.push(Layer::Level { y: at.1, role: Role::Muted, pen: Pen::Dotted });
        let cells = x.iter().map(|&x| if x < 0.0 { Cell::Hatched } else { Cell::Shade(x) }).collect();
        chart.layers.push(Layer::Cells(Cells { x: x_range, y: y_range, columns: y.len() / 4, cells }));
        let name = |(&x, &y)| Name { at: (x, y), text: "name".to_owned(), role: Role::Neutral, bold: true };
        let names: Vec<Name> = x.iter().zip(&y).map(name).collect();
        chart.layers.push(Layer::Ends(names.clone()));
        chart.layers.push(Layer::Names(Names { names, around: vec![at], on_ground: true }));
        let mut logarithmic = chart.clone();
        (logarithmic.x.scale, logarithmic.y.scale) = (Scale::Logarithmic, Scale::Logarithmic);
        check(&[chart, logarithmic], size, scale)?;
    }

    #[test]
    fn any_poles_and_zeros_are_painted(values in prop::collection::vec((number(), number()), 0..12), size in size()) {
        let values: Vec<_> = values.into_iter().map(|(re, im)| Complex::new(re, im)).collect();
        let (poles, rest) = values.split_at(values.len() / 3);
        let (zeros, closed_loop) = rest.split_at(rest.len() / 2);
        check(&[s_plane(poles, zeros, closed_loop)], size, 8)?;
    }

    #[test]
    fn any_zeros_shade_the_valve_plane(a in number(), b in number(), setting in [number(), number()], size in size()) {
        let zero = |[x, y]: [f64; 2]| (x != y).then_some(a * x + b * y);
        check(&[plane(&zero, Some(setting))], size, 8)?;
    }

    #[test]
    fn any_run_is_painted(
        rows in prop::collection::vec((number(), number(), number()), 0..40),
        (scale, wall, limit) in (number(), number(), number()),
        window in prop::option::of((number(), number())),
        size in size(),
    ) {
        let column = |pick: fn(&(f64, f64, f64)) -> f64| rows.iter().map(pick).collect::<Vec<f64>>();
        let (time_s, level, voltage) = (column(|row| row.0), column(|row| row.1), column(|row| row.2));
        let run = RunColumns { time_s: &time_s, levels: [&level, &voltage], voltages: [&voltage, &level] };
        let usual = Run::step(1.0);
        let spec = Responses {
            nonlinear: run,
            recorded: None,
            references: [&level, &level],
            linear: Some(run),
            pinned: vec![(usual.columns(), "pinned")],
            flags: &[],
            steps: &[],
            level_scale: scale,
            walls: [wall, 0.2],
            voltage_limits: (limit, 10.0),
            window_s: window,
            ..response_spec(&usual, None, None)
        };
        check(&responses(&spec), size, 8)?;
    }
}
