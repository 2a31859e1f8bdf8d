//! One case: a robot, its nominal model, and the effects that the model does not have.

use firmware::ParameterBlock;
use firmware::block::HardLimits;
use model::Robot;
use serde::{Deserialize, Serialize};

use super::cause::TrueCause;
use super::error::TrialError;
use super::plans::Motions;
use super::reality::Reality;
use super::rng::Rng;
use super::visibility::Visibility;
use files::Log;
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{FrictionLaw, Settings, SimulatedRobot, record_sampled, start_of};

/// What kind of truth a case has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Nothing that the model, refitted, does not hold.
    None,
    /// One effect of the catalogue.
    Single,
    /// Two different ones.
    Pair,
    /// One that the catalogue does not have.
    Foreign,
}

impl Kind {
    /// All kinds, and how often each is drawn.
    pub const ALL: [(Self, f64); 4] =
        [(Self::None, 0.15), (Self::Single, 0.50), (Self::Pair, 0.20), (Self::Foreign, 0.15)];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Single => "single",
            Self::Pair => "pair",
            Self::Foreign => "foreign",
        }
    }
}

/// A case of a blind trial.
#[derive(Clone, Debug)]
pub struct Case {
    /// 1, 2, ...
    pub number: u32,
    /// What kind of truth it has.
    pub kind: Kind,
    /// The true robot.
    pub robot: Robot<f64>,
    /// The model that the board works with and that the diagnosis gets.
    pub nominal: Robot<f64>,
    /// What the true robot does beyond its model.
    pub causes: Vec<TrueCause>,
    /// How much the causes show.
    pub visibility: Option<Visibility>,
    /// What is played.
    pub motions: Motions,
    /// All durations of the recipe times this.
    pub duration_scale: f64,
    /// Amplifier noise [V rms].
    pub noise_v: f64,
    /// Seed of the amplifier noise.
    pub seed: u32,
    /// What else the robot is; `None` in the plain trial.
    pub reality: Option<Reality>,
}

/// A log and the plan that it was recorded by.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The plan.
    pub plan: Plan,
    /// The log.
    pub log: Log,
}

impl Case {
    /// The same robot, motions and noise with other causes.
    pub fn with_causes(&self, causes: Vec<TrueCause>) -> Self {
        Self { causes, visibility: None, ..self.clone() }
    }

    /// The same in another reality.
    pub fn with_reality(&self, reality: Reality) -> Self {
        Self { reality: Some(reality), ..self.clone() }
    }

    /// The rig, whose board works with the nominal model.
    pub fn rig(&self) -> Rig {
        let rig = Rig::new(self.nominal);
        match &self.reality {
            None => rig,
            Some(Reality { bus, .. }) => Rig {
                encoder_counts_per_turn: bus.counts_per_turn(),
                sample_period_s: bus.sample_period_s,
                ..rig
            },
        }
    }

    /// What is recorded.
    pub fn plans(&self) -> Vec<Plan> {
        self.motions.plans(self.duration_scale)
    }

    /// Records all logs; same case, same logs.
    ///
    /// # Errors
    /// The board refuses the model, or the causes cannot be built.
    pub fn record(&self) -> Result<Vec<Recorded>, TrialError> {
        let mut recorded = self.record_undamaged()?;
        if let Some(reality) = &self.reality {
            for (index, recorded) in (0..).zip(&mut recorded) {
                let log = std::mem::take(&mut recorded.log);
                recorded.log = reality.bus.damage(log, &mut Rng::new(self.seed, index));
            }
        }
        Ok(recorded)
    }

    /// The same as the rig saw it, before clock and bus changed the logs.
    ///
    /// # Errors
    /// As of [`Self::record`].
    pub fn record_undamaged(&self) -> Result<Vec<Recorded>, TrialError> {
        self.record_plans(self.plans())
    }

    /// Records other plans than its own, one after the other.
    ///
    /// # Errors
    /// As of [`Self::record`].
    pub fn record_plans(&self, plans: Vec<Plan>) -> Result<Vec<Recorded>, TrialError> {
        let mut laws = self.reality.as_ref().map(|reality| reality.friction_laws(&self.robot));
        let plans = plans.into_iter().enumerate();
        plans.map(|(index, plan)| self.record_plan(index, plan, &mut laws)).collect()
    }

    /// Records one plan; laws of friction go on where the plan before left them.
    fn record_plan(
        &self,
        index: usize,
        plan: Plan,
        laws: &mut Option<[Box<dyn FrictionLaw>; 3]>,
    ) -> Result<Recorded, TrialError> {
        let rig = self.rig();
        let block = self.block(&plan, &rig);
        let mut robot = self.robot_of(&block, &rig, index)?;
        let go_on = laws.is_some();
        if let Some(laws) = laws.take() {
            robot = robot.with_friction_laws(laws);
        }
        let sampler = self.sampler(index);
        let recording = record_with(sampler, &block, &mut robot, plan.ticks(&rig))?;
        *laws = go_on.then(|| robot.into_friction_laws());
        Ok(Recorded { plan, log: recording })
    }

    /// The plan's block. A coarse encoder's steps must not pass for broken wires.
    fn block(&self, plan: &Plan, rig: &Rig) -> ParameterBlock {
        let mut block = plan.block(rig);
        if self.reality.is_some() {
            block.safety.acceleration_rad_per_s2 =
                [HardLimits::default().acceleration_rad_per_s2; 3];
        }
        block
    }

    /// How the encoders are read.
    fn sampler(&self, index: usize) -> Sampler {
        match &self.reality {
            None => Box::new(SimulatedRobot::reading_rad),
            Some(reality) => Box::new(reality.sampler(Rng::new(self.seed, 100 + index as u32))),
        }
    }

    fn robot_of(
        &self,
        block: &ParameterBlock,
        rig: &Rig,
        index: usize,
    ) -> Result<SimulatedRobot, TrialError> {
        let settings = Settings {
            sample_period_s: rig.sample_period_s,
            substeps: (rig.sample_period_s / STEP_S).round() as u32,
            noise_v: self.noise_v,
            seed: u64::from(self.seed) << 32 | index as u64,
        };
        let mut effects = Vec::new();
        for cause in &self.causes {
            effects.push(cause.build()?);
        }
        if let Some(reality) = &self.reality {
            effects.extend(reality.effects(settings.seed)?);
        }
        Ok(SimulatedRobot::with_effects(self.robot, effects, start_of(block), &settings))
    }
}

/// The simulator's step [s], as fine as its own default.
const STEP_S: f64 = 1e-4;

/// What the encoders read of a robot [rad].
type Sampler = Box<dyn FnMut(&SimulatedRobot) -> [f64; 3]>;

fn record_with(
    mut sampler: Sampler,
    block: &ParameterBlock,
    robot: &mut SimulatedRobot,
    ticks: u32,
) -> Result<Log, TrialError> {
    let mut board = InProcess::default();
    let recording = record_sampled(&mut board, block, robot, ticks, &mut sampler, &mut |_| {})?;
    Ok(recording.log)
}
