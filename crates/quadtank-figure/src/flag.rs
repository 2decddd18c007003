use super::chart::{Anchor, Label, Layer, Pen, Role};

/// Distance of a word from the foot of its line, for each flag before it (CSS px).
const RISE: f64 = 16.0;
/// Flags beside each other before they begin at the foot again.
const ROWS: usize = 4;

/// Something that happened at a time: an upright line with a word at its foot.
#[derive(Clone, Debug, PartialEq)]
pub struct Flag {
    /// When (s).
    pub time_s: f64,
    /// What.
    pub text: String,
    /// Of what.
    pub role: Role,
}

/// The lines and words of the flags inside `window`; `foot` is where the words stand, in the units of the axis. Each word is
/// higher than the one before it, so that those of one moment can be read.
pub fn flags<'a>(flags: &[Flag], foot: f64, (from, to): (f64, f64)) -> impl Iterator<Item = Layer<'a>> {
    let shown = flags.iter().filter(move |flag| (from..=to).contains(&flag.time_s)).enumerate();
    shown.flat_map(move |(k, flag)| {
        let is_late = flag.time_s > from + 0.7 * (to - from);
        [
            Layer::Upright { x: flag.time_s, role: flag.role, pen: Pen::Hair },
            Layer::Label(Label {
                at: (flag.time_s, foot),
                offset: (if is_late { -6.0 } else { 6.0 }, -RISE * (k % ROWS) as f64),
                anchor: if is_late { Anchor::Right } else { Anchor::Left },
                text: flag.text.clone(),
                role: flag.role,
                bold: false,
            }),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_of_the_window_have_words_above_each_other() {
        let flag = |time_s| Flag { time_s, text: "full".to_owned(), role: Role::RightHalfPlane };
        let all = [flag(1.0), flag(2.0), flag(9.5), flag(20.0)];
        let layers: Vec<_> = flags(&all, 3.0, (0.0, 10.0)).collect();
        let labels = layers.iter().filter_map(|layer| match layer {
            Layer::Label(label) => Some((label.at, label.offset, label.anchor)),
            _ => None,
        });
        let expected = [
            ((1.0, 3.0), (6.0, 0.0), Anchor::Left),
            ((2.0, 3.0), (6.0, -RISE), Anchor::Left),
            ((9.5, 3.0), (-6.0, -2.0 * RISE), Anchor::Right),
        ];
        assert_eq!(labels.collect::<Vec<_>>(), expected);
        assert_eq!(layers.iter().filter(|layer| matches!(layer, Layer::Upright { .. })).count(), 3);
    }
}
