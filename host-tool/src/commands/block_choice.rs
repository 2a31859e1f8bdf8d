//! The parameter block that a command makes of a model file, and its options.

use std::path::{Path, PathBuf};

use clap::Args;
use firmware::ParameterBlock;

use super::{Failure, simulate};
use crate::files::ExcitationFile;
use crate::simulation::{Plan, Rig, plan};

/// What the board is to do with the model.
#[derive(Clone, Debug, Args)]
pub struct BlockChoice {
    /// What the commands are made of: pd, pd-friction, pd-model, friction-only or open-loop.
    #[arg(long, default_value = "pd-model")]
    pub mode: String,
    /// What the board plays: hold (hanging down, 10 s), task (20 s) or excitation (30 s).
    #[arg(long, default_value = "hold", value_name = "NAME")]
    pub reference: String,
    /// Play this motion, as `rrr design-excitation` writes it; 30 s.
    #[arg(long, value_name = "EXCITATION.toml", conflicts_with = "reference")]
    pub excitation: Option<PathBuf>,
    /// The board makes up for the effects that the model file holds, as far as it can.
    #[arg(long)]
    pub compensate: bool,
    /// Cut commands at this voltage, which must be below the model file's.
    #[arg(long, value_name = "VOLTS")]
    pub command_limit_v: Option<f64>,
}

impl BlockChoice {
    /// The block for a model file, checked as the board checks it.
    ///
    /// # Errors
    /// A file that cannot be used, an unknown name, or a value that the board refuses.
    pub fn block(&self, model: &Path) -> Result<ParameterBlock, Failure> {
        let mut arguments = simulate::Arguments::new(model, "", Path::new(""));
        arguments.compensate = self.compensate;
        let rig = self.limited(arguments.rig()?)?;
        let mode = simulate::mode_named(&self.mode)?;
        let block = self.plan()?.with_mode(mode).block(&rig);
        block.check().map_err(|error| {
            let message = format!("{}: the board refuses it: {error}", model.display());
            Failure::new(message, "correct the value in the model file")
        })?;
        Ok(block)
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
