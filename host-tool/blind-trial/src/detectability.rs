//! Whether what was drawn shows in the logs, and whether the arm still follows.
//!
//! The command that the true robot needs for the recorded motion, less the command that was
//! recorded, is compared with and without the causes, on the logs to train on; then again
//! after parameters and friction levels were refitted, held by what is known of them.

use model::Robot;
use model::base::COUNT;
use nalgebra::{DMatrix, DVector};

use super::case::{Case, Recorded};
use super::error::TrialError;
use super::plans::{is_excitation, is_train};
use super::visibility::Visibility;
use files::{JointLog, RobotFile};
use identification::base_parameters::rows::{RowSettings, Rows};
use recordings::campaign::Known;
use recordings::motion::Instant;
use recordings::{Campaign, Trace};
use rig::Plan;
use rig::effects::Kind;

/// How a command residual is judged: as far up as the encoder lets accelerations be seen.
const ROWS: RowSettings = RowSettings {
    motion_cutoff_hz: 200.0,
    row_cutoff_hz: Some(40.0),
    row_period_s: 0.006,
    instant: Instant::Middle,
};
/// Relative standard deviation of the nominal model's parameters.
const MODEL_ERROR: f64 = 0.02;
/// Parameters that the refit may change: base, level and viscous part of each friction.
const REFITTED: usize = COUNT + 6;

/// The residuals of a recording by the true model, and how they change with parameters.
pub struct Residuals {
    /// One for each log and joint.
    pub(crate) groups: Vec<Group>,
}

/// The rows of one joint in an unbroken stretch of a log.
pub(crate) struct Group {
    /// The joint, 0 to 2.
    pub(crate) joint: usize,
    /// The command less what the true model needs [V].
    pub(crate) residual_v: DVector<f64>,
    /// Slopes of that need by relative changes of the refitted parameters [V].
    pub(crate) columns: DMatrix<f64>,
}

impl Residuals {
    /// Of the logs to train on.
    ///
    /// # Errors
    /// A log too short to be judged.
    pub fn of(case: &Case, recorded: &[Recorded]) -> Result<Self, TrialError> {
        Self::of_logs(case, recorded, is_train)
    }

    /// Of the logs that are wanted.
    ///
    /// # Errors
    /// A log too short to be judged.
    pub fn of_logs(
        case: &Case,
        recorded: &[Recorded],
        is_wanted: fn(&Plan) -> bool,
    ) -> Result<Self, TrialError> {
        let known = known(case)?;
        let mut groups = Vec::new();
        for Recorded { plan, log } in recorded.iter().filter(|r| is_wanted(&r.plan)) {
            let counts = f64::from(case.rig().encoder_counts_per_turn);
            let trace = Trace::of_log(log.clone(), plan.entry("csv"), counts);
            for rows in Rows::of(&trace, &known, &case.robot.friction, &ROWS)? {
                groups.extend((0..3).map(|joint| Group::of(&rows, joint, &case.robot)));
            }
        }
        Ok(Self { groups })
    }

    /// How much larger they are than those without causes.
    pub fn compared_with(&self, without: &Self) -> Visibility {
        let floors: Vec<f64> = without.groups.iter().map(|group| rms(&group.residual_v)).collect();
        let excess = |left: &dyn Fn(&Group) -> f64| {
            let ratios = self.groups.iter().zip(&floors).map(|(group, floor)| left(group) / floor);
            ratios.map(|ratio| (ratio * ratio - 1.0).max(0.0).sqrt()).fold(0.0, f64::max)
        };
        let change = self.refit(&floors);
        Visibility {
            raw: excess(&|group| rms(&group.residual_v)),
            left: excess(&|group| rms(&(&group.residual_v - &group.columns * &change))),
            moved: change.norm() / MODEL_ERROR,
        }
    }

    /// Relative changes of the parameters, by weighted least squares with a prior.
    fn refit(&self, floors: &[f64]) -> DVector<f64> {
        let mut normal = DMatrix::identity(REFITTED, REFITTED) / MODEL_ERROR.powi(2);
        let mut right = DVector::zeros(REFITTED);
        for (group, floor) in self.groups.iter().zip(floors) {
            let weight = 1.0 / (floor * floor);
            normal += group.columns.tr_mul(&group.columns) * weight;
            right += group.columns.tr_mul(&group.residual_v) * weight;
        }
        let zero = DVector::zeros(REFITTED);
        normal.cholesky().map_or(zero, |cholesky| cholesky.solve(&right))
    }
}

