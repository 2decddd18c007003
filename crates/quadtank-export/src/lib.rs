//! The experiment of the home bench as a script in a language of control engineers, and its linear model as LaTeX.
//!
//! [`export`] writes a script that needs nothing of this laboratory: the parameters of a [`Scenario`], the equations, linear
//! analysis with the usual library of the language, the nonlinear closed loop, and the figures that this laboratory finds, which
//! the script holds its own against. What is the same for every experiment is a file in the language itself, in `templates/`;
//! only the block of numbers is generated.

mod data;
mod expected;
mod language;
mod latex;
mod remark;
#[cfg(test)]
mod sample;

pub use language::Language;
pub use latex::{LATEX_FILE_NAME, LATEX_MEDIA_TYPE, latex};

use quadtank::study::StudyError;
use quadtank_scenario::{BenchDocument, Scenario, ScenarioError};
use thiserror::Error;

/// Where the block of numbers goes in a template, behind the mark of a comment.
const PLACE: &str = " {{ data }}\n";

/// Why an experiment has no script.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ExportError {
    /// The document is not valid, so its numbers might mean something else in a script.
    #[error("{0}")]
    Scenario(#[from] ScenarioError),
    /// There are no figures to expect: no operating point, no linear model, or a run that takes too much work.
    #[error("{0}")]
    Study(#[from] StudyError),
}

/// The experiment of a scenario as a script.
///
/// The script computes everything anew and stops with an error where a figure differs from the one that this laboratory
/// finds by more than 1e-6 of its scale. All numbers are written with all their digits. Noise comes from a generator that other
/// languages do not have, so the script is of the run without noise, and says so. Name and note of the document stand in
/// comments, whatever characters they have.
///
/// # Errors
/// [`ExportError`] when the document is not valid or has no results.
///
/// # Examples
/// ```
/// use quadtank_export::{Language, export};
/// use quadtank_scenario::Scenario;
///
/// let script = export(&Scenario::default(), Language::Python)?;
/// assert!(script.contains("GAMMA = np.array([0.7, 0.6])"));
/// # Ok::<(), quadtank_export::ExportError>(())
/// ```
pub fn export(scenario: &Scenario, language: Language) -> Result<String, ExportError> {
    scenario.validate()?;
    let expected = expected::section(&scenario.setup)?;
    let mut block = remark::head(scenario, language);
    for section in data::sections(&scenario.setup).iter().chain([&expected]) {
        block.push_str(&language.section(section));
    }
    let block: String =
        block.lines().map(|line| format!("{}{line}", language.indent()).trim_end().to_owned() + "\n").collect();
    let place = format!("{}{PLACE}", language.comment_mark());
    Ok(language.template().replacen(&place, &block, 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadtank::literature::PresetId;
    use quadtank::plant::PlantError;
    use quadtank::study::StudyErrorKind;
    use quadtank::study::quadruple_tank::{OperatingPointSpec, analyse, setup_of};

    #[test]
    fn every_template_has_one_place_for_the_numbers() {
        for language in Language::ALL {
            let place = format!("{}{PLACE}", language.comment_mark());
            assert_eq!(language.template().matches(&place).count(), 1, "{}", language.name());
        }
    }

    #[test]
    fn the_script_of_every_preset_has_its_parameters_and_figures() {
        for id in PresetId::ALL {
            let setup = setup_of(id);
            let analysis = analyse(&setup).unwrap();
            let zero = analysis.linear.rightmost_zero().unwrap().value.re;
            let lambda = analysis.linear.rga_11.unwrap();
            let rig = setup.plant();
            let figures = [zero, lambda, rig.pumps[1].gain, rig.tanks[3].outlet.area, rig.gravity];
            for language in Language::ALL {
                let script = export(&Scenario::from(setup.clone()), language).unwrap();
                for figure in figures {
                    assert!(script.contains(&format!("{figure:?}")), "{} {}: {figure:?}", id.name(), language.name());
                }
                assert!(script.contains(id.name()) && !script.contains("{{") && !script.contains("NaN"));
                // What each language calls a number that is none.
                assert!(!script.contains("nan\n") && !script.contains("inf\n"));
            }
        }
    }

    #[test]
    fn noise_is_left_out_and_said() {
        let mut scenario = sample::everything_acts();
        for language in Language::ALL {
            let noisy = export(&scenario, language).unwrap();
            assert!(noisy.contains("standard deviation 0.0005 m is left out"), "{}", language.name());
        }
        let noisy = export(&scenario, Language::Python).unwrap();
        scenario.setup.experiment.measurement.noise_std = 0.0;
        let calm = export(&scenario, Language::Python).unwrap();
        let figures = |script: &str| script.split_once("EXPECTED_LEVEL =").unwrap().1.to_owned();
        assert!(!calm.contains("is left out"));
        assert_eq!(figures(&noisy), figures(&calm));
    }

    #[test]
    fn what_has_no_results_has_no_script() {
        let mut scenario = Scenario::default();
        scenario.setup.valves = [0.5, 0.5];
        scenario.setup.operating_point = OperatingPointSpec::Levels([0.1, 0.1]);
        let singular = StudyErrorKind::Plant(PlantError::SingularPlant { gamma_sum: 1.0 });
        for language in Language::ALL {
            let expected = ExportError::Study(StudyError { field: "operating_point", fault: singular });
            assert_eq!(export(&scenario, language), Err(expected));
        }
    }

    #[test]
    fn a_document_with_a_number_that_is_none_is_refused() {
        for gain in [f64::NAN, f64::INFINITY] {
            let mut scenario = Scenario::default();
            scenario.setup.controller.loops[0].gain = gain;
            assert!(matches!(export(&scenario, Language::Python), Err(ExportError::Scenario(_))));
        }
    }
}
