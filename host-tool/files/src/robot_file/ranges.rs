//! What the numbers of a robot file may be: beyond these nothing real is, and a unit was mistaken.

use super::RobotFile;
use crate::error::{FileError, Problem};

/// A key of `[robot]`, its least and largest value, and what a mistake would be.
struct Range {
    key: &'static str,
    least: f64,
    most: f64,
    words: &'static str,
}

/// Longest link of an arm [m].
pub(crate) const LONGEST_LINK_M: f64 = 10.0;
/// Shortest and longest time between samples [s]: a microsecond is beyond all drives, ten seconds
/// beyond all motion.
pub(crate) const SAMPLE_PERIOD_S: [f64; 2] = [1e-6, 10.0];
/// Strongest gravity [m/s^2]: ten times that of the earth.
pub(crate) const STRONGEST_GRAVITY_M_S2: f64 = 98.1;

const LENGTH: &str = "be within 10 m either way: lengths are in metres";

const fn length(key: &'static str) -> Range {
    Range { key, least: -LONGEST_LINK_M, most: LONGEST_LINK_M, words: LENGTH }
}

const RANGES: [Range; 9] = [
    Range {
        key: "gravity_m_s2",
        least: 0.0,
        most: STRONGEST_GRAVITY_M_S2,
        words: "be from 0 to 98.1 m/s^2",
    },
    length("d1_m"),
    length("d2_m"),
    length("a2_m"),
    length("d3_m"),
    length("a3_m"),
    Range {
        key: "encoder_counts_per_rev",
        least: 1.0,
        most: 1e12,
        words: "be from 1 to 1e12 counts",
    },
    Range {
        key: "sample_period_s",
        least: SAMPLE_PERIOD_S[0],
        most: SAMPLE_PERIOD_S[1],
        words: "be above 0, from 0.000001 to 10 s",
    },
    Range {
        key: "command_limit_V",
        least: 1e-6,
        most: 1e6,
        words: "be above 0, from 0.000001 to 1000000",
    },
];

impl RobotFile {
    /// Checks every number of `[robot]` that has a range.
    pub(super) fn check_ranges(&self) -> Result<(), FileError> {
        let robot = &self.robot;
        let values = [
            robot.gravity_m_s2,
            robot.d1_m,
            robot.d2_m,
            robot.a2_m,
            robot.d3_m,
            robot.a3_m,
            robot.encoder_counts_per_rev,
            robot.sample_period_s,
            robot.command_limit_v,
        ];
        RANGES.iter().zip(values).try_for_each(|(range, value)| match value {
            Some(value) if !(range.least..=range.most).contains(&value) => {
                Err(self.out_of_range(range.key, value, range.words))
            }
            _ => Ok(()),
        })?;
        self.check_bits()
    }

    fn check_bits(&self) -> Result<(), FileError> {
        match self.robot.command_bits {
            Some(bits) if !(1..=32).contains(&bits) => {
                Err(self.out_of_range("command_bits", f64::from(bits), "be from 1 to 32"))
            }
            _ => Ok(()),
        }
    }

    fn out_of_range(&self, key: &str, value: f64, must: &str) -> FileError {
        let problem = Problem::OutOfRange(format!("{key} is {value}, but must {must}"));
        self.source.problem_in(problem, "robot", None, key)
    }
}
