//! Bytes to the board and from it, whatever carries them.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::net::TcpStream;
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

use super::address::Address;

/// Longest wait for a byte, or until the line takes one; the clock is looked at in between.
const WAIT: Duration = Duration::from_millis(5);
/// Longest wait until the line has taken all bytes.
const WRITE_WAIT: Duration = Duration::from_secs(2);

/// What carries the bytes.
pub trait Stream: Read + Write + Send {}

impl<T: Read + Write + Send> Stream for T {}

/// An open line.
pub struct Port(Box<dyn Stream>);

impl std::fmt::Debug for Port {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Port")
    }
}

impl Port {
    /// Opens it.
    ///
    /// # Errors
    /// What the system says.
    pub fn open(address: &Address) -> Result<Self> {
        Ok(Self(match address {
            Address::Serial(name) => {
                let port = serialport::new(name, firmware::link::BAUD).timeout(WAIT);
                Box::new(port.open().map_err(busy_or_not)?)
            }
            Address::Tcp(address) => {
                let stream = TcpStream::connect(address)?;
                stream.set_nodelay(true)?;
                stream.set_read_timeout(Some(WAIT))?;
                stream.set_write_timeout(Some(WAIT))?;
                Box::new(stream)
            }
            Address::Unix(path) => {
                let stream = UnixStream::connect(path)?;
                stream.set_read_timeout(Some(WAIT))?;
                stream.set_write_timeout(Some(WAIT))?;
                Box::new(stream)
            }
        }))
    }

    /// Sends all of the bytes.
    ///
    /// # Errors
    /// The line is broken, or has not taken them within 2 s.
    pub fn send(&mut self, bytes: &[u8]) -> Result<()> {
        let (mut rest, begin) = (bytes, Instant::now());
        while !rest.is_empty() {
            let is_late = begin.elapsed() >= WRITE_WAIT;
            match self.0.write(rest) {
                Ok(0) => return Err(Error::new(ErrorKind::WriteZero, "it takes no more bytes")),
                Ok(taken) => rest = &rest[taken..],
                Err(error) if is_pause(&error) && !is_late => {}
                Err(error) => return Err(error),
            }
            if is_late && !rest.is_empty() {
                return Err(Error::new(ErrorKind::TimedOut, "it takes bytes too slowly"));
            }
        }
        Ok(())
    }

    /// Bytes that have come; none after a few milliseconds without any.
    ///
    /// # Errors
    /// The line is broken, or the other end has closed it.
    pub fn receive(&mut self, buffer: &mut [u8]) -> Result<usize> {
        match self.0.read(buffer) {
            Ok(0) => Err(Error::new(ErrorKind::UnexpectedEof, "the other end has closed it")),
            Ok(length) => Ok(length),
            Err(error) if is_pause(&error) => Ok(0),
            Err(error) => Err(error),
        }
    }
}

/// A port that another program has locked is busy; the library reports no device.
fn busy_or_not(error: serialport::Error) -> Error {
    match error.kind {
        serialport::ErrorKind::NoDevice => {
            Error::new(ErrorKind::ResourceBusy, "another program has it")
        }
        _ => error.into(),
    }
}

fn is_pause(error: &Error) -> bool {
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::net::UnixListener;

    #[test]
    fn a_line_that_takes_no_bytes_is_waited_for_two_seconds_in_all() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("line");
        let listener = UnixListener::bind(&path).unwrap();
        let mut port = Port::open(&Address::Unix(path)).unwrap();
        let _nobody_reads = listener.accept().unwrap();
        let begin = Instant::now();
        let error = port.send(&vec![1; 16 << 20]).unwrap_err();
        let waited_s = begin.elapsed().as_secs_f64();
        assert!((1.9..2.5).contains(&waited_s), "{waited_s} s");
        assert!(is_pause(&error), "{error}");
    }
}
