//! What the end-to-end tests share: the firmware in QEMU and what it plays.

use std::path::PathBuf;

use firmware::reference::{Injection, Noise};
use firmware::{Mode, ParameterBlock};
use host_tool::board::{Qemu, QemuSettings};
use host_tool::simulation::{Plan, Rig, plan};
use model::reference_robot::reference_robot;

/// The variable that holds the path of the firmware's image for QEMU.
pub const IMAGE_VARIABLE: &str = "RRR_QEMU_FIRMWARE";

/// The image's path; `None`, said on the terminal, where `cargo xtask test` has not set it.
pub fn image() -> Option<PathBuf> {
    let path = std::env::var_os(IMAGE_VARIABLE).map(PathBuf::from);
    if path.is_none() {
        eprintln!("skipped: {IMAGE_VARIABLE} is not set; `cargo xtask test` builds the image");
    }
    path
}

/// The firmware in QEMU.
///
/// # Panics
/// QEMU does not start.
pub fn qemu(image: &PathBuf) -> Qemu {
    Qemu::start(&QemuSettings::new(image)).expect("QEMU starts")
}

/// The rig with the reference robot.
pub fn rig() -> Rig {
    Rig::new(reference_robot())
}

/// A minute of motion that exercises a mode: friction and open loop swing freely under noise.
pub fn minute_of(rig: &Rig, mode: Mode) -> ParameterBlock {
    let mut plan = plan::excitation(2, 60.0).with_mode(mode);
    for (index, injection) in plan.reference.injection.iter_mut().enumerate() {
        let noise = Noise { rms_v: 0.3, bandwidth_hz: 200.0, seed: 5 + index as u32 };
        *injection = Injection::Noise(noise);
    }
    plan.block(rig)
}

/// Every reference that the firmware can play, each with all terms of the control law on.
pub fn every_reference(rig: &Rig) -> Vec<Plan> {
    let mut plans = vec![plan::task(10.0), plan::excitation(1, 10.0), plan::driven_noise(10.0, 1)];
    plans.push(plan::constant_velocity(2));
    plans.push(plan::friction_excitation(rig));
    plans.push(plan::presliding_noise(rig, 1, 1));
    plans.into_iter().map(|plan| plan.with_mode(Mode::PdModel)).collect()
}
