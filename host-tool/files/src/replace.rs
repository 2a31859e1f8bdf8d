//! Writing a file whole or not at all.

use std::fs::{File, Metadata};
use std::io::{BufWriter, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use super::error::{FileError, Problem};

/// Writes a file: `fill` gets a temporary neighbour, which takes the file's name once
/// it is complete and vanishes otherwise.
///
/// # Errors
/// What `fill` returns, or why the directory does not take the file.
pub fn replace_file<F>(path: &Path, fill: F) -> Result<(), FileError>
where
    F: FnOnce(&mut BufWriter<&mut File>) -> Result<(), Problem>,
{
    replace(path, fill).map_err(|problem| problem.in_file(path))
}

fn replace<F>(path: &Path, fill: F) -> Result<(), Problem>
where
    F: FnOnce(&mut BufWriter<&mut File>) -> Result<(), Problem>,
{
    // A pipe or a device has no half-written state, and must not be renamed over.
    let is_pipe = std::fs::metadata(path).is_ok_and(|found| is_stream(&found));
    if is_pipe || is_of_the_system(path) {
        let mut stream = File::create(path).map_err(Problem::Unwritable)?;
        return fill_file(&mut stream, fill);
    }
    // What a link leads to is replaced, not the link.
    let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut neighbour = new_neighbour(&target).map_err(Problem::Unwritable)?;
    fill_file(neighbour.as_file_mut(), fill)?;
    neighbour.persist(&target).map_err(|error| Problem::Unwritable(error.error))?;
    Ok(())
}

/// Whether a path names what the system has open, /dev/stdout say, even where that is a file.
fn is_of_the_system(path: &Path) -> bool {
    path.starts_with("/dev") || path.starts_with("/proc")
}

fn is_stream(found: &Metadata) -> bool {
    !found.is_file() && !found.is_dir()
}

fn fill_file<F>(file: &mut File, fill: F) -> Result<(), Problem>
where
    F: FnOnce(&mut BufWriter<&mut File>) -> Result<(), Problem>,
{
    let mut buffered = BufWriter::with_capacity(1 << 16, file);
    fill(&mut buffered)?;
    buffered.flush().map_err(Problem::Unwritable)
}

fn new_neighbour(path: &Path) -> std::io::Result<NamedTempFile> {
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".rrr-").suffix(".tmp");
    // Temporary files are private by default; this one is to be an ordinary file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(directory)
}
