//! The processor: Unicorn executes instructions, and what it lacks is done between them.

use std::cell::{RefCell, RefMut};
use std::rc::Rc;

use unicorn_engine::{RegisterARM, Unicorn, uc_error};

use crate::advance::TIM6;
use crate::board::Board;
use crate::core::exceptions::{ENTRY_CYCLES, RETURN_CYCLES, enter, get, leave, put};
use crate::core::nvic::{FIRST_LINE, HARD_FAULT};
use crate::engine::{Shared, Stop, engine};
use crate::failure::Failure;
use crate::image::Image;
use crate::memory_map::{CCM_BYTES, CCM_START, FLASH_START, RAM_BYTES, RAM_START};
use crate::plant::Plant;
use crate::ram::Ram;
use crate::registers::Time;
use crate::registers::rcc::Reset;

/// No code is here; the engine wants an address at which to end.
const NOWHERE: u64 = 0xF000_0000;
/// The engine's number of a return from an exception.
const EXCEPTION_RETURN: u32 = 8;
/// The engine's number of an instruction that is none.
const UNDEFINED: u32 = 1;
/// The exception of TIM6.
const TICK: usize = FIRST_LINE + TIM6;
/// Steps in which the time may stand still: an event, an entry, a return.
const STILL_STEPS: u32 = 1000;

/// Room of the variables, as `cargo xtask firmware` allows it.
const VARIABLES_BYTES: usize = 32 << 10;

/// What the RAM has at a power-on.
fn noise() -> Vec<u8> {
    (0..RAM_BYTES).map(|i| (i * 197 + i / 251) as u8).collect()
}

/// A board that executes an image.
pub struct Machine {
    pub(crate) engine: Unicorn<'static, ()>,
    board: Shared<Board>,
    stop: Shared<Stop>,
    image: Rc<Image>,
    asleep: bool,
    /// Resets since the first power-on, with their times.
    pub resets: Vec<(Reset, Time)>,
    /// Exceptions that saved floating-point registers.
    pub floating_frames: u64,
    /// Most exceptions that were active at once.
    pub deepest: usize,
}

impl Machine {
    /// A board before its first power-on, with an image in its flash.
    ///
    /// # Errors
    /// The engine does not start.
    pub fn new(image: Rc<Image>, plant: Box<dyn Plant>) -> Result<Self, Failure> {
        let board = Rc::new(RefCell::new(Board::new(image.flash.clone(), plant)));
        let stop = Rc::new(RefCell::new(Stop::default()));
        let engine = engine(&image, &board, &stop)
            .map_err(|why| Failure::Core(format!("the engine does not start: {why:?}")))?;
        let mut machine = Self {
            engine,
            board,
            stop,
            image,
            asleep: false,
            resets: Vec::new(),
            floating_frames: 0,
            deepest: 0,
        };
        machine.set_ram(RAM_START, &noise());
        machine.begin()?;
        Ok(machine)
    }

