//! Start flags: how an instructor presets a bench in the query of its address.
//!
//! `embed=1` hides the header and packs the bench; `panels=valves,zeros` shows only these; `lock=valves,gains` disables
//! these controls; `lang=TAG` and `theme=light|dark` choose without being remembered; `preset=NAME` loads a
//! published rig; `bench=relay-tuning` or `bench=model-free` shows that bench; `view=explore`, `lab` or `full` says how much of it. A flag that is not understood is ignored.

use super::depth::Depth;
use super::texts::Language;
use quadtank::literature::PresetId;

/// A card of a bench.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Panel {
    /// The drawing of the rig.
    Process,
    /// The valve plane.
    Valves,
    /// Poles and zeros.
    Zeros,
    /// The relative gain array.
    Rga,
    /// The decentralised controller.
    Controller,
    /// The experiment.
    Experiment,
    /// The interpolation constraint.
    Why,
    /// The responses.
    Responses,
    /// The plant of the relay-tuning bench and its published cases.
    Plant,
    /// The relay test.
    Test,
    /// The critical curve.
    Curve,
    /// The characteristic loci with their target.
    Placement,
    /// What the paper on model-free control claims.
    Claims,
}

const PANELS: [(&str, Panel); 13] = [
    ("process", Panel::Process),
    ("valves", Panel::Valves),
    ("zeros", Panel::Zeros),
    ("rga", Panel::Rga),
    ("controller", Panel::Controller),
    ("experiment", Panel::Experiment),
    ("why", Panel::Why),
    ("responses", Panel::Responses),
    ("plant", Panel::Plant),
    ("test", Panel::Test),
    ("curve", Panel::Curve),
    ("placement", Panel::Placement),
    ("claims", Panel::Claims),
];

/// A group of controls that can be disabled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The choice of the rig.
    Preset,
    /// γ1 and γ2.
    Valves,
    /// The operating point.
    Voltages,
    /// Which pump each loop drives.
    Pairing,
    /// K and Ti.
    Gains,
    /// The rest of the controller.
    Sampling,
    /// The experiment.
    Experiment,
    /// The plant that is tuned, with the published cases.
    Plant,
    /// The relay test.
    Test,
    /// The critical point.
    Point,
    /// The target of the placement, method, action and root.
    Target,
}

const CONTROLS: [(&str, Control); 11] = [
    ("preset", Control::Preset),
    ("valves", Control::Valves),
    ("voltages", Control::Voltages),
    ("pairing", Control::Pairing),
    ("gains", Control::Gains),
    ("sampling", Control::Sampling),
    ("experiment", Control::Experiment),
    ("plant", Control::Plant),
    ("test", Control::Test),
    ("point", Control::Point),
    ("target", Control::Target),
];

/// What the query asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StartFlags {
    /// The bench to show, by its name.
    pub bench: Option<String>,
    /// No header, compact.
    pub embed: bool,
    /// The cards to show; empty for all.
    pub panels: Vec<Panel>,
    /// The controls to disable.
    pub locked: Vec<Control>,
    /// Language to begin with.
    pub language: Option<Language>,
    /// `light` or `dark`.
    pub theme: Option<String>,
    /// How much of the bench to show.
    pub view: Option<Depth>,
    /// Rig to begin with.
    pub preset: Option<PresetId>,
}

impl StartFlags {
    /// Reads the query of an address, with or without its question mark; percent escapes of commas are understood.
    pub fn parse(query: &str) -> Self {
        let mut flags = Self::default();
        for pair in query.trim_start_matches('?').split('&') {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            let value = value.replace("%2C", ",").replace("%2c", ",");
            match name {
                "bench" => flags.bench = Some(value),
                "embed" => flags.embed = value == "1",
                "panels" => flags.panels = chosen(&value, &PANELS),
                "lock" => flags.locked = chosen(&value, &CONTROLS),
                "lang" => flags.language = Language::ALL.into_iter().find(|language| language.tag() == value),
                "theme" => flags.theme = Some(value).filter(|t| t == "light" || t == "dark"),
                "view" => flags.view = Depth::of_name(&value),
                "preset" => flags.preset = PresetId::ALL.into_iter().find(|id| id.name() == value),
                _ => {}
            }
        }
        flags
    }

    /// Whether a card is shown.
    pub fn shows(&self, panel: Panel) -> bool {
        self.panels.is_empty() || self.panels.contains(&panel)
    }

    /// Whether a group of controls is disabled.
    pub fn locks(&self, control: Control) -> bool {
        self.locked.contains(&control)
    }
}

fn chosen<T: Copy>(list: &str, known: &[(&str, T)]) -> Vec<T> {
    list.split(',').filter_map(|name| known.iter().find(|(n, _)| *n == name.trim()).map(|&(_, item)| item)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_read_and_unknown_ones_ignored() {
        let flags = StartFlags::parse("?embed=1&panels=valves,zeros,nonsense&lock=gains%2Cpairing&theme=blue&x=1");
        assert!(flags.embed);
        assert_eq!(flags.panels, [Panel::Valves, Panel::Zeros]);
        assert!(flags.shows(Panel::Zeros) && !flags.shows(Panel::Rga));
        assert!(flags.locks(Control::Gains) && flags.locks(Control::Pairing) && !flags.locks(Control::Valves));
        assert_eq!(flags.theme, None);
    }

    #[test]
    fn no_query_shows_everything_and_locks_nothing() {
        let flags = StartFlags::parse("");
        assert!(flags.shows(Panel::Process) && !flags.locks(Control::Preset) && !flags.embed);
    }

    #[test]
    fn a_preset_is_found_by_its_name() {
        let flags = StartFlags::parse("preset=johansson-2000-non-minimum-phase");
        assert_eq!(flags.preset, Some(PresetId::JohanssonNonMinimumPhase));
    }
}
