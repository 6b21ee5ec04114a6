//! Charts as SVG text.

mod axis;

use axis::Axis;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::iter::repeat;

/// The points of one colour.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    /// What the legend calls it.
    pub(crate) name: String,
    /// x and y; what is not finite, or not above zero on a logarithmic axis, is left out.
    pub(crate) points: Vec<(f64, f64)>,
    /// A word beside each point; missing ones are left out.
    pub(crate) labels: Vec<String>,
    /// Whether a point is drawn as a ring and not filled; missing ones are filled.
    pub(crate) hollow: Vec<bool>,
}

/// A chart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chart {
    /// What is shown, in one line.
    pub(crate) title: String,
    /// What x is, with its unit.
    pub(crate) x_label: String,
    /// What y is, with its unit.
    pub(crate) y_label: String,
    /// Whether x is logarithmic.
    pub(crate) log_x: bool,
    /// Whether y is logarithmic.
    pub(crate) log_y: bool,
    /// What is drawn, in the order of the legend.
    pub(crate) series: Vec<Series>,
    /// Whether the points of a series are joined.
    pub(crate) line: bool,
    /// Below the chart: where the figures come from.
    pub(crate) caption: String,
}

const SIZE: (u32, u32) = (960, 600);
/// Lines that a legend has room for.
const LEGEND: usize = 18;
/// Heights of text as the library takes them; it writes 1 / 1.24 of them as the font size.
const TITLE: i32 = 25;
const TEXT: i32 = 18;
const SMALL: i32 = 15;
/// Without font files a character is taken to be about this share of its height wide.
const WIDE: f64 = 0.5;

/// Told apart with any colour vision, on white.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(70, 70, 70),
];
/// Dark to light in even steps, for more series than there are colours: their order then shows.
const RAMP: [RGBColor; 5] = [
    RGBColor(68, 1, 84),
    RGBColor(59, 82, 139),
    RGBColor(33, 145, 140),
    RGBColor(94, 201, 98),
    RGBColor(222, 200, 20),
];
const INK: RGBColor = RGBColor(40, 40, 40);
const PALE: RGBColor = RGBColor(100, 100, 100);
const GRID: RGBColor = RGBColor(226, 226, 226);

fn text(size: i32, colour: RGBColor, h: HPos, v: VPos) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&colour).pos(Pos::new(h, v))
}

/// The chart as an SVG document.
pub(crate) fn svg(chart: &Chart) -> String {
    let mut out = String::new();
    // The backend writes to a string, which takes all of it.
    draw(chart, SVGBackend::with_string(&mut out, SIZE))
        .unwrap_or_else(|error| unreachable!("{error}"));
    out
}

type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

fn draw<'a>(chart: &Chart, backend: SVGBackend<'a>) -> Drawn<'a> {
    let fits = |&(x, y): &(f64, f64)| {
        x.is_finite() && y.is_finite() && (x > 0.0 || !chart.log_x) && (y > 0.0 || !chart.log_y)
    };
    let all = || chart.series.iter().flat_map(|series| &series.points).filter(|point| fits(point));
    let x_axis = Axis::new(all().map(|point| point.0), chart.log_x);
    let y_axis = Axis::new(all().map(|point| point.1), chart.log_y);
    let area = backend.into_drawing_area();
    area.fill(&WHITE)?;
    let [width, height] = [SIZE.0, SIZE.1].map(u32::cast_signed);
    let legend = legend_width(&chart.series);
    let lines = wrap(&chart.caption, characters(width - 48, SMALL));
    let caption = 18 * i32::try_from(lines.len()).unwrap_or(0);
    let centre = (84 + width - legend) / 2;
    area.draw_text(&chart.title, &text(TITLE, INK, HPos::Center, VPos::Center), (centre, 30))?;
    for (line, y) in lines.iter().zip((height - caption - 2..).step_by(18)) {
        area.draw_text(line, &text(SMALL, PALE, HPos::Left, VPos::Center), (24, y))?;
    }
    draw_legend(chart, &area, width - legend)?;
    let mut plot = ChartBuilder::on(&area)
        .margin_top(56)
        .margin_left(16)
        .margin_right(legend)
        .margin_bottom(caption + 18)
        .x_label_area_size(52)
        .y_label_area_size(76)
        .build_cartesian_2d(x_axis.clone(), y_axis.clone())?;
    plot.configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(PALE)
        .x_desc(&chart.x_label)
        .y_desc(&chart.y_label)
        .axis_desc_style(("sans-serif", TEXT).into_font().color(&INK))
        .label_style(("sans-serif", SMALL).into_font().color(&INK))
        .x_label_formatter(&|tick| x_axis.text(*tick))
        .y_label_formatter(&|tick| y_axis.text(*tick))
        .draw()?;
    if all().next().is_none() {
        let style = text(TEXT, PALE, HPos::Center, VPos::Center);
        area.draw_text("no data", &style, (centre, height / 2))?;
    }
    let mut words = Vec::new();
    for (n, series) in chart.series.iter().enumerate() {
        let colour = colour(n, chart.series.len());
        let labels = series.labels.iter().map(String::as_str).chain(repeat(""));
        let points = series.points.iter().zip(labels).filter(|(point, _)| fits(point));
        let points: Vec<_> =
            points.map(|((x, y), label)| ((x_axis.place(*x), y_axis.place(*y)), label)).collect();
        let places = points.iter().map(|(place, _)| *place);
        if chart.line {
            plot.draw_series(LineSeries::new(places.clone(), colour.stroke_width(2)))?;
        }
        let rings = series.points.iter().zip(series.hollow.iter().copied().chain(repeat(false)));
        let rings = rings.filter(|(point, _)| fits(point)).map(|(_, ring)| ring);
        plot.draw_series(places.zip(rings).map(|(place, ring)| {
            let style = if ring { colour.stroke_width(1) } else { colour.filled() };
            Circle::new(place, 4, style)
        }))?;
        for (place, label) in points.iter().filter(|(_, label)| !label.is_empty()) {
            let (x, y) = plot.backend_coord(place);
            // Above the point, or below it where another word stands already.
            let crowded = |words: &Vec<(i32, i32)>, y: i32| {
                words.iter().any(|(a, b)| (a - x).abs() < 18 && (b - y).abs() < 14)
            };
            let (v, at) =
                if crowded(&words, y - 8) { (VPos::Top, y + 9) } else { (VPos::Bottom, y - 8) };
            words.push((x, at));
            area.draw_text(label, &text(SMALL, INK, HPos::Center, v), (x, at))?;
        }
    }
    area.present()
}

