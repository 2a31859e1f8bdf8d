//! What comes after an instruction, what it does to the stack, and how long it takes (ARMv7-M
//! manual, A5 to A7; Cortex-M4 manual, 3.3).

use anyhow::{Result, bail};

use crate::code::Code;

/// Where control goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Next {
    /// On.
    On,
    /// To an address, and on if it is conditional.
    Jump { to: u32, conditional: bool },
    /// To a function and back.
    Call { to: u32 },
    /// To one of the places of a table.
    Table { to: Vec<u32> },
    /// Back to the caller.
    Return,
    /// Nowhere: the instruction is a trap.
    Trap,
    /// Where a register says.
    Unknown,
}

/// An instruction as the bound sees it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its address.
    pub at: u32,
    /// Length [bytes].
    pub length: u32,
    /// Where control goes.
    pub next: Next,
    /// Bytes that it puts onto the stack, less those that it takes off.
    pub pushes: i64,
    /// Cycles without wait states, taken branches included.
    pub cycles: u64,
}

/// The instruction at an address.
///
/// # Errors
/// There is none, or a table that is too long.
pub fn step(code: &Code<'_>, at: u32, conditional: bool) -> Result<Step> {
    let Some(first) = code.halfword(at) else { bail!("no instruction at {at:#x}") };
    let second = code.halfword(at + 2).unwrap_or(0);
    let wide = first >> 11 >= 0b11101;
    let length = if wide { 4 } else { 2 };
    let next = if wide { wide_next(code, at, first, second)? } else { narrow_next(at, first) };
    let next = match next {
        Next::Jump { to, .. } if conditional => Next::Jump { to, conditional: true },
        other => other,
    };
    let pushes = if wide { wide_pushes(first, second) } else { narrow_pushes(first) };
    Ok(Step { at, length, next, pushes, cycles: cycles(first, second, wide) })
}

fn narrow_next(at: u32, code: u16) -> Next {
    let jump = |bits: u32, value: u16, conditional| {
        let unused = 32 - bits;
        let halfwords = (u32::from(value) << unused) as i32 >> unused;
        let to = at.wrapping_add(4).wrapping_add((halfwords << 1) as u32);
        Next::Jump { to, conditional }
    };
    match code {
        0xde00..=0xdeff => Next::Trap,
        0xdf00..=0xdfff => Next::Unknown,
        0xd000..=0xddff => jump(8, code & 0xff, true),
        0xe000..=0xe7ff => jump(11, code & 0x7ff, false),
        _ if code & 0xf500 == 0xb100 => {
            let offset = (code >> 3 & 0x40) | (code >> 2 & 0x3e);
            Next::Jump { to: at + 4 + u32::from(offset), conditional: true }
        }
        0x4770 => Next::Return,
        0x4700..=0x47ff => Next::Unknown,
        0xbd00..=0xbdff => Next::Return,
        0x4400..=0x44ff | 0x4600..=0x46ff if (code >> 4 & 8) | (code & 7) == 15 => Next::Unknown,
        _ => Next::On,
    }
}

fn wide_next(code: &Code<'_>, at: u32, first: u16, second: u16) -> Result<Next> {
    if first & 0xfff0 == 0xe8d0 && second & 0xffe0 == 0xf000 {
        return table(code, at, second & 0x10 != 0);
    }
    if first >> 11 == 0b11110 && second >> 15 == 1 {
        return Ok(branch(at, first, second));
    }
    let loads_pc = match first {
        _ if first & 0xff70 == 0xf850 => second >> 12 == 15,
        _ if first & 0xffd0 == 0xe890 || first & 0xffd0 == 0xe910 => second >> 15 == 1,
        _ => return Ok(Next::On),
    };
    Ok(match (loads_pc, first & 15) {
        (false, _) => Next::On,
        (true, 13) => Next::Return,
        (true, _) => Next::Unknown,
    })
}

