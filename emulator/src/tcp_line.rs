//! The serial line as a TCP port, to which `rrr` connects.

use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::failure::Failure;
use crate::machine::Machine;
use crate::registers::MS;
use crate::registers::lpuart::Lpuart;

/// Bytes that may wait for the line; the rest waits in the socket. Two milliseconds of the line.
const WAITING_BYTES: usize = 184;
/// So far behind, the time that was lost is not caught up.
const FAR_BEHIND: Duration = Duration::from_millis(50);

/// A port of this machine; a new connection replaces the one before.
pub struct TcpLine {
    listener: TcpListener,
    connection: Option<TcpStream>,
}

impl TcpLine {
    /// Listens at an address.
    ///
    /// # Errors
    /// The system does not give it.
    pub fn open(address: SocketAddr) -> std::io::Result<Self> {
        let listener = TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        Ok(Self { listener, connection: None })
    }

    /// Where it is.
    ///
    /// # Errors
    /// The system does not tell.
    pub fn address(&self) -> std::io::Result<SocketAddr> {
        self.listener.local_addr()
    }

    /// Bytes from the host to the board, and back.
    pub fn exchange(&mut self, board: &mut Lpuart) {
        if let Ok((stream, _)) = self.listener.accept() {
            // What the system refuses makes the line slower, no more.
            let _ = stream.set_nonblocking(true);
            let _ = stream.set_nodelay(true);
            self.connection = Some(stream);
        }
        let sent = std::mem::take(&mut board.outgoing);
        let Some(mut connection) = self.connection.take() else { return };
        let mut bytes = [0; WAITING_BYTES];
        let room = WAITING_BYTES.saturating_sub(board.incoming.len());
        let is_open = match connection.read(&mut bytes[..room]) {
            Ok(0) => room == 0,
            Ok(length) => {
                board.incoming.extend(&bytes[..length]);
                true
            }
            Err(error) => error.kind() == ErrorKind::WouldBlock,
        };
        // A host that does not read loses bytes, as at a serial line.
        let _ = connection.write(&sent);
        self.connection = is_open.then_some(connection);
    }
}

/// Lets a board run with its line at a port until `off`; seconds of the board in a second.
///
/// # Errors
/// The image did what is not modelled.
pub fn serve(
    machine: &mut Machine,
    line: &mut TcpLine,
    speed: f64,
    off: &AtomicBool,
) -> Result<(), Failure> {
    let step = Duration::from_secs_f64(1e-3 / speed);
    let mut due = Instant::now();
    let mut told = machine.resets.len();
    while !off.load(Ordering::Relaxed) {
        due += step;
        match due.checked_duration_since(Instant::now()) {
            Some(early) => std::thread::sleep(early),
            None if due.elapsed() > FAR_BEHIND => due = Instant::now(),
            None => {}
        }
        let end = machine.board().now + MS;
        machine.run_until(end)?;
        line.exchange(&mut machine.board().lpuart);
        for (reset, at) in &machine.resets[told..] {
            println!("reset at {} ms: {reset:?}", at / MS);
        }
        told = machine.resets.len();
    }
    Ok(())
}
