//! The loop closed: a robot with hidden effects is recorded and diagnosed, and the firmware
//! tracks with the amended model as if it had always known.
#![allow(missing_docs)]

use std::path::Path;

use blind_trial::Rng;
use blind_trial::robots::nominal_model;
use diagnosis::fit::gauss_newton::fit_held;
use diagnosis::fit::preparation::prepared;
use diagnosis::logs::lost_samples::stretches_of;
use diagnosis::logs::subject::Subject;
use diagnosis::{Criteria, Diagnosis, Verdict, diagnose};
use files::{EffectTable, Log, RobotFile};
use firmware::Mode;
use host_tool::commands::diagnose::{MODEL, write};
use model::Robot;
use model::reference_robot::reference_robot;
use recordings::tracking::Tracking;
use recordings::{Campaign, Trace};
use rig::compensation::Compensations;
use rig::effects::Catalogue;
use rig::plan::{excitation, task};
use rig::{Plan, Recipe, Rig};
use signal::rms;
use simulation::board::{Board, InProcess};
use simulation::{Settings, SimulatedRobot, record_robot, start_of};
use tests::{image, qemu, simulated, tables};

/// A robot with effects; what is written of it is a model that is 2 % off and knows none.
struct Case {
    effects: Vec<EffectTable>,
    nominal: Robot<f64>,
}

impl Case {
    fn new(effects: &[&str]) -> Self {
        let nominal = nominal_model(&reference_robot(), &mut Rng::new(1, 2));
        Self { effects: tables(effects), nominal }
    }

    /// What a board of this rig makes the robot do.
    fn record(&self, board: &mut dyn Board, rig: &Rig, plan: &Plan, seed: u64) -> Log {
        let settings = Settings { seed, ..Settings::default() };
        recorded(board, rig, plan, reference_robot(), &self.effects, &settings)
    }

    /// The recipe `gap`, with the nominal model.
    fn campaign(&self) -> Campaign {
        let rig = Rig::new(self.nominal);
        let plans = Recipe::by_name("gap").unwrap().plans(&rig, 1);
        let counts = f64::from(rig.encoder_counts_per_turn);
        let trace = |(plan, seed): (&Plan, u64)| {
            let log = self.record(&mut InProcess::default(), &rig, plan, seed);
            Trace::of_log(log, plan.entry("csv"), counts)
        };
        let traces = plans.iter().zip(1..).map(trace).collect();
        let file = RobotFile::from_robot(&self.nominal);
        Campaign::new(file, Some(counts), traces).unwrap()
    }

    /// Tracking errors of the joints on the motion (20)-(21) with the model, rms [mrad].
    fn errors_mrad(&self, board: &mut dyn Board, rig: &Rig) -> [f64; 3] {
        let plan = task(20.0).with_mode(Mode::PdModel);
        let log = self.record(board, rig, &plan, 9);
        let tracking = Tracking::of(&log, f64::from(rig.encoder_counts_per_turn));
        [0, 1, 2].map(|joint| 1e3 * tracking[joint].rms_rad())
    }

    /// How far a simulated robot of this model moves from where the robot does, both behind
    /// the same controller without a model, on the motion held out, rms [mrad].
    fn motion_gap_mrad(&self, model: Robot<f64>, effects: &[EffectTable]) -> [f64; 3] {
        let rig = Rig::new(self.nominal);
        let quiet = Settings { noise_v: 0.0, ..Settings::default() };
        let moved = |robot, effects: &[EffectTable]| {
            let plan = excitation(2, 10.0);
            let log = recorded(&mut InProcess::default(), &rig, &plan, robot, effects, &quiet);
            let angles = |joint: usize| {
                log.joints[joint].position_rad(f64::from(rig.encoder_counts_per_turn))
            };
            [0, 1, 2].map(angles)
        };
        let (real, twin) = (moved(reference_robot(), &self.effects), moved(model, effects));
        [0, 1, 2].map(|joint| {
            let apart: Vec<f64> =
                real[joint].iter().zip(&twin[joint]).map(|(a, b)| 1e3 * (a - b)).collect();
            rms(&apart)
        })
    }
}

