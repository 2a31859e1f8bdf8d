//! The unknowns of the search: per link the numbers of log-Cholesky, per joint the logarithm of
//! its rotor and its friction. Any values are a possible arm.

use files::ArmFile;
use model::chain::{BODY_PARAMETERS, Body, LINK_PARAMETERS};

use super::friction_terms::Term;
use super::layout::{Layout, OWN, TERMS};
use super::link_prior::{LinkPrior, reaches};
use super::own_prior::{Prior, Rotor, friction_priors};
use super::settings::Settings;

/// Unknowns of a joint: its link, its rotor, Coulomb, viscous, terms beyond.
pub const OF_JOINT: usize = LINK_PARAMETERS + OWN;
/// Where a joint's rotor stands among them.
pub const ROTOR: usize = BODY_PARAMETERS;
/// Where its Coulomb level stands among them.
pub const COULOMB: usize = LINK_PARAMETERS;

/// Where the viscous coefficient stands among a joint's own numbers.
const VISCOUS: usize = 1;

/// An unknown rotor lies within a factor of a hundred of where it is searched from.
const ROTOR_WIDTH: f64 = 4.6;
/// Unknown friction, in largest commands: no information.
const OWN_WIDTH: f64 = 100.0;
/// Constants, in largest commands: where gravity may explain as much, it does.
const CONSTANT_WIDTH: f64 = 0.1;

/// One joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointUnknowns {
    /// Its link.
    pub link: LinkPrior,
    /// Its rotor.
    pub rotor: Rotor,
    /// Coulomb level and viscous coefficient.
    pub friction: [Prior; 2],
    /// Coulomb friction is held at zero.
    pub without_coulomb: bool,
    /// Which terms friction has beyond, in the order of [`Term::ALL`].
    pub terms: [bool; TERMS],
    /// Torque by command.
    torque_constant: f64,
    /// Largest command of the logs.
    largest: f64,
    /// Largest velocity of the logs.
    fastest: f64,
}

/// All joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknowns {
    /// Base to tip.
    pub joints: Vec<JointUnknowns>,
}

impl Unknowns {
    /// Of an arm; torque by command, largest command and velocity per joint give scales.
    pub fn of(arm: &ArmFile, constants: &[f64], scales: &[[f64; 2]], settings: &Settings) -> Self {
        let joints = arm.joints.iter().zip(reaches(&arm.joints)).zip(constants).zip(scales);
        let joints = joints.map(|(((joint, reach), constant), [largest, fastest])| {
            let link = LinkPrior::of(joint, &reach, settings);
            let mass = Body::of_log_cholesky(&link.start).mass_kg;
            let arm = match joint.kind {
                model::mechanism::JointKind::Revolute => reach.length_m,
                model::mechanism::JointKind::Prismatic => 1.0,
            };
            JointUnknowns {
                rotor: Rotor::of(joint, mass * arm * arm, settings),
                link,
                friction: friction_priors(joint, settings),
                without_coulomb: false,
                terms: [false; TERMS],
                torque_constant: *constant,
                largest: largest.max(1e-9),
                fastest: fastest.max(1e-9),
            }
        });
        Self { joints: joints.collect() }
    }

    /// Takes over which rotors are searched.
    pub fn take_rotors(&mut self, other: &Self) {
        for (joint, other) in self.joints.iter_mut().zip(&other.joints) {
            joint.rotor = other.rotor;
        }
    }

    /// Where the search begins.
    pub fn start(&self) -> Vec<f64> {
        self.joints.iter().flat_map(JointUnknowns::start).collect()
    }

    /// Orders of magnitude.
    pub fn scale(&self) -> Vec<f64> {
        self.joints.iter().flat_map(JointUnknowns::scale).collect()
    }

    /// What all of them are charged before the logs are seen.
    pub fn prior_residuals(&self, all: &[f64]) -> Vec<f64> {
        let both = self.joints.iter().zip(all.chunks_exact(OF_JOINT));
        both.flat_map(|(joint, own)| joint.residuals(own)).collect()
    }

    /// The numbers in which commands are linear, in the order of [`Layout`].
    pub fn numbers(&self, all: &[f64]) -> Vec<f64> {
        let layout = Layout { joints: self.joints.len() };
        let mut numbers = vec![0.0; layout.all()];
        for (index, (joint, own)) in self.joints.iter().zip(all.chunks_exact(OF_JOINT)).enumerate()
        {
            let link = &mut numbers[LINK_PARAMETERS * index..][..LINK_PARAMETERS];
            link[..BODY_PARAMETERS].copy_from_slice(&body(own).to_array());
            link[ROTOR] = joint.armature(own);
            let friction = &mut numbers[layout.own(index)..][..OWN];
            friction.copy_from_slice(&own[COULOMB..]);
            friction[0] = if joint.without_coulomb { 0.0 } else { friction[0] };
            joint.closed().for_each(|term| friction[term.number()] = 0.0);
        }
        numbers
    }
}

