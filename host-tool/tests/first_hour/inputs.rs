//! Inputs that nothing real has, each refused with the file, the place and the cure.

use std::path::Path;

use crate::rrr::{assert_tells, refused, rrr, with_model, write};
use test_support::PIVOT;

const STATES: &str = "q1_rad,q2_rad,q3_rad,qd1_rad_per_s,qd2_rad_per_s,qd3_rad_per_s,\
    qdd1_rad_per_s2,qdd2_rad_per_s2,qdd3_rad_per_s2\n0,0,0,0,0,0,0,0,0\n";
const LIST: &str =
    "format = 1\n[[log]]\nfile = \"a.csv\"\nexperiment = \"task\"\nrole = \"holdout\"\n";

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

/// What inverse dynamics says of `model.toml` with one text for another.
fn of_model(directory: &Path, from: &str, to: &str) -> String {
    let path = directory.join("model.toml");
    let whole = std::fs::read_to_string(&path).unwrap();
    assert!(whole.contains(from), "{whole}");
    std::fs::write(&path, whole.replacen(from, to, 1)).unwrap();
    let line = "inverse-dynamics --model model.toml states.csv --out out.csv";
    let text = refused(directory, &words(line));
    std::fs::write(&path, whole).unwrap();
    text
}

fn with_states() -> tempfile::TempDir {
    let directory = with_model();
    write(directory.path(), "states.csv", STATES);
    directory
}

#[test]
fn unknown_keys_of_a_model_are_refused() {
    let directory = with_states();
    for (from, to, key) in [
        ("[robot]", "[robot]\ngravity = 9.81", "gravity is not known in [robot]; known are name"),
        ("[base]", "[base]\nzz4r = 1", "zz4r is not known in [base]"),
        ("[[friction]]", "[[friction]]\nalpha0 = 1", "alpha0 is not known in [friction]"),
        ("[robot]", "[robots]\n[robot]", "robots is not known in the file"),
    ] {
        let text = of_model(directory.path(), from, to);
        assert_tells(&text, &["model.toml, line ", key, "hint: correct its name", "[notes]"]);
    }
}

#[test]
fn unknown_keys_of_an_arm_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    for (from, to) in [
        ("[robot]", "[robot]\ngravity = 9.81"),
        ("mass_kg = 0.6", "mass = 0.6"),
        ("limit_Nm", "limit_V"),
        ("alpha0_V", "alpha_V"),
        ("format = 2", "format = 2\narm = 1"),
    ] {
        write(directory.path(), "model.toml", &PIVOT.replacen(from, to, 1));
        let line = "simulate --model model.toml --dataset gap --out logs";
        let text = refused(directory.path(), &words(line));
        assert_tells(&text, &["model.toml, line ", " is not known in ", "known are"]);
    }
}

#[test]
fn unknown_keys_of_a_list_of_logs_are_refused() {
    let directory = with_model();
    for (from, to, part) in [
        ("format = 1", "format = 1\ncounts_per_rev = 4096", "line 2: counts_per_rev is not known"),
        ("role", "rôle = 1\nrole", "line 5"),
        ("role", "joints_used = [1]\nrole", "line 5: joints_used is not known in [log]"),
        ("[[log]]", "[columns]\nt_s = { colum = \"t\" }\n[[log]]", "line 3: unknown field `colum`"),
        ("[[log]]", "[stream.a]\n[[log]]", "stream is not known in the file"),
    ] {
        write(directory.path(), "logs/dataset.toml", &LIST.replacen(from, to, 1));
        for command in [
            "validate logs --model model.toml --out out",
            "diagnose logs --model model.toml --out out",
        ] {
            let text = refused(directory.path(), &words(command));
            assert_tells(&text, &["logs/dataset.toml, ", part]);
        }
    }
}

#[test]
fn unknown_keys_of_criteria_and_motions_are_refused() {
    let directory = with_model();
    let at = directory.path();
    write(at, "criteria.toml", "[prior]\nrelativ = 0.1\n");
    write(at, "logs/dataset.toml", LIST);
    let line = "diagnose logs --model model.toml --out out --criteria criteria.toml";
    assert_tells(&refused(at, &words(line)), &["criteria.toml, line 2", "relativ"]);
    write(at, "motion.toml", "format = 1\nfade_in = 1\n");
    let line = "simulate --model model.toml --dataset excitation --out o --excitation motion.toml";
    assert_tells(&refused(at, &words(line)), &["motion.toml, line 2: fade_in is not known"]);
}

#[test]
fn numbers_on_the_command_line_are_finite_and_in_range() {
    let directory = with_model();
    write(directory.path(), "logs/dataset.toml", LIST);
    let of = |line: &str| {
        for value in ["nan", "inf", "-inf", "1e999", "-1"] {
            let option = format!("{}={value}", line.rsplit(' ').next().unwrap());
            let mut words = words(line);
            words.pop();
            words.push(&option);
            let text = refused(directory.path(), &words);
            assert_tells(&text, &[option.split('=').next().unwrap()]);
        }
        assert!(!directory.path().join("out").exists(), "{line}");
    };
    of("simulate --model model.toml --dataset task --out out --noise-v");
    of("simulate-board --tcp 0 --noise-v");
    of("simulate-board --tcp 0 --speed");
    of("blind-trial --out out --duration-scale");
    of("blind-trial --out out --noise-mV");
    of("diagnose logs --model model.toml --out out --model-doubt");
    of("design-excitation --model model.toml --out out --seconds");
    of("demo --firmware none --out out --duration-s");
    of("run task --out out --approach-speed");
    of("export-block model.toml --out out.bin --command-limit-v");
}

