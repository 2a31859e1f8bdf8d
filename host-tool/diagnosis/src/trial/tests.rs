//! Links behind springs, followed through driven noise.

use std::f64::consts::TAU;

use model::reference_robot::reference_robot;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::active_effects::FRICTION_SLOPES;
use super::equation::Trial;
use super::hypothesis::{EffectInstance, Hypothesis};
use super::test_stretch::{PERIOD_S, sines, stretch_of};
use super::warmth::Warmth;
use crate::criteria::FitCriteria;
use crate::fit::unknowns::Unknown;
use crate::logs::kinematics::Kinematics;
use crate::logs::stretch::Stretch;
use rig::Plant;
use rig::effects::Catalogue;
use signal::{LowPass, derivative, rms};
use simulation::robot::{Settings, SimulatedRobot};

const COUNT_RAD: f64 = TAU / 655_360.0;

fn backlash(values: [f64; 4]) -> EffectInstance {
    let definition = Catalogue::standard().by_name("backlash").unwrap();
    EffectInstance { definition, joint: 3, values: values.to_vec() }
}

/// Ten seconds of driven noise on joint 3 of a robot with an effect, as encoders see them.
fn driven(effect: Option<&EffectInstance>) -> Stretch {
    let effects = effect.and_then(EffectInstance::build).into_iter().collect();
    let start = [0.0, -1.5, 0.3];
    let settings = Settings::default();
    let mut robot = SimulatedRobot::with_effects(reference_robot(), effects, start, &settings);
    let mut random = Pcg64Mcg::new(3);
    let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
    let mut command_v = vec![Vec::new(); 3];
    let mut angles = vec![Vec::new(); 3];
    for k in 0..10_000 {
        let q = robot.q_rad().map(|q| (q / COUNT_RAD).round() * COUNT_RAD);
        let swing = (TAU * 0.7e-3 * f64::from(k)).sin();
        let push = 1.2 * noise() + 1.5 * swing - 4.0 * (q[2] - start[2]);
        let command = [0.0, 0.0, push];
        (0..3).for_each(|i| angles[i].push(q[i]));
        (0..3).for_each(|i| command_v[i].push(command[i]));
        robot.advance(&command);
    }
    stretch_of(motion(angles), command_v, true)
}

fn motion(angles: Vec<Vec<f64>>) -> Kinematics {
    let smooth = |q: &Vec<f64>| LowPass::new(200.0, PERIOD_S).zero_phase(q);
    let q_rad: Vec<Vec<f64>> = angles.iter().map(smooth).collect();
    let first = |q: &Vec<f64>| derivative::first(q, PERIOD_S);
    let second = |q: &Vec<f64>| -> Vec<f64> {
        let at = |k: usize| {
            let k = k.clamp(1, q.len() - 2);
            (q[k + 1] + q[k - 1] - 2.0 * q[k]) / (PERIOD_S * PERIOD_S)
        };
        (0..q.len()).map(at).collect()
    };
    Kinematics {
        qd_rad_per_s: q_rad.iter().map(first).collect(),
        qdd_rad_per_s2: angles.iter().map(second).collect(),
        q_rad,
        raw_rad: angles,
    }
}

/// What a model leaves of joint 3 below 40 Hz, rms [V].
fn left_v(stretch: &Stretch, effect: Option<EffectInstance>) -> f64 {
    let effects = effect.into_iter().collect();
    let hypothesis =
        Hypothesis { effects, ..Hypothesis::bare(Plant::of_robot(&reference_robot())) };
    let left = Trial::of(stretch, &hypothesis, &FitCriteria::default()).residual(2);
    rms(&LowPass::new(40.0, PERIOD_S).zero_phase(&left)[500..9500])
}

const BACKLASH: [f64; 4] = [2e-3, 3000.0, 1.5, 0.01];

#[test]
fn a_link_that_bounces_in_its_backlash_is_followed_through_driven_noise() {
    let floor_v = left_v(&driven(None), None);
    let stretch = driven(Some(&backlash(BACKLASH)));
    let (with_v, without_v) = (left_v(&stretch, Some(backlash(BACKLASH))), left_v(&stretch, None));
    assert!(with_v < 5.0 * floor_v, "{with_v} V, floor {floor_v} V");
    assert!(without_v > 15.0 * with_v, "{without_v} V, floor {floor_v} V");
}

