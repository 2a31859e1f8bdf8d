//! A session, from the upload to the ending, and what must hold in each of its milliseconds.

use std::rc::Rc;

use emulator::image::Image;
use emulator::machine::Machine;
use emulator::operator::Operator;
use emulator::registers::MS;
use firmware::ParameterBlock;
use firmware::link::{Command, Report};
use firmware::supervisor::{Fault, State};
use model::reference_robot::reference_robot;
use random_motions::Rng;
use rig::Rig;

use super::common::{done, encoded, told};
use super::counters::Counters;
use super::draw::block;
use super::ending::Ending;
use super::rig_bench::{RigBench, Switches};

/// The host's sign of life, and how long the board does without [ms].
const HEARTBEAT_MS: u64 = 100;
pub const HOST_TIMEOUT_MS: u16 = 1000;
/// Amplifier noise moves a joint at rest by less [rad/s].
const AT_REST_RAD_PER_S: f64 = 5e-3;
/// By then an arm that fell is at rest [ms].
const AT_REST_WITHIN_MS: u64 = 60_000;

pub struct Soak {
    pub operator: Operator,
    pub switches: Rc<Switches>,
    pub counters: Counters,
    pub rng: Rng,
    pub expected: Option<Fault>,
    pub committed: Option<ParameterBlock>,
    /// Runs take their time.
    is_long: bool,
    rig: Rig,
    sequence: Option<u32>,
    is_homed: bool,
}

impl Soak {
    pub fn new(image: &Rc<Image>, seed: u64, is_long: bool) -> Self {
        let (bench, switches) = RigBench::new();
        let machine = Machine::new(image.clone(), Box::new(bench)).unwrap();
        Self {
            operator: Operator::new(machine),
            switches,
            counters: Counters::default(),
            rng: Rng::new(seed),
            expected: None,
            committed: None,
            is_long,
            rig: Rig::new(reference_robot()),
            sequence: None,
            is_homed: false,
        }
    }

    pub fn hours(&self) -> f64 {
        self.counters.ms as f64 / 3.6e6
    }

    /// One session with this ending.
    pub fn session(&mut self, number: usize, ending: Ending) {
        self.begin_conversation();
        self.wait_for_rest();
        let at_rad = self.position_rad();
        let block = block(&self.rig, &mut self.rng, ending, at_rad);
        self.upload(&block, number.is_multiple_of(3) || ending == Ending::PowerCycle);
        self.arm(ending);
        if ending != Ending::DrivePowerWhileArmed {
            self.run(ending);
        }
        self.expected = ending.fault();
        self.end(ending);
        self.recover(ending);
        self.counters.endings[ending as usize] += 1;
        self.look_at_the_board();
    }

    /// After a reset too: the conversation begins anew, and the position is told.
    fn begin_conversation(&mut self) {
        self.pass(50);
        assert!(self.operator.hello().unwrap());
        self.ask(Command::Stream { on: true });
    }

    pub fn is_reset(&mut self) {
        (self.is_homed, self.sequence) = (false, None);
    }

    /// Joint by joint, within a turn [rad].
    fn position_rad(&self) -> [f32; 3] {
        let pi = std::f64::consts::PI;
        self.switches.position_rad.get().map(|q| ((q + pi).rem_euclid(2.0 * pi) - pi) as f32)
    }

    fn wait_for_rest(&mut self) {
        let end = self.counters.ms + AT_REST_WITHIN_MS;
        // The hand that turns the encoders after a reset.
        self.pass(1200);
        while self
            .switches
            .speed_rad_per_s
            .get()
            .iter()
            .any(|speed| speed.abs() > AT_REST_RAD_PER_S)
        {
            let speeds = self.switches.speed_rad_per_s.get();
            assert!(self.counters.ms < end, "the arm does not come to rest: {speeds:?}");
            self.pass(100);
        }
        self.pass(500);
    }

