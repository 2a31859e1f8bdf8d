//! Files that belong to one log: states in one, commands in the other.

use std::path::Path;

use super::look::File;

/// Words of file names that tell states and commands apart.
const SIDES: [&str; 12] = [
    "joint_states",
    "states",
    "state",
    "measured",
    "feedback",
    "commands",
    "command",
    "cmds",
    "cmd",
    "actions",
    "action",
    "targets",
];

/// The name of the log that a file belongs to: its own without such words.
fn log_name(path: &Path) -> String {
    let mut name = path.with_extension("").to_string_lossy().to_lowercase();
    let start = name.rfind('/').map_or(0, |slash| slash + 1);
    for side in SIDES {
        if let Some(place) = name[start..].find(side) {
            name.replace_range(start + place..start + place + side.len(), "");
            break;
        }
    }
    name.trim_end_matches(['_', '-', '.', ' ']).to_owned()
}

/// The file among `others` that belongs to the same log.
pub(super) fn partner<'a>(file: &File, others: &'a [File]) -> Option<&'a File> {
    let name = log_name(&file.path);
    others.iter().find(|other| other.path != file.path && log_name(&other.path) == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_and_commands_of_a_run_belong_together() {
        assert_eq!(log_name(Path::new("a/run1_states.csv")), log_name(Path::new("a/run1_cmd.csv")));
        assert_eq!(log_name(Path::new("state-3.npz")), log_name(Path::new("command-3.npz")));
        assert_ne!(log_name(Path::new("run1_states.csv")), log_name(Path::new("run2_cmd.csv")));
    }
}
