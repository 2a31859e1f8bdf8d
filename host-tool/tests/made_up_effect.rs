//! To add an effect is to write its definition and to put it into a catalogue: simulator,
//! diagnosis, model file, compensation, blind trial and documentation take it as it is.
#![allow(missing_docs)]

use blind_trial::{DrawSettings, Kind as CaseKind, draw, foreign};
use diagnosis::{Criteria, Value, Verdict, diagnose};
use files::RobotFile;
use rig::compensation::Compensations;
use rig::effects::{
    Catalogue, Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search,
    Size, Touches, documentation,
};

#[path = "common/short_campaign.rs"]
mod short_campaign;
use short_campaign::short_campaign;

static CUBIC_DRAG: Definition = Definition {
    name: "cubic_drag",
    words: "something drags with the cube of speed",
    equation: "u - b qd^3",
    whole_robot: false,
    parameters: &[Parameter::new("coefficient_V_s3_per_rad3", Kind::Coefficient, 0.0, 1.0)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| {
        vec![vec![0.1 * typical.friction_v / typical.speed_rad_per_s.powi(3)]]
    }),
    size: Size::grows(|typical| typical.friction_v / typical.speed_rad_per_s.powi(3)),
    draw: |_, random| vec![random.log_uniform(0.02, 0.05)],
    confused_with: &[Confusion::effect(
        "quadratic_drag",
        "over a small range of speeds a cube is nearly a square",
        "speeds ten times apart",
    )],
    compensation: Compensation::None("the board knows no drag but that of the square"),
    experiment: "`rrr run excitation` at speeds ten times apart",
    build: |joint, values| Box::new(CubicDrag { joint: usize::from(joint) - 1, b: values[0] }),
};

#[derive(Debug)]
struct CubicDrag {
    joint: usize,
    b: f64,
}

impl Effect for CubicDrag {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        voltage_v[self.joint] -= self.b * state.qd_rad_per_s[self.joint].powi(3);
    }
}

const COEFFICIENT: f64 = 0.03;

fn catalogue() -> Catalogue {
    Catalogue::standard().with(&CUBIC_DRAG)
}

#[test]
fn it_is_simulated_named_and_written_to_a_model_file() {
    let campaign = short_campaign(|| vec![CUBIC_DRAG.with(3, &[COEFFICIENT]).unwrap()]);
    let diagnosis = diagnose(&campaign, &catalogue(), &Criteria::default(), &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&diagnosis));
    let report = &diagnosis.report;
    let named: Vec<(&str, u8)> = report.causes.iter().map(|c| (&c.effect[..], c.joint)).collect();
    assert_eq!((report.verdict, &named[..]), (Verdict::Effect, &[("cubic_drag", 3)][..]));
    let Value::Number(found) = report.causes[0].parameters["coefficient_V_s3_per_rad3"] else {
        panic!("{:?}", report.causes[0]);
    };
    assert!((found / COEFFICIENT - 1.0).abs() < 0.05, "{found}");

    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.toml");
    diagnosis.model.write(&path).unwrap();
    let tables = RobotFile::read(&path).unwrap().effects;
    let (definition, values) = catalogue().definition_and_values(&tables[0]).unwrap();
    assert_eq!((definition.name, tables[0].joint, &values[..]), ("cubic_drag", 3, &[found][..]));
    catalogue().effect_of(&tables[0]).unwrap();
    assert!(Catalogue::standard().effect_of(&tables[0]).is_err(), "only this catalogue has it");
    let (_, left_out) = Compensations::of(&tables, &catalogue()).unwrap();
    assert!(left_out[0].to_string().contains("no drag but"), "{left_out:?}");
}

#[test]
fn it_is_drawn_for_a_blind_trial_and_documented() {
    let settings = DrawSettings {
        seed: 5,
        first: 1,
        cases: 1,
        kind: Some(CaseKind::Single),
        only: vec!["cubic_drag".into()],
        duration_scale: 0.3,
        noise_v: None,
    };
    let cases = draw(&settings, &catalogue(), &|| {}).unwrap();
    assert_eq!(cases[0].causes[0].effect, "cubic_drag");
    let page = documentation::markdown(&catalogue(), &Catalogue::of_arm(3));
    assert_eq!(page.matches("| `cubic_drag` |").count(), 3, "{page}");
}

/// What a hum adds to the command is bound to the acceleration that it makes by one phase, as by a delay.
#[test]
fn a_supply_that_hums_is_told_as_a_line_and_not_as_a_delay() {
    let hum = foreign::by_name("mains_hum").unwrap();
    let campaign = short_campaign(|| vec![(hum.build)(2, &[0.28, 11.3, 3.0])]);
    let standard = Catalogue::standard();
    let diagnosis = diagnose(&campaign, &standard, &Criteria::default(), &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&diagnosis));
    let report = &diagnosis.report;
    assert_eq!((report.verdict, report.causes.len()), (Verdict::Unknown, 0));
    let line = report.gap_shares.first().unwrap();
    assert_eq!((line.joint, line.detail.as_str()), (3, "a line at 11.3 Hz"));
    assert!(line.share > 0.7, "{line:?}");
}
