//! One scene through several profiles, side by side: what each covers and colours, against the scene itself
//! before any snapping. Spec clause `RG-22`.

use crate::machine::Sink;
use crate::model::{Model, View};
use crate::profile::{Form, InvalidProfile, Profile};
use crate::scene::{Scene, Triangle};
use crate::setup::{EdgeCoefficients, snap_f64};
use serde::Serialize;

/// Fraction bits of the scene as it is taken for true.
const FINE: u32 = 20;
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

/// A triangle as the scene has it, on a lattice so fine that nothing is lost in a picture.
#[derive(Clone, Copy, Debug)]
struct Fine {
    xy: [[i128; 2]; 3],
    /// Twice the area, and whether v1 and v2 had to change places for it to be positive.
    area: i128,
    turned: bool,
}

impl Fine {
    fn new(triangle: &Triangle, lattice: u32) -> Option<Self> {
        let place = |value: f64| snap_f64(value, FINE, crate::bits::Rounding::NearestEven);
        let xy = match triangle {
            Triangle::Lattice { xy, .. } => {
                xy.map(|at| at.map(|value| Some(value << FINE.saturating_sub(lattice))))
            }
            Triangle::Real { xy, .. } => xy.map(|at| at.map(place)),
        };
        let mut points = [[0; 2]; 3];
        for (n, at) in xy.iter().enumerate() {
            for (axis, value) in at.iter().enumerate() {
                points[n][axis] = (*value).filter(|value| value.unsigned_abs() < 1 << 40)?;
            }
        }
        let triangle = crate::setup::Triangle { xy: points, z: None };
        let area = triangle.area2();
        let xy = triangle.normalised().xy;
        Some(Self { xy, area: area.abs(), turned: area < 0 })
    }

    fn edges(&self) -> [EdgeCoefficients; 3] {
        crate::setup::edges(&crate::setup::Triangle { xy: self.xy, z: None })
    }

    /// What each vertex of the scene has in a point, in parts of the whole.
    #[allow(clippy::cast_precision_loss, reason = "a picture's colours")]
    fn shares(&self, edges: &[EdgeCoefficients; 3], at: [i128; 2]) -> [f64; 3] {
        let part = |k: usize| edges[k].at(at[0], at[1]) as f64 / self.area as f64;
        // Edge k runs from vertex k to the next, and is as far from zero as the third one's share.
        let mut shares = [part(1), part(2), part(0)];
        if self.turned {
            shares.swap(1, 2);
        }
        shares
    }
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

/// Draws a scene through a profile in a window of this size. Integer coordinates of the scene count
/// 2^-lattice pixels.
///
/// # Errors
/// [`InvalidProfile`] if the window is none for it.
pub fn panel(
    scene: &Scene,
    profile: &Profile,
    size: [u32; 2],
    lattice: u32,
) -> Result<Panel, InvalidProfile> {
    let mut profile = profile.clone();
    // One hit a pixel, at its own place; depth has no part in it.
    (profile.multisample, profile.depth) = (None, None);
    let view = View { window: Some((size[0], size[1])), ..View::default() };
    let model = Model::with_view(&profile, view)?;
    let grid = profile.grid()?;
    let offset = grid.offset.map(|offset| offset << (FINE - grid.sub_pixel));
    let pixels = size[0] as usize * size[1] as usize;
    let (mut wanted, mut drawn) = (vec![0u32; pixels], vec![0u32; pixels]);
    let (mut off, mut colour) = (vec![false; pixels], vec![[0; 3]; pixels]);
    let (mut refused, mut outside, mut colours_off, mut worst) = (0, 0, 0, 0.0f64);
    let (tops, places, has_colour) = places(&profile, &model);
    let mut hits = Hits { model: &model, places, tops, found: Vec::new() };
    for triangle in &scene.triangles {
        let Some(fine) = Fine::new(triangle, lattice) else {
            refused += 1;
            continue;
        };
        let edges = fine.edges();
        let at = |x: i64, y: i64| {
            [(x, 0), (y, 1)].map(|(c, axis)| (i128::from(c) << FINE) + offset[axis])
        };
        count(&fine, &edges, size, at, &mut wanted);
        #[allow(clippy::cast_precision_loss, reason = "below 2^53 in any window")]
        let real = Triangle::Real {
            xy: match triangle {
                Triangle::Real { xy, .. } => *xy,
                Triangle::Lattice { xy, .. } => {
                    xy.map(|at| at.map(|value| value as f64 / f64::from(1u32 << lattice.min(31))))
                }
            },
            z: None,
        };
        let Ok(snapped) = model.snap(&real) else {
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
            let place = row as usize * size[0] as usize + column as usize;
            drawn[place] += 1;
            let exact = (fine.area > 0).then(|| fine.shares(&edges, at(*x, *y)));
            let is_out = |shares: [f64; 3]| shares.iter().any(|share| *share < 0.0);
            outside += u64::from(exact.is_none_or(is_out));
            let grey = 110 + 12 * u8::try_from(drawn[place] % 8).unwrap_or(0);
            colour[place] = [grey; 3];
            if let Some(shade) = shade {
                colour[place] = shade.map(byte);
                // Outside of the triangle the plane goes on, and 0 and the maximum are its ends.
                let wrong = exact.map_or(0.0, |exact| {
                    let errors = exact.iter().zip(shade);
                    errors.map(|(e, s)| (e.clamp(0.0, 1.0) * 255.0 - s).abs()).fold(0.0, f64::max)
                });
                worst = worst.max(wrong);
                off[place] = wrong > COLOUR_LIMIT;
                colours_off += u64::from(wrong > COLOUR_LIMIT);
            }
        }
    }
    let each = wanted.iter().zip(&drawn);
    let sum = |of: fn(u32, u32) -> u32| each.clone().map(|(w, d)| u64::from(of(*w, *d))).sum();
    let marks = each.clone().zip(&off).map(|((w, d), off)| Mark::of(*w, *d, *off)).collect();
    let machine = match &profile.form {
        Form::Registers(machine) => machine.engine.name(),
        form => form.name(),
    };
    Ok(Panel {
        profile: profile.name.clone(),
        machine: machine.to_owned(),
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
    let Form::Registers(machine) = &profile.form else { return ([1.0; 3], Vec::new(), false) };
    let channels = machine.channels.iter();
    let channels =
        channels.flat_map(|group| group.names.iter().map(move |name| (name, group.integer)));
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

/// Counts the samples that a triangle covers.
fn count(
    fine: &Fine,
    edges: &[EdgeCoefficients; 3],
    size: [u32; 2],
    at: impl Fn(i64, i64) -> [i128; 2],
    wanted: &mut [u32],
) {
    if fine.area == 0 {
        return;
    }
    let end = |axis: usize, of: fn(i128, i128) -> i128| {
        fine.xy.iter().map(|at| at[axis]).reduce(of).map_or(0, |end| end >> FINE)
    };
    let range = |axis: usize| {
        let most = i128::from(size[axis]);
        let low = i64::try_from((end(axis, i128::min) - 1).clamp(0, most)).unwrap_or(0);
        (low, i64::try_from((end(axis, i128::max) + 2).clamp(0, most)).unwrap_or(0))
    };
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    for y in y0..y1 {
        for x in x0..x1 {
            let [px, py] = at(x, y);
            let inside = edges.iter().all(|edge| {
                let value = edge.at(px, py);
                value > 0 || value == 0 && crate::cover::FillRule::TopLeft.owns(edge.direction())
            });
            let place = usize::try_from(y * i64::from(size[0]) + x).unwrap_or(0);
            wanted[place] += u32::from(inside);
        }
    }
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
