//! Captures: what was drawn, and what the unknown machine answered. Spec clause `ID-2`.

use super::picture::{Capture, Picture};
use crate::cover::Rect;
use crate::scene::lines;
use crate::scene::{Primitive, Triangle};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

/// What an unknown machine did with one primitive.
#[derive(Clone, Debug)]
pub struct Case {
    /// Where it came from, for people.
    pub name: String,
    /// What was drawn.
    pub primitive: Primitive,
    /// The answer.
    pub answer: Answer,
}

/// What is known of an answer.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Covered pixels, and depth at some of them.
    Picture {
        /// The covered pixels.
        covered: Picture,
        /// The pixels about which the capture says something.
        known: Picture,
        /// Depth by column and row.
        depth: BTreeMap<(u32, u32), u64>,
    },
    /// Records of a machine that begins at registers, in drawing order.
    Records(Vec<Vec<String>>),
}

/// A case that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct CaseError {
    /// File and line.
    pub place: String,
    /// What is wrong, and what would do.
    pub what: String,
}

/// The keys of an answer beside those of a primitive.
#[derive(Deserialize, Default)]
#[serde(default)]
struct Given {
    rows: Option<Vec<[u32; 3]>>,
    z: Option<Vec<u64>>,
    out: Option<Vec<Vec<String>>>,
    png: Option<String>,
    unknown: Vec<[u32; 4]>,
    scissor: Option<[u32; 4]>,
}

/// Keys of an answer that say nothing about which machine it is.
const PASSED_OVER: [&str; 4] = ["events", "masked", "masks", "channels"];
const ANSWER: [&str; 6] = ["rows", "z", "out", "png", "unknown", "scissor"];

/// For each pixel of a picture, row by row, whether it is covered; and its columns and rows.
pub type Pixels = (Vec<bool>, (u32, u32));

/// How cases are read.
#[derive(Clone, Copy, Debug)]
pub struct Reading<'a> {
    /// Columns and rows of the window.
    pub window: (u32, u32),
    /// Fraction bits of the integers of `v`; without it `v` is refused, because its unit is not known.
    pub lattice: Option<u32>,
    /// The folder that pictures are looked for in.
    pub folder: &'a Path,
    /// Reads a picture.
    pub picture: fn(&Path) -> Result<Pixels, String>,
}

