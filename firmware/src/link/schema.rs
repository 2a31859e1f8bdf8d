//! One number for all message types: equal on both ends, or the ends are of different builds.

/// FNV-1a of the text of the message types, comments and white space left out.
pub const HASH: u32 = {
    let mut hash = 0x811c_9dc5;
    let mut i = 0;
    while i < TEXTS.len() {
        hash = add(hash, TEXTS[i].as_bytes());
        i += 1;
    }
    hash
};

const TEXTS: [&str; 5] = [
    include_str!("request.rs"),
    include_str!("answer.rs"),
    include_str!("telemetry.rs"),
    include_str!("../supervisor/fault.rs"),
    include_str!("../mode.rs"),
];

const fn add(mut hash: u32, text: &[u8]) -> u32 {
    let mut i = 0;
    while i < text.len() {
        if text[i] == b'/' && i + 1 < text.len() && text[i + 1] == b'/' {
            while i < text.len() && text[i] != b'\n' {
                i += 1;
            }
        } else {
            if !text[i].is_ascii_whitespace() {
                hash = (hash ^ text[i] as u32).wrapping_mul(0x0100_0193);
            }
            i += 1;
        }
    }
    hash
}

#[cfg(test)]
mod tests {
    use super::add;

    #[test]
    fn comments_and_spaces_do_not_count() {
        assert_eq!(add(1, b"a: u8, // first\n  b: u16"), add(1, b"a:u8,b:u16"));
        assert_ne!(add(1, b"a:u8,b:u16"), add(1, b"b:u16,a:u8"));
    }
}
