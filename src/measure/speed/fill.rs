//! The quickest exact path, written to memory, against plain loops that write the same.
//! Spec clause `A-14`.

use super::timing::versus;
use crate::case::Words;
use crate::cover::{Bitmask, EdgeStorage, EdgeWordConfig};
use crate::machine::DrawError;
use crate::model::{Model, Raster};
use crate::profile::{Profile, WindowConfig, builtin};
use crate::setup::{Snapped, Triangle};
use serde::Serialize;

/// Pixels on a side of the window written to: values of one window stay in a processor's caches.
const SIDE: u32 = 1024;

/// One kind of write over triangles of one size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FillRow {
    /// `coverage` as a bitmask, or `depth` with it, as values.
    pub writes: &'static str,
    /// Covered pixels of a triangle, on average.
    pub pixels: f64,
    /// Nanoseconds a covered pixel, set-up included.
    pub ns_per_pixel: f64,
    /// Millions of triangles a second.
    pub millions_per_second: f64,
    /// Time as a ratio to a plain loop that evaluates every pixel of the bounding box.
    pub ratio: f64,
}

/// Triangles of two random legs of about `side` pixels each.
fn triangles(model: &Model, side: i64, count: u64) -> Vec<Snapped<Triangle>> {
    let sub = 1 << 10;
    (0..count)
        .map(|index| {
            let mut words = Words::new(4, side.unsigned_abs(), index);
            let room = (i64::from(SIDE) - 2 * side).max(0) * sub;
            let low = side * sub;
            let at =
                [(); 2].map(|()| words.between(low.min(i64::from(SIDE) * sub / 2), low + room));
            let mut leg = || {
                let [x, y] = [(); 2].map(|()| words.between(-side * sub, side * sub));
                [x, y]
            };
            let (u, v) = (leg(), leg());
            // Of twice the area that two legs should span, at least a half: no slivers.
            let area = (u[0] * v[1] - u[1] * v[0]).abs();
            let v = if area < i128::from(side * sub).pow(2) / 2 { [-u[1], u[0]] } else { v };
            let limit = i128::from(SIDE) << 10;
            let corner = |d: [i128; 2]| [0, 1].map(|axis| (at[axis] + d[axis]).clamp(0, limit));
            let z = [(); 3].map(|()| words.between(0, (1 << 24) - 1));
            let triangle = Triangle { xy: [corner([0; 2]), corner(u), corner(v)], z: Some(z) };
            model.place(triangle).unwrap_or_else(|error| unreachable!("clamped: {error}"))
        })
        .filter(|triangle| triangle.area2() != 0)
        .collect()
}

/// A plain loop: three edge functions and a depth plane, added up from pixel to pixel in 64 bits.
fn plainly(profile: &Profile, triangle: &Triangle, raster: &mut PlainRaster, deep: bool) {
    let triangle = triangle.normalised();
    let (Ok(grid), Ok(clip), Some(z)) = (profile.whole_grid(), profile.window(), triangle.z) else {
        return;
    };
    let Some(depth) = crate::measure::accuracy::depth_of(profile) else { return };
    let (rule, storage) = (profile.form.rule(), EdgeStorage::Shifted);
    let edges = EdgeWordConfig { rule, storage, width: 64, conservative: None };
    let [x0, y0, x1, y1] = crate::machine::Target { grid, clip, reach: 0 }.bounds(&triangle);
    let words = edges.words(&triangle, &grid).lanes::<i64>(x0, y0);
    let plane = depth.plane(&triangle, z, &grid);
    let narrow = |value: i128| {
        i64::try_from(value).unwrap_or_else(|_| unreachable!("{value}: sgi-4k fits 64 bits"))
    };
    let [_, dx, dy] = plane.raw().map(narrow);
    let mut start = narrow(plane.at(x0.into(), y0.into()).raw());
    let (fraction, top) = (depth.read_out().fraction(), narrow(depth.read_out().top()) - 1);
    let mut row = words.value;
    for y in y0..y1 {
        let (mut value, mut accumulator) = (row, start);
        for x in x0..x1 {
            if value[0] | value[1] | value[2] >= 0 {
                raster.mask.fill(y, x, x + 1);
                if deep {
                    let code = accumulator.clamp(0, top) >> fraction;
                    raster.depth[(y * SIDE + x) as usize] = code.unsigned_abs();
                }
            }
            for (value, step) in value.iter_mut().zip(words.step_x) {
                *value = value.wrapping_add(step);
            }
            accumulator = accumulator.wrapping_add(dx);
        }
        for (value, step) in row.iter_mut().zip(words.step_y) {
            *value = value.wrapping_add(step);
        }
        start = start.wrapping_add(dy);
    }
}

