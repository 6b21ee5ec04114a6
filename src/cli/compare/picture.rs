//! Error maps of all machines side by side, as one SVG.

use crate::cli::failure::Failure;
use crate::cli::heat::{self, Scale};
use crate::cli::report::Map;
use guardbit::measure::comparison::{Compared, Comparison};
use std::fmt::Write as _;

const COLUMNS: usize = 4;
const GAP: u32 = 16;
const TITLE: u32 = 60;
/// Room for the words above a map, however narrow.
const WORDS: u32 = 240;

/// A map of the coverage and depth error of each machine.
pub(super) fn machines(
    compared: &mut Compared,
    comparison: &Comparison,
) -> Result<String, Failure> {
    let mut maps = Vec::new();
    for row in &comparison.machines {
        let (profile, stage) = compared.stage(row.name).map_err(Failure::input)?;
        maps.push(Map::draw(stage, &profile, 0, &comparison.scene, 280.0)?);
    }
    let [width, height] = maps.first().map_or([280, 280], |map| map.size);
    // Small windows are enlarged, pixel by pixel.
    let zoom = (280 / width.max(height).max(1)).max(1);
    let (width, height) = (width * zoom, height * zoom);
    let pitch = width.max(WORDS);
    let columns = u32::try_from(maps.len().clamp(1, COLUMNS)).unwrap_or(1);
    let rows = u32::try_from(maps.len().div_ceil(COLUMNS)).unwrap_or(1);
    let (whole, tall) = (GAP + columns * (pitch + GAP), 40 + rows * (height + TITLE + GAP) + 72);
    let title = format!("{}: coverage and depth against exact", comparison.scene);
    let mut svg = head([whole, tall], &title);
    let scale = Scale::of(maps.iter().map(|map| map.worst));
    for (n, (map, row)) in (0u32..).zip(maps.iter().zip(&comparison.machines)) {
        let (x, y) = (GAP + n % columns * (pitch + GAP), 40 + n / columns * (height + TITLE + GAP));
        let depth = row.depth_worst_ulp.map_or_else(String::new, |worst| {
            format!("depth off by up to {} ULP", super::number(worst))
        });
        let wrong = match (row.exact, row.coverage_differs) {
            (true, 0) => "coverage exact".to_owned(),
            (_, differs) => format!("{differs} samples differ"),
        };
        // Writing to a String cannot fail.
        let _ = write!(
            svg,
            "<text x=\"{x}\" y=\"{}\" font-size=\"14\">{} ({})</text>\n\
             <text x=\"{x}\" y=\"{}\" fill=\"#646464\">{wrong}</text>\n\
             <text x=\"{x}\" y=\"{}\" fill=\"#646464\">{depth}</text>\n\
             <image x=\"{x}\" y=\"{}\" width=\"{width}\" height=\"{height}\" \
             style=\"image-rendering: pixelated\" href=\"{}\"/>\n",
            y + 16,
            row.name,
            row.known_as,
            y + 33,
            y + 50,
            y + TITLE,
            map.uri(scale)?
        );
    }
    svg += &legend(scale, tall - 62);
    let _ = write!(
        svg,
        "<text x=\"{GAP}\" y=\"{}\" fill=\"#646464\">{}</text>\n</svg>\n",
        tall - 12,
        heat::WRONG
    );
    Ok(svg)
}

/// The scale of the depth errors, with its marks.
fn legend(scale: Scale, y: u32) -> String {
    const WIDE: u32 = 280;
    let colours: Vec<_> = heat::colours().collect();
    let last = u32::try_from(colours.len() - 1).unwrap_or(1);
    let mut svg =
        format!("<text x=\"{}\" y=\"{}\">depth error, ULP</text>\n", GAP + WIDE + 24, y + 10);
    for (n, [r, g, b]) in (0u32..).zip(&colours) {
        let [x, end] = [n, n + 1].map(|n| GAP + n * WIDE / (last + 1));
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"12\" fill=\"rgb({r} {g} {b})\"/>",
            end - x
        );
    }
    let marks: Vec<String> = scale.marks().collect();
    let last = u32::try_from(marks.len() - 1).unwrap_or(1);
    for (n, mark) in (0u32..).zip(&marks) {
        let x = GAP + n * WIDE / last;
        // Those at the ends stay below the scale.
        let anchor = if n == 0 {
            "start"
        } else if n == last {
            "end"
        } else {
            "middle"
        };
        let _ = writeln!(
            svg,
            "<text x=\"{x}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"#646464\">{mark}</text>",
            y + 26
        );
    }
    svg
}

/// The beginning of a picture with a title.
pub(super) fn head([width, height]: [u32; 2], title: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#282828\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <text x=\"{GAP}\" y=\"26\" font-size=\"16\">{}</text>\n",
        escaped(title)
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
