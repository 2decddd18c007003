use super::Lesson;

/// A short name for exactly this lesson: eight hexadecimal digits that change with any of its texts and numbers. It guards
/// against reading the progress of one edition with another, not against forgery.
pub fn fingerprint(lesson: &Lesson) -> String {
    let text = serde_json::to_string(lesson).unwrap_or_default();
    format!("{:08x}", checksum(text.as_bytes()))
}

/// FNV-1a (Fowler, Noll, Vo), 32 bits.
pub fn checksum(bytes: &[u8]) -> u32 {
    bytes.iter().fold(0x811c_9dc5, |hash, &byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

#[cfg(test)]
mod tests {
    use super::checksum;

    #[test]
    fn the_checksum_is_that_of_the_published_test_vectors() {
        assert_eq!(checksum(b""), 0x811c_9dc5);
        assert_eq!(checksum(b"a"), 0xe40c_292c);
        assert_eq!(checksum(b"foobar"), 0xbf9c_f968);
    }
}
