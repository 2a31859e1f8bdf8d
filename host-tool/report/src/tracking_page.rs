//! Tracking errors without and with the model in the firmware.

use super::{Chart, Page, Series, Stroke};
use files::Log;
use recordings::tracking::Tracking;

/// One recorded run of a motion.
#[derive(Clone, Debug)]
pub struct Run {
    /// What the legend calls it.
    pub name: &'static str,
    /// What was recorded.
    pub log: Log,
    /// How well it followed.
    pub tracking: Vec<Tracking>,
    /// Times real time.
    pub speed: f64,
    /// Instructions of a tick, on average; zero where they are not counted.
    pub instructions_per_tick: f64,
}

/// A robot with unmodelled effects, before and after its diagnosis.
#[derive(Clone, Debug)]
pub struct Diagnosed {
    /// What the diagnosis says.
    pub sentence: String,
    /// The address of its report.
    pub report: String,
    /// The run with the model as it was.
    pub before: Run,
    /// The run with the amended model.
    pub after: Run,
}

/// Runs of the same motion side by side: without and with the model, before and after the
/// diagnosis of a robot that changed.
pub fn tracking_page(plain: &Run, modelled: &Run, diagnosed: &Diagnosed) -> Page {
    let least = least_ratio(plain, modelled);
    let lead = format!(
        "With the model in the firmware, every joint follows the validation motion, \
         eq. (20)-(21) of the paper, at least {least:.0} times closer than with PD control alone."
    );
    let mut page = Page::new("RRR joint controller: with and without the model", &lead);
    page.table(
        &["Joint", "PD alone, rms [mrad]", "PD with the model, rms [mrad]", "ratio"],
        &rows(plain, modelled),
    );
    add(&mut page, diagnosed);
    page.heading("Tracking error without and with the model")
        .charts(&error_charts(plain, modelled));
    page.heading("What remains with the model").paragraph(REMAINDER);
    page.charts(&remainder_charts(modelled));
    page.heading("Voltages").charts(&voltage_charts(plain, modelled));
    page.heading("The board").paragraph(&format!(
        "Firmware for the Cortex-M4F in QEMU, in lockstep with the simulated robot: {:.0} \
         instructions a tick on average, {:.0} times as fast as real time.",
        modelled.instructions_per_tick, modelled.speed
    ));
    page
}

/// The robot that changed, before and after its diagnosis.
fn add(page: &mut Page, diagnosed: &Diagnosed) {
    let Diagnosed { sentence, report, before, after } = diagnosed;
    page.heading("The robot changes").paragraph(sentence).table(
        &["Joint", "model as it was, rms [mrad]", "amended model, rms [mrad]", "ratio"],
        &rows(before, after),
    );
    page.charts(&error_charts(before, after)).link("The diagnosis", report);
}

/// The least of the joints' ratios of errors.
fn least_ratio(first: &Run, second: &Run) -> f64 {
    let pairs = first.tracking.iter().zip(&second.tracking);
    let ratios = pairs.map(|(without, with)| without.rms_rad() / with.rms_rad());
    ratios.fold(f64::INFINITY, f64::min)
}

const REMAINDER: &str = "A count of the encoder is 0.0096 mrad. While the motion swells in the \
first second, acceleration changes fast and the velocity estimate lags; feedback takes the lag \
for an error. After that a count or two remain: amplifier noise of 4 mV, the steps of encoder \
and converter, and at reversals the friction state, which the firmware takes from the reference \
and the robot from its true motion.";

fn rows(plain: &Run, modelled: &Run) -> Vec<Vec<String>> {
    let pairs = plain.tracking.iter().zip(&modelled.tracking);
    pairs
        .map(|(without, with)| {
            let (without_mrad, with_mrad) = (1e3 * without.rms_rad(), 1e3 * with.rms_rad());
            vec![
                without.joint.to_string(),
                format!("{without_mrad:.3}"),
                format!("{with_mrad:.4}"),
                format!("{:.0}", without_mrad / with_mrad),
            ]
        })
        .collect()
}

fn in_milliradians(run: &Run, joint: usize) -> Vec<(f64, f64)> {
    let errors = &run.tracking[joint].error_rad;
    run.log.time_s.iter().zip(errors).map(|(&t, e)| (t, 1e3 * e)).collect()
}

/// Errors of both runs on one scale, joint by joint.
pub fn error_charts(plain: &Run, modelled: &Run) -> Vec<Chart> {
    let chart = |joint: usize| {
        Chart::new(format!("Joint {}", joint + 1), "time [s]", "tracking error [mrad]")
            .with(Series::line(plain.name, 1, in_milliradians(plain, joint)))
            .with(Series::line(modelled.name, 0, in_milliradians(modelled, joint)))
            .sized(352, 260)
    };
    (0..plain.tracking.len()).map(chart).collect()
}

fn remainder_charts(modelled: &Run) -> Vec<Chart> {
    let chart = |joint: usize| {
        Chart::new(format!("Joint {}, enlarged", joint + 1), "time [s]", "tracking error [mrad]")
            .with(Series::line("", 0, in_milliradians(modelled, joint)))
            .sized(352, 220)
    };
    (0..modelled.tracking.len()).map(chart).collect()
}

fn voltage_charts(plain: &Run, modelled: &Run) -> Vec<Chart> {
    let volts = |run: &Run, joint: usize| {
        run.log
            .time_s
            .iter()
            .copied()
            .zip(run.log.joints[joint].command_v.iter().copied())
            .collect()
    };
    let chart = |joint: usize| {
        Chart::new(format!("Joint {}", joint + 1), "time [s]", "command [V]")
            .with(Series::line(plain.name, 1, volts(plain, joint)).stroke(Stroke::Broad))
            .with(Series::line(modelled.name, 0, volts(modelled, joint)))
            .sized(352, 220)
    };
    (0..plain.log.joints.len()).map(chart).collect()
}
