//! A model of one joint: its base and the effects that were added.

use crate::base::{Base, FLOOR_RAD, Frame};
use crate::candidates::Candidate;
use crate::cross::{Gain, LeftOut, cross_validate};
use crate::fit::{Fitted, Problem, Unknown, fit};
use crate::settings::Settings;

/// A model of a joint with effects.
#[derive(Clone, Debug)]
pub struct Model {
    /// The effects, in the order in which they were added.
    pub effects: Vec<Candidate>,
    /// All that is fitted: the base's, then the effects'.
    pub unknowns: Vec<Unknown>,
    /// Fitted to all logs.
    pub fitted: Fitted,
    /// What is left of the logs that it is fitted to.
    pub left: LeftOut,
}

/// An effect that was tried.
#[derive(Clone, Debug)]
pub struct Tried {
    /// Its name.
    pub effect: &'static str,
    /// Its fields' values.
    pub values: Vec<f64>,
    /// What it gains.
    pub gain: Gain,
    /// Logarithm of its likelihood.
    pub evidence: f64,
}

impl Model {
    /// The base without effects.
    pub fn of_base(frame: &Frame, joint: usize, base: &Base) -> Self {
        let problem = frame.problem(joint, &base.unknowns, base.scale);
        let left = LeftOut::of_fit(&base.fitted, &problem);
        let (unknowns, fitted) = (base.unknowns.clone(), base.fitted.clone());
        Self { effects: Vec::new(), unknowns, fitted, left }
    }

    /// With an effect more, from the best of its starts; none where it has no start.
    pub fn with(
        &self,
        frame: &Frame,
        joint: usize,
        scale: f64,
        effect: &Candidate,
    ) -> Option<Self> {
        let mut unknowns = self.unknowns.clone();
        let is_kept = |known: &Unknown| effect.fields().all(|new| !new.overlaps(known.field));
        unknowns.retain(is_kept);
        unknowns.extend(effect.unknowns.iter().copied());
        let problem = Problem { iterations: 7, ..frame.problem(joint, &unknowns, scale) };
        let starts = effect.starts.iter().map(|values| effect.start(&self.fitted.servo, values));
        let cost = |fitted: &Fitted| fitted.normals.iter().map(|log| log.robust).sum::<f64>();
        let fits = starts.map(|start| fit(&problem, &start));
        let fitted = fits.min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
        let left = LeftOut::of_fit(&fitted, &problem);
        let effects = self.effects.iter().chain([effect]).cloned().collect();
        Some(Self { effects, unknowns, fitted, left })
    }

    /// Fitted until nothing changes.
    pub fn polish(&mut self, frame: &Frame, joint: usize, scale: f64) {
        let problem = Problem { iterations: 30, ..frame.problem(joint, &self.unknowns, scale) };
        self.fitted = fit(&problem, &self.fitted.servo);
        self.left = LeftOut::of_fit(&self.fitted, &problem);
    }

    /// Without one of its effects, all else fitted again.
    pub fn without(&self, frame: &Frame, joint: usize, base: &Base, effect: usize) -> Self {
        let mut effects = self.effects.clone();
        let gone = effects.remove(effect);
        let mut servo = self.fitted.servo;
        for (field, neutral) in gone.fields().map(|field| (field, field.of(&base.given))) {
            field.set(&mut servo, neutral);
        }
        let mut unknowns = base.unknowns.clone();
        for unknown in effects.iter().flat_map(|effect| &effect.unknowns) {
            unknowns.retain(|known| !unknown.field.overlaps(known.field));
            unknowns.push(*unknown);
        }
        let fitted = fit(&frame.problem(joint, &unknowns, base.scale), &servo);
        let left = LeftOut::of_fit(&fitted, &frame.problem(joint, &unknowns, base.scale));
        Self { effects, unknowns, fitted, left }
    }

    /// What is left of logs left out.
    pub fn left_out(&self, frame: &Frame, joint: usize, scale: f64) -> LeftOut {
        let problem = frame.problem(joint, &self.unknowns, scale);
        cross_validate(&problem, &self.fitted, frame.settings.folds)
    }

    /// Whether it leaves hardly more than the encoder's steps: then there is nothing else that an effect
    /// could stand for.
    pub fn is_near_noise(&self, settings: &Settings) -> bool {
        self.fitted.rms() <= settings.near_noise * FLOOR_RAD
    }

    /// Settings for what it leaves: where that is hardly more than noise, small parts of it tell.
    pub fn settings(&self, settings: &Settings) -> Settings {
        let part = if self.is_near_noise(settings) { settings.least_near_noise } else { 1.0 };
        Settings {
            least_gain: part * settings.least_gain,
            least_shrinkage: part * settings.least_shrinkage,
            least_half_shrinkage: part * settings.least_half_shrinkage,
            ..settings.clone()
        }
    }
}
