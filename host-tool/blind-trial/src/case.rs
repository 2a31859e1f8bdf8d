//! One case: a robot, the model given of it, and what the model does not know.

use firmware::ParameterBlock;
use model::Robot;
use serde::{Deserialize, Serialize};

use super::cause::TrueCause;
use super::error::TrialError;
use super::plans::Motions;
use files::Log;
use rig::effects::Effect;
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

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
    /// The model that the board and the diagnosis are given.
    pub given: Robot<f64>,
    /// What the true robot does beyond its model.
    pub causes: Vec<TrueCause>,
    /// How much the causes show.
    pub visibility: Option<super::visibility::Visibility>,
    /// What is played.
    pub motions: Motions,
    /// All durations of the recipe times this.
    pub duration_scale: f64,
    /// Amplifier noise [V rms].
    pub noise_v: f64,
    /// Seed of the amplifier noise.
    pub seed: u32,
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

    /// The rig, whose board works with the model given.
    pub fn rig(&self) -> Rig {
        Rig::new(self.given)
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
        let plans = self.plans().into_iter().enumerate();
        plans.map(|(index, plan)| self.record_plan(index, plan)).collect()
    }

    fn record_plan(&self, index: usize, plan: Plan) -> Result<Recorded, TrialError> {
        let rig = self.rig();
        let block = plan.block(&rig);
        let robot = self.robot_of(&block, &rig, index)?;
        let mut board = InProcess::default();
        let recording = record_robot(&mut board, &block, robot, plan.ticks(&rig), &mut |_| {})?;
        Ok(Recorded { plan, log: recording.log })
    }

    fn robot_of(
        &self,
        block: &ParameterBlock,
        rig: &Rig,
        index: usize,
    ) -> Result<SimulatedRobot, TrialError> {
        let settings = Settings {
            sample_period_s: rig.sample_period_s,
            noise_v: self.noise_v,
            seed: u64::from(self.seed) << 32 | index as u64,
            ..Settings::default()
        };
        let effects: Result<Vec<Box<dyn Effect>>, _> =
            self.causes.iter().map(TrueCause::build).collect();
        Ok(SimulatedRobot::with_effects(self.robot, effects?, start_of(block), &settings))
    }
}