fn recorded(
    board: &mut dyn Board,
    rig: &Rig,
    plan: &Plan,
    robot: Robot<f64>,
    effects: &[EffectTable],
    settings: &Settings,
) -> Log {
    let block = plan.block(rig);
    let robot = SimulatedRobot::with_effects(robot, simulated(effects), start_of(&block), settings);
    record_robot(board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap().log
}

/// The model retuned to the same logs within its doubt, without any effect.
fn refitted(campaign: &Campaign) -> Robot<f64> {
    let subject = Subject::of(campaign, &Catalogue::standard(), &Criteria::default()).unwrap();
    let logs = campaign.traces.iter().enumerate();
    let stretches = logs.flat_map(|(log, trace)| stretches_of(trace, log, &subject)).collect();
    let (_, free) = prepared(&subject, stretches, None).unwrap();
    let held = fit_held(&free.evidence, &subject, &free.linear).unwrap();
    held.hypothesis.plant.as_robot().unwrap()
}

/// The amended model, through its file.
fn amended(diagnosis: &Diagnosis, name: &str) -> RobotFile {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    write(diagnosis, &directory, &Default::default()).unwrap();
    RobotFile::read(directory.join(MODEL)).unwrap()
}

/// Errors with the nominal model, retuned, and amended; of the motion, likewise.
struct Found {
    diagnosis: Diagnosis,
    tracking_mrad: [[f64; 3]; 3],
    motion_mrad: [[f64; 3]; 3],
}

fn found(case: &Case, board: &mut dyn Board, name: &str) -> Found {
    let campaign = case.campaign();
    let diagnosis =
        diagnose(&campaign, &Catalogue::standard(), &Criteria::default(), &|_| ()).unwrap();
    let file = amended(&diagnosis, name);
    let (compensations, left_out) =
        Compensations::of(&file.effects, &Catalogue::standard()).unwrap();
    assert_eq!(left_out, []);
    let refitted = refitted(&campaign);
    let knowing = Rig::of_file(&file).unwrap().with_compensations(compensations);
    let tracking_mrad = [Rig::new(case.nominal), Rig::new(refitted), knowing]
        .map(|rig| case.errors_mrad(board, &rig));
    let motion_mrad = [
        case.motion_gap_mrad(case.nominal, &[]),
        case.motion_gap_mrad(refitted, &[]),
        case.motion_gap_mrad(file.robot().unwrap(), &file.effects),
    ];
    println!(
        "{name}\njoint  tracking: nominal refitted amended; motion: nominal refitted amended [mrad]"
    );
    for joint in 0..3 {
        let [a, b, c] = tracking_mrad.map(|errors| errors[joint]);
        let [d, e, f] = motion_mrad.map(|errors| errors[joint]);
        println!("{}  {a:9.4} {b:9.4} {c:9.4}  {d:9.4} {e:9.4} {f:9.4}", joint + 1);
    }
    let gap = &diagnosis.report.gap;
    let drift = [&gap.refitted_rad, &gap.with_effects_rad].map(|all| all.iter().map(|e| 1e3 * e));
    let [before, after] = drift.map(Iterator::collect::<Vec<f64>>);
    println!("drift [mrad]: refitted {before:.4?}, amended {after:.4?}");
    Found { diagnosis, tracking_mrad, motion_mrad }
}

impl Found {
    /// Asserts what is named.
    fn names(&self, causes: &[(&str, u8)]) {
        let report = &self.diagnosis.report;
        assert_eq!(report.verdict, Verdict::Effect);
        let mut named: Vec<_> =
            report.causes.iter().map(|c| (c.effect.as_str(), c.joint)).collect();
        named.sort_unstable();
        assert_eq!(named, causes);
    }

    /// Asserts that a joint's errors shrink so many times, against the nominal model and
    /// against the model retuned without effects, and that little is left of its tracking.
    fn shrinks(&self, joint: usize, times: f64) {
        let gap = &self.diagnosis.report.gap;
        let drift = [gap.refitted_rad[joint - 1], gap.with_effects_rad[joint - 1]];
        assert!(drift[1] < drift[0] / times, "joint {joint}: drift {drift:?} rad");
        for errors in [self.tracking_mrad, self.motion_mrad] {
            let [nominal, retuned, amended] = errors.map(|errors| errors[joint - 1]);
            let most = nominal.min(retuned) / times;
            assert!(amended < most, "joint {joint}: {nominal} {retuned} {amended} mrad");
        }
        // That of an exact model, a count or two.
        assert!(self.tracking_mrad[2][joint - 1] < 0.03, "{:?}", self.tracking_mrad);
    }

    /// The part of a joint's gap that the report says to stay once tables are in the model, of voltages above noise.
    fn told_to_stay(&self, joint: usize) -> f64 {
        let gap = &self.diagnosis.report.gap;
        let above_noise = |left_v: &[f64]| {
            (left_v[joint - 1].powi(2) - gap.noise_floor_v[joint - 1].powi(2)).max(0.0).sqrt()
        };
        above_noise(&gap.with_tables_v) / above_noise(&gap.refitted_v)
    }

    /// Asserts that of a joint's errors with the model retuned that part stays which the report says, give or take a factor.
    fn shrinks_as_told(&self, joint: usize, factor: f64) {
        let told = self.told_to_stay(joint);
        for errors in [self.tracking_mrad, self.motion_mrad] {
            let [_, retuned, amended] = errors.map(|errors| errors[joint - 1]);
            let stays = amended / retuned;
            println!("joint {joint}: {stays:.3} stays, {told:.3} was told");
            assert!(stays < factor * told && stays > told / factor, "{stays} stays, not {told}");
        }
    }
}

#[test]
fn cogging_and_asymmetric_friction_are_found_and_made_up_for_in_qemu() {
    let Some(image) = image() else { return };
    let case = Case::new(&[
        "asymmetric_friction:1:relative_asymmetry=0.3",
        "cogging:3:amplitude_V=0.15,harmonic=8,phase_rad=0.9",
    ]);
    let found = found(&case, &mut qemu(&image), "cogging-and-asymmetric-friction");
    found.names(&[("asymmetric_friction", 1), ("cogging", 3)]);
    found.shrinks(1, 40.0);
    found.shrinks(3, 100.0);
}

#[test]
fn a_payload_is_found_and_made_up_for_in_qemu() {
    let Some(image) = image() else { return };
    let case = Case::new(&["payload:mass_kg=0.5"]);
    let found = found(&case, &mut qemu(&image), "payload");
    found.names(&[("payload", 0)]);
    found.shrinks(2, 40.0);
    found.shrinks(3, 200.0);
}

/// Detents at two places of joint 3, of no effect's shape, and friction of joint 1 that has a hump over velocity.
#[test]
fn what_has_no_name_becomes_tables_that_make_up_for_it_in_qemu() {
    let Some(image) = image() else { return };
    let case = Case::new(&[
        "table:3:axis=position,knots=-4 -1.4 -1 -0.6 0.2 0.5 0.8 4,values_V=0 0 0.25 0 0 -0.2 0 0",
        "table:1:axis=velocity,knots=-9 -3 -1.5 -0.3 0.3 1.5 3 9,values_V=0 0 -0.2 0 0 0.2 0 0",
    ]);
    let found = found(&case, &mut qemu(&image), "tables");
    found.shrinks_as_told(1, 1.5);
    found.shrinks_as_told(3, 1.5);
}
