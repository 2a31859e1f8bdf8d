//! Every fault, injected: the output is zero in the tick that finds it, and stays so.
#![allow(missing_docs)]

#[allow(dead_code)]
mod common;

use common::block;
use common::played::{COUNTS_PER_RAD, Found, ZERO, play, quiet};
use common::supervised::{RUN, armed, disarmed, holding};
use firmware::reference::{Injection, Motion, Noise, Reference};
use firmware::supervisor::{
    BootReport, Fault, FaultRecord, Health, Order, OrderError, State, Supervisor,
};
use firmware::{Controller, Gains, Mode, ParameterBlock};

fn running(block: ParameterBlock) -> Supervisor {
    let mut supervisor = armed(block);
    supervisor.execute(RUN).unwrap();
    supervisor
}

/// A tick in which the board itself reports something, after ten good ones.
fn with_health(health: Health) -> Vec<([i32; 3], Health)> {
    let mut ticks = quiet(|_| [0; 3], 20);
    ticks[10].1 = health;
    ticks
}

fn assert_found(found: Option<Found>, fault: Fault, joint: u8, tick: u32) {
    let found = found.unwrap_or_else(|| panic!("{fault}: not found"));
    assert_eq!((found.record.fault, found.record.joint, found.tick), (fault, joint, tick));
}

#[test]
fn an_encoder_that_jumps() {
    let mut supervisor = running(holding(Mode::Pd));
    let ticks = quiet(|k| [0, if k < 11 { 0 } else { 600 }, 0], 20);
    assert_found(play(&mut supervisor, ticks), Fault::EncoderJump, 2, 11);
}

#[test]
fn a_jump_is_found_in_motion_and_over_the_wrap_of_the_count() {
    let mut block = holding(Mode::OpenLoop);
    block.safety.speed_rad_per_s = [20.0; 3];
    let mut supervisor = running(block);
    // Up to 9 rad/s within 0.1 s, on to the wrap of 32 bits: no jump. Then one back.
    let count =
        |k: i32| (i64::from(k.min(100)) * i64::from(k) * 9 / 2).min(900 * i64::from(k)) as i32;
    let ticks = quiet(|k| [0, 0, count(k) - i32::from(k > 500) * 700], 600);
    assert_found(play(&mut supervisor, ticks), Fault::EncoderJump, 3, 501);
}

#[test]
fn an_encoder_that_stands_while_its_reference_moves() {
    let motion = Motion::Quintic { from_rad: 0.0, to_rad: 1.0, duration_s: 1.0 };
    let mut block = holding(Mode::Pd);
    block.reference.motion[2] = motion;
    let found = play(&mut running(block), quiet(|_| [0; 3], 400)).unwrap();
    assert_eq!((found.record.fault, found.record.joint), (Fault::EncoderStuck, 3));
    // The quintic has gone 0.05 rad after 189 ms.
    assert!((185..195).contains(&found.tick), "{}", found.tick);
}

#[test]
fn an_encoder_that_stands_under_an_open_loop_command() {
    for fast_period_s in [10.0, 0.05] {
        let mut block = holding(Mode::OpenLoop);
        let excitation = firmware::reference::FrictionExcitation {
            first_amplitude_v: 8.0,
            last_amplitude_v: 8.0,
            growth_s: 1.0,
            slow_period_s: 10.0,
            fast_period_s,
        };
        block.reference.injection[0] = Injection::FrictionExcitation(excitation);
        let found = play(&mut running(block), quiet(|_| [0; 3], 4000)).unwrap();
        assert_eq!((found.record.fault, found.record.joint), (Fault::EncoderStuck, 1));
    }
}

#[test]
fn a_tracking_error() {
    // Away from the reference at 2 rad/s: 0.5 rad after 250 ms.
    let step = 2e-3 * COUNTS_PER_RAD;
    let ticks = quiet(|k| [(step * f64::from(k)) as i32, 0, 0], 300);
    assert_found(play(&mut running(holding(Mode::Pd)), ticks), Fault::TrackingError, 1, 251);
}

