//! A board's key in a file: 64 hexadecimal digits.

use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use firmware::link::Key;
use tempfile::NamedTempFile;

use crate::failure::Failure;
use files::Problem;

/// The key in a file.
///
/// # Errors
/// The file cannot be read, or holds something else.
pub fn read_key(path: &Path) -> Result<Key, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        let missing = error.kind() == std::io::ErrorKind::NotFound;
        let problem = if missing { Problem::Missing } else { Problem::Unreadable(error) };
        problem.in_file(path)
    })?;
    key_of(text.trim()).ok_or_else(|| {
        let message = format!("{}: a key has 64 hexadecimal digits", path.display());
        Failure::new(message, "`rrr set-key FILE` makes a key and gives it to the board")
    })
}

fn key_of(text: &str) -> Option<Key> {
    if text.len() != 64 || !text.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let mut key = [0; 32];
    for (byte, digits) in key.iter_mut().zip(text.as_bytes().chunks(2)) {
        *byte = u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?;
    }
    Some(key)
}

/// A new key in a temporary file beside the one that it is for, which does not exist yet.
///
/// It is on the disk before the board gets it, so that the board never has a key that nobody
/// else has. Dropped, it is gone.
#[derive(Debug)]
pub struct NewKey {
    /// The key.
    pub key: Key,
    path: PathBuf,
    temporary: NamedTempFile,
}

impl NewKey {
    /// A random key for the file `path`, readable by the user alone.
    ///
    /// # Errors
    /// The directory does not take it.
    pub fn make(path: &Path) -> Result<Self, Failure> {
        Self::on_disk(path).map_err(|error| {
            let message = format!("{}: no key can be made: {error}", path.display());
            Failure::new(message, "name a file in a directory that you may write to, with room")
        })
    }

    fn on_disk(path: &Path) -> std::io::Result<Self> {
        let mut key: Key = [0; 32];
        File::open("/dev/urandom")?.read_exact(&mut key)?;
        let digits: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
        let mut temporary = temporary_file(path)?;
        writeln!(temporary, "{digits}")?;
        temporary.as_file().sync_all()?;
        File::open(directory(path))?.sync_all()?;
        Ok(Self { key, path: path.to_owned(), temporary })
    }

    /// Renames the file, now that the board has the key.
    ///
    /// # Errors
    /// The file cannot be renamed; it stays where it is, and the message says where.
    pub fn rename(self) -> Result<(), Failure> {
        let Err(error) = self.temporary.persist_noclobber(&self.path) else {
            // The key is on the disk under one name or the other.
            let _ = File::open(directory(&self.path)).and_then(|directory| directory.sync_all());
            return Ok(());
        };
        let kept = kept_path(error.file);
        let (path, error) = (self.path.display(), error.error);
        let message = format!("{path}: cannot be made: {error}; the board has the key of {kept}");
        Err(Failure::new(message, format!("rename {kept}, and keep a copy")))
    }

    /// Keeps the temporary file, as the board may have the key; its name, and the final one.
    pub fn keep(self) -> (String, PathBuf) {
        (kept_path(self.temporary), self.path)
    }
}

/// Keeps a temporary file; its name.
fn kept_path(mut file: NamedTempFile) -> String {
    file.disable_cleanup(true);
    file.path().display().to_string()
}

/// An empty file for the user alone, named after the one that it is for.
fn temporary_file(path: &Path) -> std::io::Result<NamedTempFile> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let prefix = format!("{name}.");
    tempfile::Builder::new().prefix(&prefix).suffix(".new").tempfile_in(directory(path))
}

fn directory(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_64_digits() {
        let key = key_of(&"0aFf".repeat(16)).unwrap();
        assert_eq!(key[..4], [0x0A, 0xFF, 0x0A, 0xFF]);
        for text in ["", "0aff", &"0aFg".repeat(16), &"ä".repeat(32)] {
            assert_eq!(key_of(text), None, "{text}");
        }
    }

    #[test]
    fn a_new_key_has_its_name_once_it_is_renamed_and_goes_if_it_is_not() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("key");
        let files = || std::fs::read_dir(directory.path()).unwrap().count();
        drop(NewKey::make(&path).unwrap());
        assert_eq!(files(), 0);
        let new = NewKey::make(&path).unwrap();
        let key = new.key;
        assert_eq!((path.exists(), files()), (false, 1));
        new.rename().unwrap();
        assert_eq!((read_key(&path).unwrap(), files()), (key, 1));
    }

    #[test]
    fn a_key_file_that_came_meanwhile_is_not_written_over() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("key");
        let new = NewKey::make(&path).unwrap();
        let key = new.key;
        std::fs::write(&path, "another").unwrap();
        let failure = new.rename().unwrap_err();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "another");
        let name = failure.message.rsplit(' ').next().unwrap();
        assert_eq!(read_key(Path::new(name)).unwrap(), key, "{}", failure.message);
    }
}
