//! Long work: on a thread of its own, with the interpreter free, heard of and stopped.

use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use host_tool::failure::Failure;
use pyo3::prelude::*;

use crate::failure::{Error, exception};

/// How often signals are looked for: nobody waits longer for Ctrl-C to be heard.
const SIGNALS_EVERY: Duration = Duration::from_millis(50);

/// What a thread says.
enum Said<T> {
    /// What is under way.
    Step(String),
    /// What came of it.
    Done(Result<T, Failure>),
}

/// Carried by the unwinding that ends work at its next step; nobody is told of it.
struct Stopped;

/// Runs work, which is handed a function that tells what is under way; `progress` is a Python
/// function of that sentence, or None.
///
/// Ctrl-C, or an exception in `progress`, is raised at once. The work ends at its next step, by
/// unwinding: it holds nothing that outlives its thread.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&dyn Fn(&str)) -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let is_stopped = Arc::new(AtomicBool::new(false));
    let (sender, mut receiver) = channel();
    let stopped = Arc::clone(&is_stopped);
    thread::spawn(move || {
        let steps = sender.clone();
        let done = work(&|step| tell(&steps, &stopped, step));
        // Nobody listens any more after Ctrl-C.
        let _ = sender.send(Said::Done(done));
    });
    let heard = listen(py, &mut receiver, progress.as_ref());
    is_stopped.store(heard.is_err(), Ordering::Relaxed);
    heard
}

fn tell<T>(steps: &Sender<Said<T>>, stopped: &AtomicBool, step: &str) {
    let is_heard = steps.send(Said::Step(step.to_owned())).is_ok();
    if stopped.load(Ordering::Relaxed) || !is_heard {
        resume_unwind(Box::new(Stopped));
    }
}

fn listen<T: Send>(
    py: Python<'_>,
    receiver: &mut Receiver<Said<T>>,
    progress: Option<&Py<PyAny>>,
) -> PyResult<T> {
    loop {
        let next = &mut *receiver;
        match py.detach(move || next.recv_timeout(SIGNALS_EVERY)) {
            Ok(Said::Done(done)) => return done.map_err(|failure| exception(&failure)),
            Ok(Said::Step(step)) => {
                if let Some(progress) = progress {
                    progress.call1(py, (step,))?;
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Error::new_err("the work ended in an internal error, told above"));
            }
        }
        py.check_signals()?;
    }
}
