use super::super::range::{extent, join, part, range};
use super::super::{Axis, Chart, Course, Entry, Layer, Name, Pen, Role, Sample, Series};

/// Heights of the three charts beside each other.
const WEIGHTS: [f64; 3] = [2.2, 1.5, 1.0];
/// Levels are shown in cm, flows in L/s.
const CENTIMETRES: f64 = 100.0;
const LITRES: f64 = 1000.0;
/// Room beyond a band, as a share of it: at the edge of the plot its lines would only look like a smudge.
const BAND_ROOM: f64 = 0.03;
/// An axis never shows less than this share of the largest value, so that noise does not look like a step.
const MIN_SHARE: f64 = 0.01;

/// How many times as wide as the run what is shown may become by pinned runs: beyond, the run would only look like a line.
const WIDEST: f64 = 30.0;

/// One run of the loop; all columns have the rows of `time_s`.
#[derive(Clone, Copy, Debug)]
pub struct LevelRunColumns<'a> {
    /// Time (s), rising.
    pub time_s: &'a [f64],
    /// Level (m).
    pub level: &'a [f64],
    /// Outflow (m³/s).
    pub outflow: &'a [f64],
    /// Output of the controller, as a signal.
    pub output: &'a [f64],
}

/// What the charts of the loop show.
#[derive(Clone, Debug)]
pub struct LevelLoopCharts<'a> {
    /// The run.
    pub run: LevelRunColumns<'a>,
    /// Reference at its times (m).
    pub reference: &'a [f64],
    /// Inflow at its times (m³/s).
    pub inflow: &'a [f64],
    /// Pinned runs; their numbers stand at their ends.
    pub pinned: Vec<LevelRunColumns<'a>>,
    /// Band in which the level is to stay (m).
    pub band: Option<[f64; 2]>,
    /// The time that is shown (s).
    pub window_s: (f64, f64),
    /// Lowest and highest output.
    pub output_range: [f64; 2],
    /// Words.
    pub texts: LevelLoopTexts<'a>,
}

/// The words of these charts. The legend shows those that are not empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct LevelLoopTexts<'a> {
    /// Names with units of the axes: time, level (cm), flow (L/s), output.
    pub axes: [&'a str; 4],
    /// Name of the level.
    pub level: &'a str,
    /// What the dashed line is.
    pub reference: &'a str,
    /// Name of the inflow.
    pub inflow: &'a str,
    /// Name of the outflow.
    pub outflow: &'a str,
    /// Name of the output, for the table.
    pub output: &'a str,
    /// What the band is.
    pub band: &'a str,
}

/// One column of a run: the one that a chart is about.
type Column = for<'a> fn(&LevelRunColumns<'a>) -> &'a [f64];

/// Three charts with one time axis: the level with its reference, the flows, the output of the controller.
///
/// Ranges are those of the run and the pinned runs, but a pinned run that would make a line of the run leaves the chart.
pub fn level_loop<'a>(spec: &LevelLoopCharts<'a>) -> [Chart<'a>; 3] {
    let mut charts = [level_chart(spec), flow_chart(spec), output_chart(spec)];
    for (chart, weight) in charts.iter_mut().zip(WEIGHTS) {
        chart.weight = weight;
        chart.x.numbered = false;
    }
    let [_, _, last] = &mut charts;
    last.x.numbered = true;
    spec.texts.axes[0].clone_into(&mut last.x.label);
    charts
}

fn level_chart<'a>(spec: &LevelLoopCharts<'a>) -> Chart<'a> {
    let texts = &spec.texts;
    let column: Column = |run| run.level;
    let mut range = range_of(spec, column, spec.reference, (0.0, f64::INFINITY));
    let band = spec.band.filter(|band| band.iter().all(|edge| edge.is_finite()));
    if let Some([low, high]) = band {
        let room = BAND_ROOM * (high - low).abs();
        range = join(range, (low.min(high) - room, low.max(high) + room));
    }
    let mut chart = chart(spec, texts.axes[1], (range.0 * CENTIMETRES, range.1 * CENTIMETRES), 6);
    if let Some([low, high]) = band.map(|band| band.map(|edge| edge * CENTIMETRES)) {
        let x = (f64::NEG_INFINITY, f64::INFINITY);
        chart.layers.push(Layer::Region { x, y: (low, high), role: Role::Loop1 });
        chart.layers.extend([low, high].map(|y| Layer::Level { y, role: Role::Muted, pen: Pen::Hair }));
    }
    let reference = series(texts.reference, Role::Loop1, Pen::Dashed, Course::Held, (spec.run.time_s, spec.reference));
    chart.layers.push(Layer::Line(Series { y_scale: CENTIMETRES, ..reference }));
    add_runs(&mut chart, spec, column, (texts.level, Role::Loop1, Course::Straight, CENTIMETRES));
    add_ends(&mut chart, spec, column, CENTIMETRES, Role::Loop1);
    let entries = [(Pen::Solid, Role::Loop1, texts.level), (Pen::Dashed, Role::Loop1, texts.reference)];
    chart.legend = legend(entries.into_iter().chain(band.map(|_| (Pen::Hair, Role::Muted, texts.band))));
    chart
}

