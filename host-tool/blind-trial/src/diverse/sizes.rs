//! Causes of any size: how an effect is made larger or smaller.

use crate::cause::{TrueCause, TrueEffect};
use rig::effects::{Definition, Kind, Parameter};

/// A cause `part` times as large as it was drawn, within the bounds of its parameters.
///
/// `peak_command_v` is what a limit is measured by: at a part of 0 it is there, at 1 as drawn.
pub fn scaled(
    effect: TrueEffect,
    joint: u8,
    values: &[f64],
    part: f64,
    peak_command_v: f64,
) -> TrueCause {
    let values = match effect {
        TrueEffect::Catalogue(definition) => catalogue(definition, values, part, peak_command_v),
        TrueEffect::Foreign(definition) => {
            let first = values[0] * if definition.grows { part } else { 1.0 / part };
            // Nothing foreign is a change by more than nine tenths, or takes longer than 20 ms.
            let most = match definition.parameters[0] {
                "relative_loss" | "coefficient" | "relative_difference" => 0.9,
                "time_constant_s" => 0.02,
                _ => f64::INFINITY,
            };
            [&[first.clamp(-most, most)], &values[1..]].concat()
        }
    };
    TrueCause::new(effect, joint, values)
}

fn catalogue(definition: &Definition, values: &[f64], part: f64, peak_v: f64) -> Vec<f64> {
    let one = |(k, (parameter, &value)): (usize, (&Parameter, &f64))| {
        let scaled = match parameter.kind {
            Kind::Amplitude
            | Kind::RelativeChange
            | Kind::Mass
            | Kind::Force
            | Kind::Rotation
            | Kind::Gap
            | Kind::Offset
            | Kind::HalfWidth
            | Kind::Coefficient
            | Kind::Delay => value * part,
            Kind::TimeConstant if k == 0 => value * part,
            Kind::Stiffness if k == 0 && definition.size.grows => value * part,
            // A spring half as large in effect is twice as stiff, and damped as before.
            Kind::Stiffness if k == 0 => value / part,
            Kind::Damping if !definition.size.grows => value / part.sqrt(),
            Kind::Limit => peak_v * (value / peak_v).powf(part.min(1.5)),
            _ => value,
        };
        scaled.clamp(parameter.lowest, parameter.highest)
    };
    definition.parameters.iter().zip(values).enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use crate::foreign;
    use rig::effects::{Catalogue, DrawContext};

    #[test]
    fn every_effect_can_be_made_smaller_and_larger() {
        let robot = model::reference_robot::reference_robot();
        let mut rng = Rng::new(1, 1);
        let catalogue = Catalogue::standard();
        let effects = catalogue.iter().map(TrueEffect::Catalogue);
        let foreign = foreign::ALL.into_iter().chain(foreign::SHAPES).map(TrueEffect::Foreign);
        for effect in effects.chain(foreign) {
            let whole = matches!(effect, TrueEffect::Catalogue(d) if d.whole_robot);
            let joint = if whole { 0 } else { 3 };
            let context = DrawContext { robot: &robot, peak_command_v: [5.0; 3], joint: 2 };
            let values = effect.draw(&context, &mut rng);
            let same = scaled(effect, joint, &values, 1.0, 5.0);
            assert_eq!(same, TrueCause::new(effect, joint, values.clone()));
            for part in [0.1, 2.0] {
                let other = scaled(effect, joint, &values, part, 5.0);
                other.build().unwrap();
                assert!(other != same, "{}", effect.name());
            }
        }
    }
}
