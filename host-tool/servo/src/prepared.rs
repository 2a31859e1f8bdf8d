//! A campaign made ready: records, the rigid body along them, contacts cut out, joints refitted.

use rayon::prelude::*;

use diagnosis::Contact;
use files::{ArmFile, Role};
use model::chain::SerialChain;
use recordings::ArmCampaign;

use crate::along::{along, without_rotors};
use crate::arm_replay::arm_replay;
use crate::base::{Base, Frame, refit};
use crate::contact::{contacts, cut, deviations};
use crate::effect_table::apply;
use crate::error::ServoError;
use crate::fit::errors;
use crate::goal_clip::{self, GoalClip, goal_clips};
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::moves::{measured, simulated};
use crate::record::{Record, period};
use crate::settings::Settings;
use crate::whole_table::{tip_force, with_effects};

/// What everything after works on.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The links without rotors.
    pub links: SerialChain<f64>,
    /// The joints as given.
    pub given: Vec<ServoJoint>,
    /// All stretches; those to confirm on have the role `holdout`.
    pub logs: Vec<Judged>,
    /// Median distance of rows [s].
    pub period_s: f64,
    /// The joints refitted.
    pub bases: Vec<Base>,
    /// Contacts, which are cut.
    pub contacts: Vec<Contact>,
    /// Clipped goals, which are cut.
    pub clips: Vec<GoalClip>,
    /// Whether logs were held out; else the last part of each is.
    pub is_held_out: bool,
}

/// The joints of a file.
///
/// # Errors
/// A drive that is not known.
pub fn joints(arm: &ArmFile) -> Result<Vec<ServoJoint>, ServoError> {
    let joints = arm.joints.iter().enumerate().map(|(k, joint)| ServoJoint::of(k, joint));
    let mut servos = joints.collect::<Result<Vec<_>, _>>()?;
    apply(&arm.effects, &mut servos)?;
    Ok(servos)
}

impl Prepared {
    /// Reads a campaign's logs, finds contacts, refits all joints.
    ///
    /// # Errors
    /// Drives or links that are not known, no log to fit to.
    pub fn of(campaign: &ArmCampaign, settings: &Settings) -> Result<Self, ServoError> {
        let arm = &campaign.arm;
        let links = with_effects(&without_rotors(&arm.chain()?), &arm.effects)?;
        if tip_force(&arm.effects)? != [0.0; 3] {
            return Err(ServoError::Effect("tip_force".to_owned()));
        }
        let given = joints(arm)?;
        let records: Vec<Record> =
            campaign.recordings.iter().flat_map(|log| Record::of(log, settings)).collect();
        let is_held_out = records.iter().any(|record| record.role == Role::Holdout);
        let pieces = crate::pieces::pieces(records, is_held_out, settings);
        if !pieces.iter().any(|record| record.role == Role::Train) {
            return Err(ServoError::NoLog);
        }
        let period_s = pieces.iter().map(|r| period(&r.time_s)).fold(0.0, f64::max);
        let judged = |record: Record| Judged::of(&links, record, settings);
        let logs: Vec<Judged> = pieces.into_par_iter().map(judged).collect();
        let (bases, contacts, clips) = (Vec::new(), Vec::new(), Vec::new());
        let mut found = Self { links, given, logs, period_s, bases, contacts, clips, is_held_out };
        let turns: Vec<f64> = found.given.iter().map(|servo| servo.encoder_offset).collect();
        turns.iter().enumerate().for_each(|(joint, turn)| found.turn(joint, *turn));
        found.refit(settings);
        Ok(found)
    }

    /// The logs that are fitted to.
    pub fn train(&self) -> Vec<&Judged> {
        self.logs.iter().filter(|log| log.record.role == Role::Train).collect()
    }

    /// The logs that confirm.
    pub fn held_out(&self) -> Vec<&Judged> {
        self.logs.iter().filter(|log| log.record.role == Role::Holdout).collect()
    }