/// The log-Cholesky numbers among a joint's unknowns.
pub fn link_numbers(own: &[f64]) -> [f64; BODY_PARAMETERS] {
    core::array::from_fn(|k| own[k])
}

fn body(own: &[f64]) -> Body<f64> {
    Body::of_log_cholesky(&link_numbers(own))
}

impl JointUnknowns {
    /// The rotor's inertia at a joint's unknowns.
    pub fn armature(&self, own: &[f64]) -> f64 {
        match self.rotor {
            Rotor::Fixed(value) => value,
            Rotor::Given(..) | Rotor::Unknown(_) => own[ROTOR].exp(),
        }
    }

    /// Closes terms that would drive the joint, by its own numbers: one that is negative and must not be, and a square
    /// by which friction shrinks with the velocity at the largest.
    pub fn close_driving_terms(&mut self, own: &[f64]) {
        let slope = own[VISCOUS] + 2.0 * own[Term::Square.number()] * self.fastest;
        for (term, open) in Term::ALL.into_iter().zip(&mut self.terms) {
            let is_driving = match term {
                Term::Peak | Term::Load => own[term.number()] < 0.0,
                Term::Square => slope < 0.0,
                Term::Constant => false,
            };
            *open &= !is_driving;
        }
    }

    /// The terms that friction does not have.
    fn closed(&self) -> impl Iterator<Item = Term> {
        Term::ALL.into_iter().zip(self.terms).filter_map(|(term, open)| (!open).then_some(term))
    }

    /// Order of magnitude of a term: as large as the largest command.
    fn size(&self, term: Term) -> f64 {
        match term {
            Term::Peak | Term::Constant => self.largest,
            Term::Load => 1.0 / self.torque_constant,
            Term::Square => self.largest / self.fastest.powi(2),
        }
    }

    fn start(&self) -> Vec<f64> {
        let rotor = match self.rotor {
            Rotor::Fixed(_) => 0.0,
            Rotor::Given(value, _) | Rotor::Unknown(value) => value.ln(),
        };
        let friction = self.friction.map(|prior| prior.map_or(0.0, |(value, _)| value));
        self.link.start.into_iter().chain([rotor]).chain(friction).chain([0.0; TERMS]).collect()
    }

    fn scale(&self) -> Vec<f64> {
        let friction = [1.0, self.largest, self.largest / self.fastest];
        let own = friction.into_iter().chain(Term::ALL.map(|term| self.size(term)));
        self.link.width.into_iter().chain(own).collect()
    }

    fn residuals(&self, own: &[f64]) -> Vec<f64> {
        let rotor = match self.rotor {
            // What does not count stays where it is.
            Rotor::Fixed(_) => own[ROTOR],
            Rotor::Given(value, doubt) => (own[ROTOR].exp() - value) / doubt,
            Rotor::Unknown(value) => (own[ROTOR] - value.ln()) / ROTOR_WIDTH,
        };
        let widths = [self.largest, self.largest / self.fastest].map(|x| OWN_WIDTH * x);
        let friction = (0..2).map(|k| match self.friction[k] {
            _ if k == 0 && self.without_coulomb => own[COULOMB] / self.largest,
            Some((value, doubt)) => (own[COULOMB + k] - value) / doubt,
            None => own[COULOMB + k] / widths[k],
        });
        let terms = Term::ALL.into_iter().zip(self.terms).map(|(term, open)| {
            let width = match term {
                _ if !open => 1.0,
                Term::Constant => CONSTANT_WIDTH,
                Term::Peak | Term::Load | Term::Square => OWN_WIDTH,
            };
            own[COULOMB + term.number()] / (width * self.size(term))
        });
        let mut all = self.link.residuals(&link_numbers(own));
        all.push(rotor);
        all.extend(friction);
        all.extend(terms);
        all
    }
}

#[cfg(test)]
mod tests {
    use files::example_arms::two_link_pendulum;

    use super::*;

    #[test]
    fn terms_that_would_drive_are_closed() {
        let (arm, scales) = (two_link_pendulum(), [[10.0, 5.0]; 2]);
        let unknowns = Unknowns::of(&arm, &[1.6, 0.9], &scales, &Settings::default());
        let after = |peak: f64, load: f64, square: f64| {
            let mut joint = JointUnknowns { terms: [true; TERMS], ..unknowns.joints[0].clone() };
            // Coulomb's level 0.2, viscous 0.1, at most 5 rad/s, and a constant.
            joint.close_driving_terms(&[0.2, 0.1, peak, load, square, -1.0]);
            joint.terms
        };
        assert_eq!(after(0.1, 0.01, -0.009), [true; TERMS]);
        assert_eq!(after(-0.1, 0.01, -0.011), [false, true, false, true]);
        assert_eq!(after(0.1, -0.01, 0.5), [true, false, true, true]);
    }
}
