//! The bytes of a document as text.

use super::ScenarioError;

/// The text of a document in UTF-8 or, as PowerShell writes it, UTF-16 of either byte order; without its byte order mark.
///
/// UTF-16 without a mark is known by the zero in its first character, which is an ASCII one in JSON.
///
/// # Errors
/// [`ScenarioError::NotText`] for bytes that are neither.
pub fn text_of(bytes: &[u8]) -> Result<String, ScenarioError> {
    let text = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => utf_8(rest),
        [0xff, 0xfe, rest @ ..] => utf_16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf_16(rest, u16::from_be_bytes),
        [_, 0, ..] => utf_16(bytes, u16::from_le_bytes),
        [0, _, ..] => utf_16(bytes, u16::from_be_bytes),
        _ => utf_8(bytes),
    };
    text.ok_or(ScenarioError::NotText)
}

fn utf_8(bytes: &[u8]) -> Option<String> {
    std::str::from_utf8(bytes).ok().map(str::to_owned)
}

fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Option<String> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let units = pairs.iter().map(|&pair| unit(pair));
    if rest.is_empty() { char::decode_utf16(units).collect::<Result<_, _>>().ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "{\"é\": \"𝄞\"}";

    fn utf_16_of(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn every_encoding_gives_the_same_text() {
        let marked = format!("\u{feff}{TEXT}");
        for text in [TEXT, &marked] {
            for bytes in
                [text.as_bytes().to_vec(), utf_16_of(text, u16::to_le_bytes), utf_16_of(text, u16::to_be_bytes)]
            {
                assert_eq!(text_of(&bytes).as_deref(), Ok(TEXT), "{bytes:?}");
            }
        }
    }

    #[test]
    fn bytes_that_are_no_text_are_refused() {
        let lone_surrogate = utf_16_of("{", u16::to_le_bytes).into_iter().chain([0x00, 0xd8]).collect();
        for bytes in [vec![0xff, 0xfe, 0x00], vec![0xc3], b"caf\xe9".to_vec(), lone_surrogate] {
            assert_eq!(text_of(&bytes), Err(ScenarioError::NotText), "{bytes:?}");
        }
        for bytes in [&b""[..], b"{", b"\xef\xbb\xbf", b"\xff\xfe"] {
            assert!(text_of(bytes).is_ok(), "{bytes:?}");
        }
    }
}
