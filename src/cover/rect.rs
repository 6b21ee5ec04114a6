//! Half-open rectangles of pixels: windows and scissors. Spec clause `C-6`.

#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The largest window side in pixels.
const SIDE: u32 = 1 << 16;

/// Pixels `[x0, x1)` by `[y0, y1)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
pub struct Rect {
    /// First column.
    pub x0: u32,
    /// First row.
    pub y0: u32,
    /// One past the last column.
    pub x1: u32,
    /// One past the last row.
    pub y1: u32,
}

/// A window that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{width} x {height}: a window has 1 to 65536 pixels on each side")]
pub struct RectError {
    /// Width asked for.
    pub width: u32,
    /// Height asked for.
    pub height: u32,
}

impl Rect {
    /// The window of this size, from (0, 0).
    ///
    /// # Errors
    /// [`RectError`] unless both sides are 1 to 65536.
    pub fn window(width: u32, height: u32) -> Result<Self, RectError> {
        if (1..=SIDE).contains(&width) && (1..=SIDE).contains(&height) {
            Ok(Self { x0: 0, y0: 0, x1: width, y1: height })
        } else {
            Err(RectError { width, height })
        }
    }

    /// What both rectangles share; empty rectangles have equal ends.
    #[must_use]
    pub fn intersect(self, other: Self) -> Self {
        let (x0, y0) = (self.x0.max(other.x0), self.y0.max(other.y0));
        Self { x0, y0, x1: self.x1.min(other.x1).max(x0), y1: self.y1.min(other.y1).max(y0) }
    }

    /// The part of a range of pixel columns (axis 0) or rows (axis 1) inside the rectangle.
    pub fn clip(&self, axis: usize, (low, high): (i128, i128)) -> (u32, u32) {
        let (first, end) = if axis == 0 { (self.x0, self.x1) } else { (self.y0, self.y1) };
        let within = |value: i128| {
            u32::try_from(value.clamp(i128::from(first), i128::from(end))).unwrap_or(end)
        };
        let low = within(low);
        (low, within(high).max(low))
    }
}
