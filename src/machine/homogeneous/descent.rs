//! The recursion: a block of samples is left out, taken whole, or halved on both axes.

use crate::cover::Rect;
use crate::machine::{Target, Work};
use crate::setup::{Linear, linear_at};

/// A descent into one primitive.
pub(super) struct Descent<'a> {
    functions: &'a [Linear],
    target: &'a Target,
    found: Vec<[u32; 3]>,
}

impl<'a> Descent<'a> {
    pub(super) fn new(functions: &'a [Linear], target: &'a Target) -> Self {
        Self { functions, target, found: Vec::new() }
    }

    /// The covered runs `[y, x0, x1)`, maximal, in y then x order.
    pub(super) fn runs(mut self, work: &mut Work) -> Vec<[u32; 3]> {
        let clip = self.target.clip;
        if clip.x0 < clip.x1 && clip.y0 < clip.y1 {
            let side = clip.x1.max(clip.y1).next_power_of_two();
            self.block(0, 0, side.max(2), work);
        }
        self.found.sort_unstable();
        let mut runs: Vec<[u32; 3]> = Vec::with_capacity(self.found.len());
        for [y, x0, x1] in self.found {
            match runs.last_mut() {
                Some(last) if last[0] == y && last[2] == x0 => last[2] = x1,
                _ => runs.push([y, x0, x1]),
            }
        }
        runs
    }

    /// Lowest and highest value of a function over the samples of a block.
    fn range(&self, f: &Linear, x: u32, y: u32, side: u32) -> (i128, i128) {
        let grid = &self.target.grid;
        let first = linear_at(f, grid.position(i128::from(x), i128::from(y)));
        let span = i128::from(side - 1) << grid.sub_pixel;
        let (dx, dy) = (f[0] * span, f[1] * span);
        (first + dx.min(0) + dy.min(0), first + dx.max(0) + dy.max(0))
    }

    fn block(&mut self, x: u32, y: u32, side: u32, work: &mut Work) {
        let block = Rect { x0: x, y0: y, x1: x + side, y1: y + side };
        let inner = block.intersect(self.target.clip);
        if inner.x0 >= inner.x1 || inner.y0 >= inner.y1 {
            return;
        }
        work.tiles += 1;
        let mut whole = true;
        for f in self.functions {
            let (low, high) = self.range(f, x, y, side);
            if high < 0 {
                return;
            }
            whole &= low >= 0;
        }
        if whole {
            self.found.extend((inner.y0..inner.y1).map(|y| [y, inner.x0, inner.x1]));
        } else if side == 2 {
            self.samples(inner, work);
        } else {
            let half = side / 2;
            for (right, down) in [(0, 0), (half, 0), (0, half), (half, half)] {
                self.block(x + right, y + down, half, work);
            }
        }
    }

    /// Two by two samples at once, each decided by itself.
    fn samples(&mut self, inner: Rect, work: &mut Work) {
        work.visits += 4;
        for y in inner.y0..inner.y1 {
            for x in inner.x0..inner.x1 {
                let at = self.target.grid.position(i128::from(x), i128::from(y));
                if self.functions.iter().all(|f| linear_at(f, at) >= 0) {
                    self.found.push([y, x, x + 1]);
                }
            }
        }
    }
}
