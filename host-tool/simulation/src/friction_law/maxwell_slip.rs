//! Generalised Maxwell slip: springs side by side that break away one after the other.
//!
//! Al-Bender, Lampaert and Swevers, IEEE Trans. Automatic Control 50(11), 2005.

use model::friction::{Friction, FrictionScale};

use super::law::{FrictionLaw, level_v, viscous_v};

/// A spring that holds a part of the level and then slips.
#[derive(Clone, Copy, Debug)]
struct Element {
    stiffness_v_per_rad: f64,
    force_v: f64,
    slips: bool,
}

/// Equal parts of gamma(v) on springs whose stiffnesses are spread.
#[derive(Clone, Debug)]
pub struct MaxwellSlip {
    friction: Friction<f64>,
    /// How fast a slipping element goes to its level [1/s].
    attraction_per_s: f64,
    elements: Vec<Element>,
}

impl MaxwellSlip {
    /// With this many elements (1 or more). The softest gives way at `spread` times the
    /// deflection of the stiffest; together they are as stiff at rest as `sigma0`.
    pub fn new(
        friction: Friction<f64>,
        elements: usize,
        spread: f64,
        attraction_per_s: f64,
    ) -> Self {
        let count = elements.max(1);
        let weight = |k: usize| spread.powf(-(k as f64) / (count.max(2) - 1) as f64);
        let whole: f64 = (0..count).map(weight).sum();
        let element = |k| Element {
            stiffness_v_per_rad: friction.sigma0_v_per_rad * weight(k) / whole,
            force_v: 0.0,
            slips: false,
        };
        Self { friction, attraction_per_s, elements: (0..count).map(element).collect() }
    }
}

impl Element {
    /// Moves on by a step; `level_v` is the element's own part.
    fn step(&mut self, level_v: f64, velocity_rad_per_s: f64, step_s: f64, attraction: f64) -> f64 {
        let ahead = self.force_v * velocity_rad_per_s >= 0.0;
        self.slips &= ahead && velocity_rad_per_s != 0.0;
        if self.slips {
            let target_v = level_v.copysign(velocity_rad_per_s);
            self.force_v -= (target_v - self.force_v) * (-attraction * step_s).exp_m1();
            return self.force_v;
        }
        self.force_v += self.stiffness_v_per_rad * velocity_rad_per_s * step_s;
        if self.force_v.abs() >= level_v && self.force_v * velocity_rad_per_s >= 0.0 {
            self.force_v = level_v.copysign(self.force_v);
            self.slips = true;
        }
        self.force_v
    }
}

impl FrictionLaw for MaxwellSlip {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64 {
        let part_v =
            level_v(&self.friction, scale, velocity_rad_per_s) / self.elements.len() as f64;
        let attraction = self.attraction_per_s;
        let springs = self.elements.iter_mut();
        let springs_v: f64 =
            springs.map(|e| e.step(part_v, velocity_rad_per_s, step_s, attraction)).sum();
        springs_v + viscous_v(&self.friction, scale, velocity_rad_per_s)
    }

    fn rest(&mut self) {
        for element in &mut self.elements {
            (element.force_v, element.slips) = (0.0, false);
        }
    }
}
