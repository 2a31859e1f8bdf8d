//! What varies with the angle: waves that repeat every turn, and what is slow over it.

use super::angle::{AngleSums, Carrier, Wave};
use super::fit::{Design, Fit};
use super::found::Found;
use super::nodes::Nodes;
use super::orders::lowest_order;
use super::samples::Samples;
use super::shape::{centred, explained, spread};
use crate::quantity::volts;
use crate::result::Axis;

/// A function of the angle.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let waves = Waves::of(samples);
    let left_v: Vec<f64> =
        samples.residual_v.iter().zip(&waves.fitted_v).map(|(r, f)| r - f).collect();
    let slow = slow(samples, &left_v);
    let both_v2 = waves.energy_v2 + slow.energy_v2;
    if both_v2 <= 0.0 {
        return None;
    }
    let least_v2 = samples.criteria.named_angle_part * both_v2;
    let parts = [(waves.energy_v2, waves.words()), (slow.energy_v2, slow.detail)];
    let mut parts: Vec<_> = parts.into_iter().filter(|p| p.0 > least_v2).collect();
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let words: Vec<String> = parts.into_iter().map(|part| part.1).collect();
    let fitted_v = waves.fitted_v.iter().zip(&slow.fitted_v).map(|(a, b)| a + b).collect();
    Some(Found { axis: Axis::Position, energy_v2: both_v2, detail: words.join("; "), fitted_v })
}

/// Waves over the angle, the strongest first.
struct Waves {
    waves: Vec<Wave>,
    energy_v2: f64,
    fitted_v: Vec<f64>,
}

impl Waves {
    /// Waves one by one, each of which must pay on stretches left out.
    fn of(samples: &Samples) -> Self {
        let least_v2 = samples.criteria.least_order_part * samples.excess_v2();
        let mut found = Self { waves: vec![], energy_v2: 0.0, fitted_v: vec![0.0; samples.len()] };
        let base = Design::of(samples.len(), 2, |k, row| {
            row.extend([(0, 1.0), (1, samples.direction[k])]);
        });
        let level = Fit::of(&base, &samples.residual_v, &samples.fold).coefficients(&[0, 1]);
        let mut left_v = less(&samples.residual_v, &base.times(&level));
        while found.waves.len() < samples.criteria.most_orders {
            let sums = AngleSums::of(samples, &left_v);
            let best = sums.best(lowest_order(samples), samples.criteria.highest_order);
            let Some(wave) = best.filter(|wave| wave.energy_v2 > least_v2) else { break };
            let waves: Vec<Wave> = found.waves.iter().copied().chain([wave]).collect();
            let design = design(samples, &waves);
            let fit = Fit::of(&design, &samples.residual_v, &samples.fold);
            let all: Vec<usize> = (0..2 + 2 * waves.len()).collect();
            // A constant must not claim what a wave that is seen in part explains.
            let energy_v2 = fit.gain(&[0, 1], &all).max(fit.gain(&[], &all[2..]));
            if energy_v2 < found.energy_v2 + least_v2 {
                break;
            }
            let mut coefficients = fit.coefficients(&all);
            left_v = less(&samples.residual_v, &design.times(&coefficients));
            (coefficients[0], coefficients[1]) = (0.0, 0.0);
            let amplitude_v = |k: usize| coefficients[2 + 2 * k].hypot(coefficients[3 + 2 * k]);
            let waves = waves.into_iter().enumerate();
            let waves = waves.map(|(k, w)| Wave { amplitude_v: amplitude_v(k), ..w }).collect();
            found = Self { waves, energy_v2, fitted_v: design.times(&coefficients) };
        }
        found
    }

    /// "order 8 per revolution, 0.11 V".
    fn words(&self) -> String {
        let Some(first) = self.waves.first() else { return String::new() };
        let mut orders: Vec<usize> = self.waves.iter().map(|wave| wave.order).collect();
        orders.sort_unstable();
        orders.dedup();
        let manner = match first.carrier {
            Carrier::Constant => "",
            Carrier::Direction => ", turns with the direction",
            Carrier::Command => ", grows with the command",
        };
        match orders.as_slice() {
            [order] => {
                let size = volts(first.amplitude_v);
                format!("order {order} per revolution, {size}{manner}")
            }
            [others @ .., last] => {
                let others: Vec<String> = others.iter().map(usize::to_string).collect();
                format!("orders {} and {last} per revolution{manner}", others.join(", "))
            }
            [] => String::new(),
        }
    }
}

/// A constant, the direction, and a cosine and a sine per wave.
fn design(samples: &Samples, waves: &[Wave]) -> Design {
    let carriers: Vec<Vec<f64>> = waves.iter().map(|wave| wave.carrier.values(samples)).collect();
    Design::of(samples.len(), 2 + 2 * waves.len(), |k, row| {
        row.extend([(0, 1.0), (1, samples.direction[k])]);
        for (index, wave) in waves.iter().enumerate() {
            let (sine, cosine) = (wave.order as f64 * samples.position_rad[k]).sin_cos();
            let carrier = carriers[index][k];
            row.extend([(2 + 2 * index, carrier * cosine), (3 + 2 * index, carrier * sine)]);
        }
    })
}

fn less(values: &[f64], fitted: &[f64]) -> Vec<f64> {
    values.iter().zip(fitted).map(|(value, fitted)| value - fitted).collect()
}

/// What is slow over the angle, whatever the motion, in what the waves leave.
fn slow(samples: &Samples, left_v: &[f64]) -> Found {
    let angle = &samples.position_rad;
    let nodes = Nodes::of(angle.iter().copied());
    let design = Design::of(samples.len(), 1 + nodes.len(), |k, row| {
        row.push((0, 1.0));
        row.extend(nodes.weights(angle[k]).map(|(node, weight)| (1 + node, weight)));
    });
    let fit = Fit::of(&design, left_v, &samples.fold);
    let all: Vec<usize> = (0..=nodes.len()).collect();
    let energy_v2 = fit.gain(&[0], &all);
    let mut fitted_v = centred(&design.times(&fit.coefficients(&all)));
    if energy_v2 <= 0.0 {
        fitted_v.fill(0.0);
    }
    let centred_angle = centred(angle);
    let (share, slope) = explained(&fitted_v, |k| centred_angle[k]);
    let detail = if share > samples.criteria.clear_part {
        format!("proportional to the angle, {} per rad", volts(slope))
    } else {
        format!("slow over the angle, by {}", volts(spread(&fitted_v)))
    };
    Found { axis: Axis::Position, energy_v2, detail, fitted_v }
}
