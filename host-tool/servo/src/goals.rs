//! Goals over time.

use files::ArmJoint;
use model::mechanism::JointKind;
use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;

/// A goal over time: sines, or steps held for a while.
#[derive(Clone, Debug)]
pub enum Motion {
    /// Amplitude, angular frequency and phase of each, about a middle.
    Sines(f64, [[f64; 3]; 3]),
    /// How long one is held [s], and the goals.
    Steps(f64, Vec<f64>),
}

impl Motion {
    /// Draws sines or steps of a joint for a log of this length [s], within its range and this far about
    /// its middle.
    pub fn draw(
        joint: &ArmJoint,
        swing: f64,
        length_s: f64,
        is_sines: bool,
        random: &mut Pcg64Mcg,
    ) -> Self {
        let (middle, swing) = reach(joint, swing);
        let unit = Uniform::new(0.0, 1.0).expect("a range");
        let mut draw = || unit.sample(&mut *random);
        if is_sines {
            let mut sine = || {
                let frequency = 0.08 * 8.0_f64.powf(draw());
                [swing * (0.2 + 0.3 * draw()), std::f64::consts::TAU * frequency, 6.3 * draw()]
            };
            return Self::Sines(middle, [sine(), sine(), sine()]);
        }
        let hold = 0.7 + 2.0 * draw();
        let count = (length_s / hold) as usize + 2;
        let mut goal = || middle + 0.8 * swing * (2.0 * draw() - 1.0);
        Self::Steps(hold, (0..count).map(|_| goal()).collect())
    }

    /// The goal at a time [s]; before zero that at zero.
    pub fn at(&self, t: f64) -> f64 {
        match self {
            Self::Sines(middle, parts) => {
                middle + parts.iter().map(|[a, w, p]| a * (w * t + p).sin()).sum::<f64>()
            }
            Self::Steps(hold, goals) => goals[(t / hold) as usize],
        }
    }
}

/// Part of a joint's range that three sines of the largest amplitudes cross.
const PART_OF_RANGE: f64 = 0.9;
/// How far a sliding joint without limits goes, by radians of a turning one [m/rad].
const SLIDE_M_PER_RAD: f64 = 0.15;

/// The middle of a joint's motion and how far it swings.
fn reach(joint: &ArmJoint, swing: f64) -> (f64, f64) {
    match (joint.limits, joint.kind) {
        (Some([low, high]), _) => {
            (0.5 * (low + high), swing.min(PART_OF_RANGE * 0.5 * (high - low) / 1.5))
        }
        (None, JointKind::Revolute) => (0.0, swing),
        (None, JointKind::Prismatic) => (0.0, SLIDE_M_PER_RAD * swing),
    }
}
