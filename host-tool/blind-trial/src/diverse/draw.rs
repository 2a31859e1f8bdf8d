//! Draws diverse cases. Only what the arm cannot follow is drawn again, never what does not show.

use rayon::prelude::*;

use super::clutter::{Typical, draw_clutter};
use super::knowable::{Known, Twins, quiet, smallest_part};
use super::settings::{DiverseSettings, Ranges};
use super::sizes::scaled;
use super::world::{draw_model, draw_reality};
use crate::case::{Case, Kind};
use crate::cause::{TrueCause, TrueEffect};
use crate::detectability::{is_stable, peak_command_v};
use crate::error::TrialError;
use crate::foreign;
use crate::plans::Motions;
use crate::rng::Rng;
use crate::robots::RobotGenerator;
use rig::effects::{Catalogue, DrawContext, Random};

/// Draws of a robot, its reality and motions that the arm must follow.
const WORLD_TRIES: u32 = 30;
/// Draws of a whole case.
const CASE_TRIES: u32 = 10;
/// How often causes that shake the arm off are made smaller.
const SHRINK_TRIES: u32 = 12;

/// A case and what could be known of it.
#[derive(Clone, Debug)]
pub struct DiverseCase {
    /// The case; the first of its causes is the largest.
    pub case: Case,
    /// What could be known of each cause.
    pub known: Vec<Known>,
}

/// Draws all cases, on as many threads as there are cores; `progress` is called after each.
///
/// # Errors
/// A case for which no arm was drawn that follows its motions.
pub fn draw_diverse(
    settings: &DiverseSettings,
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<DiverseCase>, TrialError> {
    let robots = RobotGenerator::new();
    let numbers: Vec<u32> = (settings.first..settings.first + settings.cases).collect();
    let draw_one = |number: u32| {
        let case = draw_case(settings, &robots, number);
        progress();
        case
    };
    numbers.into_par_iter().map(draw_one).collect()
}

/// Draws a case; another world and other causes where the arm cannot follow with any size of these.
fn draw_case(
    settings: &DiverseSettings,
    robots: &RobotGenerator,
    number: u32,
) -> Result<DiverseCase, TrialError> {
    let drawn = |attempt: u32| Draw::of(settings, robots, number, attempt)?.case();
    for attempt in 0..CASE_TRIES {
        match drawn(attempt) {
            Err(TrialError::NothingDetectable { .. }) => {}
            done => return done,
        }
    }
    Err(nothing(number, CASE_TRIES, "a whole case"))
}

/// A case in the making.
struct Draw<'a> {
    ranges: &'a Ranges,
    rng: Rng,
    /// The case without causes, but with its clutter.
    base: Case,
    effects: Vec<(TrueEffect, u8)>,
    peak_command_v: [f64; 3],
    twins: Twins,
}

impl<'a> Draw<'a> {
    fn of(
        settings: &'a DiverseSettings,
        robots: &RobotGenerator,
        number: u32,
        attempt: u32,
    ) -> Result<Self, TrialError> {
        let ranges = &settings.ranges;
        // Not the numbers of the plain trial's case.
        let mut rng = Rng::new(settings.seed, number ^ 0x8000_0000 ^ attempt << 24);
        let kind = draw_kind(ranges, &mut rng);
        for _ in 0..WORLD_TRIES {
            let effects = draw_effects(ranges, kind, &mut rng);
            let mut base = world(settings, robots, number, kind, &mut rng);
            let recorded = base.record_undamaged()?;
            if !is_stable(&base, &recorded) {
                continue;
            }
            let counts = f64::from(base.rig().encoder_counts_per_turn);
            let typical = [0, 1, 2].map(|i| Typical::of(&recorded, &base.robot, counts, i));
            if let Some(reality) = &mut base.reality {
                reality.clutter = draw_clutter(&ranges.clutter, &typical, &effects, &mut rng);
            }
            let peak_command_v = peak_command_v(&recorded);
            if is_stable(&base, &base.record_undamaged()?) {
                let twins = Twins::of(&base)?;
                return Ok(Self { ranges, rng, base, effects, peak_command_v, twins });
            }
        }
        Err(nothing(number, WORLD_TRIES, "robot, reality and motions"))
    }

    fn case(mut self) -> Result<DiverseCase, TrialError> {
        let mut parts = Vec::new();
        for (effect, joint) in self.effects.clone() {
            parts.push(self.sized(effect, joint)?);
        }
        for _ in 0..SHRINK_TRIES {
            let causes = parts.iter().map(|sized: &Sized| sized.cause(&self.peak_command_v));
            let case = self.base.with_causes(causes.collect());
            if is_stable(&case, &case.record_undamaged()?) {
                return self.known(case);
            }
            parts.iter_mut().for_each(|sized| sized.part *= 0.6);
        }
        Err(nothing(self.base.number, SHRINK_TRIES, "sizes of causes"))
    }

