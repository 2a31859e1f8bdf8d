//! The size of the gap on the confirming logs, and what remains of it.

use diagnosis::{Axis, Gap, Remainder, RemainderCurve};

use crate::joint_effects::noise;
use crate::outcome::Outcome;

/// Rms by joint of a stage: 0 as given, 1 refitted, 2 with effects [rad].
pub fn stage_rms(outcome: &Outcome, stage: usize) -> Vec<f64> {
    let joints = 0..outcome.models.len();
    joints.map(|joint| rms(outcome, stage, joint)).collect()
}

fn rms(outcome: &Outcome, stage: usize, joint: usize) -> f64 {
    let (mut sum, mut rows) = (0.0, 0_usize);
    for motion in &outcome.motions {
        let log = &outcome.prepared.logs[motion.log];
        let measured = &log.record.joints[joint].position;
        let simulated = &motion.stages[stage][joint];
        for row in (0..measured.len()).filter(|row| log.counts[joint][*row]) {
            sum += (measured[row] - simulated[row]).powi(2);
            rows += 1;
        }
    }
    (sum / rows.max(1) as f64).sqrt()
}

/// The gap, stage by stage; on a servo at rest an error of position is worth stiffness volts.
pub fn gap(outcome: &Outcome) -> Gap {
    let stages = [0, 1, 2].map(|stage| stage_rms(outcome, stage));
    let floor: Vec<f64> = noise(&outcome.arm).into_iter().map(f64::sqrt).collect();
    let volts = |rad: &[f64]| -> Vec<f64> {
        rad.iter().zip(&outcome.prepared.given).map(|(rad, servo)| rad * servo.stiffness).collect()
    };
    Gap {
        as_given_v: volts(&stages[0]),
        refitted_v: volts(&stages[1]),
        with_effects_v: volts(&stages[2]),
        with_tables_v: volts(&stages[2]),
        noise_floor_v: volts(&floor),
        as_given_rad: stages[0].clone(),
        refitted_rad: stages[1].clone(),
        with_effects_rad: stages[2].clone(),
        noise_floor_rad: floor,
    }
}

/// What no cause explains, largest first.
pub fn remainder(outcome: &Outcome, gap: &Gap) -> Vec<Remainder> {
    let all: f64 = gap.refitted_rad.iter().map(|rms| rms * rms).sum();
    let of = |joint: usize| {
        let rms_rad = gap.with_effects_rad[joint];
        let best = outcome.selected[joint].tried.first();
        Remainder {
            joint: joint as u8 + 1,
            axis: Axis::Velocity,
            rms_v: gap.with_effects_v[joint],
            rms_rad: Some(rms_rad),
            share: rms_rad * rms_rad / all.max(f64::MIN_POSITIVE),
            detail: format!("{:.1} mrad of position, simulated from the goals", 1e3 * rms_rad),
            curve: RemainderCurve::default(),
            nearest: best
                .filter(|tried| tried.gain.part > 0.0)
                .map(|tried| tried.effect.to_owned()),
        }
    };
    let mut found: Vec<Remainder> = (0..outcome.models.len()).map(of).collect();
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}
