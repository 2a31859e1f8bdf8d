//! What is drawn.

use super::draw::draw_robots;
use super::settings::{LAWS, WholeWaySettings};

#[test]
fn five_laws_come_in_turn_and_a_robot_depends_on_seed_and_number_alone() {
    let robots = draw_robots(&WholeWaySettings::new(3, 1, 10));
    let laws: std::collections::BTreeSet<&str> = robots
        .iter()
        .filter_map(|case| case.reality.as_ref().map(|r| r.friction[0].law.name()))
        .collect();
    assert!(laws.len() >= LAWS.len(), "{laws:?}");
    let again = draw_robots(&WholeWaySettings::new(3, 7, 1));
    assert!(robots[6].robot == again[0].robot && robots[6].seed == again[0].seed);
    assert!(robots[5].robot != again[0].robot);
}
