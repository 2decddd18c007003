//! The words that a lesson can link to. The page holds their explanations, in each of its languages.

/// All words of the glossary, as links name them: `[zero](glossary:zero)`.
pub const TERMS: [&str; 74] = [
    "gamma",
    "minimum_phase",
    "zero",
    "right_half_plane",
    "pole",
    "closed_loop",
    "direction",
    "relative_gain",
    "pairing",
    "niederlinski",
    "gain",
    "integral_time",
    "peak",
    "singular_value",
    "sensitivity",
    "complementary",
    "bandwidth",
    "windup",
    "weight",
    "reference",
    "rise",
    "overshoot",
    "costs",
    "linear",
    "load",
    "noise",
    "relay",
    "ultimate",
    "describing",
    "hysteresis",
    "critical_curve",
    "importance",
    "locus",
    "target",
    "margins",
    "log_modulus",
    "decoupler",
    "local_model",
    "estimate",
    "alpha",
    "lost",
    "transmitter",
    "converter",
    "actuator",
    "characteristic",
    "resistance",
    "tight",
    "averaging",
    "variance",
    "disturbance",
    "random",
    "self_regulating",
    "reaction_curve",
    "process_gain",
    "half_rule",
    "gain_of_signals",
    "simc",
    "lambda",
    "variance_index",
    "harris",
    "travel",
    "cost_map",
    "gradient",
    "simplex",
    "genetic",
    "pi_forms",
    "proportional_band",
    "step_size",
    "level_windup",
    "level_costs",
    "sine",
    "search_box",
    "move_penalty",
    "amigo",
];

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::Value;

    use super::TERMS;

    /// The heading of the glossary stands among its words.
    const HEADING: &str = "title";

    #[test]
    fn the_words_are_those_that_the_page_explains() {
        for language in ["en", "pt-BR", "es"] {
            let file = format!("{}/../../assets/glossary/{language}.json", env!("CARGO_MANIFEST_DIR"));
            let texts: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
            let mut explained: Vec<&str> =
                texts["terms"].as_object().unwrap().keys().map(String::as_str).filter(|key| *key != HEADING).collect();
            let mut known = TERMS.to_vec();
            explained.sort_unstable();
            known.sort_unstable();
            assert_eq!(known, explained, "{language}");
        }
    }
}
