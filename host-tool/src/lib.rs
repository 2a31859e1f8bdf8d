//! The host tool: simulates the RRR robot, identifies it and judges the model.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`files`] | logs, data sets and models, as they lie on disk |
//! | [`board`] | the control firmware, in this process or in QEMU |
//! | [`flash_image`] | what goes into the board's flash, and what may |
//! | [`link`] | the board's serial line: upload, run, record |
//! | [`effects`] | the catalogue of what the model does not hold |
//! | [`compensation`] | what the controller makes up for of it |
//! | [`simulation`] | the simulated robot, and experiments recorded with it |
//! | [`identification`] | the paper's procedure, step by step |
//! | [`diagnosis`] | what causes the gap between model and robot |
//! | [`blind_trial`] | how well it does on robots whose truth it is not told |
//! | [`excitation_design`] | the motion that identifies best, section 4.2 |
//! | [`signal`], [`estimation`] | the numerical tools that it uses |
//! | [`report`] | pages with pictures |
//! | [`commands`] | one file per subcommand of `rrr` |
#![forbid(unsafe_code)]

pub mod blind_trial;
pub mod board;
pub mod commands;
pub mod compensation;
pub mod diagnosis;
pub mod effects;
pub mod estimation;
pub mod excitation_design;
pub mod files;
pub mod flash_image;
pub mod identification;
pub mod link;
pub mod progress;
pub mod report;
pub mod signal;
pub mod simulation;
