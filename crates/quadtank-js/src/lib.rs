//! The laboratory as a JavaScript module: what the command line answers about a document, for notebooks and course pages.
//!
//! Documents and options come in and reports go out as JSON text; `npm/index.js` makes plain objects of them, `npm/index.d.ts` says
//! their types. An error is thrown with the message of the command line, which begins with the place in the document. Texts are read
//! by the same reader as files.
#![expect(
    clippy::missing_errors_doc,
    reason = "all throw what is wrong with the document or the options, as said above"
)]

mod options;

use quadtank_drawing::draw;
use quadtank_scenario::answers::{AnswerError, SearchRequest, report_json};
use quadtank_scenario::{
    CsvStyle, DOCUMENT_LIMIT, Document, Quantities, ScenarioError, UnknownQuantity, document_from_bytes,
    document_from_link, published_document, published_names, read_json,
};
use serde_json::{Map, Value};
use thiserror::Error;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

use options::{TableChoice, drawing_of};

/// Why there is no answer.
#[derive(Debug, Error)]
enum Fault {
    #[error("{0}")]
    Answer(#[from] AnswerError),
    #[error("{0}")]
    Scenario(#[from] ScenarioError),
    #[error("{0}")]
    Quantity(#[from] UnknownQuantity),
    #[error("there is no published rig or case `{0}`; publishedNames() lists them")]
    Unpublished(String),
}

type Answer = Result<String, JsError>;

fn answer(text: Result<String, Fault>) -> Answer {
    Ok(text?)
}

fn read(document: &str) -> Result<Document, ScenarioError> {
    document_from_bytes(document.as_bytes())
}

/// What linear theory says about a document, as JSON.
#[wasm_bindgen]
pub fn analyse(document: &str) -> Answer {
    answer(read(document).map_err(Fault::from).and_then(|document| Ok(document.analysis_json()?)))
}

/// What happens in the run of a document, as JSON.
#[wasm_bindgen]
pub fn simulate(document: &str) -> Answer {
    answer(read(document).map_err(Fault::from).and_then(|document| Ok(document.run_json()?)))
}

/// The run of a document as CSV; `options` is JSON with `separator` and `decimal`.
#[wasm_bindgen(js_name = simulateCsv)]
pub fn simulate_csv(document: &str, options: &str) -> Answer {
    let table = || {
        let style: CsvStyle = read_json::<TableChoice>(options.as_bytes(), DOCUMENT_LIMIT)?.style()?;
        Ok(style.apply(&read(document)?.run_csv()?).into_owned())
    };
    answer(table())
}

/// What relay test and design find, or a search for the settings of a level loop, as JSON; `options` is JSON that says how to search.
#[wasm_bindgen]
pub fn tune(document: &str, options: &str) -> Answer {
    let report = || {
        let request: SearchRequest = read_json(options.as_bytes(), DOCUMENT_LIMIT)?;
        request.check()?;
        Ok(read(document)?.tuning_json(&request)?)
    };
    answer(report())
}

/// Quantities of a document by their names, which are a list in JSON, as a JSON object; null where one does not exist.
#[wasm_bindgen]
pub fn quantities(document: &str, names: &str) -> Answer {
    let values = || {
        let names: Vec<String> = read_json(names.as_bytes(), DOCUMENT_LIMIT)?;
        let quantities = Quantities::of(&read(document)?);
        let value = |name: &String| Ok((name.clone(), Value::from(quantities.value(name)?)));
        let found = names.iter().map(value).collect::<Result<Map<_, _>, Fault>>()?;
        Ok(report_json(&found)?)
    };
    answer(values())
}

/// A picture of a document as SVG; `options` is JSON with `chart` and `theme`.
#[wasm_bindgen]
pub fn plot(document: &str, options: &str) -> Answer {
    let drawing = || {
        let document = read(document)?;
        Ok(draw(&document, &drawing_of(&document, options)?)?)
    };
    answer(drawing())
}

/// What a document may not have been meant to say, as a JSON list of sentences.
#[wasm_bindgen]
pub fn warnings(document: &str) -> Answer {
    answer(read(document).map_err(Fault::from).and_then(|document| Ok(report_json(&document.warnings())?)))
}

/// The document of a published rig or case, as JSON.
#[wasm_bindgen]
pub fn published(name: &str) -> Answer {
    let document = published_document(name).ok_or_else(|| Fault::Unpublished(name.to_owned()));
    answer(document.and_then(|document| Ok(document.to_json()?)))
}

/// The names of all published rigs and cases, as a JSON list.
#[wasm_bindgen(js_name = publishedNames)]
pub fn names_of_published() -> Answer {
    answer(report_json(&published_names()).map_err(Fault::from))
}

/// The text that stands for a document in a link to the laboratory, behind `#lab=`.
#[wasm_bindgen]
pub fn link(document: &str) -> Answer {
    answer(read(document).and_then(|document| document.to_link()).map_err(Fault::from))
}

/// The document in the text of a link, as JSON.
#[wasm_bindgen(js_name = fromLink)]
pub fn from_link(link: &str) -> Answer {
    answer(document_from_link(link).and_then(|document| document.to_json()).map_err(Fault::from))
}
