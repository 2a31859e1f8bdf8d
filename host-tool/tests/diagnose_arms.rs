//! Arms of any kind under diagnosis: a pendulum of two links with voltages, a geared arm of six joints
//! with currents, and the three-joint robot as a chain, which must be judged as its closed form is.

mod arms;

use arms::{Case, all_are_named, diagnosed, names, recorded};
use diagnosis::{Criteria, Diagnosis, Report, Verdict};
use files::example_arms::{linear_axis, rotary_joint, six_axes, two_link_pendulum};
use files::{ArmFile, RobotFile};
use model::links::{Link, base_parameters};
use model::reference_robot::reference_robot;
use model::{Geometry, Robot};
use recordings::{ArmCampaign, Campaign};
use rig::effects::Catalogue;

fn of_pendulum(hidden: &[&str]) -> Report {
    diagnosed(&recorded(&two_link_pendulum(), 500.0, 15.0, hidden)).report
}

fn of_six_joints(hidden: &[&str]) -> Report {
    diagnosed(&recorded(&six_axes(), 500.0, 20.0, hidden)).report
}

fn of_six_joints_at_half_the_rate(hidden: &[&str]) -> Report {
    diagnosed(&recorded(&six_axes(), 250.0, 20.0, hidden)).report
}

#[test]
fn a_pendulum_as_its_model_has_no_gap() {
    let report = of_pendulum(&[]);
    assert_eq!((report.verdict, report.causes.len()), (Verdict::None, 0));
}

#[test]
fn single_causes_of_a_pendulum_are_named_with_joint_and_size() {
    let cases: &[Case] = &[
        ("payload:mass_kg=0.2,com_m=0.25 0 0", "payload", 0, ("mass_kg", 0.2), 0.1),
        (
            "cogging:1:amplitude_V=0.08,harmonic=7,phase_rad=0.4",
            "cogging",
            1,
            ("amplitude_V", 0.08),
            0.05,
        ),
        ("dac_offset:2:offset_V=0.05", "dac_offset", 2, ("offset_V", 0.05), 0.05),
        (
            "torque_constant:1:relative_error=0.1",
            "torque_constant",
            1,
            ("relative_error", 0.1),
            0.1,
        ),
        (
            "asymmetric_friction:2:relative_asymmetry=0.25",
            "asymmetric_friction",
            2,
            ("relative_asymmetry", 0.25),
            0.1,
        ),
        ("delay:1:delay_s=0.003", "delay", 1, ("delay_s", 0.003), 0.1),
        (
            "load_friction:1:coefficient_V_per_Nm=0.05",
            "load_friction",
            1,
            ("coefficient_V_per_Nm", 0.05),
            0.1,
        ),
    ];
    all_are_named(of_pendulum, cases);
}

/// All of a planar pendulum turns against gravity, by its first joint's zero or by its base: one thing
/// under two names.
#[test]
fn another_home_position_of_a_pendulum_is_named_as_a_lean() {
    let report = of_pendulum(&["encoder_offset:1:offset_rad=0.03"]);
    let [cause] = &report.causes[..] else { panic!("{:?}", report.causes) };
    let size = match (cause.effect.as_str(), cause.joint) {
        ("encoder_offset", 1) => "offset_rad",
        ("base_tilt", 0) => "tilt_y_rad",
        other => panic!("{other:?}"),
    };
    let diagnosis::Value::Number(found) = cause.parameters[size] else { panic!("a number") };
    assert!((found.abs() / 0.03 - 1.0).abs() < 0.1, "{found}");
}

/// All of a joint's parameters off by one factor cost five deviations each; its noise, in volts as they were
/// sent, is the same whatever the motor makes of a volt.
#[test]
fn a_motor_that_gives_more_of_every_command_is_named_on_one_joint() {
    let report = diagnosed(&recorded(
        &rotary_joint(),
        500.0,
        15.0,
        &["torque_constant:1:relative_error=0.15"],
    ))
    .report;
    names(&report, "torque_constant", 1, ("relative_error", 0.15), 0.1);
    assert!(report.causes[0].share > 0.9, "{}", report.causes[0].share);
}

/// The log under driven noise is told three times too noisy, and must not make up for the others.
#[test]
fn drag_that_leaves_less_than_two_millivolts_is_named() {
    let hidden = ["quadratic_drag:1:coefficient_V_s2_per_rad2=0.0028"];
    let report = diagnosed(&recorded(&rotary_joint(), 500.0, 15.0, &hidden)).report;
    names(&report, "quadratic_drag", 1, ("coefficient_V_s2_per_rad2", 0.0028), 0.1);
}

