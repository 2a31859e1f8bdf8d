//! From the judgement to the report.

use super::amended::amended;
use super::causes::{causes, rivals};
use super::log_residuals::{Stages, log_residuals};
use super::motion_gap::drift_rms_rad;
use super::parameters_changed::parameters_changed;
use super::remainder::remainder;
use super::sentence::{effect_words, joint_words};
use super::{torque_constants, warmth};
use crate::fit::fitted_model::FittedModel;
use crate::fit::preparation::in_file;
use crate::gap_by_axis::gap_by_axis;
use crate::logs::subject::Subject;
use crate::model_faults::FoundFault;
use crate::model_file::ModelFile;
use crate::posterior::Posterior;
use crate::result::{
    DataParts, Detectable, Diagnosis, Gap, GapShare, Level, LogResiduals, ModelFaultFound, Report,
    Untestable, Verdict,
};
use crate::rows::evidence::{Evidence, Rows};
use crate::trial::residual_rows::residual_rows;
use crate::verdict::blocks::confirming_rms_v;
use crate::verdict::decision::verdict;
use crate::verdict::held::Held;
use crate::verdict::judged::Reason;
use crate::verdict::judgement::Judgement;
use crate::verdict::{detectable, misfit};
use files::Role;
use recordings::Trace;

/// All that the report is made of.
pub struct Assembly<'a> {
    /// What is diagnosed.
    pub subject: &'a Subject,
    /// The rows, weighted as if what is left were noise.
    pub evidence: &'a Evidence,
    /// What the search amounts to.
    pub judgement: &'a Judgement<'a>,
    /// The model with tables for what remains.
    pub tables: Held,
    /// What is wrong with the model itself.
    pub fault: Option<FoundFault>,
    /// The logs.
    pub traces: &'a [Trace],
    /// Noise of a joint's rows in every stretch, rms [V], by joint.
    pub noise_v: Vec<Vec<f64>>,
}

