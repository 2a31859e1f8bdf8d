//! Angles of the joints and their derivatives along a stretch.

use std::borrow::Cow;
use std::sync::Arc;

use model::Posture;
use model::Real;
use model::chain::MAX_JOINTS;
use rig::Plant;
use signal::{LowPass, derivative, play};

/// A joint's value at an instant, joint by joint; those that the rig lacks are zero.
pub type Joints = [f64; MAX_JOINTS];

/// Sines and cosines of a joint's angles at the samples.
pub type Sines = Arc<[(f64, f64)]>;

/// Angles of the joints and their derivatives, joint by joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kinematics {
    /// Angles as measured [rad].
    pub raw_rad: Vec<Vec<f64>>,
    /// Angles, smoothed [rad].
    pub q_rad: Vec<Vec<f64>>,
    /// Velocities [rad/s].
    pub qd_rad_per_s: Vec<Vec<f64>>,
    /// Accelerations [rad/s^2].
    pub qdd_rad_per_s2: Vec<Vec<f64>>,
}

/// What a joint's friction follows, at the samples.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sliding {
    /// Velocity [rad/s].
    pub velocity_rad_per_s: Vec<f64>,
    /// Its slope [rad/s^2].
    pub acceleration_rad_per_s2: Vec<f64>,
}

impl Sliding {
    /// Velocity that dry friction feels at a sample, to first order the one `lead_s` later, and by how much it is ahead
    /// [rad/s].
    #[inline]
    pub fn ahead_by<T: Real>(&self, lead_s: T, k: usize) -> (T, T) {
        let ahead = lead_s * T::constant(self.acceleration_rad_per_s2[k]);
        (T::constant(self.velocity_rad_per_s[k]) + ahead, ahead)
    }
}

impl Kinematics {
    /// Of so many joints, with no sample yet.
    pub fn of_joints(joints: usize) -> Self {
        let none = vec![Vec::new(); joints];
        Self {
            raw_rad: none.clone(),
            q_rad: none.clone(),
            qd_rad_per_s: none.clone(),
            qdd_rad_per_s2: none,
        }
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        self.q_rad.len()
    }

    /// Velocity of a joint without what encoder steps add to it where it stands, while its angle wavers by this much:
    /// bristles relax with |v|, and noise of a velocity has one at rest, by which they would let go of a joint that
    /// sticks [rad/s].
    pub fn sliding_velocity(&self, joint: usize, wavers_rad: f64, period_s: f64) -> Cow<'_, [f64]> {
        if wavers_rad == 0.0 {
            return Cow::Borrowed(&self.qd_rad_per_s[joint]);
        }
        Cow::Owned(derivative::first(&play(&self.q_rad[joint], wavers_rad), period_s))
    }

    /// The same with its slope.
    pub fn sliding(&self, joint: usize, wavers_rad: f64, period_s: f64) -> Sliding {
        let velocity_rad_per_s = self.sliding_velocity(joint, wavers_rad, period_s).into_owned();
        let acceleration_rad_per_s2 = derivative::first(&velocity_rad_per_s, period_s);
        Sliding { velocity_rad_per_s, acceleration_rad_per_s2 }
    }

    /// Angles, velocities, accelerations of three joints at an instant.
    #[inline]
    pub fn of_three(&self, k: usize) -> ([f64; 3], [f64; 3], [f64; 3]) {
        let at = |signal: &[Vec<f64>]| [signal[0][k], signal[1][k], signal[2][k]];
        (at(&self.q_rad), at(&self.qd_rad_per_s), at(&self.qdd_rad_per_s2))
    }

    /// Angles, velocities, accelerations at an instant.
    #[inline]
    pub fn state(&self, k: usize) -> [Joints; 3] {
        let at = |signal: &[Vec<f64>]| {
            let mut values = Joints::default();
            values.iter_mut().zip(signal).for_each(|(value, signal)| *value = signal[k]);
            values
        };
        [at(&self.q_rad), at(&self.qd_rad_per_s), at(&self.qdd_rad_per_s2)]
    }
}

