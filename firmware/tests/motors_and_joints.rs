//! Motors that get too warm, joints that the rig does not have, hosts that stay silent.
#![allow(missing_docs)]

#[allow(dead_code)]
mod bench;
#[allow(dead_code)]
mod common;

use bench::operator::{Bench, Owned, encoded};
use common::supervised::{RUN, armed, holding};
use firmware::block::{HardLimits, MotorHeating};
use firmware::link::Command;
use firmware::reference::{Injection, Motion, Noise};
use firmware::supervisor::{Fault, Health, Order, State, Supervisor, TickRecord};
use firmware::{Controller, Mode, ParameterBlock};

/// A motor that bears 2 V for ever and warms within 10 s.
const MOTOR: MotorHeating = MotorHeating { continuous_v: 2.0, time_constant_s: 10.0 };

/// Joint 2 is held against its reference by somebody: feedback asks for so many volts.
fn pushing(volts: f32, heating: Option<MotorHeating>) -> ParameterBlock {
    let mut block = holding(Mode::Pd);
    block.safety.heating[1] = heating;
    block.safety.saturation_s = 1e3;
    block.safety.stalled_s = 1e3;
    block.safety.hold_s = 1e3;
    block.reference.duration_s = 1e3;
    block.safety.start_error_rad = [0.2; 3];
    block.reference.motion[1] = Motion::Hold { angle_rad: volts / 80.0 };
    block
}

fn running(block: ParameterBlock) -> Supervisor {
    let mut supervisor = armed(block);
    supervisor.execute(RUN).unwrap();
    supervisor
}

/// The first record with a fault, and the volts of joint 2 in every tick up to it.
fn play(supervisor: &mut Supervisor, ticks: u32) -> (Option<TickRecord>, Vec<f32>) {
    let mut volts = Vec::new();
    for _ in 0..ticks {
        let record = supervisor.tick(&[0; 3], Health::default());
        volts.push(record.codes[1].to_volts());
        if record.fault.is_some() {
            return (Some(record), volts);
        }
    }
    (None, volts)
}

#[test]
fn a_motor_that_needs_more_than_it_bears_is_limited_first_and_braked_then() {
    let mut supervisor = running(pushing(6.0, Some(MOTOR)));
    let (found, volts) = play(&mut supervisor, 60_000);
    let record = found.expect("it is found");
    assert_eq!(record.fault, Some((Fault::MotorTooHot, 2)));
    assert_eq!(record.state, State::Stopping, "an arm that hangs must not drop");
    // After 1 s of 6 V, the mean square is 3 of 4 V^2: from there on less and less.
    let full = volts.iter().skip(1000).position(|v| *v < 5.9).unwrap() + 1000;
    assert!((1200..1500).contains(&full), "faded in over half a second: {full}");
    assert!(volts.windows(2).skip(full).all(|pair| pair[1] <= pair[0]));
    let last_v = *volts.last().unwrap();
    assert!((2.2..2.4).contains(&last_v), "{last_v} V, a tenth above what it bears");
    let told = supervisor.fault().unwrap();
    assert!(told.value > told.limit && told.limit == 2.0 && told.value < 2.01, "{told}");
}

#[test]
fn a_command_that_stays_at_the_limit_of_a_warm_motor_is_braked_and_not_dropped() {
    let mut block = pushing(6.0, Some(MOTOR));
    block.safety.saturation_s = 0.5;
    let (found, volts) = play(&mut running(block), 60_000);
    let record = found.expect("it is found");
    assert_eq!((record.fault, record.state), (Some((Fault::MotorTooHot, 2)), State::Stopping));
    assert!((1700..2100).contains(&volts.len()), "half a second later: {}", volts.len());
}

#[test]
fn what_a_motor_bears_changes_nothing_below_it_and_heat_outlasts_an_upload() {
    let (found, without) = play(&mut running(pushing(1.6, None)), 30_000);
    assert!(found.is_none());
    let mut supervisor = running(pushing(1.6, Some(MOTOR)));
    let (found, with) = play(&mut supervisor, 30_000);
    assert!(found.is_none() && with == without, "the same bits");

    let mut supervisor = running(pushing(6.0, Some(MOTOR)));
    play(&mut supervisor, 1000);
    supervisor.execute(Order::Disarm).unwrap();
    supervisor.replace(Controller::new(pushing(6.0, Some(MOTOR)))).unwrap();
    for _ in 0..200 {
        supervisor.tick(&[0; 3], Health::default());
    }
    supervisor.execute(Order::Arm).unwrap();
    supervisor.execute(RUN).unwrap();
    let (_, volts) = play(&mut supervisor, 1000);
    assert!(volts[999] < 5.5, "{} V: it was warm", volts[999]);
}

