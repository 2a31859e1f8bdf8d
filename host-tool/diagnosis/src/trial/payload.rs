//! What a payload on a chain needs along the measured motion.
//!
//! Torques are linear in the ten numbers of a body on the last link, so ten columns tell those of every payload
//! that is tried, and no torque is computed again for it.

use std::sync::Arc;

use model::chain::{BODY_PARAMETERS, LINK_PARAMETERS, MAX_JOINTS};
use model::mechanism::Mechanism;
use rig::plant::{Body, LinkedBody};

use super::equation::Trial;
use crate::logs::derived::{Payload, PayloadColumns};
use crate::logs::kinematics::Kinematics;

impl Trial<'_> {
    /// What effects add to the last link of a chain, if that alone is changed of the rigid body, and links move
    /// as measured; none where nothing is added, and for the closed form, whose base parameters hold a payload.
    pub fn payload(&self) -> Option<Payload> {
        *self.payload.get_or_init(|| self.found_payload())
    }

    fn found_payload(&self) -> Option<Payload> {
        let (Body::Chain(own), Body::Chain(given)) = (&self.plant().body, self.given_body()) else {
            return None;
        };
        let touches = self.effects_touch_body() && self.moves_as_measured();
        touches.then(|| own.payload_beyond(given))?
    }

    /// What it needs of a joint at the samples [V].
    pub fn needed_by(&self, payload: &Payload, joint: usize) -> Vec<f64> {
        let k_t = self.plant().torque_constant_nm_per_v[joint];
        let needed = |column: &[f64; BODY_PARAMETERS]| {
            column.iter().zip(payload).map(|(slope, value)| slope * value).sum::<f64>() / k_t
        };
        self.payload_columns()[joint].iter().map(needed).collect()
    }

    fn payload_columns(&self) -> &PayloadColumns {
        let make = || match self.given_body() {
            Body::Chain(given) => Arc::new(columns(given, &self.stretch.motion)),
            Body::Rrr(_) => Arc::default(),
        };
        self.stretch.derived.payload.get_or_init(make)
    }
}

/// Those of a chain along a motion.
fn columns(linked: &LinkedBody, motion: &Kinematics) -> PayloadColumns {
    let (joints, count) = (linked.joints(), linked.chain.parameter_count());
    let first = (joints - 1) * LINK_PARAMETERS;
    let mut rows = [0.0; MAX_JOINTS * MAX_JOINTS * LINK_PARAMETERS];
    let mut columns = vec![Vec::with_capacity(motion.q_rad[0].len()); joints];
    for k in 0..motion.q_rad[0].len() {
        let [q, qd, qdd] = motion.state(k);
        linked.chain.regressor(&q, &qd, &qdd, &mut rows);
        for (joint, column) in columns.iter_mut().enumerate() {
            let of_last = &rows[joint * count + first..][..BODY_PARAMETERS];
            column.push(std::array::from_fn(|place| of_last[place]));
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use model::chain::{Body as Link, Joint, SerialChain, Transform};
    use model::mechanism::JointKind;
    use model::reference_robot::reference_robot;
    use rig::Plant;
    use rig::effects::Catalogue;

    use super::*;
    use crate::criteria::{Criteria, FitCriteria};
    use crate::trial::hypothesis::{EffectInstance, Hypothesis};
    use crate::trial::residual_rows::train_residual_rows;
    use crate::trial::test_stretch::{rows_of_sines, sines, stretch_of};

    /// Three links about axes that lie across each other.
    fn chain() -> SerialChain<f64> {
        let joint = |axis: [f64; 3]| Joint {
            kind: JointKind::Revolute,
            origin: Transform { position: [0.1, 0.2, 0.3], ..Transform::identity() },
            axis,
            body: Link::point(1.3, [0.2, -0.1, 0.05]),
            armature: 0.02,
        };
        let axes = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
        SerialChain::new([0.0, 0.0, -9.81], &axes.map(joint)).unwrap()
    }

    const MASS_KG: f64 = 0.7;
    const AT_M: [f64; 3] = [0.03, -0.02, 0.11];

    fn bare() -> Hypothesis {
        let body = Body::of_chain(chain());
        Hypothesis::bare(Plant { body, ..Plant::of_robot(&reference_robot()) })
    }

    /// With a payload as an effect, and with the same in the chain itself.
    fn loaded() -> [Hypothesis; 2] {
        let definition = Catalogue::of_arm(3).by_name("payload").unwrap();
        let values = vec![MASS_KG, AT_M[0], AT_M[1], AT_M[2]];
        let with = bare().beside(EffectInstance { definition, joint: 0, values });
        let mut loaded = bare();
        loaded.plant.body.add_payload(MASS_KG, AT_M);
        [with, loaded]
    }

    fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_payload_needs_what_the_chain_that_carries_it_does() {
        let stretch = stretch_of(sines(0.4, [5.0, 7.0, 9.0], 300), vec![vec![0.0; 300]; 3], false);
        let (criteria, hypotheses) = (FitCriteria::default(), loaded());
        let [with, loaded] = hypotheses.each_ref().map(|of| Trial::of(&stretch, of, &criteria));
        assert!(with.payload().is_some() && loaded.payload().is_none());
        for joint in 0..3 {
            let worst = largest_difference(with.needed(joint), loaded.needed(joint));
            assert!(worst < 1e-12, "joint {joint}: {worst} V");
        }
    }

    /// Rows of what a body needs are kept: those of the bare one, whoever asks first.
    #[test]
    fn rows_with_a_payload_are_those_of_the_chain_that_carries_it() {
        let criteria = Criteria::default();
        let (bare, [with, loaded]) = (bare(), loaded());
        let rows_of = |hypotheses: [&Hypothesis; 2]| {
            let evidence = rows_of_sines(&criteria);
            hypotheses.map(|hypothesis| train_residual_rows(&evidence, hypothesis))
        };
        let [bare_first, with_then] = rows_of([&bare, &with]);
        let [with_first, bare_then] = rows_of([&with, &bare]);
        let [loaded, _] = rows_of([&loaded, &loaded]);
        for joint in 0..3 {
            for (a, b) in [(&with_then, &loaded), (&with_first, &loaded), (&bare_then, &bare_first)]
            {
                let worst = largest_difference(&a[joint], &b[joint]);
                assert!(worst < 1e-9, "joint {joint}: {worst}");
            }
        }
    }
}
