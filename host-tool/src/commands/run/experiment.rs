//! The experiment that `rrr run` plays, and limits for it.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use firmware::ParameterBlock;
use firmware::link::Telemetry;
use firmware::reference::Motion;

use crate::failure::Failure;
use crate::options::mode::mode_named;
use files::ExcitationFile;
use link::approach::positions_rad;
use rig::{Plan, Rig, plan};

/// What can be played.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ExperimentName {
    /// Hold every joint where it is.
    Hold,
    /// The Fourier series that identifies best, on all joints.
    Excitation,
    /// Slow reversals of all joints.
    Slow,
    /// Moderate motion with noise up to 200 Hz added to every command.
    DrivenNoise,
    /// Legs at constant speed, both ways, of --joint.
    ConstantVelocity,
    /// Open loop on joint 3, slow and fast phases.
    FrictionExcitation,
    /// Open-loop noise below static friction on --joint.
    PreslidingNoise,
    /// The validation motion, eq. (20)-(21).
    Task,
}

impl ExperimentName {
    /// Whether the duration of the experiment is fixed.
    fn has_own_duration(self) -> bool {
        matches!(self, Self::ConstantVelocity | Self::FrictionExcitation | Self::PreslidingNoise)
    }
}

/// What is played.
#[derive(Clone, Debug, Args)]
pub struct ExperimentOptions {
    /// The experiment.
    #[arg(value_enum, value_name = "EXPERIMENT")]
    pub experiment: ExperimentName,
    /// The joint, for constant-velocity and presliding-noise.
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=3))]
    pub joint: Option<u8>,
    /// Duration of hold, excitation, slow, driven-noise and task, instead of 10, 30, 20, 12
    /// and 20 s.
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub duration: Option<u16>,
    /// The control mode, instead of the experiment's own (hold and task: that of the
    /// uploaded block): pd, pd-friction, pd-model, friction-only or open-loop.
    #[arg(long)]
    pub mode: Option<String>,
    /// Play this motion, as `rrr design-excitation` writes it, for the excitation.
    #[arg(long, value_name = "EXCITATION.toml")]
    pub excitation: Option<PathBuf>,
    /// Seed of noises.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
}

impl ExperimentOptions {
    /// Checks what can be checked without a board.
    ///
    /// # Errors
    /// Options that do not fit the experiment.
    pub fn check(&self) -> Result<(), Failure> {
        self.mode.as_deref().map(mode_named).transpose()?;
        let needs_joint = matches!(
            self.experiment,
            ExperimentName::ConstantVelocity | ExperimentName::PreslidingNoise
        );
        let refused = |message: &str, hint: &str| Err(Failure::new(message, hint));
        match (needs_joint, self.joint) {
            (true, None) => {
                refused("--joint is missing", "name the joint that is moved: 1, 2 or 3")
            }
            (false, Some(joint))
                if (self.experiment, joint) != (ExperimentName::FrictionExcitation, 3) =>
            {
                let message = format!("--joint {joint}: not with this experiment");
                refused(&message, "only constant-velocity and presliding-noise take one")
            }
            _ if self.excitation.is_some() && self.experiment != ExperimentName::Excitation => {
                refused("--excitation: not with this experiment", "only excitation plays a file")
            }
            _ if self.duration.is_some() && self.experiment.has_own_duration() => refused(
                "--duration: not with this experiment, whose duration is fixed",
                "hold, excitation, slow, driven-noise and task take one",
            ),
            _ => Ok(()),
        }
    }

    /// The experiment on this rig.
    ///
    /// # Errors
    /// An excitation file that cannot be used.
    pub fn plan(&self, stored: &ParameterBlock, now: &Telemetry) -> Result<Plan, Failure> {
        let plan = self.by_name(&rig(stored), stored, now)?;
        let own = matches!(self.experiment, ExperimentName::Hold | ExperimentName::Task);
        Ok(match self.mode.as_deref().map(mode_named).transpose()? {
            Some(mode) => plan.with_mode(mode),
            None if own => Plan { mode: stored.mode, ..plan },
            None => plan,
        })
    }

    fn by_name(
        &self,
        rig: &Rig,
        stored: &ParameterBlock,
        now: &Telemetry,
    ) -> Result<Plan, Failure> {
        let seconds = |usual: u16| f32::from(self.duration.unwrap_or(usual));
        let joint = self.joint.unwrap_or(3);
        Ok(match self.experiment {
            ExperimentName::Hold => {
                let here = positions_rad(stored, now);
                plan::hold(seconds(10))
                    .with_motion(here.map(|angle_rad| Motion::Hold { angle_rad }))
            }
            ExperimentName::Excitation => match &self.excitation {
                Some(path) => plan::excitation(1, seconds(30))
                    .with_motion(ExcitationFile::read(path)?.motion()),
                None => plan::excitation(1, seconds(30)),
            },
            ExperimentName::Slow => plan::slow(seconds(20)),
            ExperimentName::DrivenNoise => plan::driven_noise(seconds(12), self.seed),
            ExperimentName::ConstantVelocity => plan::constant_velocity(joint),
            ExperimentName::FrictionExcitation => plan::friction_excitation(rig),
            ExperimentName::PreslidingNoise => {
                plan::presliding_noise(rig, joint, 3 * self.seed + u32::from(joint))
            }
            ExperimentName::Task => plan::task(seconds(20)),
        })
    }
}

/// The rig that a block is for, as far as plans look at it.
fn rig(block: &ParameterBlock) -> Rig {
    Rig {
        encoder_counts_per_turn: block.encoder_counts_per_turn,
        sample_period_s: f64::from(block.sample_period_s),
        command_limit_v: f64::from(block.command_limit_v),
        ..Rig::new(block.robot.cast())
    }
}

/// Limits for one run, below those that were uploaded.
#[derive(Clone, Debug, Default, Args)]
pub struct Limits {
    /// Limit commands to this voltage.
    #[arg(long, value_name = "VOLTS")]
    pub command_limit_v: Option<f32>,
    /// A joint that is faster causes a fault.
    #[arg(long, value_name = "RAD_PER_S")]
    pub speed_limit: Option<f32>,
    /// A joint that is further from its reference causes a fault.
    #[arg(long, value_name = "RAD")]
    pub tracking_limit: Option<f32>,
}

impl Limits {
    /// The block with these limits.
    ///
    /// # Errors
    /// A limit above that of the block.
    pub fn applied_to(&self, mut block: ParameterBlock) -> Result<ParameterBlock, Failure> {
        lower("--command-limit-v", self.command_limit_v, &mut block.command_limit_v)?;
        for joint in 0..3 {
            let safety = &mut block.safety;
            lower("--speed-limit", self.speed_limit, &mut safety.speed_rad_per_s[joint])?;
            let widest = &mut safety.tracking_error_rad[joint];
            lower("--tracking-limit", self.tracking_limit, widest)?;
        }
        Ok(block)
    }
}

fn lower(option: &str, wanted: Option<f32>, limit: &mut f32) -> Result<(), Failure> {
    let Some(wanted) = wanted else { return Ok(()) };
    if !(wanted > 0.0 && wanted <= *limit) {
        let message = format!("{option} {wanted}: must be above 0 and at most {limit}");
        return Err(Failure::new(message, "limits of a run can only be lower than those uploaded"));
    }
    *limit = wanted;
    Ok(())
}
