use super::{Cell, Pen, Role};

/// A colour in sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub u8, pub u8, pub u8);

impl Rgb {
    /// This colour laid over another one; `share` 0 is the other, 1 this one.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two u8")]
    #[must_use]
    pub fn over(self, other: Self, share: f64) -> Self {
        let share = share.clamp(0.0, 1.0);
        let mix = |a: u8, b: u8| (f64::from(a) * share + f64::from(b) * (1.0 - share)).round() as u8;
        Self(mix(self.0, other.0), mix(self.1, other.1), mix(self.2, other.2))
    }

    /// Relative luminance (WCAG 2.2), 0 to 1.
    pub fn luminance(self) -> f64 {
        let linear = |channel: u8| {
            let c = f64::from(channel) / 255.0;
            if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(self.0) + 0.7152 * linear(self.1) + 0.0722 * linear(self.2)
    }

    /// Contrast ratio of two colours (WCAG 2.2), 1 to 21.
    pub fn contrast(self, other: Self) -> f64 {
        let (a, b) = (self.luminance(), other.luminance());
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }
}

/// The colours of a theme. Text has a contrast of at least 4.5 with the background and with every shade that it is
/// written on; lines have at least 3, trails excepted: they only lie under a mark that has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette {
    /// The card under the chart.
    pub background: Rgb,
    /// Words and numbers that stand out.
    pub text: Rgb,
    /// Tick numbers and axis labels.
    pub muted: Rgb,
    /// Grid lines; only a help, without a contrast of their own.
    pub grid: Rgb,
    /// The edge of the plot.
    pub edge: Rgb,
    /// Loop 1.
    pub loop_1: Rgb,
    /// Loop 2.
    pub loop_2: Rgb,
    /// Minimum phase.
    pub minimum_phase: Rgb,
    /// Right half-plane.
    pub right_half_plane: Rgb,
    /// Poles of the closed loop.
    pub closed_loop: Rgb,
    /// Deepest shade of a field on the minimum-phase side.
    pub minimum_phase_shade: Rgb,
    /// Deepest shade of a field on the side of the right half-plane.
    pub right_half_plane_shade: Rgb,
    /// Deepest shade of a cell. Deeper than those of fields: steps of a twelfth have to be told apart.
    pub cell_shade: Rgb,
}

impl Palette {
    /// On a white card.
    pub const LIGHT: Self = Self {
        background: Rgb(0xff, 0xff, 0xff),
        text: Rgb(0x1e, 0x29, 0x3b),
        muted: Rgb(0x5b, 0x67, 0x7a),
        grid: Rgb(0xe8, 0xec, 0xf1),
        edge: Rgb(0xc4, 0xcc, 0xd8),
        loop_1: Rgb(0x0b, 0x6b, 0xcb),
        loop_2: Rgb(0xc2, 0x41, 0x0c),
        minimum_phase: Rgb(0x0d, 0x80, 0x62),
        right_half_plane: Rgb(0xb9, 0x38, 0x15),
        closed_loop: Rgb(0x4f, 0x55, 0xc8),
        minimum_phase_shade: Rgb(0x8c, 0xcd, 0xb8),
        right_half_plane_shade: Rgb(0xf0, 0xa5, 0x8a),
        cell_shade: Rgb(0x3f, 0xa9, 0x8a),
    };

    /// On a dark card.
    pub const DARK: Self = Self {
        background: Rgb(0x13, 0x1b, 0x2b),
        text: Rgb(0xe6, 0xeb, 0xf3),
        muted: Rgb(0x9a, 0xa7, 0xba),
        grid: Rgb(0x24, 0x2f, 0x43),
        edge: Rgb(0x3b, 0x48, 0x5f),
        loop_1: Rgb(0x4d, 0xa3, 0xf7),
        loop_2: Rgb(0xf2, 0x8a, 0x4f),
        minimum_phase: Rgb(0x3e, 0xc4, 0x9c),
        right_half_plane: Rgb(0xf5, 0x82, 0x66),
        closed_loop: Rgb(0xa5, 0xa8, 0xff),
        minimum_phase_shade: Rgb(0x11, 0x60, 0x50),
        right_half_plane_shade: Rgb(0x80, 0x33, 0x20),
        cell_shade: Rgb(0x18, 0x75, 0x62),
    };

