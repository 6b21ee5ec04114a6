//! What `envelope` prints.

use super::Question;
use guardbit::bits::Rounding;
use guardbit::measure::envelope::{
    Alone, Class, Envelope, Family, Margin, Rasterizer, STEPS, STEPS_OF_THREE, Search, Shape,
    Verdict, margin, search, witness,
};
use serde::Serialize;
use std::fmt::Write as _;

/// MAY pixels of a triangle that are listed.
const PIXELS: usize = 4;
/// Wrong pixels that are listed.
const WRONG: usize = 10;

/// The whole answer.
#[derive(Serialize)]
pub(super) struct Report {
    api: &'static str,
    text: &'static str,
    bits: [u32; 2],
    snaps: Vec<String>,
    edge_rule: &'static str,
    ways: usize,
    snap_error: f64,
    window: [u32; 2],
    must: u64,
    may: u64,
    must_not: u64,
    /// MUST and MAY of each triangle alone.
    triangles: Vec<[u32; 2]>,
    listed: Vec<Listed>,
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<Checked>,
}

/// A triangle with MAY pixels.
#[derive(Serialize)]
struct Listed {
    triangle: usize,
    place: String,
    must: u32,
    may: u32,
    pixels: Vec<Differ>,
    #[serde(skip_serializing_if = "Option::is_none")]
    margin: Option<Distance>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robust: Option<Robust>,
}

/// Two rasterizers that differ in a pixel.
#[derive(Serialize)]
struct Differ {
    x: u32,
    y: u32,
    covered_by: String,
    missed_by: String,
}

#[derive(Serialize)]
struct Distance {
    x: u32,
    y: u32,
    pixels: f64,
}

/// The smallest move that was found.
#[derive(Serialize)]
struct Robust {
    within: f64,
    step: f64,
    found: bool,
    /// The larger of the distances to the right and down.
    distance: Option<f64>,
    by: Option<Shape>,
    /// The triangle after the move, as a scene has it.
    f: Option<[[f32; 2]; 3]>,
}

#[derive(Serialize)]
struct Checked {
    legal: bool,
    wrong: usize,
    first: Vec<Fault>,
    drawn_by: Option<String>,
    ways: usize,
}

#[derive(Serialize)]
struct Fault {
    x: u32,
    y: u32,
    covered: bool,
    clause: &'static str,
}

impl Report {
    pub(super) fn new(
        question: &Question,
        envelope: &Envelope,
        alone: &[[u32; 2]],
        verdict: Option<&Verdict>,
    ) -> Self {
        let family = &question.family;
        let [must, may, must_not] = envelope.count();
        let bits = family.ways.iter().map(|way| way.bits);
        let first = bits.clone().min().unwrap_or(0);
        let snaps = family.ways.iter().filter(|way| way.bits == first);
        let open = alone.iter().enumerate().filter(|(_, count)| count[1] > 0);
        Self {
            api: family.api.name(),
            text: family.api.text(),
            bits: [first, bits.max().unwrap_or(0)],
            snaps: snaps.map(|way| way.snap.to_string()).collect(),
            edge_rule: if family.api.rule().is_some() { "top-left" } else { "any consistent rule" },
            ways: family.ways.len(),
            snap_error: family.snap_error(),
            window: envelope.window.into(),
            must,
            may,
            must_not,
            triangles: alone.to_vec(),
            listed: open
                .take(question.arguments.rows)
                .map(|(n, count)| Listed::new(question, n, *count))
                .collect(),
            check: verdict.map(Checked::new),
        }
    }

    pub(super) fn text(&self, question: &Question) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = self.write(&mut text, question);
        text
    }

    fn write(&self, text: &mut String, question: &Question) -> std::fmt::Result {
        let [low, high] = self.bits;
        let bits = if low == high { low.to_string() } else { format!("{low} to {high}") };
        // All ten would be a line of their own.
        let all = self.snaps.len() == Rounding::ALL.len();
        let snaps = if all { "every rounding".to_owned() } else { self.snaps.join(", ") };
        writeln!(
            text,
            "{}: {bits} sub-pixel bits (EN-2); vertices rounded by {snaps} (EN-3); {} for edges (EN-5)",
            self.text, self.edge_rule
        )?;
        let ([width, height], triangles) = (self.window, self.triangles.len());
        writeln!(
            text,
            "{}, {width} x {height} pixels, {triangles} triangle{}: {} MUST, {} MAY, {} MUST NOT",
            question.scene.name,
            if triangles == 1 { "" } else { "s" },
            self.must,
            self.may,
            self.must_not
        )?;
        if self.listed.is_empty() && question.arguments.rows > 0 {
            writeln!(text, "no triangle has a MAY pixel")?;
        } else if !self.listed.is_empty() {
            writeln!(text, "{:24} {:>8} {:>8}", "triangle alone", "MUST", "MAY")?;
        }
        for listed in &self.listed {
            listed.write(text, self.snap_error)?;
        }
        let open = self.triangles.iter().filter(|count| count[1] > 0).count();
        if open > self.listed.len() {
            writeln!(
                text,
                "and {} more with MAY pixels; --rows lists them",
                open - self.listed.len()
            )?;
        }
        if let Some(check) = &self.check {
            check.write(text, self)?;
        }
        Ok(())
    }
}

