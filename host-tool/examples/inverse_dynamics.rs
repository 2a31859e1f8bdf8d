//! Joint torques and voltages that a robot needs for one state of motion:
//! `cargo run --example inverse_dynamics -- model.toml`.

use std::error::Error;
use std::path::Path;

use files::RobotFile;
use model::Posture;
use model::vector::Vector3;

/// Torques [Nm] and voltages [V] of joints 1 to 3, rigid body without friction.
pub fn torques_and_voltages(model: &Path) -> Result<[Vector3<f64>; 2], Box<dyn Error>> {
    let robot = RobotFile::read(model)?.robot()?;
    let q_rad = [0.0, -1.0, 0.5];
    let qd_rad_per_s = [1.0, -2.0, 0.5];
    let qdd_rad_per_s2 = [3.0, 0.0, -4.0];
    // The base's angle q1 has no influence.
    let posture = Posture::new(q_rad[1], q_rad[2]);
    let torque_nm =
        posture.inverse_dynamics(&robot.base, &robot.geometry, &qd_rad_per_s, &qdd_rad_per_s2);
    Ok([torque_nm, robot.torque_to_voltage(&torque_nm)])
}

#[allow(dead_code)] // The test calls the function.
fn main() -> Result<(), Box<dyn Error>> {
    let model = std::env::args().nth(1).ok_or("name a model file")?;
    let [torque_nm, voltage_v] = torques_and_voltages(Path::new(&model))?;
    for joint in 0..3 {
        println!("joint {}: {:8.3} Nm {:8.3} V", joint + 1, torque_nm[joint], voltage_v[joint]);
    }
    Ok(())
}