#[test]
fn a_block_with_no_more_than_the_rigs_motors_bear_is_taken() {
    let hard = HardLimits { heating: [None, Some(MOTOR), None], ..HardLimits::default() };
    let bearing = |motor| {
        let mut block = holding(Mode::Pd);
        block.safety.heating[1] = motor;
        hard.check(&block).map_err(|error| error.joint)
    };
    assert_eq!(bearing(Some(MOTOR)), Ok(()));
    assert_eq!(bearing(None), Err(2), "unknown is no limit");
    assert_eq!(bearing(Some(MotorHeating { continuous_v: 3.0, ..MOTOR })), Err(2));
    for wrong in [
        MotorHeating { continuous_v: 0.0, ..MOTOR },
        MotorHeating { time_constant_s: f32::NAN, ..MOTOR },
    ] {
        assert_eq!(pushing(1.0, Some(wrong)).check().unwrap_err().joint, 2);
    }
}

/// Joint 1 is not there; its input has noise that no joint can make.
fn without_first() -> ParameterBlock {
    let mut block = holding(Mode::Pd);
    (block.in_use[0], block.mode[0]) = (false, Mode::OpenLoop);
    block
}

fn noise(k: u32) -> i32 {
    (k.wrapping_mul(2_654_435_761) >> 12) as i32
}

#[test]
fn noise_at_a_joint_that_the_rig_lacks_is_no_fault_and_its_output_stays_zero() {
    let mut supervisor = Supervisor::default();
    supervisor.replace(Controller::new(without_first())).unwrap();
    supervisor.booted(Default::default());
    let tick = |supervisor: &mut Supervisor, k| {
        let record = supervisor.tick(&[noise(k), 0, 0], Health::default());
        assert_eq!((record.fault, record.codes[0].0), (None, 0), "tick {k}");
        record.state
    };
    assert!((0..200).all(|k| tick(&mut supervisor, k) == State::Disarmed));
    assert_eq!(supervisor.execute(Order::Arm), Ok(()));
    assert!((200..300).all(|k| tick(&mut supervisor, k) == State::Armed));
    assert_eq!(supervisor.execute(RUN), Ok(()));
    assert!((300..5000).all(|k| tick(&mut supervisor, k) == State::Running));
    // The same noise at a joint that is there.
    let record = supervisor.tick(&[0, 60_000, 0], Health::default());
    assert_eq!(record.fault, Some((Fault::EncoderJump, 2)));
}

#[test]
fn a_joint_that_is_not_there_gets_no_voltage_whatever_a_block_says() {
    let refused = |change: &dyn Fn(&mut ParameterBlock)| {
        let mut block = without_first();
        change(&mut block);
        block.check().unwrap_err().joint
    };
    assert_eq!(without_first().check(), Ok(()));
    assert_eq!(refused(&|block| block.mode[0] = Mode::Pd), 1);
    let noise = Injection::Noise(Noise { rms_v: 0.1, bandwidth_hz: 100.0, seed: 1 });
    assert_eq!(refused(&|block| block.reference.injection[0] = noise), 1);
    assert_eq!(refused(&|block| (block.in_use, block.mode) = ([false; 3], [Mode::OpenLoop; 3])), 0);
}

/// The hard limit of a host's silence [ms].
const CEILING_MS: u32 = 10_000;

#[test]
fn no_order_lets_a_host_be_silent_for_longer_than_the_rig_allows() {
    // Ticks of silence until the fault, for what was asked [ms].
    for (asked, ticks) in [(None, CEILING_MS), (Some(60_000), CEILING_MS), (Some(50), 50)] {
        let mut bench = Bench::new(None);
        let mut block = holding(Mode::Pd);
        block.reference.duration_s = 1e3;
        assert_eq!(bench.upload(&encoded(&block), Command::Use), Ok(Owned::InUse));
        bench.stand(200);
        bench.ask(Command::Arm).unwrap();
        bench.ask(Command::Run { host_timeout_ms: asked }).unwrap();
        bench.stand(ticks + 1);
        assert_eq!(bench.supervisor.fault(), None, "{asked:?}");
        bench.stand(1);
        assert_eq!(bench.supervisor.fault().map(|found| found.fault), Some(Fault::LinkLost));
    }
}
