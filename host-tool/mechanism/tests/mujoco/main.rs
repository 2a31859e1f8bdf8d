//! Chains against MuJoCo: 50 random ones of 1 to 7 joints, prismatic ones among them.
//!
//! Takes Python 3; the first run installs `mujoco` below `target/` and takes half a minute.

mod chains;

use std::path::Path;
use std::process::Command;

use test_support::Python;

/// The version is that of the figures in docs/mechanisms.md.
const WITH_MUJOCO: Python = Python {
    variable: "RRR_MUJOCO_PYTHON",
    folder: "mujoco-python",
    packages: &["mujoco==4.0.0", "numpy"],
    imports: "mujoco, numpy",
};

#[test]
fn chains_move_as_mujoco_says() {
    let Some(python) = WITH_MUJOCO.find(env!("CARGO_TARGET_TMPDIR")) else { return };
    let place = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let answers = place.join("chains.json");
    std::fs::write(&answers, chains::with_answers(50).to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/mujoco/chains.py");
    let run = Command::new(python).arg(script).arg(&answers).output().unwrap();
    let [out, errors] = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
    print!("{out}");
    assert!(run.status.success(), "{out}{errors}");
}
