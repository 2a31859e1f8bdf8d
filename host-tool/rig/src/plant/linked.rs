//! A chain by the coordinates in which it is refitted.

use std::sync::Arc;

use model::chain::{BODY_PARAMETERS, LINK_PARAMETERS, MAX_JOINTS, SerialChain};
use model::mechanism::Mechanism;

/// Directions in which the links' parameters may change, one per coordinate: what a chain's torques
/// depend on, and no more.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Directions {
    /// The changed parameters of each: index, change per unit of the coordinate.
    pub terms: Vec<Vec<(usize, f64)>>,
    /// What each coordinate is called.
    pub names: Vec<String>,
}

/// A chain whose links have moved along directions from where they were given.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkedBody {
    /// The chain as it is.
    pub chain: SerialChain<f64>,
    /// How far along each direction it has moved.
    at: Vec<f64>,
    directions: Arc<Directions>,
}

impl LinkedBody {
    /// A chain as given; coordinates begin at these values.
    pub fn new(chain: SerialChain<f64>, directions: Directions, at: Vec<f64>) -> Self {
        Self { chain, at, directions: Arc::new(directions) }
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        Mechanism::joints(&self.chain)
    }

    /// The coordinates' values.
    pub fn coordinates(&self) -> &[f64] {
        &self.at
    }

    /// What the coordinates are.
    pub fn directions(&self) -> &Directions {
        &self.directions
    }

    /// Moves a coordinate to a value.
    pub fn set(&mut self, index: usize, to: f64) {
        let change = to - self.at[index];
        self.at[index] = to;
        for (parameter, slope) in &self.directions.terms[index] {
            add(&mut self.chain, *parameter, change * slope);
        }
    }

    /// What the last link carries more than another chain's, as the ten numbers of a body; `None` where the chains
    /// differ in anything else.
    pub fn payload_beyond(&self, other: &Self) -> Option<[f64; BODY_PARAMETERS]> {
        let (mut own, mut others) = (self.chain, other.chain);
        let last = self.joints().checked_sub(1)?;
        let without_others = others.joints().nth(last)?.body;
        let body = std::mem::replace(own.link_mut(last).0, without_others);
        let (with, without) = (body.to_array(), others.link_mut(last).0.to_array());
        (own == others).then(|| std::array::from_fn(|k| with[k] - without[k]))
    }

    /// A joint's row of the regressor by the coordinates; `None` where the joint's torque does not
    /// depend on one, since it is of a link before the joint.
    pub fn row(&self, joint: usize, q: &[f64], qd: &[f64], qdd: &[f64], row: &mut [f64]) {
        let mut all = [0.0; MAX_JOINTS * MAX_JOINTS * LINK_PARAMETERS];
        let count = self.chain.parameter_count();
        self.chain.regressor(q, qd, qdd, &mut all);
        let own = &all[joint * count..][..count];
        for (entry, terms) in row.iter_mut().zip(&self.directions.terms) {
            *entry = terms.iter().map(|(parameter, slope)| own[*parameter] * slope).sum();
        }
    }

    /// Whether a joint's torque may depend on a coordinate: on a link from it to the tip.
    pub fn counts(&self, joint: usize, index: usize) -> bool {
        let terms = &self.directions.terms[index];
        terms.iter().any(|(parameter, _)| parameter / LINK_PARAMETERS >= joint)
    }
}

/// Adds to a link's parameter.
fn add(chain: &mut SerialChain<f64>, parameter: usize, change: f64) {
    let (link, place) = (parameter / LINK_PARAMETERS, parameter % LINK_PARAMETERS);
    let (body, armature) = chain.link_mut(link);
    let mut values = body.to_array();
    match values.get_mut(place) {
        Some(value) => *value += change,
        None => *armature += change,
    }
    *body = model::chain::Body::from_array(values);
}
