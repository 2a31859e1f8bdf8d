//! What was computed last along a motion: most of what is tried after another has a body that was tried before.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use rig::plant::Body;

/// Bodies that are kept: those of the fits that run side by side, and of the models that they began with.
const KEPT: usize = 4;

/// What a few bodies made of a motion, the last one first.
#[derive(Debug)]
pub struct Last<T>(Mutex<VecDeque<(Body, Arc<T>)>>);

impl<T> Last<T> {
    /// What this body makes of it; computed where it is not kept.
    pub fn of(&self, body: &Body, make: impl FnOnce() -> T) -> Arc<T> {
        let last = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = last().iter().find(|(of, _)| of == body) {
            return Arc::clone(known);
        }
        let made = Arc::new(make());
        let mut last = last();
        last.truncate(KEPT - 1);
        last.push_front((body.clone(), Arc::clone(&made)));
        made
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
        let asked = [0.0, 0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.3, 0.2];
        assert_eq!(asked.map(&mut of), asked);
        assert_eq!((of(0.0), made), (0.0, 6));
    }
}
