use super::chart::{Anchor, Label, Layer, Pen, Role};

/// Distance of a word from the foot of its line, for each flag before it (CSS px).
const RISE: f64 = 16.0;
/// Flags beside each other before they begin at the foot again.
const ROWS: usize = 4;
/// About how wide a word is, as a part of the window.
const WORD: f64 = 0.25;

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

/// The lines of the flags inside `window`, and then their words, which no line strikes through; `foot` is where the words stand, in the
/// units of the axis. Each word is higher than the one before it, so that those of one moment can be read, and stands on the side of its
/// line where no other line comes close, if there is one.
pub fn flags<'a>(flags: &[Flag], foot: f64, (from, to): (f64, f64)) -> impl Iterator<Item = Layer<'a>> {
    let word = WORD * (to - from);
    let shown: Vec<Flag> = flags.iter().filter(|flag| (from..=to).contains(&flag.time_s)).cloned().collect();
    let times: Vec<f64> = shown.iter().map(|flag| flag.time_s).collect();
    let lines: Vec<Layer> =
        shown.iter().map(|flag| Layer::Upright { x: flag.time_s, role: flag.role, pen: Pen::Hair }).collect();
    let words = shown.into_iter().enumerate().map(move |(k, flag)| {
        let strikes_right = times.iter().any(|other| *other > flag.time_s && other - flag.time_s < word);
        let has_room_left = flag.time_s > from + word;
        let is_late = flag.time_s > from + 0.7 * (to - from) || (strikes_right && has_room_left);
        Layer::Label(Label {
            at: (flag.time_s, foot),
            offset: (if is_late { -6.0 } else { 6.0 }, -RISE * (k % ROWS) as f64),
            anchor: if is_late { Anchor::Right } else { Anchor::Left },
            text: flag.text,
            role: flag.role,
            bold: false,
            on_ground: true,
            opposite: None,
        })
    });
    lines.into_iter().chain(words)
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

    #[test]
    fn a_word_stands_where_the_next_line_does_not_strike_it_through() {
        let all = [5.0, 5.5, 6.0].map(|time_s| Flag { time_s, text: "full".to_owned(), role: Role::RightHalfPlane });
        let anchors: Vec<_> = flags(&all, 3.0, (0.0, 10.0))
            .filter_map(|layer| match layer {
                Layer::Label(label) => Some(label.anchor),
                _ => None,
            })
            .collect();
        assert_eq!(anchors, [Anchor::Right, Anchor::Right, Anchor::Left]);
    }
}
