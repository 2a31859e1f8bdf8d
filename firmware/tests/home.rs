//! Encoders that count from zero wherever the arm is: it is not armed before its position is set.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::block;
use firmware::reference::Reference;
use firmware::supervisor::{
    BootReport, Fault, Health, Implausible, Order, OrderError, State, Supervisor,
};
use firmware::{Angle, Controller, Mode, ParameterBlock};

const HANGING_RAD: [f32; 3] = [0.0, -core::f32::consts::FRAC_PI_2, 0.0];

fn holding(mode: Mode) -> ParameterBlock {
    ParameterBlock { reference: Reference::hold(HANGING_RAD), ..block(mode) }
}

fn home() -> Order {
    Order::Home { position: HANGING_RAD.map(Angle::from_radians) }
}

/// A board whose encoders began to count where the arm hung, or was held.
fn lost(block: ParameterBlock) -> Supervisor {
    let mut supervisor = Supervisor::default();
    supervisor.replace(Controller::new(block)).unwrap();
    supervisor.booted(BootReport { position_lost: true, ..BootReport::default() });
    supervisor
}

/// Every joint is turned by hand and let go, then rests where it was.
fn turned_by_hand(supervisor: &mut Supervisor, joints: &[usize]) {
    for tick in 0..400 {
        let mut counts = [0; 3];
        joints.iter().for_each(|&joint| counts[joint] = 3 * i32::min(tick, 200 - tick.min(200)));
        supervisor.tick(&counts, Health::default());
    }
}

fn stand(supervisor: &mut Supervisor) -> [i32; 3] {
    (0..200).map(|_| supervisor.tick(&[0; 3], Health::default()).counts).last().unwrap()
}

fn implausible(joint: u8, why: Implausible) -> Result<(), OrderError> {
    Err(OrderError::Implausible { joint, why })
}

#[test]
fn it_is_armed_once_it_was_told_where_it_is() {
    let mut supervisor = lost(holding(Mode::Pd));
    turned_by_hand(&mut supervisor, &[0, 1, 2]);
    assert_eq!(supervisor.execute(Order::Arm), implausible(1, Implausible::NoHome));
    assert_eq!(supervisor.is_position_known(), [false; 3]);
    assert_eq!(supervisor.execute(home()), Ok(()));
    assert_eq!(supervisor.is_position_known(), [true; 3]);
    assert_eq!(supervisor.execute(Order::Arm), implausible(1, Implausible::NotSettled));
    assert_eq!(stand(&mut supervisor), [0, -163_840, 0], "a quarter turn down");
    assert_eq!(supervisor.execute(Order::Arm), Ok(()));
    assert_eq!(supervisor.execute(Order::Run { host_timeout_ticks: None }), Ok(()));
    let record = supervisor.tick(&[0; 3], Health::default());
    assert_eq!((record.state, record.fault), (State::Running, None));
    assert!(record.codes[1].0.abs() < 10, "it hangs where its reference is: {:?}", record.codes);
}

#[test]
fn a_joint_whose_encoder_never_moved_is_not_armed_where_it_is_fed_back() {
    let mut supervisor = lost(holding(Mode::Pd));
    turned_by_hand(&mut supervisor, &[0, 2]);
    supervisor.execute(home()).unwrap();
    stand(&mut supervisor);
    assert_eq!(supervisor.execute(Order::Arm), implausible(2, Implausible::NeverMoved));
    // It is turned, but where it was when home was told nobody knows.
    turned_by_hand(&mut supervisor, &[1]);
    assert_eq!(supervisor.is_position_known(), [true, false, true]);
    assert_eq!(supervisor.execute(Order::Arm), implausible(2, Implausible::NoHome));
    let mode = [Mode::Pd, Mode::OpenLoop, Mode::Pd];
    supervisor.replace(Controller::new(ParameterBlock { mode, ..holding(Mode::Pd) })).unwrap();
    stand(&mut supervisor);
    assert_eq!(supervisor.execute(Order::Arm), Ok(()), "new parameters leave the others known");
}

