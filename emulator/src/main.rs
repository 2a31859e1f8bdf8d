use emulator::{image::Image, machine::Machine, plant::Still, registers::MS};
use std::rc::Rc;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let image = Rc::new(Image::read(path.as_ref()).unwrap());
    let mut m = Machine::new(image, Box::new(Still)).unwrap();
    m.board().trace.is_on = true;
    for k in 1..=1000u64 {
        if let Err(e) = m.run_until(k * MS) {
            println!("{k}: {e}");
            println!("resets {:?}", m.resets);
            return;
        }
    }
    let (deepest, resets, low) = (m.deepest, m.resets.clone(), m.lowest_stack);
    let b = m.board();
    println!(
        "instr {} resets {resets:?} deepest {deepest} stack {low:x} faults {:?} misses {} wd longest {} ms, ticks {} tim6 {} codes {:?} volts {:?}",
        b.instructions,
        b.trace.faults,
        b.cost.misses,
        b.watchdog.longest / MS,
        b.trace.ticks.len(),
        b.tim6.updates,
        b.converter.codes,
        b.converter
    );
    println!("{:?}", b.trace.ticks.last());
    println!("{:?}", b.lpuart);
}
