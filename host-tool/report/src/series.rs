//! A named set of points in a chart.

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stroke {
    /// A line.
    #[default]
    Line,
    /// A thick pale line, for what lies beneath.
    Broad,
    /// A wide line, for what another is to be seen upon.
    Wide,
    /// A broken line.
    Dashed,
    /// Dots.
    Dots,
    /// A pale area within a closed outline.
    Area,
}

/// A named set of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What the legend calls it.
    pub name: String,
    /// Points (x, y); those not finite are left out.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Which colour of the palette.
    pub colour: usize,
}

impl Series {
    /// A line in the palette's colour of that number.
    pub fn line(name: impl Into<String>, colour: usize, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, stroke: Stroke::Line, colour }
    }

    /// The same in another stroke.
    pub fn stroke(self, stroke: Stroke) -> Self {
        Self { stroke, ..self }
    }
}
