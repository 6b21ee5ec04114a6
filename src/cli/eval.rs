//! `guardbit eval`: the live model on a pipe.

use super::Outcome;
use super::failure::Failure;
use guardbit::machine::{DrawError, Registers, Sink};
use guardbit::model::{Drawing, Model, Records, View};
use guardbit::profile;
use guardbit::scene::Triangle;
use guardbit::scene::lines::{self, Primitive};
use std::fmt::Write as _;
use std::io::{BufRead, Write};

/// Longest line read, so that input without newlines cannot fill the memory.
const LONGEST: u64 = 1 << 24;

/// Live model on a pipe: JSON Lines in, JSON Lines out, flushed line by line.
///
/// In: {"id": 7, "v": [[x,y,z],[x,y,z],[x,y,z]]}, integers in sub-pixels and depth ULPs, y down,
/// z optional; or "f" instead of "v": real numbers, x and y in pixels, z in depth ULPs,
/// {"bits": "7fc00000"} for NaN and infinities.
/// "line": [[x,y],[x,y]] and "point": [x,y] draw by the profile's rules, "polygon": [[x,y],...] and
/// "clip": [[X,Y,Z,W],...] on machines that take them.
/// "words": ["...", ...] are registers in the profile's radix, on profiles that begin there.
/// Out: {"id": 7, "rows": [[y, x0, x1], ...], "z": [...], "events": {...}}; "masks", one a pixel, where
/// the profile has several samples. Registers are answered by {"id": 7, "out": [["P", ...], ...]}, one
/// list a record as the hardware draws them, and "masked": [...] names words with bits that no field
/// holds.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// Window instead of the profile's, as WIDTHxHEIGHT.
    #[arg(long, value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// Draw only pixels [X0, X1) by [Y0, Y1), as X0,Y0,X1,Y1.
    #[arg(long, value_parser = super::parse_rect)]
    scissor: Option<guardbit::cover::Rect>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let profile = profile::load(&arguments.profile)?;
    let view = View { window: arguments.window, scissor: arguments.scissor, ..View::default() };
    let model = Model::with_view(&profile, view).map_err(Failure::input)?;
    let mut input = std::io::stdin().lock();
    let mut output = std::io::stdout().lock();
    let mut drawing = Drawing::default();
    let (mut line, mut answer) = (Vec::new(), String::new());
    let (mut number, mut all_good) = (0u64, true);
    loop {
        line.clear();
        let read = std::io::Read::take(&mut input, LONGEST)
            .read_until(b'\n', &mut line)
            .map_err(|error| Failure::io("standard input", &error))?;
        if read == 0 {
            break;
        }
        number += 1;
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        answer.clear();
        if read as u64 == LONGEST && line.last() != Some(&b'\n') {
            input.skip_until(b'\n').map_err(|error| Failure::io("standard input", &error))?;
            let message = format!("line {number}: longer than {LONGEST} bytes");
            let _ = write!(answer, "{{\"id\": null, \"error\": \"{message}\"}}");
            all_good = false;
        } else {
            all_good &= reply(&model, &line, number, &mut drawing, &mut answer);
        }
        answer.push('\n');
        output
            .write_all(answer.as_bytes())
            .and_then(|()| output.flush())
            .map_err(|error| Failure::io("standard output", &error))?;
    }
    Ok(if all_good { Outcome::Good } else { Outcome::BadInput })
}

/// Answers one line; false for an error answer.
fn reply(
    model: &Model,
    line: &[u8],
    number: u64,
    drawing: &mut Drawing,
    answer: &mut String,
) -> bool {
    let refuse = |answer: &mut String, id: Option<&str>, message: &str| {
        let message =
            serde_json::to_string(&format!("line {number}: {message}")).unwrap_or_default();
        // Writing to a String cannot fail.
        let _ = write!(answer, "{{\"id\": {}, \"error\": {message}}}", id.unwrap_or("null"));
        false
    };
    let Ok(text) = std::str::from_utf8(line) else {
        return refuse(answer, None, "not UTF-8 text");
    };
    let request = match lines::parse_line(text.trim_end()) {
        Ok(request) => request,
        Err(error) => return refuse(answer, error.id.as_deref(), &error.to_string()),
    };
    let id = request.id.as_deref();
    let primitive = &request.primitive;
    if has_depth(primitive) && model.depth().is_none() {
        let key = primitive.key();
        let message = format!("field `{key}`: the profile has no [depth], so a vertex has no z");
        return refuse(answer, id, &message);
    }
    if let Primitive::Words(words) = primitive {
        return match reply_words(model, words, id, answer) {
            Ok(()) => true,
            Err(message) => refuse(answer, id, &format!("field `words`: {message}")),
        };
    }
    drawing.clear();
    let drawn = draw(model, primitive, drawing);
    match drawn {
        Err(error) => refuse(answer, id, &error),
        Ok(has_depth) => {
            write_answer(answer, id, drawing, has_depth);
            true
        }
    }
}

