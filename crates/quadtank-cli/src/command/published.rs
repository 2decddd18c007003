//! The published rigs and cases by name.

use std::fmt::Write as _;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::literature::wood_berry::PublishedControllers;
use quadtank::study::level_loop::LevelLoopSetup;
use quadtank::study::model_free::ModelFreeSetup;
use quadtank_scenario::{level_loop_cases, model_free_cases};

pub fn preset_parser() -> impl TypedValueParser<Value = PresetId> {
    PossibleValuesParser::new(PresetId::ALL.map(PresetId::name))
        .try_map(|name| PresetId::from_name(&name).ok_or("unknown rig"))
}

/// A published case of any kind.
#[derive(Clone, Debug)]
pub enum Case {
    Tuning(PublishedCase),
    Controllers(PublishedControllers),
    ModelFree(Box<ModelFreeSetup>),
    LevelLoop(Box<LevelLoopSetup>),
}

pub fn case_of(name: &str) -> Result<Case, &'static str> {
    let model_free = || model_free_cases().find(|(known, ..)| known == name);
    let level_loop = || level_loop_cases().find(|(known, ..)| known == name);
    PublishedCase::from_name(name)
        .map(Case::Tuning)
        .or_else(|| PublishedControllers::from_name(name).map(Case::Controllers))
        .or_else(|| {
            model_free().map(|(_, valves, run)| Case::ModelFree(Box::new(ModelFreeSetup::published(valves, run))))
        })
        .or_else(|| level_loop().map(|(.., setup)| Case::LevelLoop(Box::new(setup))))
        .ok_or("unknown case; `quadtank cases` lists them")
}

pub fn list_of_presets() -> String {
    PresetId::ALL.map(PresetId::preset).iter().fold(String::new(), |mut list, preset| {
        let [gamma_1, gamma_2] = preset.plant.valves;
        let name = preset.id.name();
        // Writing to a String cannot fail.
        let _ = writeln!(list, "{name:<33} γ = {gamma_1:.2}, {gamma_2:.2}   {}, {}", preset.source, preset.table);
        list
    })
}

pub fn list_of_cases() -> String {
    let tuning = PublishedCase::all().fold(String::new(), |mut list, case| {
        let place = match case.table {
            0 => "§6.4, solvents column".to_owned(),
            88 => "eq. 88".to_owned(),
            table => format!("Table {table}, row {}", case.row),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(list, "{:<16} Campestrini (2006), {place}", case.name());
        list
    });
    let given = PublishedControllers::ALL.into_iter().fold(tuning, |mut list, controllers| {
        let source = controllers.source();
        let _ = writeln!(list, "{:<28} {source}: the column of Wood and Berry", controllers.name());
        list
    });
    let both = model_free_cases().fold(given, |mut list, (name, valves, experiment)| {
        let _ = writeln!(list, "{name:<16} Junqueira, Neves and Angelico, case {valves:?}, experiment {experiment:?}");
        list
    });
    level_loop_cases().fold(both, |mut list, (name, place, _)| {
        let _ = writeln!(list, "{name:<24} {place}");
        list
    })
}
