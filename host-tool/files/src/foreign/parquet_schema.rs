//! Whether the schema at the end of a Parquet file is the tree that its nodes claim.
//!
//! The library makes room for the children that a node claims before it looks for them. The schema is Thrift's
//! compact protocol: field 2 of the file's metadata, whose nodes have `num_children` in field 5. The library
//! reads a known field as what it should be, whatever kind stands before it; so here each must be of its kind.

const MAGIC: &[u8] = b"PAR1";
/// Nodes within each other at most.
const DEEPEST: usize = 64;

/// Whether the claims can be believed; a schema that cannot be followed is not. Files without an end are
/// left to the library.
pub(super) fn is_believable(file: &[u8]) -> bool {
    metadata(file).is_none_or(|metadata| children(metadata).is_some_and(|nodes| is_tree(&nodes)))
}

fn metadata(file: &[u8]) -> Option<&[u8]> {
    let (rest, length) = file.strip_suffix(MAGIC)?.split_last_chunk::<4>()?;
    let length = u32::from_le_bytes(*length) as usize;
    rest.get(rest.len().checked_sub(length)?..)
}

/// How many children each node claims.
fn children(metadata: &[u8]) -> Option<Vec<u64>> {
    let (mut input, mut id) = (Input(metadata), 0);
    let is_version = (input.field(&mut id)?, id) == (I32, 1);
    input.varint()?;
    if !is_version || (input.field(&mut id)?, id) != (LIST, 2) {
        return None;
    }
    let (count, kind) = input.list()?;
    (0..count).map(|_| if kind == STRUCT { input.node() } else { None }).collect()
}

/// Whether nodes with so many children each, a parent before its children, make one tree.
fn is_tree(nodes: &[u64]) -> bool {
    let mut missing = vec![1];
    for &children in nodes {
        while missing.last() == Some(&0) {
            missing.pop();
        }
        let Some(of_parent) = missing.last_mut() else { return false };
        *of_parent -= 1;
        missing.push(children);
        // The first of them stands for what holds the root.
        if missing.len() > DEEPEST + 1 {
            return false;
        }
    }
    missing.iter().all(|&count| count == 0)
}

