use quadtank::literature::{DisplayUnit, PresetId};
use quadtank::study::StudyError;
use quadtank::study::quadruple_tank::{FrequencyCurves, PlantSpec, Setup, ValveMap, analyse, run};
use quadtank_figure::{
    self, ClosedLoopGains, FrequencyCharts, FrequencyTexts, JudgedStep, PoleZero, PoleZeroTexts, ResponseTexts,
    Responses, RunColumns, Size, Style, ValvePlane, ValvePlaneTexts, to_svg,
};

use crate::HomePicture;

/// Draws a picture of a setup as an SVG document.
pub fn svg(setup: &Setup, picture: HomePicture, style: &Style) -> Result<String, StudyError> {
    match picture {
        HomePicture::Responses => responses(setup, style),
        HomePicture::ValvePlane => valve_plane(setup, style),
        HomePicture::PoleZero => pole_zero(setup, style),
        HomePicture::Frequency => frequency(setup, style),
    }
}

fn responses(setup: &Setup, style: &Style) -> Result<String, StudyError> {
    let run = run(setup)?;
    let plant = setup.plant();
    let (level, level_scale) = match setup.plant.display_unit() {
        DisplayUnit::Cm => ("level (cm)", 100.0),
        DisplayUnit::Mm => ("level (mm)", 1000.0),
        DisplayUnit::M => ("level (m)", 1.0),
    };
    let [pump_1, pump_2] = plant.pumps;
    let steps = JudgedStep::all(&run.steps, |share| format!("overshoot {:.0} %", 100.0 * share));
    let charts = quadtank_figure::responses(&Responses {
        recorded: None,
        nonlinear: RunColumns::of(&run.nonlinear),
        references: run.nonlinear.references.each_ref().map(Vec::as_slice),
        linear: Some(RunColumns::of(&run.linear)),
        pinned: Vec::new(),
        flags: &[],
        steps: &steps,
        level_scale,
        walls: [plant.tanks[0].height, plant.tanks[1].height],
        voltage_limits: (pump_1.voltage_min.min(pump_2.voltage_min), pump_1.voltage_max.max(pump_2.voltage_max)),
        window_s: None,
        texts: ResponseTexts {
            time: "time (s)",
            level,
            voltage: "pump voltage (V)",
            levels: ["level 1", "level 2"],
            references: ["reference 1", "reference 2"],
            voltages: ["pump 1", "pump 2"],
            reference: "reference",
            linear: "linear model",
        },
    });
    let size = Size { width: 840.0, height: 560.0 };
    let description = "Levels of tanks 1 and 2 with their references, and the voltages of pumps 1 and 2.";
    Ok(to_svg(&charts, size, style, "Responses", description))
}

fn valve_plane(setup: &Setup, style: &Style) -> Result<String, StudyError> {
    let map = ValveMap::of(setup)?;
    let published = published_settings(setup);
    let singular_sum = map.singular_sum();
    let boundary =
        if singular_sum == 1.0 { "γ1 + γ2 = 1".to_owned() } else { format!("γ1 + γ2 = {singular_sum:.2}") };
    let chart = quadtank_figure::valve_plane(&ValvePlane {
        right_most_zero: &|valves| map.rightmost_zero(valves),
        singular_sum,
        published: &published,
        setting: Some(setup.valves),
        texts: ValvePlaneTexts {
            gamma_1: "γ1",
            gamma_2: "γ2",
            boundary: &boundary,
            minimum_phase: "minimum phase",
            right_half_plane: "zero in the right half-plane",
        },
    });
    let size = Size { width: 560.0, height: 560.0 };
    let description = "The valve fractions, shaded by the right-most transmission zero, with the published settings.";
    Ok(to_svg(&[chart], size, style, "Valve plane", description))
}

/// The settings in which the rig of a setup was published; none for a rig of one's own.
fn published_settings(setup: &Setup) -> Vec<(&'static str, [f64; 2])> {
    let source = |id: PresetId| id.preset().source;
    let PlantSpec::Preset(rig) = setup.plant else { return Vec::new() };
    let published = PresetId::ALL.into_iter().filter(|id| source(*id) == source(rig));
    published.map(|id| (label(id), id.preset().plant.valves)).collect()
}

fn label(id: PresetId) -> &'static str {
    match id {
        PresetId::JohanssonMinimumPhase | PresetId::CocotaMinimumPhase => "P−",
        PresetId::JohanssonNonMinimumPhase | PresetId::CocotaNonMinimumPhase => "P+",
        PresetId::JunqueiraA => "case a",
        PresetId::JunqueiraB => "case b",
        PresetId::Seville => "HD-MPC",
        PresetId::Quanser => "Quanser",
        PresetId::MpcTools => "MPCtools",
        PresetId::Dtu => "DTU",
    }
}

fn pole_zero(setup: &Setup, style: &Style) -> Result<String, StudyError> {
    /// Points along the way of a zero.
    const POINTS: usize = 200;
    let analysis = analyse(setup)?;
    let zeros: Vec<_> = analysis.linear.zeros.iter().flatten().map(|zero| zero.value).collect();
    let chart = quadtank_figure::pole_zero(&PoleZero {
        poles: &analysis.linear.poles,
        zeros: &zeros,
        zero_paths: &ValveMap::of(setup)?.zero_paths(POINTS),
        closed_loop: &analysis.closed_loop.poles_s,
        decimal: style.decimal,
        texts: PoleZeroTexts {
            real: "real part (1/s)",
            imaginary: "imaginary part (1/s)",
            poles: "poles",
            zeros: "zeros",
            closed_loop: "closed loop",
            beyond: "further out",
        },
    });
    let size = Size { width: 720.0, height: 480.0 };
    let description = "Poles and transmission zeros of the linear model, and the poles of the closed loop.";
    Ok(to_svg(&[chart], size, style, "Poles and zeros", description))
}

/// Both columns, borrowed.
fn columns(both: &[Vec<f64>; 2]) -> [&[f64]; 2] {
    both.each_ref().map(Vec::as_slice)
}

fn frequency(setup: &Setup, style: &Style) -> Result<String, StudyError> {
    let analysis = analyse(setup)?;
    let curves = FrequencyCurves::of(setup, &analysis)?;
    let peak = curves.closed.as_ref().map(|closed| format!("Ms = {:.3}", closed.peak.value));
    let charts = quadtank_figure::over_frequency(&FrequencyCharts {
        frequencies: &curves.frequencies,
        plant: columns(&curves.plant),
        closed: curves.closed.as_ref().map(|closed| ClosedLoopGains {
            sensitivity: columns(&closed.sensitivity),
            complementary: columns(&closed.complementary),
            peak: (closed.peak.frequency, closed.peak.value),
            bandwidth: closed.bandwidth,
        }),
        zero: curves.zero,
        texts: FrequencyTexts {
            frequency: "frequency (rad/s)",
            plant: "σ of G (V/V)",
            closed: "σ of S, T",
            largest: "largest",
            smallest: "smallest",
            peak: peak.as_deref().unwrap_or_default(),
            bandwidth: "ωB",
            zero: "z",
        },
    });
    let size = Size { width: 840.0, height: 560.0 };
    let description = if curves.closed.is_some() {
        "Singular values of the linear plant, and of the sensitivity and the complementary sensitivity of its sampled loop."
    } else {
        "Singular values of the linear plant. The sampled loop is not stable, so it has no sensitivity to show."
    };
    Ok(to_svg(&charts, size, style, "Over frequency", description))
}