/// Simulated from a 16-bit encoder alone, such a link swings with its steps.
#[test]
fn a_spring_whose_link_is_hardly_damped_is_named() {
    let hidden = ["joint_elasticity:1:stiffness_Nm_per_rad=296,damping_Nm_s_per_rad=0.34,\
                   motor_inertia_kg_m2=0.0035"];
    let report = diagnosed(&recorded(&rotary_joint(), 500.0, 20.0, &hidden)).report;
    names(&report, "joint_elasticity", 1, ("stiffness_Nm_per_rad", 296.0), 0.15);
    assert!(report.causes[0].probability > 0.9, "{}", report.causes[0].probability);
}

/// A link that flies from one flank to the other fits by play within a seventh alone.
#[test]
fn play_of_five_degrees_is_named() {
    let hidden = ["backlash:1:gap_rad=0.09,stiffness_Nm_per_rad=242,damping_Nm_s_per_rad=0.24,\
                   motor_inertia_kg_m2=0.0042"];
    let report = diagnosed(&recorded(&rotary_joint(), 500.0, 20.0, &hidden)).report;
    names(&report, "backlash", 1, ("gap_rad", 0.09), 0.05);
}

#[test]
fn an_amplifier_that_gives_less_is_named() {
    names(&of_pendulum(&["saturation:1:limit_V=3"]), "saturation", 1, ("limit_V", 3.0), 0.05);
}

#[test]
fn a_sliding_axis_is_judged_in_its_own_units() {
    let campaign = recorded(&linear_axis(), 500.0, 15.0, &["dac_offset:1:offset_V=3"]);
    let found = diagnosed(&campaign);
    names(&found.report, "dac_offset", 1, ("offset_V", 3.0), 0.05);
    let said = host_tool::commands::diagnose::in_words(&found);
    assert!(said.contains("3 N") && !said.contains(" V"), "{said}");
}

/// What a robot's own log keeps of a campaign: one row of so many, its command as of its instant.
fn kept(campaign: ArmCampaign, one_of: usize) -> ArmCampaign {
    let keep = |signal: &Vec<f64>| signal.iter().copied().step_by(one_of).collect::<Vec<f64>>();
    let recordings = campaign.recordings.into_iter().map(|mut recording| {
        recording.log.time_s = keep(&recording.log.time_s);
        for joint in &mut recording.log.joints {
            joint.position = keep(&joint.position);
            joint.command = keep(&joint.command);
            joint.reference = joint.reference.as_ref().map(keep);
        }
        recording
    });
    ArmCampaign { arm: campaign.arm, recordings: recordings.collect() }
}

#[test]
fn commands_kept_of_instants_are_no_fault_of_the_arm() {
    let hidden = ["payload:mass_kg=0.3,com_m=0.0 0 0"];
    let campaign = kept(recorded(&two_link_pendulum(), 500.0, 15.0, &hidden), 4);
    let Diagnosis { report, .. } = diagnosed(&campaign);
    names(&report, "payload", 0, ("mass_kg", 0.3), 0.1);
    assert!(report.remarks.iter().any(|remark| remark.contains("early")), "{:?}", report.remarks);
}

/// By a model that logs have told to a part in a thousand no parameter makes up for a load; that commands are early then
/// shows only beside it.
#[test]
fn a_load_is_named_by_an_identified_model_where_logs_keep_instants() {
    let of_pendulum =
        |hidden: &[&str]| kept(recorded(&two_link_pendulum(), 500.0, 15.0, hidden), 4);
    let settings = identification::arm::Settings::default();
    let found = identification::arm::identify(&of_pendulum(&[]), &settings).unwrap();
    let loaded = of_pendulum(&["payload:mass_kg=1.0,com_m=0.25 0 0"]);
    let Diagnosis { report, .. } = diagnosed(&ArmCampaign { arm: found.model, ..loaded });
    names(&report, "payload", 0, ("mass_kg", 1.0), 0.1);
    assert!(report.remarks.iter().any(|remark| remark.contains("early")), "{:?}", report.remarks);
}

/// At 250 Hz its driven noise is sampled so coarsely that rows of joint 6 leave five times their noise, by which friction
/// by its load came to take all that the calm logs leave.
#[test]
fn a_geared_arm_as_its_model_has_no_gap() {
    let report = of_six_joints_at_half_the_rate(&[]);
    assert_eq!((report.verdict, report.causes.len()), (Verdict::None, 0));
}

