//! Which joint a column belongs to.

use super::words::words;

/// The last number in a name, or in its brackets if they hold one.
pub(super) fn number(name: &str) -> Option<usize> {
    words(name).iter().rev().find_map(|word| word.parse().ok())
}

/// The joints of names that say the same of several, from 1: by their numbers, which may begin at
/// 0, or by their order.
pub(super) fn joints(names: &[&str]) -> Vec<usize> {
    let numbers: Vec<Option<usize>> = names.iter().map(|name| number(name)).collect();
    let all: Option<Vec<usize>> = numbers.into_iter().collect();
    match all {
        Some(all) if is_distinct(&all) && (names.len() > 1 || !all.contains(&0)) => {
            let first = usize::from(all.contains(&0));
            all.into_iter().map(|number| number + first).collect()
        }
        _ => (1..=names.len()).collect(),
    }
}

fn is_distinct(numbers: &[usize]) -> bool {
    (1..numbers.len()).all(|k| !numbers[..k].contains(&numbers[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_go_by_number_or_by_order() {
        assert_eq!(joints(&["q1", "q2"]), [1, 2]);
        assert_eq!(joints(&["state[0]", "state[1]"]), [1, 2]);
        assert_eq!(joints(&["position[joint_2]", "position[joint_1]"]), [2, 1]);
        assert_eq!(joints(&["shoulder.pos", "elbow.pos"]), [1, 2]);
        assert_eq!(joints(&["q3_deg"]), [3]);
        assert_eq!(joints(&["data[0]"]), [1]);
    }
}
