//! One scene through several profiles, side by side: what each covers and colours, against the scene itself
//! before any snapping. Spec clause `RG-22`.

use super::accuracy::{Reference, Truth, reference_grid};
use crate::exact::Rule;
use crate::machine::Sink;
use crate::model::{Model, View};
use crate::profile::{InvalidProfile, Profile};
use serde::Serialize;

/// Codes of 256 that a colour may be off before it is counted.
pub const COLOUR_LIMIT: f64 = 8.0;

/// One profile's picture of the scene.
#[derive(Clone, Debug, Serialize)]
pub struct Panel {
    /// The profile.
    pub profile: String,
    /// Its machine: the form, or the engine behind registers.
    pub machine: String,
    /// Triangles that it did not take: a vertex outside its field.
    pub refused: u64,
    /// Pixels drawn, hits counted one by one.
    pub hits: u64,
    /// Pixels inside of the scene that nothing hit.
    pub holes: u64,
    /// Hits beyond those of the scene.
    pub too_many: u64,
    /// Hits short of those of the scene, holes among them.
    pub too_few: u64,
    /// Hits outside of their triangle, where a colour is held by the guard clamp alone.
    pub outside: u64,
    /// Hits whose colour is off by more than [`COLOUR_LIMIT`] codes; `None` without channels.
    pub colours_off: Option<u64>,
    /// The largest such error, in codes.
    pub colour_worst: Option<f64>,
    /// Window size.
    #[serde(skip)]
    pub size: [u32; 2],
    /// Red, green and blue of each pixel, row by row; of pixels without channels, a shade of grey.
    #[serde(skip)]
    pub colour: Vec<[u8; 3]>,
    /// What is wrong with each pixel.
    #[serde(skip)]
    pub marks: Vec<Mark>,
}

/// What is wrong with a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Neither drawn nor part of the scene.
    Empty,
    /// As in the scene.
    Right,
    /// Hit, but not as often as it should be.
    TooFew,
    /// Hit more often than it should be.
    TooMany,
    /// Not hit, and inside of the scene.
    Hole,
    /// Its colour is off.
    Colour,
}

/// Collects the hits of one triangle.
struct Hits<'a> {
    model: &'a Model,
    /// Places of three channels in each kind of record.
    places: Vec<[Option<usize>; 3]>,
    /// The top of each channel.
    tops: [f64; 3],
    found: Vec<(i64, i64, Option<[f64; 3]>)>,
}

impl Sink for Hits<'_> {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        if self.model.registers().is_none() {
            self.found.extend((x0..x1).map(|x| (i64::from(x), i64::from(y), None)));
        }
    }

    fn wants_records(&self) -> bool {
        true
    }

    #[allow(clippy::cast_precision_loss, reason = "codes of a few bits")]
    fn record(&mut self, kind: usize, values: &[i64]) {
        let Some(record) = self.model.registers().and_then(|known| known.records.get(kind)) else {
            return;
        };
        let colour = match self.places[kind] {
            [Some(r), Some(g), Some(b)] => {
                let code = |n: usize, place: usize| values[place] as f64 / self.tops[n] * 255.0;
                Some([code(0, r), code(1, g), code(2, b)])
            }
            _ => None,
        };
        self.found.extend(record.pixels(values).map(|[x, y]| (x, y, colour)));
    }
}