#[test]
fn a_joint_that_is_too_fast() {
    // 100 rad/s^2 without a reference.
    let count = |k: i32| (0.5e-4 * f64::from(k * k) * COUNTS_PER_RAD) as i32;
    let ticks = quiet(|k| [0, count(k), 0], 300);
    let found = play(&mut running(holding(Mode::OpenLoop)), ticks).unwrap();
    assert_eq!((found.record.fault, found.record.joint), (Fault::Speed, 2));
    // 15 rad/s are reached after 150 ms; the estimate has no lag.
    assert!((149..=152).contains(&found.tick), "{}", found.tick);
}

#[test]
fn a_command_that_stays_at_its_limit() {
    let mut block = holding(Mode::Pd);
    block.command_limit_v = 1.0;
    // 0.1 rad off from the first tick on, 8 V wanted: 500 ticks at the limit are allowed.
    let count = |k: i32| [0, 0, (0.1 * COUNTS_PER_RAD) as i32 * k.min(40) / 40];
    let found = play(&mut running(block), quiet(count, 600)).unwrap();
    assert_eq!((found.record.fault, found.record.joint), (Fault::Saturation, 3));
    assert!((501..510).contains(&found.tick), "{}", found.tick);
}

/// A block that cuts at 1 V, with 80 V/rad, and a motion to and fro of that share of ticks at it.
fn limit_cycle(away_ticks: i32, of_ticks: i32) -> Option<Found> {
    let mut block = holding(Mode::Pd);
    block.command_limit_v = 1.0;
    let mut supervisor = running(block);
    let there = (0.05 * COUNTS_PER_RAD) as i32;
    // A glide away from the reference and back within 20 ticks each.
    let count = |k: i32| {
        let at = k % of_ticks;
        there * at.min(away_ticks - at).clamp(0, 20) / 20
    };
    let found = play(&mut supervisor, quiet(|k| [0, 0, count(k)], 60_000));
    let [first, _, third] = supervisor.counters().saturated;
    assert!(first == 0 && (found.is_some() || third > 2000), "{third} ticks at the limit");
    found
}

#[test]
fn a_limit_cycle_at_the_limit_is_saturation_too() {
    for (away_ticks, of_ticks) in [(395, 400), (200, 400), (120, 400)] {
        let found = limit_cycle(away_ticks, of_ticks).expect("it goes on for a minute");
        assert_eq!((found.record.fault, found.record.joint), (Fault::Saturation, 3));
    }
}

#[test]
fn a_command_that_is_cut_now_and_then_is_counted_and_no_fault() {
    assert!(limit_cycle(60, 400).is_none());
}

#[test]
fn a_joint_that_should_move_and_does_not() {
    // Held 0.045 rad off with the amplifier off: 3.6 V and no motion.
    let mut block = holding(Mode::Pd);
    block.reference = Reference::hold([0.0, -1.57, 0.045]);
    let hanging = [0, (-1.57 * COUNTS_PER_RAD) as i32, 0];
    let mut supervisor = disarmed(block);
    play(&mut supervisor, quiet(|_| hanging, 200));
    supervisor.execute(Order::Arm).unwrap();
    supervisor.execute(RUN).unwrap();
    let found = play(&mut supervisor, quiet(|_| hanging, 2000)).expect("not found in 2 s");
    assert_eq!((found.record.fault, found.record.joint), (Fault::Stalled, 3));
    assert!((500..900).contains(&found.tick), "{}", found.tick);
    assert!(found.record.value > found.record.limit);
}

#[test]
fn a_joint_that_gravity_holds_against_its_voltage_is_not_stalled() {
    let mut block = block(Mode::PdModel);
    block.reference = Reference::hold([0.0; 3]);
    let mut supervisor = running(block);
    let ticks = quiet(|_| [0; 3], 5000);
    assert!(play(&mut supervisor, ticks).is_none());
    let code = supervisor.tick(&[0; 3], Health::default()).codes[1];
    assert!(code.to_volts() > 2.5, "stretched out, it is held by {} V", code.to_volts());
}

#[test]
fn a_tick_that_overran() {
    let ticks = with_health(Health { overrun: true, ..Health::default() });
    assert_found(play(&mut running(holding(Mode::Pd)), ticks), Fault::TickOverrun, 0, 11);
}

