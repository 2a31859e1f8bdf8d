//! Runs a board around the simulated robot and writes down what happens.

use firmware::ParameterBlock;
use model::Robot;

use super::robot::SimulatedRobot;
use super::sensor::counts;
use super::settings::Settings;
use crate::board::{Board, BoardError};
use files::{JointLog, Log, Position};
use signal::Unwrapper;

/// Records `ticks` of a block's reference on a robot without further effects, at rest where
/// the reference begins; `progress` is called every thousandth tick.
///
/// # Errors
/// The board refuses the block or does not answer.
pub fn record(
    board: &mut dyn Board,
    block: &ParameterBlock,
    robot: &Robot<f64>,
    settings: &Settings,
    ticks: u32,
    progress: &mut dyn FnMut(u32),
) -> Result<Recording, BoardError> {
    let robot = SimulatedRobot::at_rest(*robot, start_of(block), settings);
    record_robot(board, block, robot, ticks, progress)
}

/// [`record`] with a robot of one's own, which must be where the reference begins.
///
/// # Errors
/// The board refuses the block or does not answer.
pub fn record_robot(
    board: &mut dyn Board,
    block: &ParameterBlock,
    mut robot: SimulatedRobot,
    ticks: u32,
    progress: &mut dyn FnMut(u32),
) -> Result<Recording, BoardError> {
    record_sampled(board, block, &mut robot, ticks, &mut SimulatedRobot::reading_rad, progress)
}

/// [`record_robot`] with encoders of one's own: `sample` gives the angles [rad] that they read
/// of the robot at a tick. The robot stays where the record ends.
///
/// # Errors
/// The board refuses the block or does not answer.
pub fn record_sampled(
    board: &mut dyn Board,
    block: &ParameterBlock,
    robot: &mut SimulatedRobot,
    ticks: u32,
    sample: &mut dyn FnMut(&SimulatedRobot) -> [f64; 3],
    progress: &mut dyn FnMut(u32),
) -> Result<Recording, BoardError> {
    board.load(block)?;
    board.start()?;
    let period_s = f64::from(block.sample_period_s);
    let mut recording = Recording::with_capacity(period_s, *robot.q_rad(), ticks);
    for tick in 0..ticks {
        let counts = counts(&sample(robot), block.encoder_counts_per_turn);
        let reply = board.tick(&counts.map(|count| count as i32))?;
        let command_v = reply.codes.map(|code| f64::from(code.to_volts()));
        recording.push(&counts, &command_v, &reply);
        robot.advance(&command_v);
        if tick % 1000 == 0 {
            progress(tick);
        }
    }
    Ok(recording)
}

/// Where the reference begins [rad], on the turn that its own numbers name.
pub fn start_of(block: &ParameterBlock) -> [f64; 3] {
    use firmware::reference::Time;
    let first = Time::new(0, block.sample_period_s, 1.0 / block.sample_period_s);
    [0, 1, 2].map(|i| {
        let motion = &block.reference.motion[i];
        let setpoint = motion.at(first).earlier(0.5 * block.sample_period_s);
        Unwrapper::near(setpoint.angle.0, centre_of(motion)).update(setpoint.angle.0)
    })
}

/// The angle about which a motion begins [rad].
fn centre_of(motion: &firmware::reference::Motion) -> f64 {
    use firmware::reference::Motion;
    f64::from(match motion {
        Motion::Hold { angle_rad } => *angle_rad,
        Motion::Quintic { from_rad, .. } => *from_rad,
        Motion::Sine(sine) => sine.centre_rad,
        Motion::Fourier(series) => series.centre_rad,
        Motion::ConstantVelocity(legs) => legs.start_rad,
    })
}

/// A log being recorded, and what only a board measures.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The log as FORMATS describes it.
    pub log: Log,
    /// Counts of the board's timer that each tick took; zero where it has none.
    pub timer_counts: Vec<u32>,
    period_s: f64,
    start_rad: [f64; 3],
    references: Option<[Unwrapper; 3]>,
}

impl Recording {
    fn with_capacity(period_s: f64, start_rad: [f64; 3], ticks: u32) -> Self {
        let ticks = ticks as usize;
        let joint = |joint| JointLog {
            joint,
            position: Position::Count(Vec::with_capacity(ticks)),
            command_v: Vec::with_capacity(ticks),
            reference_rad: Some(Vec::with_capacity(ticks)),
        };
        Self {
            log: Log { time_s: Vec::with_capacity(ticks), joints: (1..=3).map(joint).collect() },
            timer_counts: Vec::with_capacity(ticks),
            period_s,
            start_rad,
            references: None,
        }
    }

    /// Instructions that a tick took on average: 25.6 counts of the timer of QEMU's
    /// board are one. Zero where nothing was counted.
    pub fn instructions_per_tick(&self) -> f64 {
        const COUNTS_PER_INSTRUCTION: f64 = 25.6;
        let counts: f64 = self.timer_counts.iter().map(|&c| f64::from(c)).sum();
        counts / COUNTS_PER_INSTRUCTION / self.timer_counts.len().max(1) as f64
    }

    fn push(&mut self, counts: &[i64; 3], command_v: &[f64; 3], reply: &firmware::lockstep::Reply) {
        let start_rad = self.start_rad;
        let references = self.references.get_or_insert_with(|| {
            [0, 1, 2].map(|i| Unwrapper::near(reply.reference[i].0, start_rad[i]))
        });
        self.log.time_s.push(self.log.time_s.len() as f64 * self.period_s);
        for (i, joint) in self.log.joints.iter_mut().enumerate() {
            if let Position::Count(column) = &mut joint.position {
                column.push(counts[i]);
            }
            joint.command_v.push(command_v[i]);
            if let Some(column) = &mut joint.reference_rad {
                column.push(references[i].update(reply.reference[i].0));
            }
        }
        self.timer_counts.push(reply.timer_counts);
    }
}