/// Angles and velocities of all joints in the middle of every interval, joint after joint, interval
/// after interval.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Middles {
    joints: usize,
    q_rad: Vec<f64>,
    qd_rad_per_s: Vec<f64>,
}

impl Middles {
    /// Those of a motion.
    pub fn of(motion: &Kinematics) -> Self {
        let joints = motion.joints();
        let between = |signals: &[Vec<f64>]| {
            let count = signals[0].len();
            let mut all = vec![0.0; joints * count];
            for (joint, signal) in signals.iter().enumerate() {
                for k in 0..count {
                    let next = (k + 1).min(count - 1);
                    all[joints * k + joint] = 0.5 * (signal[k] + signal[next]);
                }
            }
            all
        };
        Self { joints, q_rad: between(&motion.q_rad), qd_rad_per_s: between(&motion.qd_rad_per_s) }
    }

    /// How many intervals there are.
    pub fn len(&self) -> usize {
        self.q_rad.len().checked_div(self.joints).unwrap_or(0)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Angles and velocities in the interval after a sample.
    #[inline]
    pub fn at(&self, k: usize) -> (&[f64], &[f64]) {
        let range = self.joints * k..self.joints * (k + 1);
        (&self.q_rad[range.clone()], &self.qd_rad_per_s[range])
    }
}

impl Kinematics {
    /// Sines and cosines of the three-joint robot at every sample.
    pub fn postures(&self) -> Vec<Posture<f64>> {
        self.q_rad[1].iter().zip(&self.q_rad[2]).map(|(&q2, &q3)| Posture::new(q2, q3)).collect()
    }

    /// Sines and cosines of all joints' angles.
    pub fn sines(&self) -> Vec<Sines> {
        self.q_rad.iter().map(|q_rad| sines_of(q_rad)).collect()
    }

    /// The same where those of another motion are known: of joints that stand alike in both they are shared.
    pub fn sines_near(&self, other: &Self, sines: &[Sines]) -> Vec<Sines> {
        let of_joint = |(joint, q_rad): (usize, &Vec<f64>)| match *q_rad == other.q_rad[joint] {
            true => Arc::clone(&sines[joint]),
            false => sines_of(q_rad),
        };
        self.q_rad.iter().enumerate().map(of_joint).collect()
    }

    /// Every signal, by joints.
    pub fn all_mut(&mut self) -> impl Iterator<Item = &mut Vec<Vec<f64>>> {
        let Self { raw_rad, q_rad, qd_rad_per_s, qdd_rad_per_s2 } = self;
        [raw_rad, q_rad, qd_rad_per_s, qdd_rad_per_s2].into_iter()
    }

    /// Takes the angles of a joint, sampled evenly, smoothed below a cut-off.
    pub fn set(&mut self, joint: usize, q_rad: &[f64], period_s: f64, cutoff_hz: f64) {
        let smooth = LowPass::new(cutoff_hz, period_s).zero_phase(q_rad);
        self.qd_rad_per_s[joint] = derivative::first(&smooth, period_s);
        self.qdd_rad_per_s2[joint] = second_difference(q_rad, period_s);
        self.q_rad[joint] = smooth;
        self.raw_rad[joint] = q_rad.to_vec();
    }
}

fn sines_of(q_rad: &[f64]) -> Sines {
    q_rad.iter().map(|q_rad| Real::sin_cos(*q_rad)).collect()
}

/// Sines and cosines along a motion, where the closed form takes them.
pub fn postures_for(plant: &Plant, motion: &Kinematics) -> Vec<Posture<f64>> {
    if plant.body.as_rrr().is_some() { motion.postures() } else { Vec::new() }
}

fn second_difference(q_rad: &[f64], period_s: f64) -> Vec<f64> {
    let last = q_rad.len().saturating_sub(1);
    let at = |k: usize| {
        let k = k.clamp(1, last.max(2) - 1);
        (q_rad[k + 1] + q_rad[k - 1] - 2.0 * q_rad[k]) / (period_s * period_s)
    };
    (0..q_rad.len()).map(at).collect()
}
