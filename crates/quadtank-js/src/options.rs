//! Options of the functions, read as strictly as documents.

use quadtank_drawing::{Drawing, HomePicture, LevelPicture, ModelFreePicture, SessionPicture, Theme};
use quadtank_scenario::{CsvStyle, DOCUMENT_LIMIT, DecimalSign, Document, ScenarioError, Separator, read_json};
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// Signs of a table.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TableChoice {
    separator: Option<Separator>,
    decimal: DecimalSign,
}

impl TableChoice {
    /// The style that it asks for; with a decimal comma, if nothing is said, with semicolons.
    ///
    /// # Errors
    /// [`ScenarioError::Malformed`] for two commas.
    pub fn style(self) -> Result<CsvStyle, ScenarioError> {
        let usual = CsvStyle::usual(self.decimal);
        let style = CsvStyle::new(self.separator.unwrap_or(usual.separator()), self.decimal);
        style.map_err(|error| ScenarioError::Malformed { path: "separator".to_owned(), reason: error.to_string() })
    }
}

#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct PictureChoice<P> {
    chart: P,
    theme: Theme,
}

impl<P: Default> Default for PictureChoice<P> {
    fn default() -> Self {
        Self { chart: P::default(), theme: Theme::default() }
    }
}

/// What options (JSON) ask to draw of a document.
///
/// # Errors
/// [`ScenarioError::Malformed`] for a picture that documents of this kind do not have.
pub fn drawing_of(document: &Document, options: &str) -> Result<Drawing, ScenarioError> {
    fn choice<P: Default + DeserializeOwned>(options: &str) -> Result<PictureChoice<P>, ScenarioError> {
        read_json(options.as_bytes(), DOCUMENT_LIMIT)
    }
    Ok(match document {
        Document::Quadruple(_) => {
            let PictureChoice { chart, theme } = choice::<HomePicture>(options)?;
            Drawing { home: chart, theme, ..Drawing::default() }
        }
        Document::Tuning(_) => {
            let PictureChoice { chart, theme } = choice::<SessionPicture>(options)?;
            Drawing { session: chart, theme, ..Drawing::default() }
        }
        Document::ModelFree(_) => {
            let theme = choice::<ModelFreePicture>(options)?.theme;
            Drawing { theme, ..Drawing::default() }
        }
        Document::LevelLoop(_) => {
            let PictureChoice { chart, theme } = choice::<LevelPicture>(options)?;
            Drawing { level: chart, theme, ..Drawing::default() }
        }
    })
}
