//! Pictures of a document as SVG, with English words: what the command line and the JavaScript module draw. The page draws its own, in
//! the language of its reader, from the same charts.

mod level_loop;
mod model_free;
mod quadruple;
mod relay_tuning;

use quadtank_figure::{Palette, Style};
use quadtank_scenario::Document;
use quadtank_scenario::answers::{AnswerError, studied};
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::{BenchDocument, Scenario};
use serde::Deserialize;

/// What can be drawn of a run of the quadruple tank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum HomePicture {
    /// Levels, references and pump voltages over time
    #[default]
    Responses,
    /// The right-most zero over the valves
    ValvePlane,
    /// Poles and zeros, open and closed loop
    PoleZero,
    /// Singular values of plant, sensitivity and complementary sensitivity over frequency
    Frequency,
}

/// What can be drawn of a relay-tuning session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum SessionPicture {
    /// The relay test over time
    Test,
    /// The critical curve in normalised gains, with estimates
    Curve,
    /// Both characteristic loci of the design, and at the critical gains
    #[default]
    Loci,
    /// Outputs and inputs after a step of the references
    Response,
}

/// What can be drawn of a level loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum LevelPicture {
    /// Level, flows and controller output over time
    #[default]
    Run,
    /// The step test with the model that is read from it
    StepTest,
    /// The variance of the level against that of the outflow
    TradeOff,
    /// The cost over gain and integral time
    CostMap,
}

/// What can be drawn of a run under the model-free law: the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModelFreePicture {
    /// Levels, voltages and estimates over time
    #[default]
    Run,
}

/// The colours of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Theme {
    /// Dark lines on white
    #[default]
    Light,
    /// Light lines on black
    Dark,
}

impl Theme {
    /// How charts are painted in these colours.
    fn style(self) -> Style {
        let palette = match self {
            Self::Light => Palette::LIGHT,
            Self::Dark => Palette::DARK,
        };
        Style { palette, decimal: '.', scale: 8 }
    }
}

/// What is to be drawn of each kind of document, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Drawing {
    /// Of a run of the quadruple tank.
    pub home: HomePicture,
    /// Of a relay-tuning session.
    pub session: SessionPicture,
    /// Of a level loop.
    pub level: LevelPicture,
    /// Colours.
    pub theme: Theme,
}

/// Draws a picture of a document as an SVG document.
///
/// # Errors
/// [`AnswerError`] where the setup has no results.
///
/// # Examples
/// ```
/// use quadtank_drawing::{Drawing, draw};
/// use quadtank_scenario::Scenario;
///
/// let svg = draw(&Scenario::default().into(), &Drawing::default())?;
/// assert!(svg.starts_with("<svg"));
/// # Ok::<(), quadtank_scenario::answers::AnswerError>(())
/// ```
pub fn draw(document: &Document, drawing: &Drawing) -> Result<String, AnswerError> {
    let style = &drawing.theme.style();
    match document {
        Document::Quadruple(scenario) => studied::<Scenario, _>(quadruple::svg(scenario.setup(), drawing.home, style)),
        Document::Tuning(scenario) => Ok(relay_tuning::svg(scenario.setup(), drawing.session, style)?),
        Document::ModelFree(scenario) => studied::<ModelFreeScenario, _>(model_free::svg(scenario.setup(), style)),
        Document::LevelLoop(scenario) => level_loop::svg(scenario.setup(), drawing.level, style),
    }
}
