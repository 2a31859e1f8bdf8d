//! How often the loops of the tick are gone round at most, and why.

use anyhow::{Result, bail};

use super::cost::Cost;
use crate::code::Code;

/// Rounds of loops: a part of the function's name, how many loops it has (0 for any number), and for
/// each depth the rounds, in the order of the loops' addresses; the last figure holds for the rest.
type Entry = (&'static str, usize, &'static [&'static [u64]], &'static str);

/// What bounds each, where it is no delay of a constant length.
const LOOPS: [Entry; 18] = [
    ("Supervisor>::act", 0, &[&[3], &[4]], "joints; input inverses"),
    ("TIM6_DAC", 0, &[&[12]], "130 ns between SYNC and a late LDAC, two cycles a round"),
    ("act_at_rest", 0, &[&[3]], "joints"),
    ("of_tick", 0, &[&[3], &[4]], "joints; input inverses"),
    ("friction_and_disturbance", 0, &[&[6]], "effects compensated by feedforward"),
    ("less_tables", 0, &[&[2], &[6]], "tables of a joint; halvings of 20 knots"),
    ("status_when_sent", 0, &[&[60]], "POLLS in converter.rs"),
    ("first_fault", 0, &[&[3]], "joints"),
    ("Converter::set_up", 0, &[&[4]], "registers of the converter"),
    ("Converter::watch", 0, &[&[1100]], "POLLS in load.rs"),
    ("Controller::tick", 0, &[&[3], &[4]], "joints; input inverses"),
    ("start_of_reference", 0, &[&[6], &[20]], "entries of a list; knots"),
    ("ParameterBlock as core::clone", 0, &[&[16], &[20]], "entries of a list; knots"),
    ("JointMonitor::new", 0, &[&[32]], "halvings of 32 bits"),
    ("Supervisor::replace", 0, &[&[32]], "halvings of 32 bits"),
    ("u64_div_rem", 0, &[&[64]], "bits"),
    (
        "serialize_field",
        0,
        &[&[16], &[20]],
        "speeds of a reference, more than any other list; knots",
    ),
    ("parts::of", 0, &[&[20], &[20], &[5]], "knots, more than any list has; bytes of a number"),
];

/// Bytes that functions copy or clear at most, by a part of the caller's name; those not named move
/// a whole controller.
const COPIES: [(&str, u64); 6] = [
    // One number after the other.
    ("serialize", 20),
    // The robot, or a table of 20 knots.
    ("core::clone", 400),
    ("Latch", 32),
    ("latch_anew", 32),
    ("enter_fault", 64),
    ("TIM6_DAC", 64),
];
const CONTROLLER_BYTES: u64 = 4096;

/// What a call of `memcpy` or its like takes from this caller: up to three instructions a byte, where
/// nothing is aligned.
pub fn copy(caller: &str) -> Cost {
    let named = COPIES.iter().find(|(name, _)| caller.contains(name));
    let bytes = named.map_or(CONTROLLER_BYTES, |(_, bytes)| *bytes);
    Cost { instructions: 60 + 3 * bytes, cycles: 100 + 5 * bytes }
}

/// Whether a function copies or clears memory.
pub fn is_copy(name: &str) -> bool {
    ["memcpy", "memclr", "memset", "memmove"].iter().any(|part| name.contains(part))
}

/// The loops of a function: where each is entered, and in how many others it is.
pub type Heads = Vec<(u32, usize)>;

/// The rounds of the loop that is entered at a place.
///
/// # Errors
/// There is no bound.
pub fn rounds(
    code: &Code<'_>,
    function: &str,
    start: u32,
    heads: &Heads,
    head: u32,
) -> Result<u64> {
    if let Some(rounds) = delay(code, head) {
        return Ok(rounds);
    }
    let others: Vec<(u32, usize)> =
        heads.iter().copied().filter(|(at, _)| delay(code, *at).is_none()).collect();
    let depth = others.iter().find(|(at, _)| *at == head).map_or(0, |(_, depth)| *depth);
    let mut alike: Vec<u32> = others.iter().filter(|(_, d)| *d == depth).map(|(a, _)| *a).collect();
    alike.sort_unstable();
    let place = alike.iter().position(|at| *at == head).unwrap_or(0);
    let is_it = |(name, loops, ..): &&Entry| {
        function.contains(name) && (*loops == 0 || *loops == others.len())
    };
    let entry = LOOPS.iter().find(is_it);
    let bounds = entry.and_then(|(_, _, depths, _)| depths.get(depth));
    match bounds.and_then(|bounds| bounds.get(place).or(bounds.last())) {
        Some(rounds) => Ok(*rounds),
        None => bail!(
            "the loop {:#x} bytes behind the beginning of {function}, {depth} deep, one of {}, has no \
             bound: add it to LOOPS in xtask/src/worst_case/loops.rs, with the reason",
            head - start,
            others.len()
        ),
    }
}

/// The rounds of a delay: SUBS and BNE, and the counter set to a constant shortly before.
fn delay(code: &Code<'_>, head: u32) -> Option<u64> {
    let (subtract, back) = (code.halfword(head)?, code.halfword(head + 2)?);
    // SUBS rd, #1; BNE by 3 halfwords, back to it.
    if subtract & 0xf8ff != 0x3801 || back != 0xd1fd {
        return None;
    }
    let register = subtract >> 8 & 7;
    (2..16).find_map(|halfwords| constant(code, head.checked_sub(2 * halfwords)?, register))
}

/// What a MOVS or MOVW at a place puts into a low register.
fn constant(code: &Code<'_>, at: u32, register: u16) -> Option<u64> {
    let (first, second) = (code.halfword(at)?, code.halfword(at + 2)?);
    if first & 0xff00 == 0x2000 | register << 8 {
        return Some(u64::from(first & 0xff));
    }
    let is_wide = first & 0xfbf0 == 0xf240 && second >> 8 & 0x8f == register;
    let (i, high) = (u64::from(first >> 10 & 1), u64::from(first & 15));
    let low = u64::from(second >> 12 & 7) << 8 | u64::from(second & 0xff);
    is_wide.then_some(high << 12 | i << 11 | low)
}
