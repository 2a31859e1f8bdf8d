//! How much of the commands reaches the motors.

use crate::logs::intervals::at_samples;
use crate::rows::evidence::Evidence;
use crate::trial::equation::Trial;
use crate::trial::hypothesis::Hypothesis;

/// How much of the commands of each train stretch reaches each motor, rms by rms about their means, torque constants apart.
///
/// It is what rows see of the commands that counts: a delay, or a lag that is short against that, takes away much of what
/// changes from one sample to the next, and of rows hardly anything.
pub fn command_gain(evidence: &Evidence, hypothesis: &Hypothesis) -> Vec<Vec<f64>> {
    (0..evidence.train_stretches()).map(|s| in_stretch(evidence, s, hypothesis)).collect()
}

fn in_stretch(evidence: &Evidence, s: usize, hypothesis: &Hypothesis) -> Vec<f64> {
    let trial = Trial::of(&evidence.stretches[s], hypothesis, &evidence.criteria.fit);
    let of_joint = |joint: usize| {
        let Some(reached_v) = trial.reached_v(joint) else { return 1.0 };
        let rows = |signal_v: &[f64]| evidence.filter(joint, s).rows(&at_samples(signal_v));
        let sent_v = &evidence.stretches[s].command_v[joint];
        let gain = spread_over(&rows(&reached_v), &rows(sent_v));
        gain.map_or(1.0, |gain| gain / trial.motor_gain(joint))
    };
    (0..evidence.joint_count()).map(of_joint).collect()
}

/// How far values spread about their mean over how far others do, rms by rms; none where those do not.
fn spread_over(values: &[f64], others: &[f64]) -> Option<f64> {
    let (variance, of_others) = (variance(values), variance(others));
    let least = 1e-12 * others.iter().map(|value| value * value).sum::<f64>();
    (of_others > least).then(|| (variance / of_others).sqrt())
}

/// Sum of squares about the mean.
fn variance(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter().map(|value| (value - mean).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criteria;
    use crate::trial::hypothesis::EffectInstance;
    use crate::trial::test_stretch::rows_of_sines_under;
    use rig::Plant;
    use rig::effects::Catalogue;

    /// The gain of joint 2 with an effect on it, under a command of up to 190 Hz.
    fn gain_with(name: &str, value: f64) -> f64 {
        let command_v = (0..6000).map(|k| {
            let sine = |hz: f64| (std::f64::consts::TAU * hz * 1e-3 * f64::from(k)).sin();
            sine(11.0) + sine(61.0) + sine(190.0)
        });
        gain_under(&command_v.collect::<Vec<f64>>(), name, value)
    }

    fn gain_under(command_v: &[f64], name: &str, value: f64) -> f64 {
        let evidence = rows_of_sines_under(command_v, true, &Criteria::default());
        let definition = Catalogue::standard().by_name(name).unwrap();
        let effect = EffectInstance { definition, joint: 2, values: vec![value] };
        let plant = Plant::of_robot(&model::reference_robot::reference_robot());
        let gains = command_gain(&evidence, &Hypothesis::bare(plant).with(effect));
        assert!((gains[0][0] - 1.0).abs() < 1e-12, "another joint's command is what it was");
        gains[0][1]
    }

    #[test]
    fn a_command_that_comes_later_reaches_the_motor_all_the_same() {
        for (name, time_s) in [("delay", 0.4e-3), ("delay", 2.5e-3), ("actuator_lag", 0.4e-3)] {
            let gain = gain_with(name, time_s);
            assert!((gain - 1.0).abs() < 0.03, "{name} of {time_s} s: {gain}");
        }
        assert!((gain_with("torque_constant", -0.4) - 1.0).abs() < 1e-9);
        assert_eq!(gain_under(&[0.3; 6000], "torque_constant", -0.4), 1.0, "a command that stays");
    }

    #[test]
    fn what_takes_the_command_away_is_seen() {
        assert!(gain_with("saturation", 0.5) < 0.5);
        assert!(gain_with("dead_zone", 1.0) < 0.6);
        assert!(gain_with("actuator_lag", 20e-3) < 0.6);
    }
}