/// The profile refuses none of these triangles.
fn own(error: DrawError) {
    unreachable!("a triangle made for this model: {error}");
}

struct PlainRaster {
    mask: Bitmask,
    depth: Vec<u64>,
}

fn profile() -> Profile {
    let Some(Ok(profile)) = builtin("sgi-4k") else { unreachable!("sgi-4k is built in") };
    Profile { window: WindowConfig { width: SIDE, height: SIDE }, ..profile }
}

pub(super) fn measure(repeats: usize) -> Vec<FillRow> {
    let profile = profile();
    let model = Model::new(&profile).unwrap_or_else(|error| unreachable!("{error}"));
    let window = model.clip();
    let mut raster = Raster::new(window);
    let mut plain =
        PlainRaster { mask: Bitmask::new(window), depth: vec![0; SIDE as usize * SIDE as usize] };
    let mut rows = Vec::new();
    for (side, count) in [(6, 4000), (30, 400), (400, 12)] {
        let list = triangles(&model, side, count);
        raster.mask.clear();
        let mut pixels = 0;
        for triangle in &list {
            let mut mask = Bitmask::new(window);
            model.cover(triangle, &mut mask).unwrap_or_else(own);
            pixels += mask.count();
        }
        for (writes, deep) in [("coverage", false), ("depth", true)] {
            let pair = versus(
                repeats,
                || {
                    for triangle in &list {
                        plainly(&profile, triangle, &mut plain, deep);
                    }
                    plain.depth[0]
                },
                || {
                    for triangle in &list {
                        let drawn = if deep {
                            model.fill(triangle, &mut raster)
                        } else {
                            model.cover(triangle, &mut raster.mask)
                        };
                        drawn.unwrap_or_else(own);
                    }
                    raster.depth(0)[0]
                },
            );
            #[allow(clippy::cast_precision_loss, reason = "counts are reported as rates")]
            let (pixels, triangles) = (pixels as f64, list.len() as f64);
            rows.push(FillRow {
                writes,
                pixels: pixels / triangles,
                ns_per_pixel: pair.fast_ns / pixels,
                millions_per_second: triangles / pair.fast_ns * 1e3,
                ratio: pair.ratio,
            });
        }
    }
    rows
}

pub(super) fn finding(rows: &[FillRow]) -> String {
    let find = |writes: &str, largest: bool| {
        let mut of = rows.iter().filter(|row| row.writes == writes);
        if largest { of.next_back() } else { of.next() }
    };
    let (mask, values) = (find("coverage", true), find("depth", true));
    let (small, deep) = (find("coverage", false), find("depth", false));
    let ns = |row: Option<&FillRow>| row.map_or(f64::NAN, |row| row.ns_per_pixel);
    let rate = |row: Option<&FillRow>| row.map_or(f64::NAN, |row| row.millions_per_second);
    format!(
        "large triangles take {:.3} ns per pixel for coverage and {:.3} ns with depth; for triangles of {:.0} pixels, the rates are \
         {:.1} and {:.1} million triangles per second",
        ns(mask),
        ns(values),
        small.map_or(f64::NAN, |row| row.pixels),
        rate(small),
        rate(deep)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_write_the_same() {
        let (profile, model) = (profile(), Model::new(&profile()).unwrap());
        for (side, count) in [(4, 60), (60, 6)] {
            let mut raster = Raster::new(model.clip());
            let mut plain = PlainRaster {
                mask: Bitmask::new(model.clip()),
                depth: vec![0; SIDE as usize * SIDE as usize],
            };
            for triangle in triangles(&model, side, count) {
                model.fill(&triangle, &mut raster).unwrap();
                plainly(&profile, &triangle, &mut plain, true);
            }
            assert_eq!(raster.mask, plain.mask);
            assert!(raster.mask.count() > 200);
            for y in 0..SIDE {
                assert_eq!(raster.depth(y), &plain.depth[(y * SIDE) as usize..][..SIDE as usize]);
            }
        }
    }
}
