//! The names of cards and groups of controls that a lesson may use. The page holds what they stand for; a test of the page
//! compares both.

/// What a lesson may name of a bench.
#[derive(Clone, Copy, Debug)]
pub struct BenchNames {
    /// Its name.
    pub id: &'static str,
    /// Version of its document.
    pub version: u32,
    /// Its cards.
    pub panels: &'static [&'static str],
    /// Its groups of controls.
    pub locks: &'static [&'static str],
}

/// All benches.
const BENCHES: [BenchNames; 4] = [
    BenchNames {
        id: "quadruple-tank",
        version: 1,
        panels: &["process", "valves", "zeros", "rga", "controller", "experiment", "why", "responses"],
        locks: &["preset", "valves", "voltages", "pairing", "gains", "sampling", "experiment"],
    },
    BenchNames {
        id: "relay-tuning",
        version: 2,
        panels: &["plant", "test", "curve", "placement", "responses"],
        locks: &["plant", "test", "point", "target", "experiment"],
    },
    BenchNames {
        id: "model-free",
        version: 3,
        panels: &["process", "valves", "zeros", "responses", "experiment", "controller", "claims"],
        locks: &["valves", "experiment", "gains", "sampling", "pairing"],
    },
    BenchNames {
        id: "level-loop",
        version: 4,
        panels: &[
            "process",
            "experiment",
            "responses",
            "test",
            "trade-off",
            "controller",
            "assessment",
            "map",
            "forms",
            "published",
            "heated",
        ],
        locks: &["plant", "test", "experiment", "objective", "gains"],
    },
];

/// The names of all benches.
pub fn bench_ids() -> [&'static str; BENCHES.len()] {
    BENCHES.map(|bench| bench.id)
}

/// What a lesson may name of the bench with an id.
pub fn bench_names(id: &str) -> Option<&'static BenchNames> {
    BENCHES.iter().find(|bench| bench.id == id)
}
