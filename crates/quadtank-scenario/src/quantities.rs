//! The numbers that follow from a document, by their names.

use std::fmt;

use quadtank::study::{Quantity, Study};
use serde::Serialize;
use thiserror::Error;

use super::codec::DocumentKind;
use super::{BenchDocument, Document};

/// What is known of a quantity without any results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct QuantityRow {
    /// Its name, such as `zero.rightmost`.
    pub name: &'static str,
    /// Its unit in SI; `1` for a ratio, `yes/no` for 1 or 0.
    pub unit: &'static str,
    /// What it is, in one sentence.
    pub description: &'static str,
}

/// No bench has every quantity.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("the bench {bench} has no quantity `{name}`")]
pub struct UnknownQuantity {
    /// The name that was asked for.
    pub name: String,
    /// The bench of the document.
    pub bench: &'static str,
}

/// All quantities of documents of a version, in the order of their table; none of an unknown version.
pub fn quantities_of(version: u32) -> Vec<QuantityRow> {
    DocumentKind::of_version(version.into()).map_or_else(Vec::new, |kind| (kind.quantities)())
}

/// The name of the bench with documents of a version, which the address of the page has too; `None` of an unknown version.
pub fn bench_of(version: u32) -> Option<&'static str> {
    DocumentKind::of_version(version.into()).map(|kind| kind.bench)
}

/// The rows of the table of a study.
pub(super) fn rows_of<S: Study>() -> Vec<QuantityRow> {
    let row = |quantity: &Quantity<S::Results>| {
        let Quantity { name, unit, description, .. } = *quantity;
        QuantityRow { name, unit, description }
    };
    S::QUANTITIES.iter().map(row).collect()
}

/// The results of a document, to be asked for quantities. The document is computed once; what takes a search of its own is
/// computed when it is asked for.
pub struct Quantities(Box<dyn Results>);

/// Results whose type the bench knows.
trait Results {
    fn bench(&self) -> &'static str;
    fn value(&self, name: &str) -> Result<Option<f64>, UnknownQuantity>;
    fn rows(&self) -> Vec<QuantityRow>;
}

/// The results of a document of a bench.
struct ResultsOf<D: BenchDocument>(<D::Study as Study>::Results);

impl<D: BenchDocument> Results for ResultsOf<D> {
    fn bench(&self) -> &'static str {
        D::BENCH
    }

    fn value(&self, name: &str) -> Result<Option<f64>, UnknownQuantity> {
        let unknown = || UnknownQuantity { name: name.to_owned(), bench: D::BENCH };
        Quantity::find(D::Study::QUANTITIES, name).map(|quantity| quantity.value(&self.0)).ok_or_else(unknown)
    }

    fn rows(&self) -> Vec<QuantityRow> {
        rows_of::<D::Study>()
    }
}

impl Quantities {
    /// Computes a document.
    pub fn of(document: &Document) -> Self {
        match document {
            Document::Quadruple(document) => Self::computed(document),
            Document::Tuning(document) => Self::computed(document),
            Document::ModelFree(document) => Self::computed(document),
            Document::LevelLoop(document) => Self::computed(document),
        }
    }

    fn computed<D: BenchDocument>(document: &D) -> Self {
        Self(Box::new(ResultsOf::<D>(D::Study::update(document.setup(), &[], None))))
    }

    /// The quantity with this name; `None` where it does not exist for this document.
    ///
    /// # Errors
    /// [`UnknownQuantity`] for a name that the bench does not have.
    pub fn value(&self, name: &str) -> Result<Option<f64>, UnknownQuantity> {
        self.0.value(name)
    }

    /// All quantities of the bench, in the order of their table.
    pub fn rows(&self) -> Vec<QuantityRow> {
        self.0.rows()
    }
}

impl Document {
    /// The name of its bench, as in the address of the page.
    pub fn bench(&self) -> &'static str {
        match self {
            Self::Quadruple(_) => crate::Scenario::BENCH,
            Self::Tuning(_) => crate::tuning::TuningScenario::BENCH,
            Self::ModelFree(_) => crate::model_free::ModelFreeScenario::BENCH,
            Self::LevelLoop(_) => crate::level_loop::LevelLoopScenario::BENCH,
        }
    }
}

impl fmt::Debug for Quantities {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Quantities").field("bench", &self.0.bench()).finish_non_exhaustive()
    }
}
