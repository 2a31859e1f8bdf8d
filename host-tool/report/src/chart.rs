//! One chart as SVG.

use std::io::Write as _;
use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

use super::axis::{Axis, bounds, padded, short};
use super::series::{Series, Stroke};
use super::thinning::thin;
use super::zoom::{FRAME, Line, SERIES, SERIES_END, exact, zoomable};
use files::replace::replace_file;
use files::{FileError, Problem};

/// A chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Title above it.
    pub title: String,
    /// Below it, with unit.
    pub x_label: String,
    /// Beside it, with unit.
    pub y_label: String,
    /// Scale of x.
    pub x_axis: Axis,
    /// Scale of y.
    pub y_axis: Axis,
    /// What is drawn, first at the bottom.
    pub series: Vec<Series>,
    /// Lowest and highest x, where the data are not to choose.
    pub x_range: Option<(f64, f64)>,
    /// Width and height [px]; 0 takes the standard 760 x 300.
    pub size_px: (u32, u32),
    /// Whether so many points are kept that a look at a part of x shows more.
    pub is_detailed: bool,
}

/// Colours that the colour-blind tell apart (Okabe and Ito), blue, vermilion, green first.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(110, 110, 110),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

const INK: RGBColor = RGBColor(40, 44, 52);
const GRID: RGBColor = RGBColor(226, 229, 233);
const POINTS_ACROSS: usize = 900;
/// Width of a wide line: on either side it shows one and a half pixels of itself beside the line upon it.
const WIDE_PX: u32 = 5;
/// The same of a chart that is looked at piece by piece.
const DETAILED_ACROSS: usize = 4000;

/// Height of a name in the legend.
const LEGEND_ROW_PX: f64 = 20.0;
/// Height of what is about the names.
const LEGEND_EDGE_PX: f64 = 16.0;
/// Height of title and labels together.
const AROUND_PX: f64 = 80.0;

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// A canvas with axes.
type OnAxes<'c, 'a, X, Y> = ChartContext<'c, SVGBackend<'a>, Cartesian2d<X, Y>>;
type DrawResult<'a> =
    Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// A mark in the drawing, which [`zoomable`] finds.
fn mark<'a>(canvas: &Canvas<'a>, text: &str) -> DrawResult<'a> {
    canvas.draw(&Text::new(text.to_owned(), (0, 0), ("sans-serif", 1).into_font()))
}

impl Chart {
    /// An empty chart.
    pub fn new(
        title: impl Into<String>,
        x_label: impl Into<String>,
        y_label: impl Into<String>,
    ) -> Self {
        Self {
            title: title.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            ..Self::default()
        }
    }

    /// With one more series.
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// With these scales.
    pub fn axes(self, x_axis: Axis, y_axis: Axis) -> Self {
        Self { x_axis, y_axis, ..self }
    }

    /// With points for a closer look.
    pub fn detailed(self) -> Self {
        Self { is_detailed: true, ..self }
    }

    /// With all series so far in another stroke.
    pub fn restroked(mut self, stroke: Stroke) -> Self {
        self.series.iter_mut().for_each(|series| series.stroke = stroke);
        self
    }

    /// With x from the lowest to the highest.
    pub fn x_from_to(self, lowest: f64, highest: f64) -> Self {
        Self { x_range: Some((lowest, highest)), ..self }
    }

    /// With this size [px].
    pub fn sized(self, width: u32, height: u32) -> Self {
        Self { size_px: (width, height), ..self }
    }

    /// The chart as an SVG element; a chart without points says so.
    pub fn to_svg(&self) -> String {
        let (width, height) = if self.size_px.0 == 0 { (760, 300) } else { self.size_px };
        let mut svg = String::new();
        {
            let canvas = SVGBackend::with_string(&mut svg, (width, height)).into_drawing_area();
            // Drawing into a string cannot fail.
            let _ = self.draw(&canvas);
            let _ = canvas.present();
        }
        match self.lines() {
            Some(lines) => exact(&zoomable(&svg), &lines),
            None => zoomable(&svg),
        }
    }

