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
