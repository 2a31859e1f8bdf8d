//! Pages of single steps of the identification.

use super::Page;
use super::identification_page::{
    convergence_chart, frf_charts, passes_chart, shown, stribeck_chart,
};
use identification::Estimate;
use identification::base_parameters::BaseResult;
use identification::ekf::EkfResult;
use identification::presliding::Presliding;
use identification::static_friction::StaticFriction;

fn named_rows(rows: &[(&str, &Estimate)]) -> Vec<Vec<String>> {
    rows.iter().map(|(name, estimate)| vec![(*name).to_owned(), shown(estimate)]).collect()
}

const HEADER: [&str; 2] = ["Parameter", "value and 95 % interval"];

/// Static friction of each joint.
pub fn static_page(found: &[StaticFriction]) -> Page {
    let mut page =
        Page::new("Static friction", "Stribeck curves from runs at constant velocities.");
    for joint in found {
        page.heading(&format!("Joint {}", joint.joint));
        page.table(
            &HEADER,
            &named_rows(&[
                ("alpha0_V", &joint.friction.alpha0_v),
                ("alpha1_V", &joint.friction.alpha1_v),
                ("alpha0_V + alpha1_V", &joint.friction.breakaway_v),
                ("stribeck_velocity_rad_per_s", &joint.friction.stribeck_velocity_rad_per_s),
                ("alpha2_V_s_per_rad", &joint.friction.alpha2_v_s_per_rad),
            ]),
        );
        page.charts(&[stribeck_chart(joint)]);
    }
    page
}

/// What the augmented filter found.
pub fn ekf_page(found: &[EkfResult]) -> Page {
    let mut page = Page::new("Augmented EKF", "Friction, inertia and gravity in ten passes.");
    for joint in found {
        page.heading(&format!("Joint {}", joint.joint));
        let mut rows = vec![
            ("alpha0_V", &joint.friction.alpha0_v),
            ("alpha1_V", &joint.friction.alpha1_v),
            ("stribeck_velocity_rad_per_s", &joint.friction.stribeck_velocity_rad_per_s),
            ("alpha2_V_s_per_rad", &joint.friction.alpha2_v_s_per_rad),
            ("inertia_kg_m2", &joint.inertia_kg_m2),
        ];
        rows.extend(joint.gravity_torque_nm.as_ref().map(|l| ("gravity_torque_Nm", l)));
        page.table(&HEADER, &named_rows(&rows));
        let verdict = if joint.converged { "has" } else { "has not" };
        page.paragraph(&format!("The filter {verdict} converged."));
        page.charts(&[passes_chart(joint)]);
    }
    page
}

/// The FRF and the bristles of each joint.
pub fn presliding_page(found: &[Presliding]) -> Page {
    let mut page = Page::new(
        "Pre-sliding friction",
        "Stiffness and damping of the bristles from the frequency response, eq. (12).",
    );
    for joint in found {
        page.heading(&format!("Joint {}", joint.joint));
        page.table(
            &HEADER,
            &named_rows(&[
                ("sigma0_V_per_rad", &joint.sigma0_v_per_rad),
                ("sigma1_V_s_per_rad", &joint.sigma1_v_s_per_rad),
            ]),
        );
        for remark in &joint.remarks {
            page.paragraph(remark);
        }
        page.charts(&frf_charts(joint));
    }
    page
}

/// Base parameters and their convergence.
pub fn base_page(found: &BaseResult) -> Page {
    let lead =
        format!("J_k of Phi is {:.2} with {} equations.", found.condition_number, found.equations);
    let mut page = Page::new("Base parameters", &lead);
    let rows: Vec<(&str, &Estimate)> = found.estimates.iter().map(|(n, e)| (*n, e)).collect();
    page.table(&HEADER, &named_rows(&rows));
    page.charts(&[convergence_chart(&found.convergence)]);
    page
}
