//! Pseudo-random binary sequences that move pumps for identification.

use super::experiment::PumpVoltageStep;

/// Bits of the shift register: the sequence repeats itself after 2⁷ − 1 = 127 bits.
const BITS: u32 = 7;

/// A pseudo-random binary sequence of maximum length, by a shift register with the feedback x⁷ + x⁶ + 1 (Ljung 1999, §13.3).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BinarySequence {
    register: u32,
}

impl BinarySequence {
    /// Bits until it repeats itself.
    pub const PERIOD: usize = (1 << BITS) - 1;

    /// The sequence from its bit `shift` on.
    pub fn from_bit(shift: usize) -> Self {
        let mut sequence = Self { register: 1 };
        (0..shift % Self::PERIOD).for_each(|_| {
            sequence.next_bit();
        });
        sequence
    }

    fn next_bit(&mut self) -> bool {
        let bit = (self.register >> (BITS - 1) ^ self.register >> (BITS - 2)) & 1;
        self.register = (self.register << 1 | bit) & ((1 << BITS) - 1);
        bit == 1
    }
}

impl Iterator for BinarySequence {
    type Item = bool;

    fn next(&mut self) -> Option<bool> {
        Some(self.next_bit())
    }
}

/// Moves of both pumps between `low` and `high` (V, by pump) for a whole experiment of `duration_s` (s). Every bit holds for `clock_s`
/// (s). Pump 2 has the same sequence half a period later, so that both can be told apart in the levels: over a period they are
/// uncorrelated to 1 in 127.
pub fn binary_moves(low: [f64; 2], high: [f64; 2], clock_s: f64, duration_s: f64) -> Vec<PumpVoltageStep> {
    let moves_of = |pump: usize| {
        let mut last = None;
        let bits = (0..).map(f64::from).zip(BinarySequence::from_bit(pump * BinarySequence::PERIOD / 2));
        let within = bits
            .map(move |(bit, is_high)| (bit * clock_s, is_high))
            .take_while(move |&(time_s, _)| time_s < duration_s);
        within.filter_map(move |(time_s, is_high)| {
            let voltage = if is_high { high[pump] } else { low[pump] };
            (last.replace(is_high) != Some(is_high)).then_some(PumpVoltageStep { pump, time_s, voltage })
        })
    };
    moves_of(0).chain(moves_of(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signs(shift: usize) -> Vec<i32> {
        BinarySequence::from_bit(shift).take(BinarySequence::PERIOD).map(|bit| if bit { 1 } else { -1 }).collect()
    }

    #[test]
    fn the_autocorrelation_is_that_of_a_maximum_length_sequence() {
        let first = signs(0);
        assert_eq!(first.iter().sum::<i32>(), 1);
        for shift in 1..BinarySequence::PERIOD {
            let product: i32 = first.iter().zip(signs(shift)).map(|(one, other)| one * other).sum();
            assert_eq!(product, -1, "{shift}");
        }
        assert_eq!(signs(BinarySequence::PERIOD), first);
    }

    #[test]
    fn pumps_move_at_the_clock_and_only_where_the_bit_changes() {
        let moves = binary_moves([2.0, 3.0], [4.0, 5.0], 10.0, 600.0);
        for pump in [0, 1] {
            let own: Vec<_> = moves.iter().filter(|step| step.pump == pump).collect();
            assert_eq!(own[0].time_s, 0.0);
            assert!(own.windows(2).all(|pair| pair[0].voltage != pair[1].voltage && pair[0].time_s < pair[1].time_s));
            assert!(own.iter().all(|step| step.time_s % 10.0 == 0.0 && step.time_s < 600.0));
            assert!(own.len() > 20, "{}", own.len());
        }
        assert!(binary_moves([1.0; 2], [2.0; 2], 10.0, 0.0).is_empty());
    }
}
