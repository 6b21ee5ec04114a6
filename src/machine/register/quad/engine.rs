//! The engine `quads` at work: descent, quads, pixels. Spec clauses `RG-5` to `RG-7`.

use super::{Descent, Emit, QuadConfig, QuadRule, Source};
use crate::bits::bounded;
use crate::cover::SampleGrid;
use crate::format::Gather;
use crate::machine::Target;
use crate::machine::register::Engine;
use crate::setup::Triangle;
use std::cmp::Ordering;
use std::ops::Range;

#[derive(Clone, Debug)]
pub(super) struct Quads {
    pub(super) config: QuadConfig,
    pub(super) source: Source,
    pub(super) target: Target,
}

/// Edge functions from an origin, and the pixels that may be touched.
struct Job {
    /// First pixel.
    origin: [i64; 2],
    /// Values there, and steps to the right and down.
    value: [i64; 3],
    step: [[i64; 2]; 3],
    bias: [i64; 3],
    /// Half-open, in pixels.
    range: [[i64; 2]; 2],
    /// Pixels on a side.
    size: i64,
}

impl Quads {
    /// A value mod 2^width, as a signed number.
    const fn wrap(&self, value: i64) -> i64 {
        let above = 64 - self.config.width;
        value << above >> above
    }

    fn job(&self, words: &[u32]) -> Option<Job> {
        match &self.source {
            Source::Given { tile, range, edges, .. } => {
                let at = |gather: &Gather| gather.unsigned(words).cast_signed();
                let [x0, x1, y0, y1] = range.each_ref().map(at);
                let read = |gather: &Gather| self.wrap(gather.signed(words));
                Some(Job {
                    origin: tile.each_ref().map(at),
                    value: edges.each_ref().map(|edge| read(&edge[2])),
                    step: edges.each_ref().map(|edge| [read(&edge[0]), read(&edge[1])]),
                    bias: [0; 3],
                    range: [[x0, x1], [y0, y1]],
                    size: i64::from(self.config.descent?.tile),
                })
            }
            Source::Vertices { vertices, range, signed } => {
                let SampleGrid { offset, sub_pixel, .. } = self.target.grid;
                let whole = |gather: &Gather| gather.unsigned(words).cast_signed();
                let read = |gather: &Gather| {
                    if *signed { gather.signed(words) } else { whole(gather) }
                };
                let v = vertices.each_ref().map(|vertex| vertex.each_ref().map(read));
                let [left, top, right, bottom] = range.each_ref().map(whole);
                let offset = offset.map(|offset| bounded::<_, i64>(offset));
                let at = [left + offset[0], top + offset[1]];
                let one = 1i64 << sub_pixel;
                let edges = [0, 1, 2].map(|k| (v[(k + 1) % 3], v[(k + 2) % 3]));
                // The range is closed, in sub-pixels.
                let end = [(right, at[0]), (bottom, at[1])]
                    .map(|(end, at)| ((end - at) >> sub_pixel) + 1);
                let origin = at.map(|at| at >> sub_pixel);
                Some(Job {
                    origin,
                    value: edges.map(|(a, b)| {
                        let product = (b[0] - a[0]).wrapping_mul(at[1] - a[1]);
                        self.wrap(product.wrapping_sub((b[1] - a[1]).wrapping_mul(at[0] - a[0])))
                    }),
                    step: edges.map(|(a, b)| {
                        [self.wrap((a[1] - b[1]) * one), self.wrap((b[0] - a[0]) * one)]
                    }),
                    bias: [0, 1, 2].map(|k| self.bias(v[k], edges[k])),
                    range: [[origin[0], origin[0] + end[0]], [origin[1], origin[1] + end[1]]],
                    size: end[0].max(end[1]).max(0),
                })
            }
        }
    }

