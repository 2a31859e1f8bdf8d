//! `cargo xtask emulate`: the image's serial line at a TCP port.

use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::rc::Rc;
use std::sync::atomic::AtomicBool;

use clap::Parser;
use emulator::image::Image;
use emulator::machine::Machine;
use emulator::tcp_line::{TcpLine, serve};
use files::RobotFile;
use model::reference_robot::reference_robot;
use rig::Rig;
use rig::effects::{Catalogue, Effect, table_from_text};
use simulation::arm::{ArmSettings, SimulatedArm};

/// Executes the firmware's image for the NUCLEO-G474RE at a simulated arm, until Ctrl-C.
#[derive(Debug, Parser)]
struct Arguments {
    /// The image, as `cargo xtask firmware nucleo` builds it.
    #[arg(long, value_name = "ELF")]
    image: PathBuf,
    /// The TCP port of this machine at which the board's serial line is.
    #[arg(long, default_value_t = 5555)]
    tcp: u16,
    /// The robot at the board; without it the reference robot.
    #[arg(long, value_name = "MODEL.toml")]
    model: Option<PathBuf>,
    /// An effect that its model does not have, as `rrr simulate-board` takes it; several times.
    #[arg(long)]
    effect: Vec<String>,
    /// Seconds of the board in a second of this machine, as far as it keeps up.
    #[arg(long, default_value_t = 1.0)]
    speed: f64,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("emulator: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn std::error::Error>> {
    if !(0.001..=1000.0).contains(&arguments.speed) {
        return Err(format!("--speed {}: give 0.001 to 1000", arguments.speed).into());
    }
    let image = Rc::new(Image::read(&arguments.image)?);
    let mut settings = ArmSettings::new(reference_robot());
    let mut effects = Vec::new();
    if let Some(path) = &arguments.model {
        let (rig, in_file) = read(path)?;
        settings = ArmSettings::new(rig.model);
        settings.counts_per_turn = rig.encoder_counts_per_turn;
        effects = in_file;
    }
    settings.incremental_encoders = true;
    for text in &arguments.effect {
        let effect = table_from_text(text).and_then(|t| Catalogue::standard().effect_of(&t));
        effects.push(effect.map_err(|error| format!("--effect {text}: {error}"))?);
    }
    let arm = SimulatedArm::new(&settings, effects);
    let mut machine = Machine::new(image, Box::new(arm))?;
    let mut line = TcpLine::open((Ipv4Addr::LOCALHOST, arguments.tcp).into())
        .map_err(|error| format!("--tcp {}: {error}; name another port", arguments.tcp))?;
    println!("the image's line is at --port tcp:{}; Ctrl-C ends it", line.address()?);
    println!("each joint is turned by hand in the first second; `rrr home --at 0,-1.5708,0` then");
    Ok(serve(&mut machine, &mut line, arguments.speed, &AtomicBool::new(false))?)
}

type Robot = (Rig, Vec<Box<dyn Effect>>);

fn read(path: &Path) -> Result<Robot, Box<dyn std::error::Error>> {
    let file = RobotFile::read(path)?;
    let rig = if file.is_pendulum() { Rig::of_one_joint(&file)? } else { Rig::of_file(&file)? };
    let effect = |table| Catalogue::standard().effect_of(table);
    let effects: Result<_, _> = file.effects.iter().map(effect).collect();
    Ok((rig, effects.map_err(|error| format!("{}: [[effect]]: {error}", path.display()))?))
}
