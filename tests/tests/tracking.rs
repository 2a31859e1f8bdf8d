//! What the model is worth on the motion (20)-(21).
#![allow(missing_docs)]

use files::EffectTable;
use firmware::Mode;
use recordings::tracking::Tracking;
use rig::Rig;
use rig::plan::task;
use simulation::board::{Board, InProcess};
use simulation::{Settings, SimulatedRobot, record_robot, start_of};
use tests::{hidden_effects, image, qemu, rig, rig_that_compensates, simulated};

/// Root mean square tracking error of each joint [rad] over 20 s.
fn errors(board: &mut dyn Board, rig: &Rig, mode: Mode) -> Vec<f64> {
    errors_of(board, rig, mode, &[])
}

/// The same of a robot with effects.
fn errors_of(board: &mut dyn Board, rig: &Rig, mode: Mode, effects: &[EffectTable]) -> Vec<f64> {
    let plan = task(20.0).with_mode(mode);
    let block = plan.block(rig);
    let (effects, settings) = (simulated(effects), Settings::default());
    let robot = SimulatedRobot::with_effects(rig.model, effects, start_of(&block), &settings);
    let recording = record_robot(board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
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

/// Effects that the model does not hold cost ten times and more what remains once the board
/// compensates for them, and then the arm tracks as if it had none.
#[test]
fn hidden_effects_are_made_up_for_in_qemu() {
    let Some(image) = image() else { return };
    let (mut board, effects) = (qemu(&image), hidden_effects());
    let mode = Mode::PdModel;
    let without = errors(&mut board, &rig(), mode);
    let hidden = errors_of(&mut board, &rig(), mode, &effects);
    let known = errors_of(&mut board, &rig_that_compensates(&effects), mode, &effects);
    println!("joint  without  hidden  known [mrad]");
    for joint in 0..3 {
        let mrad = [&without, &hidden, &known].map(|errors| 1e3 * errors[joint]);
        println!("{}      {:7.4} {:7.4} {:7.4}", joint + 1, mrad[0], mrad[1], mrad[2]);
        assert!(known[joint] < 1.2 * without[joint], "{known:?} {without:?}");
        assert!(known[joint] < 0.1 * hidden[joint], "{known:?} {hidden:?}");
    }
}
