//! Damaged files of arms are refused or read, and never end the program.

use files::ArmFile;
use proptest::prelude::*;

const ARM: &str = "format = 2
[robot]
name = \"a\"
gravity_m_s2 = [0.0, 0.0, -9.81]
urdf = \"none.urdf\"
[[joint]]
name = \"b\"
kind = \"revolute\"
origin_xyz_m = [0.1, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
mass_kg = 0.1
inertia_kg_m2 = [1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4]
limits_rad = [-1.7, 1.7]
[joint.drive]
kind = \"current\"
[joint.encoder]
counts_per_rev = 4096
[joint.friction]
alpha0_V = 0.1
[joint.standard_error]
mass_kg = 0.01
[[effect]]
effect = \"saturation\"
joint = 1
parameters = { limit_V = 6.0 }
";

const PIECES: [&str; 14] = [
    "",
    "\n",
    "[",
    "]",
    "=",
    "\"",
    "1e308",
    "-1e308",
    "1e-320",
    "9223372036854775807",
    "[[joint]]\n",
    "[joint]\n",
    "joint = 3\n",
    "nan",
];

/// What is read is also converted and written.
fn use_all(bytes: Vec<u8>) {
    let Ok(arm) = ArmFile::parse("damaged.toml", bytes) else { return };
    let _ = (arm.chain(), arm.chain_of_what_is_known(), arm.remarks());
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("again.toml");
    arm.write(&path).unwrap();
    let again = ArmFile::read(&path).unwrap();
    assert_eq!((again.joints, again.gravity_m_s2), (arm.joints, arm.gravity_m_s2));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_cut_and_patched_file_never_panics(
        has_urdf: bool,
        changes in prop::collection::vec((0..ARM.len(), 0..20_usize, 0..PIECES.len()), 0..3),
    ) {
        let mut text = if has_urdf { ARM.to_owned() } else { ARM.replace("urdf = \"none.urdf\"\n", "") };
        for (at, length, piece) in changes {
            let from = at.min(text.len());
            let to = (from + length).min(text.len());
            text.replace_range(from..to, PIECES[piece]);
        }
        use_all(text.into_bytes());
    }

    #[test]
    fn any_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        use_all([b"format = 2\n".as_slice(), &bytes].concat());
    }
}
