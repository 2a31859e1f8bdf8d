//! `rrr inverse-dynamics`: torques and voltages that a motion needs.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use model::{BaseParameters, Geometry, Pendulum, Posture};

use crate::failure::Failure;
use files::replace::replace_file;
use files::table::{Kind, Table};
use files::{FileError, Problem, RobotFile};

/// Arguments of `rrr inverse-dynamics`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model: the rigid body of `[base]` or `[pendulum]`, and the torque constants.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// The motions: columns q1_rad.., qd1_rad_per_s.., qdd1_rad_per_s2.. (.csv or .csv.gz).
    #[arg(value_name = "STATES.csv")]
    pub states: PathBuf,
    /// Where the columns tau1_Nm.. and u1_V.. go.
    #[arg(long, value_name = "OUT.csv")]
    pub out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be read or written, named with line and column.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let file = RobotFile::read(&arguments.model)?;
    let body = Body::of(&file)?;
    let motion = Motion::read(arguments, &body.joints())?;
    if !file.effects.is_empty() {
        eprintln!("note: effects of the model are left out: inverse dynamics is rigid body only");
    }
    write(arguments, &body, &motion)?;
    Ok(())
}

/// A rigid body and its torque constants.
struct Body {
    rigid: Rigid,
    torque_constant_nm_per_v: Vec<f64>,
}

enum Rigid {
    Robot(Box<(BaseParameters<f64>, Geometry<f64>)>),
    Pendulum(Pendulum<f64>),
}

impl Body {
    fn of(file: &RobotFile) -> Result<Self, FileError> {
        if file.is_pendulum() {
            let pendulum = file.pendulum()?;
            let constant = file.torque_constant(pendulum.joint)?;
            let rigid = Rigid::Pendulum(pendulum);
            return Ok(Self { rigid, torque_constant_nm_per_v: vec![constant] });
        }
        let (base, geometry) = (file.base_parameters()?, file.geometry()?);
        if let Err(error) = base.check(&geometry) {
            // The torques are well defined all the same.
            eprintln!("warning: no rigid robot has these base parameters: {error}");
        }
        let rigid = Rigid::Robot(Box::new((base, geometry)));
        Ok(Self { rigid, torque_constant_nm_per_v: file.torque_constants()?.to_vec() })
    }

    /// The joints' numbers.
    fn joints(&self) -> Vec<u8> {
        match &self.rigid {
            Rigid::Robot(_) => vec![1, 2, 3],
            Rigid::Pendulum(pendulum) => vec![pendulum.joint],
        }
    }

    /// The torques of a row [Nm], one per joint.
    fn torques_nm(&self, motion: &Motion, row: usize) -> Vec<f64> {
        let of = |columns: &[Vec<f64>], joint: usize| columns[joint][row];
        match &self.rigid {
            Rigid::Pendulum(pendulum) => {
                let q_rad = of(&motion.q_rad, 0);
                vec![pendulum.inverse_dynamics(q_rad, of(&motion.qdd_rad_per_s2, 0))]
            }
            Rigid::Robot(robot) => {
                let (base, geometry) = robot.as_ref();
                let posture = Posture::new(of(&motion.q_rad, 1), of(&motion.q_rad, 2));
                let qd = [0, 1, 2].map(|joint| of(&motion.qd_rad_per_s, joint));
                let qdd = [0, 1, 2].map(|joint| of(&motion.qdd_rad_per_s2, joint));
                posture.inverse_dynamics(base, geometry, &qd, &qdd).to_vec()
            }
        }
    }
}

/// A table of motions, each quantity with one column per joint.
struct Motion {
    rows: usize,
    q_rad: Vec<Vec<f64>>,
    qd_rad_per_s: Vec<Vec<f64>>,
    qdd_rad_per_s2: Vec<Vec<f64>>,
}

impl Motion {
    fn read(arguments: &Arguments, joints: &[u8]) -> Result<Self, FileError> {
        let names = |quantity: &str, unit: &str| -> Vec<String> {
            joints.iter().map(|joint| format!("{quantity}{joint}_{unit}")).collect()
        };
        let [q, qd, qdd] =
            [names("q", "rad"), names("qd", "rad_per_s"), names("qdd", "rad_per_s2")];
        let wanted = |name: &str| [&q, &qd, &qdd].iter().any(|some| some.iter().any(|n| n == name));
        let kind_of = |name: &str| if wanted(name) { Kind::Float } else { Kind::Skipped };
        let mut table = Table::read(&arguments.states, kind_of)?;
        if table.rows() == 0 {
            return Err(Problem::NoSamples.in_file(&arguments.states));
        }
        let mut take = |names: &[String]| -> Result<Vec<Vec<f64>>, FileError> {
            let columns = names.iter().map(|name| table.take_float(name));
            columns.collect::<Result<_, _>>().map_err(|p: Problem| p.in_file(&arguments.states))
        };
        let (q_rad, qd_rad_per_s, qdd_rad_per_s2) = (take(&q)?, take(&qd)?, take(&qdd)?);
        Ok(Self { rows: table.rows(), q_rad, qd_rad_per_s, qdd_rad_per_s2 })
    }
}

fn write(arguments: &Arguments, body: &Body, motion: &Motion) -> Result<(), FileError> {
    replace_file(&arguments.out, |out| {
        let mut put = |line: String| writeln!(out, "{line}").map_err(Problem::Unwritable);
        put(header(&body.joints()))?;
        (0..motion.rows).try_for_each(|row| put(line(body, &body.torques_nm(motion, row))))
    })
}

fn header(joints: &[u8]) -> String {
    let torques = joints.iter().map(|joint| format!("tau{joint}_Nm"));
    let voltages = joints.iter().map(|joint| format!("u{joint}_V"));
    torques.chain(voltages).collect::<Vec<_>>().join(",")
}

/// Torques and voltages with as many digits as the values have.
fn line(body: &Body, torques_nm: &[f64]) -> String {
    let constants = &body.torque_constant_nm_per_v;
    let voltages = torques_nm.iter().zip(constants).map(|(torque, constant)| torque / constant);
    let values = torques_nm.iter().copied().chain(voltages);
    values.map(|value| value.to_string()).collect::<Vec<_>>().join(",")
}
