//! Files of the host, by semihosting.

use core::ffi::CStr;

use cortex_m_semihosting::syscall;

/// How a file is opened; the numbers are those of ARM's SYS_OPEN.
#[derive(Clone, Copy)]
pub enum Mode {
    Read = 1,
    ReadWrite = 3,
    Write = 5,
    CreateReadWrite = 7,
}

/// An open file or FIFO of the host.
pub struct HostFile {
    handle: usize,
}

impl HostFile {
    /// Opens a file in QEMU's working directory.
    pub fn open(name: &CStr, mode: Mode) -> Option<Self> {
        let length = name.count_bytes();
        // SAFETY: SYS_OPEN reads `length` bytes and a zero from `name`.
        let handle = unsafe { syscall!(OPEN, name.as_ptr(), mode as usize, length) };
        (handle != usize::MAX).then_some(Self { handle })
    }

    /// Fills `bytes`, waiting for them; `None` at the end of the file.
    pub fn read(&mut self, bytes: &mut [u8]) -> Option<()> {
        let mut rest = bytes;
        while !rest.is_empty() {
            // SAFETY: SYS_READ writes at most `rest.len()` bytes to `rest`.
            let missing = unsafe { syscall!(READ, self.handle, rest.as_mut_ptr(), rest.len()) };
            let arrived = rest.len().checked_sub(missing).filter(|&n| n > 0)?;
            rest = rest.get_mut(arrived..)?;
        }
        Some(())
    }

    /// Writes all of `bytes`; `None` when nobody reads any more.
    pub fn write(&mut self, bytes: &[u8]) -> Option<()> {
        // SAFETY: SYS_WRITE reads `bytes.len()` bytes from `bytes`.
        let missing = unsafe { syscall!(WRITE, self.handle, bytes.as_ptr(), bytes.len()) };
        (missing == 0).then_some(())
    }

    /// Goes to so many bytes from the file's begin.
    pub fn seek(&mut self, position: u32) -> Option<()> {
        // SAFETY: SYS_SEEK touches no memory.
        let failed = unsafe { syscall!(SEEK, self.handle, position) };
        (failed == 0).then_some(())
    }
}
