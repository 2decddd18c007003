//! How much of a bench is shown at once: from one picture and three things to try up to every card.

use super::start::StartFlags;

/// How much of a bench is shown at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// The rig, its levels, and three things to try: for the first visit.
    Explore,
    /// Rig, response, valves, zeros, relative gains, controller.
    Lab,
    /// Every card.
    Full,
}

impl Depth {
    /// All of them, from less to more.
    pub const ALL: [Self; 3] = [Self::Explore, Self::Lab, Self::Full];

    /// Its name in an address and in what the browser remembers.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Explore => "explore",
            Self::Lab => "lab",
            Self::Full => "full",
        }
    }

    /// The one with this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|depth| depth.name() == name)
    }

    /// What a page begins with. Frames of course pages, and addresses and links that were made before there was a choice, show what
    /// they showed then; a visitor gets what was chosen last, and a new one the simplest.
    pub fn at_start(flags: &StartFlags, has_link: bool, remembered: Option<&str>) -> Self {
        let is_prepared = !flags.panels.is_empty() || !flags.locked.is_empty() || flags.preset.is_some();
        let as_before = flags.embed || is_prepared || has_link;
        let usual = || if as_before { Self::Full } else { remembered.and_then(Self::of_name).unwrap_or(Self::Explore) };
        flags.view.unwrap_or_else(usual)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::benches::BENCHES;

    fn at_start(query: &str, has_link: bool, remembered: Option<&str>) -> Depth {
        Depth::at_start(&StartFlags::parse(query, &BENCHES), has_link, remembered)
    }

    #[test]
    fn a_first_visit_explores_and_a_later_one_shows_what_was_chosen() {
        assert_eq!(at_start("", false, None), Depth::Explore);
        assert_eq!(at_start("lang=en", false, Some("lab")), Depth::Lab);
        assert_eq!(at_start("", false, Some("nonsense")), Depth::Explore);
    }

    #[test]
    fn links_and_frames_of_before_show_every_card_and_new_ones_say_which() {
        assert_eq!(at_start("", true, Some("explore")), Depth::Full);
        assert_eq!(at_start("embed=1", false, Some("lab")), Depth::Full);
        for prepared in ["panels=valves", "lock=gains", "preset=johansson-2000-minimum-phase"] {
            assert_eq!(at_start(prepared, false, None), Depth::Full, "{prepared}");
        }
        assert_eq!(at_start("view=lab", true, Some("full")), Depth::Lab);
        assert_eq!(at_start("embed=1&view=explore", false, None), Depth::Explore);
    }
}
