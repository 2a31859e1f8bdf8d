//! The rows of a model, and their slopes in all that is open: what a linearisation is made of.

use model::friction_parameters::COUNT as FRICTION_COUNT;
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::earlier::Earlier;
use super::joint_slopes::{Column, JointSlopes};
use super::stretch_changes::changed;
use super::unknowns::{Expected, Unknown};
use crate::logs::intervals::at_samples;
use crate::rows::evidence::{Columns, Evidence, RowChange, Rows};
use crate::trial::active_effects::FRICTION_SLOPES;
use crate::trial::equation::Trial;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::parts::Parts;
use crate::trial::residual_rows::train_rows_of;
use crate::trial::rigid_rows::{base_columns, measured_columns};
use rig::effects::{Kind, Table};

/// A joint's equation in a stretch, its rows, and their slopes that need no whole model.
type Piece = (Parts, Vec<f64>, Vec<Column>);

/// The parts of the equation, the train rows, and their slopes, of every joint; slopes that a model
/// near by has already are taken from there.
pub fn slopes(
    evidence: &Evidence,
    hypothesis: &Hypothesis,
    expected: &[Expected],
    earlier: &Earlier,
) -> (Vec<Vec<Parts>>, Rows, Vec<JointSlopes>) {
    let wanted: Vec<(usize, &Expected)> =
        expected.iter().enumerate().filter(|(place, _)| !earlier.has(*place)).collect();
    let pieces: Vec<Vec<Piece>> = (0..evidence.train_stretches())
        .into_par_iter()
        .map(|s| stretch_slopes(evidence, s, hypothesis, &wanted))
        .collect();
    let mut parts = Vec::new();
    let mut residual = evidence.no_rows();
    let mut columns: Vec<Vec<Column>> = vec![Vec::new(); evidence.joint_count()];
    for piece in pieces {
        let mut take = |(joint, (parts, rows, of_stretch)): (usize, Piece)| {
            residual[joint].extend(rows);
            append(&mut columns[joint], of_stretch);
            parts
        };
        parts.push(piece.into_iter().enumerate().map(&mut take).collect());
    }
    for (place, rows) in effect_slopes(evidence, &parts, hypothesis, &wanted) {
        for (joint, rows) in rows.into_iter().enumerate() {
            columns[joint].extend(rows.map(|rows| (place, rows)));
        }
    }
    let of_joint = |&joint: &usize| {
        joined(JointSlopes::of(joint, &columns[joint], residual[joint].len()), earlier)
    };
    let joints = evidence.joints.par_iter().map(of_joint).collect();
    (parts, residual, joints)
}

/// Puts the rows of a stretch behind those of the stretches before.
fn append(columns: &mut Vec<Column>, of_stretch: Vec<Column>) {
    if columns.is_empty() {
        *columns = of_stretch;
        return;
    }
    columns.iter_mut().zip(of_stretch).for_each(|(column, (_, rows))| column.1.extend(rows));
}

/// A joint's slopes with the columns that a model near by has.
fn joined(slopes: JointSlopes, earlier: &Earlier) -> JointSlopes {
    let Some(of_joint) = earlier.of_joint(slopes.joint) else { return slopes };
    let own = slopes.places.iter().zip(slopes.matrix.column_iter());
    let kept = of_joint.iter().map(|(place, column)| (place, column.column(0)));
    let both: Vec<_> = own.chain(kept).collect();
    let places = both.iter().map(|(place, _)| **place).collect();
    let columns: Vec<_> = both.into_iter().map(|(_, column)| column).collect();
    let mut matrix = DMatrix::from_columns(&columns);
    let (own, gain) = (slopes.places.len(), earlier.gain(slopes.joint));
    if gain != 1.0 {
        matrix.columns_range_mut(own..).scale_mut(gain);
    }
    JointSlopes { joint: slopes.joint, places, matrix }
}

