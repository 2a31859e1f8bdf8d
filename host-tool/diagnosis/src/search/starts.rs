//! Where searches begin: every effect on every joint, by what its starts promise.

use rayon::prelude::*;

use super::candidates::start_values;
use super::play::{best_of_each_gap, with_wider_gaps};
use super::promise::{Start, change_that_shows, promised_by};
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::hypothesis::EffectInstance;
use rig::effects::{Definition, Search};

/// The starts of an effect on a joint.
pub(super) struct EffectStarts {
    /// The effect.
    pub definition: &'static Definition,
    joint: u8,
    starts: Vec<Start>,
    /// What each changes of a model's rows, where that is asked for again.
    changes: Vec<RowChange>,
}

impl EffectStarts {
    /// Those of these effects and joints.
    pub fn at(
        places: &[(&'static Definition, u8)],
        linear: &Linearisation,
        evidence: &Evidence,
        subject: &Subject,
    ) -> Vec<Self> {
        let of_place = |&(definition, joint): &(&'static Definition, u8)| {
            Self::of(definition, joint, linear, evidence, subject)
        };
        places.par_iter().map(of_place).collect()
    }

    fn of(
        definition: &'static Definition,
        joint: u8,
        linear: &Linearisation,
        evidence: &Evidence,
        subject: &Subject,
    ) -> Self {
        let values = start_values(linear, evidence, subject, definition, joint);
        let effects = values.into_iter().map(|values| EffectInstance { definition, joint, values });
        let (mut starts, mut changes) = (Vec::new(), Vec::new());
        for effect in with_wider_gaps(effects.collect()) {
            let change = change_that_shows(linear, evidence, &effect);
            starts.push(Start { gain: promised_by(linear, &effect, &change), effect });
            // Springs have many starts, and waves others on other rows.
            if !is_wave(definition) && !is_spring(definition) {
                changes.push(change);
            }
        }
        Self { definition, joint, starts, changes }
    }

    /// The same for the same model linearised on rows with other weights; not asked for springs. Orders of waves are
    /// told by the rows; what other starts change is what it was.
    pub fn on(
        &self,
        evidence: &Evidence,
        (linear, to): (&Linearisation, &Evidence),
        subject: &Subject,
    ) -> Self {
        if is_wave(self.definition) {
            return Self::of(self.definition, self.joint, linear, to, subject);
        }
        let again = |(start, change): (&Start, &RowChange)| {
            let (effect, change) = (start.effect.clone(), evidence.change_on(to, change));
            Start { gain: promised_by(linear, &effect, &change), effect }
        };
        let starts = self.starts.iter().zip(&self.changes).map(again).collect();
        Self { starts, changes: Vec::new(), ..*self }
    }

    /// The most promising of them, the best first.
    pub fn best(&self, subject: &Subject) -> Vec<Start> {
        let mut starts = self.starts.clone();
        starts.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        match starts.first() {
            Some(start) if start.effect.has_backlash() => best_of_each_gap(&mut starts),
            _ => starts.truncate(subject.criteria.search.starts),
        }
        starts
    }
}

fn is_wave(definition: &'static Definition) -> bool {
    matches!(definition.search, Search::Harmonics(_))
}

/// Whether an effect is a spring between motor and link, whatever its values.
pub(super) fn is_spring(definition: &'static Definition) -> bool {
    let values = definition.parameters.iter().map(|parameter| parameter.highest).collect();
    EffectInstance { definition, joint: 1, values }.is_spring()
}