    /// -1 for an edge that owns nothing: the triangle's third vertex lies left of it, or above it where it
    /// is flat.
    fn bias(&self, third: [i64; 2], (a, b): ([i64; 2], [i64; 2])) -> i64 {
        if self.config.rule == QuadRule::Both {
            return 0;
        }
        let height = self.wrap(b[1] - a[1]);
        let owns_nothing = if height == 0 {
            third[1] < a[1]
        } else {
            let product = self.wrap((b[0] - a[0]).wrapping_mul(third[1] - a[1]));
            third[0] < self.wrap(a[0] + product / height)
        };
        -i64::from(owns_nothing)
    }

    /// A node of the descent, and its quads.
    fn node(&self, job: &Job, at: [i64; 2], size: i64, level: u32, quads: &mut Vec<[i64; 2]>) {
        let Some(Descent { tile, block }) = self.config.descent else { return };
        let outside = (0..3).any(|k| {
            let extent: i64 = job.step[k].iter().filter(|step| **step >= 0).sum();
            // The sum wraps before it is moved down again, and no sign moves with it.
            let mask = (1i64 << self.config.width) - 1;
            let extent = (self.wrap(extent << tile.ilog2()) & mask) >> level;
            self.wrap(self.at(job, k, at) + extent) < 0
        });
        if outside {
            return;
        }
        if size <= i64::from(block) {
            for y in (0..size).step_by(2) {
                quads.extend((0..size).step_by(2).map(|x| [at[0] + x, at[1] + y]));
            }
            return;
        }
        for part in 0..4 {
            let at = [at[0] + size / 2 * (part & 1), at[1] + size / 2 * (part >> 1)];
            self.node(job, at, size / 2, level + 1, quads);
        }
    }

    /// An edge value at a pixel, counted from the origin.
    const fn at(&self, job: &Job, k: usize, at: [i64; 2]) -> i64 {
        let x = job.step[k][0].wrapping_mul(at[0]);
        let y = job.step[k][1].wrapping_mul(at[1]);
        self.wrap(job.value[k].wrapping_add(x).wrapping_add(y))
    }

    fn quad(&self, job: &Job, at: [i64; 2], emit: &mut dyn FnMut(usize, &[i64])) {
        let mut values = [0i64; 15];
        let mut mask = 0;
        for place in 0..4i64 {
            let at = [at[0] + (place & 1), at[1] + (place >> 1)];
            let edges: [i64; 3] = std::array::from_fn(|k| self.at(job, k, at));
            let inside = (0..3).all(|k| self.wrap(edges[k] + job.bias[k]) >= 0);
            let pixel = [job.origin[0] + at[0], job.origin[1] + at[1]];
            let within =
                (0..2).all(|axis| (job.range[axis][0]..job.range[axis][1]).contains(&pixel[axis]));
            mask |= i64::from(inside && within) << place;
            for (k, value) in edges.into_iter().enumerate() {
                values[4 * k + bounded::<_, usize>(place) + 3] = value;
            }
        }
        if mask == 0 {
            return;
        }
        values[..3].copy_from_slice(&[
            (job.origin[0] + at[0]) >> 1,
            (job.origin[1] + at[1]) >> 1,
            mask,
        ]);
        emit(0, &values);
    }

    /// The columns of the row of quads at `y` that may hold a pixel, counted from the origin: what the edge
    /// words of its first quad say of the whole row. They wrap, and then the row loses pixels. Clause `RG-5`.
    fn columns(&self, job: &Job, y: i64) -> Range<i64> {
        let quad = 2i64 << self.target.grid.sub_pixel;
        // Quads in a distance of whole quads, which wraps as an edge word does.
        let quads = |count: i64| self.wrap(quad * count) / quad;
        let (mut low, mut high) = (0, i64::MAX / 4);
        for k in 0..3 {
            let corners = [[0, y], [1, y], [0, y + 1], [1, y + 1]].map(|at| self.at(job, k, at));
            let most = corners.into_iter().fold(i64::MIN, i64::max);
            // From quad to quad; the distance to the zero of this edge is cut toward zero.
            let step = self.wrap(2 * job.step[k][0]);
            match (most < 0, step.cmp(&0)) {
                (true, Ordering::Greater) => low = low.max(quads(-most / step)),
                (true, _) => return 0..0,
                (false, Ordering::Less) => high = high.min(quads(-most / step + 1)),
                (false, _) => {}
            }
        }
        let count = job.range[0][1] - job.range[0][0];
        2 * low..(2 * (high + 1)).min(count)
    }

