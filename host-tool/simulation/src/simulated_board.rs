//! A whole board in this process, at a simulated robot, behind a TCP port: for tests.

use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use firmware::link::BoardRuntime;
use firmware::store::{Layout, RamFlash, Store};
use model::Robot;

use crate::sensor::counts;
use crate::{Settings, SimulatedRobot};

/// The name in its Hello.
pub const NAME: &str = "simulated";
/// What 921,600 baud carry in a tick, each way [bytes].
const BYTES_PER_TICK: usize = 92;
const COUNTS_PER_TURN: u32 = 655_360;
const TURNING_TICKS: u16 = 1000;

type Flash = RamFlash<Vec<u8>>;

/// What the board is like.
#[derive(Clone, Debug)]
pub struct BoardSettings {
    /// The robot.
    pub robot: Robot<f64>,
    /// Where it is at rest at power-on [rad].
    pub position_rad: [f64; 3],
    /// The flash, as an earlier board has left it.
    pub flash: Vec<u8>,
    /// Seconds of the board in a second of this machine.
    pub speed: f64,
    /// one byte in so many is broken, in both directions; none without.
    pub bytes_per_error: Option<u32>,
    /// The encoders count from zero at power-on, wherever the robot is; within the second after
    /// it somebody turns each joint by hand, and back.
    pub incremental_encoders: bool,
    /// Encoders that count nothing.
    pub dead_encoders: [bool; 3],
}

impl BoardSettings {
    /// A robot hanging down, at a board that was never used, in real time.
    pub fn new(robot: Robot<f64>) -> Self {
        Self {
            robot,
            position_rad: model::HANGING_RAD,
            flash: vec![0xFF; Layout::G474.used_bytes() as usize],
            speed: 1.0,
            bytes_per_error: None,
            incremental_encoders: false,
            dead_encoders: [false; 3],
        }
    }
}

/// A board that runs until it is switched off.
#[derive(Debug)]
pub struct SimulatedBoard {
    address: SocketAddr,
    off: Arc<AtomicBool>,
    thread: Option<JoinHandle<Vec<u8>>>,
}

impl SimulatedBoard {
    /// Switches it on.
    ///
    /// # Errors
    /// The system gives no TCP port.
    pub fn start(settings: BoardSettings) -> std::io::Result<Self> {
        let listener = TcpListener::bind("127.0.0.1:0")?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let off = Arc::new(AtomicBool::new(false));
        let seen = off.clone();
        let thread = std::thread::spawn(move || BoardLoop::new(settings, listener).run(&seen));
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
    robot: SimulatedRobot,
    /// Where the encoders count zero.
    zero: [i64; 3],
    dead: [bool; 3],
    /// Ticks until nobody turns the joints by hand any more.
    turning_ticks: u16,
    command_v: [f64; 3],
    tick: Duration,
    noise: LineNoise,
}

impl BoardLoop {
    fn new(settings: BoardSettings, listener: TcpListener) -> Self {
        let simulation = Settings { sample_period_s: 1e-3, substeps: 10, noise_v: 0.004, seed: 1 };
        let robot = SimulatedRobot::at_rest(settings.robot, settings.position_rad, &simulation);
        let incremental = settings.incremental_encoders;
        let zero = if incremental { counts(&robot.reading_rad(), COUNTS_PER_TURN) } else { [0; 3] };
        Self {
            listener,
            connection: None,
            runtime: booted(settings.flash, incremental),
            zero,
            dead: settings.dead_encoders,
            turning_ticks: if incremental { TURNING_TICKS } else { 0 },
            robot,
            command_v: [0.0; 3],
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
        let now = counts(&self.robot.reading_rad(), COUNTS_PER_TURN);
        let turned = self.turned_by_hand();
        let counts = [0, 1, 2].map(|i| match self.dead[i] {
            true => 0,
            false => (now[i] - self.zero[i] + turned) as i32,
        });
        let health = self.runtime.health();
        let record = self.runtime.supervisor.tick(&counts, health);
        self.runtime.after_tick(&record);
        self.command_v = record.codes.map(|code| f64::from(code.to_volts()));
        self.robot.advance(&self.command_v);
    }

    /// How far a hand has turned each joint [counts].
    fn turned_by_hand(&mut self) -> i64 {
        self.turning_ticks = self.turning_ticks.saturating_sub(1);
        let phase = f64::from(self.turning_ticks) / f64::from(TURNING_TICKS);
        (10_000.0 * (std::f64::consts::PI * phase).sin().powi(2)) as i64
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
