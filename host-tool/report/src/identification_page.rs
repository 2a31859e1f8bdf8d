//! `identification.html`: the paper's figures from these experiments.

use model::base::NAMES;

use super::validation_page::{HEADER, command_charts, lead, rows};
use super::{Axis, Chart, Page, Series, Stroke};
use files::{Experiment, Role};
use identification::Estimate;
use identification::base_parameters::ConvergencePoint;
use identification::ekf::{EkfPass, EkfResult};
use identification::prediction::predict_over;
use identification::presliding::{FrfPoint, Presliding};
use identification::procedure::Identified;
use identification::static_friction::StaticFriction;
use recordings::{Campaign, Trace};

const HALF: (u32, u32) = (535, 290);
const THIRD: (u32, u32) = (352, 260);

/// The page of a result.
pub fn identification_page(campaign: &Campaign, identified: &Identified) -> Page {
    let mut page = Page::new("Identification of an RRR robot", &lead(&identified.held_out));
    for remark in &identified.missing {
        page.paragraph(&format!("Note: {remark}"));
    }
    page.heading("Residuals on held-out motion").table(&HEADER, &rows(&identified.held_out));
    page.heading("Static friction (Table 2)").table(&FRICTION_HEADER, &friction_rows(identified));
    page.charts(&identified.statics.iter().flatten().map(stribeck_chart).collect::<Vec<_>>());
    if let Some(found) = &identified.filtered {
        page.heading("Augmented EKF on the friction excitation (Fig. 2, 3 and 5)");
        page.table(&EKF_HEADER, &ekf_rows(found, identified));
        page.paragraph(if found.converged {
            "The filter has converged."
        } else {
            "The filter has not converged; its values are not used."
        });
        page.charts(&ekf_charts(found, campaign, identified));
    }
    page.heading("Pre-sliding friction (Fig. 4)");
    page.charts(&identified.presliding.iter().flat_map(frf_charts).collect::<Vec<_>>());
    for remark in identified.presliding.iter().flat_map(|found| &found.remarks) {
        page.paragraph(remark);
    }
    page.heading("Excitation (Fig. 6 and 7)").charts(&excitation_charts(campaign));
    page.heading("Base parameters (eq. 19)").table(&BASE_HEADER, &base_rows(identified));
    page.heading("Convergence (Fig. 9)")
        .charts(&[convergence_chart(&identified.paper.convergence)]);
    page.heading("Command, recorded and reconstructed (Fig. 8 and 10)");
    page.charts(&identified.held_out.iter().flat_map(command_charts).collect::<Vec<_>>());
    page
}

const FRICTION_HEADER: [&str; 4] = ["Parameter", "joint 1", "joint 2", "joint 3"];

fn friction_rows(identified: &Identified) -> Vec<Vec<String>> {
    let [first, second, third] = &identified.refined.friction_estimates;
    let rows = first.iter().zip(second).zip(third);
    rows.map(|((a, b), c)| vec![a.0.into(), shown(&a.1), shown(&b.1), shown(&c.1)]).collect()
}

const BASE_HEADER: [&str; 3] = ["Parameter", "identified", "the paper's way"];

fn base_rows(identified: &Identified) -> Vec<Vec<String>> {
    let pairs = identified.refined.base_estimates.iter().zip(&identified.paper.estimates);
    pairs.map(|(ours, plain)| vec![ours.0.into(), shown(&ours.1), shown(&plain.1)]).collect()
}

/// A value with half its 95 % interval, to the digits that the interval allows.
pub(super) fn shown(estimate: &Estimate) -> String {
    let half = 0.5 * (estimate.interval[1] - estimate.interval[0]);
    let digits = if half > 0.0 { (1.0 - half.log10().floor()).clamp(0.0, 7.0) as usize } else { 5 };
    format!("{:.digits$} ± {:.digits$}", estimate.value, half)
}

