//! From the selection to the report.

use std::collections::BTreeMap;

use super::motion_gap::drift_rms_rad;
use super::sentence::{effect_words, joint_words};
use crate::fit::gauss_newton::{fit, fit_held};
use crate::fit::linearisation::Linearisation;
use crate::fit::preparation::as_given;
use crate::fit::residual_stats::ResidualStats;
use crate::gap_by_axis::gap_by_axis;
use crate::logs::intervals::at_samples;
use crate::logs::subject::Subject;
use crate::result::{
    Alternative, Cause, Diagnosis, Gap, JointResiduals, Level, LogResiduals, Report, Rival, Value,
    Verdict,
};
use crate::rows::evidence::{Evidence, Rows};
use crate::rows::noise::NoiseByRate;
use crate::search::fitted_model::FittedModel;
use crate::search::selection::{RejectedCandidate, Selection};
use crate::trial::equation::Trial;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::residual_rows::residual_rows;
use crate::verdict::decision::{confidence, verdict};
use crate::verdict::shrinkage::{Shrinkage, held_out_floor_v, held_out_rms_v, noise_floor_v};
use crate::verdict::{detectable, misfit};
use files::{EffectTable, RobotFile};
use recordings::Trace;
use rig::effects::Table;

/// All that the report is made of.
pub struct Assembly<'a> {
    /// What is diagnosed.
    pub subject: &'a Subject,
    /// The rows.
    pub evidence: &'a Evidence,
    /// The models, step by step.
    pub selection: &'a Selection,
    /// The logs.
    pub traces: &'a [Trace],
    /// Noise in what the last model leaves.
    pub noise: NoiseByRate,
}

