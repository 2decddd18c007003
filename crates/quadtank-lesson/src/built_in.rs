//! The lessons of the laboratory.

/// Their ids in the order of the course. The file of the lesson `id` at place `n` (from 1) is `lessons/n-id.json`, `n` with two digits.
pub const LESSON_IDS: [&str; 12] = [
    "two-valves-one-zero",
    "relative-gain-blows-up",
    "swap-the-pairing",
    "price-of-a-right-half-plane-zero",
    "directions",
    "linear-is-local",
    "windup",
    "relay-finds-the-ultimate-point",
    "critical-curve-has-corners",
    "perfect-outputs-exploding-insides",
    "tight-or-averaging",
    "wrong-operating-point",
];

/// Their files, in the same order.
#[cfg(feature = "built-in")]
pub const BUILT_IN: [&str; 12] = [
    include_str!("../lessons/01-two-valves-one-zero.json"),
    include_str!("../lessons/02-relative-gain-blows-up.json"),
    include_str!("../lessons/03-swap-the-pairing.json"),
    include_str!("../lessons/04-price-of-a-right-half-plane-zero.json"),
    include_str!("../lessons/05-directions.json"),
    include_str!("../lessons/06-linear-is-local.json"),
    include_str!("../lessons/07-windup.json"),
    include_str!("../lessons/08-relay-finds-the-ultimate-point.json"),
    include_str!("../lessons/09-critical-curve-has-corners.json"),
    include_str!("../lessons/10-perfect-outputs-exploding-insides.json"),
    include_str!("../lessons/11-tight-or-averaging.json"),
    include_str!("../lessons/12-wrong-operating-point.json"),
];

/// The file of a lesson of the laboratory.
#[cfg(feature = "built-in")]
pub fn built_in(id: &str) -> Option<&'static str> {
    LESSON_IDS.iter().position(|known| *known == id).map(|index| BUILT_IN[index])
}