impl Group {
    fn of(rows: &Rows, joint: usize, robot: &Robot<f64>) -> Self {
        let first = rows.joints[joint].first;
        let command = &rows.joints[joint].command_v;
        let used = command.len().saturating_sub(first);
        let mut columns = DMatrix::zeros(used, REFITTED);
        let base = robot.base.to_array();
        for (k, column) in rows.joints[joint].columns.iter().enumerate() {
            fill(&mut columns, k, column.iter().skip(first).map(|x| x * base[k]));
        }
        let friction = &robot.friction[joint];
        let whole_v = rows.friction_v(joint, friction);
        let velocity = rows.sampler.take(&rows.motion.qd_rad_per_s[joint]);
        let viscous_v = velocity.iter().map(|v| friction.alpha2_v_s_per_rad * v);
        let level_v = whole_v.iter().zip(viscous_v.clone()).map(|(whole, viscous)| whole - viscous);
        fill(&mut columns, COUNT + 2 * joint, level_v.skip(first));
        fill(&mut columns, COUNT + 2 * joint + 1, viscous_v.skip(first));
        let needed = columns.column_sum();
        let command = DVector::from_iterator(used, command.iter().skip(first).copied());
        Self { joint, residual_v: command - needed, columns }
    }
}

fn fill(matrix: &mut DMatrix<f64>, column: usize, values: impl Iterator<Item = f64>) {
    for (entry, value) in matrix.column_mut(column).iter_mut().zip(values) {
        *entry = value;
    }
}

fn known(case: &Case) -> Result<Known, TrialError> {
    let counts = f64::from(case.rig().encoder_counts_per_turn);
    Ok(Campaign::new(RobotFile::from_robot(&case.robot), Some(counts), Vec::new())?.known)
}

fn rms(values: &DVector<f64>) -> f64 {
    (values.norm_squared() / values.len().max(1) as f64).sqrt()
}

/// Whether the arm follows all its references: no joint is further than 0.3 rad from its
/// own, and commands are seldom at their limit. Where a motor saturates, joints fall behind
/// for a while and catch up again: 0.8 rad, and commands may be what they must.
pub fn is_stable(case: &Case, recorded: &[Recorded]) -> bool {
    let mut parameters = case.causes.iter().flat_map(|cause| cause.known_parameters());
    let saturates = parameters.any(|parameter| parameter.kind == Kind::Limit);
    let furthest_rad = if saturates { 0.8 } else { 0.3 };
    let most_at_limit = if saturates { 1.0 } else { 0.03 };
    let limit_v = 0.999 * case.rig().command_limit_v;
    let counts = f64::from(case.rig().encoder_counts_per_turn);
    recorded.iter().flat_map(|recorded| &recorded.log.joints).all(|joint| {
        let at_limit = joint.command_v.iter().filter(|u| u.abs() >= limit_v).count();
        furthest_rad > largest_error_rad(joint, counts)
            && at_limit as f64 <= most_at_limit * joint.command_v.len() as f64
    })
}

fn largest_error_rad(joint: &JointLog, counts: f64) -> f64 {
    let reference = joint.reference_rad.as_deref().unwrap_or_default();
    let position = joint.position_rad(counts);
    position.iter().zip(reference).map(|(q, r)| (q - r).abs()).fold(0.0, f64::max)
}

/// The largest command of each joint in the excitation to train on [V].
pub fn peak_command_v(recorded: &[Recorded]) -> [f64; 3] {
    let excitation = recorded.iter().find(|recorded| is_excitation(&recorded.plan));
    let peak = |i: usize| {
        let joint = excitation.and_then(|recorded| recorded.log.joints.get(i));
        let commands = joint.map_or(&[][..], |joint| &joint.command_v);
        commands.iter().fold(0.0, |peak: f64, u| peak.max(u.abs()))
    };
    [peak(0), peak(1), peak(2)]
}
