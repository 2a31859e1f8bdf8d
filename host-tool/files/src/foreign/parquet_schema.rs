//! Whether the schema at the end of a Parquet file has as many children as its nodes claim.
//!
//! The library makes room for what a node claims before it looks for its children. The schema is
//! Thrift's compact protocol: field 2 of the file's metadata, whose nodes have `num_children` in field 5.

const MAGIC: &[u8] = b"PAR1";

/// Whether the claims can be believed; a schema that cannot be followed is not. Files without an end are
/// left to the library.
pub(super) fn is_believable(file: &[u8]) -> bool {
    let Some(metadata) = metadata(file) else { return true };
    claims(metadata).is_some_and(|most| most <= metadata.len() as u64)
}

fn metadata(file: &[u8]) -> Option<&[u8]> {
    let (rest, length) = file.strip_suffix(MAGIC)?.split_last_chunk::<4>()?;
    let length = u32::from_le_bytes(*length) as usize;
    rest.get(rest.len().checked_sub(length)?..)
}

/// The most children that any node claims.
fn claims(metadata: &[u8]) -> Option<u64> {
    let (mut input, mut most) = (Input(metadata), 0);
    let mut id = 0;
    loop {
        let kind = input.field(&mut id)?;
        if (id, kind) == (2, LIST) {
            let (count, kind) = input.list()?;
            for _ in 0..count {
                if kind != STRUCT {
                    return None;
                }
                input.node(&mut most)?;
            }
            return Some(most);
        }
        input.skip(kind, 0)?;
    }
}

const LIST: u8 = 9;
const STRUCT: u8 = 12;
/// Structures within each other at most.
const DEEPEST: u32 = 16;

struct Input<'a>(&'a [u8]);

impl Input<'_> {
    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    fn take(&mut self, count: u64) -> Option<()> {
        self.0 = self.0.get(usize::try_from(count).ok()?..)?;
        Some(())
    }

    fn varint(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7F) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    }

    /// The kind of the next field, and its number; `None` at the end of a structure.
    fn field(&mut self, id: &mut u64) -> Option<u8> {
        let head = self.byte()?;
        match head >> 4 {
            _ if head & 0x0F == 0 => return None,
            0 => *id = self.varint()? >> 1,
            delta => *id += u64::from(delta),
        }
        Some(head & 0x0F)
    }

    fn list(&mut self) -> Option<(u64, u8)> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => self.varint()?,
            count => u64::from(count),
        };
        Some((count, head & 0x0F))
    }

    /// A node of the schema, to its end.
    fn node(&mut self, most: &mut u64) -> Option<()> {
        let mut id = 0;
        while self.0.first()? & 0x0F != 0 {
            let kind = self.field(&mut id)?;
            match (id, kind) {
                // Signs alternate: 2 n is n, 2 n - 1 is -n.
                (5, 4..=6) => *most = (*most).max(self.varint()?.div_ceil(2)),
                // The library reads a number here whatever kind stands before it.
                (5, _) => return None,
                _ => self.skip(kind, 0)?,
            }
        }
        self.take(1)
    }

    fn skip(&mut self, kind: u8, depth: u32) -> Option<()> {
        match kind {
            1 | 2 => Some(()),
            3 => self.take(1),
            4..=6 => self.varint().map(drop),
            7 => self.take(8),
            8 => {
                let length = self.varint()?;
                self.take(length)
            }
            STRUCT if depth < DEEPEST => {
                let mut id = 0;
                while self.0.first()? & 0x0F != 0 {
                    let kind = self.field(&mut id)?;
                    self.skip(kind, depth + 1)?;
                }
                self.take(1)
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_with_more_children_than_bytes_is_not_believed() {
        // Version 1, then a list of one node: its name "a", and the children it claims.
        let file = |children: &[u8]| {
            let metadata =
                [&[0x15, 2, 0x19, 0x1C, 0x48, 1, b'a', 0x15], children, &[0, 0]].concat();
            let length = (metadata.len() as u32).to_le_bytes();
            [&metadata, &length[..], MAGIC].concat()
        };
        assert!(is_believable(&file(&[4])));
        assert!(!is_believable(&file(&[0xFE, 0xFF, 0xFF, 0xFF, 0x0F])));
        assert!(is_believable(b"PAR1") && is_believable(b""));
    }
}
