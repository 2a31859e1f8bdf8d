//! A controller that knows an effect tracks as if the effect were not there.
#![allow(missing_docs)]

use files::EffectTable;
use firmware::Mode;
use model::reference_robot::reference_robot;
use recordings::tracking::Tracking;
use rig::Rig;
use rig::compensation::Compensations;
use rig::effects::Catalogue;
use rig::plan::{Plan, excitation, slow, task};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

/// Root mean square tracking error of each joint [mrad], on a robot with these effects.
fn errors_mrad(rig: &Rig, plan: &Plan, effects: &[EffectTable]) -> [f64; 3] {
    let block = plan.block(rig);
    let settings = Settings::default();
    let effects =
        effects.iter().map(|table| Catalogue::standard().effect_of(table).unwrap()).collect();
    let robot = SimulatedRobot::with_effects(rig.model, effects, start_of(&block), &settings);
    let mut board = InProcess::default();
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    let tracking = Tracking::of(&recording.log, f64::from(rig.encoder_counts_per_turn));
    [0, 1, 2].map(|i| 1e3 * tracking[i].rms_rad())
}

fn rig() -> Rig {
    Rig::new(reference_robot())
}

fn rig_for(effects: &[EffectTable]) -> Rig {
    let (compensations, left_out) = Compensations::of(effects, &Catalogue::standard()).unwrap();
    assert_eq!(left_out, []);
    rig().with_compensations(compensations)
}

/// Errors without the effects, with them, and with them known [mrad].
fn before_and_after(plan: &Plan, effects: &[EffectTable]) -> [[f64; 3]; 3] {
    [
        errors_mrad(&rig(), plan, &[]),
        errors_mrad(&rig(), plan, effects),
        errors_mrad(&rig_for(effects), plan, effects),
    ]
}

fn tables(texts: &[&str]) -> Vec<EffectTable> {
    texts.iter().map(|text| rig::effects::table_from_text(text).unwrap()).collect()
}

fn length(errors: &[f64; 3]) -> f64 {
    errors.iter().map(|e| e * e).sum::<f64>().sqrt()
}

const EFFECTS: [&str; 12] = [
    "torque_constant:2:relative_error=0.1",
    "position_friction:2:relative_amplitude=0.4,harmonic=3,phase_rad=0.7",
    "cogging:3:amplitude_V=0.15,harmonic=8,phase_rad=0.9",
    "torque_ripple:2:relative_amplitude=0.1,harmonic=12,phase_rad=-1.0",
    "payload:mass_kg=0.5",
    "tip_force:force_N=2 -3 1",
    "base_tilt:tilt_x_rad=0.05,tilt_y_rad=-0.04,hidden_moment_reach_kg_m=0.2,hidden_moment_side_kg_m=0.3",
    "asymmetric_friction:1:relative_asymmetry=0.3",
    "cable_spring:2:stiffness_V_per_rad=0.2,rest_rad=1.0",
    "dac_offset:1:offset_V=0.1",
    "dead_zone:3:half_width_V=0.1",
    "quadratic_drag:1:coefficient_V_s2_per_rad2=0.02",
];

/// Known, an effect costs at most this factor in tracking error.
const FACTOR: f64 = 1.1;
/// Unknown, it costs more than this factor on the motion (20)-(21).
const WORTH_KNOWING: f64 = 10.0;

/// Checks and prints a row: error without the effects, with them, and with them known.
fn assert_undone(name: &str, plan: &Plan, effects: &[EffectTable]) {
    let [without, with, known] = before_and_after(plan, effects).map(|errors| length(&errors));
    println!("{name:20} {:12} {without:8.4} {with:8.4} {known:8.4}", plan.name);
    assert!(known < FACTOR * without, "{name}, {}: {known} mrad, {without} without", plan.name);
    if plan.name == "task" {
        assert!(with > WORTH_KNOWING * known, "{name}: {with} mrad, {known} if known");
    }
}

