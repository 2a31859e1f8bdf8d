//! `rrr inverse-dynamics`: torques and commands that a motion needs.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use files::log::check_joints;
use files::replace::replace_file;
use files::table::{Kind, Table};
use files::{FileError, Problem};
use serde_json::json;

use crate::failure::Failure;
use crate::terminal::answer::answer;

pub mod body;
mod friction;
pub mod joint;

use body::Body;
use joint::JointColumns;

/// Arguments of `rrr inverse-dynamics`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model: a rigid body and the torque constants, of format 1 or 2.
    #[arg(long, value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// The motions: columns q1_rad.., qd1_rad_per_s.., qdd1_rad_per_s2.., with m for rad where a
    /// joint is prismatic (.csv or .csv.gz).
    #[arg(value_name = "STATES.csv")]
    pub states: PathBuf,
    /// Where the columns go: tau1_Nm.. (tau1_N..) and u1_V.. (u1_A..) = tau / k_t, of the rigid body with
    /// its rotors alone; where the model tells friction, friction1_V.. at that velocity and load, and
    /// needed1_V.., the sum of both: what the drive must put out.
    #[arg(long, value_name = "OUT.csv")]
    pub out: PathBuf,
}

/// Runs the command.
///
/// # Errors
/// A file that cannot be read or written, named with line and column.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let body = Body::read(&arguments.model)?;
    let motion = Motion::read(arguments, &body)?;
    write(arguments, &body, &motion)?;
    answer(&json!({ "out": arguments.out, "samples": motion.rows, "joints": body.joints.len() }))
}

/// A table of motions, each quantity with one column per joint.
struct Motion {
    rows: usize,
    /// Positions, velocities, accelerations.
    columns: [Vec<Vec<f64>>; 3],
}

impl Motion {
    fn read(arguments: &Arguments, body: &Body) -> Result<Self, FileError> {
        let joints = &body.joints;
        let names = [0, 1, 2].map(|order| -> Vec<String> {
            joints.iter().map(|joint| joint.motion()[order].clone()).collect()
        });
        let wanted = |name: &str| names.iter().flatten().any(|wanted| wanted == name);
        let kind_of = |name: &str| if wanted(name) { Kind::Float } else { Kind::Skipped };
        let mut table = Table::read(&arguments.states, kind_of)?;
        let last = body.last_joint();
        check_joints(table.names(), last, &format!("the model ends with joint {last}"))
            .map_err(|problem| problem.in_file(&arguments.states))?;
        if table.rows() == 0 {
            return Err(Problem::NoSamples.in_file(&arguments.states));
        }
        let mut columns = [const { Vec::new() }; 3];
        for (columns, names) in columns.iter_mut().zip(&names) {
            for name in names {
                let column = table.take_float(name);
                columns.push(column.map_err(|problem| problem.in_file(&arguments.states))?);
            }
        }
        Ok(Self { rows: table.rows(), columns })
    }

    /// Position, velocity and acceleration of all joints in a row.
    fn row(&self, row: usize) -> [Vec<f64>; 3] {
        [0, 1, 2].map(|order| self.columns[order].iter().map(|column| column[row]).collect())
    }
}

fn write(arguments: &Arguments, body: &Body, motion: &Motion) -> Result<(), FileError> {
    replace_file(&arguments.out, |out| {
        let mut put = |line: String| writeln!(out, "{line}").map_err(Problem::Unwritable);
        put(header(&body.joints))?;
        (0..motion.rows).try_for_each(|row| {
            let [q, qd, qdd] = motion.row(row);
            let loads = body.torques(&q, &qd, &vec![0.0; qdd.len()]);
            let values = values(body, &body.torques(&q, &qd, &qdd), &loads, &qd);
            if values.iter().any(|value| !value.is_finite()) {
                return Err(Problem::OutOfRange(format!(
                    "sample {} of {} needs infinite torques or commands",
                    row + 1,
                    arguments.states.display()
                )));
            }
            put(values.iter().map(f64::to_string).collect::<Vec<_>>().join(","))
        })
    })
}

fn header(joints: &[JointColumns]) -> String {
    let torques = joints.iter().map(JointColumns::torque);
    let commands = joints.iter().filter_map(JointColumns::command);
    let [friction, needed] = [0, 1]
        .map(|index| joints.iter().filter_map(move |joint| Some(joint.needed()?[index].clone())));
    torques.chain(commands).chain(friction).chain(needed).collect::<Vec<_>>().join(",")
}

/// The values of a row, in the order of the header.
fn values(body: &Body, torques: &[f64], loads: &[f64], velocities: &[f64]) -> Vec<f64> {
    let joints = || torques.iter().zip(&body.joints);
    let commands = joints().filter_map(|(torque, joint)| Some(torque / joint.torque_constant()?));
    let needed: Vec<[f64; 2]> = joints()
        .zip(loads.iter().zip(velocities))
        .filter_map(|((torque, joint), (load, v))| joint.needed_values(*torque, *load, *v))
        .collect();
    let parts = [0, 1].map(|index| needed.iter().map(move |values| values[index]));
    torques.iter().copied().chain(commands).chain(parts.into_iter().flatten()).collect()
}
