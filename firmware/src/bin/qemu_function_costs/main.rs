//! What the elementary functions cost on a Cortex-M4F, and how wrong they are.
//!
//! Prints the table of `docs/firmware.md`; `cargo xtask function-costs` runs it.
#![no_std]
#![no_main]

#[path = "../qemu_mps2_an386/timer.rs"]
mod timer;

use core::f32::consts::PI;
use core::hint::black_box;

use cortex_m as _;
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use firmware::Controller;
use firmware::block::MAX_BYTES;
use micromath::F32Ext;
use model::trigonometry::{sin_cos_radians, sin_cos_turn, sin_turn};

const INPUTS: i32 = 2000;
/// Under `-icount shift=10` one instruction is 25.6 counts of the timer.
const COUNTS_PER_INSTRUCTION: f32 = 25.6;

#[entry]
fn main() -> ! {
    timer::start();
    hprintln!("function                          instructions   largest error");
    sines();
    exponentials();
    roots();
    parameters();
    loop {
        debug::exit(debug::EXIT_SUCCESS);
    }
}

/// An angle in [-pi, pi].
fn angle(index: i32) -> f32 {
    index as f32 * (2.0 * PI / INPUTS as f32) - PI
}

fn sines() {
    let turn = |x: f32| (x * (2_147_483_648.0 / PI)) as i32;
    report("sin and cos, model, from a turn", &|x| sin_cos_turn(turn(x)).0, &libm::sin, &angle);
    report("sin and cos, model, from radians", &|x| sin_cos_radians(x).0, &libm::sin, &angle);
    report("sin alone, model, from a turn", &|x| sin_turn(turn(x)), &libm::sin, &angle);
    report("sin, libm", &libm::sinf, &libm::sin, &angle);
    report("cos, libm", &libm::cosf, &libm::cos, &angle);
    report("sin, micromath", &|x| F32Ext::sin(x), &libm::sin, &angle);
}

fn exponentials() {
    let decay = |index: i32| index as f32 * (-20.0 / INPUTS as f32);
    report("exp, libm", &libm::expf, &libm::exp, &decay);
    report("exp, micromath", &|x| F32Ext::exp(x), &libm::exp, &decay);
    report("exp - 1, libm", &libm::expm1f, &libm::expm1, &decay);
    report("exp - 1, model", &|x| model::Real::exp_m1(x), &libm::expm1, &decay);
}

fn roots() {
    let positive = |index: i32| index as f32 * 1e-2;
    report("sqrt, libm", &libm::sqrtf, &libm::sqrt, &positive);
    report("sqrt, micromath", &|x| F32Ext::sqrt(x), &libm::sqrt, &positive);
}

/// What a board does once a second after a tick.
fn parameters() {
    let controller = Controller::new(firmware::store::safe_defaults());
    let begin = timer::now();
    black_box(black_box(&controller).is_intact());
    let instructions = timer::now().wrapping_sub(begin) as f32 / COUNTS_PER_INSTRUCTION;
    let bytes = controller.block().encode(&mut [0; MAX_BYTES]).map_or(0, <[u8]>::len);
    hprintln!("parameters in use checked, {} bytes: {:.0}", bytes, instructions);
}

/// Prints a function's mean cost above that of an empty one, and its largest error.
#[inline(always)]
fn report(
    name: &str,
    function: &impl Fn(f32) -> f32,
    exact: &dyn Fn(f64) -> f64,
    input: &impl Fn(i32) -> f32,
) {
    let cost = cost_of(function, input) - cost_of(&|x| x, input);
    let mut worst = 0.0_f64;
    for index in 0..INPUTS {
        let x = input(index);
        let error = f64::from(function(x)) - exact(f64::from(x));
        worst = if error > worst { error } else { worst };
        worst = if -error > worst { -error } else { worst };
    }
    hprintln!("{:34} {:8.0} {:18.1e}", name, cost, worst);
}

/// Instructions of one call with its loop.
#[inline(always)]
fn cost_of(function: &impl Fn(f32) -> f32, input: &impl Fn(i32) -> f32) -> f32 {
    let begin = timer::now();
    for index in 0..INPUTS {
        black_box(function(black_box(input(index))));
    }
    timer::now().wrapping_sub(begin) as f32 / COUNTS_PER_INSTRUCTION / INPUTS as f32
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    loop {
        debug::exit(debug::EXIT_FAILURE);
    }
}
