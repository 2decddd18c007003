use quadtank::sim::ReferenceStepResponse;

use super::chart::{Anchor, Label, Layer, Role};
use super::responses::RunColumns;

/// Half the width of the band in which a level counts as settled, as a share of the step.
const BAND: f64 = 0.02;
/// Distance of the word of an overshoot from its highest point (CSS px).
const RISE: f64 = 11.0;

/// A reference step whose response has metrics. Its settling band is shaded, and its overshoot is labelled at the peak.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedStep {
    /// Index of the level, 0 or 1.
    pub level: usize,
    /// Time of the step, and end of the window of its metrics (s).
    pub window_s: (f64, f64),
    /// The reference before and after the step (m).
    pub reference: (f64, f64),
    /// Label of the overshoot; empty for none.
    pub overshoot: String,
}

impl JudgedStep {
    /// The steps that have metrics. `overshoot` makes the label from the overshoot as a share of the step; an overshoot within the
    /// settling band has no label.
    pub fn all(steps: &[ReferenceStepResponse], overshoot: impl Fn(f64) -> String) -> Vec<Self> {
        let judged = |step: &ReferenceStepResponse| {
            let figures = &step.figures;
            let length = figures.window_s.filter(|_| figures.no_response.is_none())?;
            let share = figures.overshoot.filter(|&share| share > BAND);
            Some(Self {
                level: step.level,
                window_s: (step.time_s, step.time_s + length),
                reference: (step.from, step.to),
                overshoot: share.map(&overshoot).unwrap_or_default(),
            })
        };
        steps.iter().filter_map(judged).collect()
    }

    /// The settling band; `scale` is the shown unit in a metre.
    pub(super) fn band(&self, scale: f64) -> Layer<'static> {
        let (from, to) = self.reference;
        let half = BAND * (to - from).abs();
        Layer::Region {
            x: self.window_s,
            y: (scale * (to - half), scale * (to + half)),
            role: Role::of_loop(self.level),
        }
    }

    /// The label of the overshoot at the peak; `None` without an overshoot.
    pub(super) fn word(&self, run: &RunColumns<'_>, scale: f64) -> Option<Layer<'static>> {
        let (begin, end) = self.window_s;
        let sign = (self.reference.1 - self.reference.0).signum();
        let rows = run.time_s.iter().zip(run.levels[self.level]).filter(|(time, _)| (begin..=end).contains(*time));
        let (&time, &level) = rows.max_by(|(_, one), (_, other)| (sign * **one).total_cmp(&(sign * **other)))?;
        (!self.overshoot.is_empty()).then(|| {
            Layer::Label(Label {
                at: (time, scale * level),
                offset: (0.0, -sign * RISE),
                anchor: Anchor::Middle,
                text: self.overshoot.clone(),
                role: Role::of_loop(self.level),
                bold: false,
                on_ground: true,
                opposite: None,
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_lies_about_the_new_reference_and_the_word_at_the_extreme() {
        let step = JudgedStep {
            level: 1,
            window_s: (1.0, 5.0),
            reference: (0.2, 0.1),
            overshoot: "overshoot 30 %".to_owned(),
        };
        let Layer::Region { x, y: (low, high), role } = step.band(100.0) else { unreachable!("a band is a region") };
        assert_eq!((x, role), ((1.0, 5.0), Role::Loop2));
        assert!((low - 9.8).abs() < 1e-12 && (high - 10.2).abs() < 1e-12, "{low} to {high}");
        let level = [0.01, 0.2, 0.07, 0.1, 0.1, 0.02];
        let run = RunColumns { time_s: &[0.0, 1.0, 2.0, 3.0, 4.0, 6.0], levels: [&[], &level], voltages: [&[], &[]] };
        let Some(Layer::Label(label)) = step.word(&run, 100.0) else { unreachable!("an overshoot has a word") };
        assert_eq!((label.at, label.offset), ((2.0, 7.000_000_000_000_001), (0.0, RISE)));
        assert_eq!(JudgedStep { overshoot: String::new(), ..step }.word(&run, 100.0), None);
    }
}
