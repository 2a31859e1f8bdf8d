//! Where a page comes from: model, data set with the hash of its content, date, version, command line.

use std::path::{Path, PathBuf};

use chrono::DateTime;
use files::dataset::LIST_NAME;
use files::log::unix_ns;
use files::mapping::Mapping;
use files::{Dataset, Entry};
use report::Provenance;
use sha2::{Digest, Sha256};

/// What a page of this command, on this model and data set, says of itself.
pub fn provenance(model: &Path, dataset: &Path) -> Provenance {
    Provenance {
        model: format!("{} ({})", model.display(), short(&hash_of(&[model.to_owned()]))),
        dataset: format!("{} ({})", dataset.display(), short(&dataset_hash(dataset))),
        date: date_of((unix_ns() / 1_000_000_000) as i64),
        version: format!("rrr {}", env!("CARGO_PKG_VERSION")),
        command_line: command_line(),
    }
}

fn short(hash: &str) -> String {
    format!("SHA-256 {}", &hash[..16.min(hash.len())])
}

/// The hash of a data set's list and of all files that it names, in their order.
pub fn dataset_hash(directory: &Path) -> String {
    let dataset = Dataset::read(directory).ok();
    let entries = dataset.as_ref().map_or(&[][..], |dataset| &dataset.entries);
    let mapping = dataset.as_ref().and_then(|d| d.mapping().ok()).unwrap_or_default();
    let mut paths = vec![directory.join(LIST_NAME)];
    for file in files_of(entries, &mapping) {
        let path = directory.join(file);
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    hash_of(&paths)
}

/// The logs' files, and those of streams beside them.
fn files_of(entries: &[Entry], mapping: &Mapping) -> Vec<String> {
    let of_logs = entries.iter().map(|entry| entry.file.clone());
    let all = mapping.logs.iter().chain([&mapping.common]);
    let of_streams = all.flat_map(|log| {
        let streams = log.streams.values().filter_map(|stream| stream.file.clone());
        streams.chain(log.files.values().cloned()).collect::<Vec<_>>()
    });
    of_logs.chain(of_streams).collect()
}

/// Of the files' lengths and bytes; one that cannot be read counts as empty.
fn hash_of(paths: &[PathBuf]) -> String {
    let mut hash = Sha256::new();
    for path in paths {
        let bytes = std::fs::read(path).unwrap_or_default();
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(&bytes);
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// As it was typed, but for the program's folder.
fn command_line() -> String {
    let quoted = |word: String| match word.contains([' ', '\'', '"']) {
        true => format!("{word:?}"),
        false => word,
    };
    let words = std::env::args().skip(1).map(quoted);
    std::iter::once("rrr".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// Date and time of a second since 1970, in UTC.
fn date_of(unix_s: i64) -> String {
    let date = DateTime::from_timestamp(unix_s, 0).unwrap_or_default();
    date.format("%Y-%m-%d %H:%M UTC").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_have_dates() {
        assert_eq!(date_of(0), "1970-01-01 00:00 UTC");
        assert_eq!(date_of(951_782_400), "2000-02-29 00:00 UTC");
        assert_eq!(date_of(1_700_000_000), "2023-11-14 22:13 UTC");
        assert_eq!(date_of(4_107_542_399), "2100-02-28 23:59 UTC");
    }
}