    /// Pixels of a row, one by one.
    fn row(&self, job: &Job, y: i64, columns: Range<i64>, emit: &mut dyn FnMut(usize, &[i64])) {
        let mut edges: [i64; 3] = std::array::from_fn(|k| self.at(job, k, [columns.start, y]));
        for x in columns {
            if (0..3).all(|k| self.wrap(edges[k] + job.bias[k]) >= 0) {
                let [e0, e1, e2] = edges;
                emit(0, &[job.origin[0] + x, job.origin[1] + y, e0, e1, e2]);
            }
            for (edge, step) in edges.iter_mut().zip(&job.step) {
                *edge = self.wrap(edge.wrapping_add(step[0]));
            }
        }
    }
}

impl Engine for Quads {
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64])) {
        let Some(job) = self.job(words) else { return };
        match (self.config.descent, self.config.emit) {
            // Without a descent the range begins at the origin.
            (None, kind) => {
                let count = job.range[1][1] - job.range[1][0];
                for y in (0..count).step_by(2) {
                    let columns = self.columns(&job, y);
                    match kind {
                        Emit::Pixels => (y..count.min(y + 2))
                            .for_each(|y| self.row(&job, y, columns.clone(), emit)),
                        Emit::Quads => {
                            columns.step_by(2).for_each(|x| self.quad(&job, [x, y], emit));
                        }
                    }
                }
            }
            (Some(descent), kind) => {
                let mut quads = Vec::new();
                let tile = i64::from(descent.tile);
                for y in (0..job.size).step_by(descent.tile as usize) {
                    for x in (0..job.size).step_by(descent.tile as usize) {
                        self.node(&job, [x, y], tile, 0, &mut quads);
                    }
                }
                quads.sort_unstable_by_key(|at| (at[1], at[0]));
                if kind == Emit::Quads {
                    for at in quads {
                        self.quad(&job, at, emit);
                    }
                } else {
                    pixels(&job, &quads, |y, x| {
                        let edges: [i64; 3] = std::array::from_fn(|k| self.at(&job, k, [x, y]));
                        if (0..3).all(|k| self.wrap(edges[k] + job.bias[k]) >= 0) {
                            let [e0, e1, e2] = edges;
                            emit(0, &[job.origin[0] + x, job.origin[1] + y, e0, e1, e2]);
                        }
                    });
                }
            }
        }
    }

    /// The pixels of the range, or of the tile.
    fn work(&self, words: &[u32], _: u64) -> u128 {
        let Some(job) = self.job(words) else { return 0 };
        let side = |axis: usize| (job.range[axis][1] - job.range[axis][0]).max(0).unsigned_abs();
        match self.config.descent {
            None => u128::from(side(0)) * u128::from(side(1)),
            Some(_) => u128::from(job.size.max(0).unsigned_abs()).pow(2),
        }
    }

    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        self.host_words(triangle, count)
    }
}

/// Calls `pixel` with y and x of all pixels of sorted quads, in the order of y then x.
fn pixels(job: &Job, quads: &[[i64; 2]], mut pixel: impl FnMut(i64, i64)) {
    for row in quads.chunk_by(|a, b| a[1] == b[1]) {
        for y in [row[0][1], row[0][1] + 1] {
            for x in row.iter().flat_map(|at| [at[0], at[0] + 1]) {
                let at = [job.origin[0] + x, job.origin[1] + y];
                if (0..2).all(|axis| (job.range[axis][0]..job.range[axis][1]).contains(&at[axis])) {
                    pixel(y, x);
                }
            }
        }
    }
}
