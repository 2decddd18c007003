use quadtank::study::level_loop::{
    ContourMap, ContourSettings, LevelLoopSetup, Objective, run_level_loop, run_step_test, trade_off,
};
use quadtank::tuning::Evaluation;
use quadtank_figure::{
    self, Chart, CostCell, CostMapChart, LevelLoopCharts, LevelLoopTexts, LevelRunColumns, NamedPoint, Role, Shape,
    Size, StepTestCharts, StepTestTexts, Style, TradeOffChart, to_svg,
};

use quadtank_scenario::answers::AnswerError;

use crate::LevelPicture;

/// Cells along each side of a map.
const CELLS: usize = 40;

/// Draws a picture of a level loop as an SVG document.
pub fn svg(setup: &LevelLoopSetup, picture: LevelPicture, style: &Style) -> Result<String, AnswerError> {
    match picture {
        LevelPicture::Run => run(setup, style),
        LevelPicture::StepTest => step_test(setup, style),
        LevelPicture::TradeOff => Ok(variances(setup, style)),
        LevelPicture::CostMap => cost_map(setup, style),
    }
}

fn drawn(charts: &[Chart], style: &Style, title: &str, description: &str) -> String {
    to_svg(charts, Size { width: 840.0, height: 560.0 }, style, title, description)
}

fn run(setup: &LevelLoopSetup, style: &Style) -> Result<String, AnswerError> {
    let answer = run_level_loop(setup)?;
    let (plant, log) = (setup.plant(), &answer.log);
    let reference: Vec<f64> = log.reference.iter().map(|&signal| plant.transmitter.level_of(signal)).collect();
    let range = plant.output.signal;
    let charts = quadtank_figure::level_loop(&LevelLoopCharts {
        run: LevelRunColumns { time_s: &log.time_s, level: &log.level, outflow: &log.outflow, output: &log.output },
        reference: &reference,
        inflow: &log.inflow,
        pinned: Vec::new(),
        band: match setup.objective {
            Objective::Averaging { band } => Some(band),
            Objective::Tight => None,
        },
        window_s: (0.0, setup.experiment.duration_s),
        output_range: [range.low, range.high],
        texts: LevelLoopTexts {
            axes: ["time (s)", "h (cm)", "q (L/s)", "output m"],
            level: "level",
            reference: "reference",
            inflow: "inflow",
            outflow: "outflow",
            output: "controller output",
            band: "band",
        },
    });
    Ok(drawn(&charts, style, "Level loop", "Level with its reference, inflow and outflow, and the controller output."))
}

fn step_test(setup: &LevelLoopSetup, style: &Style) -> Result<String, AnswerError> {
    let test = run_step_test(&setup.plant(), &setup.test)?;
    let charts = quadtank_figure::step_test(&StepTestCharts {
        time_s: &test.log.time_s,
        measured: &test.log.transmitted,
        fitted: test.fitted.as_deref(),
        output: &test.log.output,
        marks: Vec::new(),
        texts: StepTestTexts { axes: ["time (s)", "signal y", "output m"], measured: "measured", fitted: "model" },
    });
    Ok(drawn(&charts, style, "Step test", "The measured signal after a step of the output, with the fitted model."))
}

fn variances(setup: &LevelLoopSetup, style: &Style) -> String {
    let published = setup.published_tunings();
    let tunings: Vec<_> = published.iter().map(|one| one.tuning).collect();
    let found = trade_off(setup, &tunings);
    let names: Vec<String> = tunings.iter().map(|one| format!("{}, {} s", one.gain, one.integral_time_s)).collect();
    let points = found.points.iter().zip(&names).filter_map(|(point, name)| {
        let point = (*point)?;
        let at = (point.outflow, point.level);
        Some(NamedPoint { name: &name[..], at, role: Role::Neutral, shape: Shape::Point })
    });
    let (outflow, level): (Vec<f64>, Vec<f64>) = found.curve.iter().map(|point| (point.outflow, point.level)).unzip();
    let present = run_level_loop(setup).ok().map(|answer| {
        let figures = answer.figures;
        (figures.outflow.variance, figures.level.variance)
    });
    let chart = quadtank_figure::trade_off(&TradeOffChart {
        curve: (&outflow, &level),
        points: points.collect(),
        present,
        axes: ["var(q_out) ((m³/s)²)", "var(h) (m²)"],
    });
    let description =
        "The variance of the level against that of the outflow as the gain changes, with published tunings.";
    drawn(&[chart], style, "Trade-off", description)
}

fn cost_map(setup: &LevelLoopSetup, style: &Style) -> Result<String, AnswerError> {
    let mut map = ContourMap::new(setup, ContourSettings { size: [CELLS; 2] })?;
    while map.advance(CELLS) {}
    let cells: Vec<CostCell> = map
        .cells()
        .iter()
        .map(|evaluation| match evaluation {
            Some(Evaluation::Cost(cost)) => CostCell::Cost(*cost),
            Some(Evaluation::Violates(_)) => CostCell::Violates,
            Some(Evaluation::NoRun(_)) | None => CostCell::None,
        })
        .collect();
    let [gains, times_s] = setup.search.axes().map(|axis| (axis.low, axis.high));
    let chart = quadtank_figure::cost_map(&CostMapChart {
        gains,
        times_s,
        size: map.size(),
        cells: &cells,
        paths: Vec::new(),
        population: Vec::new(),
        points: Vec::new(),
        present: setup.pi_tuning().map(|tuning| (tuning.gain, tuning.integral_time_s)),
        axes: ["Kp", "Ti (s)"],
    });
    Ok(drawn(
        &[chart],
        style,
        "Cost map",
        "The cost over gain and integral time: the deeper the shade, the less it is.",
    ))
}
