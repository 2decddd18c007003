//! What a step has set on the bench that stood otherwise before, in one line: nothing changes silently.

use leptos::prelude::*;
use quadtank_scenario::Difference;

use super::classroom::use_classroom;
use crate::lab::{Lab, use_lab};
use crate::texts::tr;

/// The line; hidden where the bench stays as it was.
#[component]
pub fn WhatWasSet() -> impl IntoView {
    let (lab, room) = (use_lab(), use_classroom());
    let text = Memo::new(move |_| {
        let names = room.changed.with(|changed| names(lab, changed));
        (!names.is_empty()).then(|| tr!(lab, lesson.step_set, list = names.join(", ")))
    });
    view! { <p class="remark" data-testid="step-set" hidden=move || text.get().is_none()>{move || text.get()}</p> }
}

/// Numbers with a symbol by it and their values; of all else the part of the document, once.
fn names(lab: Lab, changed: &[Difference]) -> Vec<String> {
    changed.iter().map(|difference| number(lab, difference).unwrap_or_else(|| part(lab, &difference.path))).fold(
        Vec::new(),
        |mut known, next| {
            if !known.contains(&next) {
                known.push(next);
            }
            known
        },
    )
}

fn number(lab: Lab, difference: &Difference) -> Option<String> {
    let param = difference.param()?;
    let symbol = symbol(param.path)?;
    let [before, after] = difference.values.map(|value| lab.number_style().significant(value.unwrap_or(f64::NAN), 3));
    let unit = if matches!(param.unit, "V" | "s") { format!("\u{a0}{}", param.unit) } else { String::new() };
    Some(format!("{symbol}{} {before} → {after}{unit}", subscript(&difference.path)))
}

/// The symbol of the number of a row, as on the sliders.
fn symbol(row: &str) -> Option<&'static str> {
    Some(match row {
        "valves[]" => "γ",
        "operating_point.pump_voltage[]" | "operating_point.state.pump_voltage[]" => "v",
        "operating_point.levels[]" | "operating_point.state.levels[]" => "h",
        "controller.loops[].gain" => "K",
        "controller.loops[].integral_time_s" | "controller.pi.integral_time_s" => "Ti",
        "controller.pi.gain" => "Kp",
        _ => return None,
    })
}

/// The place in a list of two or four, counted from one, as sources write it.
fn subscript(path: &str) -> &'static str {
    let index = path.rsplit_once('[').and_then(|(_, rest)| rest.split(']').next()?.parse::<usize>().ok());
    index.and_then(|index| ["₁", "₂", "₃", "₄"].get(index).copied()).unwrap_or_default()
}

/// The part of a document, in words.
fn part(lab: Lab, path: &str) -> String {
    let inside = path.split_once('.').map_or(path, |(_, inside)| inside);
    let name = match inside.split(['.', '[']).next().unwrap_or_default() {
        "plant" => tr!(lab, lesson.rig),
        "valves" => tr!(lab, lock.valves),
        "operating_point" => tr!(lab, lock.voltages),
        "controller" if inside.ends_with("pairing") => tr!(lab, lock.pairing),
        "controller" | "controllers" => tr!(lab, lesson.set_controller),
        "experiment" => tr!(lab, lock.experiment),
        "test" => tr!(lab, lesson.set_test),
        "objective" => tr!(lab, lock.objective),
        _ => tr!(lab, lesson.set_rest),
    };
    let mut letters = name.chars();
    letters.next().map(|first| first.to_lowercase().chain(letters).collect()).unwrap_or_default()
}
