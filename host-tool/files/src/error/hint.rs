//! What to do about each problem, as a table.

use std::path::Path;

use super::problem::Problem;

/// One line a problem: what to do about it in a log, and in a TOML file where that is another thing.
macro_rules! hints {
    ($($problem:pat => $log:literal $(, toml: $toml:literal)?;)*) => {
        /// What to do, in a log and in a TOML file.
        fn hints(problem: &Problem) -> (&'static str, Option<&'static str>) {
            use Problem::*;
            match problem { $($problem => ($log, None$(.or(Some($toml)))?),)* }
        }
    };
}

hints! {
    Missing => "check the path for a typing error";
    Unreadable(_) => "check that it is a file and that you may read it";
    Unwritable(_) => "check that the directory exists, has room, and that you may write there";
    UnknownExtension | UnknownTable => "rename the file to what it holds";
    Damaged { .. } => "fetch or record the file again, or export it anew";
    NoTopic(_) =>
        "record the joints' states and commands; `ros2 bag convert` makes MCAP of other storages";
    NoTables(_) => "give the file or folder of the logs";
    Unmapped(_) =>
        "write such lines into dataset.toml, or let `rrr import` write them; docs/imports.md has each key";
    BrokenGzip(_) => "fetch or record the file again; `gzip -t` tests it";
    NotUtf8(_) => "export the file as plain UTF-8 text";
    Empty => "record the file again: it needs at least one sample",
        toml: "docs/files.md has an example of each file";
    NoSamples => "record the file again: it needs at least one sample";
    MissingColumn(_) => "add the column, or correct its name in the header";
    RepeatedColumn => "keep one of the two columns";
    BothPositions(_) => "keep q_count or q_rad, not both";
    NoJoint => "give each joint q1_count (or q1_rad) and u1_V, likewise 2 and 3";
    MoreJoints { .. } =>
        "give the model of that arm; or, if the others stood still, write `joints = [1, 2, 3]`, say, into \
         dataset.toml before the first [table], or leave their columns away";
    FieldCount { .. } => "complete the line or delete it; fields are split by commas";
    NotANumber(_) => "write the value as a decimal number with a point, as in -0.125";
    NotFinite(_) => "delete the lines without a value; gaps in time are allowed",
        toml: "write a number; where none is known, delete the key, if docs/files.md says that it may be absent";
    NotACount(_) => "write whole counts, or name the column q_rad and use radians";
    TimeNotIncreasing { .. } => "sort the lines by t_s and delete repeated ones";
    NegativeTime(_) => "let the time begin at 0, or write .csv";
    UnequalLength { .. } => "give every column one value per time";
    BrokenMcap(_) => "fetch or record the file again; `mcap doctor` tests it";
    BrokenMessage { .. } => "record it again, or convert it to .csv and correct it";
    Toml(_) => "correct the line; strings stand in quotes, numbers do not";
    Setting(_) => "`rrr diagnose --print-criteria` prints every key with its meaning and default";
    UnknownFormat(_) => "update the tool, or write the file with `format = 1`";
    ArmOfAnyKind =>
        "`rrr identify`, `diagnose`, `simulate` and `inverse-dynamics` take it; this command is for the robot \
         of three joints: give a robot.toml or model.toml with `format = 1`";
    UnknownKey(_) =>
        "correct its name, with the unit, or delete the line; what is for people may stand under [notes]";
    Urdf(_) => "correct the URDF, or write the joints into the file without `urdf`";
    MissingParameter(_) => "add it to the file; docs/files.md has every key";
    Parameter(_) => "correct the value in the file";
    RecordedLogs(_) => "give another --out: a folder of its own for simulated logs";
    Contradiction(_) => "correct one of the two";
    OutOfRange(_) => "correct the value, in the unit that its name ends in; docs/files.md has every range";
}

/// What the user can do about a problem of a file.
pub(super) fn hint(problem: &Problem, path: &Path) -> &'static str {
    let (log, toml) = hints(problem);
    let is_toml = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    toml.filter(|_| is_toml).unwrap_or(log)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_without_a_number_is_not_told_to_delete_lines_of_a_log() {
        let problem = Problem::NotFinite("nan".into());
        assert!(hint(&problem, Path::new("model.toml")).contains("delete the key"));
        assert!(hint(&problem, Path::new("run.csv")).contains("delete the lines"));
    }
}
