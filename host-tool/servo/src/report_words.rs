//! What a report says, as it goes to a terminal.

use diagnosis::{Cause, Report, Value, Verdict};

/// The verdict, the causes and the remarks, as they go to a terminal.
pub fn in_words(report: &Report) -> String {
    let mut text = format!("{}\n", sentence(report));
    for cause in &report.causes {
        text += &format!("  {}\n", cause_words(cause));
    }
    let mrad =
        |rad: &[f64]| -> String { rad.iter().map(|rad| format!(" {:6.1}", 1e3 * rad)).collect() };
    text += "\nPosition on the confirming logs, simulated from the goals, rms by joint [mrad]:\n";
    text += &format!("  as given     {}\n", mrad(&report.gap.as_given_rad));
    text += &format!("  refitted     {}\n", mrad(&report.gap.refitted_rad));
    text += &format!("  with effects {}\n", mrad(&report.gap.with_effects_rad));
    for remark in &report.remarks {
        text += &format!("  note: {remark}\n");
    }
    text
}

/// A cause with its numbers.
pub fn cause_words(cause: &Cause) -> String {
    let number = |(name, value): (&String, &Value)| match value {
        Value::Number(value) => format!("{name} = {value:.4}"),
        Value::Vector(values) => format!("{name} = {values:.4?}"),
    };
    let numbers: Vec<String> = cause.parameters.iter().map(number).collect();
    let place =
        if cause.joint == 0 { "the arm".to_owned() } else { format!("joint {}", cause.joint) };
    format!(
        "{} of {place}: {}; share {:.0} %, shrinkage {:.2} [{:.2}, {:.2}], probability {:.2}",
        cause.effect,
        numbers.join(", "),
        100.0 * cause.share,
        cause.shrinkage,
        cause.shrinkage_interval[0],
        cause.shrinkage_interval[1],
        cause.probability
    )
}

/// The verdict as a sentence.
pub fn sentence(report: &Report) -> String {
    let named: Vec<String> = report
        .causes
        .iter()
        .map(|cause| match cause.joint {
            0 => cause.effect.clone(),
            joint => format!("{} of joint {joint}", cause.effect),
        })
        .collect();
    match report.verdict {
        Verdict::None => "No gap: the refitted model moves as the arm does.".to_owned(),
        Verdict::Unknown => "A gap, and no effect that explains it is confirmed.".to_owned(),
        Verdict::Effect => format!("The gap is {}.", named.join(", ")),
        Verdict::Partial => {
            format!("A part of the gap is {}; something else remains.", named.join(", "))
        }
    }
}