    /// The lines of a chart for a closer look, if it has nothing else.
    fn lines(&self) -> Option<Vec<Line>> {
        let line = |series: &Series| {
            let width = match series.stroke {
                Stroke::Line => self.line_px(),
                Stroke::Wide => WIDE_PX,
                _ => return None,
            };
            let RGBColor(red, green, blue) = PALETTE[series.colour % PALETTE.len()];
            let colour = format!("#{red:02X}{green:02X}{blue:02X}");
            Some((colour, width, thin(&self.drawable(series), DETAILED_ACROSS)))
        };
        self.is_detailed.then(|| self.series.iter().map(line).collect()).flatten()
    }

    /// Width of a line [px]: upon a wide one it must cover whole pixels, or both colours mix.
    fn line_px(&self) -> u32 {
        let is_upon = self.series.iter().any(|series| series.stroke == Stroke::Wide);
        if is_upon { 2 } else { 1 }
    }

    /// Writes the chart as an SVG file, whole or not at all.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write_svg(&self, path: &Path) -> Result<(), FileError> {
        let svg = self.to_svg();
        replace_file(path, |file| file.write_all(svg.as_bytes()).map_err(Problem::Unwritable))
    }

    fn draw<'a>(&self, canvas: &Canvas<'a>) -> DrawResult<'a> {
        canvas.fill(&WHITE)?;
        let Some((x, y)) = self.ranges() else {
            let style = ("sans-serif", 15).into_font().color(&INK);
            return canvas.draw(&Text::new(format!("{}: no data", self.title), (20, 20), style));
        };
        match (self.x_axis, self.y_axis) {
            (Axis::Linear, Axis::Linear) => self.draw_on(canvas, x.0..x.1, y.0..y.1),
            (Axis::Logarithmic, Axis::Linear) => {
                self.draw_on(canvas, (x.0..x.1).log_scale(), y.0..y.1)
            }
            (Axis::Linear, Axis::Logarithmic) => {
                self.draw_on(canvas, x.0..x.1, (y.0..y.1).log_scale())
            }
            (Axis::Logarithmic, Axis::Logarithmic) => {
                self.draw_on(canvas, (x.0..x.1).log_scale(), (y.0..y.1).log_scale())
            }
        }
    }

    fn draw_on<'a, X, Y>(&self, canvas: &Canvas<'a>, x: X, y: Y) -> DrawResult<'a>
    where
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: ValueFormatter<f64>,
        Y::CoordDescType: ValueFormatter<f64>,
    {
        let mut chart = ChartBuilder::on(canvas)
            .caption(&self.title, ("sans-serif", self.title_px()).into_font().color(&INK))
            .margin(10)
            .x_label_area_size(38)
            .y_label_area_size(62)
            .build_cartesian_2d(x, y)?;
        mark(canvas, &self.frame(&chart))?;
        chart
            .configure_mesh()
            .x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .axis_style(GRID)
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .label_style(("sans-serif", 12).into_font().color(&INK))
            .x_label_formatter(&|value| short(*value))
            .y_label_formatter(&|value| short(*value))
            .draw()?;
        mark(canvas, SERIES)?;
        for series in &self.series {
            self.draw_series(&mut chart, series)?;
        }
        mark(canvas, SERIES_END)?;
        if self.series.iter().any(|series| !series.name.is_empty()) {
            chart
                .configure_series_labels()
                .background_style(WHITE.mix(0.85))
                .border_style(GRID)
                .label_font(("sans-serif", 12).into_font().color(&INK))
                .position(SeriesLabelPosition::UpperRight)
                .draw()?;
        }
        Ok(())
    }

    fn draw_series<'a, X, Y>(
        &self,
        chart: &mut OnAxes<'_, 'a, X, Y>,
        series: &Series,
    ) -> DrawResult<'a>
    where
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let all = self.drawable(series);
        let across = if self.is_detailed { DETAILED_ACROSS } else { POINTS_ACROSS };
        let points = if series.stroke == Stroke::Area { all } else { thin(&all, across) };
        let colour = PALETTE[series.colour % PALETTE.len()];
        let drawn = match series.stroke {
            Stroke::Line => {
                let style = colour.stroke_width(self.line_px());
                chart.draw_series(LineSeries::new(points, style))?
            }
            Stroke::Wide => {
                chart.draw_series(LineSeries::new(points, colour.stroke_width(WIDE_PX)))?
            }
            Stroke::Broad => {
                let pale = colour.mix(0.35).stroke_width(4);
                chart.draw_series(LineSeries::new(points, pale))?
            }
            Stroke::Dashed => {
                let style = colour.stroke_width(2);
                chart.draw_series(DashedLineSeries::new(points, 6, 4, style))?
            }
            Stroke::Area => {
                let pale = colour.mix(0.18).filled();
                chart.draw_series(std::iter::once(Polygon::new(points, pale)))?
            }
            Stroke::Dots => {
                chart.draw_series(points.iter().map(|&p| Circle::new(p, 2, colour.filled())))?
            }
        };
        if !series.name.is_empty() {
            drawn.label(&series.name).legend(move |(x, y)| {
                PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(3))
            });
        }
        Ok(())
    }

    /// Where the axes lie and what they span, for who looks closer at a part; nothing of decades.
    fn frame<X, Y>(&self, chart: &OnAxes<'_, '_, X, Y>) -> String
    where
        X: Ranged<ValueType = f64>,
        Y: Ranged<ValueType = f64>,
    {
        let (x, y) = chart.plotting_area().get_pixel_range();
        match (self.x_axis, self.y_axis, self.ranges()) {
            (Axis::Linear, Axis::Linear, Some((across, up))) => format!(
                "{FRAME}{} {} {} {} {} {} {} {}",
                x.start, x.end, y.start, y.end, across.0, across.1, up.0, up.1
            ),
            _ => FRAME.to_owned(),
        }
    }

    /// Letters so small that the title fits.
    fn title_px(&self) -> f64 {
        const LARGEST: f64 = 17.0;
        const SMALLEST: f64 = 11.0;
        let width = if self.size_px.0 == 0 { 760.0 } else { f64::from(self.size_px.0) };
        (1.95 * width / self.title.chars().count().max(1) as f64).clamp(SMALLEST, LARGEST)
    }

    /// The points that the scales can show.
    fn drawable(&self, series: &Series) -> Vec<(f64, f64)> {
        let fits =
            |axis: Axis, value: f64| value.is_finite() && (axis == Axis::Linear || value > 0.0);
        let shown = |p: &&(f64, f64)| fits(self.x_axis, p.0) && fits(self.y_axis, p.1);
        series.points.iter().filter(shown).copied().collect()
    }

    /// The ranges of x and y over all series.
    #[allow(clippy::type_complexity)]
    fn ranges(&self) -> Option<((f64, f64), (f64, f64))> {
        let points: Vec<_> = self.series.iter().flat_map(|s| self.drawable(s)).collect();
        if points.is_empty() {
            return None;
        }
        let x = bounds(points.iter().map(|p| p.0));
        let y = bounds(points.iter().map(|p| p.1));
        let (low, high) = padded(y, self.y_axis, 0.06);
        // Room for the legend above the data.
        let named = self.series.iter().filter(|series| !series.name.is_empty()).count() as f64;
        let height = if self.size_px.1 == 0 { 300.0 } else { f64::from(self.size_px.1) };
        let legend_px = if named > 0.0 { LEGEND_ROW_PX * named + LEGEND_EDGE_PX } else { 0.0 };
        let part = (legend_px / (height - AROUND_PX).max(100.0)).min(0.5);
        let room = part / (1.0 - part);
        let high = match self.y_axis {
            Axis::Linear => high + room * (high - low),
            Axis::Logarithmic => high * (high / low).powf(room),
        };
        let x = self.x_range.unwrap_or_else(|| padded(x, self.x_axis, 0.0));
        Some((x, (low, high)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scale_draws() {
        let points: Vec<_> = (1..50).map(|k| (f64::from(k), f64::from(k * k))).collect();
        for x in [Axis::Linear, Axis::Logarithmic] {
            for y in [Axis::Linear, Axis::Logarithmic] {
                let chart = Chart::new("t", "x", "y").axes(x, y);
                let svg = chart.with(Series::line("a", 0, points.clone())).to_svg();
                assert!(svg.starts_with("<svg") && svg.contains("polyline"), "{svg}");
            }
        }
    }

    #[test]
    fn nothing_to_draw_is_said() {
        let nothing = Series::line("a", 0, vec![(f64::NAN, 1.0)]);
        assert!(Chart::new("Empty", "", "").with(nothing).to_svg().contains("no data"));
    }
}
