//! The same scene through several profiles: a table, and a picture of each.

use super::picture::head;
use super::{Arguments, interruptible};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::heat::{BACKGROUND, Colour};
use crate::cli::output::{Output, check_place, write_text};
use crate::cli::report::data_uri;
use guardbit::measure::accuracy::Reference;
use guardbit::measure::gallery::{COLOUR_LIMIT, Mark, Panel, panel};
use guardbit::profile::{self, Profile};
use guardbit::scene::{self, Viewport};
use serde::Serialize;
use std::fmt::Write as _;

/// The real rasterizers among the built-in profiles, each once.
const REAL: [&str; 15] = [
    "d3d11",
    "vulkan-8bit",
    "vulkan-4bit",
    "larrabee",
    "ps1",
    "ps1-rtl",
    "vortex",
    "psp",
    "voodoo",
    "virge",
    "n64",
    "n64-rtl",
    "rasterix",
    "picogs",
    "graphite",
];
/// Window without --window: small enough that pixels are seen.
const WINDOW: (u32, u32) = (96, 72);
/// Longer side of a panel in the picture.
const SIDE: u32 = 288;
const COLUMNS: u32 = 4;
const GAP: u32 = 16;
const TITLE: u32 = 56;

#[derive(Serialize)]
struct Report<'a> {
    scene: &'a str,
    window: [u32; 2],
    triangles: usize,
    profiles: &'a [Panel],
}