    /// The board.
    pub fn board(&self) -> RefMut<'_, Board> {
        self.board.borrow_mut()
    }

    /// A byte string of the RAM.
    pub fn ram(&self, address: u32, bytes: usize) -> Vec<u8> {
        self.engine.mem_read_as_vec(u64::from(address), bytes).unwrap_or_default()
    }

    /// How far the stack has come down since power-on [bytes]; above the first 32 KiB, which hold
    /// the variables.
    pub fn stack_bytes(&self) -> usize {
        let (ram, noise) = (self.ram(RAM_START, RAM_BYTES), noise());
        let lowest = (VARIABLES_BYTES..RAM_BYTES).find(|i| ram[*i] != noise[*i]);
        RAM_BYTES - lowest.unwrap_or(RAM_BYTES)
    }

    /// Puts bytes into the RAM, as a fault of the memory would.
    pub fn set_ram(&mut self, address: u32, bytes: &[u8]) {
        // Outside the RAM there is nothing to put them into.
        let _ = self.engine.mem_write(u64::from(address), bytes);
    }

    /// Resets the chip; at a power-on, its RAM has anything.
    ///
    /// # Errors
    /// The vectors lead nowhere.
    pub fn reset(&mut self, reset: Reset) -> Result<(), Failure> {
        let now = self.board().now;
        self.resets.push((reset, now));
        self.board().reset(reset);
        if reset == Reset::PowerOn {
            self.set_ram(CCM_START, &noise()[..CCM_BYTES]);
            self.set_ram(RAM_START, &noise());
        }
        self.begin()
    }

    /// Ends a wait for an event.
    pub(crate) fn wake(&mut self) {
        self.asleep = false;
    }

    fn begin(&mut self) -> Result<(), Failure> {
        let [stack, entry] = [0, 1].map(|index| self.vector(index));
        self.asleep = false;
        *self.stop.borrow_mut() = Stop::default();
        put(&mut self.engine, RegisterARM::XPSR_NZCVQG, 1 << 24)?;
        put(&mut self.engine, RegisterARM::PRIMASK, 0)?;
        put(&mut self.engine, RegisterARM::CONTROL, 0)?;
        put(&mut self.engine, RegisterARM::FPSCR, 0)?;
        put(&mut self.engine, RegisterARM::SP, stack)?;
        put(&mut self.engine, RegisterARM::LR, u32::MAX)?;
        put(&mut self.engine, RegisterARM::PC, entry)
    }

    /// A vector; after a reset they are at the begin of the flash.
    fn vector(&self, index: usize) -> u32 {
        let board = self.board.borrow();
        let at = board.system.vectors.saturating_sub(FLASH_START) as usize + 4 * index;
        let bytes = board.flash.bytes.get(at..at + 4);
        bytes.map_or(0, |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
    }

    /// Runs to a point of time; resets on the way are noted.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn run_until(&mut self, end: Time) -> Result<(), Failure> {
        let mut still = 0;
        while self.board.borrow().now < end {
            let before = self.board.borrow().now;
            self.step(end)?;
            still = if self.board.borrow().now == before { still + 1 } else { 0 };
            if still > STILL_STEPS {
                return Err(Failure::Core(format!("the time stands still at {before}")));
            }
        }
        Ok(())
    }

    /// Runs to the next event, or until an exception begins or ends.
    ///
    /// # Errors
    /// The image did what is not modelled.
    pub fn step(&mut self, end: Time) -> Result<(), Failure> {
        let reset = self.board.borrow_mut().advance(&mut Ram(&mut self.engine));
        if let Some(failure) = self.board.borrow_mut().failure.take() {
            return Err(failure);
        }
        if let Some(reset) = reset {
            return self.reset(reset);
        }
        if self.board.borrow().flash.is_cut() {
            self.board.borrow_mut().flash.cut_at = None;
            return self.reset(Reset::PowerOn);
        }
        let next = self.board.borrow().nvic.next();
        if let Some((number, maskable)) = next {
            let masked = maskable && get(&self.engine, RegisterARM::PRIMASK)? & 1 == 1;
            if !masked {
                return self.enter(number);
            }
        }
        let until = self.board.borrow().next_event().min(end);
        if self.asleep {
            let now = self.board.borrow().now;
            self.board.borrow_mut().now = until.max(now + 1);
            return Ok(());
        }
        self.execute(until, next.is_some())
    }

    fn enter(&mut self, number: usize) -> Result<(), Failure> {
        let vector = self.vector(number);
        let depth = self.board.borrow().nvic.depth();
        let floating = enter(&mut self.engine, number, vector, depth)?;
        self.floating_frames += u64::from(floating);
        self.asleep = false;
        self.stop.borrow_mut().event = true;
        self.deepest = self.deepest.max(depth + 1);
        let mut board = self.board.borrow_mut();
        board.nvic.enter(number);
        board.now += ENTRY_CYCLES;
        if number == TICK {
            let now = board.cost_so_far();
            board.trace.handler.enter(now);
        }
        Ok(())
    }

    fn execute(&mut self, until: Time, watches: bool) -> Result<(), Failure> {
        self.board.borrow_mut().stop_at = until;
        {
            let mut stop = self.stop.borrow_mut();
            (stop.exception, stop.waits) = (None, false);
            (stop.watches, stop.unmasked) = (watches, false);
        }
        let pc = get(&self.engine, RegisterARM::PC)?;
        let ended = self.engine.emu_start(u64::from(pc | 1), NOWHERE, 0, 0);
        let stop = *self.stop.borrow();
        if let Some(failure) = self.board.borrow_mut().failure.take() {
            return Err(self.placed(failure, stop.at));
        }
        self.after(stop, ended)
    }

    /// What the engine stopped for.
    fn after(&mut self, stop: Stop, ended: Result<(), uc_error>) -> Result<(), Failure> {
        match (stop.exception, ended) {
            (Some(EXCEPTION_RETURN), _) => self.leave(),
            (Some(number), _) => self.fault(number, stop.at),
            (None, Err(uc_error::INSN_INVALID)) => self.fault(UNDEFINED, stop.at),
            (None, Err(why)) => {
                Err(Failure::Engine { place: self.place(stop.at), why: format!("{why:?}") })
            }
            (None, Ok(())) if stop.waits => self.wait(),
            (None, Ok(())) => Ok(()),
        }
    }

    /// An instruction and the symbol below it, in words.
    fn place(&self, at: u32) -> String {
        format!("{at:#010x} {}", self.image.place(at))
    }

    fn leave(&mut self) -> Result<(), Failure> {
        let code = get(&self.engine, RegisterARM::PC)? | 1;
        let running = {
            let mut board = self.board.borrow_mut();
            board.catch_up();
            board.set_lines();
            board.now += RETURN_CYCLES;
            if board.nvic.leave() == Some(TICK) {
                let (now, updates) = (board.cost_so_far(), board.tim6.updates);
                board.trace.handler.leave(now, updates);
            }
            board.nvic.running()
        };
        self.stop.borrow_mut().event = true;
        leave(&mut self.engine, code, running)
    }

    /// A fault of the core; one inside its own handler would lock the chip up.
    fn fault(&mut self, number: u32, at: u32) -> Result<(), Failure> {
        let place = self.place(at);
        if self.board.borrow().nvic.running() == HARD_FAULT {
            return Err(Failure::Core(format!("lock-up: fault {number} at {place}")));
        }
        put(&mut self.engine, RegisterARM::PC, at | 1)?;
        self.board.borrow_mut().trace.faults.push(place);
        // UNDEFINSTR of the usage faults, PRECISERR of the bus faults.
        self.board.borrow_mut().system.fault_status =
            if number == UNDEFINED { 1 << 16 } else { 1 << 9 };
        self.enter(HARD_FAULT)
    }

    fn wait(&mut self) -> Result<(), Failure> {
        let pc = get(&self.engine, RegisterARM::PC)?;
        put(&mut self.engine, RegisterARM::PC, (pc + 2) | 1)?;
        let mut stop = self.stop.borrow_mut();
        self.asleep = !std::mem::take(&mut stop.event);
        Ok(())
    }

    fn placed(&self, failure: Failure, at: u32) -> Failure {
        match failure {
            Failure::Access { kind, bytes, address, refusal, .. } => {
                let place = self.place(at);
                Failure::Access { kind, bytes, address, refusal, place }
            }
            other => other,
        }
    }
}