fn branch(at: u32, first: u16, second: u16) -> Next {
    let (high, low) = (u32::from(first), u32::from(second));
    let sign = high >> 10 & 1;
    let far = |offset: u32, bits: u32| {
        let unused = 32 - bits;
        at.wrapping_add(4).wrapping_add((((offset << unused) as i32 >> unused) << 1) as u32)
    };
    let long = || {
        let inverted = |bit: u32| !(low >> bit ^ sign) & 1;
        let top = sign << 23 | inverted(13) << 22 | inverted(11) << 21;
        far(top | (high & 0x3ff) << 11 | low & 0x7ff, 24)
    };
    match second & 0x5000 {
        0x5000 => Next::Call { to: long() },
        0x1000 => Next::Jump { to: long(), conditional: false },
        0x4000 => Next::Unknown,
        _ if first >> 7 & 7 == 7 && first & 0xfff0 == 0xf7f0 && second & 0xf000 == 0xa000 => {
            Next::Trap
        }
        _ if first >> 7 & 7 == 7 => Next::On,
        _ => {
            let top = sign << 19 | (low >> 11 & 1) << 18 | (low >> 13 & 1) << 17;
            let to = far(top | (high & 0x3f) << 11 | low & 0x7ff, 20);
            Next::Jump { to, conditional: true }
        }
    }
}

/// TBB and TBH: the table follows.
fn table(code: &Code<'_>, at: u32, halfwords: bool) -> Result<Next> {
    let base = at + 4;
    let Some(end) = code.end_of_data(base) else { bail!("no table at {base:#x}") };
    let width = if halfwords { 2 } else { 1 };
    let entries = (base..end).step_by(width);
    let offset = |entry: u32| match (halfwords, code.halfword(entry & !1)) {
        (true, Some(word)) => u32::from(word),
        (false, Some(word)) => u32::from(word >> (8 * (entry & 1)) & 0xff),
        (_, None) => 0,
    };
    // A byte behind the last entry fills a halfword up.
    let to = entries.map(offset).filter(|offset| *offset > 0);
    Ok(Next::Table { to: to.map(|offset| base + 2 * offset).collect() })
}

fn narrow_pushes(code: u16) -> i64 {
    let words = i64::from((code & 0x1ff).count_ones());
    match code {
        0xb400..=0xb5ff => 4 * words,
        0xbc00..=0xbdff => -4 * words,
        0xb000..=0xb07f => -4 * i64::from(code & 0x7f),
        0xb080..=0xb0ff => 4 * i64::from(code & 0x7f),
        _ => 0,
    }
}

fn wide_pushes(first: u16, second: u16) -> i64 {
    let words = |list: u16| 4 * i64::from(list.count_ones());
    let immediate = || {
        let (i, imm3, imm8) = (first >> 10 & 1, second >> 12 & 7, second & 0xff);
        (u32::from(i), u32::from(imm3), u32::from(imm8))
    };
    let sp_to_sp = second >> 8 & 15 == 13;
    match first {
        0xe92d => words(second),
        0xe8bd => -words(second),
        // VPUSH and VPOP of single and double registers.
        _ if first & 0xffbf == 0xed2d => 4 * i64::from(second & 0xff),
        _ if first & 0xffbf == 0xecbd => -4 * i64::from(second & 0xff),
        // STR and LDR of one word, as a push and a pop.
        0xf84d if second & 0xfff == 0xd04 => 4,
        0xf85d if second & 0xfff == 0xb04 => -4,
        // SUB and ADD with a modified constant, and with 12 bits.
        0xf1ad | 0xf5ad if sp_to_sp => expanded(immediate()),
        0xf10d | 0xf50d if sp_to_sp => -expanded(immediate()),
        0xf2ad | 0xf6ad if sp_to_sp => plain(immediate()),
        0xf20d | 0xf60d if sp_to_sp => -plain(immediate()),
        _ => 0,
    }
}

fn plain((i, imm3, imm8): (u32, u32, u32)) -> i64 {
    i64::from(i << 11 | imm3 << 8 | imm8)
}

/// ThumbExpandImm, as far as a stack pointer can take it.
fn expanded((i, imm3, imm8): (u32, u32, u32)) -> i64 {
    let rotation = i << 4 | imm3 << 1 | imm8 >> 7;
    match rotation {
        0..8 => i64::from(imm8),
        _ => i64::from((imm8 | 0x80).rotate_right(rotation)),
    }
}

