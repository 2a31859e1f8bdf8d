//! What goes wrong on purpose, and that it is found.

use firmware::link::Command;
use firmware::supervisor::{CHECK_EVERY_TICKS, Fault, State};

use super::{HEARTBEAT_TICKS, HOST_TIMEOUT, Soak};

/// Injected one after the other.
const FAULTS: [Fault; 8] = [
    Fault::EncoderJump,
    Fault::TickOverrun,
    Fault::LinkLost,
    Fault::Converter,
    Fault::CorruptParameters,
    Fault::EmergencyStop,
    Fault::DrivePower,
    Fault::Clock,
];

impl Soak {
    /// Makes something go wrong, sees it found in time, and clears it.
    pub(super) fn inject(&mut self, which: u32) {
        let which = which as usize;
        let fault = FAULTS[which % FAULTS.len()];
        self.expected = Some(fault);
        let due_ticks = self.inject_fault(fault, which % 3);
        for _ in 0..due_ticks {
            if fault != Fault::LinkLost {
                self.send_heartbeat_when_due();
            }
            self.tick();
        }
        let found = self.runtime.supervisor.fault().expect("it is found");
        assert_eq!(found.fault, fault);
        if fault == Fault::LinkLost {
            assert_eq!(found.tick, self.heard_at + u32::from(HOST_TIMEOUT) + 1);
        }
        self.counters.faults_injected += 1;
        self.expected = None;
        self.remove_fault(fault);
        let report = self.report();
        assert_eq!(report.fault.map(|record| record.fault), Some(fault), "the host is told");
        (0..200).for_each(|_| self.tick());
        self.request(Command::ClearFault).expect("a fault that is gone can be cleared");
    }

    /// The ticks in which the fault must be found.
    fn inject_fault(&mut self, fault: Fault, joint: usize) -> u64 {
        match fault {
            Fault::EncoderJump => self.arm.jump(joint, 5000),
            Fault::TickOverrun => self.injected.overrun = true,
            Fault::Converter => self.injected.converter_fault = true,
            Fault::EmergencyStop => self.injected.emergency_stop = true,
            Fault::DrivePower => self.injected.drive_power_lost = true,
            Fault::Clock => self.injected.clock_wrong = true,
            Fault::CorruptParameters => {
                // The lowest bit of a gain.
                self.runtime.supervisor.corrupt_parameters(|block| {
                    let gain = &mut block.gains[joint].proportional_v_per_rad;
                    *gain = f32::from_bits(gain.to_bits() ^ 1);
                });
                return u64::from(CHECK_EVERY_TICKS) + 1;
            }
            // Nothing is sent from now on; the last heartbeat is at most 100 ticks old.
            _ => {
                (0..u64::from(HOST_TIMEOUT) - 2 * HEARTBEAT_TICKS).for_each(|_| self.tick());
                return 3 * HEARTBEAT_TICKS;
            }
        }
        1
    }

    fn remove_fault(&mut self, fault: Fault) {
        self.arm.forget_jumps();
        while self.runtime.supervisor.state() == State::Stopping {
            self.tick();
        }
        if fault == Fault::CorruptParameters {
            // The flash still has them; the fault is latched over the reset.
            let boot_state = self.power_cycle();
            assert_eq!(
                boot_state.fault.map(|record| record.fault),
                Some(fault),
                "boot_state over a reset"
            );
            self.handshake();
        }
    }
}