pub(super) fn show(arguments: &Arguments, names: &[String]) -> Result<Outcome, Failure> {
    if let Some(path) = &arguments.svg {
        check_place(path)?;
    }
    let names: Vec<&str> = match names {
        [all] if all == "all" => REAL.to_vec(),
        names => names.iter().map(String::as_str).collect(),
    };
    let profiles: Vec<Profile> =
        names.iter().map(|name| profile::load(name)).collect::<Result<_, _>>()?;
    let base = profile::load(&arguments.profile)?;
    let (width, height) = arguments.window.unwrap_or(WINDOW);
    let scene = scene::load(&arguments.scene, &Viewport { width, height, depth_max: 1 })?;
    let size = [width, height];
    let reference = Reference::new(scene, &base);
    let panels = interruptible(|go_on| {
        let mut panels = Vec::new();
        for profile in &profiles {
            if !go_on() {
                break;
            }
            panels.push(
                panel(&reference, profile, size)
                    .map_err(|error| Failure::input(format!("{}: {error}", profile.name)))?,
            );
        }
        Ok(panels)
    })?;
    if let Some(path) = &arguments.svg {
        write_text(path, &picture(&reference, &panels)?)?;
    }
    let mut output = Output::new();
    if arguments.json {
        let (triangles, scene) = (reference.triangles.len(), reference.name.as_str());
        output.json(&Report { scene, window: size, triangles, profiles: &panels })?;
    } else {
        print(&mut output, &reference, size, &panels)?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}

fn print(
    output: &mut Output,
    scene: &Reference,
    size: [u32; 2],
    panels: &[Panel],
) -> Result<(), Failure> {
    output.line(format!(
        "{}: {} x {}, {} triangles; each profile is compared with the scene before snapping, at the samples of the profile",
        scene.name,
        size[0],
        size[1],
        scene.triangles.len()
    ))?;
    output.line("")?;
    output.line(
        "profile         machine           refused     hits    holes  too few too many  outside  \
         colours off    worst",
    )?;
    for panel in panels {
        let count = panel.colours_off.map_or("-".to_owned(), |off| off.to_string());
        let worst = panel.colour_worst.map_or("-".to_owned(), |worst| format!("{worst:.1}"));
        output.line(format!(
            "{:<15} {:<16} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>12} {:>8}",
            panel.profile,
            panel.machine,
            panel.refused,
            panel.hits,
            panel.holes,
            panel.too_few,
            panel.too_many,
            panel.outside,
            count,
            worst
        ))?;
    }
    output.line("")?;
    output.line(format!(
        "holes: pixels of the scene that no triangle hits; too few, too many: fewer or more hits than in the scene;\n\
         outside: hits outside their triangle, where only the guard clamp keeps a colour in its range;\n\
         colours off: hits whose colour is more than {COLOUR_LIMIT} of 255 from the exact colour, for machines with channels"
    ))
}

const WHITE: Colour = [255, 255, 255];
const MAGENTA: Colour = [255, 0, 255];
const YELLOW: Colour = [250, 200, 40];
const ORANGE: Colour = [235, 110, 40];
const GREY: Colour = [104, 116, 128];

/// Each profile's picture, and below it what differs.
fn picture(scene: &Reference, panels: &[Panel]) -> Result<String, Failure> {
    let [width, height] = panels.first().map_or([1, 1], |panel| panel.size);
    let zoom = (SIDE / width.max(height)).max(1);
    let (wide, high) = (width * zoom, height * zoom);
    let pitch = wide.max(200);
    let count = u32::try_from(panels.len()).unwrap_or(1).max(1);
    let columns = count.min(COLUMNS);
    let each = 2 * high + GAP / 2 + TITLE + GAP;
    let (whole, tall) = (GAP + columns * (pitch + GAP), 44 + count.div_ceil(columns) * each + 30);
    let name = &scene.name;
    let title = format!("{name} with {count} rasterizers, {width} x {height} pixels");
    let mut svg = head([whole, tall], &title);
    for (n, panel) in (0u32..).zip(panels) {
        let (x, y) = (GAP + n % columns * (pitch + GAP), 44 + n / columns * each);
        let colours =
            panel.colours_off.map_or_else(String::new, |off| format!(", {off} colours off"));
        // Writing to a String cannot fail.
        let _ = write!(
            svg,
            "<text x=\"{x}\" y=\"{}\" font-size=\"14\">{} ({})</text>\n\
             <text x=\"{x}\" y=\"{}\" fill=\"#646464\">{} holes, {} too few, {} too many</text>\n\
             <text x=\"{x}\" y=\"{}\" fill=\"#646464\">{} hits{colours}</text>\n",
            y + 14,
            panel.profile,
            panel.machine,
            y + 31,
            panel.holes,
            panel.too_few,
            panel.too_many,
            y + 47,
            panel.hits
        );
        for (at, pixels) in
            [(y + TITLE, shaded(panel)), (y + TITLE + high + GAP / 2, marked(panel))]
        {
            let (pixels, palette) = pixels;
            let uri = data_uri(panel.size, &pixels, palette)?;
            let _ = writeln!(
                svg,
                "<image x=\"{x}\" y=\"{at}\" width=\"{wide}\" height=\"{high}\" \
                 style=\"image-rendering: pixelated\" href=\"{uri}\"/>"
            );
        }
    }
    let _ = write!(
        svg,
        "<text x=\"{GAP}\" y=\"{}\" fill=\"#646464\">Below each: grey as in the scene, white a hole, yellow too \
         few hits, magenta too many, orange a colour that is off.</text>\n</svg>\n",
        tall - 12
    );
    Ok(svg)
}

/// The picture in 6 levels a channel.
fn shaded(panel: &Panel) -> (Vec<u8>, Vec<u8>) {
    let level = |code: u8| u8::try_from((u32::from(code) * 5 + 127) / 255).unwrap_or(5);
    let pixels = panel.colour.iter().zip(&panel.marks).map(|([r, g, b], mark)| match mark {
        Mark::Empty | Mark::Hole => 216,
        _ => 36 * level(*r) + 6 * level(*g) + level(*b),
    });
    let levels = (0..216u8).flat_map(|n| [n / 36, n / 6 % 6, n % 6].map(|level| level * 51));
    (pixels.collect(), levels.chain(BACKGROUND).collect())
}

/// What differs.
fn marked(panel: &Panel) -> (Vec<u8>, Vec<u8>) {
    let pixels = panel.marks.iter().map(|mark| match mark {
        Mark::Empty => 0,
        Mark::Right => 1,
        Mark::Hole => 2,
        Mark::TooFew => 3,
        Mark::TooMany => 4,
        Mark::Colour => 5,
    });
    let palette = [BACKGROUND, GREY, WHITE, YELLOW, MAGENTA, ORANGE];
    (pixels.collect(), palette.into_iter().flatten().collect())
}
