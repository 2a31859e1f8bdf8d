//! Emergency stop, drive power, ranges and controlled stops.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::block;
use firmware::block::{HardLimits, PositionLimits};
use firmware::reference::{Motion, Reference};
use firmware::supervisor::{
    BootReport, DriveOutputs, Fault, Health, Order, OrderError, State, Supervisor, TickRecord,
};
use firmware::{Controller, Mode, ParameterBlock};

const COUNTS_PER_RAD: f64 = 655_360.0 / std::f64::consts::TAU;
const FINE: Health = Health {
    overrun: false,
    converter_fault: false,
    parameters_corrupt: false,
    clock_wrong: false,
    emergency_stop: false,
    drive_power_lost: false,
    host_heard: false,
    tick_time_tenth_us: 0,
};

/// An arm that is wherever its reference is.
struct Follower {
    supervisor: Supervisor,
    counts: [i32; 3],
}

impl Follower {
    /// Disarmed, at rest where the reference begins.
    fn new(block: ParameterBlock) -> Self {
        let start = Controller::new(block.clone()).start_of_reference();
        let counts = start.map(|angle| angle.in_counts(block.encoder_counts_per_turn));
        let mut supervisor = Supervisor::default();
        supervisor.replace(Controller::new(block)).unwrap();
        supervisor.booted(BootReport::default());
        let mut follower = Self { supervisor, counts };
        for _ in 0..200 {
            follower.tick(FINE);
        }
        follower
    }

    fn run(&mut self, host_timeout_ticks: Option<u32>) {
        self.supervisor.execute(Order::Arm).unwrap();
        self.supervisor.execute(Order::Run { host_timeout_ticks }).unwrap();
    }

    fn tick(&mut self, health: Health) -> TickRecord {
        let record = self.supervisor.tick(&self.counts, health);
        if record.state.drives() {
            self.counts = record.reference.map(|angle| angle.in_counts(655_360));
        }
        record
    }

    /// Ticks until a fault; the tick's number from here, from 1 on.
    fn until_fault(&mut self, most: u32) -> Option<(u32, TickRecord)> {
        (1..=most).map(|k| (k, self.tick(FINE))).find(|(_, record)| record.fault.is_some())
    }
}

/// Joint 2 held level, which takes some volts, joint 3 moved to and fro.
fn moving(speed: f32) -> ParameterBlock {
    let mut block = block(Mode::PdModel);
    block.reference = Reference::hold([0.0; 3]);
    block.reference.motion[2] =
        Motion::Quintic { from_rad: 0.0, to_rad: 2.0, duration_s: 3.75 / speed };
    block
}

fn range(lower_rad: f32, upper_rad: f32) -> Option<PositionLimits> {
    Some(PositionLimits { lower_rad, upper_rad, braking_rad_per_s2: 20.0 })
}

fn zero(record: &TickRecord) -> bool {
    record.codes.iter().all(|code| code.0 == 0)
}

#[test]
fn an_emergency_stop_and_lost_power_end_a_run_and_need_a_new_arming() {
    let pressed = Health { emergency_stop: true, ..FINE };
    let lost = Health { drive_power_lost: true, ..FINE };
    let cases = [
        (pressed, Fault::EmergencyStop, OrderError::EmergencyStop),
        (lost, Fault::DrivePower, OrderError::NoDrivePower),
    ];
    for (health, fault, refusal) in cases {
        let mut arm = Follower::new(moving(1.0));
        assert!(arm.tick(health).fault.is_none(), "no fault while disarmed");
        assert_eq!(arm.supervisor.execute(Order::Arm), Err(refusal));
        for runs in [false, true] {
            arm.tick(FINE);
            arm.supervisor.execute(Order::Arm).unwrap();
            if runs {
                arm.supervisor.execute(Order::Run { host_timeout_ticks: None }).unwrap();
                (0..100).for_each(|_| assert!(arm.tick(FINE).state == State::Running));
            }
            let record = arm.tick(health);
            assert_eq!((record.fault, record.state), (Some((fault, 0)), State::Faulted));
            assert!(zero(&record), "in the same tick");
            assert!(zero(&arm.tick(FINE)), "the cause is gone, the fault stays");
            arm.supervisor.execute(Order::ClearFault).unwrap();
            assert_eq!(arm.supervisor.state(), State::Disarmed, "it must be armed anew");
        }
    }
}

#[test]
fn amplifiers_are_enabled_from_arming_on_and_brakes_released_while_it_drives() {
    let mut arm = Follower::new(moving(1.0));
    let outputs = |enable, release_brakes| DriveOutputs { enable, release_brakes };
    assert_eq!(arm.supervisor.drive_outputs(), outputs(false, false));
    arm.supervisor.execute(Order::Arm).unwrap();
    assert_eq!(arm.supervisor.drive_outputs(), outputs(true, false));
    arm.supervisor.execute(Order::Run { host_timeout_ticks: Some(50) }).unwrap();
    assert_eq!(arm.supervisor.drive_outputs(), outputs(true, true));
    arm.until_fault(100).expect("the host is silent");
    let mut engaged_at = None;
    for k in 0.. {
        match (arm.tick(FINE).state, arm.supervisor.drive_outputs()) {
            (State::Stopping, DriveOutputs { enable: true, release_brakes: false }) => {
                engaged_at.get_or_insert(k);
            }
            (State::Stopping, DriveOutputs { enable, .. }) => {
                assert!(enable && engaged_at.is_none());
            }
            (_, outputs) => {
                assert_eq!(outputs, DriveOutputs::default());
                let ticks = k - engaged_at.expect("before the voltage goes");
                assert!((200..=201).contains(&ticks), "{ticks}");
                return;
            }
        }
    }
}

