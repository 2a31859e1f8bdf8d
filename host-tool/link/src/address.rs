//! Where a board is.

use std::fmt::{Display, Formatter};
use std::os::unix::fs::FileTypeExt;
use std::path::PathBuf;

use serialport::{SerialPortInfo, SerialPortType};

use super::error::LinkError;

/// STMicroelectronics' number at USB, the ST-LINK's.
const ST_VENDOR: u16 = 0x0483;

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

    /// The board's USB port, where no other can be meant.
    ///
    /// # Errors
    /// There is none, or more than one, or the system cannot list its ports.
    pub fn find() -> Result<Self, LinkError> {
        found(listed())
    }
}

/// The serial ports of the machine.
fn listed() -> std::io::Result<Vec<SerialPortInfo>> {
    // `available_ports` panics where this directory is missing.
    #[cfg(target_os = "linux")]
    std::fs::read_dir("/sys/class/tty")?;
    Ok(serialport::available_ports()?)
}

/// The port to take, if the system can list them.
fn found(ports: std::io::Result<Vec<SerialPortInfo>>) -> Result<Address, LinkError> {
    among(&ports.map_err(LinkError::Ports)?)
}

/// The only ST-LINK, else the only USB port; others are not taken, but named.
fn among(ports: &[SerialPortInfo]) -> Result<Address, LinkError> {
    let at_usb = names(ports, |port| vendor(port).is_some());
    let st_links = names(ports, |port| vendor(port) == Some(ST_VENDOR));
    match (st_links.as_slice(), at_usb.as_slice()) {
        ([name], _) | ([], [name]) => Ok(Address::Serial(name.clone())),
        ([], []) => Err(LinkError::NoPort { others: names(ports, |_| true) }),
        ([], _) => Err(LinkError::ManyPorts(at_usb)),
        _ => Err(LinkError::ManyPorts(st_links)),
    }
}

fn names(ports: &[SerialPortInfo], wanted: impl Fn(&SerialPortInfo) -> bool) -> Vec<String> {
    ports.iter().filter(|port| wanted(port)).map(|port| port.port_name.clone()).collect()
}

/// The vendor's number, if the port is at USB.
fn vendor(port: &SerialPortInfo) -> Option<u16> {
    match &port.port_type {
        SerialPortType::UsbPort(usb) => Some(usb.vid),
        _ => None,
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
    use serialport::UsbPortInfo;

    use super::*;

    #[test]
    fn addresses_are_read_as_they_are_written() {
        for text in ["tcp:localhost:4000", "unix:/tmp/line", "/dev/ttyACM0"] {
            assert_eq!(Address::of(text).to_string(), text);
        }
        assert_eq!(Address::of("/dev/pts/7"), Address::Serial("/dev/pts/7".into()));
    }

    fn at_usb(name: &str, vid: u16) -> SerialPortInfo {
        let usb = UsbPortInfo {
            vid,
            pid: 1,
            serial_number: None,
            manufacturer: None,
            product: None,
            interface: None,
        };
        SerialPortInfo { port_name: name.to_owned(), port_type: SerialPortType::UsbPort(usb) }
    }

    fn built_in(name: &str) -> SerialPortInfo {
        SerialPortInfo { port_name: name.to_owned(), port_type: SerialPortType::PciPort }
    }

    fn taken(ports: &[SerialPortInfo]) -> String {
        among(ports).unwrap().to_string()
    }

    fn refused(ports: &[SerialPortInfo]) -> String {
        among(ports).unwrap_err().to_string()
    }

    #[test]
    fn ports_that_cannot_be_listed_are_told() {
        let error = found(Err(std::io::Error::other("no such thing"))).unwrap_err();
        assert_eq!(error.to_string(), "the serial ports cannot be listed: no such thing");
    }

    #[test]
    fn without_any_port_there_is_none() {
        assert_eq!(refused(&[]), "no USB serial port was found");
    }

    #[test]
    fn the_only_usb_port_is_taken_whoever_made_it() {
        for vid in [ST_VENDOR, 0x0403] {
            assert_eq!(
                taken(&[built_in("/dev/ttyS0"), at_usb("/dev/ttyUSB0", vid)]),
                "/dev/ttyUSB0"
            );
        }
    }

    #[test]
    fn of_several_usb_ports_the_only_st_link_is_taken() {
        let [other, st_link] = [at_usb("/dev/ttyUSB0", 0x0403), at_usb("/dev/ttyACM0", ST_VENDOR)];
        assert_eq!(taken(&[other.clone(), st_link.clone()]), "/dev/ttyACM0");
        assert_eq!(taken(&[st_link, built_in("/dev/ttyS0"), other]), "/dev/ttyACM0");
    }

    #[test]
    fn several_usb_ports_are_named_and_none_is_taken() {
        let [first, second] = ["/dev/ttyUSB0", "/dev/ttyUSB1"].map(|name| at_usb(name, 0x0403));
        let message = "2 serial ports were found: /dev/ttyUSB0, /dev/ttyUSB1";
        assert_eq!(refused(&[first.clone(), built_in("/dev/ttyS0"), second]), message);
        let st_links = ["/dev/ttyACM0", "/dev/ttyACM1"].map(|name| at_usb(name, ST_VENDOR));
        let ports = [&[first][..], &st_links].concat();
        assert_eq!(refused(&ports), "2 serial ports were found: /dev/ttyACM0, /dev/ttyACM1");
    }

    #[test]
    fn a_port_that_is_not_at_usb_is_named_and_not_taken() {
        let message = "no USB serial port was found; others are: /dev/ttyS0";
        assert_eq!(refused(&[built_in("/dev/ttyS0")]), message);
        let bluetooth = SerialPortType::BluetoothPort;
        let rfcomm = SerialPortInfo { port_name: "/dev/rfcomm0".into(), port_type: bluetooth };
        let message = "no USB serial port was found; others are: /dev/ttyS0, /dev/rfcomm0";
        assert_eq!(refused(&[built_in("/dev/ttyS0"), rfcomm]), message);
    }
}
