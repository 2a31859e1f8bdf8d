//! A short run of every target, on any compiler; `cargo xtask fuzz` makes long ones.

use fuzz_entries::mutate::mutated;
use fuzz_entries::rng::Rng;
use fuzz_entries::targets::command_handler;
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
    let mut rng = Rng::new(2);
    for _ in 0..RUNS {
        (target.run)(&mutated(&seeds, &mut rng));
    }
}

#[test]
fn every_conversation_that_damage_begins_from_reaches_a_run() {
    for conversation in fuzz_entries::seeds::conversations() {
        assert!(command_handler::reaches_a_run(&conversation));
    }
}

/// Damage that still lets the arm run is where the handler is tried hardest.
#[test]
fn many_damaged_conversations_reach_a_run() {
    let seeds = fuzz_entries::seeds::conversations();
    let mut rng = Rng::new(3);
    let reached =
        (0..2000).filter(|_| command_handler::reaches_a_run(&mutated(&seeds, &mut rng))).count();
    println!("{reached} of 2000");
    assert!(reached > 200, "{reached} of 2000");
}
