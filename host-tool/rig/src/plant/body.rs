//! The rigid body of a plant.

use model::chain::{MAX_JOINTS, SerialChain};
use model::effects::{Tilt, with_payload};
use model::mechanism::{Mechanism, Rrr};
use model::vector::Vector3;
use model::{BaseParameters, Posture, Robot};

use super::linked::LinkedBody;

/// A rigid body: the closed form of the three-joint robot, or any chain.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// The closed form.
    Rrr(Rrr<f64>),
    /// A chain of links.
    Chain(Box<LinkedBody>),
}

impl Body {
    /// That of the three-joint robot.
    pub fn of_robot(robot: &Robot<f64>) -> Self {
        Self::Rrr(Rrr::of(robot))
    }

    /// A chain that nobody refits.
    pub fn of_chain(chain: SerialChain<f64>) -> Self {
        Self::Chain(Box::new(LinkedBody::new(chain, Default::default(), Vec::new())))
    }

    /// Behind the interface of all mechanisms.
    pub fn mechanism(&self) -> &dyn Mechanism<f64> {
        match self {
            Self::Rrr(rrr) => rrr,
            Self::Chain(linked) => &linked.chain,
        }
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        match self {
            Self::Rrr(_) => 3,
            Self::Chain(linked) => linked.joints(),
        }
    }

    /// The closed form, where this is it.
    pub fn as_rrr(&self) -> Option<&Rrr<f64>> {
        match self {
            Self::Rrr(rrr) => Some(rrr),
            Self::Chain(_) => None,
        }
    }

    /// Torques of a motion, rotors included [Nm; N].
    #[inline]
    pub fn inverse_dynamics(&self, q: &[f64], qd: &[f64], qdd: &[f64], torque: &mut [f64]) {
        match self {
            Self::Rrr(rrr) => rrr.inverse_dynamics(q, qd, qdd, torque),
            Self::Chain(linked) => linked.chain.inverse_dynamics(q, qd, qdd, torque),
        }
    }

    /// Accelerations of torques [rad/s^2; m/s^2].
    #[inline]
    pub fn forward_dynamics(&self, q: &[f64], qd: &[f64], torque: &[f64], qdd: &mut [f64]) {
        match self {
            Self::Rrr(rrr) => rrr.forward_dynamics(q, qd, torque, qdd),
            Self::Chain(linked) => linked.chain.forward_dynamics(q, qd, torque, qdd),
        }
    }

    /// Coriolis and gravity torques c + h [Nm; N].
    #[inline]
    pub fn load(&self, q: &[f64], qd: &[f64], load: &mut [f64]) {
        match self {
            Self::Rrr(rrr) => {
                let posture = Posture::new(q[1], q[2]);
                let qd = [qd[0], qd[1], qd[2]];
                let coriolis = posture.coriolis(&rrr.base, &rrr.geometry, &qd);
                let gravity = posture.gravity(&rrr.base, &rrr.geometry);
                (0..3).for_each(|i| load[i] = coriolis[i] + gravity[i]);
            }
            Self::Chain(linked) => linked.chain.inverse_dynamics(q, qd, &[0.0; MAX_JOINTS], load),
        }
    }

    /// A joint's own entry of the mass matrix, rotor included [kg m^2; kg].
    pub fn inertia(&self, joint: usize, q: &[f64]) -> f64 {
        match self {
            Self::Rrr(rrr) => {
                Posture::new(q[1], q[2]).mass_matrix(&rrr.base, &rrr.geometry)[joint][joint]
            }
            Self::Chain(linked) => {
                let count = linked.joints();
                let mut mass = [0.0; MAX_JOINTS * MAX_JOINTS];
                linked.chain.mass_matrix(q, &mut mass);
                mass[joint * count + joint]
            }
        }
    }

    /// Adds a body without size to the last link: its mass [kg], and where it is in that link's
    /// frame [m]; in the closed form it is at the origin of frame 3.
    pub fn add_payload(&mut self, mass_kg: f64, at_m: Vector3<f64>) {
        match self {
            Self::Rrr(rrr) => rrr.base = with_payload(&rrr.base, &rrr.geometry, mass_kg),
            Self::Chain(linked) => {
                let payload = model::chain::Body::point(mass_kg, at_m);
                linked.chain = linked.chain.with_payload(&payload);
            }
        }
    }

    /// Height of the tip in the base frame [m]; above axis 2 in the closed form.
    pub fn tip_height_m(&self, q: &[f64]) -> f64 {
        match self {
            Self::Rrr(rrr) => {
                let Posture { s2, s23, .. } = Posture::new(q[1], q[2]);
                rrr.geometry.a2_m * s2 + rrr.geometry.a3_m * s23
            }
            Self::Chain(linked) => linked.chain.tip(q).position[2],
        }
    }