/// A model by which friction is off by these parts of itself, joint by joint.
fn with_friction_off(mut arm: ArmFile, parts: [f64; 6]) -> ArmFile {
    for (joint, part) in arm.joints.iter_mut().zip(parts) {
        let friction = joint.friction.as_mut().unwrap();
        friction.alpha0 = friction.alpha0.map(|level| level / (1.0 + part));
        friction.alpha2 = friction.alpha2.map(|viscous| viscous / (1.0 - part));
    }
    arm
}

/// Masses that are doubted as friction must be would stand in for the load.
#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn a_load_is_told_although_friction_is_far_from_the_models() {
    let hidden = ["payload:mass_kg=0.5,com_m=0.05 0 0.1"];
    let ArmCampaign { arm, recordings } = recorded(&six_axes(), 250.0, 10.0, &hidden);
    let arm = with_friction_off(arm, [0.4, -0.3, 0.3, -0.4, 0.35, -0.3]);
    let Diagnosis { report, .. } = diagnosed(&ArmCampaign { arm, recordings });
    names(&report, "payload", 0, ("mass_kg", 0.5), 0.1);
    let apart = |remark: &String| remark.contains("about masses and inertias was taken as");
    assert!(report.remarks.iter().any(apart), "{:?}", report.remarks);
}

#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn a_wave_of_a_geared_arm_is_named_with_joint_and_size() {
    let report = of_six_joints(&["cogging:2:amplitude_V=0.05,harmonic=2,phase_rad=0.4"]);
    names(&report, "cogging", 2, ("amplitude_V", 0.05), 0.1);
}

#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn a_load_and_friction_of_a_geared_arm_are_named_with_joint_and_size() {
    let cases: &[Case] = &[
        ("payload:mass_kg=0.5,com_m=0.05 0 0.1", "payload", 0, ("mass_kg", 0.5), 0.1),
        (
            "asymmetric_friction:5:relative_asymmetry=0.2",
            "asymmetric_friction",
            5,
            ("relative_asymmetry", 0.2),
            0.15,
        ),
    ];
    all_are_named(of_six_joints, cases);
}

#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn a_table_under_a_geared_arm_is_named() {
    let report = of_six_joints(&["contact:stiffness_N_per_m=45,height_m=0.04"]);
    names(&report, "contact", 0, ("stiffness_N_per_m", 45.0), 0.2);
}

#[test]
fn what_drives_of_a_geared_arm_do_is_named_with_joint_and_size() {
    let cases: &[Case] = &[
        (
            "torque_constant:2:relative_error=0.12",
            "torque_constant",
            2,
            ("relative_error", 0.12),
            0.2,
        ),
        ("delay:5:delay_s=0.0018", "delay", 5, ("delay_s", 0.0018), 0.15),
    ];
    all_are_named(of_six_joints_at_half_the_rate, cases);
}

#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn an_offset_of_a_geared_arm_is_named_with_joint_and_size() {
    let report = of_six_joints(&["dac_offset:3:offset_V=0.1"]);
    names(&report, "dac_offset", 3, ("offset_V", 0.1), 0.1);
}

/// Both make a command late; to second order a lag with commands that are later than logged is a delay.
#[test]
#[ignore = "minutes; `cargo xtask test --long`"]
fn lags_and_delays_of_a_geared_arm_are_told_apart() {
    let cases: &[Case] = &[
        (
            "actuator_lag:5:time_constant_s=0.003",
            "actuator_lag",
            5,
            ("time_constant_s", 0.003),
            0.1,
        ),
        ("delay:5:delay_s=0.003", "delay", 5, ("delay_s", 0.003), 0.1),
    ];
    all_are_named(of_six_joints, cases);
}

/// Links whose base parameters make a robot about the size of the reference robot.
fn links() -> [Link<f64>; 3] {
    let link = |mass_kg: f64, centre_m: [f64; 3], own: [f64; 3]| Link {
        mass_kg,
        centre_m,
        inertia_diagonal_kg_m2: own,
        inertia_products_kg_m2: [0.0; 3],
    };
    [
        link(6.0, [0.0, 0.0, 0.0], [0.05, 0.06, 0.06]),
        link(4.0, [-0.1, 0.01, -0.03], [0.01, 0.03, 0.03]),
        link(1.5, [-0.25, 0.02, 0.01], [0.004, 0.02, 0.02]),
    ]
}

const ROTORS_KG_M2: [f64; 3] = [0.2, 0.1, 0.01];

fn robot() -> Robot<f64> {
    let reference: Robot<f64> = reference_robot();
    let base = base_parameters(&links(), &ROTORS_KG_M2, &reference.geometry);
    Robot { base, ..reference }
}

