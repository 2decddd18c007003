//! Text as its differences from a text that both sides know.
//!
//! A packed text is a string of half bytes. 0 to 12 stand for one of [`SMALL`], as numbers are most of what differs;
//! [`COPY`] repeats what stands in the known text or was unpacked before; [`RAW`] is any other byte, in two half bytes;
//! [`END`] is followed by a checksum. Where a copy begins is told relative to where the last one would go on, because a
//! document follows its model, number by number. A tenth of the code of a general compressor, and its links are no longer.

use std::collections::HashMap;

/// Characters that take one half byte each.
const SMALL: &[u8; 13] = b"0123456789.-e";
const COPY: u8 = 13;
const RAW: u8 = 14;
const END: u8 = 15;

/// Shortest copy; a shorter one costs more than what it replaces.
const SHORTEST: usize = 4;
/// Half bytes of the checksum.
const CHECK: u32 = 8;

/// The half bytes of `text` after `known`, two in a byte; `None` once they are more than `limit` bytes. What is left of a text is
/// not looked at any more then, so that the work is bounded by the limit and not by the text.
pub(super) fn pack(known: &[u8], text: &[u8], limit: usize) -> Option<Vec<u8>> {
    let (out, taken) = halves_of(known, text, 2 * limit);
    let fits = taken == text.len() && out.len() <= 2 * limit;
    fits.then(|| out.chunks(2).map(|pair| pair[0] << 4 | pair.get(1).copied().unwrap_or(0)).collect())
}

/// The half bytes of `text` after `known`, and how many bytes of the text they tell: all, or those up to more than `limit` halves.
fn halves_of(known: &[u8], text: &[u8], limit: usize) -> (Vec<u8>, usize) {
    let whole = [known, text].concat();
    let mut seen = Seen::default();
    let mut out = Vec::new();
    let (mut at, mut expected) = (known.len(), 0);
    while at < whole.len() {
        if out.len() > limit {
            return (out, at - known.len());
        }
        seen.up_to(&whole, at);
        if let Some((from, length)) = best_copy(&whole, &seen, at, expected) {
            out.push(COPY);
            push_number(&mut out, zigzag(from, expected));
            push_number(&mut out, length - SHORTEST);
            at += length;
            expected = from + length;
        } else {
            push_literal(&mut out, whole[at]);
            at += 1;
            expected += 1;
        }
    }
    out.push(END);
    let sum = checksum(text);
    out.extend((0..CHECK).map(|k| half((sum >> (4 * k)) as usize)));
    (out, text.len())
}

/// Index of earlier places by their first [`SHORTEST`] bytes, so that only candidates for a copy are compared.
#[derive(Default)]
struct Seen {
    places: HashMap<[u8; SHORTEST], Vec<usize>>,
    end: usize,
}

impl Seen {
    /// Indexes the places before `at`.
    fn up_to(&mut self, whole: &[u8], at: usize) {
        for place in self.end..at {
            if let Some(&beginning) = whole[place..].first_chunk() {
                self.places.entry(beginning).or_default().push(place);
            }
        }
        self.end = at;
    }

    /// Earlier places with the same first [`SHORTEST`] bytes as `at`, in order.
    fn like(&self, whole: &[u8], at: usize) -> impl Iterator<Item = usize> {
        whole[at..].first_chunk().and_then(|beginning| self.places.get(beginning)).into_iter().flatten().copied()
    }
}

/// The text that [`pack`] packed; `None` when anything is wrong with it or it is longer than `limit`.
pub(super) fn unpack(known: &[u8], packed: &[u8], limit: usize) -> Option<Vec<u8>> {
    let mut halves = packed.iter().flat_map(|byte| [byte >> 4, byte & 15]);
    let mut whole = known.to_vec();
    let mut expected = 0_usize;
    loop {
        match halves.next()? {
            END => break,
            COPY => {
                let from = unzigzag(take_number(&mut halves)?, expected)?;
                let length = take_number(&mut halves)?.checked_add(SHORTEST)?;
                if from >= whole.len() || length > limit {
                    return None;
                }
                // One by one: a copy may go on into what it writes.
                for k in from..from + length {
                    whole.push(*whole.get(k)?);
                }
                expected = from + length;
            }
            RAW => {
                whole.push(halves.next()? << 4 | halves.next()?);
                expected += 1;
            }
            small => {
                whole.push(SMALL[usize::from(small)]);
                expected += 1;
            }
        }
        if whole.len() - known.len() > limit {
            return None;
        }
    }
    let text = whole.split_off(known.len());
    let mut sum = 0_u32;
    for k in 0..CHECK {
        sum |= u32::from(halves.next()?) << (4 * k);
    }
    // The last byte may be half empty, nothing else may follow.
    let rest: Vec<u8> = halves.collect();
    (sum == checksum(&text) && (rest.is_empty() || rest == [0])).then_some(text)
}

