//! Entry to an exception and return from it (ARMv7-M, B1.5.6 to B1.5.8).
//!
//! Where the floating-point unit was used, its registers are saved at once: a program sees no
//! difference to the lazy way, but for the room on the stack, which is reserved either way.

use unicorn_engine::{RegisterARM, Unicorn};

use crate::failure::Failure;
use crate::memory_map::{RAM_BYTES, RAM_START};

/// Return codes end so: to a handler, or to the thread; both on the main stack.
const TO_HANDLER: u32 = 0xFFFF_FFF1;
const TO_THREAD: u32 = 0xFFFF_FFF9;
/// Clear in a return code: the frame has floating-point registers.
const BASIC_FRAME: u32 = 1 << 4;
/// Bits of CONTROL: the process stack, floating point in use.
const PROCESS_STACK: u64 = 1 << 1;
const FLOATING_POINT: u64 = 1 << 2;
/// A bit of the saved XPSR: the stack was moved to a multiple of eight.
const ALIGNED: u32 = 1 << 9;
const THUMB: u32 = 1 << 24;
/// Words of S0 to S15, FPSCR and one that is reserved.
const FLOATING_WORDS: usize = 18;
const BASIC_WORDS: usize = 8;

const BASIC: [RegisterARM; 6] = [
    RegisterARM::R0,
    RegisterARM::R1,
    RegisterARM::R2,
    RegisterARM::R3,
    RegisterARM::R12,
    RegisterARM::LR,
];

/// Cycles of an entry and of a return, without wait states.
pub const ENTRY_CYCLES: u64 = 12;
/// As above.
pub const RETURN_CYCLES: u64 = 10;

/// Begins an exception: its number, and its vector; whether floating-point registers were saved.
///
/// # Errors
/// The stack is not in the RAM, or is the process stack, which is not modelled.
pub fn enter(
    engine: &mut Unicorn<'_, ()>,
    number: usize,
    vector: u32,
    depth: usize,
) -> Result<bool, Failure> {
    let control = get(engine, RegisterARM::CONTROL)?;
    if u64::from(control) & PROCESS_STACK != 0 {
        return Err(Failure::Core("the process stack is not modelled".to_owned()));
    }
    let floating = u64::from(control) & FLOATING_POINT != 0;
    push(engine, floating)?;
    let code = if depth == 0 { TO_THREAD } else { TO_HANDLER };
    put(engine, RegisterARM::LR, if floating { code & !BASIC_FRAME } else { code })?;
    put(engine, RegisterARM::CONTROL, control & !(FLOATING_POINT as u32))?;
    put(engine, RegisterARM::XPSR_NZCVQG, number as u32 | THUMB)?;
    put(engine, RegisterARM::PC, vector | 1)?;
    Ok(floating)
}

/// Pushes the frame onto the stack, which begins at a multiple of eight then.
fn push(engine: &mut Unicorn<'_, ()>, floating: bool) -> Result<(), Failure> {
    let sp = get(engine, RegisterARM::SP)?;
    let end = sp - 4 * words(floating) as u32;
    let frame = end & !7;
    if !(RAM_START..RAM_START + RAM_BYTES as u32).contains(&frame) {
        return Err(Failure::Core(format!("the stack is at {frame:#010x}, outside the RAM")));
    }
    let mut saved = Vec::with_capacity(words(floating));
    for register in BASIC {
        saved.push(get(engine, register)?);
    }
    saved.push(get(engine, RegisterARM::PC)? & !1);
    let moved = if end != frame { ALIGNED } else { 0 };
    saved.push(get(engine, RegisterARM::XPSR)? & !ALIGNED | THUMB | moved);
    if floating {
        for index in 0..16 {
            saved.push(get_id(engine, RegisterARM::S0 as i32 + index)?);
        }
        saved.extend([get(engine, RegisterARM::FPSCR)?, 0]);
    }
    write(engine, frame, &saved)?;
    put(engine, RegisterARM::SP, frame)
}

/// Words of a frame.
fn words(floating: bool) -> usize {
    BASIC_WORDS + if floating { FLOATING_WORDS } else { 0 }
}

/// Returns from an exception by its return code; `running` is the exception returned to.
///
/// # Errors
/// A code that fits no exception.
pub fn leave(engine: &mut Unicorn<'_, ()>, code: u32, running: usize) -> Result<(), Failure> {
    let floating = code & BASIC_FRAME == 0;
    let expected = if running == 0 { TO_THREAD } else { TO_HANDLER };
    if code | BASIC_FRAME != expected {
        return Err(Failure::Core(format!("the return code {code:#010x} fits no exception")));
    }
    let frame = get(engine, RegisterARM::SP)?;
    let saved = read(engine, frame, words(floating))?;
    let status = saved[7];
    // First the number, so that all else is written to the registers that are then in use.
    put(engine, RegisterARM::XPSR_NZCVQG, status & !(0x1FF | ALIGNED) | running as u32)?;
    for (register, value) in BASIC.into_iter().zip(&saved) {
        put(engine, register, *value)?;
    }
    if floating {
        restore_floating(engine, &saved[BASIC_WORDS..])?;
    }
    let control = get(engine, RegisterARM::CONTROL)? & !(FLOATING_POINT as u32);
    let in_use = if floating { FLOATING_POINT as u32 } else { 0 };
    put(engine, RegisterARM::CONTROL, control | in_use)?;
    let moved = if status & ALIGNED != 0 { 4 } else { 0 };
    put(engine, RegisterARM::SP, frame + 4 * words(floating) as u32 + moved)?;
    put(engine, RegisterARM::PC, saved[6] | 1)
}

fn restore_floating(engine: &mut Unicorn<'_, ()>, saved: &[u32]) -> Result<(), Failure> {
    for index in 0..16 {
        put_id(engine, RegisterARM::S0 as i32 + index, saved[index as usize])?;
    }
    put(engine, RegisterARM::FPSCR, saved[16])
}

fn write(engine: &mut Unicorn<'_, ()>, address: u32, words: &[u32]) -> Result<(), Failure> {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    engine.mem_write(u64::from(address), &bytes).map_err(|why| bad("the stack", why))
}

fn read(engine: &mut Unicorn<'_, ()>, address: u32, words: usize) -> Result<Vec<u32>, Failure> {
    let bytes = engine.mem_read_as_vec(u64::from(address), 4 * words);
    let bytes = bytes.map_err(|why| bad("the stack", why))?;
    let word = |b: &[u8]| u32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    Ok(bytes.chunks_exact(4).map(word).collect())
}

/// A register of the core.
///
/// # Errors
/// The engine has none of this name.
pub fn get(engine: &Unicorn<'_, ()>, register: RegisterARM) -> Result<u32, Failure> {
    get_id(engine, register as i32)
}

/// Sets a register of the core.
///
/// # Errors
/// The engine has none of this name.
pub fn put(engine: &mut Unicorn<'_, ()>, register: RegisterARM, to: u32) -> Result<(), Failure> {
    put_id(engine, register as i32, to)
}

fn get_id(engine: &Unicorn<'_, ()>, register: i32) -> Result<u32, Failure> {
    engine.reg_read(register).map(|value| value as u32).map_err(|why| bad("a register", why))
}

fn put_id(engine: &mut Unicorn<'_, ()>, register: i32, to: u32) -> Result<(), Failure> {
    engine.reg_write(register, u64::from(to)).map_err(|why| bad("a register", why))
}

fn bad(what: &str, why: unicorn_engine::uc_error) -> Failure {
    Failure::Core(format!("{what}: {why:?}"))
}
