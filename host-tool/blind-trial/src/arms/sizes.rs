//! How large effects are on an arm of any kind: from what a search takes for a usual size, up to four
//! times as much, with all else as it may be.

use rig::Plant;
use rig::effects::{Carrier, Definition, Kind, Parameter, Random, Search, Typical};

use crate::rng::Rng;

/// The highest order of a harmonic.
const HIGHEST_ORDER: u32 = 12;
/// A harmonic's usual amplitude, in parts of friction or of what it scales.
const AMPLITUDE: f64 = 0.1;

/// Values of an effect's parameters within their bounds.
pub fn drawn(definition: &Definition, typical: &Typical, rng: &mut Rng) -> Vec<f64> {
    let usual = match definition.search {
        Search::From(starts) => rng.pick(&starts(typical)).clone(),
        Search::Harmonics(carrier) => {
            let size = if carrier == Carrier::Unity { typical.friction_v } else { 1.0 };
            vec![AMPLITUDE * size, rng.harmonic(HIGHEST_ORDER), 0.0]
        }
    };
    let pairs = usual.into_iter().zip(definition.parameters).enumerate();
    pairs.map(|(place, (value, parameter))| varied(value, parameter, place == 0, rng)).collect()
}

/// Whether an effect of these values on a joint (from 1, or 0) can be: no bearing takes more of a load than there is. On
/// a turn about the vertical, which carries none, what is sized by friction and load takes many times that.
pub fn can_be(definition: &Definition, joint: u8, values: &[f64], plant: &Plant) -> bool {
    let Some(index) = usize::from(joint).checked_sub(1) else { return true };
    let taken = values[0] * plant.torque_constant_nm_per_v[index];
    definition.name != "load_friction" || taken <= 1.0
}

fn varied(value: f64, parameter: &Parameter, is_size: bool, rng: &mut Rng) -> f64 {
    let varied = match parameter.kind {
        Kind::Harmonic | Kind::Choice => value,
        Kind::Phase => rng.phase_rad(),
        Kind::Angle => value + rng.uniform(-0.5, 0.5),
        // Searches begin at limits that lie close to each other.
        Kind::Limit => value * rng.uniform(0.9, 1.1),
        Kind::Mass => value * rng.log_uniform(1.0, 4.0),
        _ if is_size || matches!(parameter.kind, Kind::Force | Kind::Rotation) => {
            signed(value * rng.log_uniform(1.0, 4.0), parameter, rng)
        }
        _ => signed(value * rng.log_uniform(0.5, 2.0), parameter, rng),
    };
    varied.clamp(parameter.lowest, parameter.highest)
}

/// Of either sign where the parameter may be.
fn signed(value: f64, parameter: &Parameter, rng: &mut Rng) -> f64 {
    if parameter.lowest < 0.0 && rng.unit() < 0.5 { -value } else { value }
}
