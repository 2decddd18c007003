//! Start flags: how an instructor presets a bench in the query of its address.
//!
//! `embed=1` hides the header and packs the bench; `panels=valves,zeros` shows only these cards; `lock=valves,gains` disables
//! these controls; `lang=TAG` and `theme=light|dark` choose without being remembered; `preset=NAME` loads a
//! published rig; `bench=NAME` shows that bench. A bench lists its own cards and controls. A flag that is not understood is ignored.

use super::benches::BenchEntry;
use super::session::{Lock, Panel};
use super::texts::Language;
use quadtank::literature::PresetId;

/// What the query asks for.
#[derive(Clone, Default)]
pub struct StartFlags {
    /// The bench to show.
    pub bench: Option<&'static BenchEntry>,
    /// No header, compact.
    pub embed: bool,
    /// The cards to show; empty for all.
    pub panels: Vec<Panel>,
    /// The controls to disable.
    pub locked: Vec<Lock>,
    /// Language to begin with.
    pub language: Option<Language>,
    /// Whether to begin with the dark theme.
    pub dark: Option<bool>,
    /// Rig to begin with.
    pub preset: Option<PresetId>,
}

impl StartFlags {
    /// Reads the query of an address, with or without its question mark, for a page with these benches.
    pub fn parse(query: &str, benches: &'static [BenchEntry]) -> Self {
        let mut flags = Self::default();
        for (name, value) in form_urlencoded::parse(query.trim_start_matches('?').as_bytes()) {
            flags.read(&name, &value, benches);
        }
        flags
    }

    fn read(&mut self, name: &str, value: &str, benches: &'static [BenchEntry]) {
        match name {
            "bench" => self.bench = benches.iter().find(|bench| bench.id == value),
            "embed" => self.embed = value == "1",
            "panels" => {
                let panels = || benches.iter().flat_map(|bench| bench.panels).copied();
                self.panels =
                    value.split(',').filter_map(|name| panels().find(|panel| panel.0 == name.trim())).collect();
            }
            "lock" => {
                let locks = || benches.iter().flat_map(|bench| bench.locks).copied();
                self.locked = value.split(',').filter_map(|name| locks().find(|lock| lock.0 == name.trim())).collect();
            }
            "lang" => self.language = Language::ALL.into_iter().find(|language| language.tag() == value),
            "theme" => {
                self.dark = match value {
                    "light" => Some(false),
                    "dark" => Some(true),
                    _ => None,
                };
            }
            "preset" => self.preset = PresetId::ALL.into_iter().find(|id| id.name() == value),
            _ => {}
        }
    }

    /// Whether a card is shown.
    pub fn shows(&self, panel: Panel) -> bool {
        self.panels.is_empty() || self.panels.contains(&panel)
    }

    /// Whether a group of controls is disabled.
    pub fn locks(&self, lock: Lock) -> bool {
        self.locked.contains(&lock)
    }
}

#[cfg(test)]
mod tests {
    use super::super::benches::BENCHES;
    use super::*;

    fn parse(query: &str) -> StartFlags {
        StartFlags::parse(query, &BENCHES)
    }

    #[test]
    fn flags_are_read_and_unknown_ones_ignored() {
        let flags = parse("?embed=1&panels=valves,zeros,nonsense&lock=gains%2Cpairing&theme=blue&x=1");
        assert!(flags.embed);
        assert_eq!(flags.panels, [Panel("valves"), Panel("zeros")]);
        assert!(flags.shows(Panel("zeros")) && !flags.shows(Panel("rga")));
        assert!(flags.locks(Lock("gains")) && flags.locks(Lock("pairing")) && !flags.locks(Lock("valves")));
        assert_eq!(flags.dark, None);
    }

    #[test]
    fn no_query_shows_everything_and_locks_nothing() {
        let flags = parse("");
        assert!(flags.shows(Panel("process")) && !flags.locks(Lock("preset")) && !flags.embed);
    }

    #[test]
    fn names_that_are_not_known_leave_everything_shown() {
        assert!(parse("panels=nonsense").shows(Panel("process")));
    }

    #[test]
    fn a_preset_and_a_bench_are_found_by_their_names() {
        let flags = parse("preset=johansson-2000-non-minimum-phase&bench=relay-tuning");
        assert_eq!(flags.preset, Some(PresetId::JohanssonNonMinimumPhase));
        assert_eq!(flags.bench.map(|bench| bench.id), Some("relay-tuning"));
    }

    #[test]
    fn the_readme_has_the_names_of_every_bench() {
        let readme = include_str!("../README.md");
        let cell = |names: Vec<&str>| format!("`{}`", names.join("`, `"));
        for bench in &BENCHES {
            let panels = cell(bench.panels.iter().map(|panel| panel.0).collect());
            let locks = cell(bench.locks.iter().map(|lock| lock.0).collect());
            let row = format!("| `{}` | {panels} | {locks} |", bench.id);
            assert!(readme.lines().any(|line| line == row), "README.md lacks the row\n{row}");
        }
    }
}