pub(super) fn stribeck_chart(found: &StaticFriction) -> Chart {
    let forward = |points: Vec<(f64, f64)>| -> Vec<(f64, f64)> {
        points.into_iter().map(|(v, u)| (v.abs(), u * v.signum())).collect()
    };
    let legs = found.legs.iter().map(|leg| (leg.velocity_rad_per_s, leg.friction_v)).collect();
    let curve = found.curve().into_iter().filter(|point| point.0 > 0.0).collect();
    Chart::new(format!("Joint {}", found.joint), "speed [rad/s]", "friction [V]")
        .axes(Axis::Logarithmic, Axis::Linear)
        .with(Series::line("eq. (10), fitted", 0, curve))
        .with(Series::line("steady legs", 1, forward(legs)).stroke(Stroke::Dots))
        .sized(THIRD.0, THIRD.1)
}

pub(super) fn frf_charts(found: &Presliding) -> [Chart; 3] {
    // Beyond the band of the fit there is noise only.
    let shown = |p: &&FrfPoint| p.frequency_hz <= 1.3 * found.band_hz[1];
    let points = |pick: fn(&FrfPoint) -> f64| {
        found.frf.iter().filter(shown).map(|p| (p.frequency_hz, pick(p))).collect::<Vec<_>>()
    };
    let degrees = |pick: fn(&FrfPoint) -> f64| {
        points(pick).into_iter().map(|(f, phase)| (f, phase.to_degrees())).collect::<Vec<_>>()
    };
    let joint = found.joint;
    [
        Chart::new(format!("Joint {joint}, magnitude"), "frequency [Hz]", "[rad/V]")
            .axes(Axis::Logarithmic, Axis::Logarithmic)
            .with(Series::line("measured", 1, points(|p| p.measured_rad_per_v)))
            .with(Series::line("fitted", 0, points(|p| p.fitted_rad_per_v)))
            .sized(THIRD.0, THIRD.1),
        Chart::new(format!("Joint {joint}, phase"), "frequency [Hz]", "[degrees]")
            .axes(Axis::Logarithmic, Axis::Linear)
            .with(Series::line("measured", 1, degrees(|p| p.measured_phase_rad)))
            .with(Series::line("fitted", 0, degrees(|p| p.fitted_phase_rad)))
            .sized(THIRD.0, THIRD.1),
        Chart::new(format!("Joint {joint}, coherence"), "frequency [Hz]", "")
            .axes(Axis::Logarithmic, Axis::Linear)
            .with(Series::line("with the own command", 3, points(|p| p.coherence)))
            .with(Series::line("with all commands", 2, points(|p| p.multiple_coherence)))
            .sized(THIRD.0, THIRD.1),
    ]
}

/// Trajectories and commands of the first excitation.
fn excitation_charts(campaign: &Campaign) -> Vec<Chart> {
    let mut traces = campaign.traces_of(Experiment::Excitation, Role::Train, None);
    let Some(trace) = traces.next() else { return Vec::new() };
    let angle = Chart::new("Joint angles", "time [s]", "[rad]").sized(HALF.0, HALF.1);
    let command = Chart::new("Commands", "time [s]", "[V]").sized(HALF.0, HALF.1);
    let series = |number: usize, values: &[f64], trace: &Trace| {
        let points = trace.time_s.iter().copied().zip(values.iter().copied()).collect();
        Series::line(format!("joint {}", number + 1), number, points)
    };
    let all = trace.joints.iter().enumerate();
    let (angle, command) = all.fold((angle, command), |(angle, command), (i, joint)| {
        let angle = angle.with(series(i, &joint.q_rad, trace));
        (angle, command.with(series(i, &joint.command_v, trace)))
    });
    vec![angle, command]
}

/// All parameters over the number of samples, each less its last value, in its own error.
pub(super) fn convergence_chart(points: &[ConvergencePoint]) -> Chart {
    let chart =
        Chart::new("Each parameter against its last value", "samples", "difference [kg m, kg m^2]")
            .sized(1080, 330);
    let last = points.last().map(|point| point.values).unwrap_or_default();
    NAMES.iter().enumerate().fold(chart, |chart, (k, name)| {
        // The first points, before all parameters are excited, would hide the rest.
        let settled = points.iter().skip(points.len() / 6);
        let line = settled.map(|p| (p.samples as f64, p.values[k] - last[k])).collect();
        let name = if k < 7 { (*name).to_owned() } else { String::new() };
        chart.with(Series::line(name, k, line))
    })
}

