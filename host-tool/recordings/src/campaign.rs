//! The recorded experiments of a rig, in radians and volts.

use model::Geometry;

use files::mapping::told;
use files::{Dataset, Entry, Experiment, FileError, Log, Recording, RobotFile, Role};

/// A log in radians and volts.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The log's file name, for messages.
    pub file: String,
    /// What was done.
    pub experiment: Experiment,
    /// What the log is for.
    pub role: Role,
    /// The joint, 1 to 3, of an experiment on one joint.
    pub joint: Option<u8>,
    /// Typical time between samples [s].
    pub period_s: f64,
    /// Times [s].
    pub time_s: Vec<f64>,
    /// What each joint in the log did, in the order of their numbers.
    pub joints: Vec<JointTrace>,
}

/// One joint's columns.
#[derive(Clone, Debug, PartialEq)]
pub struct JointTrace {
    /// Joint, 1 to 3.
    pub number: u8,
    /// Measured angle [rad].
    pub q_rad: Vec<f64>,
    /// Commanded voltage over the interval that begins at the sample [V].
    pub command_v: Vec<f64>,
    /// Reference [rad], where there is one.
    pub reference_rad: Option<Vec<f64>>,
}

impl Trace {
    /// A recording in radians.
    pub fn of(recording: Recording) -> Self {
        let counts_per_rev = recording.counts_per_rev();
        Self::of_log(recording.log, recording.entry, counts_per_rev)
    }

    /// A log in radians; counts per turn are not used where it is in radians already.
    pub fn of_log(log: Log, entry: Entry, counts_per_rev: f64) -> Self {
        let joints = log.joints.iter().map(|joint| JointTrace {
            number: joint.joint,
            q_rad: joint.position_rad(counts_per_rev),
            command_v: joint.command_v.clone(),
            reference_rad: joint.reference_rad.clone(),
        });
        Self {
            joints: joints.collect(),
            file: entry.file,
            experiment: entry.experiment,
            role: entry.role,
            joint: entry.joint,
            period_s: log.sample_period_s().unwrap_or(f64::NAN),
            time_s: log.time_s,
        }
    }

    /// A joint's columns, 1 to 3.
    pub fn joint(&self, number: u8) -> Option<&JointTrace> {
        self.joints.iter().find(|joint| joint.number == number)
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }
}

/// What is known before identification: the manufacturer's numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Lengths and gravity; `None` for a rig of one joint.
    pub geometry: Option<Geometry<f64>>,
    /// Gravity [m/s^2].
    pub gravity_m_s2: f64,
    /// Torque constants of the joints in `joints` [Nm/V].
    pub torque_constant_nm_per_v: Vec<f64>,
    /// The joints of the rig, 1 to 3.
    pub joints: Vec<u8>,
    /// Encoder step [rad].
    pub encoder_step_rad: f64,
    /// Largest command [V].
    pub command_limit_v: f64,
    /// Step of the command [V].
    pub command_step_v: f64,
}

impl Known {
    /// The torque constant of a joint, 1 to 3 [Nm/V].
    pub fn torque_constant(&self, joint: u8) -> f64 {
        let index = self.joints.iter().position(|&number| number == joint);
        index.map_or(f64::NAN, |index| self.torque_constant_nm_per_v[index])
    }
}

/// A whole campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Campaign {
    /// The manufacturer's numbers.
    pub known: Known,
    /// The robot file they stand in.
    pub robot_file: RobotFile,
    /// All logs.
    pub traces: Vec<Trace>,
    /// What was done to logs of foreign files that their user should know.
    pub notes: Vec<String>,
}

impl Campaign {
    /// Reads the robot file's numbers and all logs of a data set.
    ///
    /// # Errors
    /// A file that cannot be used.
    pub fn read(dataset: &Dataset, robot_file: RobotFile) -> Result<Self, FileError> {
        let recordings = dataset.recordings()?;
        let of_logs = recordings.iter().map(|r| (r.entry.file.as_str(), r.notes.as_slice()));
        let notes = told(of_logs);
        let traces = recordings.into_iter().map(Trace::of).collect();
        let counts = robot_file.robot.encoder_counts_per_rev.or(dataset.encoder_counts_per_rev);
        Ok(Self { notes, ..Self::new(robot_file, counts, traces)? })
    }

    /// A campaign of logs that are at hand; encoder counts per turn where they are known.
    ///
    /// # Errors
    /// The robot file lacks what the manufacturer must tell.
    pub fn new(
        robot_file: RobotFile,
        encoder_counts_per_rev: Option<f64>,
        traces: Vec<Trace>,
    ) -> Result<Self, FileError> {
        let known = known(&robot_file, encoder_counts_per_rev)?;
        Ok(Self { known, robot_file, traces, notes: Vec::new() })
    }

    /// The logs of an experiment, of one role, on a joint where one is named.
    pub fn traces_of(
        &self,
        experiment: Experiment,
        role: Role,
        joint: Option<u8>,
    ) -> impl Iterator<Item = &Trace> {
        self.traces.iter().filter(move |trace| {
            trace.experiment == experiment
                && trace.role == role
                && (joint.is_none() || trace.joint == joint)
        })
    }
}

fn known(file: &RobotFile, counts_per_rev: Option<f64>) -> Result<Known, FileError> {
    let joints: Vec<u8> = match &file.pendulum {
        Some(pendulum) if file.base.is_none() => vec![pendulum.joint],
        _ => vec![1, 2, 3],
    };
    let one_joint = joints.len() == 1;
    let constants: Result<Vec<f64>, FileError> =
        joints.iter().map(|&joint| file.torque_constant(joint)).collect();
    let limit_v = file.robot.command_limit_v.unwrap_or(f64::INFINITY);
    let steps = file.robot.command_bits.map_or(f64::INFINITY, |bits| 2f64.powi(bits as i32));
    Ok(Known {
        geometry: if one_joint { None } else { Some(file.geometry()?) },
        gravity_m_s2: file.robot.gravity_m_s2.unwrap_or(9.81),
        torque_constant_nm_per_v: constants?,
        joints,
        encoder_step_rad: counts_per_rev.map_or(0.0, |counts| std::f64::consts::TAU / counts),
        command_limit_v: limit_v,
        command_step_v: if steps.is_finite() { 2.0 * limit_v / steps } else { 0.0 },
    })
}
