//! Pictures of one bit a pixel, and what may have happened to them on the way. Spec clause `ID-4`.

use crate::cover::Rect;
use crate::machine::Sink;
use std::collections::BTreeSet;

/// One bit for each pixel of a window.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Picture {
    width: u32,
    height: u32,
    /// Words of 64 pixels, row by row.
    bits: Vec<u64>,
}

impl Picture {
    /// A picture of a window with no pixel set.
    pub fn empty((width, height): (u32, u32)) -> Self {
        Self { width, height, bits: vec![0; width.div_ceil(64) as usize * height as usize] }
    }

    /// Columns and rows.
    pub const fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    fn at(&self, x: u32, y: u32) -> (usize, u64) {
        let row = self.width.div_ceil(64) as usize * y as usize;
        (row + (x / 64) as usize, 1 << (x % 64))
    }

    /// Whether a pixel is set.
    pub fn get(&self, x: u32, y: u32) -> bool {
        let (word, bit) = self.at(x, y);
        self.bits[word] & bit != 0
    }

    /// Sets the pixels of a rectangle that lie in the window.
    pub fn fill(&mut self, rect: Rect) {
        let (x1, y1) = (rect.x1.min(self.width), rect.y1.min(self.height));
        for y in rect.y0..y1 {
            let mut x = rect.x0;
            while x < x1 {
                let (word, _) = self.at(x, y);
                let end = x1.min((x / 64 + 1) * 64);
                let count = end - x;
                self.bits[word] |= (u64::MAX >> (64 - count)) << (x % 64);
                x = end;
            }
        }
    }

    /// Clears every pixel.
    pub fn clear(&mut self) {
        self.bits.fill(0);
    }

    /// Pixels that are set.
    pub fn count(&self) -> u32 {
        self.bits.iter().map(|word| word.count_ones()).sum()
    }

    /// The places of pixels that are set.
    pub(super) fn pixels(&self) -> BTreeSet<(u32, u32)> {
        let all = (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y)));
        all.filter(|(x, y)| self.get(*x, *y)).collect()
    }

    /// Pixels that are set in both.
    pub(super) fn common(&self, other: &Self) -> u32 {
        self.bits.iter().zip(&other.bits).map(|(a, b)| (a & b).count_ones()).sum()
    }

    /// Whether two pictures agree where `known` is set.
    pub fn agrees(&self, other: &Self, known: &Self) -> bool {
        let words = self.bits.iter().zip(&other.bits).zip(&known.bits);
        words.into_iter().all(|((a, b), known)| (a ^ b) & known == 0)
    }

    /// The picture with each pixel taken from elsewhere: those of pixels that `from` gives, none where it
    /// gives a place outside the window.
    fn moved(&self, from: impl Fn(i64, i64) -> (i64, i64)) -> Self {
        let mut moved = Self::empty(self.size());
        for (y, x) in (0..self.height).flat_map(|y| (0..self.width).map(move |x| (y, x))) {
            let (sx, sy) = from(i64::from(x), i64::from(y));
            let inside = |value: i64, end: u32| u32::try_from(value).ok().filter(|v| *v < end);
            if let (Some(sx), Some(sy)) = (inside(sx, self.width), inside(sy, self.height))
                && self.get(sx, sy)
            {
                let (word, bit) = moved.at(x, y);
                moved.bits[word] |= bit;
            }
        }
        moved
    }
}

impl Sink for Picture {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        self.fill(Rect { x0, y0: y, x1, y1: y + 1 });
    }
}

/// What a capture may have done to every picture of the machine: mirrored first, then moved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Capture {
    /// Left and right are exchanged.
    pub mirror_x: bool,
    /// Top and bottom are exchanged.
    pub mirror_y: bool,
    /// Columns to the right.
    pub right: i32,
    /// Rows down.
    pub down: i32,
}

impl Capture {
    /// Every capture that moves a picture by at most `shift` pixels on each axis, the one that changes nothing
    /// first.
    pub fn all(shift: u32, mirrored: bool) -> Vec<Self> {
        let shift = i32::try_from(shift).unwrap_or(i32::MAX);
        let both = [false, true];
        let mirrors = if mirrored { &both[..] } else { &both[..1] };
        let mut all = Vec::new();
        for (mirror_x, mirror_y) in mirrors.iter().flat_map(|x| mirrors.iter().map(move |y| (x, y)))
        {
            for (right, down) in
                (-shift..=shift).flat_map(|right| (-shift..=shift).map(move |down| (right, down)))
            {
                all.push(Self { mirror_x: *mirror_x, mirror_y: *mirror_y, right, down });
            }
        }
        all.sort_by_key(|capture| *capture != Self::default());
        all
    }

    /// The machine's picture behind a captured one: `None` is what changes nothing.
    pub(super) fn undone(self, captured: &Picture) -> Picture {
        if self == Self::default() {
            return captured.clone();
        }
        let (width, height) = (i64::from(captured.width), i64::from(captured.height));
        captured.moved(|x, y| {
            let x = if self.mirror_x { width - 1 - x } else { x };
            let y = if self.mirror_y { height - 1 - y } else { y };
            (x + i64::from(self.right), y + i64::from(self.down))
        })
    }
}

impl std::fmt::Display for Capture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mirrored = match (self.mirror_x, self.mirror_y) {
            (false, false) => "as it is",
            (true, false) => "mirrored left to right",
            (false, true) => "mirrored top to bottom",
            (true, true) => "turned by 180 degrees",
        };
        write!(f, "{mirrored}, moved by ({}, {})", self.right, self.down)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_fill_words_and_parts_of_words() {
        for (x0, x1) in [(0, 1), (0, 64), (3, 130), (63, 65), (128, 200), (7, 7)] {
            let mut picture = Picture::empty((130, 3));
            picture.fill(Rect { x0, y0: 1, x1, y1: 9 });
            for (y, x) in (0..3).flat_map(|y| (0..130).map(move |x| (y, x))) {
                assert_eq!(picture.get(x, y), y >= 1 && x0 <= x && x < x1, "{x} {y}");
            }
        }
    }

    /// Clause ID-4: what is captured, undone, is what was drawn, where it stayed in the window.
    #[test]
    fn captures_are_undone() {
        let size = (9, 7);
        let mut drawn = Picture::empty(size);
        drawn.fill(Rect { x0: 3, y0: 2, x1: 5, y1: 3 });
        drawn.fill(Rect { x0: 3, y0: 3, x1: 4, y1: 4 });
        let all = Capture::all(2, true);
        assert_eq!((all.len(), all[0]), (100, Capture::default()));
        for capture in all {
            // Pixel (x, y) of the machine goes to where the capture puts it.
            let mut captured = Picture::empty(size);
            for (x, y) in [(3i32, 2i32), (4, 2), (3, 3)] {
                let x = if capture.mirror_x { 8 - x } else { x } + capture.right;
                let y = if capture.mirror_y { 6 - y } else { y } + capture.down;
                let [x, y] = [x, y].map(|v| u32::try_from(v).unwrap());
                captured.fill(Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 });
            }
            assert_eq!(capture.undone(&captured), drawn, "{capture}");
        }
    }
}
