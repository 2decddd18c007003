//! What a pinned run says of itself, and what it brings back.

use leptos::prelude::*;

use super::session::Session;
use quadtank::control::Pairing;
use quadtank::study::quadruple_tank::Setup;

/// Takes a pinned run up: the experiment is what all of them are compared in, so it stays.
pub fn restore(present: &mut Setup, pinned: &Setup) {
    *present = Setup { experiment: present.experiment.clone(), ..pinned.clone() };
}

/// The gains of a pinned run, and valves and pairing where they are not the present ones.
pub fn text(session: Session, pinned: &Setup) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let gains = [0, 1].map(|k| {
        let settings = pinned.controller.loops[k];
        let (gain, time) = (style.significant(settings.gain, 3), style.significant(settings.integral_time_s, 3));
        format!("{} {gain} · {time} s", ["K₁", "K₂"][k])
    });
    let mut parts = gains.to_vec();
    let (valves, pairing) = session.document.with(|s| (s.setup.valves, s.setup.controller.pairing));
    if pinned.valves != valves {
        let [one, two] = pinned.valves.map(|gamma| style.fixed(gamma, 2));
        parts.push(format!("γ {one}; {two}"));
    }
    if pinned.controller.pairing != pairing {
        let name = if pinned.controller.pairing == Pairing::Diagonal { "1–1 / 2–2" } else { "1–2 / 2–1" };
        parts.push(name.to_owned());
    }
    parts.join(" · ")
}
