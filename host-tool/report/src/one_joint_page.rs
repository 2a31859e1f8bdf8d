//! `identification.html` of a rig of one joint.

use super::Page;
use super::identification_page::{shown, stribeck_chart};
use identification::procedure::OneJointIdentified;

/// The page of a result.
pub fn one_joint_page(identified: &OneJointIdentified) -> Page {
    let motion = &identified.motion;
    let lead = format!(
        "Of the command of joint {}, {:.3} V rms, the model leaves {:.3} V.",
        motion.joint, motion.command_rms_v, motion.residual_rms_v
    );
    let mut page = Page::new("Identification of one joint", &lead);
    page.table(&["Parameter", "value"], &one_joint_rows(identified));
    page.paragraph(&format!("Logs used: {}.", motion.used.join(", ")));
    for remark in &identified.missing {
        page.paragraph(&format!("Note: {remark}"));
    }
    if let Some(statics) = &identified.statics {
        page.heading("Static friction").charts(&[stribeck_chart(statics)]);
    }
    page
}

/// A row per parameter, with half its 95 % interval.
pub fn one_joint_rows(identified: &OneJointIdentified) -> Vec<Vec<String>> {
    let motion = &identified.motion;
    let mut rows: Vec<Vec<String>> = [
        ("inertia_kg_m2", &motion.inertia_kg_m2),
        ("gravity_torque_Nm", &motion.gravity_torque_nm),
        ("alpha0_V", &motion.alpha0_v),
        ("alpha2_V_s_per_rad", &motion.alpha2_v_s_per_rad),
        ("offset_V", &motion.offset_v),
    ]
    .map(|(name, estimate)| vec![name.to_owned(), shown(estimate)])
    .to_vec();
    rows.push(vec!["delay_s".to_owned(), format!("{:.4}", motion.delay_s)]);
    rows
}
