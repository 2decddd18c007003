use std::f64::consts::PI;

use nalgebra::Complex;
use quadtank_figure::{
    Anchor, Axis, Chart, Label, Layer, Palette, Pen, Rect, Rgb, Role, Sheet, Size, layout, responses, table,
};

use crate::fixture::{
    Run, SIZE, STYLE, johansson_s_plane, plane, plane_with, response_charts, response_spec, right_most_zero, s_plane,
};
use crate::recorder::{Drawn, record, record_sheet};

/// The paths in the colour of a line.
fn strokes(drawn: &[Drawn], role: Role, pen: Pen) -> Vec<Vec<(f64, f64)>> {
    let wanted = Palette::LIGHT.line(role, pen);
    let path = |drawn: &Drawn| match drawn {
        Drawn::Path { points, color, .. } if *color == wanted => Some(points.clone()),
        _ => None,
    };
    drawn.iter().filter_map(path).collect()
}

fn texts<'a>(drawn: &'a [Drawn]) -> Vec<&'a str> {
    let text = |drawn: &'a Drawn| if let Drawn::Text { text, .. } = drawn { Some(text.as_str()) } else { None };
    drawn.iter().filter_map(text).collect()
}

fn only(chart: &Chart<'static>, keep: impl Fn(&Layer) -> bool) -> Chart<'static> {
    let mut chart = chart.clone();
    chart.layers.retain(|layer| keep(layer));
    chart.legend.clear();
    chart
}

/// Whether all points are in the rectangle, to the rounding of 1/8 px.
fn within(rect: &Rect, points: &[(f64, f64)]) -> bool {
    points.iter().all(|&(x, y)| {
        (rect.left - 0.07..=rect.right() + 0.07).contains(&x) && (rect.top - 0.07..=rect.bottom() + 0.07).contains(&y)
    })
}

#[test]
fn pixels_and_data_correspond_both_ways() {
    let run = Run::step(1.0);
    for frame in layout(&response_charts(&run, None, None), SIZE) {
        for point in [(0.0, 0.5), (frame.x.0, frame.y.1), (123.4, 12.9)] {
            let back = frame.to_data(frame.to_px(point));
            assert!((back.0 - point.0).abs() < 1e-9 && (back.1 - point.1).abs() < 1e-9, "{point:?} {back:?}");
        }
        assert!((frame.x_px(frame.x.0) - frame.plot.left).abs() < 1e-9);
        assert!((frame.y_px(frame.y.1) - frame.plot.top).abs() < 1e-9);
    }
}

#[test]
fn pixels_and_data_correspond_on_logarithmic_axes() {
    let chart = Chart::new(Axis::logarithmic("gain", (0.1, 100.0)), Axis::logarithmic("time", (1e-9, 1e-3)));
    let frame = layout(&[chart], SIZE)[0];
    for point in [(0.1, 1e-3), (1.0, 1e-6), (37.0, 2.5e-8), (1e3, 1e-12)] {
        let back = frame.to_data(frame.to_px(point));
        assert!((back.0 / point.0 - 1.0).abs() < 1e-9 && (back.1 / point.1 - 1.0).abs() < 1e-9, "{point:?} {back:?}");
    }
    let middle = (frame.plot.left + frame.plot.width / 3.0, frame.plot.top + frame.plot.height / 2.0);
    let px = frame.to_px((1.0, 1e-6));
    assert!((px.0 - middle.0).abs() < 1e-9 && (px.1 - middle.1).abs() < 1e-9, "{px:?} {middle:?}");
}

#[test]
fn stacked_charts_share_their_edges_and_fill_the_figure() {
    let run = Run::step(1.0);
    let frames = layout(&response_charts(&run, None, None), SIZE);
    assert_eq!(frames[0].plot.left, frames[1].plot.left);
    assert_eq!(frames[0].plot.right(), frames[1].plot.right());
    assert!((frames[1].outer.bottom() - SIZE.height).abs() < 1e-9);
    assert!(frames[0].plot.bottom() < frames[1].plot.top);
    assert!((frames[0].plot.height / frames[1].plot.height - 2.2).abs() < 0.05);
}

#[test]
fn a_marker_is_painted_where_the_frame_says() {
    let chart = plane(&right_most_zero, Some([0.43, 0.34]));
    let frame = layout(std::slice::from_ref(&chart), SIZE)[0];
    let drawn = record(&[chart], SIZE, &STYLE);
    let (x, y) = frame.to_px((0.43, 0.34));
    let hit = |drawn: &&Drawn| match drawn {
        Drawn::Circle { center, .. } => (center.0 - x).hypot(center.1 - y) < 0.1,
        _ => false,
    };
    assert!(drawn.iter().filter(hit).count() >= 2);
    assert_eq!(frame.plot.width, frame.plot.height);
}

#[test]
fn the_line_of_the_valve_plane_is_where_the_gain_is_singular() {
    for sum in [0.4, 1.0, 1.8] {
        let chart = plane_with(&right_most_zero, None, sum);
        let frame = layout(std::slice::from_ref(&chart), SIZE)[0];
        let drawn = record(&[chart], SIZE, &STYLE);
        let ends = [sum.min(1.0), (sum - 1.0).max(0.0)].map(|gamma_2| frame.to_px((sum - gamma_2, gamma_2)));
        let is_line = |drawn: &&Drawn| match drawn {
            Drawn::Path { points, .. } => [points.first(), points.last()]
                .into_iter()
                .zip(ends)
                .all(|(found, (x, y))| found.is_some_and(|found| (found.0 - x).hypot(found.1 - y) < 0.1)),
            _ => false,
        };
        assert_eq!(drawn.iter().filter(is_line).count(), 1, "{sum}");
        let name = drawn.iter().find_map(|drawn| match drawn {
            Drawn::Text { text, at } if text == "the line" => Some(*at),
            _ => None,
        });
        let (x, _) = name.unwrap();
        // Eight letters of about half their size, which end there where the line ends far to the right.
        let length = 8.0 * 7.0;
        let (left, right) = if sum < 1.5 { (x, x + length) } else { (x - length, x) };
        assert!(frame.plot.left < left && right < frame.plot.right(), "{sum}: {left} to {right}");
    }
    for sum in [-0.2, 2.5] {
        let drawn = record(&[plane_with(&right_most_zero, None, sum)], SIZE, &STYLE);
        assert!(!texts(&drawn).contains(&"the line"), "{sum}");
    }
}

#[test]
fn a_label_that_an_edge_would_push_onto_its_point_changes_sides_where_there_is_room() {
    // Heights (px) of the labels of two points at the ends of curves, and of the points.
    let heights = |y: [f64; 2], may_change: bool| {
        let mut chart = Chart::new(Axis::new("", (0.0, 1.0)), Axis::new("", (0.0, 1.0)));
        for index in 0..2 {
            let label = Label {
                at: (0.9, y[index]),
                offset: (-6.0, if y[index] > y[1 - index] { -12.0 } else { 12.0 }),
                anchor: Anchor::Right,
                text: format!("label {index}"),
                role: Role::Loop1,
                bold: true,
                on_ground: false,
                opposite: may_change.then_some(y[1 - index]),
            };
            chart.layers.push(Layer::Label(label));
        }
        let frame = layout(std::slice::from_ref(&chart), SIZE)[0];
        let drawn = record(&[chart], SIZE, &STYLE);
        let height = |index: usize| {
            drawn.iter().find_map(|drawn| match drawn {
                Drawn::Text { text, at } if *text == format!("label {index}") => Some(at.1),
                _ => None,
            })
        };
        ([height(0).unwrap(), height(1).unwrap()], y.map(|y| frame.y_px(y)))
    };
    let (labels, points) = heights([0.995, 0.005], true);
    assert!(labels[0] > points[0] + 10.0 && labels[1] < points[1] - 10.0, "{labels:?} {points:?}");
    // Points that are close leave no room between them: labels keep their sides, and do not lie on each other.
    for y in [[0.995, 0.97], [0.03, 0.005]] {
        assert_eq!(heights(y, true), heights(y, false));
    }
    assert_eq!(heights([0.7, 0.3], true), heights([0.7, 0.3], false));
}

#[test]
fn a_diverging_run_is_clipped_and_flattens_nothing() {
    let (run, runaway) = (Run::step(1.0), Run::diverging());
    for mut chart in response_charts(&run, Some(&runaway), None) {
        chart.legend.clear();
        let frame = layout(std::slice::from_ref(&chart), SIZE)[0];
        // A step of 1 cm, stretched once to either side and rounded; and 1 V, which nothing stretches.
        assert!(frame.y.1 - frame.y.0 <= 5.0, "{:?}", frame.y);
        let drawn = record(&[chart], SIZE, &STYLE);
        let lines = [Role::Loop1, Role::Loop2].map(|role| strokes(&drawn, role, Pen::Solid)).concat();
        assert!(lines.len() >= 4);
        for path in lines {
            assert!(within(&frame.plot, &path), "{path:?} leaves {:?}", frame.plot);
        }
    }
}

#[test]
fn references_are_dashed_linear_runs_dotted_and_pinned_runs_faded() {
    let (run, other) = (Run::step(1.0), Run::step(3.0));
    let drawn = |linear, pinned| {
        let charts = response_charts(&run, linear, pinned);
        record(&charts[..1], SIZE, &STYLE)
    };
    let plain = drawn(None, None);
    let width =
        |wanted: f64| move |drawn: &&Drawn| matches!(drawn, Drawn::Path { width, .. } if (width - wanted).abs() < 0.07);
    let solid = strokes(&plain, Role::Loop1, Pen::Solid);
    let dashes: Vec<_> = solid.iter().filter(|path| path.len() <= 4).collect();
    // The reference with its upright step, at 8.5 px for a dash and a gap, and the sample of the legend.
    let charts = response_charts(&run, None, None);
    let frame = layout(&charts[..1], SIZE)[0];
    let length = frame.plot.width + frame.y_px(12.4) - frame.y_px(13.4);
    assert!((dashes.len() as f64 - 1.0 - length / 8.5).abs() <= 2.0, "{} dashes on {length} px", dashes.len());
    let dash_length =
        |path: &[(f64, f64)]| path.windows(2).map(|p| (p[1].0 - p[0].0).hypot(p[1].1 - p[0].1)).sum::<f64>();
    assert!(dashes.iter().filter(|dash| (dash_length(dash) - 5.0).abs() < 0.3).count() > 60);
    let dotted = drawn(Some(&other), None);
    assert!(dotted.iter().filter(width(1.8)).count() > plain.iter().filter(width(1.8)).count() + 200);
    let faded = drawn(None, Some(&other));
    assert_eq!(strokes(&plain, Role::Loop1, Pen::Pinned(0)).len(), 0);
    assert_eq!(strokes(&faded, Role::Loop1, Pen::Pinned(0)).len(), 1);
}

#[test]
fn two_sheets_are_the_whole_picture_and_the_ground_knows_when_it_changes() {
    let (run, other) = (Run::step(1.0), Run::step(3.0));
    let charts = response_charts(&run, Some(&other), Some(&other));
    let sorted = |sheets: &[Sheet]| {
        let mut drawn: Vec<_> = sheets
            .iter()
            .flat_map(|&sheet| record_sheet(&charts, SIZE, &STYLE, sheet))
            .map(|thing| format!("{thing:?}"))
            .collect();
        drawn.sort();
        drawn
    };
    let [ground, curves] = [Sheet::Ground, Sheet::Curves].map(|sheet| sorted(&[sheet]).len());
    assert!(ground > 0 && curves > 0);
    assert_eq!(sorted(&[Sheet::Ground, Sheet::Curves]), sorted(&[Sheet::Both]));

    // Another run within the same axes leaves the ground; another pinned run or another range does not.
    let ground = charts.each_ref().map(Chart::ground);
    let has_ground = |charts: &[Chart]| charts.iter().zip(&ground).all(|(chart, ground)| chart.has_ground(ground));
    assert!(has_ground(&response_charts(&Run::step(1.05), Some(&other), Some(&other))));
    assert!(!has_ground(&response_charts(&run, Some(&other), Some(&run))));
    assert!(!has_ground(&response_charts(&run, Some(&other), None)));
    assert!(!has_ground(&response_charts(&Run::diverging(), Some(&other), Some(&other))));
}

#[test]
fn a_curve_is_drawn_with_few_points() {
    let run = Run::step(1.0);
    let drawn = record(&response_charts(&run, None, None), SIZE, &STYLE);
    let points: usize =
        drawn.iter().map(|drawn| if let Drawn::Path { points, .. } = drawn { points.len() } else { 0 }).sum();
    assert!(points < 2000, "{points} points for 18,000 values");
}

#[test]
fn held_inputs_make_corners() {
    let run = Run::step(1.0);
    let charts = response_charts(&run, None, None);
    let frames = layout(&charts, SIZE);
    let drawn = record(&charts, SIZE, &STYLE);
    // The reference steps at 100 s: a piece of dash stands upright there.
    let x = frames[0].x_px(100.0);
    let upright = |path: &Vec<(f64, f64)>| {
        path.windows(2).any(|p| (p[0].0 - x).abs() < 0.1 && p[0].0 == p[1].0 && p[0].1 != p[1].1)
    };
    assert!(strokes(&drawn, Role::Loop1, Pen::Solid).iter().any(upright));
}

#[test]
fn the_range_follows_the_window() {
    let run = Run::step(1.0);
    let mut spec = response_spec(&run, None, None);
    spec.window_s = Some((0.0, 90.0));
    let [levels, _] = responses(&spec);
    // Before the step nothing moves; the least range is 5 % of 20 cm, around 12.4 to 13.0 cm.
    let (low, high) = levels.y.span();
    assert!(low >= 11.5 && high <= 13.9, "{low} {high}");
    assert_eq!(levels.x.range, (0.0, 90.0));
}

#[test]
fn far_poles_become_arrows_and_do_not_shrink_the_rest() {
    let real = |re| Complex::new(re, 0.0);
    let poles = [-0.01, -0.02].map(real);
    let near = s_plane(&poles, &[real(0.013)], &[]);
    let far = s_plane(&poles, &[real(0.013)], &[Complex::new(-0.1, PI), real(-5.0)]);
    assert_eq!(near.x.range, far.x.range);
    let drawn = record(&[only(&far, |layer| matches!(layer, Layer::Marker(_)))], SIZE, &STYLE);
    let arrows = drawn.iter().filter(|drawn| matches!(drawn, Drawn::Polygon { points, .. } if points.len() == 3));
    assert_eq!(arrows.count(), 2);
    let explained = |chart: &Chart| chart.legend.iter().any(|entry| entry.text == "further out");
    assert!(explained(&far) && !explained(&near));
}

#[test]
fn the_right_half_plane_is_tinted_from_zero_to_the_edge() {
    let chart = johansson_s_plane();
    let frame = layout(&[only(&chart, |_| true)], SIZE)[0];
    let drawn = record(&[only(&chart, |layer| matches!(layer, Layer::Region { .. }))], SIZE, &STYLE);
    let Some(Drawn::Polygon { points, color }) = drawn.first() else { panic!("{:?}", drawn.first()) };
    assert_eq!(*color, Palette::LIGHT.region(Role::RightHalfPlane));
    let left = points.iter().map(|point| point.0).fold(f64::INFINITY, f64::min);
    let right = points.iter().map(|point| point.0).fold(0.0, f64::max);
    assert!((left - frame.x_px(0.0)).abs() < 0.07 && (right - frame.plot.right()).abs() < 0.07);
}

#[test]
fn zeros_carry_their_values() {
    let drawn = record(&[johansson_s_plane()], SIZE, &STYLE);
    assert!(texts(&drawn).contains(&"−0.0570") && texts(&drawn).contains(&"+0.0130"), "{:?}", texts(&drawn));
}

#[test]
fn the_valve_plane_changes_sides_on_the_line() {
    let chart = plane(&right_most_zero, None);
    let Some(Layer::Field(field)) = chart.layers.first() else { panic!("the shading comes first") };
    for (index, shade) in field.shades.iter().enumerate() {
        let (row, column) = (index / field.columns, index % field.columns);
        let beyond = i64::try_from(row + column).expect("small") - 40;
        if beyond != 0 {
            assert_eq!(*shade < 0.0, beyond > 0, "row {row}, column {column}: {shade}");
        } else {
            // Rounding of γ1 + γ2; the corners of the line have no zero at all.
            assert!(shade.abs() < 1e-9, "row {row}, column {column}: {shade}");
        }
    }
}

#[test]
fn shades_lie_on_their_side_of_the_line() {
    let chart = only(&plane(&right_most_zero, None), |layer| matches!(layer, Layer::Field(_)));
    let frame = layout(std::slice::from_ref(&chart), SIZE)[0];
    let (mut teal, mut warm) = (0, 0);
    for drawn in record(&[chart], SIZE, &STYLE) {
        let Drawn::Polygon { points, color: Rgb(red, green, _) } = drawn else { continue };
        *(if green > red { &mut teal } else { &mut warm }) += 1;
        for point in points {
            let (gamma_1, gamma_2) = frame.to_data(point);
            let beyond = gamma_1 + gamma_2 - 1.0;
            // One eighth of a pixel is 0.0005 of the axis.
            assert!(if green > red { beyond > -2e-3 } else { beyond < 2e-3 }, "{gamma_1}, {gamma_2}");
        }
    }
    // 16 steps to the deepest shade. With the zero 0.0267 1/s at γ = 0.3 as one half, zeros to the left, which stop at −0.02 1/s, have
    // shades up to 0.02/(0.02 + 0.0267) = 0.43, the seventh step.
    assert_eq!((teal, warm), (7, 16));
}

#[test]
fn numbers_are_in_the_readers_notation() {
    let style = quadtank_figure::Style { decimal: ',', ..STYLE };
    let drawn = record(&[plane(&right_most_zero, None)], SIZE, &style);
    assert!(texts(&drawn).contains(&"0,2"));
}

#[test]
fn the_table_has_the_curves_by_name_and_the_last_row() {
    let (run, other) = (Run::step(1.0), Run::step(2.0));
    let table = table(&response_charts(&run, Some(&other), None), 100);
    assert_eq!(table.columns[..4], ["time (s)", "reference 1", "reference 2", "level 1"]);
    assert!(table.columns.contains(&"level 1 (linear)".to_owned()));
    assert!(table.rows.len() <= 101 && table.rows.len() > 50, "{}", table.rows.len());
    let last = table.rows.last().expect("rows");
    assert_eq!(last.len(), table.columns.len());
    assert_eq!(last[0], 3000.0);
    assert!((last[3] - 100.0 * run.levels[0][3000]).abs() < 1e-12);
}

#[test]
fn a_summary_says_where_a_curve_goes() {
    let run = Run::step(1.0);
    let [levels, _] = response_charts(&run, None, None);
    let summary = levels.summary();
    let level_1 = summary.iter().find(|curve| curve.pen == Pen::Solid && curve.role == Role::Loop1).expect("level 1");
    assert_eq!((level_1.first, level_1.last), (100.0 * run.levels[0][0], 100.0 * run.levels[0][3000]));
    assert!(level_1.lowest <= level_1.first && level_1.highest >= level_1.last);
}

#[test]
fn a_cursor_reads_lines_between_points_and_inputs_as_held() {
    let run = Run::step(1.0);
    let [levels, voltages] = response_charts(&run, None, None);
    let line = levels.series().find(|series| series.pen == Pen::Solid).expect("level 1");
    let middle = 50.0 * (run.levels[0][200] + run.levels[0][201]);
    assert!((line.at(200.5).expect("inside") - middle).abs() < 1e-12);
    let held = voltages.series().next().expect("pump 1");
    assert_eq!(held.at(200.9), Some(run.voltages[0][200]));
    assert_eq!(held.at(3000.0), Some(run.voltages[0][3000]));
    assert_eq!((held.at(-1.0), held.at(3001.0), held.at(f64::NAN)), (None, None, None));
}

#[test]
fn a_figure_without_charts_is_empty() {
    assert_eq!(record(&[], SIZE, &STYLE), []);
    assert_eq!(layout(&[], Size { width: 0.0, height: 0.0 }), []);
}
