//! Arms whose geometry and inertias a URDF holds.

use std::path::PathBuf;

use files::{ArmFile, FileError};
use model::mechanism::{JointKind, Mechanism};
use proptest::prelude::*;

const URDF: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <link name="world"/>
  <link name="base"><inertial><mass value="9"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="upper">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 1.5707963267948966"/>
      <mass value="2"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.025"/>
    </inertial>
  </link>
  <link name="bracket"><inertial><mass value="1"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <link name="rod"/>
  <link name="tool"/>
  <link name="finger"><inertial><mass value="0.5"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <joint name="stand" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.5" rpy="0 0.3 0"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="10" velocity="3"/>
  </joint>
  <joint name="screws" type="fixed"><parent link="upper"/><child link="bracket"/><origin xyz="0.3 0 0" rpy="0 0 0.2"/></joint>
  <joint name="slide" type="prismatic">
    <parent link="bracket"/><child link="rod"/>
    <origin xyz="0.05 0 0"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.4" effort="10" velocity="3"/>
  </joint>
  <joint name="flange" type="fixed"><parent link="rod"/><child link="tool"/></joint>
  <joint name="grip" type="continuous"><parent link="tool"/><child link="finger"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/></joint>
</robot>
"#;

const HEAD: &str = "format = 2\n[robot]\nurdf = \"arm.urdf\"\n";
const TWO: &str = "[[joint]]\nname = \"shoulder\"\narmature_kg_m2 = 0.3\n[joint.drive]\nkind = \"torque\"\n\
                   [[joint]]\nname = \"slide\"\n";

fn read(text: &str, urdf: &str) -> Result<ArmFile, FileError> {
    let directory = tempfile::tempdir().unwrap();
    let path: PathBuf = directory.path().join("robot.toml");
    std::fs::write(directory.path().join("arm.urdf"), urdf).unwrap();
    std::fs::write(&path, text).unwrap();
    ArmFile::read(path)
}

fn refused(text: &str, urdf: &str) -> String {
    read(text, urdf).unwrap_err().to_string()
}

#[test]
fn joints_are_found_by_name() {
    let arm = read(&[HEAD, TWO].concat(), URDF).unwrap();
    let [shoulder, slide] = arm.joints.as_slice() else { panic!("{:?}", arm.joints) };
    assert_eq!((shoulder.kind, slide.kind), (JointKind::Revolute, JointKind::Prismatic));
    assert_eq!((shoulder.limits, slide.limits), (Some([-1.0, 2.0]), Some([0.0, 0.4])));
    assert_eq!((shoulder.axis, slide.axis), ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]));
    // What the base stands on, and what is screwed on between, are fixed.
    assert_eq!(shoulder.origin_xyz_m, [0.0, 0.0, 1.5]);
    let (sine, cosine) = 0.2_f64.sin_cos();
    let expected = [0.3 + 0.05 * cosine, 0.05 * sine, 0.0];
    assert!((0..3).all(|k| (slide.origin_xyz_m[k] - expected[k]).abs() < 1e-15));
    assert!((slide.origin_rpy_rad[2] - 0.2).abs() < 1e-15);
    assert_eq!((shoulder.armature, slide.armature), (Some(0.3), None));
}

#[test]
fn what_is_fixed_to_a_link_is_a_part_of_it() {
    let arm = read(&[HEAD, TWO].concat(), URDF).unwrap();
    let upper = &arm.joints[0].link;
    assert_eq!(upper.mass_kg, Some(3.0));
    let com = upper.com_m.unwrap();
    assert!((com[0] - (2.0 * 0.1 + 0.3) / 3.0).abs() < 1e-15);
    // Turned by a quarter, the link's ixx is its iyy; the bracket is a point 0.2 m off.
    let inertia = upper.inertia_kg_m2.unwrap();
    let apart = 2.0 / 3.0 * 0.2_f64.powi(2);
    for (found, expected) in
        [(inertia[0], 0.02), (inertia[3], 0.01 + apart), (inertia[5], 0.025 + apart)]
    {
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }
    // The finger is not named: it stays where it is on the rod, which has no mass of its own.
    let rod = &arm.joints[1].link;
    assert_eq!((rod.mass_kg, rod.com_m), (Some(0.5), Some([0.0, 0.0, 0.1])));
    let (mut torque, cosine) = ([0.0; 2], 0.2_f64.cos());
    arm.chain().unwrap().gravity(&[0.0; 2], &mut torque);
    assert!((torque[1] + 0.5 * 9.81 * 0.3_f64.sin() * cosine).abs() < 1e-12, "{torque:?}");
}