/// What the joints of the rig have in a stretch.
fn stretch_slopes(
    evidence: &Evidence,
    s: usize,
    hypothesis: &Hypothesis,
    wanted: &[(usize, &Expected)],
) -> Vec<Piece> {
    let trial = Trial::of(&evidence.stretches[s], hypothesis, &evidence.criteria.fit);
    let of_joint = |joint: usize| {
        if !evidence.joints.contains(&joint) {
            return Piece::default();
        }
        let parts = Parts::of(&trial, joint);
        let rows = train_rows_of(evidence, s, joint, &trial, &parts.net);
        let columns = own_slopes(evidence, s, joint, &trial, hypothesis, wanted);
        (parts, rows, columns)
    };
    (0..evidence.joint_count()).into_par_iter().map(of_joint).collect()
}

/// Slopes of a joint's rows in a stretch that need no whole model.
fn own_slopes(
    evidence: &Evidence,
    s: usize,
    joint: usize,
    trial: &Trial,
    hypothesis: &Hypothesis,
    wanted: &[(usize, &Expected)],
) -> Vec<Column> {
    let own: Columns;
    let is_base = |(_, e): &(usize, &Expected)| matches!(e.unknown, Unknown::Base(_));
    let base = match trial.moves_as_measured() || !wanted.iter().any(is_base) {
        true => measured_columns(evidence, s, joint, trial),
        false => {
            own = base_columns(evidence, s, joint, trial);
            &own
        }
    };
    let mut known = Known { hats: vec![None; hypothesis.tables.len()], friction: None };
    let mut column = |&(place, e): &(usize, &Expected)| match e.unknown {
        Unknown::Base(k) => base[k].clone().map(|mut column| {
            evidence.weigh(s, joint, &mut column);
            (place, column)
        }),
        unknown => {
            let slope = known.slope(unknown, joint, trial, hypothesis)?;
            Some((place, evidence.weighted(s, joint, &slope)))
        }
    };
    let gain = trial.motor_gain(joint);
    let as_sent = |wanted: &(usize, &Expected)| {
        let (place, mut column) = column(wanted)?;
        if !matches!(wanted.1.unknown, Unknown::Lag(_)) {
            column.iter_mut().for_each(|row| *row /= gain);
        }
        Some((place, column))
    };
    wanted.iter().filter_map(as_sent).collect()
}

/// Slopes that come several at a time, once asked for.
struct Known {
    /// What each table adds at each of its knots.
    hats: Vec<Option<Vec<Vec<f64>>>>,
    /// Slopes of friction in the intervals.
    friction: Option<Vec<[f64; FRICTION_SLOPES]>>,
}

impl Known {
    /// Slope of a joint's residual at the samples along what is open; none along base parameters,
    /// effects, and what is another joint's.
    fn slope(
        &mut self,
        unknown: Unknown,
        joint: usize,
        trial: &Trial,
        hypothesis: &Hypothesis,
    ) -> Option<Vec<f64>> {
        match unknown {
            Unknown::Friction { joint: of, parameter } if of == joint => {
                Some(self.friction_slope(parameter, joint, trial))
            }
            Unknown::FrictionLead(of) if of == joint => {
                Some(self.friction_slope(FRICTION_COUNT, joint, trial))
            }
            Unknown::GearLoss => Some(self.friction_slope(FRICTION_COUNT + 1, joint, trial)),
            Unknown::Warmth { joint: of, log, value } if of == joint => {
                Some(self.warmth_slope((log, value), joint, trial))
            }
            Unknown::Lag(of) if of == joint => {
                Some(trial.command_slope(joint).iter().map(|u| -u).collect())
            }
            Unknown::Table { index, knot } if of_joint(hypothesis, index, joint) => {
                let make = || table_hats(trial, &hypothesis.tables[index], joint);
                Some(self.hats[index].get_or_insert_with(make)[knot].clone())
            }
            _ => None,
        }
    }

