//! Where the chip has what (RM0440, 2.2.2).

/// The flash: two banks of 256 KiB.
pub const FLASH_START: u32 = 0x0800_0000;
/// Length of the flash [bytes].
pub const FLASH_BYTES: usize = 512 << 10;
/// Length of a bank [bytes].
pub const BANK_BYTES: usize = 256 << 10;
/// Bank 2.
pub const BANK2_START: u32 = FLASH_START + BANK_BYTES as u32;
/// SRAM1 and SRAM2; the alias of the CCM SRAM behind them is not modelled.
pub const RAM_START: u32 = 0x2000_0000;
/// Their length [bytes].
pub const RAM_BYTES: usize = 96 << 10;
/// The CCM SRAM.
pub const CCM_START: u32 = 0x1000_0000;
/// Its length [bytes].
pub const CCM_BYTES: usize = 32 << 10;
/// Registers of the chip's blocks: APB1 to AHB1.
pub const PERIPHERALS: (u32, u32) = (0x4000_0000, 0x0003_0000);
/// Registers of the pins.
pub const PINS: (u32, u32) = (0x4800_0000, 0x0000_2000);
/// The random generator's page of AHB2.
pub const AHB2: (u32, u32) = (0x5000_0000, 0x0010_0000);
/// Registers of the core.
pub const CORE: (u32, u32) = (0xE000_0000, 0x0010_0000);