/// What was told of an encoder is void once it has failed, running or not.
#[test]
fn an_encoder_that_failed_must_move_and_be_told_again() {
    for is_running in [true, false] {
        let mut supervisor = lost(holding(Mode::Pd));
        turned_by_hand(&mut supervisor, &[0, 1, 2]);
        supervisor.execute(home()).unwrap();
        stand(&mut supervisor);
        if is_running {
            supervisor.execute(Order::Arm).unwrap();
            supervisor.execute(Order::Run { host_timeout_ticks: None }).unwrap();
        }
        // The plug of encoder 2 comes off and the count goes astray.
        let astray = |supervisor: &mut Supervisor, ticks| {
            for _ in 0..ticks {
                supervisor.tick(&[0, 7000, 0], Health::default());
            }
        };
        astray(&mut supervisor, 200);
        let fault = supervisor.fault().map(|record| record.fault);
        assert_eq!(fault, is_running.then_some(Fault::EncoderJump));
        let _ = supervisor.execute(Order::ClearFault);
        assert_eq!(supervisor.is_position_known(), [true, false, true]);
        assert_eq!(supervisor.execute(Order::Arm), implausible(2, Implausible::NeverMoved));
        for tick in 0..400 {
            let turned = 7000 + 3 * i32::min(tick, 200 - tick.min(200));
            supervisor.tick(&[0, turned, 0], Health::default());
        }
        assert_eq!(supervisor.execute(Order::Arm), implausible(2, Implausible::NoHome));
        supervisor.execute(home()).unwrap();
        astray(&mut supervisor, 200);
        assert_eq!(supervisor.execute(Order::Arm), Ok(()));
    }
}

#[test]
fn what_was_told_is_void_with_another_encoder() {
    let mut supervisor = lost(holding(Mode::Pd));
    turned_by_hand(&mut supervisor, &[0, 1, 2]);
    supervisor.execute(home()).unwrap();
    let other = ParameterBlock { encoder_counts_per_turn: 4096, ..holding(Mode::Pd) };
    supervisor.replace(Controller::new(other)).unwrap();
    assert_eq!(stand(&mut supervisor), [0; 3]);
    assert_eq!(supervisor.execute(Order::Arm), implausible(1, Implausible::NoHome));
}

#[test]
fn it_is_told_at_rest_and_disarmed_and_as_often_as_wanted() {
    let mut supervisor = lost(holding(Mode::Pd));
    assert_eq!(supervisor.execute(home()), implausible(1, Implausible::NotSettled));
    for tick in 0..300 {
        supervisor.tick(&[20 * tick, 0, 0], Health::default());
    }
    assert_eq!(supervisor.execute(home()), implausible(1, Implausible::Moving));
    turned_by_hand(&mut supervisor, &[0, 1, 2]);
    stand(&mut supervisor);
    for _ in 0..3 {
        supervisor.execute(home()).unwrap();
        assert_eq!(stand(&mut supervisor), [0, -163_840, 0]);
    }
    supervisor.execute(Order::Arm).unwrap();
    assert_eq!(supervisor.execute(home()), Err(OrderError::NotNow { state: State::Armed }));
}

#[test]
fn encoders_that_know_where_they_are_need_not_be_told() {
    let mut supervisor = Supervisor::default();
    supervisor.replace(Controller::new(holding(Mode::Pd))).unwrap();
    supervisor.booted(BootReport::default());
    stand(&mut supervisor);
    assert_eq!(supervisor.execute(Order::Arm), Ok(()));
}

#[test]
fn a_run_does_not_begin_while_a_joint_moves() {
    let mut supervisor = lost(ParameterBlock { mode: [Mode::OpenLoop; 3], ..holding(Mode::Pd) });
    turned_by_hand(&mut supervisor, &[0, 1, 2]);
    supervisor.execute(home()).unwrap();
    stand(&mut supervisor);
    supervisor.execute(Order::Arm).unwrap();
    for tick in 0..100 {
        supervisor.tick(&[0, tick * tick / 10, 0], Health::default());
    }
    let run = Order::Run { host_timeout_ticks: None };
    assert_eq!(supervisor.execute(run), implausible(2, Implausible::Moving));
    assert_ne!(supervisor.fault().map(|record| record.fault), Some(Fault::Speed));
}