impl Listed {
    fn new(question: &Question, n: usize, [must, may]: [u32; 2]) -> Self {
        let (family, shape) = (&question.family, &question.shapes[n]);
        let window = question.arguments.window;
        let alone = Alone::of(family, shape, window);
        let open = alone.pixels().filter(|(_, class)| *class == Class::May);
        let differ = |(pixel, _): ([u32; 2], Class)| Differ::new(family, shape, pixel);
        let robust = question.arguments.robust;
        let most = question.arguments.within;
        Self {
            triangle: n,
            place: question.scene.place(n),
            must,
            may,
            pixels: open.filter_map(differ).take(PIXELS).collect(),
            margin: margin(family, shape, window).filter(|_| robust).map(Distance::from),
            robust: robust.then(|| Robust::new(shape, search(family, shape, window, most), most)),
        }
    }

    fn write(&self, text: &mut String, snap_error: f64) -> std::fmt::Result {
        writeln!(text, "{:24} {:>8} {:>8}", self.place, self.must, self.may)?;
        for Differ { x, y, covered_by, missed_by } in &self.pixels {
            writeln!(text, "  ({x}, {y}): covered with {covered_by}; not with {missed_by}")?;
        }
        let more = (self.may as usize).saturating_sub(self.pixels.len());
        if more > 0 {
            writeln!(text, "  and {more} more MAY pixels; --png shows all")?;
        }
        if let Some(Distance { x, y, pixels }) = &self.margin {
            writeln!(
                text,
                "  margin: the outline is {pixels:.4} pixels from the sample of ({x}, {y}), the closest that is \
                 decided; a snap moves it by less than {snap_error:.4}"
            )?;
        }
        self.robust.as_ref().map_or(Ok(()), |robust| robust.write(text))
    }
}

impl Differ {
    fn new(family: &Family, shape: &Shape, [x, y]: [u32; 2]) -> Option<Self> {
        let [covers, misses] = witness(family, std::slice::from_ref(shape), [x, y]);
        let name = |rasterizer: Rasterizer| rasterizer.to_string();
        Some(Self { x, y, covered_by: covers.map(name)?, missed_by: misses.map(name)? })
    }
}

impl From<Margin> for Distance {
    fn from(Margin { pixel: [x, y], distance }: Margin) -> Self {
        Self { x, y, pixels: distance }
    }
}

impl Robust {
    fn new(shape: &Shape, found: Search, most: u32) -> Self {
        let pixels = |steps: i32| f64::from(steps) / f64::from(STEPS);
        let found = if let Search::Found(by) = found { Some(by) } else { None };
        Self {
            within: f64::from(most) / f64::from(STEPS),
            step: 1.0 / f64::from(STEPS),
            found: found.is_some(),
            distance: found.map(|by| f64::from(by.most()) / f64::from(STEPS)),
            by: found.map(|by| by.steps.map(|steps| steps.map(pixels))),
            f: found.map(|by| by.apply(shape).map(|vertex| vertex.map(narrow))),
        }
    }

    fn write(&self, text: &mut String) -> std::fmt::Result {
        let most = self.within;
        let three = f64::from(STEPS_OF_THREE) / f64::from(STEPS);
        let tried = format!(
            "all vertices together, one, two each on its own, up to {most} pixel{}, and three up to {}, in steps of \
             1/{STEPS}",
            if most > 1.0 { "s" } else { "" },
            three.min(most)
        );
        let (Some(by), Some(shape), Some(distance)) = (self.by, self.f, self.distance) else {
            return writeln!(text, "  robust: no move is enough of those tried: {tried}");
        };
        let moves: Vec<String> = by
            .iter()
            .enumerate()
            .filter(|(_, by)| by.iter().any(|distance| *distance != 0.0))
            .map(|(n, [x, y])| format!("vertex {n} by ({x}, {y})"))
            .collect();
        writeln!(text, "  robust: {distance} pixels are enough: {}", moves.join(", "))?;
        let [a, b, c] = shape.map(|[x, y]| format!("[{x}, {y}]"));
        writeln!(text, "    {{\"f\": [{a}, {b}, {c}]}}")?;
        writeln!(text, "    the smallest of: {tried}")
    }
}

/// A coordinate that already is a binary32 number, so that it is printed with the digits of one.
#[allow(clippy::cast_possible_truncation, reason = "exact: moves end in binary32 numbers")]
fn narrow(value: f64) -> f32 {
    value as f32
}

impl Checked {
    fn new(verdict: &Verdict) -> Self {
        let fault = |wrong: &guardbit::measure::envelope::Wrong| Fault {
            x: wrong.pixel[0],
            y: wrong.pixel[1],
            covered: wrong.covered,
            clause: wrong.clause,
        };
        Self {
            legal: verdict.wrong.is_empty(),
            wrong: verdict.wrong.len(),
            first: verdict.wrong.iter().take(WRONG).map(fault).collect(),
            drawn_by: verdict.drawn_by.map(|rasterizer| rasterizer.to_string()),
            ways: verdict.ways,
        }
    }

    fn write(&self, text: &mut String, report: &Report) -> std::fmt::Result {
        let ways = report.ways;
        for Fault { x, y, covered, clause } in &self.first {
            let what = if *covered {
                "is covered, but no rasterizer covers it"
            } else {
                "is not covered, but every rasterizer covers it"
            };
            writeln!(text, "  ({x}, {y}) {what} ({clause})")?;
        }
        if !self.legal {
            return writeln!(
                text,
                "NOT LEGAL: {} pixels are not as {} asks",
                self.wrong, report.text
            );
        }
        match &self.drawn_by {
            Some(name) => {
                writeln!(
                    text,
                    "LEGAL: drawn with {name}; {} of {ways} ways draw this picture",
                    self.ways
                )
            }
            None => writeln!(
                text,
                "NOT LEGAL: each pixel alone is allowed, but none of {ways} ways with one rule draws the whole picture"
            ),
        }
    }
}
