//! Whether an effect of the whole arm is a cause.

use crate::base::{Base, Frame};
use crate::confirm::{Taken, Unit, probability, units};
use crate::cross::{Gain, LeftOut};
use crate::fit::robust;
use crate::judged::Judged;
use crate::prepared::Prepared;
use crate::settings::Settings;
use crate::spread::spread;
use crate::whole_effect::Whole;
use crate::whole_fit::{WholeFit, fit_plain, fit_whole, rigid};
use model::chain::SerialChain;

/// An effect of the whole arm that was tried.
#[derive(Clone, Debug)]
pub struct WholeCause {
    /// Fitted.
    pub fit: WholeFit,
    /// What it gains over joints whose gravity is as given.
    pub gain: Gain,
    /// What it takes of the confirming logs.
    pub taken: Taken,
    /// That it is a cause.
    pub probability: f64,
    /// Whether it may be named.
    pub is_named: bool,
}

/// Tries all of them over the joints as they are in `bases`, best first.
pub fn find(prepared: &Prepared, bases: &[Base], settings: &Settings) -> Vec<WholeCause> {
    find_from(prepared, bases, None, settings)
}

/// The same, one of them from where it was found before, too: with friction open, a fit without the load puts the load
/// into friction, and a search from there may stop early.
pub fn find_from(
    prepared: &Prepared,
    bases: &[Base],
    known: Option<&WholeFit>,
    settings: &Settings,
) -> Vec<WholeCause> {
    let all = prepared.train();
    let short = spread(&all, settings.whole_arm_s);
    let frame = Frame { logs: &short, period_s: prepared.period_s, settings };
    let links = &prepared.links;
    let mut plain = fit_plain(&frame, links, bases, &rigid(bases));
    if let Some(known) = known {
        plain = plain.better_of(fit_plain(&frame, links, bases, &known.servos));
    }
    let scaled = scaled(bases, &short, settings);
    let mut found: Vec<WholeCause> = Whole::ALL
        .into_iter()
        .filter(|effect| *effect != Whole::BaseTilt || is_upright(prepared))
        .map(|effect| {
            let known = known.filter(|known| known.effect == effect);
            let fit = fitted(&frame, links, bases, effect, &plain, known);
            judge(prepared, &plain, &scaled, fit, settings)
        })
        .collect();
    let rank = |cause: &WholeCause| if is_plausible(cause) { cause.gain.part } else { -1.0 };
    found.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    prefer_weight(&mut found, prepared, settings);
    found
}

/// An effect fitted to the frame's logs: a payload at the last link's centre, where a mass that was
/// exchanged is, or elsewhere, near or far, where that takes so much more that the logs tell the place.
fn fitted(
    frame: &Frame,
    links: &SerialChain<f64>,
    bases: &[Base],
    effect: Whole,
    plain: &WholeFit,
    known: Option<&WholeFit>,
) -> WholeFit {
    let settings = frame.settings;
    let of = |frame: &Frame, first: &WholeFit| {
        let starts = [Some(first), known].into_iter().flatten();
        let fits = starts.map(|start| fit_whole(frame, links, bases, effect, start));
        fits.reduce(WholeFit::better_of).expect("one start at least")
    };
    let mut found = of(frame, plain);
    if effect != Whole::Payload || !effect.is_beyond(&found.values, links, settings) {
        return found;
    }
    for place_doubt in [settings.elsewhere_doubt, settings.far_doubt] {
        let wide = Settings { place_doubt, ..settings.clone() };
        let wide = Frame { settings: &wide, ..*frame };
        let elsewhere = of(&wide, &found);
        let gain = Gain::of(&left_out(&elsewhere.left), &left_out(&found.left));
        let is_certain = gain.certainty >= settings.least_certainty;
        if is_certain && gain.part >= settings.least_elsewhere(bases.len()) {
            found = elsewhere;
        }
    }
    found
}

/// What a fit leaves of its logs, as a gain is taken from.
fn left_out(robust: &[f64]) -> LeftOut {
    LeftOut { robust: robust.to_vec(), squares: Vec::new(), rows: Vec::new() }
}

/// A base that leans is told by gravity along -z.
fn is_upright(prepared: &Prepared) -> bool {
    let [x, y, z] = prepared.links.gravity_m_s2();
    z < 0.0 && x.hypot(y) < 0.2 * z.abs()
}

