//! Tables of any numbers are either refused with a reason or are curves.
#![allow(missing_docs)]

use proptest::prelude::*;
use rig::compensation::Compensations;
use rig::effects::{Catalogue, MAX_TABLE_KNOTS, Table, TableAxis};

fn any_axis() -> impl Strategy<Value = TableAxis> {
    prop::sample::select(TableAxis::ALL.to_vec())
}

prop_compose! {
    fn curve()(
        joint in 1..=3_u8,
        axis in any_axis(),
        first in -1e5..1e5_f64,
        points in prop::collection::vec((1e-9..1e3_f64, -5.0..5.0_f64), 2..=MAX_TABLE_KNOTS),
    ) -> Table {
        let mut last = first;
        let knots = points.iter().map(|(step, _)| { last += step; last }).collect();
        Table { joint, axis, knots, values_v: points.iter().map(|(_, value_v)| *value_v).collect() }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_numbers_are_refused_or_make_a_curve(
        joint in any::<u8>(),
        axis in any_axis(),
        knots in prop::collection::vec(any::<f64>(), 0..80),
        values_v in prop::collection::vec(any::<f64>(), 0..80),
        x in any::<f64>(),
    ) {
        let table = Table { joint, axis, knots, values_v };
        table.value_v(x);
        match table.clone().checked() {
            Err(why) => prop_assert!(!why.to_string().is_empty()),
            Ok(curve) => prop_assert!(curve.value_v(x).abs() <= 5.0),
        }
        prop_assert_eq!(Table::of(&table.to_effect_table()).is_ok(), table.checked().is_ok());
    }

    #[test]
    fn a_curve_stays_between_its_values_and_within_what_the_board_plays(
        table in curve(),
        x in any::<f64>(),
    ) {
        let Ok(table) = table.checked() else { return Ok(()) };
        let [lowest, highest] = [f64::min, f64::max]
            .map(|of| table.values_v.iter().copied().reduce(of).unwrap());
        let value_v = table.value_v(x);
        prop_assert!(value_v >= lowest - 1e-9 && value_v <= highest + 1e-9);
        let file = [table.to_effect_table()];
        let (compensations, left_out) = Compensations::of(&file, &Catalogue::standard()).unwrap();
        prop_assert_eq!(compensations.tables.len() + left_out.len(), 1);
        for (played, on_board) in
            compensations.tables.iter().zip(&compensations.joints[usize::from(table.joint) - 1].tables)
        {
            let (coarse, missed_v) = table.coarsened(on_board.knots.len());
            prop_assert_eq!(missed_v, played.missed_v);
            prop_assert!((coarse.value_v(x) - value_v).abs() <= missed_v + 1e-9);
        }
    }
}
