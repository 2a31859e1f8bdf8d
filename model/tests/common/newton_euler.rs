//! Recursive Newton-Euler inverse dynamics, in the base frame, from textbook
//! mechanics alone: nothing of the closed form or of the base parameters is used.

use std::f64::consts::FRAC_PI_2;

use model::links::Link;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::rigid_robot::{RigidRobot, State};

/// Where a link is and how it moves, all in the base frame.
struct Motion {
    /// Joint axis, and from the joint to the link's own (distal) frame.
    axis: Vector3<f64>,
    reach: Vector3<f64>,
    orientation: Rotation3<f64>,
    spin: Vector3<f64>,
    spin_rate: Vector3<f64>,
    /// Acceleration of the link's frame; gravity is an upward acceleration of the base.
    acceleration: Vector3<f64>,
}

/// The joint torques [Nm] for a motion.
pub fn inverse_dynamics(robot: &RigidRobot, state: &State) -> [f64; 3] {
    let mut motion = base(robot.geometry.gravity_m_s2);
    let motions = [0, 1, 2].map(|joint| {
        motion = outward(&motion, robot, state, joint);
        (motion.axis, wrench(&robot.links[joint], &motion), motion.reach)
    });
    let mut torque_nm = [0.0; 3];
    let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
    for (joint, (axis, own, reach)) in motions.iter().enumerate().rev() {
        // Both about this link's joint: the next link pulls at the end of the reach.
        moment += own.moment + reach.cross(&force);
        force += own.force;
        let rotor = robot.rotor_inertia_kg_m2[joint] * state.qdd_rad_per_s2[joint];
        torque_nm[joint] = axis.dot(&moment) + rotor;
    }
    torque_nm
}

fn base(gravity: f64) -> Motion {
    Motion {
        axis: Vector3::z(),
        reach: Vector3::zeros(),
        orientation: Rotation3::identity(),
        spin: Vector3::zeros(),
        spin_rate: Vector3::zeros(),
        acceleration: Vector3::z() * gravity,
    }
}

/// The motion of the link after joint `joint` (0 to 2), Table 1.
fn outward(before: &Motion, robot: &RigidRobot, state: &State, joint: usize) -> Motion {
    let g = &robot.geometry;
    let twist = [FRAC_PI_2, 0.0, 0.0][joint];
    let (length, offset) = ([0.0, g.a2_m, g.a3_m][joint], [g.d1_m, g.d2_m, g.d3_m][joint]);
    let axis = before.orientation * Vector3::z();
    let turned =
        before.orientation * Rotation3::from_axis_angle(&Vector3::z_axis(), state.q_rad[joint]);
    let reach = turned * Vector3::new(length, 0.0, offset);
    let turning = axis * state.qd_rad_per_s[joint];
    let spin = before.spin + turning;
    let spin_rate =
        before.spin_rate + axis * state.qdd_rad_per_s2[joint] + before.spin.cross(&turning);
    Motion {
        axis,
        reach,
        orientation: turned * Rotation3::from_axis_angle(&Vector3::x_axis(), twist),
        spin,
        spin_rate,
        acceleration: before.acceleration + acceleration_at(&spin, &spin_rate, &reach),
    }
}

/// Acceleration of a point of a rigid body relative to another, `r` away.
fn acceleration_at(spin: &Vector3<f64>, rate: &Vector3<f64>, r: &Vector3<f64>) -> Vector3<f64> {
    rate.cross(r) + spin.cross(&spin.cross(r))
}

struct Wrench {
    force: Vector3<f64>,
    /// About the link's joint.
    moment: Vector3<f64>,
}

/// What moves the link itself: Newton's and Euler's laws about its centre of mass.
fn wrench(link: &Link<f64>, motion: &Motion) -> Wrench {
    let centre = motion.orientation * Vector3::from(link.centre_m);
    let acceleration =
        motion.acceleration + acceleration_at(&motion.spin, &motion.spin_rate, &centre);
    let inertia = motion.orientation * inertia(link) * motion.orientation.transpose();
    let force = acceleration * link.mass_kg;
    let euler = inertia * motion.spin_rate + motion.spin.cross(&(inertia * motion.spin));
    Wrench { force, moment: euler + (motion.reach + centre).cross(&force) }
}

fn inertia(link: &Link<f64>) -> Matrix3<f64> {
    let [xx, yy, zz] = link.inertia_diagonal_kg_m2;
    let [xy, xz, yz] = link.inertia_products_kg_m2;
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}