    fn friction_slope(&mut self, place: usize, joint: usize, trial: &Trial) -> Vec<f64> {
        let slopes = self.friction_slopes(joint, trial);
        at_samples(&slopes.iter().map(|slope| -slope[place]).collect::<Vec<f64>>())
    }

    /// Slope along a part of the joint's warmth in a log: none on the other logs.
    fn warmth_slope(
        &mut self,
        (log, value): (usize, usize),
        joint: usize,
        trial: &Trial,
    ) -> Vec<f64> {
        let slopes = self.friction_slopes(joint, trial);
        if log != trial.log() {
            return at_samples(&vec![0.0; slopes.len()]);
        }
        let along = &trial.warmth_slopes(joint, slopes)[value];
        at_samples(&along.iter().map(|slope| -slope).collect::<Vec<f64>>())
    }

    fn friction_slopes(&mut self, joint: usize, trial: &Trial) -> &[[f64; FRICTION_SLOPES]] {
        self.friction.get_or_insert_with(|| trial.friction_slopes(joint))
    }
}

/// Whether a table lies on a joint (0 to 2).
fn of_joint(hypothesis: &Hypothesis, table: usize, joint: usize) -> bool {
    usize::from(hypothesis.tables[table].joint) == joint + 1
}

/// What a table of one volt at a knot and none at the others adds to a joint, at the samples; knot
/// by knot.
pub fn table_hats(trial: &Trial, table: &Table, joint: usize) -> Vec<Vec<f64>> {
    let abscissa = trial.abscissa(joint, table.axis);
    let of_knot = |knot: usize| {
        let mut unit = Table { values_v: vec![0.0; table.knots.len()], ..table.clone() };
        unit.values_v[knot] = 1.0;
        at_samples(&abscissa.iter().map(|x| unit.value_v(*x)).collect::<Vec<f64>>())
    };
    (0..table.knots.len()).map(of_knot).collect()
}

/// Slopes of the train rows along the open parameters of effects.
fn effect_slopes(
    evidence: &Evidence,
    parts: &[Vec<Parts>],
    hypothesis: &Hypothesis,
    wanted: &[(usize, &Expected)],
) -> Vec<(usize, RowChange)> {
    let slope = |&(place, expected): &(usize, &Expected)| match expected.unknown {
        Unknown::Effect { index, value } => {
            Some((place, effect_slope(evidence, parts, hypothesis, index, value)))
        }
        _ => None,
    };
    wanted.par_iter().filter_map(slope).collect()
}

/// Slope of the train rows along a value of an effect.
fn effect_slope(
    evidence: &Evidence,
    parts: &[Vec<Parts>],
    hypothesis: &Hypothesis,
    index: usize,
    value: usize,
) -> RowChange {
    let effect = &hypothesis.effects[index];

    let step = step_of(effect, value);
    let mut moved = hypothesis.clone();
    moved.effects[index].values[value] += step;
    let mut others = hypothesis.effects.clone();
    others.remove(index);
    let joints = match effect.definition.couples_joints {
        true => evidence.joints.clone(),
        false => vec![usize::from(effect.joint) - 1],
    };
    let before = (parts, hypothesis);
    let mut slope = changed(evidence, before, &moved, (effect, &others), &joints);
    slope.iter_mut().flatten().flatten().for_each(|row| *row /= step);
    slope
}

/// Step for a difference along a parameter of an effect, away from its nearer bound. A link
/// that bounces in its backlash makes rows rough: only wide steps show where they lead.
pub fn step_of(effect: &EffectInstance, value: usize) -> f64 {
    let parameters = effect.definition.parameters;
    let (parameter, value) = (&parameters[value], effect.values[value]);
    let part = if effect.has_backlash() { 0.15 } else { 5e-3 };
    let size = match parameter.kind {
        Kind::Phase => 1e-3,
        // Bounds may be far: a limit of a volt among a hundred thousand is not stepped over.
        _ => (part * value.abs()).max(1e-6 * (parameter.highest - parameter.lowest).min(10.0)),
    };
    if value + size > parameter.highest { -size } else { size }
}
