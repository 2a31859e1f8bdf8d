//! A line of words.

/// Writes a line as `println!` does, where words go; a closed output is no failure.
#[macro_export]
macro_rules! say {
    ($($words:tt)*) => { $crate::terminal::output::try_print_line(format_args!($($words)*)) };
}
