//! Logs of other people's files, by a mapping in `dataset.toml`.

use std::path::Path;

use files::{ArmFile, ArmLog, Dataset, FileError, Log, Position};

/// A directory with a list and files of text.
struct Set(tempfile::TempDir);

impl Set {
    fn of(mapping: &str, files: &[(&str, &str)]) -> Self {
        let directory = tempfile::tempdir().unwrap();
        let first = files[0].0;
        let list = format!(
            "format = 1\n{mapping}\n[[log]]\nfile = \"{first}\"\nexperiment = \"task\"\nrole = \"train\"\n"
        );
        std::fs::write(directory.path().join("dataset.toml"), list).unwrap();
        for (name, text) in files {
            std::fs::write(directory.path().join(name), text).unwrap();
        }
        Self(directory)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn log(&self) -> Result<(Log, Vec<String>), FileError> {
        let recording = Dataset::read(self.path())?.recordings()?.remove(0);
        Ok((recording.log, recording.notes))
    }

    fn arm_log(&self, arm: &str) -> Result<(ArmLog, Vec<String>), FileError> {
        let dataset = Dataset::read(self.path())?;
        let arm = ArmFile::parse("model.toml", arm.into())?;
        let (file, view) = (&dataset.entries[0].file, dataset.mapping()?.view(0));
        ArmLog::read_mapped(self.path(), file, &view, &arm)
    }

    fn error(&self) -> String {
        self.log().unwrap_err().to_string()
    }
}

fn angles(log: &Log, joint: u8) -> &[f64] {
    match &log.joint(joint).unwrap().position {
        Position::Radian(angles) => angles,
        Position::Count(_) => panic!("counts"),
    }
}

const GERMAN: &str = "Zeit;Winkel_3;Spannung_3\nms;deg;mV\n0;180,0;500\n2;90,0;-250\n5;-90,0;0\n";

#[test]
fn units_signs_and_separators() {
    let mapping = "[columns]\nt_s = { column = \"Zeit\", unit = \"ms\" }\n\
        q3_rad = { column = \"Winkel_3\", unit = \"deg\", scale = -1, offset = 0.5 }\n\
        u3_V = { column = \"Spannung_3\", unit = \"mV\" }\n";
    let (log, notes) = Set::of(mapping, &[("run.csv", GERMAN)]).log().unwrap();
    assert_eq!(log.time_s, [0.0, 0.002, 0.005]);
    let pi = std::f64::consts::PI;
    assert_eq!(angles(&log, 3), [0.5 - pi, 0.5 - pi / 2.0, 0.5 + pi / 2.0]);
    assert_eq!(log.joint(3).unwrap().command_v, [0.5, -0.25, 0.0]);
    assert!(notes.is_empty(), "{notes:?}");
}

#[test]
fn one_message_has_what_was_found_what_is_needed_and_what_to_write() {
    let message = Set::of("", &[("run.csv", GERMAN)]).error();
    for part in [
        "run.csv: the column t_s is missing",
        "found in run.csv: Zeit, Winkel_3, Spannung_3",
        "needed: t_s, q1_rad (or q1_count), u1_V",
        "[columns]",
        "t_s = { column = \"Zeit\", unit = \"ms\" }",
        "q3_rad = { column = \"Winkel_3\", unit = \"deg\" }",
        "u3_V = \"Spannung_3\"",
    ] {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}

const TWO: &str = "format = 2\n[robot]\n[[joint]]\nkind = \"revolute\"\naxis = [0, 0, 1]\n\
    [joint.drive]\nkind = \"torque\"\n[[joint]]\nkind = \"revolute\"\naxis = [0, 0, 1]\n\
    [joint.drive]\nkind = \"torque\"\n";

#[test]
fn all_that_an_arm_lacks_is_said_at_once() {
    let set = Set::of("", &[("run.csv", "time,j0,j1,tau_0\n0,0,0,0\n0.1,0,0,0\n")]);
    let message = set.arm_log(TWO).unwrap_err().to_string();
    for part in [
        "the columns t_s, q1_rad (or q1_count), u1_Nm, q2_rad (or q2_count), u2_Nm are missing",
        "found in run.csv: time, j0, j1, tau_0",
        "t_s = \"time\"",
        "u1_Nm = \"tau_0\"",
        "q2_rad = { column = \"..\", unit = \"rad\" }",
    ] {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}

#[test]
fn a_mapping_that_cannot_be_is_refused_with_its_line() {
    let cases = [
        (
            "[columns]\nq1_deg = \"a\"\n",
            "dataset.toml, line 3: q1_deg in [columns] is no column of a log",
        ),
        (
            "[columns]\nu1_V = { column = \"a\", unit = \"Nm\" }\n",
            "dataset.toml, line 3: u1_V takes the units V, mV, not \"Nm\"; a command in another unit",
        ),
        ("[columns]\nu1_V = { colum = \"a\" }\n", "dataset.toml, line 3: unknown field `colum`"),
        (
            "[columns]\nu1_V = 3\n",
            "line 3: invalid type: integer `3`, expected the name of a column",
        ),
        ("[columns]\nu1_V = { column = \"a\", unsigned = true }\n", "u1_V is marked unsigned"),
        ("[streams.x]\nclock = \"mine\"\n", "dataset.toml, line 3: unknown variant `mine`"),
    ];
    for (mapping, expected) in cases {
        let message = Set::of(mapping, &[("run.csv", GERMAN)]).error();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn what_is_mapped_and_not_there_is_named() {
    let mapping = "[columns]\nt_s = \"Zeit\"\nq3_rad = \"Winkel_4\"\nu3_V = \"Spannung_3\"\n";
    let message = Set::of(mapping, &[("run.csv", GERMAN)]).error();
    assert!(message.contains("the column Winkel_4 (for q3_rad) is missing"), "{message}");
}

/// States at 100 Hz and commands at 250 Hz, of a second.
fn states_and_commands(clock_s: f64, seen_late_s: f64) -> [(&'static str, String); 2] {
    let wave = |t: f64| 2.0 * (7.0 * t).sin() + (23.0 * t).cos() + 0.5 * (61.0 * t).sin();
    let mut states = "t,q,u_seen\n".to_owned();
    for k in 0..400 {
        let t = f64::from(k) * 0.01;
        states += &format!("{t:.3},{:.6},{:.6}\n", t.sin(), wave(t - seen_late_s));
    }
    let mut commands = "stamp,u\n".to_owned();
    for k in 0..1050 {
        let t = f64::from(k) * 0.004 - 0.1;
        commands += &format!("{:.3},{:.6}\n", t + clock_s, wave(t));
    }
    [("states.csv", states), ("commands.csv", commands)]
}

const STREAMS: &str = "[columns]\nt_s = \"t\"\nq1_rad = \"q\"\n\
    u1_V = { stream = \"sent\", column = \"u\", copy = \"u_seen\" }\n[streams.sent]\n\
    file = \"commands.csv\"\ntime = \"stamp\"\n";

fn with_streams(more: &str, clock_s: f64, late_s: f64) -> (Log, Vec<String>) {
    let files = states_and_commands(clock_s, late_s);
    let files = files.each_ref().map(|(name, text)| (*name, text.as_str()));
    Set::of(&format!("{STREAMS}{more}"), &files).log().unwrap()
}

#[test]
fn streams_of_other_rates_are_put_together_and_their_lag_is_told() {
    let (log, notes) = with_streams("", 0.0, 0.013);
    assert_eq!(log.len(), 400);
    let notes = notes.join("\n");
    assert!(notes.contains("250.0 Hz put onto the log's 100.0 Hz"), "{notes}");
    // The command is held for 4 ms, so the copy of its wave is seen 2 ms sooner than it was late.
    let told: f64 =
        notes.split("u1_V is seen ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((told - 11.0).abs() < 2.1, "{notes}");
}

#[test]
fn clocks_that_differ_are_set_right_by_a_copy() {
    let (same, _) = with_streams("", 0.0, 0.0);
    let (set_right, notes) = with_streams("clock = \"own\"\n", 12.345, 0.0);
    let notes = notes.join("\n");
    assert!(notes.contains("its clock is -12.34"), "{notes}");
    let [a, b] = [same, set_right].map(|log| log.joint(1).unwrap().command_v.clone());
    let worst = a.iter().zip(&b).skip(5).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // The two milliseconds that nothing tells apart, at the slope of the command.
    assert!(worst < 0.3, "{worst}");
}

#[test]
fn clocks_without_time_in_common_are_refused() {
    let files = states_and_commands(100.0, 0.0);
    let files = files.each_ref().map(|(name, text)| (*name, text.as_str()));
    let message = Set::of(STREAMS, &files).error();
    assert!(message.contains("no time in common"), "{message}");
}

#[test]
fn rows_of_an_episode_and_rows_without_numbers() {
    let text = "episode,t,q,u\n0,0,1,1\n0,0.1,2,1\n1,0,3,5\n1,0.1,,5\n1,0.1,4,6\n1,0.1,4,6\n";
    let mapping = "[columns]\nt_s = \"t\"\nq1_rad = \"q\"\nu1_V = \"u\"\n";
    let directory = Set::of(mapping, &[("run.csv", text)]);
    let list = directory.path().join("dataset.toml");
    let with_rows = std::fs::read_to_string(&list).unwrap() + "rows = { episode = 1 }\n";
    std::fs::write(&list, with_rows).unwrap();
    let recording = Dataset::read(directory.path()).unwrap().recordings().unwrap().remove(0);
    assert_eq!(recording.entry.file, "run.csv (episode 1)");
    assert_eq!(angles(&recording.log, 1), [3.0, 4.0]);
    assert_eq!(
        recording.notes,
        [
            "rows that lack a number were left out: 1",
            "rows that repeat the time before them were left out: 1"
        ]
    );
}

#[test]
fn torques_without_a_sign_or_in_steps_are_told() {
    let arm = TWO.split("[[joint]]").take(2).collect::<Vec<_>>().join("[[joint]]");
    let mapping = "[columns]\ntau1_Nm = { column = \"load\", unsigned = true }\n\
        u1_Nm = { column = \"u\", step = 0.05 }\n";
    let set = Set::of(mapping, &[("run.csv", "t_s,q1_rad,u,load\n0,0,1,2\n0.1,0,1,2\n")]);
    let (log, notes) = set.arm_log(&arm).unwrap();
    assert_eq!((&log.joints[0].torque, &log.joints[0].command), (&None, &vec![1.0, 1.0]));
    let notes = notes.join("\n");
    assert!(notes.contains("tau1_Nm lacks its sign and is not used"), "{notes}");
    assert!(notes.contains("u1_Nm comes in steps of 0.05 Nm"), "{notes}");
}
