//! Start flags: how an instructor presets a bench in the query of its address.
//!
//! `embed=1` hides the header and packs the bench; `panels=valves,zeros` shows only these cards; `lock=valves,gains` disables
//! these controls; `lang=TAG` and `theme=light|dark` choose without being remembered; `preset=NAME` loads a
//! published rig; `bench=NAME` shows that bench; `lesson=ID`, or the path of a file beside the page, and `step=N` begin a lesson; `page=lessons`, `glossary` or `teachers` shows that page; `origins=https://…` names the pages around a frame
//! that may talk with it, and `grows=1` says that such a page follows the height of the content; `scale=1.5` makes a page larger, as for a projector;
//! `view=explore`, `lab` or `full` says how much of it. A bench lists its own cards and controls. What is not
//! understood has no effect, and the page names it.

use std::ops::RangeInclusive;

use super::benches::BenchEntry;
use super::depth::Depth;
use super::lessons::SidePage;
use super::session::{Lock, Panel};
use super::texts::Language;
use quadtank::literature::PresetId;

/// Most names that are told of what was not understood, and the longest of them (characters).
const MAX_UNKNOWN: usize = 6;
const LONGEST_UNKNOWN: usize = 40;

/// How large a page can be asked for: below 1 no text would be legible.
const SCALES: RangeInclusive<f64> = 1.0..=4.0;

