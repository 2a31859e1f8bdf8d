//! `rrr simulate-board`: a board at a simulated robot, to practise on without hardware.

use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::Args;
use serde_json::json;

use crate::failure::Failure;
use crate::options::effects;
use crate::options::number::noise_v;
use crate::output_files::write_bytes;
use crate::terminal::answer::answer;
use crate::terminal::interrupt::interrupt;
use crate::terminal::output::print_line;
use files::RobotFile;
use model::reference_robot::reference_robot;
use rig::Rig;
use rig::effects::Effect;
use simulation::arm::ArmSettings;
use simulation::simulated_board::{BoardSettings, SimulatedBoard, erased_flash};

/// How often Ctrl-C is looked for.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// Arguments of `rrr simulate-board`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The TCP port of this machine at which the board's line is; 0 for one that is free.
    #[arg(long, value_name = "PORT", default_value_t = 5555)]
    pub tcp: u16,
    /// The robot at the board, of three joints or a [pendulum], with the effects that the file
    /// lists; without it the reference robot.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: Option<PathBuf>,
    /// An effect of the robot that its model does not have, such as
    /// cogging:3:amplitude_V=0.1,harmonic=8,phase_rad=0; may be given several times.
    #[arg(long, value_name = "EFFECT:JOINT:NAME=VALUE,...")]
    pub effect: Vec<String>,
    /// Seconds of the board in a second of this machine, 0.01 to 100, as far as it keeps up;
    /// `rrr run` then wants a longer --host-timeout-ms.
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = speed)]
    pub speed: f64,
    /// The encoders count from zero at power-on, as those of the NUCLEO board do, and in the
    /// second after it somebody turns each joint by hand, and back.
    #[arg(long)]
    pub incremental_encoders: bool,
    /// Where the board's flash is kept from one power-on to the next; without it, it is new.
    #[arg(long, value_name = "FILE")]
    pub flash: Option<PathBuf>,
    /// Amplifier noise [V rms].
    #[arg(long, default_value_t = 0.004, value_parser = noise_v)]
    pub noise_v: f64,
    /// Seed of the noise.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

fn speed(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(factor) if (0.01..=100.0).contains(&factor) => Ok(factor),
        _ => Err("must be a number from 0.01 to 100".to_owned()),
    }
}

/// Runs the command, until Ctrl-C.
///
/// # Errors
/// A model or an effect that cannot be used, a port that is taken, or a file for the flash that
/// cannot be read or written.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let interrupted = interrupt();
    let (arm, effects) = arguments.arm()?;
    let settings = BoardSettings {
        speed: arguments.speed,
        flash: arguments.flash.as_deref().map_or_else(|| Ok(erased_flash()), flash_of)?,
        address: (Ipv4Addr::LOCALHOST, arguments.tcp).into(),
        ..BoardSettings::new(arm.robot)
    };
    let board = SimulatedBoard::start_with_effects(BoardSettings { arm, ..settings }, effects)
        .map_err(|error| port_taken(arguments.tcp, &error))?;
    print_line(format_args!("a simulated board is at --port {}; Ctrl-C ends it", board.port()))?;
    answer(&json!({ "port": board.port() }))?;
    wait_for(interrupted);
    let flash = board.switch_off();
    arguments.flash.as_deref().map_or(Ok(()), |path| write_bytes(&flash, path))
}

fn wait_for(interrupted: &AtomicBool) {
    while !interrupted.load(Ordering::Relaxed) {
        std::thread::sleep(LOOK_EVERY);
    }
}

impl Arguments {
    /// The arm, and what it has beyond its model.
    fn arm(&self) -> Result<(ArmSettings, Vec<Box<dyn Effect>>), Failure> {
        let mut effects = Vec::new();
        let mut arm = ArmSettings::new(reference_robot());
        if let Some(path) = &self.model {
            let file = RobotFile::read(path)?;
            let rig = rig_of(&file)?;
            arm = ArmSettings::new(rig.model);
            arm.counts_per_turn = rig.encoder_counts_per_turn;
            effects = effects::of_file(&file.effects, path)?;
        }
        effects.extend(effects::of_options(&self.effect)?);
        arm.incremental_encoders = self.incremental_encoders;
        (arm.noise_v, arm.seed) = (self.noise_v, self.seed);
        Ok((arm, effects))
    }
}

fn rig_of(file: &RobotFile) -> Result<Rig, Failure> {
    Ok(if file.is_pendulum() { Rig::of_one_joint(file)? } else { Rig::of_file(file)? })
}

/// The flash in a file, or a new one where there is no file yet.
fn flash_of(path: &Path) -> Result<Vec<u8>, Failure> {
    let (new, bytes) = (erased_flash(), std::fs::read(path));
    match bytes {
        Ok(bytes) if bytes.len() == new.len() => Ok(bytes),
        Ok(bytes) => Err(Failure::new(
            format!("{}: {} bytes are no flash of this board", path.display(), bytes.len()),
            format!("name a file of {} bytes, or one that is not there yet", new.len()),
        )),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(new),
        Err(error) => Err(Failure::new(
            format!("{}: cannot be read: {error}", path.display()),
            "name another file for --flash",
        )),
    }
}

fn port_taken(port: u16, error: &std::io::Error) -> Failure {
    Failure::new(
        format!("--tcp {port}: {error}"),
        "end the program that has the port, or name another one; 0 takes one that is free",
    )
}
