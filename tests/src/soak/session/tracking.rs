//! Tracking errors of a run, and that they do not grow.

use firmware::supervisor::TickRecord;
use firmware::{Mode, ParameterBlock};

use super::super::arm::COUNTS_PER_TURN;
use super::Soak;

impl Soak {
    /// Adds the squares of tracking errors in the mode that knows the model.
    pub(super) fn add_squares(&mut self, block: &ParameterBlock, sums: &mut [f64; 3]) {
        let Some(record) = self.true_records.back() else { return };
        let seen = self.arm_at(record);
        for joint in (0..3).filter(|joint| block.mode[*joint] == Mode::PdModel) {
            let error_rad = f64::from(record.reference[joint].minus(seen[joint]));
            sums[joint] += error_rad * error_rad;
            self.counters.worst_error_rad = self.counters.worst_error_rad.max(error_rad.abs());
        }
    }

    fn arm_at(&self, record: &TickRecord) -> [firmware::Angle; 3] {
        record.counts.map(|count| {
            let within = count.rem_euclid(COUNTS_PER_TURN as i32) as f64;
            let units = within / f64::from(COUNTS_PER_TURN) * 2f64.powi(32);
            firmware::Angle(units as u32 as i32)
        })
    }

    pub(super) fn assert_no_drift(&mut self, first: [f64; 3], last: [f64; 3], ticks: u64) {
        for joint in 0..3 {
            let [before, after] = [first, last].map(|sums| (sums[joint] / ticks as f64).sqrt());
            let drift = (after - before).abs();
            self.counters.worst_drift_rad = self.counters.worst_drift_rad.max(drift);
            assert!(after <= 1.3 * before + 5e-4, "joint {}: {before} to {after} rad", joint + 1);
        }
    }
}
