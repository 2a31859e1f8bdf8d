//! A tick's last part where the rig measures the converter's outputs.

use super::fault::Fault;
use super::joint_monitor::LimitViolation;
use super::state_machine::Supervisor;
use super::tick_record::TickRecord;

impl Supervisor {
    /// Takes the voltages that were measured before the codes of this tick acted [V]; after
    /// [`Self::complete`], whose record this is. False in the tick that finds a fault: outputs off.
    ///
    /// Whoever measures no outputs never calls this.
    #[inline(never)]
    pub fn outputs_measured(&mut self, measured_v: &[f32; 3], record: &TickRecord) -> bool {
        let found = match self.state.enables() {
            true => self.outputs.look(measured_v),
            false => {
                self.outputs.look_away();
                None
            }
        };
        self.outputs.acting = record.codes;
        match found {
            Some((index, off_v)) => self.enter_output_fault(index, off_v),
            None => true,
        }
    }

    #[cold]
    fn enter_output_fault(&mut self, index: usize, value: f32) -> bool {
        let limit = self.outputs.limit_v;
        self.enter_fault(
            index as u8 + 1,
            LimitViolation { fault: Fault::OutputVoltage, value, limit },
        );
        false
    }
}
