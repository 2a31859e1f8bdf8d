//! Links an image against the memory map of the board that its feature names.
//!
//! Host builds of the library need nothing of this and get nothing.

use std::env;
use std::path::PathBuf;

const BOTH_BOARDS: &str = "the features qemu-mps2-an386 and nucleo-g474re exclude each other: \
     build one board at a time, as `cargo xtask firmware qemu` does";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    match (has_feature("QEMU_MPS2_AN386"), has_feature("NUCLEO_G474RE")) {
        (true, true) => panic!("{BOTH_BOARDS}"),
        (true, false) => link_for_qemu(),
        (false, true) => link_for_nucleo(),
        (false, false) => {}
    }
}

fn has_feature(name: &str) -> bool {
    env::var_os(format!("CARGO_FEATURE_{name}")).is_some()
}

/// The map of the emulated board goes in front of `memory.x`, whose numbers it replaces.
fn link_for_qemu() {
    let map = package_dir().join("memory-qemu.x");
    println!("cargo::rerun-if-changed={}", map.display());
    link_argument(&format!("-T{}", map.display()));
    link_with_runtime();
}

fn link_for_nucleo() {
    println!("cargo::rerun-if-env-changed=DEFMT_LOG");
    if env::var_os("DEFMT_LOG").is_none() {
        // Without it, nothing below an error would be compiled into the image.
        println!("cargo::rustc-env=DEFMT_LOG=info");
    }
    let hot_code = package_dir().join("ccm-nucleo.x");
    println!("cargo::rerun-if-changed={}", hot_code.display());
    link_argument(&format!("-T{}", hot_code.display()));
    link_with_runtime();
    link_argument("-Tdefmt.x");
}

/// `link.x`, of cortex-m-rt, includes the `memory.x` of the workspace root.
fn link_with_runtime() {
    let root = package_dir().join("..");
    println!("cargo::rerun-if-changed={}", root.join("memory.x").display());
    println!("cargo::rustc-link-search={}", root.display());
    link_argument("--nmagic");
    link_argument("-Tlink.x");
}

fn link_argument(argument: &str) {
    println!("cargo::rustc-link-arg-bins={argument}");
}

fn package_dir() -> PathBuf {
    env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR").into()
}
