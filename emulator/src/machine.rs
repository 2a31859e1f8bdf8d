//! The processor: Unicorn executes instructions, and what it lacks is done between them.

use std::cell::RefCell;
use std::rc::Rc;

use unicorn_engine::{Arch, ArmCpuModel, Mode, Prot, RegisterARM, Unicorn, uc_error};

use crate::board::{Board, Memory};
use crate::core::exceptions::{ENTRY_CYCLES, RETURN_CYCLES, enter, get, leave, put};
use crate::core::nvic::HARD_FAULT;
use crate::failure::Failure;
use crate::image::Image;
use crate::memory_map::{
    AHB2, BANK_BYTES, BANK2_START, CORE, FLASH_START, PERIPHERALS, PINS, RAM_BYTES, RAM_START,
};
use crate::plant::Plant;
use crate::registers::Time;
use crate::registers::rcc::Reset;

/// No code is here; the engine wants an address at which to end.
const NOWHERE: u64 = 0xF000_0000;
/// The engine's number of a return from an exception.
const EXCEPTION_RETURN: u32 = 8;
/// Opcodes: wait for an event, send one, unmask interrupts.
const WAIT_FOR_EVENT: u16 = 0xBF20;
const SEND_EVENT: u16 = 0xBF40;
const UNMASK: u16 = 0xB662;
const MOVE_TO_SPECIAL: u16 = 0xF380;

/// Steps in which the time may stand still: an event, an entry, a return.
const STILL_STEPS: u32 = 1000;

/// What stopped the engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Stop {
    /// An exception of the engine.
    exception: Option<u32>,
    /// The program waits for an event.
    waits: bool,
    /// The instruction that is about to be executed.
    at: u32,
    /// Interrupts were just unmasked while one was pending.
    watches: bool,
    /// The instruction before may have unmasked interrupts.
    unmasked: bool,
    event: bool,
}

/// A board that executes an image.
pub struct Machine {
    pub(crate) engine: Unicorn<'static, ()>,
    board: Rc<RefCell<Board>>,
    stop: Rc<RefCell<Stop>>,
    image: Rc<Image>,
    asleep: bool,
    /// Resets since the first power-on, with their times.
    pub resets: Vec<(Reset, Time)>,
    /// Lowest address of the stack at an entry to an exception.
    pub lowest_stack: u32,
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
            lowest_stack: u32::MAX,
            deepest: 0,
        };
        machine.begin()?;
        Ok(machine)
    }

    /// The board.
    pub fn board(&self) -> std::cell::RefMut<'_, Board> {
        self.board.borrow_mut()
    }

    /// A byte string of the RAM.
    pub fn ram(&self, address: u32, bytes: usize) -> Vec<u8> {
        self.engine.mem_read_as_vec(u64::from(address), bytes).unwrap_or_default()
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
            let noise: Vec<u8> = (0..RAM_BYTES).map(|i| (i * 197 + i / 251) as u8).collect();
            self.set_ram(RAM_START, &noise);
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
        let frame = enter(&mut self.engine, number, vector, depth)?;
        self.asleep = false;
        self.stop.borrow_mut().event = true;
        self.lowest_stack = self.lowest_stack.min(frame);
        self.deepest = self.deepest.max(depth + 1);
        let mut board = self.board.borrow_mut();
        board.nvic.enter(number);
        board.now += ENTRY_CYCLES;
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
        match (stop.exception, ended) {
            (Some(EXCEPTION_RETURN), _) => self.leave(),
            (Some(number), _) => self.fault(number, stop.at),
            (None, Err(why)) => {
                let place = format!("{:#010x} {}", stop.at, self.image.place(stop.at));
                Err(Failure::Engine { place, why: format!("{why:?}") })
            }
            (None, Ok(())) if stop.waits => self.wait(),
            (None, Ok(())) => Ok(()),
        }
    }

    fn leave(&mut self) -> Result<(), Failure> {
        let code = get(&self.engine, RegisterARM::PC)? | 1;
        let running = {
            let mut board = self.board.borrow_mut();
            board.catch_up();
            board.set_lines();
            board.now += RETURN_CYCLES;
            board.nvic.leave();
            board.nvic.running()
        };
        self.stop.borrow_mut().event = true;
        leave(&mut self.engine, code, running)
    }

    /// A fault of the core; one inside its own handler would lock the chip up.
    fn fault(&mut self, number: u32, at: u32) -> Result<(), Failure> {
        let place = format!("{at:#010x} {}", self.image.place(at));
        if self.board.borrow().nvic.running() == HARD_FAULT {
            return Err(Failure::Core(format!("lock-up: fault {number} at {place}")));
        }
        put(&mut self.engine, RegisterARM::PC, at | 1)?;
        self.board.borrow_mut().trace.faults.push(place);
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
                let place = format!("{at:#010x} {}", self.image.place(at));
                Failure::Access { kind, bytes, address, refusal, place }
            }
            other => other,
        }
    }
}