/// The same robot as a chain: joint i + 1 stands in link i where the distal frame i of Table 1 does.
fn robot_as_chain() -> ArmFile {
    let robot = robot();
    let Geometry { d1_m, d2_m, a2_m, d3_m, a3_m, .. } = robot.geometry;
    let origins = [[0.0; 3], [0.0, 0.0, d1_m], [a2_m, 0.0, d2_m]];
    let distal = [[0.0, 0.0, d1_m], [a2_m, 0.0, d2_m], [a3_m, 0.0, d3_m]];
    let mut text = "format = 2\n[robot]\ngravity_m_s2 = [0.0, 0.0, -9.81]\n".to_owned();
    for (k, link) in links().iter().enumerate() {
        let [x, y, z] = link.centre_m;
        // The first distal frame is turned about x by a quarter.
        let turned = if k == 0 { [x, -z, y] } else { [x, y, z] };
        let at: Vec<f64> = (0..3).map(|i| turned[i] + distal[k][i]).collect();
        let [xx, yy, zz] = link.inertia_diagonal_kg_m2;
        let roll = if k == 1 { std::f64::consts::FRAC_PI_2 } else { 0.0 };
        let f = &robot.friction[k];
        text += &format!(
            "[[joint]]\nkind = \"revolute\"\naxis = [0.0, 0.0, 1.0]\norigin_xyz_m = {:?}\n\
             origin_rpy_rad = [{roll:?}, 0.0, 0.0]\nmass_kg = {:?}\ncom_m = {at:?}\n\
             inertia_kg_m2 = [{xx:?}, 0.0, 0.0, {yy:?}, 0.0, {zz:?}]\narmature_kg_m2 = {:?}\n\
             drive = {{ kind = \"voltage\", torque_constant_Nm_per_V = {:?} }}\n\
             encoder = {{ counts_per_rev = 655360 }}\n\
             friction = {{ alpha0_V = {:?}, alpha1_V = {:?}, stribeck_velocity_rad_per_s = {:?}, \
             alpha2_V_s_per_rad = {:?}, sigma0_V_per_rad = {:?}, sigma1_V_s_per_rad = {:?} }}\n",
            origins[k],
            link.mass_kg,
            ROTORS_KG_M2[k],
            robot.torque_constant_nm_per_v[k],
            f.alpha0_v,
            f.alpha1_v,
            f.stribeck_velocity_rad_per_s,
            f.alpha2_v_s_per_rad,
            f.sigma0_v_per_rad,
            f.sigma1_v_s_per_rad,
        );
    }
    ArmFile::parse("arm.toml", text.into_bytes()).unwrap()
}

/// The same logs, judged by the closed form.
fn diagnosed_in_closed_form(campaign: &ArmCampaign) -> Report {
    let traces = campaign.recordings.iter().map(|log| log.trace(&campaign.arm)).collect();
    let file = RobotFile::from_robot(&robot());
    let campaign = Campaign::new(file, Some(655_360.0), traces).unwrap();
    let (catalogue, criteria) = (Catalogue::standard(), Criteria::default());
    diagnosis::diagnose(&campaign, &catalogue, &criteria, &|_| ()).unwrap().report
}

#[test]
fn a_chain_is_judged_as_its_closed_form() {
    let arm = robot_as_chain();
    let cases = [
        None,
        Some("cogging:3:amplitude_V=0.11,harmonic=8,phase_rad=0.9"),
        Some("asymmetric_friction:2:relative_asymmetry=0.2"),
        Some("payload:mass_kg=0.4,com_m=0.415 0 0.09"),
    ];
    for hidden in cases {
        let hidden: Vec<&str> = hidden.into_iter().collect();
        let campaign = recorded(&arm, 500.0, 8.0, &hidden);
        let (chain, closed) = (diagnosed(&campaign).report, diagnosed_in_closed_form(&campaign));
        assert_eq!(chain.verdict, closed.verdict, "{hidden:?}");
        let places = |report: &Report| -> Vec<(String, u8)> {
            report.causes.iter().map(|c| (c.effect.clone(), c.joint)).collect()
        };
        assert_eq!(places(&chain), places(&closed), "{hidden:?}");
        for (a, b) in chain.gap.with_effects_v.iter().zip(&closed.gap.with_effects_v) {
            assert!((a / b - 1.0).abs() < 0.2, "{hidden:?}: {:?} {:?}", chain.gap, closed.gap);
        }
    }
}
