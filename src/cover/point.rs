//! Points and circles. Spec clauses `L-8` to `L-10`.

use super::rect::Rect;
use super::sample::SampleGrid;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a point draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PointRule {
    /// The pixel that holds it: (floor x, floor y).
    #[default]
    Pixel,
    /// The pixel of Direct3D: (ceil(x - 1), ceil(y - 1)).
    PixelD3d,
    /// Samples of a square around it, its upper and left sides included.
    Square {
        /// Its side, in sub-pixels.
        size: u32,
    },
    /// Samples of a disk around it; on the rim those above its centre, and on its height those to
    /// the left.
    Disk {
        /// Its diameter, in sub-pixels.
        size: u32,
    },
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct PointConfig {
    /// Which pixels.
    pub rule: PointRule,
}

/// A point rule that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("point size = {0}: a point with an area has 1 to 2^24 sub-pixels")]
pub struct PointError(pub u32);

impl PointConfig {
    /// Checks the size.
    ///
    /// # Errors
    /// [`PointError`] unless it is 1 to 2^24.
    pub fn validate(&self) -> Result<(), PointError> {
        match self.rule {
            PointRule::Square { size } | PointRule::Disk { size }
                if !(1..=1 << 24).contains(&size) =>
            {
                Err(PointError(size))
            }
            _ => Ok(()),
        }
    }

    /// Calls `row(y, x0, x1)` for the runs of a point inside `clip`, top to bottom.
    pub fn rows(
        &self,
        point: [i128; 2],
        grid: &SampleGrid,
        clip: Rect,
        row: &mut dyn FnMut(u32, u32, u32),
    ) {
        let pixel = |[x, y]: [i128; 2], row: &mut dyn FnMut(u32, u32, u32)| {
            let ((x0, x1), (y0, y1)) = (clip.clip(0, (x, x + 1)), clip.clip(1, (y, y + 1)));
            if x0 < x1 && y0 < y1 {
                row(y0, x0, x1);
            }
        };
        let s = grid.sub_pixel;
        match self.rule {
            PointRule::Pixel => pixel(point.map(|value| value >> s), row),
            PointRule::PixelD3d => pixel(point.map(|value| -(-value >> s) - 1), row),
            PointRule::Square { size } => {
                // 2 (sample - point) in [-size, size).
                let size = i128::from(size);
                let side = |axis: usize| {
                    grid.pixels(axis, (point[axis] - size / 2, point[axis] + (size + 1) / 2 - 1))
                };
                let ((x0, x1), (y0, y1)) = (clip.clip(0, side(0)), clip.clip(1, side(1)));
                if x0 < x1 {
                    (y0..y1).for_each(|y| row(y, x0, x1));
                }
            }
            PointRule::Disk { size } => {
                let size = i128::from(size);
                let reach = |axis: usize| (point[axis] - size / 2 - 1, point[axis] + size / 2 + 1);
                let (y0, y1) = clip.clip(1, grid.pixels(1, reach(1)));
                for y in y0..y1 {
                    let down = grid.position(0, i128::from(y))[1] - point[1];
                    let rest = size * size - 4 * down * down;
                    if rest < 0 {
                        continue;
                    }
                    // The farthest sub-pixel column whose square stays within the rest.
                    let far = rest.unsigned_abs().isqrt().cast_signed();
                    let on_rim = far * far == rest && far % 2 == 0;
                    let inner = far / 2;
                    // A rim point above belongs, one below does not; level with the centre, the left.
                    let (left, right) = match (on_rim, down.signum()) {
                        (false, _) | (true, -1) => (inner, inner),
                        (true, 0) => (inner, inner - 1),
                        _ => (inner - 1, inner - 1),
                    };
                    let columns = grid.pixels(0, (point[0] - left, point[0] + right));
                    let (x0, x1) = clip.clip(0, columns);
                    if x0 < x1 {
                        row(y, x0, x1);
                    }
                }
            }
        }
    }
}

/// The midpoint circle of radius `r` around a pixel: each pixel once, octant by octant.
///
/// ```
/// let mut second = Vec::new();
/// guardbit::cover::circle(10, &mut |[x, y]| {
///     if 0 <= x && x <= y { second.push((x, y)) }
/// });
/// second.sort_unstable();
/// assert_eq!(second, [(0, 10), (1, 10), (2, 10), (3, 10), (4, 9), (5, 9), (6, 8), (7, 7)]);
/// ```
pub fn circle(r: u32, plot: &mut dyn FnMut([i64; 2])) {
    let (mut x, mut y, mut e) = (0, i64::from(r), 0);
    while x <= y {
        let mut points: Vec<[i64; 2]> = [[x, y], [y, x]]
            .into_iter()
            .flat_map(|[a, b]| [[a, b], [-a, b], [a, -b], [-a, -b]])
            .collect();
        // On an axis and on a diagonal octants meet.
        points.sort_unstable();
        points.dedup();
        points.into_iter().for_each(&mut *plot);
        e += 2 * x + 1;
        x += 1;
        if e > y - 1 {
            e -= 2 * y - 1;
            y -= 1;
        }
    }
}
