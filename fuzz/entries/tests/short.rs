//! A short run of every target, on any compiler; `cargo xtask fuzz` makes long ones.

use fuzz_entries::dice::Dice;
use fuzz_entries::mutate::mutated;
use fuzz_entries::{TARGETS, Target};

const RUNS: usize = 20_000;

#[test]
fn no_target_fails() {
    std::thread::scope(|scope| {
        for target in &TARGETS {
            scope.spawn(|| run(target));
        }
    });
}

fn run(target: &Target) {
    let seeds = (target.seeds)();
    assert!(seeds.iter().all(|seed| !seed.is_empty()), "{}", target.name);
    seeds.iter().for_each(|seed| (target.run)(seed));
    let mut dice = Dice::new(2);
    for _ in 0..RUNS {
        (target.run)(&mutated(&seeds, &mut dice));
    }
}
