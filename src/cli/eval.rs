//! `guardbit eval`: the live model on a pipe.

mod bias;
mod limited;

use super::Outcome;
use super::failure::Failure;
use bias::Models;
use guardbit::machine::{DrawError, Legal, Registers, Sink};
use guardbit::model::{Drawing, Model, PixelDetail, Primitive, PrimitiveError, Records, View};
use guardbit::profile;
use guardbit::scene::lines;
use limited::{Limited, NUMBERS};
use std::fmt::Write as _;
use std::io::{BufRead, Write};

/// Longest line read, so that input without newlines cannot fill the memory.
const LONGEST: u64 = 1 << 24;

/// Steps that registers may take for each record that an answer may have.
const STEPS: u64 = 16;

/// Run the model on a pipe: JSON Lines in, JSON Lines out, flushed after each line.
///
/// Input: one primitive on each line.
/// {"id": 7, "v": [[x,y,z],[x,y,z],[x,y,z]]} is a triangle: integers, x and y in sub-pixels, z in depth
/// ULPs (optional), y down.
/// "f" instead of "v" takes real numbers: x and y in pixels, z in depth ULPs; {"bits": "7fc00000"} gives
/// NaN and infinities.
/// "line": [[x,y],[x,y]] and "point": [x,y] follow the rules of the profile.
/// "position": [[x,y,z,w], ...] are three vertices in clip space, which [viewport] of the profile brings to the
/// window; "w" is theirs.
/// "polygon": [[x,y],...] and "clip": [[X,Y,Z,W],...] need a machine that draws them.
/// On a profile with channels, "channels": {"color": [[r,g,b],[r,g,b],[r,g,b]], ...} gives their values, and
/// "q": [...] beside "v" (codes of 1/w) or "w": [...] beside "f" (distances from the eye) what perspective
/// needs.
/// "bias": {"constant": 2, "slope": 256, "clamp": 9, "unit": 1} is the depth bias of the draw call, in place of
/// [depth.bias] of the profile: slope in 1/256; what is left out is 0, and unit 1.
/// "words": ["...", ...] are the registers of a register-level machine, in the radix of the profile.
///
/// Output: {"id": 7, "rows": [[y, x0, x1], ...], "z": [...], "events": {...}}.
/// With channels, "channels": {"color": [[r,g,b], ...], ...} has their values in the order of "z".
/// If the profile has several samples in each pixel, "masks" has one mask for each pixel.
/// For "words", the output is {"id": 7, "out": [["P", ...], ...]}: one list for each record, in the order
/// in which the hardware draws; "masked": [...] names the words with bits outside all fields, and "illegal":
/// [...] the conditions of the profile that the words break.
///
/// A bad line gives {"id": ..., "error": "..."}; the next lines are processed, and the exit status is 2.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// Window as WIDTHxHEIGHT; replaces the window of the profile.
    #[arg(long, value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// Draw only the pixels with X0 <= x < X1 and Y0 <= y < Y1, given as X0,Y0,X1,Y1.
    #[arg(long, value_parser = super::parse_rect)]
    scissor: Option<guardbit::cover::Rect>,
    /// The most numbers in an answer, or the most records for "words"; a longer answer is an error. Without
    /// this option: 16777216 numbers, 4194304 records.
    #[arg(long, value_name = "N")]
    limit: Option<u64>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let profile = profile::load(&arguments.profile)?;
    let view = View { window: arguments.window, scissor: arguments.scissor, ..View::default() };
    let model = Model::with_view(&profile, view).map_err(Failure::input)?;
    let mut models = Models::new(model, view);
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
            let message = format!("line {number}: the line is longer than {LONGEST} bytes");
            let _ = write!(answer, "{{\"id\": null, \"error\": \"{message}\"}}");
            all_good = false;
        } else {
            let place = (number, arguments.limit);
            all_good &= reply(&mut models, &line, place, &mut drawing, &mut answer);
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
    models: &mut Models,
    line: &[u8],
    (number, limit): (u64, Option<u64>),
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
        return refuse(answer, None, "the line is not UTF-8 text");
    };
    let request = match lines::parse_line(text.trim_end()) {
        Ok(request) => request,
        Err(error) => return refuse(answer, error.id.as_deref(), &error.to_string()),
    };
    let id = request.id.as_deref();
    let model = match models.of(request.bias) {
        Ok(model) => model,
        Err(message) => return refuse(answer, id, &message),
    };
    let key = request.primitive.key();
    let given = [request.primitive.has_depth(), request.shading.is_some()];
    let prepared = model.prepare(&request.primitive).and_then(|primitive| match &request.shading {
        Some(shading) => model.shade(primitive, shading),
        None => Ok(primitive),
    });
    let primitive = match prepared {
        Ok(primitive) => primitive,
        Err(error) => return refuse(answer, id, &error.to_string()),
    };
    drawing.clear();
    let drawn = if let Some(words) = primitive.words() {
        let most = limit.unwrap_or(Records::MOST);
        reply_records(model, (&primitive, words), most, id, answer)
    } else {
        let mut limited = Limited::new(drawing, limit.unwrap_or(NUMBERS));
        let drawn = model.draw(&primitive, &mut limited).map_err(|error| error.to_string());
        drawn.and_then(|()| limited.check()).and_then(|()| {
            let details = primitive.shaded().map_or(Ok(Vec::new()), |(triangle, values)| {
                model.details(triangle, values, drawing)
            });
            let details = details.map_err(|error| error.to_string())?;
            write_answer(answer, id, (model, drawing, &details), given);
            Ok(())
        })
    };
    match drawn {
        Ok(()) => true,
        Err(error) => refuse(answer, id, &format!("field `{key}`: {error}")),
    }
}

