//! `rrr simulate`: experiments of the simulated robot, recorded as if it were real.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use firmware::Mode;

use super::arm_simulation::ArmSimulation;
use super::simulate_arm;
use crate::failure::Failure;
use crate::options::compensation::compensated;
use crate::options::effects;
use crate::options::mode::mode_named;
use crate::options::number::noise_v;
use crate::output_files::create_directory;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Progress;
use files::log::unix_ns;
use files::{ArmFile, Dataset, Entry, ExcitationFile, Experiment, McapDetails, RobotFile, Role};
use rig::effects::Effect;
use rig::{Plan, Recipe, Rig};
use serde_json::json;
use simulation::board::{Board, InProcess, Qemu, QemuSettings};
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

/// Arguments of `rrr simulate`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The robot to simulate, which the board also takes for its model.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// What to record: campaign, gap, task, excitation or friction.
    #[arg(long, value_name = "NAME")]
    pub dataset: String,
    /// Directory for dataset.toml and the logs.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Play this motion, as `rrr design-excitation` writes it, for the excitation.
    #[arg(long, value_name = "EXCITATION.toml")]
    pub excitation: Option<PathBuf>,
    /// The control mode, instead of the data set's own:
    /// pd, pd-friction, pd-model, friction-only or open-loop.
    #[arg(long)]
    pub mode: Option<String>,
    /// How the logs are written.
    #[arg(long, value_enum, default_value_t = Format::CsvGz)]
    pub format: Format,
    /// Run the firmware's image in QEMU instead of in this process.
    #[arg(long, value_name = "ELF")]
    pub qemu: Option<PathBuf>,
    /// An effect of the robot that its model does not have, such as
    /// cogging:3:amplitude_V=0.1,harmonic=8,phase_rad=0; may be given several times.
    #[arg(long, value_name = "EFFECT:JOINT:NAME=VALUE,...")]
    pub effect: Vec<String>,
    /// The board compensates for the effects in the model file, as far as it can, in the
    /// modes that use the model; not for those of --effect.
    #[arg(long)]
    pub compensate: bool,
    /// Seed of all noises.
    #[arg(long, default_value_t = 1)]
    pub seed: u32,
    /// Amplifier noise [V rms].
    #[arg(long, default_value_t = 0.004, value_parser = noise_v)]
    pub noise_v: f64,
    /// Integration steps per tick.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub substeps: u32,
}

/// A log's format.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Format {
    /// Compressed text.
    CsvGz,
    /// Text.
    Csv,
    /// For Foxglove.
    Mcap,
}

impl Format {
    fn extension(self) -> &'static str {
        match self {
            Self::CsvGz => "csv.gz",
            Self::Csv => "csv",
            Self::Mcap => "mcap",
        }
    }
}

/// Runs the command.
///
/// # Errors
/// An unknown name, a model that cannot be used, a board that does not answer, or a
/// directory that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    if ArmFile::is_at(&arguments.model) {
        return simulate_arm::run(&arguments.of_arm());
    }
    let rig = arguments.rig()?;
    let plans = arguments.plans(&rig)?;
    arguments.effects()?;
    let entries = arguments.entries(&plans);
    let names: Vec<String> = entries.iter().map(|entry| entry.file.clone()).collect();
    Dataset::check_room(&arguments.out, &names)?;
    create_directory(&arguments.out)?;
    let mut board = arguments.board()?;
    for (index, plan) in plans.iter().enumerate() {
        arguments.record(&mut *board, &rig, plan, index as u32)?;
    }
    let dataset = Dataset {
        directory: arguments.out.clone(),
        encoder_counts_per_rev: Some(f64::from(rig.encoder_counts_per_turn)),
        entries,
    };
    dataset.write_simulated(&arguments.out)?;
    say!("{} logs in {}", plans.len(), arguments.out.display());
    answer(&json!({ "dataset": arguments.out, "logs": names }))
}

impl Arguments {
    /// A data set recorded in this process, as it is by default.
    pub fn new(model: &Path, dataset: &str, out: &Path) -> Self {
        Self {
            model: model.to_owned(),
            dataset: dataset.to_owned(),
            out: out.to_owned(),
            excitation: None,
            mode: None,
            format: Format::CsvGz,
            qemu: None,
            effect: Vec::new(),
            compensate: false,
            seed: 1,
            noise_v: 0.004,
            substeps: 10,
        }
    }