#[test]
fn a_link_without_mass_is_unknown() {
    let all = read(HEAD, URDF).unwrap();
    assert_eq!(all.joints.len(), 3);
    assert_eq!(all.joints[1].link, files::arm_file::LinkTable::default());
    assert!(all.joints[2].limits.is_none());
    assert!(all.chain().unwrap_err().to_string().contains("mass_kg of joint 2 (slide) is missing"));
    // The file may know what the URDF does not.
    let known = "mass_kg = 0.4\ncom_m = [0, 0, 0]\ninertia_kg_m2 = [0, 0, 0, 0, 0, 0]\n\
                 [[joint]]\nname = \"grip\"\n";
    let text = [HEAD, TWO, known].concat();
    assert_eq!(read(&text, URDF).unwrap().joints[1].link.mass_kg, Some(0.4));
}

#[test]
fn a_file_from_a_urdf_is_written_out() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.toml");
    let arm = read(&[HEAD, TWO].concat(), URDF).unwrap();
    arm.write(&path).unwrap();
    assert_eq!(ArmFile::read(&path).unwrap().joints, arm.joints);
}

#[test]
fn what_does_not_fit_is_named() {
    let two = [HEAD, TWO].concat();
    let cases = [
        (
            two.replace("\"slide\"", "\"glide\""),
            URDF.to_owned(),
            "arm.urdf: there is no joint \"glide\"; there are stand, shoulder",
        ),
        (
            two.replace("\"slide\"", "\"grip\""),
            URDF.to_owned(),
            "joint \"slide\" moves before \"grip\", but is not that before it",
        ),
        (
            two.replace("\"slide\"", "\"flange\""),
            URDF.to_owned(),
            "joint \"flange\" must be revolute, continuous or prismatic",
        ),
        (
            two.replace("name = \"slide\"\n", ""),
            URDF.to_owned(),
            "a [[joint]] beside `urdf` has no name",
        ),
        (
            two.replace("armature", "kind = \"prismatic\"\narmature"),
            URDF.to_owned(),
            "robot.toml, line 6: kind is not that of the URDF's joint",
        ),
        (two.replace("arm.urdf", "leg.urdf"), URDF.to_owned(), "leg.urdf: there is no such file"),
        (two.clone(), URDF.replace("<link name=\"rod\"/>", ""), "there is no link \"rod\""),
        (
            two.clone(),
            URDF.replace("<child link=\"tool\"/>", "<child link=\"upper\"/>"),
            "link \"upper\" is the child of two joints",
        ),
        (
            two.clone(),
            URDF.replace("<child link=\"base\"/>", "<child link=\"world\"/>"),
            "is in a circle",
        ),
        (
            two.clone(),
            URDF.replace("xyz=\"0 0 0.5\"", "xyz=\"0 nan 0.5\""),
            "joint \"shoulder\" or its link has a value that is no finite number",
        ),
        (two.clone(), URDF.replace("<parent link=\"bracket\"/>", ""), "arm.urdf: "),
        (two, URDF[..900].to_owned(), "arm.urdf: "),
        (
            HEAD.to_owned(),
            URDF.replace("<parent link=\"bracket\"/>", "<parent link=\"base\"/>"),
            "joints \"shoulder\" and \"slide\" are on two branches",
        ),
    ];
    for (text, urdf, expected) in cases {
        let message = refused(&text, &urdf);
        assert!(message.contains(expected) && !message.contains('\n'), "{message}");
    }
}

const PIECES: [&str; 10] = [
    "",
    "<",
    ">",
    "\"",
    "</link>",
    "<link name=\"rod\"/>",
    "nan",
    "1e999",
    "&amp;",
    "type=\"fixed\"",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_cut_and_patched_urdf_never_panics(
        changes in prop::collection::vec((0..URDF.len(), 0..30_usize, 0..PIECES.len()), 1..4),
        is_named: bool,
    ) {
        let mut urdf = URDF.to_owned();
        for (at, length, piece) in changes {
            let from = at.min(urdf.len());
            let to = (from + length).min(urdf.len());
            urdf.replace_range(from..to, PIECES[piece]);
        }
        let text = if is_named { [HEAD, TWO].concat() } else { HEAD.to_owned() };
        let _ = read(&text, &urdf).map(|arm| (arm.chain(), arm.remarks()));
    }
}