/// The RAM, for the DMA.
struct Ram<'a>(&'a mut Unicorn<'static, ()>);

impl Memory for Ram<'_> {
    fn read(&mut self, address: u32) -> Option<u8> {
        let mut byte = [0];
        self.0.mem_read(u64::from(address), &mut byte).ok()?;
        Some(byte[0])
    }

    fn write(&mut self, address: u32, byte: u8) -> bool {
        let end = RAM_START + RAM_BYTES as u32;
        (RAM_START..end).contains(&address) && self.0.mem_write(u64::from(address), &[byte]).is_ok()
    }
}

type Shared<T> = Rc<RefCell<T>>;

fn engine(
    image: &Image,
    board: &Shared<Board>,
    stop: &Shared<Stop>,
) -> Result<Unicorn<'static, ()>, uc_error> {
    let mut engine = Unicorn::new(Arch::ARM, Mode::THUMB | Mode::MCLASS)?;
    engine.ctl_set_cpu_model(ArmCpuModel::CORTEX_M4 as i32)?;
    engine.mem_map(u64::from(FLASH_START), BANK_BYTES as u64, Prot::READ | Prot::EXEC)?;
    engine.mem_write(u64::from(FLASH_START), &image.flash[..BANK_BYTES])?;
    engine.mem_map(u64::from(RAM_START), RAM_BYTES as u64, Prot::READ | Prot::WRITE)?;
    let bank2 = (BANK2_START, BANK_BYTES as u32);
    for (start, length) in [bank2, PERIPHERALS, PINS, AHB2, CORE] {
        map_registers(&mut engine, start, length, board)?;
    }
    watch_instructions(&mut engine, image, board, stop)?;
    let seen = stop.clone();
    engine.add_intr_hook(move |engine, number| {
        seen.borrow_mut().exception = Some(number);
        let _ = engine.emu_stop();
    })?;
    Ok(engine)
}

fn map_registers(
    engine: &mut Unicorn<'static, ()>,
    start: u32,
    length: u32,
    board: &Shared<Board>,
) -> Result<(), uc_error> {
    let (reads, writes) = (board.clone(), board.clone());
    let read = move |engine: &mut Unicorn<'_, ()>, offset: u64, bytes: usize| {
        let address = start + offset as u32;
        let mut board = reads.borrow_mut();
        let value = board.read(address, bytes);
        value.unwrap_or_else(|refusal| {
            let place = String::new();
            let kind = "read";
            board.failure.get_or_insert(Failure::Access { kind, bytes, address, place, refusal });
            let _ = engine.emu_stop();
            0
        })
    };
    let write = move |engine: &mut Unicorn<'_, ()>, offset: u64, bytes: usize, value: u64| {
        let address = start + offset as u32;
        let mut board = writes.borrow_mut();
        if let Err(refusal) = board.write(address, bytes, value as u32) {
            let place = String::new();
            let kind = "write";
            board.failure.get_or_insert(Failure::Access { kind, bytes, address, place, refusal });
            let _ = engine.emu_stop();
        }
    };
    engine.mmio_map(u64::from(start), u64::from(length), Some(read), Some(write))
}

/// Before each instruction: the time it takes, and whether the engine is to stop before it.
fn watch_instructions(
    engine: &mut Unicorn<'static, ()>,
    image: &Image,
    board: &Shared<Board>,
    stop: &Shared<Stop>,
) -> Result<(), uc_error> {
    let (board, stop) = (board.clone(), stop.clone());
    let code: Vec<u16> = image.flash[..BANK_BYTES]
        .chunks_exact(2)
        .map(|halfword| u16::from_le_bytes([halfword[0], halfword[1]]))
        .collect();
    let first = u64::from(FLASH_START);
    let last = first + BANK_BYTES as u64;
    let watch = move |engine: &mut Unicorn<'_, ()>, address: u64, bytes: u32| {
        let mut board = board.borrow_mut();
        let mut stop = stop.borrow_mut();
        stop.at = address as u32;
        let opcode = code[(address - first) as usize / 2];
        let unmasked = std::mem::replace(
            &mut stop.unmasked,
            opcode == UNMASK || opcode & 0xFFF0 == MOVE_TO_SPECIAL,
        );
        if board.now >= board.stop_at || stop.watches && unmasked {
            let _ = engine.emu_stop();
            return;
        }
        if opcode == WAIT_FOR_EVENT {
            stop.waits = true;
            let _ = engine.emu_stop();
            return;
        }
        stop.event |= opcode == SEND_EVENT;
        let cycles = board.cost.of(address as u32, bytes);
        board.now += cycles;
        board.instructions += 1;
    };
    engine.add_code_hook(first, last, watch)?;
    Ok(())
}
