use serde::{Deserialize, Serialize};

use super::{andreis, level_slides};
use crate::plant::level::LevelPlant;

/// A published level loop. The names stand in documents and links and are never changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LevelPresetId {
    /// Andreis (2017), the plant of Tables 4.1 and 4.2.
    Andreis,
    /// Andreis (2017), the model "with uncertainties" of §5.1.
    AndreisUncertain,
    /// The control example of the lecture slides.
    LectureSlides,
}

impl LevelPresetId {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Andreis, Self::AndreisUncertain, Self::LectureSlides];

    /// The loop.
    pub fn plant(self) -> LevelPlant {
        match self {
            Self::Andreis => andreis::plant(),
            Self::AndreisUncertain => andreis::uncertain_plant(),
            Self::LectureSlides => level_slides::plant(),
        }
    }
}
