//! `rrr demo`: experiments, identification, the identified model at work in QEMU, and the
//! diagnosis of a robot that has changed since.

mod changed;

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use firmware::Mode;
use model::reference_robot::reference_robot;
use serde_json::json;

use super::{identify, simulate};
use crate::failure::Failure;
use crate::options::number::duration_s;
use crate::output_files::create_directory;
use crate::say;
use crate::terminal::answer::{answer, is_part};
use crate::terminal::progress::Progress;
use files::{EffectTable, RobotFile};
use recordings::tracking::Tracking;
use report::tracking_page::{Run, error_charts, tracking_page};
use rig::Rig;
use rig::effects::Catalogue;
use rig::plan::task;
use simulation::board::{Qemu, QemuSettings};
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

/// Arguments of `rrr demo`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The firmware's image for QEMU's mps2-an386.
    #[arg(long, value_name = "ELF")]
    pub firmware: PathBuf,
    /// Directory for index.html, the campaign and the model.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Length of each run [s].
    #[arg(long, default_value_t = 20.0, value_parser = duration_s)]
    pub duration_s: f32,
}

/// Runs the demonstration.
///
/// # Errors
/// QEMU or the firmware does not work, or a file cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    create_directory(&arguments.out)?;
    is_part(true);
    say!("1. The firmware in QEMU plays the experiments to a robot that it does not know.");
    let robot = arguments.write_robot()?;
    simulate::run(&arguments.campaign(&robot))?;
    say!("\n2. The logs give the model.");
    identify::run_whole(&arguments.identification())?;
    let model = RobotFile::read(arguments.out.join("model.toml"))?.robot()?;
    say!("\n3. The model goes into the firmware, which plays the motion (20)-(21).");
    let rig = Rig::new(model);
    let plain = arguments.drive(&rig, Mode::Pd, "PD alone", &[])?;
    let modelled = arguments.drive(&rig, Mode::PdModel, "PD with the model", &[])?;
    print_table(&plain, &modelled);
    let diagnosed = arguments.diagnosed(&rig)?;
    let path = arguments.out.join("index.html");
    tracking_page(&plain, &modelled, &diagnosed).write(&path)?;
    error_charts(&plain, &modelled)[1].write_svg(&arguments.out.join("tracking.svg"))?;
    say!("\nPictures: {}", path.display());
    is_part(false);
    answer(&json!({ "page": path }))
}

impl Arguments {
    /// Writes the true robot, which only the simulation knows, and the manufacturer's data.
    fn write_robot(&self) -> Result<PathBuf, Failure> {
        let rig = Rig::new(reference_robot());
        let mut file = RobotFile::from_robot(&rig.model);
        file.robot.encoder_counts_per_rev = Some(f64::from(rig.encoder_counts_per_turn));
        file.robot.sample_period_s = Some(rig.sample_period_s);
        file.robot.command_limit_v = Some(rig.command_limit_v);
        file.robot.command_bits = Some(16);
        let truth = self.out.join("true-robot.toml");
        file.write(&truth)?;
        file.base = None;
        file.friction.clear();
        file.write(self.out.join("robot.toml"))?;
        Ok(truth)
    }

    fn campaign(&self, robot: &Path) -> simulate::Arguments {
        simulate::Arguments {
            qemu: Some(self.firmware.clone()),
            ..simulate::Arguments::new(robot, "campaign", &self.out.join("campaign"))
        }
    }

    fn identification(&self) -> identify::Whole {
        identify::Whole {
            dataset: self.out.join("campaign"),
            robot: self.out.join("robot.toml"),
            out: self.out.join("model.toml"),
        }
    }

    /// Records the motion (20)-(21) with QEMU in the loop, on the true robot with effects.
    fn drive(
        &self,
        rig: &Rig,
        mode: Mode,
        name: &'static str,
        effects: &[EffectTable],
    ) -> Result<Run, Failure> {
        let plan = task(self.duration_s).with_mode(mode);
        let (ticks, block) = (plan.ticks(rig), plan.block(rig));
        let effects: Result<Vec<_>, _> =
            effects.iter().map(|table| Catalogue::standard().effect_of(table)).collect();
        let effects = effects.map_err(|error| Failure::new(error.to_string(), ""))?;
        let start = start_of(&block);
        let robot =
            SimulatedRobot::with_effects(reference_robot(), effects, start, &Settings::default());
        let mut board = Qemu::start(&QemuSettings::new(&self.firmware))?;
        let progress = Progress::new(name, u64::from(ticks));
        let started = Instant::now();
        let recording = record_robot(&mut board, &block, robot, ticks, &mut |tick| {
            progress.at(u64::from(tick));
        })?;
        let elapsed_s = started.elapsed().as_secs_f64();
        progress.finish();
        let counts_per_turn = f64::from(rig.encoder_counts_per_turn);
        Ok(Run {
            name,
            tracking: Tracking::of(&recording.log, counts_per_turn),
            speed: f64::from(ticks) * rig.sample_period_s / elapsed_s,
            instructions_per_tick: recording.instructions_per_tick(),
            log: recording.log,
        })
    }
}

fn print_table(first: &Run, second: &Run) {
    say!("Motion (20)-(21), firmware in QEMU around the simulated robot\n");
    say!("  joint   rms tracking error [mrad]                 ratio");
    say!("          {:>17}   {:>17}", first.name, second.name);
    for (without, with) in first.tracking.iter().zip(&second.tracking) {
        let (without_mrad, with_mrad) = (1e3 * without.rms_rad(), 1e3 * with.rms_rad());
        say!(
            "  {}       {without_mrad:17.3}   {with_mrad:17.4}   {:8.0}",
            without.joint,
            without_mrad / with_mrad
        );
    }
    say!(
        "\n  a tick takes {:.0} instructions; the loop ran {:.0} times as fast as real time",
        second.instructions_per_tick,
        second.speed
    );
}
