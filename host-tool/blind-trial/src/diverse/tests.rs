//! Diverse cases are drawn again alike, and their twins tell what could be known.

use super::*;
use crate::case::Kind;

fn settings(first: u32, cases: u32) -> DiverseSettings {
    DiverseSettings { seed: 3, first, cases, duration_scale: 0.3, ranges: Ranges::default() }
}

#[test]
fn a_case_depends_on_seed_and_number_alone() {
    let both = draw_diverse(&settings(1, 2), &|| {}).unwrap();
    let again = draw_diverse(&settings(2, 1), &|| {}).unwrap();
    let [one, other] = [&both[1], &again[0]];
    assert_eq!(one.case.causes, other.case.causes);
    assert_eq!(one.case.reality, other.case.reality);
    assert_eq!(one.known, other.known);
    let log = |case: &DiverseCase| case.case.record().unwrap().remove(1).log;
    assert!(log(one) == log(other));
    assert!(both[0].case.reality != one.case.reality);
}

#[test]
fn the_largest_cause_stands_first_and_has_a_share() {
    let mut settings = settings(1, 3);
    settings.ranges.kinds =
        [(Kind::Pair, 1.0), (Kind::None, 0.0), (Kind::Single, 0.0), (Kind::Foreign, 0.0)];
    for DiverseCase { case, known } in draw_diverse(&settings, &|| {}).unwrap() {
        assert_eq!((case.causes.len(), known.len()), (2, 2));
        assert!(known[0].share.unwrap_or_default() >= known[1].share.unwrap_or_default());
        assert!(known.iter().all(|known| (0.0..=1.0).contains(&known.oracle)));
    }
}
