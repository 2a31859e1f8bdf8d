//! A whole board in this process, at a simulated robot, behind a TCP port: to practise on, and
//! for tests.

use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use firmware::link::BoardRuntime;
use firmware::store::{Layout, RamFlash, Store};
use model::Robot;
use rig::effects::Effect;

use crate::arm::{ArmSettings, SimulatedArm};

/// The name in its Hello.
pub const NAME: &str = "simulated";
/// What 921,600 baud carry in a tick, each way [bytes].
const BYTES_PER_TICK: usize = 92;

type Flash = RamFlash<Vec<u8>>;

/// What the board is like.
#[derive(Clone, Debug)]
pub struct BoardSettings {
    /// The arm that it drives.
    pub arm: ArmSettings,
    /// The flash, as an earlier board has left it.
    pub flash: Vec<u8>,
    /// Seconds of the board in a second of this machine.
    pub speed: f64,
    /// one byte in so many is broken, in both directions; none without.
    pub bytes_per_error: Option<u32>,
    /// Where its line is; port 0 for whichever is free.
    pub address: SocketAddr,
}

impl BoardSettings {
    /// A robot hanging down, at a board that was never used, in real time.
    pub fn new(robot: Robot<f64>) -> Self {
        Self {
            arm: ArmSettings::new(robot),
            flash: erased_flash(),
            speed: 1.0,
            bytes_per_error: None,
            address: (Ipv4Addr::LOCALHOST, 0).into(),
        }
    }
}

/// The flash of a board that was never used.
pub fn erased_flash() -> Vec<u8> {
    vec![0xFF; Layout::G474.used_bytes() as usize]
}

/// A board that runs until it is switched off.
#[derive(Debug)]
pub struct SimulatedBoard {
    address: SocketAddr,
    off: Arc<AtomicBool>,
    thread: Option<JoinHandle<Vec<u8>>>,
}

impl SimulatedBoard {
    /// Switches it on, at an arm that is as its model says.
    ///
    /// # Errors
    /// The system does not give the TCP port.
    pub fn start(settings: BoardSettings) -> std::io::Result<Self> {
        Self::start_with_effects(settings, Vec::new())
    }

    /// Switches it on, at an arm that has these effects.
    ///
    /// # Errors
    /// The system does not give the TCP port.
    pub fn start_with_effects(
        settings: BoardSettings,
        effects: Vec<Box<dyn Effect>>,
    ) -> std::io::Result<Self> {
        let listener = TcpListener::bind(settings.address)?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let off = Arc::new(AtomicBool::new(false));
        let seen = off.clone();
        let thread =
            std::thread::spawn(move || BoardLoop::new(settings, effects, listener).run(&seen));
        Ok(Self { address, off, thread: Some(thread) })
    }

    /// What `--port` takes.
    pub fn port(&self) -> String {
        format!("tcp:{}", self.address)
    }

    /// Switches it off; what its flash holds then.
    pub fn switch_off(mut self) -> Vec<u8> {
        self.off.store(true, Ordering::Relaxed);
        let flash = self.thread.take().map(JoinHandle::join);
        flash.and_then(Result::ok).unwrap_or_default()
    }
}

impl Drop for SimulatedBoard {
    fn drop(&mut self) {
        self.off.store(true, Ordering::Relaxed);
    }
}

struct BoardLoop {
    listener: TcpListener,
    connection: Option<TcpStream>,
    runtime: BoardRuntime<Store<Flash>>,
    arm: SimulatedArm,
    tick: Duration,
    noise: LineNoise,
}

impl BoardLoop {
    fn new(settings: BoardSettings, effects: Vec<Box<dyn Effect>>, listener: TcpListener) -> Self {
        Self {
            listener,
            connection: None,
            runtime: booted(settings.flash, settings.arm.incremental_encoders),
            arm: SimulatedArm::new(&settings.arm, effects),
            tick: Duration::from_secs_f64(1e-3 / settings.speed),
            noise: LineNoise { bytes_per_error: settings.bytes_per_error, state: 1 },
        }
    }

    fn run(mut self, off: &AtomicBool) -> Vec<u8> {
        let mut due = Instant::now();
        while !off.load(Ordering::Relaxed) {
            due += self.tick;
            match due.checked_duration_since(Instant::now()) {
                Some(early) => std::thread::sleep(early),
                // Far behind: the time that was lost is not caught up.
                None if due.elapsed() > Duration::from_millis(50) => due = Instant::now(),
                None => {}
            }
            self.tick();
            self.serve();
        }
        let empty = Store::new(RamFlash::new(Vec::new()), 0, Layout::G474);
        let store = std::mem::replace(self.runtime.handler.store(), empty);
        store.into_flash().bytes().to_vec()
    }

    fn tick(&mut self) {
        let counts = self.arm.counts();
        let health = self.runtime.health();
        let record = self.runtime.supervisor.tick(&counts, health);
        self.runtime.after_tick(&record);
        self.arm.advance(&record.codes.map(|code| f64::from(code.to_volts())));
    }

    /// A tick's worth of the line; a new connection replaces the one before.
    fn serve(&mut self) {
        if let Ok((stream, _)) = self.listener.accept() {
            let _ = stream.set_nonblocking(true);
            let _ = stream.set_nodelay(true);
            self.connection = Some(stream);
        }
        let Some(mut connection) = self.connection.take() else { return };
        let mut bytes = [0; BYTES_PER_TICK];
        let is_open = match connection.read(&mut bytes) {
            Ok(0) => false,
            Ok(length) => {
                bytes[..length].iter().for_each(|&byte| {
                    self.runtime.receive(self.noise.corrupt(byte));
                });
                true
            }
            Err(error) => error.kind() == ErrorKind::WouldBlock,
        };
        let sent: Vec<u8> = (0..BYTES_PER_TICK)
            .map_while(|_| self.runtime.send())
            .map(|byte| self.noise.corrupt(byte))
            .collect();
        // A host that does not read loses bytes, as at a serial line.
        let _ = connection.write(&sent);
        self.connection = is_open.then_some(connection);
    }
}

/// Corrupts one byte in so many.
struct LineNoise {
    bytes_per_error: Option<u32>,
    state: u32,
}

impl LineNoise {
    fn corrupt(&mut self, byte: u8) -> u8 {
        let Some(mean) = self.bytes_per_error else { return byte };
        self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        match (self.state >> 8) % mean {
            0 => byte ^ 1 << (self.state >> 29),
            _ => byte,
        }
    }
}

fn booted(flash: Vec<u8>, position_lost: bool) -> BoardRuntime<Store<Flash>> {
    let store = Store::new(RamFlash::new(flash), Layout::G474.bank_start, Layout::G474);
    BoardRuntime::boot(store, NAME, nonce_seed(), position_lost).0
}

/// Different at every power-on, which is all that a simulated board needs.
fn nonce_seed() -> [u8; 16] {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    now.unwrap_or_default().as_nanos().to_le_bytes()
}