    /// The case with its largest cause first.
    fn known(&self, case: Case) -> Result<DiverseCase, TrialError> {
        let known = self.twins.known(&case)?;
        let mut both: Vec<_> = case.causes.iter().cloned().zip(known).collect();
        both.sort_by(|(_, a), (_, b)| {
            b.share.unwrap_or_default().total_cmp(&a.share.unwrap_or_default())
        });
        let (causes, known) = both.into_iter().unzip();
        Ok(DiverseCase { case: Case { causes, ..case }, known })
    }

    /// An effect of a size between half of what just shows and twice what is usually drawn.
    fn sized(&mut self, effect: TrueEffect, joint: u8) -> Result<Sized, TrialError> {
        let context = DrawContext {
            robot: &self.base.robot,
            peak_command_v: self.peak_command_v,
            joint: usize::from(joint.max(1)) - 1,
        };
        let values = effect.draw(&context, &mut self.rng);
        let mut sized = Sized { effect, joint, values, part: 1.0 };
        let sizes = &self.ranges.sizes;
        for _ in 0..SHRINK_TRIES {
            let probe = quiet(&self.base.with_causes(vec![sized.cause(&self.peak_command_v)]));
            let recorded = probe.record_undamaged()?;
            if is_stable(&probe, &recorded) {
                let gain = self.twins.gain(&probe, &recorded)?;
                let least = sizes.least * sized.part * smallest_part(gain, sizes.most);
                let most = sizes.most * sized.part;
                sized.part = self.rng.log_uniform(least.min(most), most);
                return Ok(sized);
            }
            sized.part *= 0.5;
        }
        Err(nothing(self.base.number, SHRINK_TRIES, "sizes of a cause"))
    }
}

/// An effect with a size.
struct Sized {
    effect: TrueEffect,
    joint: u8,
    values: Vec<f64>,
    part: f64,
}

impl Sized {
    fn cause(&self, peak_command_v: &[f64; 3]) -> TrueCause {
        let peak_v = peak_command_v[usize::from(self.joint.max(1)) - 1];
        scaled(self.effect, self.joint, &self.values, self.part, peak_v)
    }
}

fn draw_kind(ranges: &Ranges, rng: &mut Rng) -> Kind {
    let mut rest = rng.unit() * ranges.kinds.iter().map(|(_, part)| part).sum::<f64>();
    let chosen = ranges.kinds.iter().find(|(_, part)| {
        rest -= part;
        rest <= 0.0
    });
    chosen.map_or(Kind::Single, |(kind, _)| *kind)
}

/// The effects that a kind hides, and their joints: all pairs but one effect twice on a joint.
fn draw_effects(ranges: &Ranges, kind: Kind, rng: &mut Rng) -> Vec<(TrueEffect, u8)> {
    let count = match kind {
        Kind::None => 0,
        Kind::Single | Kind::Foreign => 1,
        Kind::Pair => 2,
    };
    let mut effects: Vec<(TrueEffect, u8)> = Vec::new();
    while effects.len() < count {
        let is_foreign = match kind {
            Kind::Pair => rng.unit() < ranges.foreign_in_pair,
            _ => kind == Kind::Foreign,
        };
        let drawn = if is_foreign { draw_foreign(ranges, rng) } else { draw_known(rng) };
        let springs = |other: &(TrueEffect, u8)| {
            moves_link(other) && moves_link(&drawn) && other.1 == drawn.1
        };
        if !effects.contains(&drawn) && !effects.iter().any(springs) {
            effects.push(drawn);
        }
    }
    effects
}

fn draw_known(rng: &mut Rng) -> (TrueEffect, u8) {
    let all: Vec<_> = Catalogue::standard().iter().collect();
    let definition = *rng.pick(&all);
    let joint = rng.joint();
    (TrueEffect::Catalogue(definition), if definition.whole_robot { 0 } else { joint })
}

fn draw_foreign(ranges: &Ranges, rng: &mut Rng) -> (TrueEffect, u8) {
    let definition = match rng.unit() < ranges.shapes {
        true => *rng.pick(&foreign::SHAPES),
        false => *rng.pick(&foreign::ALL),
    };
    (TrueEffect::Foreign(definition), rng.joint())
}

/// Whether a link moves apart from its motor: the simulator has one spring in a joint.
fn moves_link((effect, _): &(TrueEffect, u8)) -> bool {
    ["joint_elasticity", "backlash", "rubbing_backlash"].contains(&effect.name())
}

/// A robot in a reality without clutter, its model and what it plays.
fn world(
    settings: &DiverseSettings,
    robots: &RobotGenerator,
    number: u32,
    kind: Kind,
    rng: &mut Rng,
) -> Case {
    let robot = robots.true_robot(rng);
    let reality = draw_reality(&settings.ranges, rng);
    let (least_v, most_v) = settings.ranges.bus.noise_v;
    Case {
        number,
        kind,
        nominal: draw_model(&robot, &reality.model_error, rng),
        robot,
        causes: Vec::new(),
        visibility: None,
        motions: Motions::draw(rng),
        duration_scale: settings.duration_scale,
        noise_v: rng.log_uniform(least_v, most_v),
        seed: rng.seed(),
        reality: Some(reality),
    }
}

fn nothing(case: u32, tries: u32, what: &str) -> TrialError {
    TrialError::NothingDetectable { case, tries, what: what.into() }
}
