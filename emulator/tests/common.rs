//! What the tests share: the image, an arm at the board, the commands to get it going.
#![allow(dead_code)]

use std::path::PathBuf;
use std::rc::Rc;

use emulator::image::Image;
use emulator::machine::Machine;
use emulator::operator::Operator;
use emulator::plant::{Plant, Still};
use emulator::registers::MS;
use firmware::block::MAX_BYTES;
use firmware::link::Command;
use firmware::supervisor::{Fault, State};
use firmware::{Angle, Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use rig::compensation::Compensations;
use rig::effects::{Catalogue, table_from_text};
use rig::{Plan, Rig};
use simulation::arm::{ArmSettings, SimulatedArm};
use simulation::start_of;

/// Holds the path of the image; `cargo xtask emulate` sets it.
const IMAGE_VARIABLE: &str = "RRR_NUCLEO_FIRMWARE";

/// The image; `None`, said, where none is named.
pub fn image() -> Option<Rc<Image>> {
    let Some(path) = std::env::var_os(IMAGE_VARIABLE).map(PathBuf::from) else {
        eprintln!("skipped, because {IMAGE_VARIABLE} names no image");
        return None;
    };
    Some(Rc::new(Image::read(&path).unwrap_or_else(|error| panic!("{error}"))))
}

/// The byte of the image that `RRR_RIG_LOOPBACK=wired` sets at the build.
const HAS_LOOPBACK: &str = "RRR_RIG_HAS_LOOPBACK";

/// The image of a rig that measures the converter's outputs.
pub fn wired() -> Option<Rc<Image>> {
    Some(Rc::new(image()?.with_byte(HAS_LOOPBACK, 1).expect("the image has its rig's byte")))
}

/// An arm at rest, exactly as its model.
pub fn arm(position_rad: [f64; 3]) -> Box<dyn Plant> {
    let mut settings = ArmSettings::new(reference_robot());
    settings.position_rad = position_rad;
    settings.incremental_encoders = true;
    Box::new(SimulatedArm::new(&settings, Vec::new()))
}

/// A position, as the host tells it.
pub fn told(position_rad: [f64; 3]) -> [Angle; 3] {
    position_rad.map(|q_rad| Angle::from_radians(q_rad as f32))
}

/// A board with an arm at rest, its ticks kept.
pub fn board_with_arm(image: &Rc<Image>, position_rad: [f64; 3]) -> Operator {
    let machine = Machine::new(image.clone(), arm(position_rad)).unwrap();
    machine.board().trace.is_on = true;
    Operator::new(machine)
}

/// A board whose arm does not move.
pub fn board_alone(image: &Rc<Image>) -> Operator {
    Operator::new(Machine::new(image.clone(), Box::new(Still)).unwrap())
}

/// A block as bytes.
pub fn encoded(block: &ParameterBlock) -> Vec<u8> {
    block.encode(&mut [0; MAX_BYTES]).unwrap().to_vec()
}

/// Asks for what must be done.
pub fn done(operator: &mut Operator, command: Command<'_>) {
    let words = format!("{command:?}");
    let answer = operator.ask(command).unwrap_or_else(|error| panic!("{words}: {error}"));
    assert_eq!(answer, Some(Ok(())), "{words}");
}

/// Uploads and stores a block.
pub fn commit(operator: &mut Operator, block: &ParameterBlock) {
    assert!(operator.hello().unwrap());
    assert_eq!(operator.upload(&encoded(block)).unwrap(), Some(Ok(())));
    done(operator, Command::Commit);
}

/// From a boot to the first tick of the run.
pub fn home_and_run(operator: &mut Operator, position_rad: [f64; 3]) {
    operator.run_ms(1500).unwrap();
    assert!(operator.hello().unwrap());
    done(operator, Command::Stream { on: true });
    done(operator, Command::Home { position: told(position_rad) });
    operator.run_ms(200).unwrap();
    done(operator, Command::Arm);
    done(operator, Command::Run { host_timeout_ms: None });
}

/// A board that plays the task, its outputs released.
pub fn running(image: &Rc<Image>, plan: Plan) -> Operator {
    let rig = Rig::new(reference_robot());
    let block = plan.with_mode(Mode::PdModel).block(&rig);
    let mut board = board_with_arm(image, start_of(&block));
    board.run_ms(50).unwrap();
    commit(&mut board, &block);
    home_and_run(&mut board, start_of(&block));
    board.run_ms(500).unwrap();
    assert!(board.machine.board().converter.is_released());
    board
}

/// Fault and state after so many milliseconds, asked over the line.
pub fn after_ms(board: &mut Operator, ms: u64) -> (Option<Fault>, State) {
    board.run_ms(ms).unwrap();
    assert!(board.hello().unwrap());
    let report = board.query().unwrap().unwrap();
    (report.fault.map(|fault| fault.fault), report.state)
}

/// Milliseconds from a time to the fall of CLR.
pub fn cleared_after_ms(board: &Operator, since: u64) -> f64 {
    let board = board.machine.board();
    assert!(!board.converter.is_released());
    assert_eq!(board.converter.volts(), [0.0; 3]);
    (board.trace.cleared_at.unwrap() - since) as f64 / MS as f64
}

/// Seconds of a run whose host gives a sign of life in each.
pub fn attend(operator: &mut Operator, seconds: u64) {
    for _ in 0..seconds {
        operator.run_ms(990).unwrap();
        done(operator, Command::Query);
        operator.run_ms(8).unwrap();
    }
}

/// Effects of every kind that the board compensates for, so that the tick does all that it can.
const EFFECTS: [&str; 12] = [
    "cogging:1:amplitude_V=0.08,harmonic=12,phase_rad=0.4",
    "cogging:2:amplitude_V=0.15,harmonic=8,phase_rad=0.9",
    "position_friction:2:relative_amplitude=0.3,harmonic=2,phase_rad=2.0",
    "cogging:3:amplitude_V=0.1,harmonic=8,phase_rad=-0.5",
    "dead_zone:3:half_width_V=0.05",
    "payload:mass_kg=0.3",
    "base_tilt:tilt_x_rad=0.03,tilt_y_rad=-0.02",
    "table:1:axis=position,knots=-1 0.5 1.7 3.2,values_V=0.05 -0.04 0.08 0",
    "table:3:axis=load,knots=-3 -0.5 0.4 2.5,values_V=0.06 -0.02 0.03 -0.06",
    "torque_ripple:2:relative_amplitude=0.08,harmonic=16,phase_rad=-1.2",
    "asymmetric_friction:3:relative_asymmetry=0.2",
    "quadratic_drag:1:coefficient_V_s2_per_rad2=0.01",
];

/// A rig that compensates for them, at an arm that has none of them.
pub fn rig_that_compensates() -> Rig {
    let tables: Vec<_> = EFFECTS.iter().map(|text| table_from_text(text).unwrap()).collect();
    let (compensations, left_out) = Compensations::of(&tables, &Catalogue::standard()).unwrap();
    assert!(left_out.is_empty(), "{left_out:?}");
    Rig::new(reference_robot()).with_compensations(compensations)
}
