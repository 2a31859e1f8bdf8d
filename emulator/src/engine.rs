//! Unicorn, set up: memory, registers by callbacks, a look at each instruction before it is executed.

use std::cell::RefCell;
use std::rc::Rc;

use unicorn_engine::{Arch, ArmCpuModel, Mode, Prot, Unicorn, uc_error};

use crate::board::Board;
use crate::failure::{Failure, Refusal};
use crate::image::Image;
use crate::memory_map::{
    AHB2, BANK_BYTES, BANK2_START, CCM_BYTES, CCM_START, CORE, FLASH_START, PERIPHERALS, PINS,
    RAM_BYTES, RAM_START,
};

/// Opcodes: wait for an event, send one, unmask interrupts.
const WAIT_FOR_EVENT: u16 = 0xBF20;
const SEND_EVENT: u16 = 0xBF40;
const UNMASK: u16 = 0xB662;
const MOVE_TO_SPECIAL: u16 = 0xF380;

/// Its last address.
const CCM_END: u64 = CCM_START as u64 + CCM_BYTES as u64 - 1;

/// What stopped the engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stop {
    /// An exception of the engine.
    pub exception: Option<u32>,
    /// The program waits for an event.
    pub waits: bool,
    /// The instruction that is about to be executed.
    pub at: u32,
    /// Interrupts were just unmasked while one was pending.
    pub watches: bool,
    /// The instruction before may have unmasked interrupts.
    pub unmasked: bool,
    /// An event that no wait has taken yet.
    pub event: bool,
}

/// What engine and machine both work on.
pub type Shared<T> = Rc<RefCell<T>>;

/// The engine at a board, before its first instruction.
///
/// # Errors
/// Those of Unicorn.
pub fn engine(
    image: &Image,
    board: &Shared<Board>,
    stop: &Shared<Stop>,
) -> Result<Unicorn<'static, ()>, uc_error> {
    let mut engine = Unicorn::new(Arch::ARM, Mode::THUMB | Mode::MCLASS)?;
    engine.ctl_set_cpu_model(ArmCpuModel::CORTEX_M4 as i32)?;
    map_memory(&mut engine, image, board)?;
    watch_instructions(&mut engine, image, board, stop)?;
    let seen = stop.clone();
    engine.add_intr_hook(move |engine, number| {
        seen.borrow_mut().exception = Some(number);
        halt(engine);
    })?;
    Ok(engine)
}

fn map_memory(
    engine: &mut Unicorn<'static, ()>,
    image: &Image,
    board: &Shared<Board>,
) -> Result<(), uc_error> {
    engine.mem_map(u64::from(FLASH_START), BANK_BYTES as u64, Prot::READ | Prot::EXEC)?;
    engine.mem_write(u64::from(FLASH_START), &image.flash[..BANK_BYTES])?;
    engine.mem_map(u64::from(RAM_START), RAM_BYTES as u64, Prot::READ | Prot::WRITE)?;
    engine.mem_map(u64::from(CCM_START), CCM_BYTES as u64, Prot::ALL)?;
    let bank2 = (BANK2_START, BANK_BYTES as u32);
    for (start, length) in [bank2, PERIPHERALS, PINS, AHB2, CORE] {
        map_registers(engine, start, length, board)?;
    }
    Ok(())
}

/// Stops the engine before the next instruction; the engine cannot but take it.
fn halt(engine: &mut Unicorn<'_, ()>) {
    let _ = engine.emu_stop();
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
        board.read(address, bytes).unwrap_or_else(|refusal| {
            refuse(engine, &mut board, ("read", bytes, address), refusal);
            0
        })
    };
    let write = move |engine: &mut Unicorn<'_, ()>, offset: u64, bytes: usize, value: u64| {
        let address = start + offset as u32;
        let mut board = writes.borrow_mut();
        if let Err(refusal) = board.write(address, bytes, value as u32) {
            refuse(engine, &mut board, ("write", bytes, address), refusal);
        }
    };
    engine.mmio_map(u64::from(start), u64::from(length), Some(read), Some(write))
}

/// Ends the run; the machine knows which instruction it was.
fn refuse(
    engine: &mut Unicorn<'_, ()>,
    board: &mut Board,
    (kind, bytes, address): (&'static str, usize, u32),
    refusal: Refusal,
) {
    let place = String::new();
    board.failure.get_or_insert(Failure::Access { kind, bytes, address, place, refusal });
    halt(engine);
}

fn watch_instructions(
    engine: &mut Unicorn<'static, ()>,
    image: &Image,
    board: &Shared<Board>,
    stop: &Shared<Stop>,
) -> Result<(), uc_error> {
    let (board, stop) = (board.clone(), stop.clone());
    let halfwords = image.flash[..BANK_BYTES].chunks_exact(2);
    let code: Vec<u16> = halfwords.map(|h| u16::from_le_bytes([h[0], h[1]])).collect();
    let first = u64::from(FLASH_START);
    let code_at = move |engine: &mut Unicorn<'_, ()>, address: u64| {
        if let Some(opcode) = code.get((address.wrapping_sub(first) / 2) as usize) {
            return *opcode;
        }
        let mut halfword = [0; 2];
        // It has just been fetched from there.
        let _ = engine.mem_read(address, &mut halfword);
        u16::from_le_bytes(halfword)
    };
    let watch = move |engine: &mut Unicorn<'_, ()>, address: u64, bytes: u32| {
        let opcode = code_at(engine, address);
        let (mut board, mut stop) = (board.borrow_mut(), stop.borrow_mut());
        stop.at = address as u32;
        if stop.comes_before(opcode, board.now >= board.stop_at) {
            return halt(engine);
        }
        let cycles = board.cost.of(address as u32, bytes);
        board.now += cycles;
        board.instructions += 1;
        board.trace.handler.execute(address as u32);
    };
    let in_ccm = watch.clone();
    engine.add_code_hook(first, first + BANK_BYTES as u64 - 1, watch)?;
    engine.add_code_hook(u64::from(CCM_START), CCM_END, in_ccm)?;
    Ok(())
}

impl Stop {
    /// Whether the engine is to stop before this instruction.
    fn comes_before(&mut self, opcode: u16, is_due: bool) -> bool {
        let unmasks = opcode == UNMASK || opcode & 0xFFF0 == MOVE_TO_SPECIAL;
        let unmasked = std::mem::replace(&mut self.unmasked, unmasks);
        if is_due || self.watches && unmasked {
            return true;
        }
        self.waits = opcode == WAIT_FOR_EVENT;
        self.event |= opcode == SEND_EVENT;
        self.waits
    }
}