#[test]
fn a_silent_host_brakes_the_arm_and_holds_it_before_the_voltage_goes() {
    let mut arm = Follower::new(moving(1.0));
    arm.run(Some(1500));
    let (tick, record) = arm.until_fault(3000).unwrap();
    assert_eq!((tick, record.fault), (1501, Some((Fault::LinkLost, 0))));
    assert_eq!(record.state, State::Stopping);
    let (mut before, mut speed, mut stopping) = (arm.counts[2], f64::MAX, 0);
    loop {
        let record = arm.tick(FINE);
        if record.state == State::Faulted {
            assert!(zero(&record));
            break;
        }
        stopping += 1;
        assert!(record.codes[1].to_volts() > 2.0, "joint 2 is held, not dropped");
        let now = f64::from(arm.counts[2] - before) / COUNTS_PER_RAD * 1e3;
        assert!(now <= speed + 0.05, "{now} after {speed} rad/s: it only brakes");
        (before, speed) = (arm.counts[2], now);
        assert!(stopping < 500 || now.abs() < 0.03, "{now} rad/s after half a second");
    }
    assert_eq!(stopping, 2000);
    assert_eq!(arm.supervisor.fault().unwrap().fault, Fault::LinkLost, "the first cause");
}

#[test]
fn holding_has_an_end() {
    let mut block = moving(3.0);
    block.reference.duration_s = 2.0;
    block.safety.hold_s = 3.0;
    let mut arm = Follower::new(block);
    arm.run(None);
    let (tick, record) = arm.until_fault(8000).expect("it is held for ever");
    assert_eq!((record.fault, record.state), (Some((Fault::HoldTooLong, 0)), State::Stopping));
    assert!((5000..5003).contains(&tick), "{tick}");
    let stopping = (0..).take_while(|_| arm.tick(FINE).state == State::Stopping).count();
    assert_eq!(stopping, 2000, "held while the brakes engage");
}

#[test]
fn a_graver_fault_cuts_a_controlled_stop_short() {
    let mut arm = Follower::new(moving(1.0));
    arm.run(Some(500));
    arm.until_fault(600).unwrap();
    for order in [Order::Stop, Order::Disarm, Order::ClearFault] {
        assert!(arm.supervisor.execute(order).is_err(), "it is stopping already");
    }
    arm.tick(FINE);
    let record = arm.tick(Health { emergency_stop: true, ..FINE });
    assert!(zero(&record) && record.state == State::Faulted);
    assert_eq!(record.fault, Some((Fault::LinkLost, 0)), "the first cause is kept");
}

#[test]
fn a_joint_is_braked_before_the_end_of_its_range() {
    for (speed, upper_rad) in [(0.5, 1.0), (1.0, 1.2), (3.0, 1.0), (6.0, 1.3)] {
        let mut block = moving(speed);
        block.safety.position[2] = range(-1.0, upper_rad);
        let mut arm = Follower::new(block);
        arm.run(None);
        let (_, record) = arm.until_fault(8000).expect("the reference goes to 2 rad");
        assert_eq!(record.fault, Some((Fault::PositionLimit, 3)));
        assert_eq!(record.state, State::Stopping);
        while arm.tick(FINE).state == State::Stopping {}
        let rest_rad = f64::from(arm.counts[2]) / COUNTS_PER_RAD;
        let short_rad = f64::from(upper_rad) - rest_rad;
        println!("{speed} rad/s: at rest {short_rad:.4} rad before {upper_rad} rad");
        assert!((0.0..0.1).contains(&short_rad), "{rest_rad} of {upper_rad} rad");
    }
}

#[test]
fn a_run_does_not_begin_outside_the_range_and_no_block_widens_the_rigs() {
    let mut block = moving(1.0);
    block.safety.position[1] = range(0.1, 1.0);
    let mut arm = Follower::new(block.clone());
    arm.supervisor.execute(Order::Arm).unwrap();
    let refused = arm.supervisor.execute(Order::Run { host_timeout_ticks: None });
    assert!(matches!(refused, Err(OrderError::OutsideRange { joint: 2, .. })), "{refused:?}");

    let hard = HardLimits { position: [None, range(-0.5, 0.5), None], ..HardLimits::default() };
    assert_eq!(hard.check(&block).unwrap_err().joint, 2);
    block.safety.position[1] = None;
    assert_eq!(hard.check(&block).unwrap_err().joint, 2, "no range is the widest");
    block.safety.position[1] = range(-0.4, 0.5);
    assert_eq!(hard.check(&block), Ok(()));
}

#[test]
fn a_range_upside_down_is_refused() {
    for wrong in [range(1.0, -1.0), range(f32::NAN, 1.0), range(0.0, 1e9)] {
        let mut block = moving(1.0);
        block.safety.position[0] = wrong;
        assert_eq!(block.check().unwrap_err().joint, 1, "{wrong:?}");
    }
}
