//! The library sequential-storage in the power-cut test that the store passes.
//!
//! Not a test of this project: it prints the figures of `docs/parameter-store.md`. Run it with
//! `cargo test --release -p firmware --test store_library -- --ignored --nocapture`.
#![allow(missing_docs)]

mod failing_flash;

use embassy_futures::block_on;
use embedded_storage::nor_flash as blocking;
use embedded_storage_async::nor_flash::{NorFlash, ReadNorFlash};
use failing_flash::{FailingFlash, Torn};
use sequential_storage::cache::Cache;
use sequential_storage::map::{MapConfig, MapStorage};

impl ReadNorFlash for FailingFlash {
    const READ_SIZE: usize = 1;

    async fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        blocking::ReadNorFlash::read(self, offset, bytes)
    }

    fn capacity(&self) -> usize {
        blocking::ReadNorFlash::capacity(self)
    }
}

impl NorFlash for FailingFlash {
    const WRITE_SIZE: usize = 8;
    const ERASE_SIZE: usize = 2048;

    async fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        blocking::NorFlash::erase(self, from, to)
    }

    async fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        blocking::NorFlash::write(self, offset, bytes)
    }
}

/// Bytes as long as a block, different for each number.
fn value(number: u8) -> Vec<u8> {
    (0..300).map(|i| (i as u8).wrapping_mul(31) ^ number).collect()
}

/// Stores a value; the power may fail. Whether the library said that it is stored.
fn store(flash: FailingFlash, pages: u32, number: u8) -> (FailingFlash, bool) {
    let config = MapConfig::new(0..2048 * pages);
    let mut map = MapStorage::<u8, _, _>::new(flash, config, Cache::new_uncached());
    let result = block_on(map.store_item(&mut [0; 512], &0, &value(number).as_slice()));
    (map.destroy().0, result.is_ok())
}

/// The number of the value found, 0 for none; `None` for an error.
fn found(flash: &FailingFlash, pages: u32) -> Option<u8> {
    let config = MapConfig::new(0..2048 * pages);
    let flash = flash.clone().repaired();
    let mut map = MapStorage::<u8, _, _>::new(flash, config, Cache::new_uncached());
    let mut buffer = [0; 512];
    let bytes = block_on(map.fetch_item::<&[u8]>(&mut buffer, &0)).ok()?;
    bytes.map_or(Some(0), |bytes| (1..=255).find(|number| value(*number) == bytes))
}

#[derive(Default)]
struct Count {
    cuts: u32,
    neither: u32,
    lost: u32,
}

fn count(pages: u32, torn: Torn) -> Count {
    let mut count = Count::default();
    let mut flash = FailingFlash::new();
    for old in 0..=12 {
        let work = store(flash.clone().repaired(), pages, old + 1).0.work;
        for point in 0..=work {
            let after = store(flash.clone().powered(point, torn), pages, old + 1).0.repaired();
            let number = found(&after, pages);
            let (next, acknowledged) = store(after, pages, 99);
            count.cuts += 1;
            count.neither += u32::from(number != Some(old) && number != Some(old + 1));
            count.lost += u32::from(acknowledged && found(&next, pages) != Some(99));
        }
        flash = store(flash.repaired(), pages, old + 1).0;
    }
    count
}

#[test]
#[ignore = "measures a library"]
fn what_sequential_storage_makes_of_power_cuts() {
    for pages in [2, 4] {
        for torn in Torn::ALL {
            let Count { cuts, neither, lost } = count(pages, torn);
            println!(
                "{pages} pages, torn words {torn:?}: {cuts} cuts, neither old nor new {neither}, \
                 next acknowledged and not there {lost}"
            );
        }
    }
}