/// Cycles of the core, at zero wait states: the manual's, taken branches at three.
fn cycles(first: u16, second: u16, wide: bool) -> u64 {
    let listed = |list: u16| u64::from(list.count_ones());
    match first {
        0xb400..=0xb5ff | 0xbc00..=0xbdff if !wide => 1 + listed(first & 0x1ff) + 3,
        0xc000..=0xcfff if !wide => 1 + listed(first & 0xff),
        0xd000..=0xe7ff if !wide => 3,
        _ if !wide && first & 0xf500 == 0xb100 => 3,
        0x4700..=0x47ff if !wide => 3,
        // Loads and stores of one register.
        0x4800..=0x9fff if !wide => 2,
        _ if !wide => 1,
        _ if first >> 11 == 0b11110 && second >> 15 == 1 => 4,
        // TBB, TBH; LDRD, STRD; LDM, STM.
        _ if first & 0xfff0 == 0xe8d0 => 4,
        _ if first & 0xfe40 == 0xe840 => 3,
        _ if first & 0xfe40 == 0xe800 => 1 + listed(second) + 3,
        // Loads and stores.
        _ if first & 0xfe00 == 0xf800 => 2,
        // SDIV, UDIV.
        _ if first & 0xffd0 == 0xfb90 => 12,
        // VLDM, VSTM, VPUSH, VPOP; VLDR, VSTR.
        _ if first & 0xfe20 == 0xec20 => 1 + u64::from(second & 0xff),
        _ if first & 0xff20 == 0xed00 => 2,
        // VDIV, VSQRT; VMLA and its like; the rest of the floating-point unit.
        _ if first & 0xffb0 == 0xee80 => 14,
        _ if first & 0xffbf == 0xeeb1 && second & 0xc0 == 0xc0 => 14,
        _ if first & 0xffb0 == 0xee00 || first & 0xffb0 == 0xee10 => 3,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The only instruction of a function at address 0, with what follows it.
    fn only(halfwords: &[u16]) -> Step {
        let bytes: Vec<u8> = halfwords.iter().flat_map(|h| h.to_le_bytes()).collect();
        let code = Code::from_parts(bytes.leak(), &[(0, 2, "f")], &[]);
        step(&code, 0, false).unwrap()
    }

    #[test]
    fn jumps_calls_and_returns_are_told_apart() {
        assert_eq!(only(&[0xd0fe]).next, Next::Jump { to: 0, conditional: true });
        assert_eq!(only(&[0xe7fe]).next, Next::Jump { to: 0, conditional: false });
        assert_eq!(only(&[0xf000, 0xf802]).next, Next::Call { to: 8 });
        assert_eq!(only(&[0x4770]).next, Next::Return);
        assert_eq!(only(&[0xe8bd, 0x8ff0]).next, Next::Return);
        assert_eq!(only(&[0x4718]).next, Next::Unknown);
        assert_eq!(only(&[0xde00]).next, Next::Trap);
    }

    #[test]
    fn a_table_has_its_places_and_a_byte_that_fills_it_up() {
        // TBB [pc, r0]; places 2, 3 and 4 halfwords behind the table's beginning.
        let halfwords = [0xe8df, 0xf000, 0x0302, 0x0004, 0xbf00_u16, 0xbf00, 0xbf00];
        let bytes: Vec<u8> = halfwords.iter().flat_map(|h| h.to_le_bytes()).collect();
        let code = Code::from_parts(&bytes, &[(0, 14, "f")], &[(0, "$t"), (4, "$d"), (8, "$t")]);
        let step = step(&code, 0, false).unwrap();
        assert_eq!(step.next, Next::Table { to: vec![8, 10, 12] });
    }

    #[test]
    fn what_is_pushed_is_counted() {
        assert_eq!(only(&[0xb5f0]).pushes, 20, "push {{r4-r7, lr}}");
        assert_eq!(only(&[0xe92d, 0x0f00]).pushes, 16, "push.w {{r8-r11}}");
        assert_eq!(only(&[0xed2d, 0x8b10]).pushes, 64, "vpush {{d8-d15}}");
        assert_eq!(only(&[0xb0a0]).pushes, 128, "sub sp, #128");
        assert_eq!(only(&[0xf5ad, 0x5dcb]).pushes, 6496, "sub.w sp, sp, #6496");
    }
}
