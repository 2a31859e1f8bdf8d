//! What was computed last along a motion: most of what is tried after another has a body that was tried before.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rig::plant::Body;

/// Bodies that are kept: those of the fits that run side by side, and of the models that they began with.
const KEPT: usize = 4;

/// What a few bodies made of a motion, the last one first.
#[derive(Debug)]
pub struct Last<T>(Mutex<VecDeque<(Body, Arc<T>)>>);

impl<T> Last<T> {
    /// What this body makes of it; computed where it is not kept.
    pub fn of(&self, body: &Body, make: impl FnOnce() -> T) -> Arc<T> {
        if let Some(known) = self.again(body) {
            return known;
        }
        // Made while others may look: two that ask at once make it twice.
        let made = Arc::new(make());
        let mut last = self.lock();
        last.truncate(KEPT - 1);
        last.push_front((body.clone(), Arc::clone(&made)));
        made
    }

    /// What is kept of this body, which is the last one then.
    fn again(&self, body: &Body) -> Option<Arc<T>> {
        let mut last = self.lock();
        let place = last.iter().position(|(of, _)| of == body)?;
        let found = last.remove(place)?;
        let known = Arc::clone(&found.1);
        last.push_front(found);
        Some(known)
    }

    fn lock(&self) -> MutexGuard<'_, VecDeque<(Body, Arc<T>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> Default for Last<T> {
    fn default() -> Self {
        Self(Default::default())
    }
}

/// A copy is of a motion that may change: it has been asked for nothing yet.
impl<T> Clone for Last<T> {
    fn clone(&self) -> Self {
        Self::default()
    }
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;

    use super::*;

    /// The reference robot's with another mass.
    fn body(payload_kg: f64) -> Body {
        let mut body = Body::of_robot(&reference_robot());
        body.add_payload(payload_kg, Default::default());
        body
    }

    #[test]
    fn bodies_that_come_again_are_not_computed_again() {
        let (last, mut made) = (Last::default(), 0);
        let mut of = |payload_kg: f64| {
            *last.of(&body(payload_kg), || {
                made += 1;
                payload_kg
            })
        };
        let asked = [0.0, 0.1, 0.2, 0.3, 0.0, 0.4, 0.3, 0.2];
        assert_eq!(asked.map(&mut of), asked);
        assert_eq!((of(0.0), of(0.1), made), (0.0, 0.1, 6));
    }
}