fn plans() -> [Plan; 3] {
    [task(10.0), excitation(2, 10.0), slow(20.0)].map(|plan| plan.with_mode(Mode::PdModel))
}

#[test]
fn an_effect_that_is_known_is_as_good_as_absent() {
    println!(
        "{:20} {:12} {:>8} {:>8} {:>8} [mrad]",
        "effect", "motion", "without", "with", "known"
    );
    for text in EFFECTS {
        let name = text.split(':').next().unwrap();
        plans().iter().for_each(|plan| assert_undone(name, plan, &tables(&[text])));
    }
}

/// Friction of another form below 0.2 rad/s: 0.05 V too much there.
const SLOW_FRICTION: &str =
    "table:2:axis=velocity,knots=-0.2 -0.1 -0.02 0.02 0.1 0.2,values_V=0 0.05 0.05 -0.05 -0.05 0";

#[test]
fn a_table_that_is_known_is_as_good_as_absent() {
    let over = [
        ("over velocity", SLOW_FRICTION),
        ("over position", "table:2:axis=position,knots=-3 -2 -1.2 0,values_V=0 0.1 -0.1 0"),
        ("over load", "table:3:axis=load,knots=-2 -1 0 1 2,values_V=-0.1 0.05 0 0.05 0.1"),
    ];
    for (name, text) in over {
        for plan in plans() {
            let [without, with, known] =
                before_and_after(&plan, &tables(&[text])).map(|errors| length(&errors));
            println!("{name:20} {:12} {without:8.4} {with:8.4} {known:8.4}", plan.name);
            assert!(known < 1.05 * without, "{name}, {}: {known} {without} mrad", plan.name);
            let worth_knowing = plan.name != "task" || with > 2.0 * known;
            assert!(worth_knowing, "{name}: {with} mrad, {known} if known");
        }
    }
}

#[test]
fn all_effects_at_once_are_undone() {
    plans().iter().for_each(|plan| assert_undone("all twelve", plan, &tables(&EFFECTS)));
}

#[test]
fn what_befalls_a_command_is_undone_in_the_right_order() {
    let on_joint_2 = [
        "dac_offset:2:offset_V=0.3",
        "torque_ripple:2:relative_amplitude=0.3,harmonic=6,phase_rad=0.2",
        "dead_zone:2:half_width_V=0.2",
        "torque_constant:2:relative_error=-0.2",
    ];
    let mut effects = tables(&on_joint_2);
    for _ in 0..4 {
        effects.rotate_left(1);
        assert_undone("four on a command", &plans()[0], &effects);
    }
}

#[test]
fn the_friction_of_a_place_is_undone_without_the_model_too() {
    let effects = tables(&["position_friction:1:relative_amplitude=0.6,harmonic=2,phase_rad=0.7"]);
    let plan = slow(20.0).with_mode(Mode::PdFriction);
    let [without, with, known] = before_and_after(&plan, &effects).map(|errors| errors[0]);
    println!("friction alone: {without:.4} {with:.4} {known:.4} mrad");
    assert!((known / without - 1.0).abs() < 0.01 && with > 1.1 * without);
}

/// What an estimate of an effect leaves is a share of the effect, not more.
#[test]
fn an_effect_known_to_a_tenth_leaves_a_tenth() {
    for text in EFFECTS {
        let effects = tables(&[text]);
        let mut estimated = effects.clone();
        let (name, value) = estimated[0].parameters.iter().next().unwrap();
        let (name, Some(value)) = (name.clone(), value.as_float()) else { continue };
        estimated[0].parameters.insert(name, (1.1 * value).into());
        let plan = &plans()[0];
        let with = length(&errors_mrad(&rig(), plan, &effects));
        let known = length(&errors_mrad(&rig_for(&estimated), plan, &effects));
        println!("{text}: {with:.4} {known:.4} mrad");
        assert!(known < 0.25 * with, "{text}: {with} {known}");
    }
}
