//! Damage to good inputs.

use crate::rng::Rng;

/// Numbers that programs stumble over.
const EDGES: [u8; 8] = [0, 1, 0x7F, 0x80, 0xFE, 0xFF, b'-', b'\n'];

/// Text that files are made of.
const WORDS: [&[u8]; 12] = [
    b"nan",
    b"inf",
    b"-1e999",
    b"1e-320",
    b"-0.0",
    b"99999999999999999999",
    b"[[effect]]\n",
    b"joint = 3\n",
    b",",
    b"\r\n",
    b"\"",
    b"\xEF\xBB\xBF",
];

/// A seed, changed in one to eight places, and now and then joined with another.
pub fn mutated(seeds: &[Vec<u8>], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = pick(seeds, rng).to_vec();
    for _ in 0..=rng.below(8) {
        change(&mut bytes, seeds, rng);
    }
    bytes
}

fn pick<'a>(seeds: &'a [Vec<u8>], rng: &mut Rng) -> &'a [u8] {
    seeds.get(rng.below(seeds.len())).map_or(&[], Vec::as_slice)
}

fn change(bytes: &mut Vec<u8>, seeds: &[Vec<u8>], rng: &mut Rng) {
    let at = rng.below(bytes.len() + 1);
    let until = (at + 1 + rng.below(16)).min(bytes.len());
    match rng.below(9) {
        0 => flip(bytes, at, 1 << rng.below(8)),
        1 => set(bytes, at, rng.bits() as u8),
        2 => set(bytes, at, EDGES[rng.below(EDGES.len())]),
        3 => bytes.truncate(at),
        4 => drop(bytes.drain(at.min(until)..until)),
        5 => insert(bytes, at, &rng.bits().to_le_bytes()[..1 + rng.below(8)]),
        6 => insert(bytes, at, WORDS[rng.below(WORDS.len())]),
        7 => {
            let copy = bytes[at.min(until)..until].to_vec();
            insert(bytes, rng.below(at + 1), &copy);
        }
        _ => {
            let other = pick(seeds, rng);
            let from = rng.below(other.len() + 1);
            bytes.truncate(at);
            bytes.extend_from_slice(&other[from..]);
        }
    }
}

fn set(bytes: &mut [u8], at: usize, value: u8) {
    if let Some(byte) = bytes.get_mut(at) {
        *byte = value;
    }
}

fn flip(bytes: &mut [u8], at: usize, bits: u8) {
    if let Some(byte) = bytes.get_mut(at) {
        *byte ^= bits;
    }
}

fn insert(bytes: &mut Vec<u8>, at: usize, new: &[u8]) {
    bytes.splice(at..at, new.iter().copied());
}