/// What the joints leave with gravity's scale free.
fn scaled(bases: &[Base], logs: &[&Judged], settings: &Settings) -> Vec<f64> {
    let joints: Vec<usize> = (0..bases.len()).collect();
    let of = |log: &&Judged| {
        let left = joints.iter().map(|joint| {
            let base = &bases[*joint];
            let step = settings.search_step_s;
            let errors = crate::fit::errors(&base.fitted.servo, log, *joint, step);
            robust(&errors, log, *joint, base.scale) / base.fitted.square_of_one
        });
        left.sum()
    };
    logs.iter().map(of).collect()
}

fn judge(
    prepared: &Prepared,
    plain: &WholeFit,
    scaled: &[f64],
    fit: WholeFit,
    settings: &Settings,
) -> WholeCause {
    let gain = Gain::of(&left_out(&fit.left), &left_out(&plain.left));
    let sum = |left: &[f64]| left.iter().sum::<f64>();
    let (bare, free, with) = (sum(&plain.left), sum(scaled), sum(&fit.left));
    // A scale of gravity for each joint, which no arm has, must not do better.
    let as_good = bare - with >= settings.whole_part_of_scales * (bare - free);
    let held_out = prepared.held_out();
    let without = all_joints(prepared, &held_out, plain, None, settings);
    let loaded = all_joints(prepared, &held_out, &fit, Some(&fit), settings);
    let taken = Taken::of(&without, &without, &loaded, 0.0, settings);
    let certain =
        gain.certainty >= settings.least_certainty && gain.part >= settings.least_whole_gain;
    WholeCause {
        probability: probability(taken.certainty.min(gain.certainty)),
        is_named: as_good
            && certain
            && fit.effect.is_beyond(&fit.values, &prepared.links, settings)
            && taken.is_confirmed(settings),
        fit,
        gain,
        taken,
    }
}

/// Squares of all joints together, each in parts of what one of its rows leaves.
fn all_joints(
    prepared: &Prepared,
    logs: &[&Judged],
    fit: &WholeFit,
    effect: Option<&WholeFit>,
    settings: &Settings,
) -> Vec<Unit> {
    let changed: Vec<Judged> = match effect {
        Some(fit) => {
            logs.iter().map(|log| fit.effect.applied(&prepared.links, log, &fit.values)).collect()
        }
        None => logs.iter().map(|log| (*log).clone()).collect(),
    };
    let changed: Vec<&Judged> = changed.iter().collect();
    let mut sum: Vec<Unit> = Vec::new();
    for (joint, servo) in fit.servos.iter().enumerate() {
        let one = prepared.bases[joint].fitted.square_of_one;
        let found = units(servo, joint, &changed, settings.search_step_s);
        sum.resize(found.len(), Unit { log: 0, squares: 0.0, rows: 0 });
        for (sum, unit) in sum.iter_mut().zip(found) {
            *sum = Unit {
                log: unit.log,
                squares: sum.squares + unit.squares / one,
                rows: sum.rows + unit.rows,
            };
        }
    }
    sum
}

/// The best is named if no other does the same; a force that pulls straight down or up is a weight.
fn prefer_weight(found: &mut [WholeCause], prepared: &Prepared, settings: &Settings) {
    if let Some(payload) = found.iter().position(|cause| cause.fit.effect == Whole::Payload) {
        let near = settings.rival_part * found[0].gain.part;
        let vertical = |cause: &WholeCause| {
            cause.fit.effect == Whole::TipForce && is_vertical(&cause.fit.values, prepared)
        };
        if found[payload].gain.part >= near && (payload == 0 || vertical(&found[0])) {
            found[..=payload].rotate_right(1);
        }
    }
    let Some(best) = found.first() else { return };
    let near = settings.rival_part * best.gain.part;
    let rival = found[1..].iter().any(|other| {
        let weight = best.fit.effect == Whole::Payload
            && other.fit.effect == Whole::TipForce
            && is_vertical(&other.fit.values, prepared);
        other.gain.part >= near && !weight && is_plausible(other)
    });
    let first = found[0].is_named && !rival;
    for (k, cause) in found.iter_mut().enumerate() {
        cause.is_named = k == 0 && first;
    }
}

/// A base does not lean by more than a few deviations of what bases lean by.
fn is_plausible(cause: &WholeCause) -> bool {
    const MOST_TILT_RAD: f64 = 0.5;
    cause.fit.effect != Whole::BaseTilt
        || cause.fit.values.iter().all(|angle| angle.abs() < MOST_TILT_RAD)
}

/// Whether a force is within a sixth of its size of gravity's direction.
fn is_vertical(force: &[f64], prepared: &Prepared) -> bool {
    let gravity = prepared.links.gravity_m_s2();
    let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along: f64 = force.iter().zip(&gravity).map(|(f, g)| f * g).sum();
    along.abs() >= 0.985 * size(force) * size(&gravity)
}
