//! Instructions of a tick on the Cortex-M4F, counted exactly by QEMU.
#![allow(missing_docs)]

use firmware::Mode;
use host_tool::board::Board;
use host_tool::simulation::{Settings, record};
use tests::{every_reference, image, minute_of, qemu, rig};

/// From counts in to codes out, whatever the board plays.
const MOST_INSTRUCTIONS: f64 = 2500.0;
/// On the motion (20)-(21) with all terms on, on average.
const AIM: f64 = 1500.0;

fn instructions(timer_counts: u32) -> f64 {
    f64::from(timer_counts) / 25.6
}

#[test]
fn no_reference_makes_a_tick_too_long() {
    let Some(image) = image() else { return };
    let (mut board, rig) = (qemu(&image), rig());
    println!("{:24} {:>8} {:>8}", "reference", "mean", "worst");
    for plan in every_reference(&rig) {
        let ticks = plan.ticks(&rig).min(20_000);
        let block = plan.block(&rig);
        let recording =
            record(&mut board, &block, &rig.model, &Settings::default(), ticks, &mut |_| {})
                .unwrap();
        let worst = recording.timer_counts.iter().copied().max().map_or(0.0, instructions);
        let mean = recording.instructions_per_tick();
        println!("{:24} {mean:8.0} {worst:8.0}", plan.name);
        assert!(worst > 500.0, "the timer counts");
        assert!(worst < MOST_INSTRUCTIONS, "{}: {worst}", plan.name);
        assert!(plan.name != "task" || mean < AIM, "{mean}");
    }
}

#[test]
fn no_mode_makes_a_tick_too_long() {
    let Some(image) = image() else { return };
    let (mut board, rig) = (qemu(&image), rig());
    println!("{:24} {:>8}", "mode", "worst");
    for mode in Mode::ALL {
        board.load(&minute_of(&rig, mode)).unwrap();
        board.start().unwrap();
        let ticks = (0..5000).map(|k| board.tick(&[7 * k, -5 * k, 3 * k]).unwrap().timer_counts);
        let worst = ticks.max().map_or(0.0, instructions);
        println!("{:24} {worst:8.0}", mode.name());
        assert!(worst < MOST_INSTRUCTIONS, "{}: {worst}", mode.name());
    }
}
