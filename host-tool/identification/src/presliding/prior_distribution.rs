//! The prior distribution of the fit's parameters: a mean and a standard error for each.

use super::linear::{LinearFriction, LinearRobot, rigid_at};
use super::prior::{Bristles, Prior, RigidBody};
use super::record::Record;
use super::start::Start;
use recordings::campaign::Known;

/// Means and standard errors of the parameters; the fit begins at the means.
#[derive(Clone, Copy, Debug)]
pub struct PriorDistribution {
    /// The robot of the means.
    pub robot: LinearRobot,
    /// Standard error of log sigma_0, per joint; infinite for the excited one.
    pub sigma0: [f64; 3],
    /// Standard error of log sigma_1, per joint; infinite for the excited one.
    pub sigma1: [f64; 3],
    /// Standard error of log D_ii.
    pub inertia: [f64; 3],
    /// Standard error of D_ij over sqrt(D_ii D_jj), of the pairs (1,2), (1,3), (2,3).
    pub coupling: f64,
    /// Whether base parameters, or the pendulum's, are known.
    pub body_known: bool,
}

/// Errors of log D_ii and of D_ij over sqrt(D_ii D_jj) of a rig whose inertia the FRF alone
/// determines.
const UNKNOWN_INERTIA: f64 = 0.7;
/// Errors of log sigma_0 and log sigma_1 of a neighbour of which nothing is known.
const UNKNOWN_BRISTLES: [f64; 2] = [1.5, 1.0];
/// alpha_2 of a joint without an earlier estimate [V s/rad].
pub const TYPICAL_VISCOUS_V_S_PER_RAD: f64 = 0.1;

/// The rigid body: D, gravity stiffness, errors of D_ii and D_ij.
struct Body {
    mass: [[f64; 3]; 3],
    gravity: [[f64; 3]; 3],
    inertia_error: [f64; 3],
    coupling_error: f64,
    body_known: bool,
}

/// J / k_t of the excited joint, where the prior contains it [V s^2/rad].
pub fn known_inertia(record: &Record, known: &Known, prior: &Prior) -> Option<f64> {
    let body = known_body(record, known, prior)?;
    let i = record.excited;
    Some(body.mass[i][i] / known.torque_constant(i as u8 + 1))
}

/// The prior around a first guess.
pub fn prior_distribution(
    record: &Record,
    known: &Known,
    prior: &Prior,
    start: &Start,
) -> PriorDistribution {
    let torque_constant_nm_per_v = [1, 2, 3].map(|joint| {
        let constant = known.torque_constant(joint);
        if constant > 0.0 { constant } else { 1.0 }
    });
    let guessed = || guessed_body(start.inertia, &torque_constant_nm_per_v);
    let body = known_body(record, known, prior).unwrap_or_else(guessed);
    let i = record.excited;
    let gravity_v = body.gravity[i][i] / torque_constant_nm_per_v[i];
    let own_sigma0 = (start.stiffness - gravity_v).max(0.1 * start.stiffness);
    let neighbour = |joint: usize| neighbour(prior.bristles[joint], own_sigma0, start.damping);
    let bristles = [0, 1, 2].map(neighbour);
    let viscous = |joint: usize| viscous(prior, joint);
    let friction = [0, 1, 2].map(|joint| LinearFriction {
        sigma0_v_per_rad: if joint == i { own_sigma0 } else { bristles[joint].sigma0_v_per_rad },
        sigma1_v_s_per_rad: if joint == i {
            (start.damping - viscous(joint)).max(0.1 * start.damping)
        } else {
            bristles[joint].sigma1_v_s_per_rad
        },
        alpha2_v_s_per_rad: viscous(joint),
        ..LinearFriction::default()
    });
    let error = |joint: usize, error: f64| if joint == i { f64::INFINITY } else { error };
    PriorDistribution {
        robot: LinearRobot {
            present: record.present,
            mass_kg_m2: body.mass,
            gravity_nm_per_rad: body.gravity,
            torque_constant_nm_per_v,
            friction,
            delay_s: 0.0,
        },
        sigma0: [0, 1, 2].map(|joint| error(joint, bristles[joint].sigma0_relative_error)),
        sigma1: [0, 1, 2].map(|joint| error(joint, bristles[joint].sigma1_relative_error)),
        inertia: body.inertia_error,
        coupling: body.coupling_error,
        body_known: body.body_known,
    }
}

/// alpha_2 of a joint, 0 to 2 [V s/rad].
pub fn viscous(prior: &Prior, joint: usize) -> f64 {
    let sliding = prior.sliding[joint].as_ref();
    sliding.map_or(TYPICAL_VISCOUS_V_S_PER_RAD, |sliding| sliding.alpha2_v_s_per_rad.value)
}

fn neighbour(prior: Option<Bristles>, own_sigma0: f64, own_damping: f64) -> Bristles {
    prior.unwrap_or(Bristles {
        sigma0_v_per_rad: own_sigma0,
        sigma0_relative_error: UNKNOWN_BRISTLES[0],
        sigma1_v_s_per_rad: own_damping,
        sigma1_relative_error: UNKNOWN_BRISTLES[1],
    })
}

fn known_body(record: &Record, known: &Known, prior: &Prior) -> Option<Body> {
    match (prior.rigid?, known.geometry) {
        (RigidBody::Robot { base, relative_error }, Some(geometry)) => {
            let (mass, gravity) = rigid_at(&base, &geometry, record.posture_rad);
            Some(Body {
                mass,
                gravity,
                inertia_error: [relative_error; 3],
                coupling_error: relative_error,
                body_known: true,
            })
        }
        (RigidBody::Pendulum { pendulum, relative_error }, _)
            if usize::from(pendulum.joint) == record.excited + 1 =>
        {
            let i = record.excited;
            let constants = [1, 2, 3].map(|joint| known.torque_constant(joint).max(0.0));
            let inertia_v = pendulum.inertia_kg_m2 / constants[i];
            let mut body =
                guessed_body(inertia_v, &constants.map(|k| if k > 0.0 { k } else { 1.0 }));
            body.gravity[i][i] = pendulum.gravity_torque_nm * record.posture_rad[i].cos();
            body.inertia_error[i] = relative_error;
            body.body_known = true;
            Some(body)
        }
        _ => None,
    }
}

/// Without base parameters: all joints as heavy for their motors as the excited one.
fn guessed_body(inertia_v: f64, constants: &[f64; 3]) -> Body {
    let mut mass = [[0.0; 3]; 3];
    for (joint, constant) in constants.iter().enumerate() {
        mass[joint][joint] = inertia_v * constant;
    }
    Body {
        mass,
        gravity: [[0.0; 3]; 3],
        inertia_error: [UNKNOWN_INERTIA; 3],
        coupling_error: UNKNOWN_INERTIA,
        body_known: false,
    }
}
