//! What the board does with a model: the parameter block and its options.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use clap::Args;
use firmware::ParameterBlock;
use firmware::block::HardLimits;
use model::ParameterError;

use super::compensation::compensated;
use super::mode::mode_named;
use crate::failure::Failure;
use files::{ExcitationFile, RobotFile};
use rig::joints::with_joints;
use rig::{Plan, Rig, plan, range};

/// What the board is to do with the model.
#[derive(Clone, Debug, Args)]
pub struct BlockOptions {
    /// The control mode: pd, pd-friction, pd-model, friction-only or open-loop.
    #[arg(long, default_value = "pd-model")]
    pub mode: String,
    /// The reference: hold (hanging down, 10 s), task (20 s) or excitation (30 s).
    #[arg(long, default_value = "hold", value_name = "NAME")]
    pub reference: String,
    /// Play this motion, as `rrr design-excitation` writes it; 30 s.
    #[arg(long, value_name = "EXCITATION.toml", conflicts_with = "reference")]
    pub excitation: Option<PathBuf>,
    /// The joints that the rig has, as in 3 or 1,3; the others get no voltage, and need no encoder.
    #[arg(long, value_delimiter = ',', value_parser = clap::value_parser!(u8).range(1..=3))]
    pub joints: Vec<u8>,
    /// The board compensates for the effects in the model file, as far as it can.
    #[arg(long)]
    pub compensate: bool,
    /// Limit commands to this voltage, which must be below the model file's.
    #[arg(long, value_name = "VOLTS")]
    pub command_limit_v: Option<f64>,
}

/// Words for a value that no board takes.
fn refused(model: &Path, why: &dyn Display) -> Failure {
    let message = format!("{}: the board refuses it: {why}", model.display());
    Failure::new(message, "correct the value in the model file")
}

/// Refuses a reference that leaves the joints' ranges.
///
/// # Errors
/// It does; with the time at which it would.
pub fn refuse_leaving(block: &ParameterBlock) -> Result<(), Failure> {
    match range::leaving(block) {
        None => Ok(()),
        Some(leaving) => Err(Failure::new(
            leaving.to_string(),
            "limits_rad of the model file has the ranges: take another reference, or a slower one",
        )),
    }
}

/// Words for a value that is beyond a hard limit of the board, with the limit.
fn beyond_limit(model: &Path, error: &ParameterError) -> Failure {
    let limit = hard_limit(error.name).map_or_else(String::new, |limit| format!(", {limit}"));
    let failure = refused(model, &format!("{error}{limit}"));
    match error.name {
        PROPORTIONAL_GAIN | DERIVATIVE_GAIN => Failure { hint: GAIN_HINT.to_owned(), ..failure },
        _ => failure,
    }
}

/// The hard limit of a parameter whose error does not state it, in the unit of its name.
fn hard_limit(name: &str) -> Option<f32> {
    let limits = HardLimits::default();
    match name {
        "command_limit_V" => Some(limits.command_v),
        PROPORTIONAL_GAIN => Some(limits.proportional_gain_v_per_rad),
        DERIVATIVE_GAIN => Some(limits.derivative_gain_v_s_per_rad),
        "speed_limit_rad_per_s" => Some(limits.speed_rad_per_s),
        "tracking_error_limit_rad" => Some(limits.tracking_error_rad),
        "acceleration_limit_rad_per_s2" => Some(limits.acceleration_rad_per_s2),
        "saturation_limit_s" => Some(limits.saturation_s),
        "stuck_travel_rad" => Some(limits.stuck_travel_rad),
        "stuck_voltage_V" => Some(limits.stuck_voltage_v),
        "stalled_margin_V" => Some(limits.stalled_margin_v),
        "hold_s" => Some(limits.hold_s),
        "stalled_s" => Some(limits.stalled_s),
        "start_error_limit_rad" => Some(limits.start_error_rad),
        "stuck_s" => Some(limits.stuck_s),
        _ => None,
    }
}

const PROPORTIONAL_GAIN: &str = "proportional_gain_V_per_rad";
const DERIVATIVE_GAIN: &str = "derivative_gain_V_s_per_rad";
const GAIN_HINT: &str = "the gains are made of inertia and torque constant: correct [base] or \
    torque_constant_Nm_per_V in the model file";

impl BlockOptions {
    /// The block for a model file, checked as the board checks it, hard limits and all.
    ///
    /// # Errors
    /// A file that cannot be used, an unknown name, or a value that the board refuses.
    pub fn parameter_block(&self, model: &Path) -> Result<ParameterBlock, Failure> {
        let file = RobotFile::read(model)?;
        let (rig, joints) = self.rig(&file)?;
        let rig = if self.compensate { compensated(rig, &file, model)? } else { rig };
        let rig = self.limited(rig)?;
        let mode = mode_named(&self.mode)?;
        let block = self.plan()?.with_mode(mode).block(&rig);
        let block = match joints {
            [] => block,
            joints => with_joints(block, joints),
        };
        refuse_leaving(&block)?;
        block.check().map_err(|error| refused(model, &error))?;
        HardLimits::default().check(&block).map_err(|error| beyond_limit(model, &error))?;
        Ok(block)
    }

    /// The rig, and the joints that it has; none named means all.
    fn rig(&self, file: &RobotFile) -> Result<(Rig, &[u8]), Failure> {
        match file.is_pendulum().then(|| file.pendulum()).transpose()? {
            None => Ok((Rig::of_file(file)?, &self.joints)),
            Some(pendulum) if pendulum.joint == 3 => Ok((Rig::of_one_joint(file)?, &[3])),
            Some(pendulum) => Err(Failure::new(
                format!(
                    "joint = {} in [pendulum]: the board has a rig of one joint as joint 3",
                    pendulum.joint
                ),
                "wire it to encoder 3 and output C, and write joint = 3 in the model file",
            )),
        }
    }

    fn limited(&self, rig: Rig) -> Result<Rig, Failure> {
        let Some(limit_v) = self.command_limit_v else { return Ok(rig) };
        if !(limit_v > 0.0 && limit_v <= rig.command_limit_v) {
            let largest_v = rig.command_limit_v;
            let message = format!("--command-limit-v {limit_v}: must be above 0 V");
            return Err(Failure::new(message, format!("give {largest_v} V at most")));
        }
        Ok(Rig { command_limit_v: limit_v, ..rig })
    }

    fn plan(&self) -> Result<Plan, Failure> {
        if let Some(path) = &self.excitation {
            let motion = ExcitationFile::read(path)?.motion();
            return Ok(plan::excitation(1, 30.0).with_motion(motion));
        }
        match self.reference.as_str() {
            "hold" => Ok(plan::hold(10.0)),
            "task" => Ok(plan::task(20.0)),
            "excitation" => Ok(plan::excitation(1, 30.0)),
            name => {
                let message = format!("--reference {name}: no such reference");
                Err(Failure::new(message, "take one of hold, task, excitation"))
            }
        }
    }
}
