//! CMA-ES from several starts.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use cmaes::CMAESOptions;
use model::Robot;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::demand::Demand;
use super::objective::{DIMENSION, Objective};
use super::series::Series;
use super::settings::{Effort, Settings};

/// A designed motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Design {
    /// The motion.
    pub series: Series,
    /// J_k of Phi over one period, eq. (14).
    pub condition_number: f64,
    /// What it asks of joints and amplifiers, as it begins and over its period.
    pub demand: Demand,
    /// Whether it keeps all limits; where gravity and friction alone need more voltage
    /// than there is, no motion does.
    pub keeps_limits: bool,
    /// Whether the time limit cut the search short.
    pub cut_short: bool,
}

/// Searches the motion with the smallest J_k; `progress` hears the share done, 0 to 1.
pub fn design(robot: &Robot<f64>, settings: &Settings, progress: &(dyn Fn(f64) + Sync)) -> Design {
    let search = Search::begin(Objective { robot, settings }, progress);
    let starts = settings.effort.starts.max(1);
    let found: Vec<Found> = (0..starts).into_par_iter().map(|start| search.run(start)).collect();
    let cut_short = found.iter().any(|found| found.cut_short);
    let best = found.into_iter().map(|found| search.finish(&found.vector, cut_short));
    best.reduce(better).unwrap_or_else(|| search.finish(&[], cut_short))
}

/// The one that keeps the limits, and of two that do the one of smaller J_k.
fn better(a: Design, b: Design) -> Design {
    let key = |design: &Design| (!design.keeps_limits, design.condition_number);
    if key(&b) < key(&a) { b } else { a }
}

/// What one start found.
struct Found {
    vector: Vec<f64>,
    cut_short: bool,
}

/// A search under way.
struct Search<'a> {
    objective: Objective<'a>,
    progress: &'a (dyn Fn(f64) + Sync),
    generations_done: AtomicU64,
    begun: Instant,
}

impl<'a> Search<'a> {
    fn begin(objective: Objective<'a>, progress: &'a (dyn Fn(f64) + Sync)) -> Self {
        Self { objective, progress, generations_done: AtomicU64::new(0), begun: Instant::now() }
    }

    /// One start: the best vector that it came to.
    fn run(&self, start: u32) -> Found {
        let effort = &self.objective.settings.effort;
        let first = first_vector(self.objective.settings.seed, start);
        let mut found = Found { vector: first.clone(), cut_short: false };
        let Ok(mut strategy) = strategy(effort, self.objective.settings.seed, start, first)
            .build(|vector: &cmaes::DVector<f64>| self.objective.cost(vector.as_slice()))
        else {
            return found;
        };
        for generation in 0..effort.generations {
            if self.out_of_time() {
                found.cut_short = true;
                break;
            }
            if strategy.next().is_some() {
                self.advance(u64::from(effort.generations - generation));
                break;
            }
            self.advance(1);
        }
        if let Some(best) = strategy.overall_best_individual() {
            found.vector = best.point.as_slice().to_vec();
        }
        found
    }

    fn out_of_time(&self) -> bool {
        let limit = self.objective.settings.effort.time_limit;
        limit.is_some_and(|limit| self.begun.elapsed() > limit)
    }

    fn advance(&self, generations: u64) {
        let effort = &self.objective.settings.effort;
        let all = f64::from(effort.generations.max(1)) * f64::from(effort.starts.max(1));
        let done = self.generations_done.fetch_add(generations, Ordering::Relaxed) + generations;
        (self.progress)(done as f64 / all);
    }

    /// The motion of a vector, judged at the firmware's sample period.
    fn finish(&self, vector: &[f64], cut_short: bool) -> Design {
        const TICK_S: f64 = 1e-3;
        let settings = self.objective.settings;
        let series = self.objective.motion(vector, TICK_S);
        let demand = self.objective.demand(&series, TICK_S);
        let count = (settings.period_s / settings.sample_period_s).round() as usize;
        Design {
            series,
            condition_number: self.objective.condition_number(series.period(count)),
            demand,
            keeps_limits: demand.keeps(&settings.limits)
                && self.objective.stays_in_range(&series, TICK_S),
            cut_short,
        }
    }
}

/// CMA-ES with a step that lets the first generation differ by all there is.
fn strategy(effort: &Effort, seed: u64, start: u32, first: Vec<f64>) -> CMAESOptions {
    const FIRST_STEP: f64 = 0.2;
    CMAESOptions::new(first, FIRST_STEP)
        .population_size(effort.population.max(4) as usize)
        .seed(seed << 16 | u64::from(start))
}

/// A random motion, in the units of [`Objective`].
fn first_vector(seed: u64, start: u32) -> Vec<f64> {
    const DEVIATION: f64 = 0.3;
    let mut random = Pcg64Mcg::new(u128::from(seed) << 33 | u128::from(start) << 1 | 1);
    let draw = |_| -> f64 {
        let deviate: f64 = StandardNormal.sample(&mut random);
        DEVIATION * deviate
    };
    (0..DIMENSION).map(draw).collect()
}
