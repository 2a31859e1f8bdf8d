//! Where a Thumb-2 instruction can pass control (ARMv7-M manual, DDI 0403, A5 and A7).

/// What an instruction does with the program counter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Goes on to the next instruction, returns, or jumps by a table within its function.
    Local,
    /// Can go to this address: a call or a branch, conditional or not.
    To(u32),
    /// Goes where a register or a word of memory says.
    Computed,
}

/// A decoded instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// Length in bytes, 2 or 4.
    pub length: u32,
    /// Where it passes control.
    pub flow: Flow,
}

/// Decodes the instruction at `address`; `second` is needed only if it has 32 bits.
pub fn decode(address: u32, first: u16, second: Option<u16>) -> Option<Instruction> {
    if first >> 11 < 0b11101 {
        return Some(Instruction { length: 2, flow: narrow(address, first) });
    }
    Some(Instruction { length: 4, flow: wide(address, first, second?) })
}

fn narrow(address: u32, code: u16) -> Flow {
    match code {
        0xde00..=0xdeff => Flow::Local,                   // UDF
        0xdf00..=0xdfff => Flow::Computed,                // SVC: through a vector
        0xd000..=0xddff => to(address, code & 0xff, 8),   // B<cond>, T1
        0xe000..=0xe7ff => to(address, code & 0x7ff, 11), // B, T2
        _ if code & 0xf500 == 0xb100 => compare_and_branch(address, code),
        0x4700..=0x47ff => by_register(code),
        0x4400..=0x44ff | 0x4600..=0x46ff if destination(code) == 15 => Flow::Computed,
        _ => Flow::Local,
    }
}

/// CBZ and CBNZ: forwards only.
fn compare_and_branch(address: u32, code: u16) -> Flow {
    let offset = (code >> 3 & 0x40) | (code >> 2 & 0x3e);
    Flow::To(address.wrapping_add(4 + u32::from(offset)))
}

/// BX and BLX; `bx lr` is a return.
fn by_register(code: u16) -> Flow {
    if code & 0xff80 == 0x4700 && code >> 3 & 15 == 14 { Flow::Local } else { Flow::Computed }
}

/// The destination of ADD and MOV between any two registers.
fn destination(code: u16) -> u16 {
    (code >> 4 & 8) | (code & 7)
}

fn wide(address: u32, first: u16, second: u16) -> Flow {
    if first >> 11 == 0b11110 && second >> 15 == 1 {
        return wide_branch(address, first, second);
    }
    let to_pc = match first {
        _ if first & 0xff70 == 0xf850 => second >> 12 == 15, // LDR
        _ if first & 0xffd0 == 0xe890 => second >> 15 == 1,  // LDM, POP
        _ if first & 0xffd0 == 0xe910 => second >> 15 == 1,  // LDMDB
        _ => false,
    };
    // From the stack it is a return.
    if to_pc && first & 15 != 13 { Flow::Computed } else { Flow::Local }
}

fn wide_branch(address: u32, first: u16, second: u16) -> Flow {
    match second & 0x5000 {
        0x5000 | 0x1000 => far(address, first, second), // BL, B (T4)
        0x4000 => Flow::Computed,                       // BLX to Arm code, which no Cortex-M has
        _ if first >> 7 & 7 == 7 => Flow::Local,        // MSR, MRS, barriers, hints, UDF
        _ => conditional(address, first, second),
    }
}

/// The offset of BL and B (T4): `S:I1:I2:imm10:imm11:0`.
fn far(address: u32, first: u16, second: u16) -> Flow {
    let (first, second) = (u32::from(first), u32::from(second));
    let sign = first >> 10 & 1;
    let inverted = |bit: u32| !(second >> bit ^ sign) & 1;
    let high = sign << 23 | inverted(13) << 22 | inverted(11) << 21;
    to(address, high | (first & 0x3ff) << 11 | second & 0x7ff, 24)
}

/// The offset of B<cond> (T3): `S:J2:J1:imm6:imm11:0`.
fn conditional(address: u32, first: u16, second: u16) -> Flow {
    let (first, second) = (u32::from(first), u32::from(second));
    let high = (first >> 10 & 1) << 19 | (second >> 11 & 1) << 18 | (second >> 13 & 1) << 17;
    to(address, high | (first & 0x3f) << 11 | second & 0x7ff, 20)
}

/// A target relative to the program counter, which is 4 bytes ahead, by a signed offset.
fn to(address: u32, halfwords: impl Into<u32>, bits: u32) -> Flow {
    let unused = 32 - bits;
    let halfwords = (halfwords.into() << unused) as i32 >> unused;
    Flow::To(address.wrapping_add(4).wrapping_add((halfwords << 1) as u32))
}

#[cfg(test)]
mod tests;
