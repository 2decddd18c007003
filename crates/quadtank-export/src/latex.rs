//! The linear model and the controller as LaTeX, with nothing but `amsmath`.

mod write;

use nalgebra::DMatrix;
use quadtank::control::{AntiWindup, LoopMode, PiSettings};
use quadtank::linear::TransmissionZero;
use quadtank::plant::Pump;
use quadtank::study::quadruple_tank::{Analysis, Setup, analyse};
use quadtank_scenario::{BenchDocument, Scenario};

use crate::{ExportError, remark};
use write::{complex, list, matrix, number, row};

/// What a LaTeX document should be called.
pub const LATEX_FILE_NAME: &str = "quadtank_model.tex";
/// The media type of a LaTeX document.
pub const LATEX_MEDIA_TYPE: &str = "application/x-tex";

/// Lines are short enough for the narrow page of `article`.
const TEMPLATE: &str = include_str!("../templates/model.tex");

/// Linear model and controller of a scenario as a LaTeX document that needs `amsmath` alone: operating point, state-space matrices,
/// transfer matrix, zeros with their directions, relative gains, and the law of both loops with its numbers.
///
/// Numbers have six significant digits and are those of [`analyse`]. Name and note of the document stand in comments.
///
/// # Errors
/// [`ExportError`] when the document is not valid or has no linear model.
///
/// # Examples
/// ```
/// use quadtank_export::latex;
/// use quadtank_scenario::Scenario;
///
/// let text = latex(&Scenario::default())?;
/// assert!(text.contains(r"\Lambda &= \begin{bmatrix} 1.4 & -0.4 \\ -0.4 & 1.4 \end{bmatrix}"));
/// # Ok::<(), quadtank_export::ExportError>(())
/// ```
pub fn latex(scenario: &Scenario) -> Result<String, ExportError> {
    scenario.validate()?;
    let setup = &scenario.setup;
    let analysis = analyse(setup)?;
    let (rest, model) = (&analysis.operating_point, &analysis.linear.model);
    // The remark comes last: it may have any text in it.
    let parts = [
        ("levels", row(&rest.levels)),
        ("voltages", row(&rest.pump_voltage)),
        ("valves", row(&setup.valves)),
        ("fractions", fractions(setup, rest.pump_voltage)),
        ("rest", if analysis.drift.is_none() { " at rest" } else { ", which are not at rest" }.to_owned()),
        ("drifts", if analysis.drift.is_none() { "" } else { "d + " }.to_owned()),
        ("drift", drift(&analysis)),
        ("states", states(&analysis)),
        ("a", of_model(&model.a)),
        ("b", of_model(&model.b)),
        ("c", of_model(&model.c)),
        ("d", of_model(&model.d)),
        ("poles", list(&analysis.linear.poles)),
        ("delays", delays(&setup.plant().pumps)),
        ("transfer", transfer_matrix(&analysis, &setup.plant().pumps)),
        ("gain", matrix(analysis.linear.dc_gain.map(|row| row.map(number)))),
        ("zeros", zeros(&analysis)),
        ("relative_gains", relative_gains(&analysis)),
        ("sampling_time", format!("${}$", number(setup.controller.sampling_time_s))),
        ("power_gain", format!("${}$", number(setup.plant().power_gain))),
        ("laws", [0, 1].map(|index| law(setup, index)).join(" \\\\\n")),
        ("windup", [0, 1].map(|index| remark_of_loop(&setup.controller.loops[index], index)).join("\n")),
        ("remark", remark::about(scenario, "%")),
    ];
    Ok(parts.into_iter().fold(TEMPLATE.to_owned(), |text, (name, part)| text.replacen(&placeholder(name), &part, 1)))
}

/// Where a part goes in the template; a remark has its line with the mark of a comment to itself.
fn placeholder(name: &str) -> String {
    if name == "remark" { format!("% {{{{ {name} }}}}\n") } else { format!("{{{{ {name} }}}}") }
}

/// What the fractions are where they depend on the flow: those of the flow, and of a small change of it.
fn fractions(setup: &Setup, pump_voltage: [f64; 2]) -> String {
    let plant = setup.plant();
    if !plant.has_flow_dependent_valves() {
        return String::new();
    }
    let [slopes, of_flow, of_change] =
        [plant.valve_slopes, plant.fractions_at(pump_voltage), plant.incremental_fractions(pump_voltage)]
            .map(|pair| row(&pair));
    format!(
        " of small flows, which grow\nwith the flow through each valve by ${slopes}$\\,s/m$^3$ to \
         ${of_flow}$; of a small change of it goes ${of_change}$\nto the lower tanks"
    )
}

fn of_model(of: &DMatrix<f64>) -> String {
    matrix(of.row_iter().map(|row| row.iter().map(|&entry| number(entry)).collect::<Vec<_>>()))
}

/// How fast the states leave a point that is not at rest by themselves (m/s).
fn drift(analysis: &Analysis) -> String {
    let Some(drift) = analysis.drift else { return String::new() };
    let states: Vec<f64> =
        (0..4).filter(|&tank| analysis.time_constants_s[tank].is_some()).map(|tank| drift[tank]).collect();
    format!("  d &= {}^{{\\mathsf{{T}}}}, \\\\\n", row(&states))
}

/// The tanks that are not dry, whose levels are the states.
fn states(analysis: &Analysis) -> String {
    let wet = analysis.time_constants_s.iter().enumerate().filter(|(_, time)| time.is_some());
    let tanks: Vec<String> = wet.map(|(tank, _)| (tank + 1).to_string()).collect();
    match tanks.split_last() {
        None => "no tank".to_owned(),
        Some((tank, [])) => format!("tank {tank}"),
        Some((last, others)) => format!("tanks {} and {last}", others.join(", ")),
    }
}

