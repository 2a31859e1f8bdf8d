//! A line between `rrr` and a simulated board that can be broken at a request.

use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::time::Duration;

use firmware::frame::FrameReader;
use firmware::link::{Command, ToBoard};
use simulation::simulated_board::SimulatedBoard;

/// What becomes of the line at a request, before the board hears it.
#[derive(Debug)]
pub enum Deed {
    Pass,
    /// From now on nothing passes, either way.
    Silence,
    /// It leads to another board from now on, as after a reset.
    LeadTo(String),
}

/// A line for one host; `port` is what `--port` takes.
pub struct Line {
    pub port: String,
}

impl Line {
    /// A line to a board; `watch` sees every request once.
    pub fn to(
        board: &SimulatedBoard,
        watch: impl FnMut(&Command<'_>) -> Deed + Send + 'static,
    ) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = format!("tcp:{}", listener.local_addr().unwrap());
        let board = connected(&board.port());
        std::thread::spawn(move || {
            let (host, _) = listener.accept().unwrap();
            let reader = FrameReader::new();
            let mut carrier =
                Carrier { host: quick(host), board, silent: false, reader, newest: 0, watch };
            while carrier.carry() {}
        });
        Self { port }
    }
}

/// What to do at the `query`-th sign of life of the `run`-th run, both from 1.
pub fn at_query(
    run: usize,
    query: usize,
    mut deed: impl FnMut() -> Deed + Send,
) -> impl FnMut(&Command<'_>) -> Deed + Send {
    let (mut runs, mut queries) = (0, 0);
    move |command| {
        match command {
            Command::Run { .. } => (runs, queries) = (runs + 1, 0),
            Command::Query => queries += 1,
            _ => {}
        }
        let is_now = (runs, queries) == (run, query) && *command == Command::Query;
        if is_now { deed() } else { Deed::Pass }
    }
}

struct Carrier<W> {
    host: TcpStream,
    board: TcpStream,
    silent: bool,
    reader: FrameReader,
    /// Number of the newest request.
    newest: u32,
    watch: W,
}

impl<W: FnMut(&Command<'_>) -> Deed> Carrier<W> {
    /// Carries what has come; false once an end is closed.
    fn carry(&mut self) -> bool {
        let (mut asked, mut answered) = ([0; 4096], [0; 4096]);
        let (Some(asked), Some(answered)) =
            (come(&mut self.host, &mut asked), come(&mut self.board, &mut answered))
        else {
            return false;
        };
        asked.iter().for_each(|&byte| self.look_at(byte));
        self.silent
            || (self.board.write_all(asked).is_ok() && self.host.write_all(answered).is_ok())
    }

    fn look_at(&mut self, byte: u8) {
        let Some(Ok(ToBoard::Request(request))) = self.reader.push(byte).map(ToBoard::read) else {
            return;
        };
        if request.number <= self.newest {
            return;
        }
        self.newest = request.number;
        match (self.watch)(&request.command) {
            Deed::Pass => {}
            Deed::Silence => self.silent = true,
            Deed::LeadTo(port) => self.board = connected(&port),
        }
    }
}

fn come<'b>(stream: &mut TcpStream, buffer: &'b mut [u8]) -> Option<&'b [u8]> {
    match stream.read(buffer) {
        Ok(0) => None,
        Ok(length) => Some(&buffer[..length]),
        Err(error) => {
            matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut).then_some(&[])
        }
    }
}

fn connected(port: &str) -> TcpStream {
    let address: SocketAddr = port.trim_start_matches("tcp:").parse().unwrap();
    quick(TcpStream::connect(address).unwrap())
}

fn quick(stream: TcpStream) -> TcpStream {
    stream.set_nodelay(true).unwrap();
    stream.set_read_timeout(Some(Duration::from_millis(1))).unwrap();
    stream
}