const TRUE: u8 = 1;
const FALSE: u8 = 2;
const BYTE: u8 = 3;
const I16: u8 = 4;
const I32: u8 = 5;
const I64: u8 = 6;
const DOUBLE: u8 = 7;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// The kinds of the fields of a logical type, from field 1 on; `None` of one that is not known.
fn fields_of_logical_type(id: u64) -> Option<&'static [u8]> {
    match id {
        // Strings, maps, lists, names, dates, JSON, identifiers, files and the like.
        1..=4 | 6 | 11..=15 | 19 => Some(&[]),
        // Decimals: scale, precision.
        5 => Some(&[I32, I32]),
        // Times and time stamps: whether of UTC, unit.
        7 | 8 => Some(&[TRUE, STRUCT]),
        // Whole numbers: bits, whether with a sign.
        10 => Some(&[BYTE, TRUE]),
        // Variants, geometries, geographies.
        16 => Some(&[BYTE]),
        17 => Some(&[BINARY]),
        18 => Some(&[BINARY, I32]),
        _ => None,
    }
}

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

    /// The kind of the next field, and its number by its distance; 0 at the end of a structure.
    fn field(&mut self, id: &mut u64) -> Option<u8> {
        let head = self.byte()?;
        match (head >> 4, head & 0x0F) {
            (_, 0) => Some(0),
            // A number in full, for logical types from 16 on. Signs alternate; numbers only grow.
            (0, kind) => {
                let number = self.varint()?;
                let is_next = number % 2 == 0 && number / 2 > *id;
                *id = number / 2;
                is_next.then_some(kind)
            }
            (delta, kind) => {
                *id += u64::from(delta);
                Some(kind)
            }
        }
    }

    fn list(&mut self) -> Option<(u64, u8)> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => self.varint()?,
            count => u64::from(count),
        };
        Some((count, head & 0x0F))
    }

    /// A node of the schema, to its end: how many children it claims.
    fn node(&mut self) -> Option<u64> {
        let (mut id, mut children) = (0, 0);
        loop {
            match (self.field(&mut id)?, id) {
                (0, _) => return Some(children),
                // Signs alternate: 2 n is n, 2 n - 1 is -n.
                (I32, 5) => children = self.varint()?.div_ceil(2),
                (I32, 1..=3 | 6..=9) => drop(self.varint()?),
                (BINARY, 4) => self.binary()?,
                (STRUCT, 10) => self.logical_type()?,
                _ => return None,
            }
        }
    }

    fn binary(&mut self) -> Option<()> {
        let length = self.varint()?;
        self.take(length)
    }

    /// A union whose fields are structures.
    fn logical_type(&mut self) -> Option<()> {
        let mut id = 0;
        loop {
            match self.field(&mut id)? {
                0 => return Some(()),
                STRUCT => match fields_of_logical_type(id) {
                    Some(kinds) => self.structure(kinds)?,
                    // A kind of later days, which the library passes over too.
                    None => self.skip(STRUCT, DEEPEST)?,
                },
                _ => return None,
            }
        }
    }

    /// A structure whose fields have these kinds.
    fn structure(&mut self, kinds: &[u8]) -> Option<()> {
        let mut id = 0;
        loop {
            let kind = self.field(&mut id)?;
            let wanted =
                usize::try_from(id).ok()?.checked_sub(1).and_then(|k| kinds.get(k).copied());
            match (kind, wanted) {
                (0, _) => return Some(()),
                (TRUE | FALSE, Some(TRUE)) => {}
                (BYTE, Some(BYTE)) => self.take(1)?,
                (I32, Some(I32)) => drop(self.varint()?),
                (BINARY, Some(BINARY)) => self.binary()?,
                (STRUCT, Some(STRUCT)) => self.unit()?,
                _ => return None,
            }
        }
    }

    /// A field of this kind that is not known, to its end, with structures within it no deeper than this.
    fn skip(&mut self, kind: u8, deepest: usize) -> Option<()> {
        match kind {
            TRUE | FALSE => {}
            BYTE => self.take(1)?,
            I16 | I32 | I64 => drop(self.varint()?),
            DOUBLE => self.take(8)?,
            BINARY => self.binary()?,
            STRUCT => {
                let deeper = deepest.checked_sub(1)?;
                let mut id = 0;
                loop {
                    match self.field(&mut id)? {
                        0 => break,
                        kind => self.skip(kind, deeper)?,
                    }
                }
            }
            _ => return None,
        }
        Some(())
    }

    /// A unit of time: a union of milliseconds, microseconds, nanoseconds, each an empty structure.
    fn unit(&mut self) -> Option<()> {
        let mut id = 0;
        let is_unit = self.field(&mut id)? == STRUCT && id <= 3;
        let ends = [self.byte()?, self.byte()?];
        (is_unit && ends == [0, 0]).then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file whose metadata are version 1 and a list of nodes, each as its bytes up to the end.
    fn file(nodes: &[&[u8]]) -> Vec<u8> {
        let mut metadata = vec![0x15, 2, 0x19, (nodes.len() as u8) << 4 | STRUCT];
        nodes.iter().for_each(|node| metadata.extend([node, &[0][..]].concat()));
        metadata.push(0);
        let length = (metadata.len() as u32).to_le_bytes();
        [&metadata, &length[..], MAGIC].concat()
    }

    const ROOT: &[u8] = &[0x48, 1, b'r', 0x15, 2];
    const LEAF: &[u8] = &[0x15, 10, 0x25, 0, 0x18, 1, b'a'];

    #[test]
    fn a_tree_is_believed() {
        assert!(is_believable(&file(&[ROOT, LEAF])));
        assert!(is_believable(b"PAR1") && is_believable(b""));
    }

    #[test]
    fn claims_that_make_no_tree_are_not_believed() {
        let claiming = |children: &[u8]| [&ROOT[..4], children].concat();
        for children in [&[0][..], &[4], &[3], &[0xFE, 0xFF, 0xFF, 0xFF, 0x0F]] {
            assert!(!is_believable(&file(&[&claiming(children), LEAF])), "{children:?}");
        }
        let deep = |nodes| is_tree(&[vec![1; nodes], vec![0]].concat());
        assert!(deep(DEEPEST - 1) && !deep(DEEPEST));
    }

    #[test]
    fn a_field_of_another_kind_is_not_followed() {
        // A name that says that it is a number, of which the library reads a text all the same.
        assert!(!is_believable(&file(&[&[0x45, 1, b'r', 0x15, 2], LEAF])));
        // A time stamp of UTC in milliseconds, and one whose unit says that it is a number.
        let stamp = |kind: u8| {
            let tail = [0x6C, 0x8C, 0x11, 0x10 | kind, 0x1C, 0, 0, 0, 0];
            [LEAF, &tail].concat()
        };
        assert!(is_believable(&file(&[ROOT, &stamp(STRUCT)])));
        assert!(!is_believable(&file(&[ROOT, &stamp(I32)])));
    }

    #[test]
    fn logical_types_of_later_days_are_passed_over() {
        // Field 10 a union, whose field by its number in full is a structure.
        let of_type = |id: u8, inner: &[u8]| [LEAF, &[0x6C, 0x0C, 2 * id], inner, &[0, 0]].concat();
        let number: &[u8] = &[0x15, 2];
        assert!(is_believable(&file(&[ROOT, &of_type(16, &[0x13, 1])])), "a variant");
        assert!(!is_believable(&file(&[ROOT, &of_type(16, number)])), "a variant of another kind");
        assert!(is_believable(&file(&[ROOT, &of_type(40, number)])), "not known");
        assert!(!is_believable(&file(&[ROOT, &of_type(40, &[0x1C; 100])])), "too deep");
    }
}
