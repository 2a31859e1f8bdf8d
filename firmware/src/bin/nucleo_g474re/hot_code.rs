//! The code of the tick runs from the CCM SRAM, which delivers every instruction at once; the
//! flash takes five cycles for eight of them wherever its cache of 1 KiB misses.
//!
//! `ccm-nucleo.x` says which functions; they lie in the flash and are copied before all else.

use core::arch::global_asm;

// Called by the reset before variables have their values, so it is not written in Rust.
global_asm!(
    ".section .text.__pre_init,\"ax\",%progbits",
    ".global __pre_init",
    ".type __pre_init,%function",
    ".thumb_func",
    "__pre_init:",
    "    ldr r0, =__siccm",
    "    ldr r1, =__sccm",
    "    ldr r2, =__eccm",
    "0:  cmp r1, r2",
    "    beq 1f",
    "    ldm r0!, {{r3}}",
    "    stm r1!, {{r3}}",
    "    b 0b",
    "1:  dsb",
    "    isb",
    "    bx lr",
    ".size __pre_init, . - __pre_init",
);
