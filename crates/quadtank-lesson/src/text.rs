use serde::{Deserialize, Serialize};

/// A language in which lessons are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Tongue {
    /// English.
    #[serde(rename = "en")]
    En,
    /// Brazilian Portuguese.
    #[serde(rename = "pt-BR")]
    PtBr,
    /// Spanish.
    #[serde(rename = "es")]
    Es,
}

impl Tongue {
    /// All languages.
    pub const ALL: [Self; 3] = [Self::En, Self::PtBr, Self::Es];

    /// Its tag, as in `lang` of an address.
    pub fn tag(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::PtBr => "pt-BR",
            Self::Es => "es",
        }
    }

    /// The language of a tag.
    pub fn of_tag(tag: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|tongue| tongue.tag() == tag)
    }
}

/// A text in the languages of a lesson.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Text {
    /// English.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub en: Option<String>,
    /// Brazilian Portuguese.
    #[serde(default, rename = "pt-BR", skip_serializing_if = "Option::is_none")]
    pub pt_br: Option<String>,
    /// Spanish.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub es: Option<String>,
}

impl Text {
    /// The text in a language, if there is one that is not empty.
    pub fn get(&self, tongue: Tongue) -> Option<&str> {
        let text = match tongue {
            Tongue::En => &self.en,
            Tongue::PtBr => &self.pt_br,
            Tongue::Es => &self.es,
        };
        text.as_deref().filter(|text| !text.trim().is_empty())
    }

    /// The text in a language or, where the lesson does not have it, in the first one that it has.
    pub fn shown(&self, tongue: Tongue) -> &str {
        self.get(tongue).or_else(|| Tongue::ALL.into_iter().find_map(|other| self.get(other))).unwrap_or_default()
    }
}
