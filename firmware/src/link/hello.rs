//! The opening messages of a conversation. Their layout never changes.
//!
//! Bytes of fixed place, no postcard: a host and a firmware of any age understand
//! each other's Hello, and if nothing else is the same, they can say so in words.
//!
//! | host asks | board answers | bytes |
//! | --- | --- | --- |
//! | `R R R` | `R R R` | 3 |
//! | version of the protocol | the same, the board's | 2, little-endian |
//! | | hash of the message types | 4, little-endian |
//! | | build id | 24, text, filled up with zeros |
//! | | name of the board | 24, text, filled up with zeros |
//!
//! A Hello restarts the numbers of requests and makes the last challenge void. It is
//! answered whatever the version. Bytes after these are room for later; they are ignored.

/// Which build of the firmware this is.
pub const BUILD_ID: &str = match option_env!("RRR_BUILD_ID") {
    Some(id) => id,
    None => env!("CARGO_PKG_VERSION"),
};
/// Version of the protocol: raised when frames, numbering or proofs change their meaning.
pub const PROTOCOL_VERSION: u16 = 1;
/// Length of the host's Hello [bytes].
pub const HOST_HELLO_BYTES: usize = 5;
/// Length of the board's Hello [bytes].
pub const HELLO_BYTES: usize = 57;

const MAGIC: [u8; 3] = *b"RRR";
const TEXT_BYTES: usize = 24;

/// The host's Hello.
pub fn host_hello() -> [u8; HOST_HELLO_BYTES] {
    let [low, high] = PROTOCOL_VERSION.to_le_bytes();
    [MAGIC[0], MAGIC[1], MAGIC[2], low, high]
}

/// The host's version of the protocol, if these bytes are its Hello.
pub fn parse_host_hello(bytes: &[u8]) -> Option<u16> {
    match bytes {
        [b'R', b'R', b'R', low, high, ..] => Some(u16::from_le_bytes([*low, *high])),
        _ => None,
    }
}

/// A text of at most 24 bytes, as it stands in a Hello.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Text([u8; TEXT_BYTES]);

impl Text {
    /// The beginning of a text.
    pub fn new(text: &str) -> Self {
        let mut bytes = [0; TEXT_BYTES];
        for (slot, byte) in bytes.iter_mut().zip(text.bytes()) {
            *slot = byte;
        }
        Self(bytes)
    }

    /// The text, up to the first zero or the first byte that is no UTF-8.
    pub fn as_str(&self) -> &str {
        let end = self.0.iter().position(|&byte| byte == 0).unwrap_or(TEXT_BYTES);
        let text = self.0.get(..end).unwrap_or_default();
        match core::str::from_utf8(text) {
            Ok(text) => text,
            Err(error) => text
                .get(..error.valid_up_to())
                .and_then(|valid| core::str::from_utf8(valid).ok())
                .unwrap_or_default(),
        }
    }
}

impl core::fmt::Debug for Text {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.as_str().fmt(f)
    }
}

/// The board's Hello.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hello {
    /// Version of the protocol.
    pub protocol_version: u16,
    /// Hash of the message types, [`super::schema::HASH`].
    pub schema_hash: u32,
    /// Which build of the firmware this is.
    pub build_id: Text,
    /// Which board this is.
    pub board: Text,
}

impl Hello {
    /// This build's, on a board of that name.
    pub fn of_this_build(board: &str) -> Self {
        Self {
            protocol_version: PROTOCOL_VERSION,
            schema_hash: super::schema::HASH,
            build_id: Text::new(BUILD_ID),
            board: Text::new(board),
        }
    }

    /// The Hello as bytes.
    pub fn encode(&self) -> [u8; HELLO_BYTES] {
        let mut bytes = [0; HELLO_BYTES];
        bytes[0..3].copy_from_slice(&MAGIC);
        bytes[3..5].copy_from_slice(&self.protocol_version.to_le_bytes());
        bytes[5..9].copy_from_slice(&self.schema_hash.to_le_bytes());
        bytes[9..33].copy_from_slice(&self.build_id.0);
        bytes[33..57].copy_from_slice(&self.board.0);
        bytes
    }

    /// The Hello in these bytes, if it is one.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        let bytes = bytes.first_chunk::<HELLO_BYTES>()?;
        if !bytes.starts_with(&MAGIC) {
            return None;
        }
        let text = |from: usize| {
            let mut text = [0; TEXT_BYTES];
            text.copy_from_slice(&bytes[from..from + TEXT_BYTES]);
            Text(text)
        };
        Some(Self {
            protocol_version: u16::from_le_bytes([bytes[3], bytes[4]]),
            schema_hash: u32::from_le_bytes([bytes[5], bytes[6], bytes[7], bytes[8]]),
            build_id: text(9),
            board: text(33),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_layout_is_the_one_that_never_changes() {
        assert_eq!(&host_hello()[..3], b"RRR");
        let hello = Hello {
            protocol_version: 0x0201,
            schema_hash: 0x0605_0403,
            build_id: Text::new("0.1.0"),
            board: Text::new("a name that is longer than there is room for"),
        };
        let bytes = hello.encode();
        assert_eq!(&bytes[..15], b"RRR\x01\x02\x03\x04\x05\x060.1.0\0");
        assert_eq!(&bytes[33..], b"a name that is longer th");
        assert_eq!(Hello::decode(&bytes), Some(hello));
        assert_eq!(hello.build_id.as_str(), "0.1.0");
    }

    #[test]
    fn a_later_hello_may_be_longer() {
        let mut bytes = Hello::of_this_build("x").encode().to_vec();
        bytes.extend([1, 2, 3]);
        assert_eq!(Hello::decode(&bytes), Some(Hello::of_this_build("x")));
        assert_eq!(Hello::decode(&bytes[..56]), None);
        assert_eq!(parse_host_hello(b"RRR\x07\0more"), Some(7));
        assert_eq!(parse_host_hello(b"RRS\x07\0"), None);
    }
}
