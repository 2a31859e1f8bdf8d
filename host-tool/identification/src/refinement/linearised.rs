//! The equations, linearised in friction and in the lags of timing.

use model::{BaseParameters, Friction, Geometry, Posture};
use rayon::prelude::*;

use super::super::base_parameters::friction::sensitivity;
use super::super::base_parameters::rows::Rows;
use super::super::base_parameters::solve::Stack;
use super::layout::{CORIOLIS_LAG, Layout, TIMING_COUNT};
use super::solution::Solution;
use recordings::campaign::Known;
use recordings::motion::Motion;
use signal::derivative;

/// The values about which the equations are linearised.
pub(super) struct LinearisationPoint {
    pub friction: [Friction<f64>; 3],
    /// Known from the first step on.
    pub rigid: Option<RigidBody>,
}

/// The rigid body that Coriolis torques are computed with.
pub(super) struct RigidBody {
    base: BaseParameters<f64>,
    geometry: Geometry<f64>,
    torque_constant_nm_per_v: [f64; 3],
}

impl RigidBody {
    pub fn of(known: &Known, solution: &Solution) -> Option<Self> {
        Some(Self {
            base: BaseParameters::from_array(std::array::from_fn(|k| solution.parameters[k])),
            geometry: known.geometry?,
            torque_constant_nm_per_v: [1, 2, 3].map(|joint| known.torque_constant(joint)),
        })
    }

    /// Change of a joint's voltage per second that velocities come early [V/s].
    fn coriolis_slope(&self, motion: &Motion, joint: usize) -> Vec<f64> {
        const STEP_S: f64 = 1e-4;
        let at = |k: usize| {
            let (q, qd, qdd) = motion.state(k);
            let posture = Posture::new(q[1], q[2]);
            let torque = |step_s: f64| {
                let velocity = [0, 1, 2].map(|i| qd[i] + step_s * qdd[i]);
                posture.coriolis(&self.base, &self.geometry, &velocity)[joint]
            };
            (torque(STEP_S) - torque(-STEP_S))
                / (2.0 * STEP_S)
                / self.torque_constant_nm_per_v[joint]
        };
        (0..motion.len()).map(at).collect()
    }
}

/// The equations linearised about a friction: right-hand sides and the columns of timing
/// and friction.
pub(super) fn linearised(stretches: &[Rows], layout: &Layout, point: &LinearisationPoint) -> Stack {
    let pieces: Vec<[JointPiece; 3]> = stretches
        .par_iter()
        .map(|rows| [0, 1, 2].map(|joint| JointPiece::of(rows, joint, layout, point)))
        .collect();
    let (right, extra): (Vec<_>, Vec<_>) = pieces
        .into_iter()
        .map(|[a, b, c]| ([a.right, b.right, c.right], [a.columns, b.columns, c.columns]))
        .unzip();
    Stack::new(stretches, &right, &extra, layout.extra_count())
}

/// One joint's right-hand side and columns over a stretch.
struct JointPiece {
    right: Vec<f64>,
    columns: Vec<(usize, Vec<f64>)>,
}

impl JointPiece {
    fn of(rows: &Rows, joint: usize, layout: &Layout, point: &LinearisationPoint) -> Self {
        let friction = &point.friction[joint];
        let period_s = rows.motion.period_s;
        let friction_v = rows.friction_raw_v(joint, friction);
        let net_v: Vec<f64> =
            rows.motion.command_v[joint].iter().zip(&friction_v).map(|(u, f)| u - f).collect();
        let slope = |signal: &[f64]| rows.sampler.take(&derivative::first(signal, period_s));
        let mut columns =
            vec![(joint, slope(&rows.motion.command_v[joint])), (3 + joint, slope(&friction_v))];
        if let Some(rigid) = &point.rigid {
            let slope = rigid.coriolis_slope(&rows.motion, joint);
            columns.push((CORIOLIS_LAG, rows.sampler.take(&slope)));
        }
        let mine: Vec<(usize, usize)> = layout
            .free
            .iter()
            .enumerate()
            .filter(|(_, free)| free.0 == joint)
            .map(|(index, free)| (TIMING_COUNT + index, free.1))
            .collect();
        columns.par_extend(mine.into_par_iter().map(|(place, parameter)| {
            (place, sensitivity(rows, joint, friction, parameter, &friction_v))
        }));
        Self { right: rows.sampler.take(&net_v), columns }
    }
}
