//! One case after the other on each core.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::ScopedJoinHandle;

use crate::failure::Failure;

/// Has each case done once, by as many workers as there are cores, each without help of the
/// others; what comes of them is in no order.
pub(super) fn on_all_cores<C: Sync, O: Send>(
    cases: &[C],
    one: &(dyn Fn(&C) -> Result<O, Failure> + Sync),
) -> Result<Vec<O>, Failure> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let all = std::thread::scope(|scope| {
        let begin = |_| scope.spawn(|| some_of(cases, &next, one));
        let workers: Vec<_> = (0..workers).map(begin).collect();
        workers.into_iter().map(ScopedJoinHandle::join).collect::<Vec<_>>()
    });
    let mut outcomes = Vec::with_capacity(cases.len());
    for some in all {
        let stopped = |_| Failure::new("a diagnosis was aborted", "");
        outcomes.extend(some.map_err(stopped)??);
    }
    Ok(outcomes)
}

/// What one worker does.
fn some_of<C: Sync, O: Send>(
    cases: &[C],
    next: &AtomicUsize,
    one: &(dyn Fn(&C) -> Result<O, Failure> + Sync),
) -> Result<Vec<O>, Failure> {
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let alone = alone.map_err(|error| Failure::new(error.to_string(), ""))?;
    let mut outcomes = Vec::new();
    while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
        outcomes.push(alone.install(|| one(case))?);
    }
    Ok(outcomes)
}