/// Draws a scene through a profile in a window of this size.
///
/// # Errors
/// [`InvalidProfile`] if the window is none for it.
pub fn panel(
    scene: &Reference,
    profile: &Profile,
    size: [u32; 2],
) -> Result<Panel, InvalidProfile> {
    let mut profile = profile.clone();
    // One hit a pixel, at its own place; depth has no part in it.
    (profile.multisample, profile.depth) = (None, None);
    let view = View { window: Some((size[0], size[1])), ..View::default() };
    let model = Model::with_view(&profile, view)?;
    let grid = profile.whole_grid()?;
    let truth = Truth::new(scene, &grid, model.clip(), Rule::TopLeft);
    let samples = reference_grid(&grid);
    let pixels = size[0] as usize * size[1] as usize;
    let at = |column: u32, row: u32| row as usize * size[0] as usize + column as usize;
    let (mut wanted, mut drawn) = (vec![0u32; pixels], vec![0u32; pixels]);
    let (mut off, mut colour) = (vec![false; pixels], vec![[0; 3]; pixels]);
    let (mut refused, mut outside, mut colours_off, mut worst) = (0, 0, 0, 0.0f64);
    let (tops, places, has_colour) = places(&profile, &model);
    let mut hits = Hits { model: &model, places, tops, found: Vec::new() };
    for index in 0..scene.triangles.len() {
        for run in truth.runs(index) {
            wanted[at(run.x0, run.y)..at(run.x1, run.y)].iter_mut().for_each(|count| *count += 1);
        }
        let snapped = model.snap(&scene.triangle(index, &profile));
        let (Some(face), Ok(snapped)) = (scene.face(index), snapped) else {
            refused += 1;
            continue;
        };
        hits.found.clear();
        // What a machine refuses has no hits.
        let _ = model.draw(&snapped, &mut hits);
        for (x, y, shade) in &hits.found {
            let (Ok(column), Ok(row)) = (u32::try_from(*x), u32::try_from(*y)) else { continue };
            if column >= size[0] || row >= size[1] {
                continue;
            }
            let place = at(column, row);
            drawn[place] += 1;
            // Not finite without area, where no colour is right or wrong.
            let exact = face.weights(samples.position((*x).into(), (*y).into()));
            let is_in = exact.iter().all(|share| *share >= 0.0);
            outside += u64::from(!is_in);
            let grey = 110 + 12 * u8::try_from(drawn[place] % 8).unwrap_or(0);
            colour[place] = [grey; 3];
            if let Some(shade) = shade {
                colour[place] = shade.map(byte);
                // Outside of the triangle the plane goes on, and 0 and the maximum are its ends.
                let errors = exact.iter().zip(shade);
                let wrong =
                    errors.map(|(e, s)| (e.clamp(0.0, 1.0) * 255.0 - s).abs()).fold(0.0, f64::max);
                worst = worst.max(wrong);
                off[place] = wrong > COLOUR_LIMIT;
                colours_off += u64::from(wrong > COLOUR_LIMIT);
            }
        }
    }
    let each = wanted.iter().zip(&drawn);
    let sum = |of: fn(u32, u32) -> u32| each.clone().map(|(w, d)| u64::from(of(*w, *d))).sum();
    let marks = each.clone().zip(&off).map(|((w, d), off)| Mark::of(*w, *d, *off)).collect();
    Ok(Panel {
        profile: profile.name.clone(),
        machine: profile.form.engine().to_owned(),
        refused,
        hits: drawn.iter().map(|d| u64::from(*d)).sum(),
        holes: sum(|w, d| u32::from(w > 0 && d == 0)),
        too_many: sum(|w, d| d.saturating_sub(w)),
        too_few: sum(u32::saturating_sub),
        outside,
        colours_off: has_colour.then_some(colours_off),
        colour_worst: has_colour.then_some(worst),
        size,
        colour,
        marks,
    })
}

/// The top of each of the first three channels, where a record has what, and whether there are colours.
#[allow(clippy::cast_precision_loss, reason = "codes of a few bits")]
fn places(profile: &Profile, model: &Model) -> ([f64; 3], Vec<[Option<usize>; 3]>, bool) {
    let channels = profile.form.channels().iter();
    let channels =
        channels.flat_map(|group| group.names.iter().map(move |name| (name, group.top_bits())));
    let first: Vec<(&String, u32)> = channels.take(3).collect();
    let top =
        |n: usize| first.get(n).map_or(1.0, |(_, bits)| ((1u64 << (*bits).min(52)) - 1) as f64);
    let records = model.registers().map_or(&[][..], |registers| &registers.records);
    let place = |record: &crate::machine::Record| {
        let channel = |n: usize| first.get(n).and_then(|(name, _)| record.position(name));
        [channel(0), channel(1), channel(2)]
    };
    ([top(0), top(1), top(2)], records.iter().map(place).collect(), first.len() == 3)
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "held in the range of a byte"
)]
fn byte(code: f64) -> u8 {
    code.round().clamp(0.0, 255.0) as u8
}

impl Mark {
    const fn of(wanted: u32, drawn: u32, off: bool) -> Self {
        match (wanted, drawn) {
            (0, 0) => Self::Empty,
            (1.., 0) => Self::Hole,
            (w, d) if d > w => Self::TooMany,
            (w, d) if d < w => Self::TooFew,
            _ if off => Self::Colour,
            _ => Self::Right,
        }
    }
}
