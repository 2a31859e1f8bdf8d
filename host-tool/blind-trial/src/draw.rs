//! Draws cases: robots, motions, and causes that show and leave the arm stable.

use rayon::prelude::*;

use super::Rng;
use super::case::{Case, Kind};
use super::cause::{TrueCause, TrueEffect};
use super::detectability::{Residuals, is_stable, peak_command_v};
use super::error::TrialError;
use super::plans::Motions;
use super::population::Population;
use super::robots::{RobotGenerator, nominal_model};
use super::settings::DrawSettings;
use super::visibility::Visibility;
use rig::effects::{Catalogue, DrawContext, Random};

/// Amplifier noise that is drawn [V rms].
const NOISE_V: (f64, f64) = (0.003, 0.006);
/// Draws of motions that the arm must follow.
const MOTION_TRIES: u32 = 20;
/// Draws of effects and joints, and of sizes for each.
const CAUSE_TRIES: u32 = 12;
const SIZE_TRIES: u32 = 16;

/// Draws all cases, on as many threads as there are cores; `progress` is called after each.
///
/// # Errors
/// An unknown name among those asked for, or a case for which nothing fit was drawn.
pub fn draw(
    settings: &DrawSettings,
    catalogue: &Catalogue,
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<Case>, TrialError> {
    let population = Population::of(settings, catalogue)?;
    let robots = RobotGenerator::new();
    let numbers: Vec<u32> = (settings.first..settings.first + settings.cases).collect();
    let draw_one = |number: u32| {
        let case = Draw::of(settings, &population, &robots, number)?.case();
        progress();
        case
    };
    numbers.into_par_iter().map(draw_one).collect()
}

/// A case in the making.
struct Draw<'a> {
    population: &'a Population,
    rng: Rng,
    /// The case without its causes.
    bare: Case,
    without: Residuals,
    peak_command_v: [f64; 3],
}

impl<'a> Draw<'a> {
    fn of(
        settings: &DrawSettings,
        population: &'a Population,
        robots: &RobotGenerator,
        number: u32,
    ) -> Result<Self, TrialError> {
        let mut rng = Rng::new(settings.seed, number);
        let kind = population.draw_kind(&mut rng);
        for _ in 0..MOTION_TRIES {
            let bare = bare_case(settings, robots, number, kind, &mut rng);
            let recorded = bare.record()?;
            if is_stable(&bare, &recorded) {
                let without = Residuals::of(&bare, &recorded)?;
                let peak_command_v = peak_command_v(&recorded);
                return Ok(Self { population, rng, bare, without, peak_command_v });
            }
        }
        Err(nothing(number, MOTION_TRIES, "robot and motions"))
    }

    fn case(mut self) -> Result<Case, TrialError> {
        let causes = match self.bare.kind {
            Kind::None => return Ok(self.bare),
            Kind::Pair => self.pair()?,
            _ => vec![self.cause(None)?],
        };
        let recorded = self.bare.with_causes(causes.clone()).record()?;
        let visibility = Residuals::of(&self.bare, &recorded)?.compared_with(&self.without);
        Ok(Case { causes, visibility: Some(visibility), ..self.bare })
    }

    /// Two causes, each of them detectable alone, and stable together.
    fn pair(&mut self) -> Result<Vec<TrueCause>, TrialError> {
        for _ in 0..CAUSE_TRIES {
            let first = self.cause(None)?;
            let second = self.cause(Some(&first))?;
            let case = self.bare.with_causes(vec![first, second]);
            if is_stable(&case, &case.record()?) {
                return Ok(case.causes);
            }
        }
        Err(nothing(self.bare.number, CAUSE_TRIES, "pairs"))
    }

    /// A detectable cause; another one than that given.
    fn cause(&mut self, other: Option<&TrueCause>) -> Result<TrueCause, TrialError> {
        for _ in 0..CAUSE_TRIES {
            let (effect, joint) = self.population.draw_effect(self.bare.kind, other, &mut self.rng);
            for _ in 0..SIZE_TRIES {
                let cause = self.sized(effect, joint);
                if self.visibility(&cause)?.is_some_and(|visibility| visibility.is_detectable()) {
                    return Ok(cause);
                }
            }
        }
        Err(nothing(self.bare.number, CAUSE_TRIES * SIZE_TRIES, "effects"))
    }

    fn sized(&mut self, kind: TrueEffect, joint: u8) -> TrueCause {
        let index = usize::from(joint.max(1)) - 1;
        let context = DrawContext {
            robot: &self.bare.robot,
            peak_command_v: self.peak_command_v,
            joint: index,
        };
        let values = kind.draw(&context, &mut self.rng);
        TrueCause::new(kind, joint, values)
    }

    /// How much a cause shows; `None` where the arm does not stay stable with it.
    fn visibility(&self, cause: &TrueCause) -> Result<Option<Visibility>, TrialError> {
        let case = self.bare.with_causes(vec![cause.clone()]);
        let recorded = case.record()?;
        if !is_stable(&case, &recorded) {
            return Ok(None);
        }
        Ok(Some(Residuals::of(&case, &recorded)?.compared_with(&self.without)))
    }
}

fn bare_case(
    settings: &DrawSettings,
    robots: &RobotGenerator,
    number: u32,
    kind: Kind,
    rng: &mut Rng,
) -> Case {
    let robot = robots.true_robot(rng);
    let drawn_noise_v = rng.log_uniform(NOISE_V.0, NOISE_V.1);
    Case {
        number,
        kind,
        nominal: nominal_model(&robot, rng),
        robot,
        causes: Vec::new(),
        visibility: None,
        motions: Motions::draw(rng),
        duration_scale: settings.duration_scale,
        noise_v: settings.noise_v.unwrap_or(drawn_noise_v),
        seed: rng.seed(),
        reality: None,
    }
}

fn nothing(case: u32, tries: u32, what: &str) -> TrialError {
    TrialError::NothingDetectable { case, tries, what: what.into() }
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;

    use super::*;

    #[test]
    fn every_effect_gets_values_within_its_bounds() {
        let robot = reference_robot();
        let mut rng = Rng::new(1, 1);
        for definition in Catalogue::standard().iter() {
            for _ in 0..50 {
                let joint = if definition.whole_robot { 0 } else { rng.joint() };
                let index = usize::from(joint.max(1)) - 1;
                let peak_command_v = [2.0, 5.0, 3.0];
                let context = DrawContext { robot: &robot, peak_command_v, joint: index };
                let values = (definition.draw)(&context, &mut rng);
                definition.with(joint, &values).unwrap();
            }
        }
    }
}
