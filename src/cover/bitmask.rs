//! Coverage as bits in memory: a pixel a bit, 64 a word, least significant first.

use super::rect::Rect;

/// A window's coverage, one bit a pixel.
///
/// ```
/// use guardbit::cover::{Bitmask, Rect};
/// let mut mask = Bitmask::new(Rect { x0: 0, y0: 0, x1: 100, y1: 2 });
/// mask.fill(1, 60, 70);
/// assert_eq!(mask.row(1), [0xf << 60, 0x3f]);
/// assert_eq!(mask.count(), 10);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bitmask {
    words: Vec<u64>,
    pitch: usize,
}

impl Bitmask {
    /// Nothing covered; pixels `[0, x1)` by `[0, y1)` of a window.
    pub fn new(window: Rect) -> Self {
        let pitch = window.x1.div_ceil(64) as usize;
        Self { words: vec![0; pitch * window.y1 as usize], pitch }
    }

    /// Covers `[x0, x1)` of row y, which lie in the window.
    #[inline]
    pub fn fill(&mut self, y: u32, x0: u32, x1: u32) {
        if x0 >= x1 {
            return;
        }
        let begin = y as usize * self.pitch;
        let (first, last) = ((x0 / 64) as usize, ((x1 - 1) / 64) as usize);
        let row = &mut self.words[begin + first..=begin + last];
        let head = u64::MAX << (x0 % 64);
        let tail = u64::MAX >> (63 - (x1 - 1) % 64);
        match row {
            [one] => *one |= head & tail,
            [one, middle @ .., other] => {
                *one |= head;
                middle.fill(u64::MAX);
                *other |= tail;
            }
            [] => {}
        }
    }

    /// The words of row y.
    pub fn row(&self, y: u32) -> &[u64] {
        &self.words[y as usize * self.pitch..][..self.pitch]
    }

    /// Whether pixel (x, y) is covered.
    pub fn get(&self, x: u32, y: u32) -> bool {
        self.row(y)[(x / 64) as usize] >> (x % 64) & 1 == 1
    }

    /// Covered pixels.
    pub fn count(&self) -> u64 {
        self.words.iter().map(|word| u64::from(word.count_ones())).sum()
    }

    /// Covers nothing again.
    pub fn clear(&mut self) {
        self.words.fill(0);
    }
}
