//! `cargo xtask check-elf`: the control tick, from the interrupt's vector on, neither computes in
//! `f64` nor panics, and what it takes at most.
//!
//! The chip's FPU has no `f64`: such arithmetic calls a routine of a hundred
//! instructions and more. These routines, and those of a panic, are functions, so
//! it is enough to look at the names of those that the tick can reach.

use anyhow::{Result, bail};

use crate::board::Board;
use crate::call_graph::Reached;
use crate::code::{Code, Function};
use crate::firmware;
use crate::image::Image;
use crate::toolchain::FirmwareToolchain;
use crate::worst_case;

/// The tick of the NUCLEO.
const HANDLER: &str = "TIM6_DAC";

/// Builds the images of the boards named, or of all, and checks them.
pub fn run(names: &[&str]) -> Result<()> {
    let boards = Board::parse(names)?;
    let toolchain = FirmwareToolchain::find_or_make()?;
    for board in boards {
        check(board, &firmware::build(&toolchain, board)?)?;
    }
    Ok(())
}

/// Checks one image and prints what the tick can reach.
pub fn check(board: Board, image: &Image) -> Result<()> {
    let code = Code::read(&image.elf()?)?;
    let reached = Reached::from(&ticks(&code)?, &code, is_forbidden)?;
    println!("{}: the control tick can reach these functions:", board.name());
    for function in reached.functions().filter_map(|address| code.function(address)) {
        println!("  {}", function.names.join(" = "));
    }
    refuse_forbidden(image, &code, &reached)?;
    println!("{}: {}", board.name(), verdict(&code));
    if board == Board::Nucleo {
        worst_case::report(&code, HANDLER)?;
    }
    Ok(())
}

/// Where the handler of the tick begins, and the library's parts of it, in every copy.
fn ticks(code: &Code<'_>) -> Result<Vec<u32>> {
    let ticks: Vec<u32> = code
        .functions()
        .filter(|(_, function)| function.is_called(is_tick))
        .map(|(start, _)| start)
        .collect();
    if ticks.is_empty() {
        bail!("no function Controller::tick or Supervisor::act: they must be #[inline(never)]");
    }
    Ok(ticks)
}

fn refuse_forbidden(image: &Image, code: &Code<'_>, reached: &Reached) -> Result<()> {
    let offences: Vec<String> = reached
        .functions()
        .filter(|&address| code.function(address).is_some_and(is_forbidden))
        .map(|address| offence(address, code, reached))
        .collect();
    if offences.is_empty() {
        return Ok(());
    }
    bail!(
        "the control tick can compute in f64 or panic:\n  {}\n\
         `addr2line --functions --inlines --demangle --exe={} ADDRESS` shows the lines",
        offences.join("\n  "),
        image.path().display()
    )
}

fn offence(address: u32, code: &Code<'_>, reached: &Reached) -> String {
    let name = |start: u32| code.function(start).map_or("?", Function::name);
    let path: Vec<&str> = reached.path(address).into_iter().map(name).collect();
    let site = reached.call_of(address).map(|call| format!(", called at {:#x}", call.site));
    format!("{}{}", path.join(" -> "), site.unwrap_or_default())
}

fn verdict(code: &Code<'_>) -> &'static str {
    if code.functions().any(|(_, function)| function.is_called(is_double)) {
        "none of them computes in f64 or panics"
    } else {
        "none of them panics, and nothing in the whole image computes in f64"
    }
}

fn is_tick(name: &str) -> bool {
    let of_the_library = name.contains("Controller") || name.contains("Supervisor");
    let is_part =
        ["::tick", "::act", "::complete", "::prepare"].iter().any(|end| name.ends_with(end));
    name == HANDLER || of_the_library && is_part
}

fn is_forbidden(function: &Function) -> bool {
    function.is_called(is_double) || function.is_called(is_panic)
}

/// The run-time routines for `f64`: by their names in the Arm ABI (`__aeabi_dadd`,
/// `__aeabi_cdcmple`, `__aeabi_f2d`) or in GCC's library (`__adddf3`, `__fixdfsi`).
fn is_double(name: &str) -> bool {
    let name = name.rsplit("::").next().unwrap_or(name);
    match name.strip_prefix("__aeabi_") {
        Some(operation) => {
            operation.starts_with('d') || operation.starts_with("cd") || operation.ends_with("2d")
        }
        // The linker's bridges have the whole name of what they lead to behind theirs.
        None => name.starts_with("__") && !name.starts_with("__Thumb") && name.contains("df"),
    }
}

/// The core library's ways into a panic, and the handler.
fn is_panic(name: &str) -> bool {
    name.contains("panic")
        || name.contains("begin_unwind")
        || name.ends_with("_failed")
        || name.ends_with("_fail")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn routines_for_f64_are_told_from_others() {
        for name in ["__aeabi_dmul", "__aeabi_cdcmple", "__aeabi_f2d", "__aeabi_d2f"] {
            assert!(is_double(name), "{name}");
        }
        for name in ["__extendsfdf2", "compiler_builtins::float::mul::__muldf3"] {
            assert!(is_double(name), "{name}");
        }
        for name in ["__aeabi_fadd", "__aeabi_memcpy4", "__aeabi_uldivmod", "libm::sin", "abs_df"] {
            assert!(!is_double(name), "{name}");
        }
    }

    #[test]
    fn panics_are_told_from_others() {
        for name in ["core::panicking::panic_fmt", "core::slice::index::slice_index_fail"] {
            assert!(is_panic(name), "{name}");
        }
        assert!(is_panic("core::option::expect_failed"));
        assert!(!is_panic("firmware::controller::Controller::tick"));
    }

    #[test]
    fn the_tick_is_found_under_both_manglings() {
        assert!(is_tick("firmware::controller::Controller::tick"));
        assert!(is_tick("<firmware::controller::Controller>::tick"));
        assert!(is_tick("<firmware::supervisor::Supervisor>::tick"));
        assert!(!is_tick("firmware::controller::Controller::start"));
    }
}