/// The copy that saves most half bytes at a place, as its beginning and length.
fn best_copy(whole: &[u8], seen: &Seen, at: usize, expected: usize) -> Option<(usize, usize)> {
    let mut best = None;
    let mut most = 0;
    // Where the last copy would go on first: it is the usual one and the cheapest to tell.
    for from in std::iter::once(expected).filter(|&from| from < at).chain(seen.like(whole, at)) {
        let length = whole[at..].iter().zip(&whole[from..]).take_while(|(a, b)| a == b).count();
        if length < SHORTEST {
            continue;
        }
        let spelt: usize = whole[at..at + length].iter().map(|&byte| cost_of_literal(byte)).sum();
        let saved =
            spelt.saturating_sub(1 + cost_of_number(zigzag(from, expected)) + cost_of_number(length - SHORTEST));
        if saved > most {
            (best, most) = (Some((from, length)), saved);
        }
    }
    best
}

fn push_literal(out: &mut Vec<u8>, byte: u8) {
    match SMALL.iter().position(|&small| small == byte) {
        Some(index) => out.push(half(index)),
        None => out.extend([RAW, byte >> 4, byte & 15]),
    }
}

fn cost_of_literal(byte: u8) -> usize {
    if SMALL.contains(&byte) { 1 } else { 3 }
}

/// The lowest four bits.
#[expect(clippy::cast_possible_truncation, reason = "four bits fit")]
fn half(value: usize) -> u8 {
    (value & 15) as u8
}

/// A number by its octal digits, lowest first; all but the last have the fourth bit set.
fn push_number(out: &mut Vec<u8>, mut number: usize) {
    while number > 7 {
        out.push(half(number & 7) | 8);
        number >>= 3;
    }
    out.push(half(number));
}

fn cost_of_number(number: usize) -> usize {
    let mut cost = 1;
    let mut left = number;
    while left > 7 {
        left >>= 3;
        cost += 1;
    }
    cost
}

fn take_number(halves: &mut impl Iterator<Item = u8>) -> Option<usize> {
    let mut number = 0;
    for shift in (0..30).step_by(3) {
        let digit = halves.next()?;
        number |= usize::from(digit & 7) << shift;
        if digit < 8 {
            return Some(number);
        }
    }
    None
}

/// A place relative to the expected one as a number: 0, 1, 2, 3 … for 0, −1, 1, −2 ….
fn zigzag(place: usize, expected: usize) -> usize {
    if place >= expected { 2 * (place - expected) } else { 2 * (expected - place) - 1 }
}

fn unzigzag(number: usize, expected: usize) -> Option<usize> {
    if number.is_multiple_of(2) { expected.checked_add(number / 2) } else { expected.checked_sub(number.div_ceil(2)) }
}

/// FNV-1a.
fn checksum(text: &[u8]) -> u32 {
    text.iter().fold(0x811c_9dc5, |hash, &byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

#[cfg(test)]
mod tests {
    use super::*;

    const KNOWN: &[u8] = br#"{"gain": 3.0,"time": 30.0,"mode": "automatic"}"#;

    fn there_and_back(text: &[u8]) -> usize {
        let packed = pack(KNOWN, text, 1000).unwrap();
        assert_eq!(unpack(KNOWN, &packed, 1000).as_deref(), Some(text));
        packed.len()
    }

    #[test]
    fn what_is_known_takes_little() {
        assert!(there_and_back(KNOWN) <= 8);
        assert!(there_and_back(br#"{"gain": 4.25,"time": 30.0,"mode": "automatic"}"#) <= 13);
        there_and_back(b"");
        there_and_back(&[0, 255, b'1', b'1', b'1', b'1', b'1', b'1', b'1', b'1', 7]);
        // A run repeats itself.
        assert!(there_and_back(&[b'x'; 900]) <= 12);
    }

    #[test]
    fn damage_is_noticed() {
        let packed = pack(KNOWN, br#"{"gain": 4.25,"time": 30.0,"mode": "manual"}"#, 1000).unwrap();
        for end in 0..packed.len() {
            assert_eq!(unpack(KNOWN, &packed[..end], 1000), None, "{end}");
        }
        for at in 0..packed.len() {
            for bit in 0..8 {
                let mut wrong = packed.clone();
                wrong[at] ^= 1 << bit;
                assert!(unpack(KNOWN, &wrong, 1000).is_none(), "{at} {bit}");
            }
        }
        assert_eq!(unpack(KNOWN, &pack(KNOWN, &[b'x'; 900], 1000).unwrap(), 899), None);
    }

    #[test]
    fn a_text_that_does_not_fit_is_left_where_it_does_not() {
        let step = |k: u32| format!("{{\"time_s\": {k}.0,\"pump\": {},\"voltage\": 3.{k}}}", k % 2);
        let text = (0..4000).map(step).collect::<Vec<_>>().join(",");
        let (halves, taken) = halves_of(KNOWN, text.as_bytes(), 3000);
        assert!(halves.len() <= 3020 && taken < text.len() / 3, "{taken} of {}", text.len());
        assert_eq!(pack(KNOWN, text.as_bytes(), 1500), None);
        // The limit is met to the byte.
        let packed = pack(KNOWN, text.as_bytes(), text.len()).unwrap();
        assert_eq!(pack(KNOWN, text.as_bytes(), packed.len()), Some(packed.clone()));
        assert_eq!(pack(KNOWN, text.as_bytes(), packed.len() - 1), None);
    }
}
