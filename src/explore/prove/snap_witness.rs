//! Triangles whose snap loses a pixel, or claims one. Spec clause `CR-5`.

use super::Witness;
use super::domain::Question;
use super::trial::shoot;
use crate::cover::{ConservativeConfig, ConservativeMode};
use crate::exact::Square;
use crate::profile::Profile;
use crate::setup::Triangle;

/// Real coordinates are tried in so many parts of a sub-pixel.
const PARTS: i128 = 16;

type Xy = [[i128; 2]; 3];

/// The profile with other squares.
fn with(question: &Question, config: ConservativeConfig) -> Option<Profile> {
    let mut profile = question.profile.clone();
    profile.form.edge_mut()?.conservative = Some(config);
    Some(profile)
}

/// The vertices before a snap that takes so many parts of a sub-pixel from each coordinate, if the profile's snap
/// does so.
fn before(question: &Question, xy: Xy, parts: i128) -> Option<Xy> {
    let real = xy.map(|v| v.map(|at| PARTS * at + parts));
    let snap = |at: i128| question.profile.vertex.snap.divide(at, PARTS).map(|(at, _)| at);
    let snapped = real.map(|v| v.map(snap));
    let area = question.vertex_area();
    let same = snapped == xy.map(|v| v.map(Some)) && xy.iter().all(|at| area.holds(*at));
    same.then_some(real)
}

/// A pixel's square in halves of a part of a sub-pixel, with so many halves of a sub-pixel of growth.
fn square(question: &Question, pixel: [i128; 2], grow: i128) -> Square {
    let middle = question.sample(pixel).map(|at| 2 * PARTS * at);
    Square { middle, half_side: PARTS * ((1 << question.sub_pixel()) + grow) }
}

fn witness(
    (grow, pixel): (u32, [i128; 2]),
    (xy, parts): (Xy, i128),
    [expected, got]: [&str; 2],
) -> Witness {
    let (size, way) = (parts.abs(), if parts > 0 { "larger" } else { "smaller" });
    let divisor = (1..=size).rev().find(|n| size % n == 0 && PARTS % n == 0).unwrap_or(1);
    let moved = format!("{}/{} sub-pixel {way}", size / divisor, PARTS / divisor);
    Witness {
        pixel: Some(pixel),
        ..Witness::drawn(
            grow,
            &Triangle { xy, z: None },
            format!("before the snap each coordinate is {moved}, and {expected}"),
            got.to_owned(),
        )
    }
}

/// A triangle with a long side that passes just by a corner of pixel (1, 1): the snap moves the side over it, and
/// `needed` halves of a sub-pixel would have held.
pub(super) fn lost(
    question: &Question,
    config: ConservativeConfig,
    needed: u32,
) -> Option<Witness> {
    let side = 1i128 << question.sub_pixel();
    let pixel = question.origin.map(|at| at + 1);
    let outer = config.mode == ConservativeMode::Outer;
    let plain = square(question, pixel, 0);
    let grown = square(question, pixel, config.grow.into());
    let [own, enough] =
        [config.grow, needed].map(|grow| with(question, ConservativeConfig { grow, ..config }));
    let (own, enough) = (own?, enough?);
    // The corner that is nearest to the vertex at the right angle, or farthest from it.
    let corner = if outer { side } else { 2 * side };
    for (a, b) in near(corner) {
        for parts in (1 - PARTS..PARTS).filter(|parts| *parts != 0) {
            let plain_xy = [[0, 0], [a, 0], [0, b]];
            // Towards the corner with a loss, or away from it.
            for mirrored in [false, true] {
                let xy = plain_xy.map(|v| {
                    [0, 1].map(|axis| {
                        let from = question.origin[axis] * side;
                        from + if mirrored { 3 * side - v[axis] } else { v[axis] }
                    })
                });
                let Some(real) = before(question, xy, parts) else { continue };
                let double = |xy: Xy, by: i128| xy.map(|v| v.map(|at| by * at));
                let (real, snapped) = (double(real, 2), double(xy, 2 * PARTS));
                let found = if outer {
                    plain.touches(real) && !grown.touches(snapped)
                } else {
                    grown.lies_in(snapped) && !plain.lies_in(real)
                };
                let triangle = Triangle { xy, z: None };
                let covered = |profile| Some(shoot(question, profile, &triangle, pixel)?.covered);
                if found && covered(&own)? != outer && covered(&enough)? == outer {
                    let texts = if outer {
                        ["the triangle touches the square of the pixel", "not covered"]
                    } else {
                        ["the square of the pixel is not in the triangle", "covered"]
                    };
                    return Some(witness((config.grow, pixel), (xy, parts), texts));
                }
            }
        }
    }
    None
}

/// Legs whose long side passes a corner (at, at) within two sub-pixels: at / a + at / b is near 1.
fn near(at: i128) -> impl Iterator<Item = (i128, i128)> {
    (at + 1..=4 * at).flat_map(move |a| {
        let b = at * a / (a - at);
        (b - 2..=b + 2).filter(move |b| *b > at && *b <= 4 * at).map(move |b| (a, b))
    })
}

/// A triangle that the snap brings to one point, in the middle of pixel (0, 0).
pub(super) fn flattened(question: &Question, config: ConservativeConfig) -> Option<Witness> {
    let pixel = question.origin;
    let xy = [question.sample(pixel); 3];
    let profile = with(question, config)?;
    // One vertex on the grid, two beside it.
    let parts =
        [PARTS / 4, -PARTS / 4].into_iter().find(|parts| before(question, xy, *parts).is_some())?;
    let covered = shoot(question, &profile, &Triangle { xy, z: None }, pixel)?.covered;
    let [x, y] = xy[0];
    (!covered).then(|| Witness { pixel: Some(pixel), ..Witness::drawn(config.grow, &Triangle { xy, z: None }, format!(
            "before the snap the vertices are ({x}, {y}), ({x} {sign} 1/4, {y}) and ({x}, {y} {sign} 1/4), and the \
             triangle touches the square of the pixel",
            sign = if parts > 0 { '+' } else { '-' }
        ), "nothing: no area is left".to_owned()) })
}