/// The colour of one of so many series.
fn colour(n: usize, count: usize) -> RGBColor {
    if count <= COLOURS.len() {
        return COLOURS[n];
    }
    let (steps, scaled) = (count - 1, n * (RAMP.len() - 1));
    let (below, part) = (scaled / steps, scaled % steps);
    let above = (below + 1).min(RAMP.len() - 1);
    let mix = |channel: fn(&RGBColor) -> u8| {
        let [from, to] = [below, above].map(|n| usize::from(channel(&RAMP[n])));
        u8::try_from((from * (steps - part) + to * part) / steps).unwrap_or(u8::MAX)
    };
    RGBColor(mix(|c| c.0), mix(|c| c.1), mix(|c| c.2))
}

/// Room right of the plot; a single series needs no legend.
fn legend_width(series: &[Series]) -> i32 {
    if series.len() < 2 {
        return 28;
    }
    let longest = series.iter().map(|series| series.name.chars().count()).max().unwrap_or(0);
    (1..=40).find(|n| characters(n * 8, TEXT) >= longest).unwrap_or(40) * 8 + 56
}

fn draw_legend<'a>(
    chart: &Chart,
    area: &DrawingArea<SVGBackend<'a>, plotters::coord::Shift>,
    left: i32,
) -> Drawn<'a> {
    if chart.series.len() < 2 {
        return Ok(());
    }
    let count = chart.series.len();
    let most = if count > LEGEND { LEGEND - 1 } else { count };
    if let (true, Some(y)) = (count > most, (72..).step_by(24).nth(most)) {
        let style = text(TEXT, PALE, HPos::Left, VPos::Center);
        area.draw_text(&format!("and {} more", count - most), &style, (left + 48, y))?;
    }
    for (n, (series, y)) in chart.series.iter().zip((72..).step_by(24)).enumerate().take(most) {
        let colour = colour(n, count);
        if chart.line {
            let ends = vec![(left + 16, y), (left + 40, y)];
            area.draw(&PathElement::new(ends, colour.stroke_width(2)))?;
        }
        area.draw(&Circle::new((left + 28, y), 4, colour.filled()))?;
        let style = text(TEXT, INK, HPos::Left, VPos::Center);
        area.draw_text(&series.name, &style, (left + 48, y))?;
    }
    Ok(())
}

/// How many characters of this height go into so many pixels.
fn characters(pixels: i32, size: i32) -> usize {
    // Both are small and positive.
    let count = f64::from(pixels) / (f64::from(size) * WIDE);
    (0..1000).take_while(|n| f64::from(*n) < count.floor()).count()
}

/// Lines of at most so many characters, broken at blanks.
fn wrap(text: &str, limit: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests;
