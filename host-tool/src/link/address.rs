//! Where a board is.

use std::fmt::{Display, Formatter};
use std::os::unix::fs::FileTypeExt;
use std::path::PathBuf;

use serialport::SerialPortType;

use super::error::LinkError;

/// Where a board is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
    /// A serial port or a pty, by its path.
    Serial(String),
    /// `host:port`.
    Tcp(String),
    /// A Unix socket.
    Unix(PathBuf),
}

impl Address {
    /// What the user wrote: `tcp:HOST:PORT`, `unix:PATH`, or the path of a port, pty or socket.
    pub fn of(text: &str) -> Self {
        if let Some(address) = text.strip_prefix("tcp:") {
            return Self::Tcp(address.to_owned());
        }
        if let Some(path) = text.strip_prefix("unix:") {
            return Self::Unix(path.into());
        }
        match std::fs::metadata(text).is_ok_and(|found| found.file_type().is_socket()) {
            true => Self::Unix(text.into()),
            false => Self::Serial(text.to_owned()),
        }
    }

    /// The only serial port of the machine; those at USB go first, as ST-LINKs are.
    ///
    /// # Errors
    /// There is none, or more than one.
    pub fn find() -> Result<Self, LinkError> {
        // Where the system cannot list them, none is found.
        let all = serialport::available_ports().unwrap_or_default();
        let is_usb = |kind: &SerialPortType| matches!(kind, SerialPortType::UsbPort(_));
        let names = |usb: bool| -> Vec<String> {
            let wanted = all.iter().filter(|port| is_usb(&port.port_type) == usb);
            wanted.map(|port| port.port_name.clone()).collect()
        };
        let at_usb = names(true);
        only(if at_usb.is_empty() { names(false) } else { at_usb })
    }
}

fn only(mut names: Vec<String>) -> Result<Address, LinkError> {
    match (names.pop(), names.is_empty()) {
        (None, _) => Err(LinkError::NoPort),
        (Some(name), true) => Ok(Address::Serial(name)),
        (Some(last), false) => {
            names.push(last);
            Err(LinkError::ManyPorts(names))
        }
    }
}

impl Display for Address {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Serial(name) => f.write_str(name),
            Self::Tcp(address) => write!(f, "tcp:{address}"),
            Self::Unix(path) => write!(f, "unix:{}", path.display()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_as_they_are_written() {
        for text in ["tcp:localhost:4000", "unix:/tmp/line", "/dev/ttyACM0"] {
            assert_eq!(Address::of(text).to_string(), text);
        }
        assert_eq!(Address::of("/dev/pts/7"), Address::Serial("/dev/pts/7".into()));
    }

    #[test]
    fn one_port_is_taken_and_several_are_named() {
        let names = |n: usize| (0..n).map(|k| format!("/dev/ttyACM{k}")).collect::<Vec<_>>();
        assert!(matches!(only(names(0)), Err(LinkError::NoPort)));
        assert_eq!(only(names(1)).unwrap(), Address::Serial("/dev/ttyACM0".into()));
        let error = only(names(2)).unwrap_err();
        assert_eq!(error.to_string(), "2 serial ports are there: /dev/ttyACM0, /dev/ttyACM1");
    }
}