    fn upload(&mut self, block: &ParameterBlock, commit: bool) {
        assert_eq!(self.operator.upload(&encoded(block)).unwrap(), Some(Ok(())));
        self.ask(if commit { Command::Commit } else { Command::Use });
        self.counters.uploads += 1;
        if commit {
            self.counters.commits += 1;
            self.committed = Some(block.clone());
        }
    }

    fn arm(&mut self, ending: Ending) {
        // Whoever has turned the joints tells where they are; other sessions keep the position.
        if !self.is_homed || self.rng.below(4) == 0 {
            self.pass(200);
            let position = self.switches.position_rad.get();
            self.ask(Command::Home { position: told(position) });
            self.is_homed = true;
        }
        self.pass(200);
        assert_eq!(self.report().state, State::Disarmed, "{ending:?}");
        self.ask(Command::Arm);
        let armed_ms = self.rng.below(if self.is_long { 1000 } else { 100 });
        self.attend(u64::from(armed_ms));
    }

    fn run(&mut self, ending: Ending) {
        self.switches.amplifiers.set(ending != Ending::Stall);
        let host_timeout_ms = (ending != Ending::Alone).then_some(HOST_TIMEOUT_MS);
        self.ask(Command::Run { host_timeout_ms });
        let run_ms = match ending {
            Ending::Stall | Ending::Hold | Ending::Range => 20,
            _ if self.is_long => 10_000 + u64::from(self.rng.below(20_000)),
            _ => 500,
        };
        self.attend(run_ms);
        let report = self.report();
        assert_eq!((report.state, report.fault), (State::Running, None), "{ending:?}");
    }

    /// Lets the board run while the host gives signs of life [ms].
    pub fn attend(&mut self, ms: u64) {
        let end = self.counters.ms + ms;
        while self.counters.ms < end {
            self.ask(Command::Query);
            let left = end.saturating_sub(self.counters.ms);
            self.pass(left.min(HEARTBEAT_MS));
        }
    }

    pub fn ask(&mut self, command: Command<'_>) {
        done(&mut self.operator, command);
        self.counters.requests += 1;
        self.take_in();
    }

    pub fn report(&mut self) -> Report {
        let report = self.operator.query().unwrap().expect("an answer");
        self.counters.requests += 1;
        self.take_in();
        report
    }

    /// Lets the board run [ms].
    pub fn pass(&mut self, ms: u64) {
        for _ in 0..ms {
            self.operator.run_ms(1).unwrap();
            self.take_in();
        }
    }

    /// What must hold of everything that the board has told.
    fn take_in(&mut self) {
        let now_ms = self.operator.machine.board().now / MS;
        self.counters.ms = now_ms;
        for record in std::mem::take(&mut self.operator.telemetry) {
            let is_zero = record.codes.iter().all(|code| code.0 == 0);
            assert!(is_zero || record.state.drives(), "voltage while {}", record.state);
            let fault = record.fault.map(|(fault, _)| fault);
            assert!(fault.is_none() || fault == self.expected, "nobody injected {record:?}");
            // A board that was reset counts from zero.
            let last = self.sequence.filter(|last| *last < record.sequence);
            self.counters.missed += last.map_or(0, |last| u64::from(record.sequence - last - 1));
            self.sequence = Some(record.sequence);
            self.counters.records += 1;
            self.counters.ticks_in[record.state as usize] += 1;
        }
        assert_eq!(self.operator.strange, 0, "a frame that is none of the board's");
        let board = self.operator.machine.board();
        assert!(board.converter.is_released() || board.converter.volts() == [0.0; 3]);
    }

    fn look_at_the_board(&mut self) {
        self.counters.stack_bytes = self.operator.machine.stack_bytes();
        let resets = self.operator.machine.resets.len();
        assert_eq!(resets, self.counters.resets, "a reset that nobody made");
        let board = self.operator.machine.board();
        self.counters.longest_tick_cycles = board.trace.handler.most.cycles;
        assert!(self.counters.stack_bytes <= 64 << 10);
    }
}
