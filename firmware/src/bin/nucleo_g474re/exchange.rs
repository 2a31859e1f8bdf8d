//! What passes between the tick and the tasks: without locks, so the tick never waits.

use core::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

use cortex_m::singleton;
use firmware::Controller;
use firmware::message::Status;
use heapless::spsc::{Consumer, Producer, Queue};

/// A queue of N slots holds N - 1 things.
type Controllers = Queue<Controller, 2>;
type Commands = Queue<Command, 4>;

/// What the tick is told to do.
#[derive(Clone, Copy)]
pub enum Command {
    Start,
    Stop,
}

/// The tasks' end.
pub struct Orders {
    controllers: Producer<'static, Controller>,
    commands: Producer<'static, Command>,
}

impl Orders {
    /// Has the tick take another controller, as soon as it does not run; false if one waits.
    pub fn replace(&mut self, controller: Controller) -> bool {
        self.controllers.enqueue(controller).is_ok()
    }

    /// Has the tick carry out a command; false if too many wait.
    pub fn command(&mut self, command: Command) -> bool {
        self.commands.enqueue(command).is_ok()
    }
}

/// The tick's end.
pub struct Inbox {
    pub controllers: Consumer<'static, Controller>,
    pub commands: Consumer<'static, Command>,
}

/// Both ends; `None` the second time.
pub fn channel() -> Option<(Orders, Inbox)> {
    let controllers = singleton!(: Controllers = Queue::new())?.split();
    let commands = singleton!(: Commands = Queue::new())?.split();
    let orders = Orders { controllers: controllers.0, commands: commands.0 };
    Some((orders, Inbox { controllers: controllers.1, commands: commands.1 }))
}

/// What the tick tells about itself.
pub struct Report {
    pub ticks: AtomicU32,
    /// Ticks that were not done when the next one was due.
    pub overruns: AtomicU32,
    /// Longest time from the timer's event to the end of the tick [0.1 us].
    pub longest_tenth_us: AtomicU32,
    pub loaded: AtomicBool,
    pub running: AtomicBool,
    pub converter_fault: AtomicBool,
}

/// Written by the tick alone.
pub static REPORT: Report = Report {
    ticks: AtomicU32::new(0),
    overruns: AtomicU32::new(0),
    longest_tenth_us: AtomicU32::new(0),
    loaded: AtomicBool::new(false),
    running: AtomicBool::new(false),
    converter_fault: AtomicBool::new(false),
};

impl Report {
    /// What the host gets to see.
    pub fn status(&self, accepted: bool) -> Status {
        Status {
            accepted,
            loaded: self.loaded.load(Relaxed),
            running: self.running.load(Relaxed),
            overrun: self.overruns.load(Relaxed) > 0,
            converter_fault: self.converter_fault.load(Relaxed),
        }
    }
}