#[test]
fn backlash_that_is_not_there_explains_nothing_away() {
    let delay = Catalogue::standard().by_name("delay").unwrap();
    let delay = EffectInstance { definition: delay, joint: 3, values: vec![4e-3] };
    let stretch = driven(Some(&delay));
    let null_v = left_v(&stretch, None);
    for gap_rad in [1e-6, 1e-4, 1e-3] {
        for stiffness in [500.0, 5e3, 5e4, 1e6] {
            let guess = backlash([gap_rad, stiffness, 1e-2 * stiffness.sqrt(), 0.01]);
            let left_v = left_v(&stretch, Some(guess));
            assert!(left_v > 0.75 * null_v, "{left_v} V, without {null_v} V, {stiffness} Nm/rad");
        }
    }
}

/// Friction of joint 3 over the last second of three in which it has slid and stands, its angle read in steps
/// [V]; followed within a play of `at_rest_rad`.
fn friction_at_rest(at_rest_rad: f64) -> Vec<f64> {
    let mut random = Pcg64Mcg::new(5);
    let mut noise = || -> f64 { StandardNormal.sample(&mut random) };
    let mut angle = |k: i32| 0.3 * (f64::from(k.min(1000)) * PERIOD_S) + 0.5 * COUNT_RAD * noise();
    let read: Vec<f64> = (0..3000).map(&mut angle).collect();
    let mut stretch = stretch_of(
        motion(vec![vec![0.0; 3000], vec![-1.5; 3000], read]),
        vec![vec![0.0; 3000]; 3],
        false,
    );
    stretch.at_rest_rad = vec![at_rest_rad; 3];
    let bare = Hypothesis::bare(Plant::of_robot(&reference_robot()));
    let criteria = FitCriteria::default();
    Trial::of(&stretch, &bare, &criteria).friction(2, &bare.plant)[2000..].to_vec()
}

#[test]
fn bristles_of_a_joint_that_stands_do_not_let_go_by_noise() {
    let lost = |friction_v: &[f64]| 1.0 - friction_v.last().unwrap() / friction_v[0];
    let (by_noise, by_play) = (friction_at_rest(0.0), friction_at_rest(2.0 * COUNT_RAD));
    assert!(lost(&by_noise) > 0.2, "{}", lost(&by_noise));
    assert!(lost(&by_play).abs() < 0.01, "{}", lost(&by_play));
}

/// Half a second in which all joints turn back and all commands change their sign.
fn swinging() -> Stretch {
    let command = |w: f64| -> Vec<f64> {
        (0..500).map(|k| 2.0 * (w * PERIOD_S * f64::from(k)).cos()).collect()
    };
    let frequencies = [9.0, 11.0, 13.0];
    stretch_of(sines(0.3, frequencies, 500), frequencies.map(command).to_vec(), false)
}

/// What gears take, of which simulators and model files hear as effects.
#[test]
fn what_gears_take_is_friction_by_the_motors_torque_on_every_joint() {
    let (stretch, criteria) = (swinging(), FitCriteria::default());
    let bare = Hypothesis::bare(Plant::of_robot(&reference_robot()));
    let lossy = Hypothesis { gear_loss: 0.06, ..bare.clone() };
    let told = Hypothesis { effects: lossy.effects_of_gears(), ..bare.clone() };
    assert!(bare.effects_of_gears().is_empty() && told.effects.len() == 3);
    for joint in 0..3 {
        let left = |hypothesis| Trial::of(&stretch, hypothesis, &criteria).residual(joint);
        let both = left(&lossy).into_iter().zip(left(&told));
        let worst = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let taken = left(&lossy).iter().zip(left(&bare)).map(|(a, b)| (a - b).abs()).sum::<f64>();
        assert!(worst < 1e-12 && taken > 1.0, "joint {joint}: {worst} of {taken} V");
    }
}

#[test]
fn friction_changes_by_what_gears_take_as_its_slope_says() {
    const STEP: f64 = 1e-6;
    let (stretch, criteria) = (swinging(), FitCriteria::default());
    let bare = Hypothesis::bare(Plant::of_robot(&reference_robot()));
    let with = |gear_loss| Hypothesis { gear_loss, ..bare.clone() };
    let friction_v = |hypothesis: &Hypothesis| {
        Trial::of(&stretch, hypothesis, &criteria).friction(1, &hypothesis.plant)
    };
    let slopes = Trial::of(&stretch, &with(0.05), &criteria).friction_slopes(1);
    let both = friction_v(&with(0.05 + STEP)).into_iter().zip(friction_v(&with(0.05)));
    for (slope, (after, before)) in slopes.iter().zip(both) {
        let wanted = (after - before) / STEP;
        assert!((slope[FRICTION_SLOPES - 1] - wanted).abs() < 1e-3, "{wanted} V");
    }
}

