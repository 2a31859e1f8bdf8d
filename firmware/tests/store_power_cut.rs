//! The power fails during a commit, after every byte: the old block or the new one is there.
#![allow(missing_docs)]

mod common;
mod failing_flash;

use common::block;
use failing_flash::{FailingFlash, Torn, store};
use firmware::Mode;
use firmware::block::{MAX_BYTES, ParameterBlock};
use firmware::store::{Kind, NOTE_BYTES};

/// A block that differs from others by its number.
fn numbered(number: u32) -> ParameterBlock {
    let mut block = block(Mode::ALL[number as usize % 5]);
    block.command_limit_v = 1.0 + number as f32 / 100.0;
    block
}

fn encoded(number: u32) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    numbered(number).encode(&mut buffer).unwrap().to_vec()
}

/// Flash after the blocks 1 to `count` were committed.
fn with_blocks(count: u32) -> FailingFlash {
    (1..=count).fold(FailingFlash::new(), |flash, number| commit(flash, number).repaired())
}

/// Commits a block; the power may fail.
fn commit(flash: FailingFlash, number: u32) -> FailingFlash {
    let mut store = store(flash);
    let _ = store.commit(&encoded(number));
    store.into_flash()
}

/// The number of the block that the board begins with; `None` for the safe defaults.
fn booted(flash: &FailingFlash) -> Option<u32> {
    let boot = store(flash.clone().repaired()).boot();
    boot.source.slot()?;
    let number = ((boot.block.command_limit_v - 1.0) * 100.0).round() as u32;
    assert_eq!(boot.block, numbered(number), "a mixture");
    Some(number)
}

/// Bytes that the commit of a block erases and writes.
fn work(flash: &FailingFlash, number: u32) -> usize {
    commit(flash.clone().repaired(), number).work
}

/// Cuts the power after every byte of the commit of block `new`, in every manner; hands each
/// flash on.
fn every_cut(before: &FailingFlash, new: u32, mut check: impl FnMut(FailingFlash, usize, Torn)) {
    let work = work(before, new);
    assert!(work > 2048 + encoded(new).len(), "{work}");
    for torn in Torn::ALL {
        for point in 0..=work {
            check(commit(before.clone().powered(point, torn), new).repaired(), point, torn);
        }
    }
}

#[test]
fn after_every_cut_the_old_or_the_new_block_is_there_and_the_next_commit_holds() {
    let mut cuts = [0, 0];
    for blocks in 1..=2 {
        let before = with_blocks(blocks);
        let (work, new) = (work(&before, blocks + 1), blocks + 1);
        every_cut(&before, new, |after, point, torn| {
            let found = booted(&after);
            assert!(
                found == Some(blocks) || found == Some(new),
                "{found:?} after {point} of {work} bytes, torn {torn:?}"
            );
            assert!(found == Some(new) || point < work, "acknowledged and lost");
            cuts[usize::from(found == Some(new))] += 1;
            assert_eq!(booted(&commit(after, 9)), Some(9), "{point} {torn:?}");
        });
    }
    println!("{} cuts: {} times the old block, {} the new", cuts[0] + cuts[1], cuts[0], cuts[1]);
    // As docs/parameter-store.md says.
    assert_eq!(cuts[0] + cuts[1], 29_484);
}

#[test]
fn the_first_block_is_there_or_not_and_never_half() {
    every_cut(&FailingFlash::new(), 1, |after, point, torn| {
        let found = booted(&after);
        assert!(found.is_none() || found == Some(1), "{found:?} {point} {torn:?}");
        assert_eq!(booted(&commit(after, 2)), Some(2), "{point} {torn:?}");
    });
}

/// The pattern of sequential-storage's issue 136: two cuts, then a commit that is acknowledged.
#[test]
fn a_commit_after_two_cuts_holds() {
    let before = with_blocks(2);
    let mut pairs = 0;
    for torn in Torn::ALL {
        // Around the ends of erasure, header, body and mark, and here and there between.
        for first in (0..work(&before, 3))
            .filter(|cut| cut.is_multiple_of(1000) || (2044..2076).contains(cut))
        {
            let once = commit(before.clone().powered(first, torn), 3).repaired();
            let old = booted(&once).unwrap();
            for second in (0..=work(&once, 4))
                .filter(|cut| cut.is_multiple_of(500) || (2047..2077).contains(cut))
            {
                let twice = commit(once.clone().powered(second, torn), 4).repaired();
                let found = booted(&twice).unwrap();
                assert!(found == old || found == 4, "{first} {second} {torn:?}: {found}");
                assert_eq!(booted(&commit(twice, 5)), Some(5), "{first} {second} {torn:?}");
                pairs += 1;
            }
        }
    }
    println!("{pairs} pairs of cuts");
    assert_eq!(pairs, 7_350);
}

fn note(flash: &FailingFlash, kind: Kind) -> Option<Vec<u8>> {
    let mut buffer = [0; NOTE_BYTES];
    let length = store(flash.clone().repaired()).read_note(kind, &mut buffer)?;
    Some(buffer[..length].to_vec())
}

fn keep(flash: FailingFlash, kind: Kind, bytes: &[u8]) -> FailingFlash {
    let mut store = store(flash);
    let _ = store.write_note(kind, bytes);
    store.into_flash()
}

/// Faults and keys, on a page with room and on a full one.
#[test]
fn after_every_cut_the_old_or_the_new_note_is_there() {
    for kind in [Kind::Fault, Kind::Key] {
        for notes in [1_u8, 5, 31, 32, 33, 64] {
            let before = (1..=notes)
                .fold(FailingFlash::new(), |flash, n| keep(flash, kind, &[n; NOTE_BYTES]));
            let (old, new) = (vec![notes; NOTE_BYTES], vec![notes + 1; 7]);
            assert_eq!(note(&before, kind), Some(old.clone()));
            let before = before.repaired();
            let work = keep(before.clone(), kind, &new).work;
            assert_eq!(work > 2048, notes.is_multiple_of(32), "{work}");
            for torn in Torn::ALL {
                for point in 0..=work {
                    let after = keep(before.clone().powered(point, torn), kind, &new).repaired();
                    let found = note(&after, kind).unwrap();
                    assert!(found == old || found == new, "{notes} {point} {torn:?}");
                    let next = keep(after, kind, &[]);
                    assert_eq!(note(&next, kind), Some(vec![]), "{notes} {point} {torn:?}");
                }
            }
        }
    }
}
