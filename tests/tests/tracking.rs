//! What the model is worth on the motion (20)-(21).
#![allow(missing_docs)]

use firmware::Mode;
use host_tool::board::{Board, InProcess};
use host_tool::simulation::plan::task;
use host_tool::simulation::tracking::Tracking;
use host_tool::simulation::{Rig, Settings, record};
use tests::{image, qemu, rig};

/// Root mean square tracking error of each joint [rad] over 20 s.
fn errors(board: &mut dyn Board, rig: &Rig, mode: Mode) -> Vec<f64> {
    let plan = task(20.0).with_mode(mode);
    let block = plan.block(rig);
    let settings = Settings::default();
    let recording =
        record(board, &block, &rig.model, &settings, plan.ticks(rig), &mut |_| {}).unwrap();
    let counts_per_turn = f64::from(rig.encoder_counts_per_turn);
    Tracking::of(&recording.log, counts_per_turn).iter().map(Tracking::rms_rad).collect()
}

fn assert_a_fifth(board: &mut dyn Board) {
    let rig = rig();
    let [plain, friction, modelled] =
        [Mode::Pd, Mode::PdFriction, Mode::PdModel].map(|mode| errors(board, &rig, mode));
    for joint in 0..3 {
        assert!(modelled[joint] < plain[joint] / 5.0, "{plain:?} {modelled:?}");
        assert!(friction[joint] < plain[joint], "{plain:?} {friction:?}");
        // What remains is a count or two, docs/firmware.md says of what.
        assert!(modelled[joint] < 3.0e-5, "{modelled:?}");
    }
}

#[test]
fn the_model_cuts_the_error_to_a_fifth_on_the_host() {
    assert_a_fifth(&mut InProcess::default());
}

#[test]
fn the_model_cuts_the_error_to_a_fifth_in_qemu() {
    let Some(image) = image() else { return };
    assert_a_fifth(&mut qemu(&image));
}