/// Parameters that mail systems, social networks and analytics add to any link that they pass on. Neither who made the link nor
/// who follows it can do anything about them, so they are tolerated. Everything else may be a misspelt flag.
const TRACKING: [&str; 12] = [
    "dclid", "fbclid", "gbraid", "gclid", "igsh", "igshid", "msclkid", "srsltid", "ttclid", "twclid", "wbraid", "yclid",
];
/// The same by how their names begin; an underscore is that of the linkers of several analytics (`_ga`, `_gl`, `_hsenc`).
const TRACKING_FAMILIES: [&str; 4] = ["utm_", "mc_", "gad_", "_"];

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
    /// How much of the bench to show.
    pub view: Option<Depth>,
    /// Whether to begin with the dark theme.
    pub dark: Option<bool>,
    /// Rig to begin with.
    pub preset: Option<PresetId>,
    /// The lesson to begin: its id, or the path of its file.
    pub lesson: Option<String>,
    /// Its step, from 0.
    pub step: Option<usize>,
    /// The page to show in place of a bench.
    pub page: Option<SidePage>,
    /// The origins of pages that may hear and say something, see [`messages`](super::messages).
    pub origins: Vec<String>,
    /// Whether the embedding page sets the height of the frame by messages.
    pub grows: bool,
    /// Magnification of the page; `None` for the usual size.
    pub scale: Option<f64>,
    /// What was not understood, fit to be shown.
    pub unknown: Vec<String>,
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
        let is_understood = match name {
            "bench" => {
                self.bench = benches.iter().find(|bench| bench.id == value);
                self.bench.is_some()
            }
            "embed" => {
                self.embed = value == "1";
                matches!(value, "0" | "1")
            }
            "panels" => {
                let named = |name: &str| benches.iter().flat_map(|bench| bench.panels).find(|panel| panel.0 == name);
                self.panels = self.chosen("panels", value, named);
                true
            }
            "lock" => {
                let named = |name: &str| benches.iter().flat_map(|bench| bench.locks).find(|lock| lock.0 == name);
                self.locked = self.chosen("lock", value, named);
                true
            }
            "lang" => {
                self.language = Language::spoken(value);
                self.language.is_some()
            }
            "theme" => {
                self.dark = match value {
                    "light" => Some(false),
                    "dark" => Some(true),
                    _ => None,
                };
                self.dark.is_some()
            }
            "view" => {
                self.view = Depth::of_name(value);
                self.view.is_some()
            }
            "lesson" => {
                self.lesson = Some(value.to_owned()).filter(|id| !id.is_empty());
                self.lesson.is_some()
            }
            "step" => {
                self.step = value.parse::<usize>().ok().and_then(|step| step.checked_sub(1));
                self.step.is_some()
            }
            "origins" => {
                self.origins =
                    value.split(',').map(str::trim).filter(|origin| !origin.is_empty()).map(str::to_owned).collect();
                self.origins.iter().all(|origin| origin.starts_with("https://") || origin.starts_with("http://"))
            }
            "grows" => {
                self.grows = value == "1";
                matches!(value, "0" | "1")
            }
            "scale" => {
                self.scale = value.parse().ok().filter(|scale| SCALES.contains(scale));
                self.scale.is_some()
            }
            "page" => {
                self.page = SidePage::of_name(value);
                self.page.is_some()
            }
            "preset" => {
                self.preset = PresetId::ALL.into_iter().find(|id| id.name() == value);
                self.preset.is_some()
            }
            _ => is_tracking(name),
        };
        if !is_understood {
            self.note_unknown(name, value);
        }
    }

    /// The items that a list names, separated by commas.
    fn chosen<T: Copy + 'static>(
        &mut self,
        flag: &str,
        list: &str,
        named: impl Fn(&str) -> Option<&'static T>,
    ) -> Vec<T> {
        let mut chosen = Vec::new();
        for name in list.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            match named(name) {
                Some(&item) => chosen.push(item),
                None => self.note_unknown(flag, name),
            }
        }
        chosen
    }

    fn note_unknown(&mut self, flag: &str, value: &str) {
        let separator = if value.is_empty() { "" } else { "=" };
        match self.unknown.len() {
            0..MAX_UNKNOWN => self.unknown.push(shown(&format!("{flag}{separator}{value}"))),
            MAX_UNKNOWN => self.unknown.push("…".to_owned()),
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

fn is_tracking(name: &str) -> bool {
    TRACKING.contains(&name) || TRACKING_FAMILIES.iter().any(|family| name.starts_with(family))
}

/// A piece of the query as it may stand in a sentence: short, and without what acts on the text around it (line breaks, marks
/// of direction, characters without width), which Rust writes as an escape.
fn shown(text: &str) -> String {
    let is_plain = |&c: &char| matches!(c, '"' | '\'' | '\\') || c.escape_debug().len() == 1;
    let mut characters = text.chars().map(|c| if is_plain(&c) { c } else { char::REPLACEMENT_CHARACTER });
    let mut shown: String = characters.by_ref().take(LONGEST_UNKNOWN).collect();
    if characters.next().is_some() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::super::benches::BENCHES;
    use super::*;

    fn parse(query: &str) -> StartFlags {
        StartFlags::parse(query, &BENCHES)
    }

    #[test]
    fn flags_are_read() {
        let flags = parse("?embed=1&panels=valves,zeros&lock=gains%2Cpairing&theme=dark&lang=pt-BR");
        assert!(flags.embed);
        assert_eq!(flags.panels, [Panel("valves"), Panel("zeros")]);
        assert!(flags.shows(Panel("zeros")) && !flags.shows(Panel("rga")));
        assert!(flags.locks(Lock("gains")) && flags.locks(Lock("pairing")) && !flags.locks(Lock("valves")));
        assert_eq!((flags.dark, flags.language.map(Language::tag)), (Some(true), Some("pt-BR")));
        assert_eq!(flags.unknown, [""; 0]);
    }

    #[test]
    fn what_is_not_understood_is_named() {
        let flags = parse("?pannels=valves&panels=valves,zeos&lock=gain&lang=xx&theme=blue&embed");
        assert_eq!(flags.unknown, ["pannels=valves", "panels=zeos", "lock=gain", "lang=xx", "theme=blue", "embed"]);
        assert_eq!(flags.panels, [Panel("valves")]);
        assert_eq!(parse("preset=none&bench=other").unknown, ["preset=none", "bench=other"]);
        assert_eq!(parse("panels=&lock=gains,&embed=0&").unknown, [""; 0]);
    }

    #[test]
    fn what_other_systems_add_to_a_link_is_tolerated() {
        assert_eq!(parse("utm_source=mail&fbclid=x&gclid=y&_ga=1.2&mc_cid=3").unknown, [""; 0]);
    }

    #[test]
    fn names_of_what_is_not_understood_are_few_short_and_harmless() {
        let flags = parse(&format!("<b>=%0A%00%E2%80%AE\u{200b}\"&{}&{}", "x".repeat(500), "y=1&".repeat(1000)));
        assert_eq!(flags.unknown.len(), MAX_UNKNOWN + 1);
        assert_eq!(flags.unknown[0], "<b>=\u{fffd}\u{fffd}\u{fffd}\u{fffd}\"");
        assert_eq!(flags.unknown[1], "x".repeat(LONGEST_UNKNOWN) + "…");
        assert_eq!(flags.unknown.last().map(String::as_str), Some("…"));
        assert_eq!(parse("%FF%C3").unknown, ["\u{fffd}\u{fffd}"]);
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
    fn a_page_is_as_large_as_usual_or_larger() {
        assert_eq!((parse("scale=1.5").scale, parse("grows=1").grows), (Some(1.5), true));
        let flags = parse("scale=0.5&scale=9&scale=NaN&scale=large&grows=yes");
        assert_eq!(flags.unknown, ["scale=0.5", "scale=9", "scale=NaN", "scale=large", "grows=yes"]);
        assert_eq!(flags.scale, None);
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
