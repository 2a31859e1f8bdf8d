//! A model that holds a table is diagnosed with it, and keeps it.
#![allow(missing_docs)]

use diagnosis::{Criteria, Verdict, diagnose};
use recordings::Campaign;
use rig::effects::{Catalogue, Table, TableAxis};

#[path = "common/short_campaign.rs"]
mod short_campaign;
use short_campaign::short_campaign;

/// Friction of another form below 0.2 rad/s, 0.05 V deep.
fn table() -> Table {
    Table {
        joint: 2,
        axis: TableAxis::Velocity,
        knots: vec![-0.2, -0.05, 0.05, 0.2],
        values_v: vec![0.0, 0.05, -0.05, 0.0],
    }
}

/// Logs of a robot that has the table, and a model that knows it.
fn campaign() -> Campaign {
    let effect = || Catalogue::standard().effect_of(&table().to_effect_table()).unwrap();
    let mut campaign = short_campaign(|| vec![effect()]);
    campaign.robot_file.effects.push(table().to_effect_table());
    campaign
}

#[test]
fn a_table_that_the_model_knows_leaves_no_gap_and_stays() {
    let diagnosis =
        diagnose(&campaign(), &Catalogue::standard(), &Criteria::default(), &|_| ()).unwrap();
    let report = &diagnosis.report;
    assert_eq!(report.verdict, Verdict::None, "{:?}", report.causes);
    assert_eq!(diagnosis.model.effects(), [table().to_effect_table()]);
}