#[test]
fn dry_friction_leads_and_viscous_friction_does_not() {
    let (stretch, criteria) = (swinging(), FitCriteria::default());
    let change_v = |set: fn(&mut model::Friction<f64>)| {
        let mut plant = Plant::of_robot(&reference_robot());
        set(&mut plant.friction[1]);
        let bare = Hypothesis::bare(plant);
        let leading = Hypothesis { friction_lead_s: vec![0.01; 3], ..bare.clone() };
        let left = |hypothesis| Trial::of(&stretch, hypothesis, &criteria).residual(1);
        let both = left(&leading).into_iter().zip(left(&bare));
        both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let viscous = change_v(|friction| {
        (friction.alpha0_v, friction.alpha1_v) = (1e-9, 0.0);
        (friction.sigma1_v_s_per_rad, friction.alpha2_v_s_per_rad) = (0.0, 5.0);
    });
    assert!(viscous < 1e-6, "{viscous} V");
    let dry = change_v(|friction| friction.alpha2_v_s_per_rad = 0.0);
    assert!(dry > 0.01, "{dry} V");
}

#[test]
fn what_makes_a_command_late_takes_the_place_of_its_lag() {
    let late = |lag_s: &[f64]| {
        let bare = Hypothesis::bare(Plant::of_robot(&reference_robot()));
        let definition = Catalogue::standard().by_name("delay").unwrap();
        let delay = EffectInstance { definition, joint: 1, values: vec![0.002] };
        Hypothesis { lag_s: lag_s.to_vec(), ..bare }.with(delay).lag_s
    };
    assert_eq!(late(&[4e-4, 1e-5, 3e-5]), [2e-5, 1e-5, 3e-5]);
    // Joints that do not move tell nothing; of one joint alone what is early is the log's.
    assert_eq!(
        (late(&[4e-4, 0.0, 0.0]), late(&[-4e-4, 0.0, 0.0])),
        (vec![0.0; 3], vec![-4e-4, 0.0, 0.0])
    );
}

#[test]
fn warmth_scales_the_friction_of_its_joint_in_its_log_alone() {
    let (stretch, criteria) = (swinging(), FitCriteria::default());
    let bare = Hypothesis::bare(Plant::of_robot(&reference_robot()));
    let with = |joint: usize, log: usize, parts: [f64; 2]| {
        let warmths = [((joint, log), Warmth { parts })].into();
        Hypothesis { warmths, ..bare.clone() }
    };
    let friction_v = |hypothesis: &Hypothesis| {
        Trial::of(&stretch, hypothesis, &criteria).friction(1, &hypothesis.plant)
    };
    assert_eq!(friction_v(&with(0, 0, [0.2, 0.1])), friction_v(&bare));
    assert_eq!(friction_v(&with(1, 7, [0.2, 0.1])), friction_v(&bare));
    let mut scaled = bare.clone();
    for value in [0, 1, 3] {
        let unknown = Unknown::Friction { joint: 1, parameter: value };
        unknown.set(&mut scaled, 1.2 * unknown.get(&bare));
    }
    let both = friction_v(&with(1, 0, [0.2, 0.0])).into_iter().zip(friction_v(&scaled));
    let worst = both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-12, "{worst} V");
}

/// Warmth changes slowly, so its slopes are those along the parameters that it scales, but for what bristles remember.
#[test]
fn friction_changes_by_warmth_as_its_slopes_say() {
    const STEP: f64 = 1e-6;
    let (stretch, criteria) = (swinging(), FitCriteria::default());
    const WARM: [f64; 2] = [-0.3, 0.1];
    let mut bare = Hypothesis::bare(Plant::of_robot(&reference_robot()));
    bare.warmths = [((1, 0), Warmth { parts: WARM })].into();
    let trial = Trial::of(&stretch, &bare, &criteria);
    let slopes = trial.warmth_slopes(1, &trial.friction_slopes(1));
    let before = trial.friction(1, &bare.plant);
    for (value, slope) in slopes.iter().enumerate() {
        let mut parts = WARM;
        parts[value] += STEP;
        let warmths = [((1, 0), Warmth { parts })].into();
        let with = Hypothesis { warmths, ..bare.clone() };
        let after = Trial::of(&stretch, &with, &criteria).friction(1, &with.plant);
        let wanted = after.iter().zip(&before).map(|(after, before)| (after - before) / STEP);
        let largest = slope.iter().fold(0.0, |largest, s| f64::max(largest, s.abs()));
        let worst = wanted.zip(slope).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 0.03 * largest, "part {value}: {worst} of {largest} V");
    }
}
