//! Effects of the whole arm: a payload, a force at the tip, a base that leans.
//!
//! They change what the rigid body asks along the logs, so that is computed anew for each.

use model::chain::{Body, SerialChain};
use model::mechanism::Mechanism;

use crate::judged::Judged;
use crate::settings::Settings;

/// An effect of the whole arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whole {
    /// Mass and the place of its centre in the last link.
    Payload,
    /// A force on the tip, base frame.
    TipForce,
    /// The base leans about x and y.
    BaseTilt,
}

impl Whole {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Payload, Self::TipForce, Self::BaseTilt];

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Payload => "payload",
            Self::TipForce => "tip_force",
            Self::BaseTilt => "base_tilt",
        }
    }

    /// How many values it has.
    pub fn count(self) -> usize {
        match self {
            Self::Payload => 4,
            Self::TipForce => 3,
            Self::BaseTilt => 2,
        }
    }

    /// Values without the effect; where a payload's centre is likely: that of the last link.
    pub fn start(self, links: &SerialChain<f64>) -> Vec<f64> {
        match self {
            Self::Payload => {
                let centre = last_centre(links);
                vec![0.0, centre[0], centre[1], centre[2]]
            }
            Self::TipForce => vec![0.0; 3],
            Self::BaseTilt => vec![0.0; 2],
        }
    }

    /// Deviations before the logs are seen, and steps of slopes, from the arm's own size.
    pub fn doubts(self, links: &SerialChain<f64>, settings: &Settings) -> Vec<f64> {
        let mass = links.joints().map(|joint| joint.body.mass_kg).sum::<f64>().max(1e-3);
        match self {
            Self::Payload => {
                // A load sits about where the last link's own mass does.
                let far = last_centre(links).iter().map(|x| x * x).sum::<f64>().sqrt();
                let doubt = (settings.place_doubt * far).max(1e-3);
                vec![mass, doubt, doubt, doubt]
            }
            Self::TipForce => vec![9.81 * mass; 3],
            Self::BaseTilt => vec![0.2; 2],
        }
    }

    /// Values moved by a step of the search. What a load does is linear in its mass and in mass times
    /// place, so where its mass changes the step of its place does.
    pub fn moved(self, values: &[f64], step: &[f64]) -> Vec<f64> {
        let mut moved: Vec<f64> =
            values.iter().zip(step).map(|(value, step)| value + step).collect();
        if self == Self::Payload && moved[0] != 0.0 {
            let part = (values[0] / moved[0]).clamp(-1.0, 1.0);
            (1..4).for_each(|k| moved[k] = values[k] + part * step[k]);
        }
        moved
    }

    /// Whether a load is more than what drawn links are wrong by.
    pub fn is_beyond(self, values: &[f64], links: &SerialChain<f64>, settings: &Settings) -> bool {
        let moves = links.joints().map(|joint| joint.body.mass_kg).sum::<f64>();
        let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let load = match self {
            Self::Payload => values[0].abs(),
            Self::TipForce => size(values) / size(&links.gravity_m_s2()).max(1e-9),
            Self::BaseTilt => return size(values) >= settings.least_tilt_rad,
        };
        load >= settings.least_load_part * moves
    }

    /// The force on the tip [N].
    pub fn force(self, values: &[f64]) -> [f64; 3] {
        if self == Self::TipForce { values.try_into().unwrap_or_default() } else { [0.0; 3] }
    }

    /// A log with the effect.
    pub fn applied(self, links: &SerialChain<f64>, log: &Judged, values: &[f64]) -> Judged {
        let changed = self.links(links, values);
        let mut found = Judged { along: crate::along::along(&changed, &log.moves), ..log.clone() };
        if self == Self::TipForce {
            add_force(&changed, &mut found, values);
        }
        found
    }

    /// The chain with the effect, a force aside.
    pub fn links(self, links: &SerialChain<f64>, values: &[f64]) -> SerialChain<f64> {
        match self {
            Self::Payload => {
                links.with_payload(&Body::point(values[0], [values[1], values[2], values[3]]))
            }
            Self::TipForce => *links,
            Self::BaseTilt => {
                let (sa, ca) = values[0].sin_cos();
                let (sb, cb) = values[1].sin_cos();
                let size = links.gravity_m_s2().iter().map(|g| g * g).sum::<f64>().sqrt();
                links.with_gravity([size * sb, -size * sa * cb, -size * ca * cb])
            }
        }
    }
}

fn last_centre(links: &SerialChain<f64>) -> [f64; 3] {
    let Some(last) = links.joints().last() else { return [0.0; 3] };
    last.body.moment_kg_m.map(|moment| moment / last.body.mass_kg.max(1e-9))
}

/// Adds what a force on the tip asks of each joint: torque = -J^T F.
fn add_force(links: &SerialChain<f64>, log: &mut Judged, force: &[f64]) {
    let n = log.record.joints.len();
    let (mut q, mut rows) = (vec![0.0; n], vec![0.0; 6 * n]);
    for row in 0..log.record.len() {
        for joint in 0..n {
            q[joint] = log.moves[joint].position[row] + log.moves[joint].turn;
        }
        links.tip_jacobian(&q, &mut rows);
        for joint in 0..n {
            let torque: f64 = (0..3).map(|axis| rows[axis * n + joint] * force[axis]).sum();
            log.along[joint][row].coupling -= torque;
        }
    }
}