/// Answers registers with records.
fn reply_records(
    model: &Model,
    (primitive, words): (&Primitive, &[u32]),
    most: u64,
    id: Option<&str>,
    answer: &mut String,
) -> Result<(), String> {
    struct Lines<'a> {
        registers: &'a Registers,
        answer: &'a mut String,
        rows: u64,
        most: u64,
    }
    impl Sink for Lines<'_> {
        fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

        fn most_steps(&self) -> u64 {
            self.most.max(Records::MOST).saturating_mul(STEPS)
        }

        fn record(&mut self, kind: usize, values: &[i64]) {
            self.rows += 1;
            if self.rows > self.most {
                return;
            }
            self.answer.push_str(if self.rows == 1 { "[\"" } else { ", [\"" });
            self.registers.push_record(kind, values, "\", \"", self.answer);
            self.answer.push_str("\"]");
        }
    }
    let Some(registers) = model.registers() else {
        return Err(PrimitiveError::NoRegisters.to_string());
    };
    let _ = write!(answer, "{{\"id\": {}, \"out\": [", id.unwrap_or("null"));
    let mut records = Lines { registers, answer, rows: 0, most };
    let drawn = model.draw(primitive, &mut records);
    let rows = records.rows;
    if let Err(error) = drawn {
        answer.clear();
        return Err(match error {
            DrawError::Work { .. } => format!("{error}; --limit N allows {STEPS} N steps"),
            other => other.to_string(),
        });
    }
    if rows > most {
        answer.clear();
        return Err(format!(
            "the hardware draws {rows} records, but an answer has at most {most}; --limit N allows more"
        ));
    }
    answer.push(']');
    let masked = registers.input.dropped(words);
    if !masked.is_empty() {
        let _ = write!(answer, ", \"masked\": [\"{}\"]", masked.join("\", \""));
    }
    let quoted = |legal: &Legal| serde_json::Value::from(legal.text()).to_string();
    let illegal: Vec<String> = registers.illegal(words).map(quoted).collect();
    if !illegal.is_empty() {
        let _ = write!(answer, ", \"illegal\": [{}]", illegal.join(", "));
    }
    answer.push('}');
    Ok(())
}

fn write_answer(
    answer: &mut String,
    id: Option<&str>,
    (model, drawing, details): (&Model, &Drawing, &[Vec<PixelDetail>]),
    [has_depth, has_channels]: [bool; 2],
) {
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
    if has_channels {
        write_channels(answer, model, drawing);
        write_details(answer, model, details);
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

/// `"channels": {"color": [[r, g, b], ...]}`: the components at each place, run by run.
fn write_channels(answer: &mut String, model: &Model, drawing: &Drawing) {
    answer.push_str(", \"channels\": {");
    for (n, port) in model.ports().channels.iter().enumerate() {
        let comma = if n == 0 { "" } else { ", " };
        // A triangle that covers nothing has no values.
        let values = drawing.channels.get(n).map_or(&[][..], Vec::as_slice);
        let _ = write!(answer, "{comma}\"{}\": [", port.name);
        for (n, place) in values.chunks(port.components.len()).enumerate() {
            let comma = if n == 0 { "" } else { ", " };
            let codes: Vec<String> = place.iter().map(i64::to_string).collect();
            let _ = write!(answer, "{comma}[{}]", codes.join(", "));
        }
        answer.push(']');
    }
    answer.push('}');
}

/// `"detail": {"texcoord": [56, ...]}`: the levels at the covered pixels, run by run.
fn write_details(answer: &mut String, model: &Model, details: &[Vec<PixelDetail>]) {
    if details.is_empty() {
        return;
    }
    answer.push_str(", \"detail\": {");
    let channels = model.profile().channel.iter().filter(|channel| channel.detail.is_some());
    for (n, (channel, pixels)) in channels.zip(details).enumerate() {
        let comma = if n == 0 { "" } else { ", " };
        let levels: Vec<String> = pixels.iter().map(|pixel| pixel.level.to_string()).collect();
        let _ = write!(answer, "{comma}\"{}\": [{}]", channel.name, levels.join(", "));
    }
    answer.push('}');
}
