//! Published rigs and cases as documents, by name.

use quadtank::literature::andreis::PublishedDisturbance;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::literature::wood_berry::PublishedControllers;
use quadtank::literature::{LevelPresetId, PresetId, level_slides};
use quadtank::sim::level::LevelController;
use quadtank::study::level_loop::{LevelLoopSetup, published_setup};
use quadtank::study::model_free::ModelFreeSetup;
use quadtank::study::quadruple_tank::setup_of;
use quadtank::study::relay_tuning::TuningSetup;

use super::level_loop::LevelLoopScenario;
use super::model_free::ModelFreeScenario;
use super::tuning::TuningScenario;
use super::{Document, Scenario};

/// The document of a published rig or case, by the name that `quadtank presets` or `quadtank cases` lists.
pub fn published_document(name: &str) -> Option<Document> {
    let rig = || PresetId::from_name(name).map(|id| Scenario::from(setup_of(id)).into());
    let tuning =
        || PublishedCase::from_name(name).map(|case| TuningScenario::from(TuningSetup::published(case)).into());
    let given = || {
        let controllers = PublishedControllers::from_name(name)?;
        Some(TuningScenario::from(TuningSetup::with_published(controllers)).into())
    };
    let model_free = || {
        let (_, valves, run) = model_free_cases().find(|(known, ..)| known == name)?;
        Some(ModelFreeScenario::from(ModelFreeSetup::published(valves, run)).into())
    };
    let level_loop = || {
        let (.., setup) = level_loop_cases().find(|(known, ..)| known == name)?;
        Some(LevelLoopScenario::from(setup).into())
    };
    rig().or_else(tuning).or_else(given).or_else(model_free).or_else(level_loop)
}

/// The names that [`published_document`] knows: rigs, then cases.
pub fn published_names() -> Vec<String> {
    let rigs = PresetId::ALL.into_iter().map(|id| id.name().to_owned());
    let tuning = PublishedCase::all().map(PublishedCase::name);
    let given = PublishedControllers::ALL.into_iter().map(|controllers| controllers.name().to_owned());
    let model_free = model_free_cases().map(|(name, ..)| name);
    rigs.chain(tuning).chain(given).chain(model_free).chain(level_loop_cases().map(|(name, ..)| name)).collect()
}

/// The published cases by name: `junqueira-a-s1` and so on.
pub fn model_free_cases() -> impl Iterator<Item = (String, PublishedValves, PublishedExperiment)> {
    PublishedValves::ALL.into_iter().flat_map(|valves| {
        PublishedExperiment::ALL.into_iter().map(move |experiment| {
            let name = format!("junqueira-{valves:?}-{experiment:?}").to_lowercase();
            (name, valves, experiment)
        })
    })
}

/// The published cases with their names and places.
pub fn level_loop_cases() -> impl Iterator<Item = (String, String, LevelLoopSetup)> {
    let plants = [
        (LevelPresetId::Andreis, "andreis", "the plant with its current controller"),
        (LevelPresetId::AndreisUncertain, "andreis-uncertain", "the model with errors, the same controller"),
    ];
    let andreis = plants.into_iter().flat_map(|(id, name, what)| {
        PublishedDisturbance::ALL.map(|disturbance| {
            let (suffix, title, tables) = match disturbance {
                PublishedDisturbance::SineL => ("sine-l", "Sine Wave L", "Tables 5.1, 5.2"),
                PublishedDisturbance::SineH => ("sine-h", "Sine Wave H", "Tables 5.3, 5.4"),
                PublishedDisturbance::Random => ("random", "Random", "Tables 5.5, 5.6"),
            };
            let place = format!("Andreis (2017), §5.1, {tables}: {what}, {title}");
            (format!("{name}-{suffix}"), place, published_setup(id, disturbance))
        })
    });
    let slides = level_slides::settings().into_iter().enumerate().map(|(index, settings)| {
        let disturbance = PublishedDisturbance::SineL;
        let controller = LevelController::pid(settings, level_slides::DERIVATIVE_FILTER_S);
        let setup = LevelLoopSetup { controller, ..published_setup(LevelPresetId::LectureSlides, disturbance) };
        let minutes = level_slides::MINUTE;
        let [p, i, d] = [settings.proportional, settings.integral * minutes, settings.derivative / minutes];
        let place = format!("lecture slides on a level tank, setting {}: P = {p}, I = {i}/min, D = {d} min", index + 1);
        (format!("level-slides-{}", index + 1), place, setup)
    });
    andreis.chain(slides)
}