#[test]
fn a_converter_that_does_not_answer() {
    let ticks = with_health(Health { converter_fault: true, ..Health::default() });
    assert_found(play(&mut running(holding(Mode::Pd)), ticks), Fault::Converter, 0, 11);
}

#[test]
fn parameters_that_have_changed_in_memory() {
    let ticks = with_health(Health { parameters_corrupt: true, ..Health::default() });
    assert_found(play(&mut running(holding(Mode::Pd)), ticks), Fault::CorruptParameters, 0, 11);
}

#[test]
fn a_value_that_is_not_finite() {
    let mut block = holding(Mode::Pd);
    block.gains[1] = Gains { proportional_v_per_rad: 0.0, derivative_v_s_per_rad: f32::MAX };
    block.safety.saturation_s = 9.0;
    // Towards 1.5 rad/s; beyond 1 rad/s the product is too large for an f32.
    let count = |k: i32| [0, 157 * k, 0];
    let mut alone = Controller::new(block.clone());
    let quiet_ticks = [[0; 3]; 200];
    for counts in &quiet_ticks {
        alone.tick(counts);
    }
    alone.start();
    let first = (1..100).find(|&k| !alone.tick(&count(k)).is_finite(1)).unwrap();
    let found = play(&mut running(block), quiet(count, 100));
    assert_found(found, Fault::NotFinite, 2, first as u32);
}

#[test]
fn a_host_that_falls_silent_in_open_loop() {
    // Friction alone is compensated: there is nothing that could brake the joints.
    let mut supervisor = armed(holding(Mode::FrictionOnly));
    supervisor.execute(Order::Run { host_timeout_ticks: Some(50) }).unwrap();
    let mut ticks = quiet(|_| [0; 3], 200);
    for tick in [20, 60, 100] {
        ticks[tick - 1].1.host_heard = true;
    }
    assert_found(play(&mut supervisor, ticks), Fault::LinkLost, 0, 151);
    let mut alone = running(holding(Mode::Pd));
    assert!(play(&mut alone, quiet(|_| [0; 3], 5000)).is_none(), "it may, if it was not asked");
}

#[test]
fn what_the_boot_finds() {
    let latched = FaultRecord { fault: Fault::Speed, joint: 2, tick: 9, value: 20.0, limit: 15.0 };
    let armed = BootReport { was_armed: true, ..BootReport::default() };
    let causes = [
        (armed, Fault::Reset),
        (BootReport { supply_failed: true, ..armed }, Fault::BrownOut),
        (BootReport { watchdog_reset: true, ..armed }, Fault::Watchdog),
        (BootReport { watchdog_reset: true, ..BootReport::default() }, Fault::Watchdog),
        (
            BootReport { parameters_corrupt: true, ..BootReport::default() },
            Fault::CorruptParameters,
        ),
        (BootReport { converter_fault: true, ..BootReport::default() }, Fault::Converter),
        (
            BootReport { latched: Some(latched), watchdog_reset: true, ..BootReport::default() },
            Fault::Speed,
        ),
    ];
    for (report, fault) in causes {
        let mut supervisor = Supervisor::default();
        supervisor.replace(Controller::new(holding(Mode::Pd))).unwrap();
        assert_eq!(supervisor.tick(&[0; 3], Health::default()).codes, ZERO);
        supervisor.booted(report);
        assert_eq!(supervisor.state(), State::Faulted);
        assert_eq!(supervisor.fault().unwrap().fault, fault);
        assert_eq!(supervisor.tick(&[0; 3], Health::default()).codes, ZERO);
        assert_eq!(
            supervisor.execute(Order::Arm),
            Err(OrderError::NotNow { state: State::Faulted })
        );
        assert_eq!(supervisor.execute(Order::ClearFault), Ok(()));
        assert_eq!((supervisor.state(), supervisor.fault()), (State::Disarmed, None));
    }
    let mut supervisor = Supervisor::default();
    supervisor.booted(BootReport { supply_failed: true, ..BootReport::default() });
    assert_eq!(supervisor.state(), State::Disarmed, "a power-on");
}