    /// Fits, cuts what is no free motion, until nothing more is found.
    fn refit(&mut self, settings: &Settings) {
        /// What a contact bends shows others once it is cut.
        const ROUNDS: usize = 3;
        for round in 0..ROUNDS {
            let starts: Vec<ServoJoint> = match self.bases.is_empty() {
                true => self.given.clone(),
                false => self.bases.iter().map(|base| base.fitted.servo).collect(),
            };
            if round > 0 {
                let links = self.links;
                self.follow(&links, [0.0; 3], &starts, settings);
            }
            let train = self.train();
            let frame = Frame { logs: &train, period_s: self.period_s, settings };
            let bases = refit(&frame, &self.given, &starts, round == 0);
            self.bases = bases;
            if round + 1 == ROUNDS || (!self.cut(settings) && round > 0) {
                break;
            }
        }
    }

    /// The rigid body along the motion of the arm as these joints move these links, a force on the tip; that force's
    /// own torque is not among what the body asks.
    pub fn follow(
        &mut self,
        links: &SerialChain<f64>,
        force_n: [f64; 3],
        servos: &[ServoJoint],
        settings: &Settings,
    ) {
        self.logs.par_iter_mut().for_each(|log| {
            let found = arm_replay(links, force_n, servos, &log.record, settings.step_s);
            let turns: Vec<f64> = log.moves.iter().map(|joint| joint.turn).collect();
            let followed = simulated(&log.record, servos, &found, settings);
            // An arm that its simulation loses goes on along what was measured.
            let is_near = followed.iter().all(|joint| joint.is_finite());
            log.moves = if is_near { followed } else { measured(&log.record) };
            log.moves.iter_mut().zip(turns).for_each(|(joint, turn)| joint.turn = turn);
            log.along = along(links, &log.moves);
        });
    }

    /// The rigid body with a joint standing elsewhere than its encoder says.
    pub fn turn(&mut self, joint: usize, turn: f64) {
        let links = self.links;
        let other = |log: &&mut Judged| log.moves[joint].turn != turn;
        self.logs.par_iter_mut().filter(other).for_each(|log| {
            log.moves[joint].turn = turn;
            log.along = along(&links, &log.moves);
        });
    }

    /// Cuts contacts and clipped goals that the present models show; whether there were new ones.
    fn cut(&mut self, settings: &Settings) -> bool {
        let servos: Vec<ServoJoint> = self.bases.iter().map(|base| base.fitted.servo).collect();
        let deviations = deviations(&self.train(), &servos, settings.search_step_s);
        let contacts_of = |log: &Judged| {
            let left = |(joint, servo)| errors(servo, log, joint, settings.search_step_s);
            let left: Vec<Vec<f64>> = servos.iter().enumerate().map(left).collect();
            (contacts(log, &left, &deviations, settings), left)
        };
        let found: Vec<(Vec<Contact>, Vec<Vec<f64>>)> =
            self.logs.par_iter().map(contacts_of).collect();
        let before = self.cut_rows();
        for (log, (contacts, left)) in self.logs.iter_mut().zip(found) {
            cut(log, &contacts);
            let clips = goal_clips(log, &left, &deviations, settings);
            goal_clip::cut(log, &clips, settings);
            self.contacts.extend(contacts);
            self.clips.extend(clips);
        }
        self.contacts = merged(std::mem::take(&mut self.contacts));
        self.cut_rows() > before
    }

    fn cut_rows(&self) -> usize {
        let of = |log: &Judged| log.counts.iter().flatten().filter(|counts| !**counts).count();
        self.logs.iter().map(of).sum()
    }
}

/// Contacts of all rounds as one list, those that overlap as one.
fn merged(mut contacts: Vec<Contact>) -> Vec<Contact> {
    contacts.sort_by(|a, b| a.file.cmp(&b.file).then(a.seconds[0].total_cmp(&b.seconds[0])));
    let mut found: Vec<Contact> = Vec::new();
    for contact in contacts {
        match found.last_mut() {
            Some(last) if last.file == contact.file && contact.seconds[0] <= last.seconds[1] => {
                last.seconds[1] = last.seconds[1].max(contact.seconds[1]);
            }
            _ => found.push(contact),
        }
    }
    found
}
