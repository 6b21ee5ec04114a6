//! Pictures of a window, in and out.

use crate::cli::failure::Failure;
use crate::cli::heat::{BACKGROUND, Colour};
use crate::cli::pixels::{self, covered};
use guardbit::measure::envelope::{Class, Envelope, EnvelopeError};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

const MUST: Colour = [60, 160, 90];
const MAY: Colour = [225, 190, 60];

/// Which pixels a device covered.
pub(super) struct Covered {
    pub(super) size: (u32, u32),
    /// By rows.
    pub(super) pixels: Vec<bool>,
}

/// Reads a PNG, or the answers of `eval`.
pub(super) fn read(path: &Path, window: (u32, u32)) -> Result<Covered, Failure> {
    let name = path.display().to_string();
    let failed = |error: &std::io::Error| Failure::io(&name, error);
    let mut file = BufReader::new(File::open(path).map_err(|error| failed(&error))?);
    let start = file.fill_buf().map_err(|error| failed(&error))?;
    if start.starts_with(b"\x89PNG") {
        read_png(file, &name, window)
    } else {
        read_answers(file, &name, window)
    }
}

fn read_png(file: BufReader<File>, name: &str, window: (u32, u32)) -> Result<Covered, Failure> {
    let (pixels, size) =
        covered(file).map_err(|error| Failure::input(format!("{name}: {error}")))?;
    if size != window {
        let (width, height) = size;
        let error = EnvelopeError::Size { width, height, window };
        return Err(Failure::input(format!("{name}: {error}")));
    }
    Ok(Covered { size, pixels })
}

/// An answer of `eval`; its other members do not matter here.
#[derive(serde::Deserialize)]
struct Answer {
    rows: Option<Vec<[u32; 3]>>,
    error: Option<String>,
}

fn read_answers(file: impl BufRead, name: &str, window: (u32, u32)) -> Result<Covered, Failure> {
    let mut pixels = vec![false; window.0 as usize * window.1 as usize];
    let mut answers = 0;
    for (n, line) in file.lines().enumerate() {
        let place = format!("{name}: line {}", n + 1);
        let line = line.map_err(|error| match error.kind() {
            std::io::ErrorKind::InvalidData => Failure::input(format!(
                "{place}: neither a PNG nor UTF-8 text; give a PNG or the answers of `guardbit eval`"
            )),
            _ => Failure::io(name, &error),
        })?;
        if line.trim().is_empty() {
            continue;
        }
        let answer: Answer = serde_json::from_str(&line).map_err(|error| {
            Failure::input(format!("{place}: {error}"))
                .hint("a picture is a PNG, or JSON Lines with \"rows\": [[y, x0, x1], ...]")
        })?;
        if let Some(error) = answer.error {
            return Err(Failure::input(format!("{place}: the device answered an error: {error}")));
        }
        let rows = answer.rows.ok_or_else(|| {
            Failure::input(format!("{place}: the field `rows` is missing: [[y, x0, x1], ...]"))
        })?;
        for [y, x0, x1] in rows {
            if x0 > x1 || x1 > window.0 || y >= window.1 {
                return Err(Failure::input(format!(
                    "{place}: the run [{y}, {x0}, {x1}] is not in the window: y < {} and x0 <= x1 <= {} are needed",
                    window.1, window.0
                )));
            }
            let row = y as usize * window.0 as usize;
            pixels[row + x0 as usize..row + x1 as usize].fill(true);
        }
        answers += 1;
    }
    if answers == 0 {
        return Err(Failure::input(format!(
            "{name}: there is no picture; give a PNG or the answers of `guardbit eval`"
        )));
    }
    Ok(Covered { size: window, pixels })
}

/// Writes a window as PNG, small windows enlarged to about 256 pixels; says by how much.
pub(super) fn write(path: &Path, envelope: &Envelope) -> Result<u32, Failure> {
    let (width, height) = envelope.window;
    let zoom = (256 / width.max(height)).max(1);
    let colours: Vec<Colour> = envelope
        .classes()
        .map(|class| match class {
            Class::Must => MUST,
            Class::May => MAY,
            Class::MustNot => BACKGROUND,
        })
        .collect();
    pixels::write(path, (&colours, width), zoom, &[])?;
    Ok(zoom)
}