    /// The list's entries for plans.
    fn entries(&self, plans: &[Plan]) -> Vec<Entry> {
        plans.iter().map(|plan| plan.entry(self.format.extension())).collect()
    }

    /// What is to be simulated of an arm of any kind.
    fn of_arm(&self) -> ArmSimulation<'_> {
        let of_board = [
            ("--excitation", self.excitation.is_some()),
            ("--mode", self.mode.is_some()),
            ("--qemu", self.qemu.is_some()),
            ("--compensate", self.compensate),
        ];
        ArmSimulation {
            model: &self.model,
            dataset: &self.dataset,
            out: &self.out,
            effects: &self.effect,
            seed: self.seed,
            of_board: of_board.iter().find(|(_, given)| *given).map(|(name, _)| *name),
        }
    }

    /// The rig of the model file, with compensations if they are wanted.
    pub(super) fn rig(&self) -> Result<Rig, Failure> {
        let file = RobotFile::read(&self.model)?;
        let rig = Rig::of_file(&file)?;
        if self.compensate { compensated(rig, &file, &self.model) } else { Ok(rig) }
    }

    fn plans(&self, rig: &Rig) -> Result<Vec<Plan>, Failure> {
        let recipe = Recipe::by_name(&self.dataset).ok_or_else(|| {
            let known: Vec<String> =
                Recipe::ALL.iter().map(|r| format!("{} ({})", r.name, r.purpose)).collect();
            let message = format!("--dataset {}: no such data set", self.dataset);
            Failure::new(message, format!("take one of {}", known.join(", ")))
        })?;
        let plans = self.with_excitation(recipe.plans(rig, self.seed))?;
        match self.mode()? {
            Some(mode) => Ok(plans.into_iter().map(|plan| plan.with_mode(mode)).collect()),
            None => Ok(plans),
        }
    }

    /// The plans with the given motion in place of the train log's excitation.
    fn with_excitation(&self, mut plans: Vec<Plan>) -> Result<Vec<Plan>, Failure> {
        let Some(path) = &self.excitation else { return Ok(plans) };
        let motion = ExcitationFile::read(path)?.motion();
        let is_excitation =
            |plan: &Plan| plan.experiment == Experiment::Excitation && plan.role == Role::Train;
        let Some(index) = plans.iter().position(is_excitation) else {
            let message = format!("--excitation: the data set {} has no excitation", self.dataset);
            return Err(Failure::new(message, "take --dataset excitation, campaign or gap"));
        };
        plans[index] = plans[index].clone().with_motion(motion);
        Ok(plans)
    }

    fn mode(&self) -> Result<Option<Mode>, Failure> {
        self.mode.as_deref().map(mode_named).transpose()
    }

    /// The effects of the model file and those of the command line.
    fn effects(&self) -> Result<Vec<Box<dyn Effect>>, Failure> {
        let mut all = effects::of_file(&RobotFile::read(&self.model)?.effects, &self.model)?;
        all.extend(effects::of_options(&self.effect)?);
        Ok(all)
    }

    fn board(&self) -> Result<Box<dyn Board>, Failure> {
        match &self.qemu {
            Some(image) => Ok(Box::new(Qemu::start(&QemuSettings::new(image))?)),
            None => Ok(Box::new(InProcess::default())),
        }
    }

    /// Records a plan and writes its log.
    fn record(
        &self,
        board: &mut dyn Board,
        rig: &Rig,
        plan: &Plan,
        index: u32,
    ) -> Result<(), Failure> {
        let ticks = plan.ticks(rig);
        let settings = Settings {
            sample_period_s: rig.sample_period_s,
            substeps: self.substeps,
            noise_v: self.noise_v,
            seed: u64::from(self.seed) << 32 | u64::from(index),
        };
        let progress = Progress::new(&plan.name, u64::from(ticks));
        let block = plan.block(rig);
        let robot =
            SimulatedRobot::with_effects(rig.model, self.effects()?, start_of(&block), &settings);
        let recording = record_robot(board, &block, robot, ticks, &mut |tick| {
            progress.at(u64::from(tick));
        })?;
        progress.finish();
        let entry = plan.entry(self.format.extension());
        let details = McapDetails {
            counts_per_rev: Some(f64::from(rig.encoder_counts_per_turn)),
            began_unix_ns: unix_ns(),
            board: &[],
        };
        recording.log.write_with(self.out.join(entry.file), &details)?;
        Ok(())
    }
}