/// G(s): one lag where a pump feeds a lower tank, two where its water passes an upper one (Johansson 2000, eq. 2). A dry tank
/// passes its inflow on at once. The hose of a pump is a dead time.
fn transfer_matrix(analysis: &Analysis, pumps: &[Pump; 2]) -> String {
    let element = |output: usize, input: usize| {
        let tanks = if output == input { vec![output] } else { vec![output, output + 2] };
        let lags = tanks.into_iter().filter_map(|tank| analysis.time_constants_s[tank]);
        let lags: Vec<String> = lags.map(|time| format!("({} s + 1)", number(time))).collect();
        let element = match (analysis.linear.dc_gain[output][input], lags.as_slice()) {
            (0.0, _) => return "0".to_owned(),
            (gain, []) => number(gain),
            (gain, [lag]) => format!("\\dfrac{{{}}}{{{}}}", number(gain), &lag[1..lag.len() - 1]),
            (gain, lags) => format!("\\dfrac{{{}}}{{{}}}", number(gain), lags.join(" ")),
        };
        let delay_s = pumps[input].delay_s;
        if delay_s > 0.0 { format!("{element}\\, e^{{-{} s}}", number(delay_s)) } else { element }
    };
    // More room between rows of fractions.
    matrix([0, 1].map(|output| [0, 1].map(|input| element(output, input)))).replacen(" \\\\ ", " \\\\[2ex] ", 1)
}

/// What the hoses do to the inputs.
fn delays(pumps: &[Pump; 2]) -> String {
    if pumps.iter().all(|pump| pump.delay_s == 0.0) {
        return String::new();
    }
    let [first, second] = pumps.map(|pump| number(pump.delay_s));
    format!(" The inputs $u_1$ and $u_2$ act ${first}$\\,s and ${second}$\\,s late.")
}

fn zeros(analysis: &Analysis) -> String {
    let zeros = match &analysis.linear.zeros {
        Err(_) => return "$\\det G(s) = 0$ for every $s$: there are no isolated zeros.".to_owned(),
        Ok(zeros) if zeros.is_empty() => return "There are no finite zeros.".to_owned(),
        Ok(zeros) => zeros,
    };
    let rows: Vec<String> = zeros.iter().enumerate().map(|(index, zero)| zero_row(index + 1, zero)).collect();
    format!(
        "Each zero $z_i$ (1/s) with the direction $p_i$ of the inputs that pass nothing there, $G(z_i)\\,p_i = 0$, and that of the \
         outputs that\nno input moves, $q_i^{{\\mathsf{{H}}}} G(z_i) = 0$:\n\\begin{{align*}}\n{}\n\\end{{align*}}",
        rows.join(" \\\\\n")
    )
}

fn zero_row(number: usize, zero: &TransmissionZero) -> String {
    let direction = |entries: &[_]| matrix([entries.iter().map(|&entry| complex(entry)).collect::<Vec<_>>()]);
    format!(
        "  z_{number} &= {}, & p_{number} &= {}^{{\\mathsf{{T}}}}, \\\\\n  & & q_{number} &= {}^{{\\mathsf{{T}}}}",
        complex(zero.value),
        direction(zero.input_direction.as_slice()),
        direction(zero.output_direction.as_slice()),
    )
}

fn relative_gains(analysis: &Analysis) -> String {
    let Ok(lambda) = analysis.linear.rga_11 else {
        return "$G(0)$ is singular: the relative gain array does not exist.".to_owned();
    };
    let array = matrix([[lambda, 1.0 - lambda], [1.0 - lambda, lambda]].map(|row| row.map(number)));
    let index = |name: &str, index: Option<f64>| {
        index.map_or_else(String::new, |index| format!(", \\\\\n  N_{{\\text{{{name}}}}} &= {}", number(index)))
    };
    let [diagonal, swapped] = analysis.linear.niederlinski;
    format!(
        "Relative gain array at steady state, and the Niederlinski index of each pairing that has one:\n\\begin{{align*}}\n  \
         \\Lambda &= {array}{}{}\n\\end{{align*}}",
        index("diagonal", diagonal),
        index("swapped", swapped),
    )
}

/// `u_p = K (b r − y + (1/Ti) ∫ (r − y) dt)`
fn law(setup: &Setup, index: usize) -> String {
    let PiSettings { gain, integral_time_s, set_point_weight, .. } = setup.controller.loops[index];
    let (level, pump) = (index + 1, setup.controller.pairing.pump_of(index) + 1);
    let weight = if set_point_weight == 1.0 { String::new() } else { format!("{}\\,", number(set_point_weight)) };
    format!(
        "  u_{pump}(t) &= {} \\left( {weight}r_{level}(t) - y_{level}(t) + \\frac{{1}}{{{}}} \\int_0^t \\bigl( r_{level}(\\tau) - \
         y_{level}(\\tau) \\bigr)\\, d\\tau \\right)",
        number(gain),
        number(integral_time_s),
    )
}

/// What keeps the integral of a loop from winding up, and whether a person moves its output at first.
fn remark_of_loop(settings: &PiSettings, index: usize) -> String {
    let windup = match settings.anti_windup {
        AntiWindup::Off => "has nothing against windup".to_owned(),
        AntiWindup::BackCalculation { tracking_ratio } => {
            let time = number(tracking_ratio * settings.integral_time_s);
            format!("has back-calculation with the tracking time ${time}$\\,s")
        }
    };
    let manual = match settings.mode {
        LoopMode::Automatic => String::new(),
        LoopMode::Manual { output, until_s } => {
            format!(", and is in manual mode at ${}$\\,V until ${}$\\,s", number(output), number(until_s))
        }
    };
    format!("Loop {} {windup}{manual}.", index + 1)
}

#[cfg(test)]
mod tests;