fn flow_chart<'a>(spec: &LevelLoopCharts<'a>) -> Chart<'a> {
    let texts = &spec.texts;
    let column: Column = |run| run.outflow;
    let (low, high) = range_of(spec, column, spec.inflow, (f64::NEG_INFINITY, f64::INFINITY));
    let mut chart = chart(spec, texts.axes[2], (low * LITRES, high * LITRES), 4);
    let inflow = series(texts.inflow, Role::Muted, Pen::Hair, Course::Straight, (spec.run.time_s, spec.inflow));
    chart.layers.push(Layer::Line(Series { y_scale: LITRES, ..inflow }));
    add_runs(&mut chart, spec, column, (texts.outflow, Role::Loop2, Course::Straight, LITRES));
    add_ends(&mut chart, spec, column, LITRES, Role::Loop2);
    chart.legend = legend([(Pen::Hair, Role::Muted, texts.inflow), (Pen::Solid, Role::Loop2, texts.outflow)]);
    chart
}

fn output_chart<'a>(spec: &LevelLoopCharts<'a>) -> Chart<'a> {
    let texts = &spec.texts;
    let column: Column = |run| run.output;
    let [lowest, highest] = spec.output_range;
    let range = range_of(spec, column, &[], (lowest.min(highest), lowest.max(highest)));
    let mut chart = chart(spec, texts.axes[3], range, 3);
    let (bottom, top) = chart.y.span();
    // At the edge of the plot a limit would only look like a smudge.
    let limits = spec.output_range.into_iter().filter(|&limit| bottom < limit && limit < top);
    chart.layers.extend(limits.map(|y| Layer::Level { y, role: Role::Muted, pen: Pen::Dashed }));
    add_runs(&mut chart, spec, column, (texts.output, Role::Neutral, Course::Held, 1.0));
    add_ends(&mut chart, spec, column, 1.0, Role::Neutral);
    chart
}

fn legend<'a>(entries: impl IntoIterator<Item = (Pen, Role, &'a str)>) -> Vec<Entry> {
    let named = entries.into_iter().filter(|(.., text)| !text.is_empty());
    named.map(|(pen, role, text)| Entry { sample: Sample::Line(pen), role, text: text.to_owned() }).collect()
}

fn chart<'a>(spec: &LevelLoopCharts, label: &str, range: (f64, f64), ticks: usize) -> Chart<'a> {
    Chart::new(Axis::new("", spec.window_s), Axis::rounded(label, range, ticks))
}

fn range_of(spec: &LevelLoopCharts, column: Column, also: &[f64], limits: (f64, f64)) -> (f64, f64) {
    let LevelRunColumns { time_s, .. } = spec.run;
    let main = [column(&spec.run), also];
    let (low, high) = main.into_iter().filter_map(extent).reduce(join).unwrap_or_default();
    let beside = spec.pinned.iter().map(|run| (run.time_s, [column(run)]));
    let shown = range(spec.window_s, time_s, main.into_iter(), beside, limits, MIN_SHARE * high.abs().max(low.abs()));
    let pinned = spec.pinned.iter().filter_map(|run| extent(part(run.time_s, column(run), spec.window_s)));
    let all = pinned.fold(shown, |all, (low, high)| join(all, (low.max(limits.0), high.min(limits.1))));
    if all.1 - all.0 <= WIDEST * (shown.1 - shown.0) { all } else { shown }
}

fn series<'a>(name: &'a str, role: Role, pen: Pen, course: Course, (x, y): (&'a [f64], &'a [f64])) -> Series<'a> {
    Series { name: name.into(), role, pen, course, x: x.into(), y: y.into(), y_scale: 1.0 }
}

/// The pinned runs, and the run upon them. The table tells pinned ones by their numbers.
fn add_runs<'a>(
    chart: &mut Chart<'a>,
    spec: &LevelLoopCharts<'a>,
    column: Column,
    (name, role, course, y_scale): (&'a str, Role, Course, f64),
) {
    for (place, run) in (0..).zip(&spec.pinned) {
        let pinned = series("", role, Pen::Pinned(place), course, (run.time_s, column(run)));
        let name = if name.is_empty() { "".into() } else { format!("{name} ({})", u32::from(place) + 1).into() };
        chart.layers.push(Layer::Line(Series { name, y_scale, ..pinned }));
    }
    let run = series(name, role, Pen::Solid, course, (spec.run.time_s, column(&spec.run)));
    chart.layers.push(Layer::Line(Series { y_scale, ..run }));
}

