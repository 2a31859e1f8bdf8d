//! The logs of a case: those of the `gap` recipe, with other motions from case to case.

use firmware::reference::{FourierSeries, Motion};

use super::Rng;
use files::{Experiment, Role};
use rig::Plan;
use rig::effects::Random;
use rig::plan::{driven_noise, excitation, peak_velocity, slow, task};

/// Which motions a case plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Motions {
    /// Variant of the excitation; 1 is the designed one.
    pub excitation: u32,
    /// Variant of the slow reversals.
    pub slow: u32,
    /// Variant under the driven noise.
    pub driven_noise: u32,
    /// Variant of the excitation held out.
    pub held_out: u32,
    /// Seed of the driven noise.
    pub noise_seed: u32,
}

/// Variants that are drawn: beyond, the series' amplitudes lose digits in `f32`.
const VARIANTS: f64 = 30.0;
/// How often the designed excitation is played.
const DESIGNED: f64 = 0.4;

impl Motions {
    /// Four different motions.
    pub fn draw(rng: &mut Rng) -> Self {
        let mut used = vec![1];
        let mut another = || loop {
            let variant = 2 + (rng.unit() * (VARIANTS - 1.0)) as u32;
            if !used.contains(&variant) {
                used.push(variant);
                return variant;
            }
        };
        let [first, slow, driven_noise, held_out] = [(); 4].map(|()| another());
        let excitation = if rng.unit() < DESIGNED { 1 } else { first };
        let noise_seed = 1 + (rng.unit() * 1e6) as u32;
        Self { excitation, slow, driven_noise, held_out, noise_seed }
    }

    /// The plans, with all durations times a factor.
    pub fn plans(&self, duration_scale: f64) -> Vec<Plan> {
        let seconds = |duration_s: f64| (duration_s * duration_scale) as f32;
        let mut train = excitation(self.excitation, seconds(20.0));
        train.name = "excitation".into();
        let mut held_out = excitation(self.held_out, seconds(10.0)).with_role(Role::Holdout);
        held_out.name = "excitation-2".into();
        vec![
            train,
            like(slow(seconds(20.0)), self.slow),
            like(driven_noise(seconds(12.0), self.noise_seed), self.driven_noise),
            task(seconds(10.0)),
            held_out,
        ]
    }
}

/// A plan with the motion of another variant, as fast as its own.
fn like(plan: Plan, variant: u32) -> Plan {
    let other = excitation(variant, 1.0).reference.motion;
    let own = &plan.reference.motion;
    let motion = [0, 1, 2].map(|i| match (&own[i], &other[i]) {
        (Motion::Fourier(own), Motion::Fourier(other)) => Motion::Fourier(as_fast(own, other)),
        (own, _) => own.clone(),
    });
    plan.with_motion(motion)
}

/// `other` at `own`'s period and peak velocity.
fn as_fast(own: &FourierSeries, other: &FourierSeries) -> FourierSeries {
    let at_own_period = FourierSeries { period_s: own.period_s, ..*other };
    let scale = peak_velocity(own) / peak_velocity(&at_own_period);
    FourierSeries {
        sine_rad: other.sine_rad.map(|a| a * scale),
        cosine_rad: other.cosine_rad.map(|b| b * scale),
        ..*own
    }
}

/// Whether a model may be fitted to the log.
pub fn is_train(plan: &Plan) -> bool {
    plan.role == Role::Train
}

/// Whether it is the excitation that is fitted to.
pub fn is_excitation(plan: &Plan) -> bool {
    is_train(plan) && plan.experiment == Experiment::Excitation
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_differ_and_are_as_fast_as_the_recipes_own() {
        let motions = Motions::draw(&mut Rng::new(3, 1));
        let plans = motions.plans(1.0);
        let names: Vec<&str> = plans.iter().map(|plan| plan.name.as_str()).collect();
        assert_eq!(names, ["excitation", "slow", "driven-noise", "task", "excitation-2"]);
        let own = slow(20.0);
        for i in 0..3 {
            let (Motion::Fourier(own), Motion::Fourier(drawn)) =
                (&own.reference.motion[i], &plans[1].reference.motion[i])
            else {
                panic!("both are Fourier series");
            };
            assert!(own.sine_rad != drawn.sine_rad);
            assert!((peak_velocity(own) / peak_velocity(drawn) - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn shorter_logs_are_asked_for_by_a_factor() {
        let plans = Motions::draw(&mut Rng::new(3, 1)).plans(0.5);
        let seconds: Vec<f32> = plans.iter().map(|plan| plan.reference.duration_s).collect();
        assert_eq!(seconds, [10.0, 10.0, 6.0, 5.0, 5.0]);
    }
}
