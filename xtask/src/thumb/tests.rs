//! The encodings are an assembler's, with the addresses it put them at.

use super::Flow::{Computed, Local, To};
use super::*;

fn narrow_at(address: u32, code: u16) -> Flow {
    let instruction = decode(address, code, None).expect("16 bits are enough");
    assert_eq!(instruction.length, 2);
    instruction.flow
}

fn wide_at(address: u32, first: u16, second: u16) -> Flow {
    let instruction = decode(address, first, Some(second)).expect("32 bits are enough");
    assert_eq!(instruction.length, 4);
    instruction.flow
}

#[test]
fn bl_goes_to_its_function_forwards_backwards_and_far() {
    assert_eq!(wide_at(0x1000, 0xf000, 0xf8fe), To(0x1200));
    assert_eq!(wide_at(0x1004, 0xf7ff, 0xfffc), To(0x1000));
    assert_eq!(wide_at(0x1090, 0xf1fe, 0xffb6), To(0x20_0000));
    assert_eq!(wide_at(0x20_0000, 0xf600, 0xfffe), To(0x1000));
}

#[test]
fn wide_branches_go_to_their_targets() {
    assert_eq!(wide_at(0x1008, 0xf000, 0xb8fa), To(0x1200)); // b.w
    assert_eq!(wide_at(0x100c, 0xf7ff, 0xbff8), To(0x1000));
    assert_eq!(wide_at(0x1010, 0xf040, 0x80f6), To(0x1200)); // bne.w
    assert_eq!(wide_at(0x1014, 0xf43f, 0xaff4), To(0x1000)); // beq.w
    assert_eq!(wide_at(0x20_0004, 0xf33f, 0x87fc), To(0x24_0000)); // bgt.w
}

#[test]
fn narrow_branches_go_to_their_targets() {
    assert_eq!(narrow_at(0x1018, 0xdbf2), To(0x1000)); // blt
    assert_eq!(narrow_at(0x101a, 0xe7f1), To(0x1000)); // b
    assert_eq!(narrow_at(0x101c, 0xb108), To(0x1022)); // cbz
    assert_eq!(narrow_at(0x101e, 0xb90f), To(0x1024)); // cbnz
    assert_eq!(narrow_at(0x1000, 0xb3f8), To(0x1082)); // cbz, farthest
}

#[test]
fn jumps_through_registers_and_memory_are_computed() {
    for code in [0x4718, 0x4798, 0x4697, 0x448f, 0xdf00] {
        assert_eq!(narrow_at(0, code), Computed, "{code:04x}"); // bx, blx, mov pc, add pc, svc
    }
    for (first, second) in [(0xe890, 0x8010), (0xe910, 0x8002)] {
        assert_eq!(wide_at(0, first, second), Computed, "{first:04x}"); // ldm, ldmdb
    }
    for (first, second) in [(0xf8d0, 0xf004), (0xf8df, 0xf004), (0xf850, 0xf021)] {
        assert_eq!(wide_at(0, first, second), Computed, "{first:04x}"); // ldr pc
    }
}

#[test]
fn returns_and_table_branches_stay_local() {
    assert_eq!(narrow_at(0, 0x4770), Local); // bx lr
    assert_eq!(narrow_at(0, 0xbd10), Local); // pop {r4, pc}
    assert_eq!(wide_at(0, 0xe8bd, 0x8110), Local); // pop.w {r4, r8, pc}
    assert_eq!(wide_at(0, 0xf85d, 0xfb04), Local); // ldr pc, [sp], #4
    assert_eq!(wide_at(0, 0xe8df, 0xf000), Local); // tbb
    assert_eq!(wide_at(0, 0xe8df, 0xf010), Local); // tbh
}

#[test]
fn instructions_that_only_look_like_branches_stay_local() {
    for code in [0x4690, 0xbf00, 0xdefe, 0xbeab] {
        assert_eq!(narrow_at(0, code), Local, "{code:04x}"); // mov r8, nop, udf, bkpt
    }
    for (first, second) in [(0xf7f0, 0xa001), (0xf3bf, 0x8f5f), (0xf380, 0x8811), (0xf3ef, 0x8010)]
    {
        assert_eq!(wide_at(0, first, second), Local, "{first:04x}"); // udf.w, dmb, msr, mrs
    }
    for (first, second) in [(0xee20, 0x0a81), (0xed9f, 0x0a01), (0xf24d, 0x0000), (0xf850, 0x3021)]
    {
        assert_eq!(wide_at(0, first, second), Local, "{first:04x}"); // vmul, vldr, movw, ldr r3
    }
}

#[test]
fn half_an_instruction_is_not_decoded() {
    assert_eq!(decode(0, 0xf000, None), None);
}
