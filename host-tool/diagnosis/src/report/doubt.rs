//! A wider doubt about the model, in words.

use crate::criteria::Doubt;

/// That logs show a model further off than was `given`, and by which doubt it was searched then.
pub fn words(given: Doubt, seen: Doubt) -> String {
    let taken = match is_same(given) && is_same(seen) {
        true => format!(
            "{}: the doubt about them was taken as {}, as by --model-doubt {:.3}",
            percent(given.masses),
            percent(seen.masses),
            seen.masses
        ),
        false => format!(
            "was thought: the doubt about masses and inertias was taken as {} (given {}), that about friction as {} \
             (given {}), as by relative and relative_friction in --criteria",
            percent(seen.masses),
            percent(given.masses),
            percent(seen.friction),
            percent(given.friction)
        ),
    };
    format!(
        "the parameters of the model are further off than {taken}; identify the model anew, and more can be said"
    )
}

/// Whether masses and friction are as doubtful, as far as is told.
fn is_same(doubt: Doubt) -> bool {
    percent(doubt.masses) == percent(doubt.friction)
}

fn percent(part: f64) -> String {
    format!("{:.*} %", usize::from(part < 0.1), 100.0 * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_doubt_about_all_is_told_as_the_option_takes_it() {
        let said = words(Doubt::both(0.025), Doubt { masses: 0.3, friction: 0.1 * (0.3 / 0.1) });
        assert!(said.contains("further off than 2.5 %"), "{said}");
        assert!(said.contains("taken as 30 %, as by --model-doubt 0.300"), "{said}");
    }

    #[test]
    fn two_doubts_are_told_with_those_given() {
        let said = words(Doubt::both(0.025), Doubt { masses: 0.025, friction: 0.26 });
        assert!(said.contains("masses and inertias was taken as 2.5 % (given 2.5 %)"), "{said}");
        assert!(said.contains("friction as 26 % (given 2.5 %)"), "{said}");
    }
}