#[test]
fn a_fault_is_left_by_a_clear_alone_and_not_while_its_cause_is_there() {
    let mut supervisor = running(holding(Mode::Pd));
    let broken = Health { converter_fault: true, ..Health::default() };
    supervisor.tick(&[0; 3], broken);
    for order in [Order::Arm, RUN, Order::Stop, Order::Disarm] {
        assert_eq!(supervisor.execute(order), Err(OrderError::NotNow { state: State::Faulted }));
    }
    assert_eq!(supervisor.execute(Order::ClearFault), Err(OrderError::FaultPersists));
    supervisor.tick(&[0; 3], Health::default());
    assert_eq!(supervisor.execute(Order::ClearFault), Ok(()));
    assert_eq!(supervisor.state(), State::Disarmed);
}

#[test]
fn the_output_is_zero_unless_it_runs() {
    // 0.04 rad off its reference: a running controller puts out up to 3.2 V.
    let mut block = holding(Mode::Pd);
    block.reference = Reference::hold([0.04; 3]);
    let mut supervisor = Supervisor::default();
    let codes = |supervisor: &mut Supervisor| supervisor.tick(&[0; 3], Health::default()).codes;
    assert_eq!(codes(&mut supervisor), ZERO, "without parameters");
    supervisor.replace(Controller::new(block.clone())).unwrap();
    assert_eq!(codes(&mut supervisor), ZERO, "boot");
    supervisor.booted(BootReport::default());
    assert!((0..200).all(|_| codes(&mut supervisor) == ZERO), "disarmed");
    supervisor.execute(Order::Arm).unwrap();
    assert!((0..200).all(|_| codes(&mut supervisor) == ZERO), "armed");
    supervisor.execute(RUN).unwrap();
    codes(&mut supervisor);
    assert!((0..300).all(|_| codes(&mut supervisor) != ZERO), "running");
    assert!(codes(&mut supervisor).iter().all(|code| code.0 > 6_000), "0.6 of it, 1.9 V");
    supervisor.execute(Order::Stop).unwrap();
    assert_eq!(supervisor.state(), State::Armed);
    assert_eq!(codes(&mut supervisor), ZERO, "stopped");
    supervisor.execute(RUN).unwrap();
    codes(&mut supervisor);
    assert_ne!(codes(&mut supervisor), ZERO);
    supervisor.execute(Order::Disarm).unwrap();
    assert_eq!((supervisor.state(), codes(&mut supervisor)), (State::Disarmed, ZERO));
}

#[test]
fn orders_out_of_turn_change_nothing() {
    let not_now = |state| Err(OrderError::NotNow { state });
    let mut supervisor = Supervisor::default();
    for order in [Order::Arm, RUN, Order::Stop, Order::Disarm, Order::ClearFault] {
        assert_eq!(supervisor.execute(order), not_now(State::Boot));
    }
    supervisor.booted(BootReport::default());
    assert_eq!(supervisor.execute(Order::Arm), Err(OrderError::NoParameters));
    assert_eq!(supervisor.execute(RUN), not_now(State::Disarmed));
    assert_eq!(supervisor.execute(Order::ClearFault), not_now(State::Disarmed));
    let mut supervisor = armed(holding(Mode::Pd));
    assert_eq!(supervisor.execute(Order::Arm), not_now(State::Armed));
    let other = || Controller::new(holding(Mode::PdModel));
    assert_eq!(supervisor.replace(other()), not_now(State::Armed));
    supervisor.execute(RUN).unwrap();
    assert_eq!(supervisor.replace(other()), not_now(State::Running));
    assert_eq!(supervisor.execute(RUN), not_now(State::Running));
}

#[test]
fn noise_within_the_limits_is_no_fault_in_any_mode() {
    for mode in Mode::ALL {
        let mut block = holding(mode);
        let noise = Noise { rms_v: 1.0, bandwidth_hz: 200.0, seed: 3 };
        block.reference.injection = [Injection::Noise(noise); 3];
        let dither = |k: i32| [7 * (k % 3), -(k % 5), 2 * (k % 2)];
        assert!(play(&mut running(block), quiet(dither, 5000)).is_none(), "{mode:?}");
    }
}
