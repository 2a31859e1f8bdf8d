//! The exit statuses of every command, once, for the help and the documentation.

/// The command did what was asked.
pub const DONE: u8 = 0;
/// The command did its work, and the result does not pass.
pub const NOT_PASSED: u8 = 1;
/// Bad input, of clap's as well, and whatever else went wrong.
pub const BAD_INPUT: u8 = 2;
/// After Ctrl-C, by custom 128 and the signal's number.
pub const INTERRUPTED: u8 = 130;

/// Each status with its meaning.
pub const STATUSES: [(u8, &str); 4] = [
    (DONE, "done; of `diagnose` whatever the verdict, which is in its report"),
    (
        NOT_PASSED,
        "done, and the result does not pass: `validate` has more left of a command than its limits allow, \
         `identify` has found a model that no robot has, and written it elsewhere",
    ),
    (
        BAD_INPUT,
        "bad input or whatever else went wrong: the message says where and what to do; nothing half-written \
         is left behind; `run` also after a fault of the board",
    ),
    (INTERRUPTED, "ended by Ctrl-C"),
];

/// The statuses as lines of help.
pub fn help() -> String {
    let line = |(status, meaning): &(u8, &str)| format!("  {status:3}  {meaning}\n");
    format!("Exit status:\n{}", STATUSES.iter().map(line).collect::<String>())
}

/// The statuses as a table of the documentation.
pub fn markdown() -> String {
    let row = |(status, meaning): &(u8, &str)| format!("| {status} | {meaning} |\n");
    let rows: String = STATUSES.iter().map(row).collect();
    format!("| status | meaning |\n| --- | --- |\n{rows}")
}
