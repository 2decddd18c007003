use serde::{Deserialize, Serialize};

use super::LevelError;
use super::error::within;

/// Unit of a signal between instruments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SignalUnit {
    /// Milliampere.
    Milliampere,
    /// Pound-force per square inch.
    Psi,
}

/// Range of a signal, in its unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SignalRange {
    /// Lower end.
    pub low: f64,
    /// Upper end, above the lower one.
    pub high: f64,
    /// Unit of both.
    pub unit: SignalUnit,
}

impl SignalRange {
    /// 4 to 20 mA.
    pub const CURRENT: Self = Self { low: 4.0, high: 20.0, unit: SignalUnit::Milliampere };
    /// 3 to 15 psi.
    pub const PNEUMATIC: Self = Self { low: 3.0, high: 15.0, unit: SignalUnit::Psi };
    /// 0 to 15 psi, the range of the lecture slides.
    pub const PNEUMATIC_FROM_ZERO: Self = Self { low: 0.0, high: 15.0, unit: SignalUnit::Psi };

    /// Width of the range.
    pub fn span(&self) -> f64 {
        self.high - self.low
    }

    /// The signal as a share of its range.
    pub fn share(&self, signal: f64) -> f64 {
        (signal - self.low) / self.span()
    }

    /// The signal within its range.
    #[inline]
    pub fn clip(&self, signal: f64) -> f64 {
        signal.max(self.low).min(self.high)
    }

    fn check(&self, field: &'static str) -> Result<(), LevelError> {
        within(field, self.low, -f64::MAX, f64::MAX)?;
        within(field, self.high, f64::MIN_POSITIVE, f64::MAX)?;
        within(field, self.span(), f64::MIN_POSITIVE, f64::MAX)
    }
}

/// A level transmitter: range, lag, and a signal that may end at its range (Andreis 2017, Eqs. 71 to 73).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Transmitter {
    /// Levels (m) at the lower and upper end of the signal.
    pub level_range: [f64; 2],
    /// The signal.
    pub signal: SignalRange,
    /// Time constant (s); 0 for a transmitter that follows at once.
    pub lag_s: f64,
    /// Whether the signal ends at its range.
    pub clips: bool,
}

impl Transmitter {
    /// Gain `K_t`, signal per metre.
    pub fn gain(&self) -> f64 {
        self.signal.span() / (self.level_range[1] - self.level_range[0])
    }

    /// Signal of a level at rest, before it is clipped.
    #[inline]
    pub fn signal_of(&self, level: f64) -> f64 {
        self.signal.low + self.gain() * (level - self.level_range[0])
    }

    /// Level of a signal (m), the inverse of [`signal_of`](Self::signal_of).
    pub fn level_of(&self, signal: f64) -> f64 {
        self.level_range[0] + (signal - self.signal.low) / self.gain()
    }

    /// The signal that leaves the transmitter, clipped where it clips.
    #[inline]
    pub fn sent(&self, signal: f64) -> f64 {
        if self.clips { self.signal.clip(signal) } else { signal }
    }

    pub(super) fn check(&self) -> Result<(), LevelError> {
        let [low, high] = self.level_range;
        within("level_range", low, -f64::MAX, f64::MAX)?;
        within("level_range", high, -f64::MAX, f64::MAX)?;
        within("level_range", high - low, f64::MIN_POSITIVE, f64::MAX)?;
        within("lag_s", self.lag_s, 0.0, f64::MAX)?;
        self.signal.check("transmitter.signal")
    }
}

/// The output of the controller, which may end at its range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OutputStage {
    /// The signal.
    pub signal: SignalRange,
    /// Whether the signal ends at its range.
    pub clips: bool,
}

impl OutputStage {
    /// The signal that leaves the controller, clipped where it clips.
    #[inline]
    pub fn sent(&self, signal: f64) -> f64 {
        if self.clips { self.signal.clip(signal) } else { signal }
    }

    pub(super) fn check(&self) -> Result<(), LevelError> {
        self.signal.check("output.signal")
    }
}

/// A linear converter such as I/P, from one range to another: `p = 0.75 m` from 4–20 mA to 3–15 psi (Andreis 2017, Eqs. 76 to 78).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Converter {
    /// Range of what goes in.
    pub input: SignalRange,
    /// Range of what comes out.
    pub output: SignalRange,
}

impl Converter {
    /// Output per unit of input.
    pub fn gain(&self) -> f64 {
        self.output.span() / self.input.span()
    }

    /// Output for an input.
    #[inline]
    pub fn convert(&self, signal: f64) -> f64 {
        self.output.low + self.gain() * (signal - self.input.low)
    }

    /// Input for an output.
    pub fn invert(&self, signal: f64) -> f64 {
        self.input.low + (signal - self.output.low) / self.gain()
    }

    pub(super) fn check(&self) -> Result<(), LevelError> {
        self.input.check("converter.input")?;
        self.output.check("converter.output")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_shares_and_clips() {
        let range = SignalRange::CURRENT;
        assert_eq!(range.share(8.0), 0.25);
        assert_eq!([3.0, 11.0, 21.0].map(|signal| range.clip(signal)), [4.0, 11.0, 20.0]);
        let open = OutputStage { signal: range, clips: false };
        assert_eq!((open.sent(21.0), OutputStage { clips: true, ..open }.sent(21.0)), (21.0, 20.0));
    }

    #[test]
    fn a_converter_inverts_and_a_transmitter_measures() {
        let converter = Converter { input: SignalRange::CURRENT, output: SignalRange::PNEUMATIC };
        assert_eq!((converter.gain(), converter.convert(12.0), converter.invert(9.0)), (0.75, 9.0, 12.0));
        let transmitter =
            Transmitter { level_range: [0.5, 2.5], signal: SignalRange::CURRENT, lag_s: 0.0, clips: true };
        assert_eq!((transmitter.signal_of(1.5), transmitter.level_of(12.0)), (12.0, 1.5));
        assert_eq!((transmitter.signal_of(3.0), transmitter.sent(24.0)), (24.0, 20.0));
    }

    #[test]
    fn ranges_without_width_are_refused() {
        let stage = |low, high| OutputStage { signal: SignalRange { low, high, unit: SignalUnit::Psi }, clips: true };
        assert_eq!(stage(3.0, 15.0).check(), Ok(()));
        assert!(stage(3.0, 3.0).check().is_err() && stage(15.0, 3.0).check().is_err());
        assert!(stage(f64::NAN, 3.0).check().is_err() && stage(0.0, f64::INFINITY).check().is_err());
    }
}