impl Reading<'_> {
    /// Reads the cases of a text, one a line.
    ///
    /// # Errors
    /// [`CaseError`] names the line and what is wrong in it.
    pub fn cases(&self, source: &str, text: &str) -> Result<Vec<Case>, CaseError> {
        let mut cases = Vec::new();
        for (n, line) in (1..).zip(text.lines()) {
            if line.trim().is_empty() {
                continue;
            }
            let place = format!("{source}: line {n}");
            let case = self.case(line.trim(), &place);
            cases.push(case.map_err(|what| CaseError { place, what })?);
        }
        Ok(cases)
    }

    /// Reads one line.
    ///
    /// # Errors
    /// Says what is wrong.
    pub fn case(&self, line: &str, name: &str) -> Result<Case, String> {
        let value: serde_json::Value = serde_json::from_str(line).map_err(|e| e.to_string())?;
        let serde_json::Value::Object(mut asked) = value else {
            return Err("a case is a JSON object".to_owned());
        };
        let mut given = serde_json::Map::new();
        for key in ANSWER {
            given.extend(asked.remove(key).map(|value| (key.to_owned(), value)));
        }
        for key in PASSED_OVER {
            asked.remove(key);
        }
        let given: Given = serde_json::from_value(given.into()).map_err(|e| e.to_string())?;
        let request = lines::parse_line(&serde_json::Value::from(asked).to_string());
        let primitive = self.unit(request.map_err(|error| error.to_string())?.primitive)?;
        let answer = match (&given.out, &given.rows, &given.png) {
            (Some(out), None, None) => Answer::Records(out.clone()),
            (None, Some(rows), None) => self.rows(rows, &given)?,
            (None, None, Some(png)) => self.png(png, &given)?,
            _ => {
                return Err("a case has one answer: `rows` as eval writes them, `png`, a picture \
                            of the window, or `out`, the records of registers"
                    .to_owned());
            }
        };
        Ok(Case { name: name.to_owned(), primitive, answer })
    }

    /// Coordinates in pixels, whatever the unit of the machine's own.
    fn unit(&self, primitive: Primitive) -> Result<Primitive, String> {
        let Primitive::Triangle(Triangle::Lattice { xy, z }) = primitive else {
            return Ok(primitive);
        };
        let bits = self.lattice.ok_or(
            "field `v`: its unit is a decision of the machine; give `f` in pixels, or --lattice BITS \
             for integers of 2^-BITS pixels",
        )?;
        let real = |value: i128| {
            // Vertices of 53 bits or less are exact.
            #[allow(clippy::cast_precision_loss, reason = "vertex fields have 32 bits at most")]
            let value = value as f64;
            value / f64::from(2u32).powi(i32::try_from(bits).unwrap_or(0))
        };
        #[allow(clippy::cast_precision_loss, reason = "depth codes have 53 bits at most here")]
        let z = z.map(|z| z.map(|value| value as f64));
        Ok(Primitive::Triangle(Triangle::Real { xy: xy.map(|v| v.map(real)), z }))
    }

    fn rows(&self, rows: &[[u32; 3]], given: &Given) -> Result<Answer, String> {
        let (width, height) = self.window;
        let mut covered = Picture::empty(self.window);
        let mut depth = BTreeMap::new();
        let mut values = given.z.iter().flatten();
        for [y, x0, x1] in rows {
            if *y >= height || x0 >= x1 || *x1 > width {
                return Err(format!(
                    "field `rows`: [{y}, {x0}, {x1}] is not in the window of {width} x {height}; choose \
                     --window"
                ));
            }
            covered.fill(Rect { x0: *x0, y0: *y, x1: *x1, y1: y + 1 });
            if given.z.is_some() {
                for x in *x0..*x1 {
                    let z = values.next().ok_or("field `z`: fewer values than covered pixels")?;
                    depth.insert((x, *y), *z);
                }
            }
        }
        if values.next().is_some() {
            return Err("field `z`: more values than covered pixels".to_owned());
        }
        let known = self.known(given);
        depth.retain(|(x, y), _| known.get(*x, *y));
        Ok(Answer::Picture { covered, known, depth })
    }

    fn png(&self, png: &str, given: &Given) -> Result<Answer, String> {
        if given.z.is_some() {
            return Err("field `z`: depth goes with `rows`, because a picture has no order".into());
        }
        let path = self.folder.join(png);
        let place = path.display();
        let (pixels, (width, height)) =
            (self.picture)(&path).map_err(|error| format!("field `png`: {place}: {error}"))?;
        if (width, height) != self.window {
            return Err(format!(
                "field `png`: {place} has {width} x {height} pixels, but the window has {} x {}",
                self.window.0, self.window.1
            ));
        }
        let mut covered = Picture::empty(self.window);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        for ((x, y), _) in places.zip(pixels).filter(|(_, covered)| *covered) {
            covered.fill(Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 });
        }
        Ok(Answer::Picture { covered, known: self.known(given), depth: BTreeMap::new() })
    }

    /// What a scissor cut off is not known, and neither are the pixels said to be so.
    fn known(&self, given: &Given) -> Picture {
        let (width, height) = self.window;
        let mut unknown = Picture::empty(self.window);
        for [x0, y0, x1, y1] in given.unknown.iter().copied() {
            unknown.fill(Rect { x0, y0, x1, y1 });
        }
        let mut known = Picture::empty(self.window);
        let [x0, y0, x1, y1] = given.scissor.unwrap_or([0, 0, width, height]);
        for (x, y) in (y0..y1.min(height)).flat_map(|y| (x0..x1.min(width)).map(move |x| (x, y))) {
            if !unknown.get(x, y) {
                known.fill(Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 });
            }
        }
        known
    }
}

/// A picture of the machine behind a capture.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    /// Covered and known pixels.
    pub(super) shown: [Picture; 2],
    /// Pixels that are both.
    pub(super) count: u32,
}

/// A case behind each capture that is thought of.
#[derive(Clone, Debug)]
pub(super) struct Undone {
    /// By capture.
    pub(super) pictures: Vec<Shown>,
}

impl Undone {
    pub(super) fn of(answer: &Answer, captures: &[Capture]) -> Self {
        let Answer::Picture { covered, known, .. } = answer else {
            return Self { pictures: Vec::new() };
        };
        let undone = |capture: &Capture| {
            let shown = [capture.undone(covered), capture.undone(known)];
            Shown { count: shown[0].common(&shown[1]), shown }
        };
        Self { pictures: captures.iter().map(undone).collect() }
    }
}