/// Answers registers with records.
fn reply_words(
    model: &Model,
    words: &[String],
    id: Option<&str>,
    answer: &mut String,
) -> Result<(), String> {
    struct Lines<'a> {
        registers: &'a Registers,
        answer: &'a mut String,
        rows: u64,
    }
    impl Sink for Lines<'_> {
        fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

        fn record(&mut self, kind: usize, values: &[i64]) {
            self.rows += 1;
            if self.rows > Records::MOST {
                return;
            }
            self.answer.push_str(if self.rows == 1 { "[\"" } else { ", [\"" });
            self.registers.push_record(kind, values, "\", \"", self.answer);
            self.answer.push_str("\"]");
        }
    }
    let Some(registers) = model.registers() else {
        return Err("this profile's machine draws primitives, not set-up registers".to_owned());
    };
    let words = registers.parse(words).map_err(|error| error.to_string())?;
    let _ = write!(answer, "{{\"id\": {}, \"out\": [", id.unwrap_or("null"));
    let mut records = Lines { registers, answer, rows: 0 };
    model.draw_words(&words, &mut records).map_err(|error| error.to_string())?;
    if records.rows > Records::MOST {
        let rows = records.rows;
        answer.clear();
        return Err(format!(
            "{rows} records are drawn, and an answer has at most {}",
            Records::MOST
        ));
    }
    answer.push(']');
    let masked = registers.input.dropped(&words);
    if !masked.is_empty() {
        let _ = write!(answer, ", \"masked\": [\"{}\"]", masked.join("\", \""));
    }
    answer.push('}');
    Ok(())
}

/// Whether a primitive gives depth.
fn has_depth(primitive: &Primitive) -> bool {
    match primitive {
        Primitive::Triangle(Triangle::Lattice { z, .. }) => z.is_some(),
        Primitive::Triangle(Triangle::Real { z, .. }) => z.is_some(),
        Primitive::Polygon(polygon) => polygon.z.is_some(),
        Primitive::Clip(triangle) => triangle.z.is_some(),
        Primitive::Words(_) | Primitive::Line(_) | Primitive::Point(_) => false,
    }
}

/// Draws a primitive; whether it has depth, or what is wrong, with its field.
fn draw(model: &Model, primitive: &Primitive, out: &mut Drawing) -> Result<bool, String> {
    let key = primitive.key();
    // Coordinates outside the field name the primitive's own key, not a triangle's.
    let accept = |points: &mut [[i128; 2]]| {
        model.accept(points).map_err(|error| match key {
            "point" => error.to_string().replace("v[0]", "point").replace("<= v <=", "<= x, y <="),
            _ => {
                error.to_string().replace("v[", &format!("{key}[")).replace("<= v <=", "<= x, y <=")
            }
        })
    };
    let result = match primitive {
        Primitive::Triangle(triangle) => {
            let triangle = model.snap(triangle).map_err(|error| error.to_string())?;
            model.draw(&triangle, out)
        }
        Primitive::Line(line) => {
            let mut line = *line;
            accept(&mut line)?;
            model.draw_line(&line, out)
        }
        Primitive::Point(point) => {
            let mut point = [*point];
            accept(&mut point)?;
            model.draw_point(&point[0], out)
        }
        Primitive::Polygon(polygon) => {
            let mut polygon = polygon.clone();
            accept(&mut polygon.xy)?;
            let top = i128::from(model.profile().depth_max());
            for (n, z) in polygon.z.iter().flatten().enumerate() {
                if !(0..=top).contains(z) {
                    let message =
                        format!("polygon[{n}][2] = {z} is outside the depth: 0 <= z <= {top}");
                    return Err(message);
                }
            }
            model.draw_polygon(&polygon, out)
        }
        Primitive::Clip(triangle) => model.draw_clip(triangle, out),
        // Answered in a form of its own.
        Primitive::Words(_) => return Ok(false),
    };
    match result {
        Ok(()) => Ok(has_depth(primitive)),
        Err(error @ (DrawError::Primitive(_) | DrawError::PolygonDepth { .. })) => {
            Err(format!("field `{key}`: {error}"))
        }
        Err(error) => Err(error.to_string()),
    }
}

fn write_answer(answer: &mut String, id: Option<&str>, drawing: &Drawing, has_depth: bool) {
    let _ = write!(answer, "{{\"id\": {}, \"rows\": [", id.unwrap_or("null"));
    for (n, span) in drawing.spans.iter().enumerate() {
        let comma = if n == 0 { "" } else { ", " };
        let _ = write!(answer, "{comma}[{}, {}, {}]", span.y, span.x0, span.x1);
    }
    answer.push(']');
    if has_depth {
        answer.push_str(", \"z\": [");
        for (n, z) in drawing.depth.iter().enumerate() {
            let comma = if n == 0 { "" } else { ", " };
            let _ = write!(answer, "{comma}{z}");
        }
        answer.push(']');
    }
    if !drawing.masks.is_empty() {
        answer.push_str(", \"masks\": [");
        for (n, mask) in drawing.masks.iter().enumerate() {
            let comma = if n == 0 { "" } else { ", " };
            let _ = write!(answer, "{comma}{mask}");
        }
        answer.push(']');
    }
    let mut events = drawing.event_counts().peekable();
    if events.peek().is_some() {
        answer.push_str(", \"events\": {");
        for (n, (key, count)) in events.enumerate() {
            let comma = if n == 0 { "" } else { ", " };
            let _ = write!(answer, "{comma}\"{key}\": {count}");
        }
        answer.push('}');
    }
    answer.push('}');
}