#[test]
fn a_link_of_415_metres_is_refused() {
    let text = of_model(with_states().path(), "a3_m = 0.415", "a3_m = 415");
    assert_tells(&text, &["model.toml, line ", "a3_m is 415, but must be within 10 m"]);
    assert_tells(&text, &["hint: correct the value, in the unit that its name ends in"]);
}

#[test]
fn lengths_and_angles_of_an_arm_are_in_metres_and_radians() {
    let directory = tempfile::tempdir().unwrap();
    for (key, words_of) in [
        ("origin_xyz_m = [0, 0, 415]", "origin_xyz_m in [[joint]] 1 is 415"),
        ("origin_rpy_rad = [90, 0, 0]", "angles are in radians"),
    ] {
        write(directory.path(), "model.toml", &PIVOT.replacen("axis", &format!("{key}\naxis"), 1));
        let line = "simulate --model model.toml --dataset gap --out logs";
        assert_tells(&refused(directory.path(), &words(line)), &["line ", words_of]);
    }
}

#[test]
fn a_sample_period_of_zero_is_refused() {
    let directory = with_states();
    for (to, value) in [("0", "0"), ("-0.001", "-0.001"), ("1000", "1000")] {
        let line = format!("[robot]\nsample_period_s = {to}");
        let text = of_model(directory.path(), "[robot]", &line);
        assert_tells(&text, &[&format!("sample_period_s is {value}, but must be above 0")]);
    }
    write(directory.path(), "model.toml", &PIVOT.replace("= 0.002\n[[", "= 0\n[["));
    let line = "simulate --model model.toml --dataset gap --out logs";
    assert_tells(&refused(directory.path(), &words(line)), &["line 4: sample_period_s is 0"]);
}

#[test]
fn infinite_voltages_are_refused() {
    let directory = with_states();
    let at = directory.path();
    let text = of_model(at, "[robot]", "[robot]\ncommand_limit_V = inf");
    assert_tells(&text, &["line ", "`robot.command_limit_V = inf` is not a finite number"]);
    let text = of_model(at, "[robot]", "[robot]\ncommand_limit_V = 1e300");
    assert_tells(&text, &["command_limit_V is 1"]);
    write(at, "states.csv", &STATES.replace("0,0,0,0,0,0\n", "1e200,1e200,1e200,0,0,0\n"));
    let line = "inverse-dynamics --model model.toml states.csv --out out.csv";
    assert_tells(&refused(at, &words(line)), &["sample 1 of states.csv needs infinite"]);
    assert!(!at.join("out.csv").exists());
    let effect = "dac_offset:1:offset_V=inf";
    let line = ["simulate", "--model", "model.toml", "--dataset", "task", "--out", "o", "--effect"];
    assert_tells(&refused(at, &[&line[..], &[effect]].concat()), &["--effect", "offset_V"]);
    write(at, "logs/dataset.toml", LIST);
    write(at, "logs/a.csv", "t_s,q1_rad,u1_V,q2_rad,u2_V,q3_rad,u3_V\n0,0,inf,0,0,0,0\n");
    let line = "validate logs --model model.toml --out out";
    assert_tells(
        &refused(at, &words(line)),
        &["a.csv, line 2, column u1_V: `inf` is not a finite"],
    );
}

#[test]
fn hints_are_about_the_file_that_is_wrong() {
    let directory = with_states();
    let text = of_model(directory.path(), "a3_m = 0.415", "a3_m = nan");
    assert_tells(&text, &["hint: write a number"]);
    assert!(!text.contains("delete the lines"), "{text}");
    write(directory.path(), "model.toml", "");
    let line = "inverse-dynamics --model model.toml states.csv --out out.csv";
    let text = refused(directory.path(), &words(line));
    assert_tells(&text, &["model.toml: is empty", "hint: docs/files.md"]);
}

#[test]
fn columns_of_other_names_are_told_all_at_once_with_the_lines_that_map_them() {
    let directory = with_model();
    let log =
        "Zeit;Winkel_1_grad;Moment_1;Winkel_2_grad;Moment_2\n0,00;10,5;1;2;3\n0,01;20;1;2;3\n";
    write(directory.path(), "logs/a.csv", log);
    write(directory.path(), "logs/dataset.toml", LIST);
    let run = rrr(directory.path(), &words("validate logs --model model.toml --out out"));
    let text = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert_tells(&text, &["found in a.csv: Zeit, Winkel_1_grad, Moment_1", "needed: t_s, q1_rad"]);
    assert_tells(
        &text,
        &["t_s = \"Zeit\"", "q1_rad = { column = \"Winkel_1_grad\", unit = \"deg\""],
    );
}