impl Assembly<'_> {
    /// The whole diagnosis.
    pub fn diagnosis(&self, file: &ModelFile, mut remarks: Vec<String>) -> Diagnosis {
        let (subject, judgement) = (self.subject, self.judgement);
        let criteria = &subject.criteria;
        let given_v = self.evidence.volts(&residual_rows(self.evidence, &in_file(subject)));
        let logs = self.log_residuals(&given_v);
        let (detectable, untestable) = self.detectable();
        let (causes, alternatives) = causes(subject, judgement);
        let verdict = self.verdict(causes.len());
        remarks.extend(self.remark(verdict));
        let last = &judgement.last.linear.hypothesis;
        remarks.extend(warmth::words(subject, &self.evidence.stretches, last));
        remarks.extend(self.remarks_of_lengths());
        remarks.extend(torque_constants::words(subject));
        let report = Report {
            format: 2,
            verdict,
            causes,
            alternatives,
            parameters_changed: parameters_changed(
                subject,
                &judgement.confirmation.refitted.linear,
                &judgement.last.linear,
            ),
            remainder: remainder(subject, judgement, &logs),
            gap_shares: self.gap_shares(&logs),
            gap: self.gap(&given_v),
            data: self.data(),
            untestable,
            detectable,
            remarks,
            model_fault: self.model_fault(),
            contact: None,
        };
        Diagnosis {
            report,
            logs,
            waterfall: self.waterfall(&given_v),
            rivals: rivals(subject, judgement),
            model: amended(subject, file, &self.tables.linear.hypothesis),
            posterior: Some(Posterior::of(subject, file, &self.tables.linear)),
            catalogue: subject.catalogue.clone(),
            criteria: criteria.clone(),
            units: subject.units_by_number(),
        }
    }

    /// Where the gap lies, in the joints' units.
    fn gap_shares(&self, logs: &[LogResiduals]) -> Vec<GapShare> {
        let units = self.subject.units_by_number();
        let mut shares = gap_by_axis(logs, &self.subject.criteria.axes);
        for share in &mut shares {
            share.detail = units
                .get(&share.joint)
                .map_or_else(|| share.detail.clone(), |units| units.in_words(&share.detail));
        }
        shares
    }

    /// What must be said where the model is not that of the robot in the logs.
    fn remark(&self, verdict: Verdict) -> Option<String> {
        match self.model_fault() {
            Some(fault) => Some(format!("the logs do not fit this model: {}", fault.what)),
            None => misfit::remark(self.subject, &self.judgement.refitted, verdict),
        }
    }

    /// What lengths that are a little off would do as well, each in its words.
    fn remarks_of_lengths(&self) -> impl Iterator<Item = String> {
        let by_lengths = self.judgement.withheld.iter().filter(|it| it.reason == Reason::Lengths);
        by_lengths.map(|withheld| {
            let words = effect_words(withheld.effect.definition.name);
            format!("lengths that are a few per cent off do what a {words} would do; measure them")
        })
    }

    /// What the logs would have shown beside the causes that are named, whose own gap does not hide it.
    fn detectable(&self) -> (Vec<Detectable>, Vec<Untestable>) {
        let Judgement { refitted, last, .. } = self.judgement;
        let weighted = refitted.linear.reweighted(&refitted.evidence, &last.evidence);
        let linear = weighted.as_ref().unwrap_or(&refitted.linear);
        detectable::detectable(linear, &last.evidence, self.subject)
    }

    /// The verdict in one word; no cause is sought in a model that is at fault itself.
    fn verdict(&self, named: usize) -> Verdict {
        let Judgement { refitted, last, confirmation, .. } = self.judgement;
        let (tables_v, criteria) = (&self.tables.residual_v, &self.subject.criteria.verdict);
        match self.fault {
            Some(_) => Verdict::Unknown,
            None => verdict(refitted, last, tables_v, named, confirmation, criteria),
        }
    }

    fn model_fault(&self) -> Option<ModelFaultFound> {
        self.fault.as_ref().map(|found| ModelFaultFound {
            what: found.fault.words(self.subject),
            explained: found.explained,
        })
    }

    /// What each stage leaves of every log.
    fn log_residuals(&self, given_v: &Rows) -> Vec<LogResiduals> {
        let Judgement { refitted, confirmation, .. } = self.judgement;
        let stages = Stages {
            given_v,
            refitted_v: &confirmation.refitted.residual_v,
            with_effects_v: &confirmation.full.residual_v,
            noise_v: &self.noise_v,
        };
        let hypothesis = &refitted.linear.hypothesis;
        log_residuals(self.subject, self.evidence, self.traces, hypothesis, &stages)
    }

    fn gap(&self, given_v: &Rows) -> Gap {
        let confirmation = &self.judgement.confirmation;
        let rms = |rows: &Rows| confirming_rms_v(self.evidence, rows);
        let drift = |held: &Held| drift_rms_rad(self.evidence, &held.linear.hypothesis);
        Gap {
            as_given_v: rms(given_v),
            refitted_v: rms(&confirmation.refitted.residual_v),
            with_effects_v: rms(&confirmation.full.residual_v),
            with_tables_v: rms(&self.tables.residual_v),
            noise_floor_v: self.noise_rms_v(),
            as_given_rad: drift_rms_rad(self.evidence, &in_file(self.subject)),
            refitted_rad: drift(&confirmation.refitted),
            with_effects_rad: drift(&confirmation.full),
            ..Gap::default()
        }
    }

    /// What noise alone would leave of each joint's confirming rows, rms [V].
    fn noise_rms_v(&self) -> Vec<f64> {
        let of_joint = |joint: usize| {
            let ranges = self.evidence.ranges(joint).into_iter().enumerate();
            ranges.flat_map(|(s, range)| vec![self.noise_v[joint][s]; range.len()]).collect()
        };
        let one: Rows = (0..self.evidence.joint_count()).map(of_joint).collect();
        confirming_rms_v(self.evidence, &one)
    }

    /// The gap step by step, one cause more each.
    fn waterfall(&self, given_v: &Rows) -> Vec<Level> {
        let level = |name: String, rows: &Rows| Level {
            name,
            rms_v: confirming_rms_v(self.evidence, rows),
        };
        let confirmation = &self.judgement.confirmation;
        let mut levels = vec![
            level("as given".into(), given_v),
            level("refitted".into(), &confirmation.refitted.residual_v),
        ];
        let known = self.subject.known_effects.len();
        for count in 1..=self.judgement.named.len() {
            let Some(held) = self.with_first(known + count) else { continue };
            let effect = &self.judgement.last.linear.hypothesis.effects[known + count - 1];
            let joint = joint_words(self.subject.outer_joint(effect.joint));
            let name = format!("with {}, {joint}", effect_words(effect.definition.name));
            levels.push(level(name, &held.residual_v));
        }
        let tables = |held: &Held| held.linear.hypothesis.tables.len();
        if tables(&self.tables) > tables(&confirmation.full) {
            levels.push(level("with tables".into(), &self.tables.residual_v));
        }
        levels.push(Level { name: "noise".into(), rms_v: self.noise_rms_v() });
        levels
    }

    /// The last model with just the first of its effects.
    fn with_first(&self, count: usize) -> Option<Held> {
        let Judgement { last, confirmation, .. } = self.judgement;
        let mut hypothesis = last.linear.hypothesis.clone();
        if hypothesis.effects.len() == count {
            return Some(confirmation.full.clone());
        }
        hypothesis.effects.truncate(count);
        let steps = self.subject.criteria.verdict.without_cause_steps;
        let FittedModel { linear, evidence, .. } = last;
        let model = FittedModel::fitted_near(linear, evidence, self.subject, hypothesis, steps)?;
        Some(Held::of(self.subject, &model))
    }

    /// Which logs served for what.
    fn data(&self) -> DataParts {
        let files = |role: Role| {
            let stretches = self.evidence.stretches.iter().filter(|s| s.role == role);
            let mut files: Vec<String> =
                stretches.map(|s| self.traces[s.log].file.clone()).collect();
            files.dedup();
            files
        };
        let train = files(Role::Train);
        DataParts { fit: train.clone(), select: train, confirm: files(Role::Holdout) }
    }
}
