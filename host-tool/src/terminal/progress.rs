//! Progress on the terminal; silent where there is none.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar for one long piece of work.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar that is full after `steps`.
    pub fn new(what: &str, steps: u64) -> Self {
        let bar = ProgressBar::new(steps);
        let template = "  {msg:26} {bar:36} {percent:>3} %  {eta}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(what.to_owned());
        Self { bar }
    }

    /// So far done.
    pub fn at(&self, step: u64) {
        self.bar.set_position(step);
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A line that says which step of several is under way.
#[derive(Debug)]
pub struct Steps {
    line: ProgressBar,
}

impl Steps {
    /// No step yet.
    pub fn new() -> Self {
        let line = ProgressBar::new_spinner();
        line.enable_steady_tick(std::time::Duration::from_millis(100));
        Self { line }
    }

    /// This step now.
    pub fn at(&self, step: &str) {
        self.line.set_message(step.to_owned());
    }

    /// Takes the line away.
    pub fn finish(&self) {
        self.line.finish_and_clear();
    }
}

impl Default for Steps {
    fn default() -> Self {
        Self::new()
    }
}