    /// The colour of a role, for lines and marks.
    pub fn color(&self, role: Role) -> Rgb {
        match role {
            Role::Loop1 => self.loop_1,
            Role::Loop2 => self.loop_2,
            Role::MinimumPhase => self.minimum_phase,
            Role::RightHalfPlane => self.right_half_plane,
            Role::ClosedLoop => self.closed_loop,
            Role::Neutral => self.text,
            Role::Muted => self.muted,
        }
    }

    /// The colour of a line.
    pub fn line(&self, role: Role, pen: Pen) -> Rgb {
        match pen {
            Pen::Faded | Pen::Pinned(_) => self.color(role).over(self.background, FADED),
            Pen::Trail => self.color(role).over(self.background, TRAIL),
            Pen::Solid | Pen::Broad | Pen::Dotted | Pen::Dashed | Pen::Hair => self.color(role),
        }
    }

    /// The pale shade of a region.
    pub fn region(&self, role: Role) -> Rgb {
        self.color(role).over(self.background, REGION)
    }

    /// The shade of a field at a value between −1 and 1.
    pub fn shade(&self, value: f64) -> Rgb {
        let deepest = if value < 0.0 { self.minimum_phase_shade } else { self.right_half_plane_shade };
        deepest.over(self.background, value.abs())
    }

    /// What a cell is filled with. The palest differs from the background.
    pub fn cell(&self, cell: Cell) -> Rgb {
        match cell {
            Cell::Empty => self.background,
            Cell::Shade(depth) => {
                self.cell_shade.over(self.background, PALEST + (1.0 - PALEST) * depth.clamp(0.0, 1.0))
            }
            Cell::Hatched => self.shade(RULED_OUT),
        }
    }

    /// The lines of a hatched cell.
    pub fn hatching(&self) -> Rgb {
        self.shade(1.0)
    }
}

/// How much of its colour a faded line keeps.
const FADED: f64 = 0.73;
/// How much of its colour a trail has.
const TRAIL: f64 = 0.35;
/// How much of its colour a region has.
const REGION: f64 = 0.09;
/// How much of the deepest shade the palest cell has.
const PALEST: f64 = 0.1;
/// Shade of what is ruled out.
const RULED_OUT: f64 = 0.35;

#[cfg(test)]
mod tests {
    use super::*;

    const ROLES: [Role; 7] = [
        Role::Loop1,
        Role::Loop2,
        Role::MinimumPhase,
        Role::RightHalfPlane,
        Role::ClosedLoop,
        Role::Neutral,
        Role::Muted,
    ];

    fn each_palette(check: impl Fn(&Palette)) {
        check(&Palette::LIGHT);
        check(&Palette::DARK);
    }

    #[test]
    fn contrast_is_that_of_wcag() {
        assert!((Rgb(0, 0, 0).contrast(Rgb(255, 255, 255)) - 21.0).abs() < 1e-9);
        // #777777 on white is the textbook case just below the limit: 4.48.
        assert!((Rgb(0x77, 0x77, 0x77).contrast(Rgb(255, 255, 255)) - 4.48).abs() < 0.005);
    }

    #[test]
    fn text_can_be_read() {
        each_palette(|palette| {
            for role in ROLES {
                let contrast = palette.color(role).contrast(palette.background);
                assert!(contrast >= 4.5, "{role:?} on the card: {contrast}");
                let contrast = palette.text.contrast(palette.region(role));
                assert!(contrast >= 4.5, "text on the region {role:?}: {contrast}");
            }
            for cell in (0..=10).map(|k| Cell::Shade(f64::from(k) / 10.0)).chain([Cell::Hatched]) {
                let contrast = palette.text.contrast(palette.cell(cell));
                assert!(contrast >= 4.5, "text on {cell:?}: {contrast}");
            }
            assert!(palette.text.contrast(palette.hatching()) >= 4.5);
            for shade in [-1.0, -0.5, 0.5, 1.0] {
                let contrast = palette.text.contrast(palette.shade(shade));
                assert!(contrast >= 4.5, "text on shade {shade}: {contrast}");
            }
        });
    }

    #[test]
    fn lines_and_marks_can_be_seen() {
        each_palette(|palette| {
            for role in ROLES {
                for pen in [Pen::Solid, Pen::Dotted, Pen::Dashed, Pen::Faded, Pen::Pinned(1), Pen::Hair] {
                    let contrast = palette.line(role, pen).contrast(palette.background);
                    assert!(contrast >= 3.0, "{role:?} {pen:?}: {contrast}");
                }
            }
        });
    }
}
