//! No bytes make a reader panic.

use std::path::Path;

use files::{Dataset, Log, RobotFile};
use proptest::prelude::*;

mod common;

/// Reads bytes as every kind of file; only the absence of panics counts.
fn read_as_everything(directory: &Path, bytes: &[u8]) {
    for name in ["log.csv", "log.csv.gz", "log.mcap", "dataset.toml", "model.toml"] {
        std::fs::write(directory.join(name), bytes).unwrap();
    }
    let _ = Log::read(directory.join("log.csv"));
    let _ = Log::read(directory.join("log.csv.gz"));
    let _ = Log::read(directory.join("log.mcap"));
    let _ = Dataset::read(directory).and_then(|dataset| dataset.recordings());
    if let Ok(file) = RobotFile::read(directory.join("model.toml")) {
        let _ = (file.robot(), file.pendulum());
        file.write(directory.join("model.toml")).unwrap();
    }
}

/// A good file's bytes with some of them replaced, and the end cut off.
fn damaged(mut bytes: Vec<u8>, changes: &[(prop::sample::Index, u8)], keep: usize) -> Vec<u8> {
    for (index, byte) in changes {
        let index = index.index(bytes.len());
        bytes[index] = *byte;
    }
    bytes.truncate((bytes.len() * keep).div_ceil(100));
    bytes
}

const MODEL: &str = "format = 1\n[robot]\ntorque_constant_Nm_per_V = [3]\ngravity_m_s2 = 9.81\n\
    [pendulum]\njoint = 3\ninertia_kg_m2 = 0.07\ngravity_torque_Nm = 1.9\n[[friction]]\n\
    joint = 3\nalpha0_V = 0.3\nalpha1_V = 0.1\nstribeck_velocity_rad_per_s = 0.003\n\
    alpha2_V_s_per_rad = 0.1\n[[effect]]\neffect = \"payload\"\njoint = 0\n";

fn good_files() -> Vec<Vec<u8>> {
    let directory = common::directory();
    let written = ["log.csv", "log.csv.gz", "log.mcap"].map(|name| {
        let path = directory.path().join(name);
        common::log_in_counts(20).write(&path).unwrap();
        std::fs::read(path).unwrap()
    });
    let list = "format = 1\n[[log]]\nfile = \"log.csv\"\nexperiment = \"slow\"\nrole = \"train\"\n";
    written.into_iter().chain([MODEL.into(), list.into()]).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read_as_everything(common::directory().path(), &bytes);
    }

    #[test]
    fn arbitrary_rows_do_not_panic(rows in "[-+0-9.,eEna\"\r\n \t]{0,200}") {
        let text = format!("t_s,q1_count,u1_V,note\n{rows}");
        read_as_everything(common::directory().path(), text.as_bytes());
    }

    #[test]
    fn damaged_files_do_not_panic(
        which in 0..5_usize,
        changes in prop::collection::vec(any::<(prop::sample::Index, u8)>(), 0..8),
        keep in 1..=100_usize,
    ) {
        let bytes = damaged(good_files().swap_remove(which), &changes, keep);
        read_as_everything(common::directory().path(), &bytes);
    }
}