    /// Adds what a force on the tip does to the joints, in the base frame [N].
    pub fn add_tip_force(&self, q: &[f64], force_n: &Vector3<f64>, torque: &mut [f64]) {
        match self {
            Self::Rrr(rrr) => {
                let posture = Posture::new(q[1], q[2]);
                let pushed = posture.tip_force_torque(q[0].sin_cos(), &rrr.geometry, force_n);
                (0..3).for_each(|joint| torque[joint] += pushed[joint]);
            }
            Self::Chain(linked) => {
                let count = linked.joints();
                let mut jacobian = [0.0; 6 * MAX_JOINTS];
                linked.chain.tip_jacobian(q, &mut jacobian);
                for (joint, torque) in torque[..count].iter_mut().enumerate() {
                    let along = |k: usize| jacobian[k * count + joint] * force_n[k];
                    *torque += (0..3).map(along).sum::<f64>();
                }
            }
        }
    }

    /// Adds what gravity does to the joints of a leaning base beyond what it does to a level one.
    pub fn add_tilt(&self, q: &[f64], tilt: &Tilt<f64>, torque: &mut [f64]) {
        match self {
            Self::Rrr(rrr) => {
                let posture = Posture::new(q[1], q[2]);
                let leaning = tilt.torque(q[0].sin_cos(), &posture, &rrr.base, &rrr.geometry);
                (0..3).for_each(|joint| torque[joint] += leaning[joint]);
            }
            Self::Chain(linked) => {
                let chain = &linked.chain;
                let change = rotated_change(&chain.gravity_m_s2(), tilt);
                let (mut leaning, rest) = ([0.0; MAX_JOINTS], [0.0; MAX_JOINTS]);
                chain.with_gravity(change).inverse_dynamics(q, &rest, &rest, &mut leaning);
                let count = linked.joints();
                // What holds against gravity is the other way round.
                torque[..count].iter_mut().zip(&leaning).for_each(|(sum, held)| *sum -= held);
            }
        }
    }

    /// Takes the motor's inertia off a joint: what moves with its link.
    pub fn remove_motor(&mut self, joint: usize, inertia: f64) {
        match self {
            Self::Rrr(rrr) => *own_inertia(&mut rrr.base, joint) -= inertia,
            Self::Chain(linked) => *linked.chain.link_mut(joint).1 -= inertia,
        }
    }
}

/// What a lean adds to gravity in the base frame [m/s^2]. The tilt tells it for gravity along -z;
/// another gravity turns with the base by the same rotation.
fn rotated_change(gravity: &Vector3<f64>, tilt: &Tilt<f64>) -> Vector3<f64> {
    let size = gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    let along = gravity[2] == -size;
    let change = tilt.gravity_change.map(|part| size * part);
    if along || size == 0.0 { change } else { turned(gravity, size, change) }
}

/// A change that holds for gravity along -z, for gravity along another line: by the shortest rotation
/// that takes the one to the other.
fn turned(gravity: &Vector3<f64>, size: f64, change: Vector3<f64>) -> Vector3<f64> {
    use model::vector::{cross, dot};
    let down = [0.0, 0.0, -1.0];
    let unit = gravity.map(|g| g / size);
    let (axis, cosine) = (cross(&down, &unit), dot(&down, &unit));
    if cosine < -1.0 + 1e-12 {
        return [change[0], -change[1], -change[2]];
    }
    let (once, along) = (cross(&axis, &change), dot(&axis, &change) / (1.0 + cosine));
    [0, 1, 2].map(|k| cosine * change[k] + once[k] + along * axis[k])
}

/// A joint's parameter that holds its own inertia.
fn own_inertia(base: &mut BaseParameters<f64>, joint: usize) -> &mut f64 {
    match joint {
        0 => &mut base.zz1r,
        1 => &mut base.zz2r,
        _ => &mut base.ia3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::ArmFile;

    /// A carriage of 2 kg on a level rail along x: where the base leans by b about y it is pushed along
    /// by m g sin b, as the definition of a tilt says.
    #[test]
    fn a_carriage_on_a_rail_that_leans_is_pushed_along_it() {
        let text = "format = 2\n[robot]\n[[joint]]\nkind = \"prismatic\"\naxis = [1.0, 0.0, 0.0]\n\
                    mass_kg = 2.0\ncom_m = [0.0, 0.0, 0.0]\ninertia_kg_m2 = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]\n";
        let arm = ArmFile::parse("rail.toml", text.into()).unwrap();
        let body = Body::of_chain(arm.chain().unwrap());
        let mut force = [0.0];
        body.add_tilt(&[0.3], &Tilt::new(0.1, 0.2, [0.0; 2]), &mut force);
        assert!((force[0] - 2.0 * 9.81 * f64::sin(0.2)).abs() < 1e-12, "{force:?}");
    }
}