impl Assembly<'_> {
    /// The whole diagnosis.
    pub fn diagnosis(&self, file: &RobotFile, mut remarks: Vec<String>) -> Diagnosis {
        let verdict = verdict(self.selection, &self.subject.criteria);
        let named = verdict == Verdict::Effect;
        let free = &self.selection.refitted.linear;
        let given = residual_rows(self.evidence, &as_given(self.subject));
        let refitted = self.within_prior(free);
        let last = if named { &self.selection.last().linear } else { &refitted };
        let logs = self.logs(&given, &refitted.residual, &last.residual);
        let (detectable, untestable) = detectable::detectable(free, self.evidence, self.subject);
        let (causes, alternatives) =
            if named { self.causes(&refitted, last) } else { Default::default() };
        remarks.extend(misfit::remark(self.subject, self.evidence, free, verdict));
        let report = Report {
            format: 1,
            verdict,
            causes,
            alternatives,
            gap_shares: gap_by_axis(&logs, &self.subject.criteria.axes),
            gap: self.gap(&given, &refitted, last),
            untestable,
            detectable,
            remarks,
        };
        let waterfall = self.waterfall(&given, &refitted, named);
        let model = self.amended(file, &last.hypothesis);
        let (catalogue, criteria) = (self.subject.catalogue.clone(), self.subject.criteria.clone());
        let rivals = self.rivals(named);
        Diagnosis { report, logs, waterfall, rivals, model, catalogue, criteria }
    }

    /// The refitted model, its parameters no further from the model as given than the prior
    /// allows: what the uncertainty of that model can explain, and no more.
    fn within_prior(&self, free: &Linearisation) -> Linearisation {
        let stats = ResidualStats::of(self.evidence, free);
        let held = (stats.prior_penalty > self.subject.criteria.fit.unexplained_prior_penalty)
            .then(|| fit_held(self.evidence, self.subject, free.hypothesis.clone()))
            .flatten();
        held.unwrap_or_else(|| free.clone())
    }

    fn gap(&self, given: &Rows, refitted: &Linearisation, last: &Linearisation) -> Gap {
        Gap {
            as_given_v: held_out_rms_v(self.evidence, given),
            refitted_v: held_out_rms_v(self.evidence, &refitted.residual),
            with_effects_v: held_out_rms_v(self.evidence, &last.residual),
            noise_floor_v: held_out_floor_v(self.evidence, &self.noise),
            refitted_rad: drift_rms_rad(self.evidence, &refitted.hypothesis),
            with_effects_rad: drift_rms_rad(self.evidence, &last.hypothesis),
        }
    }

    fn waterfall(&self, given: &Rows, refitted: &Linearisation, named: bool) -> Vec<Level> {
        let level = |name: &str, rows: &Rows| Level {
            name: name.into(),
            rms_v: held_out_rms_v(self.evidence, rows),
        };
        let mut levels = vec![level("as given", given), level("refitted", &refitted.residual)];
        for step in self.selection.added.iter().filter(|_| named) {
            let Some(effect) = step.linear.hypothesis.effects.last() else { continue };
            let name = format!(
                "with {}, {}",
                effect_words(effect.definition.name),
                joint_words(self.subject.outer_joint(effect.joint))
            );
            levels.push(level(&name, &self.within_prior(&step.linear).residual));
        }
        let rms_v = held_out_floor_v(self.evidence, &self.noise);
        levels.push(Level { name: "noise".into(), rms_v });
        levels
    }

    fn causes(
        &self,
        refitted: &Linearisation,
        last: &Linearisation,
    ) -> (Vec<Cause>, Vec<Alternative>) {
        let known = self.subject.known_effects.len();
        let added = last.hypothesis.effects.len() - known;
        let mut causes = Vec::new();
        let mut alternatives = Vec::new();
        for index in 0..added {
            let effect = &last.hypothesis.effects[known + index];
            let without = (added > 1).then(|| self.without(last, known + index)).flatten();
            let before = without.as_ref().unwrap_or(refitted);
            let joints = match effect.joint {
                0 => self.evidence.joints.clone(),
                joint => vec![usize::from(joint) - 1],
            };
            let shrinkage = Shrinkage::of(self.evidence, &joints, &before.residual, &last.residual);
            let (sure, others) = confidence(self.selection, index, self.subject);
            alternatives.extend(others);
            causes.push(Cause {
                effect: effect.definition.name.into(),
                joint: self.subject.outer_joint(effect.joint),
                parameters: parameters(effect),
                confidence: sure,
                shrinkage: shrinkage.value,
                shrinkage_interval: shrinkage.interval,
            });
        }
        let named = |other: &Alternative| {
            causes.iter().any(|c| c.effect == other.effect && c.joint == other.joint)
        };
        alternatives.retain(|other| !named(other));
        (causes, alternatives)
    }

    /// The model without one of its causes, within the prior.
    fn without(&self, last: &Linearisation, index: usize) -> Option<Linearisation> {
        let mut hypothesis = last.hypothesis.clone();
        hypothesis.effects.remove(index);
        let steps = self.subject.criteria.verdict.without_cause_steps;
        let free = fit(self.evidence, self.subject, hypothesis, steps)?;
        Some(self.within_prior(&free))
    }

    fn rivals(&self, named: bool) -> Vec<Rival> {
        let rival = |rejected: &RejectedCandidate| {
            let before = &self.selection.before(rejected.round).stats;
            let explained = match before.excess > 0.0 {
                true => 1.0 - rejected.stats.excess / before.excess,
                false => 1.0 - rejected.stats.prior_penalty / before.prior_penalty.max(1.0),
            };
            self.rival(&rejected.effect, explained, self.why_rejected(rejected, named))
        };
        let mut rivals: Vec<Rival> = self.selection.rejected.iter().map(rival).collect();
        if !named {
            rivals.extend(self.insufficient());
        }
        rivals.sort_by(|a, b| b.explained.total_cmp(&a.explained));
        rivals
    }

    fn rival(&self, effect: &EffectInstance, explained: f64, why: String) -> Rival {
        Rival {
            effect: effect.definition.name.into(),
            joint: self.subject.outer_joint(effect.joint),
            parameters: parameters(effect),
            explained: explained.clamp(0.0, 1.0),
            why,
        }
    }

    fn why_rejected(&self, rejected: &RejectedCandidate, named: bool) -> String {
        let left = format!("leaves up to {:.1} times the noise", rejected.stats.worst());
        let Some(model) = self.selection.added.get(rejected.round).filter(|_| named) else {
            return left;
        };
        let Some(added) = model.linear.hypothesis.effects.last() else { return left };
        let ratio = (rejected.stats.squares / model.stats.squares).sqrt();
        format!(
            "{left}, in all {ratio:.1} times what {} leaves",
            effect_words(added.definition.name)
        )
    }

    /// Effects that were added, but do not explain enough to be named.
    fn insufficient(&self) -> Vec<Rival> {
        let gap = &self.selection.refitted.stats;
        let rival = |model: &FittedModel| {
            let effect = model.linear.hypothesis.effects.last()?;
            let left = model.stats.worst();
            let why = format!("even with it, up to {left:.1} times the noise are left");
            Some(self.rival(effect, 1.0 - model.stats.excess / gap.excess.max(1.0), why))
        };
        self.selection.added.iter().filter_map(rival).collect()
    }

    fn logs(&self, given: &Rows, refitted: &Rows, last: &Rows) -> Vec<LogResiduals> {
        let hypothesis = &self.selection.refitted.linear.hypothesis;
        let of_stretch = |s: usize| {
            let stretch = &self.evidence.stretches[s];
            let trial = Trial::of(stretch, hypothesis, &self.subject.criteria.fit);
            let filter = self.evidence.filter(self.evidence.joints[0], s);
            let instants: Vec<usize> = filter.instants(stretch.len()).collect();
            let joint = |(&joint, &number): (&usize, &u8)| {
                let range = self.evidence.ranges(joint)[s].clone();
                let floor_v = self.evidence.floor_v(joint, s);
                let volts = |rows: &Rows| -> Vec<f64> {
                    rows[joint][range.clone()].iter().map(|row| floor_v * row).collect()
                };
                let at = |signal: &[f64]| instants.iter().map(|&k| signal[k]).collect();
                let command = at_samples(&stretch.command_v[joint]);
                JointResiduals {
                    joint: number,
                    position_rad: at(&stretch.motion.q_rad[joint]),
                    velocity_rad_per_s: at(&stretch.motion.qd_rad_per_s[joint]),
                    acceleration_rad_per_s2: at(
                        &filter.smooth(&stretch.motion.qdd_rad_per_s2[joint])
                    ),
                    load_nm: at(&trial.load_nm(joint)),
                    command_v: filter.rows(&command),
                    given_v: volts(given),
                    refitted_v: volts(refitted),
                    with_effects_v: volts(last),
                    noise_floor_v: noise_floor_v(self.evidence, &self.noise, joint, s),
                }
            };
            let joints = self.evidence.joints.iter().zip(&self.subject.numbers);
            LogResiduals {
                file: self.traces[stretch.log].file.clone(),
                role: stretch.role,
                time_s: instants
                    .iter()
                    .map(|&k| stretch.start_s + k as f64 * stretch.period_s)
                    .collect(),
                joints: joints.map(joint).collect(),
            }
        };
        (0..self.evidence.stretches.len()).map(of_stretch).collect()
    }

    /// The model file with refitted parameters, the effects and the tables.
    fn amended(&self, file: &RobotFile, hypothesis: &Hypothesis) -> RobotFile {
        let mut amended = self.subject.refitted_file(file, &hypothesis.robot);
        amended.effects = hypothesis
            .effects
            .iter()
            .map(|effect| EffectTable {
                effect: effect.definition.name.into(),
                joint: self.subject.outer_joint(effect.joint),
                parameters: parameters(effect)
                    .into_iter()
                    .map(|(name, value)| (name, as_toml(value)))
                    .collect(),
                ..EffectTable::default()
            })
            .chain(hypothesis.tables.iter().map(|table| {
                let joint = self.subject.outer_joint(table.joint);
                Table { joint, ..table.clone() }.to_effect_table()
            }))
            .collect();
        amended
    }
}

/// An effect's parameters by name, components of a vector together.
fn parameters(effect: &EffectInstance) -> BTreeMap<String, Value> {
    let mut all = BTreeMap::<String, Value>::new();
    for (parameter, &value) in effect.definition.parameters.iter().zip(&effect.values) {
        if parameter.optional && value == 0.0 {
            continue;
        }
        let entry = match all.remove(parameter.name) {
            None => Value::Number(value),
            Some(Value::Number(first)) => Value::Vector(vec![first, value]),
            Some(Value::Vector(mut values)) => {
                values.push(value);
                Value::Vector(values)
            }
        };
        all.insert(parameter.name.into(), entry);
    }
    all
}

fn as_toml(value: Value) -> toml::Value {
    match value {
        Value::Number(number) => toml::Value::Float(number),
        Value::Vector(values) => {
            toml::Value::Array(values.into_iter().map(toml::Value::Float).collect())
        }
    }
}