/// Numbers of the pinned runs at the ends of their curves, if these are in sight.
fn add_ends(chart: &mut Chart, spec: &LevelLoopCharts, column: Column, scale: f64, role: Role) {
    let (low, high) = chart.y.span();
    let numbered = (1..).zip(&spec.pinned).filter_map(|(number, run)| {
        let shown = run.time_s.partition_point(|&time| time <= spec.window_s.1);
        let row = shown.min(column(run).len()).checked_sub(1)?;
        let at = (*run.time_s.get(row)?, column(run)[row] * scale);
        let is_in_sight = low <= at.1 && at.1 <= high && spec.window_s.0 <= at.0;
        is_in_sight.then(|| Name { at, text: format!("{number}"), role, bold: true })
    });
    let names: Vec<Name> = numbered.collect();
    if !names.is_empty() {
        chart.layers.push(Layer::Ends(names));
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::table;
    use super::*;

    const TIME: [f64; 4] = [0.0, 1.0, 2.0, 3.0];

    fn spec<'a>(level: &'a [f64], pinned: &[&'a [f64]]) -> LevelLoopCharts<'a> {
        let columns = |column| LevelRunColumns { time_s: &TIME, level: column, outflow: column, output: column };
        LevelLoopCharts {
            run: columns(level),
            reference: &[1.0; 4],
            inflow: &[1.2; 4],
            pinned: pinned.iter().map(|&column| columns(column)).collect(),
            band: None,
            window_s: (0.0, 3.0),
            output_range: [0.0, 100.0],
            texts: LevelLoopTexts {
                axes: ["time", "level", "flow", "output"],
                level: "h",
                reference: "r",
                inflow: "in",
                outflow: "out",
                output: "u",
                band: "band",
            },
        }
    }

    fn shows(chart: &Chart, value: f64) -> bool {
        let (low, high) = chart.y.span();
        (low..=high).contains(&value)
    }

    #[test]
    fn the_run_is_in_sight_and_pinned_runs_stretch_the_axes_within_limits() {
        let level = [1.0, 1.1, 1.3, 1.2];
        let alone = level_loop(&spec(&level, &[]));
        assert!(shows(&alone[0], 100.0) && shows(&alone[0], 130.0), "centimetres: {:?}", alone[0].y);
        assert!(shows(&alone[1], 1000.0) && shows(&alone[1], 1300.0), "litres per second: {:?}", alone[1].y);
        let calm = level_loop(&spec(&level, &[&[1.1; 4]]));
        // A tight run with an averaging one beside it, whose level moves twelve times as far.
        let averaging = level_loop(&spec(&level, &[&[0.5, 1.0, 4.1, 2.0]]));
        assert!(shows(&averaging[0], 50.0) && shows(&averaging[0], 410.0), "{:?}", averaging[0].y);
        let wild = level_loop(&spec(&level, &[&[1.0, 1.5, -1e9, 1e9]]));
        for k in 0..3 {
            assert_eq!(alone[k].y.range, calm[k].y.range);
            let [(low, high), (from, to)] = [alone[k].y.range, wild[k].y.range];
            assert!(from <= low && high <= to && to - from < 5.0 * (high - low), "{low} {high} {from} {to}");
        }
        assert_eq!(alone.each_ref().map(|chart| chart.x.numbered), [false, false, true]);
        assert_eq!(alone[2].x.label, "time");
    }

    #[test]
    fn a_band_is_in_sight_and_limits_of_the_output_where_they_are_near() {
        let level = [1.0, 1.1, 1.3, 1.2];
        let mut spec = spec(&level, &[]);
        spec.band = Some([0.5, 1.5]);
        spec.output_range = [1.05, 100.0];
        let [levels, flows, output] = level_loop(&spec);
        assert!(shows(&levels, 50.0) && shows(&levels, 150.0));
        let rules = |chart: &Chart| chart.layers.iter().filter(|layer| matches!(layer, Layer::Level { .. })).count();
        assert_eq!((rules(&levels), rules(&output)), (2, 1));
        let legend = |chart: &Chart| chart.legend.iter().map(|entry| entry.text.clone()).collect::<Vec<_>>();
        assert_eq!(
            (legend(&levels), legend(&flows)),
            (vec!["h".into(), "r".into(), "band".into()], vec!["in".into(), "out".into()])
        );
    }

    #[test]
    fn curves_have_their_names_in_the_table_and_pinned_ones_their_numbers_at_their_ends() {
        let level = [1.0, 1.1, 1.3, 1.2];
        let charts = level_loop(&spec(&level, &[&[1.1; 4], &[1.2; 4]]));
        let table = table(&charts, 10);
        let columns = ["time", "r", "h (1)", "h (2)", "h", "in", "out (1)", "out (2)", "out", "u (1)", "u (2)", "u"];
        assert_eq!(table.columns, columns);
        assert_eq!(table.rows.len(), 4);
        let words = |chart: &Chart| {
            let names = chart.layers.iter().filter_map(|layer| match layer {
                Layer::Ends(names) => Some(names.iter().map(|name| name.text.clone()).collect::<Vec<_>>()),
                _ => None,
            });
            names.flatten().collect::<Vec<_>>()
        };
        assert_eq!(charts.each_ref().map(words), [["1", "2"]; 3]);
    }
}
