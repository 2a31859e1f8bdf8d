//! Servo arms for tests and blind trials, with friction that differs from servo to servo.

use files::arm_file::{ArmFriction, Drive, DriveKind, Encoder, EncoderSide, LinkTable};
use files::{ArmFile, ArmJoint};
use model::chain::SerialChain;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64Mcg;

use crate::along::without_rotors;

/// A servo of the kind of hobby arms, with friction that differs by a tenth from one to the next.
fn servo_joint(name: &str, random: &mut Pcg64Mcg) -> ArmJoint {
    let spread = Normal::new(1.0, 0.1).expect("a deviation above zero");
    let mut about = |value: f64| value * f64::clamp(spread.sample(random), 0.7, 1.3);
    ArmJoint {
        name: Some(name.to_owned()),
        axis: [0.0, 0.0, 1.0],
        armature: Some(about(0.02)),
        drive: Some(Drive {
            kind: DriveKind::PositionServo,
            torque_constant: Some(0.5),
            stiffness: Some(29.0),
            limit: Some(10.6),
            ..Drive::default()
        }),
        encoder: Some(Encoder { counts: 4096.0, side: EncoderSide::Joint }),
        friction: Some(ArmFriction {
            alpha0: Some(about(0.15)),
            alpha1: Some(0.0),
            stribeck_velocity: Some(0.1),
            alpha2: Some(about(1.2)),
            ..ArmFriction::default()
        }),
        ..ArmJoint::default()
    }
}

fn link(mass_kg: f64, com_m: [f64; 3]) -> LinkTable {
    let size = mass_kg * 4e-4;
    LinkTable {
        mass_kg: Some(mass_kg),
        com_m: Some(com_m),
        inertia_kg_m2: Some([size, 0.0, 0.0, size, 0.0, size]),
    }
}

fn upright(name: &str, joints: Vec<ArmJoint>) -> ArmFile {
    let mut file = ArmFile::default();
    file.name = Some(name.to_owned());
    file.gravity_m_s2 = [0.0, 0.0, -9.81];
    file.joints = joints;
    file
}

/// A pendulum of one servo about a horizontal axis, hanging at zero: a mass [kg] at a distance [m].
pub fn pendulum(seed: u64, mass_kg: f64, length_m: f64) -> ArmFile {
    let mut random = Pcg64Mcg::new((u128::from(seed) << 1) | 1);
    let joint = ArmJoint {
        axis: [0.0, -1.0, 0.0],
        link: link(mass_kg, [0.0, 0.0, -length_m]),
        ..servo_joint("swing", &mut random)
    };
    upright("pendulum", vec![joint])
}

/// A joint's name, its origin [m], its axis, its link's mass [kg] and centre [m].
type Place = (&'static str, [f64; 3], [f64; 3], f64, [f64; 3]);

/// An arm of six servos: turn, shoulder, elbow, wrist about three axes, 0.35 m long.
pub fn six_axes(seed: u64) -> ArmFile {
    let mut random = Pcg64Mcg::new((u128::from(seed) << 1) | 1);
    let places: [Place; 6] = [
        ("turn", [0.0, 0.0, 0.05], [0.0, 0.0, 1.0], 0.15, [0.0, 0.0, 0.03]),
        ("shoulder", [0.0, 0.0, 0.05], [0.0, 1.0, 0.0], 0.12, [0.06, 0.0, 0.0]),
        ("elbow", [0.12, 0.0, 0.0], [0.0, 1.0, 0.0], 0.11, [0.06, 0.0, 0.0]),
        ("pitch", [0.12, 0.0, 0.0], [0.0, 1.0, 0.0], 0.08, [0.03, 0.0, 0.0]),
        ("roll", [0.06, 0.0, 0.0], [1.0, 0.0, 0.0], 0.06, [0.02, 0.0, 0.0]),
        ("yaw", [0.04, 0.0, 0.0], [0.0, 0.0, 1.0], 0.05, [0.03, 0.0, 0.0]),
    ];
    let joints = places.into_iter().map(|(name, origin, axis, mass, centre)| ArmJoint {
        origin_xyz_m: origin,
        axis,
        link: link(mass, centre),
        ..servo_joint(name, &mut random)
    });
    upright("six-axes", joints.collect())
}

/// The links of a file without rotors.
///
/// # Panics
/// A file whose links are not known.
pub fn links_of(file: &ArmFile) -> SerialChain<f64> {
    without_rotors(&file.chain().expect("links that are known"))
}
