//! Whether and how the board compensates for an effect.

use firmware::Angle;
use firmware::compensation::{AngularHarmonic, Feedforward, InputInverse};
use model::effects::Tilt;
use model::vector::Vector3;

/// Whether and how the board compensates for an effect; the functions take its values, which are
/// within their bounds, or say why the board cannot compensate for these.
#[derive(Clone, Copy, Debug)]
pub enum Compensation {
    /// Feedforward adds what the effect takes away.
    Feedforward(fn(&[f64]) -> Result<Feedforward, &'static str>),
    /// The command goes through the inverse of the effect.
    Inverse(fn(&[f64]) -> Result<InputInverse, &'static str>),
    /// The model that the board computes with takes it up.
    Model(fn(&mut ArmLoad, &[f64]) -> Result<(), &'static str>),
    /// The board does not, for this reason.
    None(&'static str),
}

/// What acts on the arm as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmLoad {
    /// Mass at the tip [kg].
    pub payload_kg: f64,
    /// How the base leans, if it does.
    pub tilt: Option<Tilt<f64>>,
    /// Force on the tip, in the base frame [N].
    pub tip_force_n: Vector3<f64>,
}

/// The board's wave over the turn; its angles wrap there, so the wave must fit it.
///
/// # Errors
/// A harmonic that is no whole number.
pub fn turn_wave(harmonic: f64, phase_rad: f64) -> Result<AngularHarmonic, &'static str> {
    const ROUNDING: f64 = 1e-6;
    let whole = harmonic.round();
    if (harmonic - whole).abs() > ROUNDING {
        return Err("its harmonic is no whole number, so it does not repeat every turn");
    }
    Ok(AngularHarmonic { order: whole as u16, phase: Angle::from_radians(phase_rad as f32) })
}