const EKF_HEADER: [&str; 3] = ["Parameter of joint 3", "augmented EKF", "whole model"];

/// The filter's estimates beside those of all steps together.
fn ekf_rows(found: &EkfResult, identified: &Identified) -> Vec<Vec<String>> {
    let robot = &identified.robot;
    let gravity_nm = robot.geometry.gravity_m_s2 * robot.base.mx3r.hypot(robot.base.my3r);
    let friction = &robot.friction[2];
    let row = |name: &str, estimate: &Estimate, value: f64| {
        vec![name.to_owned(), shown(estimate), format!("{value:.5}")]
    };
    let mut rows = vec![
        row("alpha0_V", &found.friction.alpha0_v, friction.alpha0_v),
        row("alpha0_V + alpha1_V", &found.friction.breakaway_v, friction.stribeck_level(0.0)),
        row("alpha2_V_s_per_rad", &found.friction.alpha2_v_s_per_rad, friction.alpha2_v_s_per_rad),
        row("J3 [kg m^2]", &found.inertia_kg_m2, robot.base.zz3r + robot.base.ia3),
    ];
    rows.extend(found.gravity_torque_nm.as_ref().map(|l| row("l3 [Nm]", l, gravity_nm)));
    rows
}

/// Command and response, the simulated response, and the parameters pass by pass.
fn ekf_charts(found: &EkfResult, campaign: &Campaign, identified: &Identified) -> Vec<Chart> {
    let mut traces =
        campaign.traces_of(Experiment::FrictionExcitation, Role::Train, Some(found.joint));
    let Some((trace, joint)) = traces.next().and_then(|t| Some((t, t.joint(found.joint)?))) else {
        return Vec::new();
    };
    let points = |values: &[f64]| -> Vec<(f64, f64)> {
        trace.time_s.iter().copied().zip(values.iter().copied()).collect()
    };
    let command = Chart::new("Command (Fig. 2)", "time [s]", "[V]")
        .with(Series::line("", 0, points(&joint.command_v)))
        .sized(HALF.0, HALF.1);
    let mut response = Chart::new("Response (Fig. 3 and 5)", "time [s]", "angle [rad]")
        .with(Series::line("measured", 1, points(&joint.q_rad)).stroke(Stroke::Broad))
        .sized(HALF.0, HALF.1);
    let simulated = predict_over(trace, &identified.robot, f64::INFINITY).unwrap_or_default();
    if let Some(whole) = simulated.first() {
        let index = usize::from(found.joint) - 1;
        let sum = whole.measured_rad[index].iter().zip(&whole.error_rad[index]).map(|(q, e)| q + e);
        let line = whole.time_s.iter().copied().zip(sum).collect();
        response = response.with(Series::line("simulated by the model", 0, line));
    }
    vec![command, response, passes_chart(found)]
}

/// What is drawn of a pass.
type ValueOfPass = fn(&EkfPass) -> f64;

/// Each parameter over the passes, in parts of its last value.
pub(super) fn passes_chart(found: &EkfResult) -> Chart {
    let Some(last) = found.history.last() else { return Chart::default() };
    let chart =
        Chart::new("Passes of the filter", "pass", "value / last value").sized(HALF.0, HALF.1);
    let pick: [(&str, ValueOfPass); 5] = [
        ("alpha0", |pass| pass.friction.alpha0_v),
        ("alpha1", |pass| pass.friction.alpha1_v),
        ("alpha2", |pass| pass.friction.alpha2_v_s_per_rad),
        ("J", |pass| pass.inertia_kg_m2),
        ("l", |pass| pass.gravity_torque_nm),
    ];
    pick.into_iter().enumerate().fold(chart, |chart, (colour, (name, value))| {
        let points =
            found.history.iter().map(|pass| (pass.number as f64, value(pass) / value(last)));
        chart.with(Series::line(name, colour, points.collect()))
    })
}
