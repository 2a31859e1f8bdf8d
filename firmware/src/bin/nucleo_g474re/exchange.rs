//! What passes between the tick and the tasks: without locks, so the tick never waits.
//!
//! A task puts one question at a time into a queue and waits for the answer, which the
//! next tick gives. The tick puts its records into another queue and drops them, counted,
//! when it is full.

use core::sync::atomic::{AtomicBool, AtomicU8, AtomicU32, Ordering::Relaxed};

use cortex_m::singleton;
use embassy_time::{Duration, Instant};
use firmware::link::{SupervisorAccess, SupervisorStatus};
use firmware::supervisor::{Order, OrderError, State, TickRecord};
use firmware::{Controller, ParameterBlock};

use crate::queue::{Consumer, Producer, Queue};

type Controllers = Queue<Controller, 1>;
type Questions = Queue<Question, 1>;
type Replies = Queue<Reply, 1>;
/// What the line may do meanwhile [ticks].
const RECORDS: usize = 32;
type Records = Queue<TickRecord, RECORDS>;
/// The end at which the tasks take the tick's records out.
pub type RecordReader = Consumer<TickRecord, RECORDS>;

/// By then the tick has answered, whenever it was asked.
const ANSWERED_AFTER: Duration = Duration::from_millis(4);

/// What the tick is asked.
#[derive(Clone, Copy)]
pub enum Question {
    /// What the supervisor's status is.
    Status,
    /// To carry this out.
    Order(Order),
    /// To take the controller that waits.
    Replace,
}

/// What the tick answers.
pub struct Reply {
    /// Whether it was done.
    pub outcome: Result<(), OrderError>,
    /// The status after it.
    pub status: SupervisorStatus,
}

/// The tasks' end.
pub struct Remote {
    controllers: Producer<Controller, 1>,
    questions: Producer<Question, 1>,
    replies: Consumer<Reply, 1>,
    status: SupervisorStatus,
}

/// The tick's end.
pub struct Inbox {
    pub controllers: Consumer<Controller, 1>,
    pub questions: Consumer<Question, 1>,
    pub replies: Producer<Reply, 1>,
    pub records: Producer<TickRecord, RECORDS>,
}

/// Both ends and the tick's records; `None` the second time.
pub fn channel() -> Option<(Remote, RecordReader, Inbox)> {
    let controllers = singleton!(: Controllers = Queue::new())?.split();
    let questions = singleton!(: Questions = Queue::new())?.split();
    let replies = singleton!(: Replies = Queue::new())?.split();
    let records = singleton!(: Records = Queue::new())?.split();
    let remote = Remote {
        controllers: controllers.0,
        questions: questions.0,
        replies: replies.1,
        status: SupervisorStatus::default(),
    };
    let inbox = Inbox {
        controllers: controllers.1,
        questions: questions.1,
        replies: replies.0,
        records: records.0,
    };
    Some((remote, records.1, inbox))
}

impl Remote {
    /// Waits for the next tick, 1 ms at most; the tick itself waits for nothing.
    fn ask(&mut self, question: Question) -> Result<(), OrderError> {
        // An answer that came too late for an earlier question.
        while self.replies.dequeue().is_some() {}
        let asked = self.questions.enqueue(question);
        let end = Instant::now() + ANSWERED_AFTER;
        while asked && Instant::now() < end {
            if let Some(reply) = self.replies.dequeue() {
                self.status = reply.status;
                return reply.outcome;
            }
        }
        Err(OrderError::NotNow { state: self.status.state })
    }
}

impl SupervisorAccess for Remote {
    fn refresh(&mut self) {
        // If the tick does not answer, the last status stands.
        let _ = self.ask(Question::Status);
    }

    fn status(&self) -> SupervisorStatus {
        self.status
    }

    fn order(&mut self, order: Order) -> Result<(), OrderError> {
        self.ask(Question::Order(order))
    }

    fn replace(&mut self, block: &ParameterBlock) -> Result<(), OrderError> {
        match self.controllers.enqueue(Controller::new(block.clone())) {
            true => self.ask(Question::Replace),
            // An earlier one still waits.
            false => Err(OrderError::NotNow { state: self.status.state }),
        }
    }
}

/// The values that tick and tasks share without a queue.
pub struct Shared {
    pub ticks: AtomicU32,
    /// Ticks that were not done when the next one was due.
    pub overruns: AtomicU32,
    /// Longest time from the timer's event to the end of the tick [0.1 us].
    pub longest_tenth_us: AtomicU32,
    state: AtomicU8,
    /// Records that found no room.
    pub records_dropped: AtomicU32,
    /// Whether records are wanted; written by the link.
    pub streaming: AtomicBool,
    /// The host was heard; set by the link, taken by the tick.
    pub host_heard: AtomicBool,
    /// The clock that ticks is not true; written by the clock's watch.
    pub clock_wrong: AtomicBool,
}

/// Written by the tick, but for what the link writes.
pub static SHARED: Shared = Shared {
    ticks: AtomicU32::new(0),
    overruns: AtomicU32::new(0),
    longest_tenth_us: AtomicU32::new(0),
    state: AtomicU8::new(State::Boot as u8),
    records_dropped: AtomicU32::new(0),
    streaming: AtomicBool::new(false),
    host_heard: AtomicBool::new(false),
    clock_wrong: AtomicBool::new(false),
};

impl Shared {
    /// What the supervisor does, for the lamp and the log.
    pub fn state(&self) -> State {
        let byte = self.state.load(Relaxed);
        State::ALL.into_iter().find(|state| *state as u8 == byte).unwrap_or_default()
    }

    /// Publishes the supervisor's state.
    pub fn set_state(&self, state: State) {
        self.state.store(state as u8, Relaxed);
    }
}
