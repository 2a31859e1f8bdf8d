//! Which columns of which files make a log: the `[columns]` and `[streams]` of `dataset.toml`.

mod align;
mod assemble;
mod clock;
mod lag;
mod lane;
mod log;
mod message;
mod notes;
mod parse;
mod read;
mod source;
mod spec;
mod view;

pub use log::Mapped;
pub use notes::told;
pub(super) use parse::parse;
pub use read::{Needs, explain, lacks_time, read};
pub use spec::{Clock, ColumnSource, LogMapping, Mapping, StreamSource};
pub use view::View;
