//! Where in a file something is wrong.

/// A place in a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// Line, counted from 1.
    pub line: Option<usize>,
    /// Column of a table, by its name.
    pub column: Option<String>,
}

impl Place {
    /// A line, counted from 1.
    pub fn line(line: usize) -> Self {
        Self { line: Some(line), column: None }
    }

    /// A column by its name.
    pub fn column(name: impl Into<String>) -> Self {
        Self { line: None, column: Some(name.into()) }
    }

    /// The same place, narrowed to a column.
    pub fn and_column(self, name: impl Into<String>) -> Self {
        Self { column: Some(name.into()), ..self }
    }
}
