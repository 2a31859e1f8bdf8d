//! Long series made short without losing their peaks.

/// At most about `2 * buckets` points: the lowest and the highest of each bucket, in order.
pub fn thin(points: &[(f64, f64)], buckets: usize) -> Vec<(f64, f64)> {
    if points.len() <= 2 * buckets {
        return points.to_vec();
    }
    let size = points.len().div_ceil(buckets);
    points.chunks(size).flat_map(lowest_and_highest).collect()
}

fn lowest_and_highest(bucket: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    let (Some(low), Some(high)) = (bucket.iter().min_by(by_value), bucket.iter().max_by(by_value))
    else {
        return Vec::new();
    };
    if low.0 <= high.0 { vec![*low, *high] } else { vec![*high, *low] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_peak_survives() {
        let mut points: Vec<_> = (0..100_000).map(|k| (f64::from(k), 0.0)).collect();
        points[77_777].1 = 5.0;
        let thinned = thin(&points, 500);
        assert!(thinned.len() <= 1000);
        assert!(thinned.contains(&(77_777.0, 5.0)));
    }
}
