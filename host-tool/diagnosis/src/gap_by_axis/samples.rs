//! One joint's residuals over all logs, as one list of samples.

use crate::criteria::AxisCriteria;
use crate::result::{JointResiduals, LogResiduals};

/// Samples of one joint, log after log.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Number of the log of each sample.
    pub log: Vec<usize>,
    /// Which fifth of the stretches each sample belongs to.
    pub fold: Vec<usize>,
    /// Time since the log began [s].
    pub time_s: Vec<f64>,
    /// Angle [rad].
    pub position_rad: Vec<f64>,
    /// Velocity [rad/s].
    pub velocity_rad_per_s: Vec<f64>,
    /// Acceleration [rad/s^2].
    pub acceleration_rad_per_s2: Vec<f64>,
    /// Coriolis and gravity torque [Nm].
    pub load_nm: Vec<f64>,
    /// Command [V].
    pub command_v: Vec<f64>,
    /// Residual [V].
    pub residual_v: Vec<f64>,
    /// Direction of motion, -1 to 1, continuous through standstill.
    pub direction: Vec<f64>,
    /// The thresholds by which they are judged.
    pub criteria: AxisCriteria,
    /// Sum of squares that noise alone leaves [V^2].
    pub floor_v2: f64,
}

impl Samples {
    /// The samples of every joint in the logs, by number, with the residual that `pick` names.
    pub fn of_joints(
        logs: &[LogResiduals],
        criteria: &AxisCriteria,
        pick: impl Fn(&JointResiduals) -> &Vec<f64>,
    ) -> Vec<Self> {
        let mut joints: Vec<u8> =
            logs.iter().flat_map(|log| log.joints.iter().map(|joint| joint.joint)).collect();
        joints.sort_unstable();
        joints.dedup();
        joints.into_iter().map(|joint| Self::of_joint(logs, joint, criteria, &pick)).collect()
    }

    fn of_joint(
        logs: &[LogResiduals],
        joint: u8,
        criteria: &AxisCriteria,
        pick: &impl Fn(&JointResiduals) -> &Vec<f64>,
    ) -> Self {
        let mut samples = Self { joint, criteria: criteria.clone(), ..Self::default() };
        let spans = logs.iter().map(|log| span_s(&log.time_s));
        let longest_s = criteria.longest_piece_s;
        let stretch_s = (spans.sum::<f64>() / criteria.fewest_pieces).clamp(1e-3, longest_s);
        let mut stretches = 0;
        for (number, log) in logs.iter().enumerate() {
            if let Some(columns) = log.joints.iter().find(|columns| columns.joint == joint) {
                samples.append(number, &log.time_s, columns, pick(columns), stretch_s, stretches);
            }
            stretches += (span_s(&log.time_s) / stretch_s).ceil() as usize + 1;
        }
        samples.direction = direction(&samples.velocity_rad_per_s, criteria.standstill_part);
        samples
    }

    /// Appends a log's samples; those that are not finite are left out.
    fn append(
        &mut self,
        number: usize,
        time_s: &[f64],
        columns: &JointResiduals,
        residual_v: &[f64],
        stretch_s: f64,
        stretches: usize,
    ) {
        let (q, qd) = (&columns.position_rad, &columns.velocity_rad_per_s);
        let (qdd, load) = (&columns.acceleration_rad_per_s2, &columns.load_nm);
        let u = &columns.command_v;
        let others = [q, qd, qdd, load, u].map(Vec::len);
        let count = others.into_iter().chain([residual_v.len()]).fold(time_s.len(), usize::min);
        let began_s = time_s.first().copied().unwrap_or(0.0);
        for k in 0..count {
            let row = [time_s[k] - began_s, q[k], qd[k], qdd[k], load[k], u[k], residual_v[k]];
            if row.iter().any(|value| !value.is_finite()) {
                continue;
            }
            self.log.push(number);
            self.fold.push((stretches + (row[0] / stretch_s) as usize) % self.criteria.folds);
            let lists = [
                &mut self.time_s,
                &mut self.position_rad,
                &mut self.velocity_rad_per_s,
                &mut self.acceleration_rad_per_s2,
                &mut self.load_nm,
                &mut self.command_v,
                &mut self.residual_v,
            ];
            lists.into_iter().zip(row).for_each(|(list, value)| list.push(value));
            self.floor_v2 += columns.noise_floor_v * columns.noise_floor_v;
        }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.residual_v.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.residual_v.is_empty()
    }

    /// Sum of squares above that of noise alone [V^2]; 0 where it may be chance.
    pub fn excess_v2(&self) -> f64 {
        let excess_v2 = self.residual_v.iter().map(|r| r * r).sum::<f64>() - self.floor_v2;
        if excess_v2 > self.criteria.floor_uncertainty * self.floor_v2 { excess_v2 } else { 0.0 }
    }
}

fn span_s(time_s: &[f64]) -> f64 {
    time_s.last().zip(time_s.first()).map_or(0.0, |(last, first)| last - first)
}

fn direction(velocity_rad_per_s: &[f64], standstill_part: f64) -> Vec<f64> {
    let rms = root_mean_square(velocity_rad_per_s);
    let slow = (standstill_part * rms).max(f64::MIN_POSITIVE);
    velocity_rad_per_s.iter().map(|v| (v / slow).clamp(-1.0, 1.0)).collect()
}

/// Root of the mean square; 0 without values.
pub(super) fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}
