//! The dispatched kernels. Generic over the lane only: width and mode are data.
//! Each has a plain twin in [`super::twin`] and a property test that ties the two.
#![allow(
    clippy::needless_range_loop,
    reason = "parallel arrays by index are what the vectoriser sees through"
)]

use super::processor::Processor;
use crate::bits::Lane;
use crate::format::Decode;
use fearless_simd::dispatch;
use num_traits::AsPrimitive;

/// Samples per block: enough independent additions to fill the widest vector unit twice.
const BLOCK: usize = 32;

/// The multiples 0 to BLOCK-1 of a slope: one addition each from a block's base.
#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn ramp<L: Lane>(slope: L) -> [L; BLOCK] {
    let mut offset = L::zero();
    std::array::from_fn(|_| {
        let here = offset;
        offset = offset.wrapping_add(&slope);
        here
    })
}

/// Reads a row of a plane: `out[n]` is the read-out of `start + n * slope`.
///
/// Formats: lane words as [`Decode::load`] and [`Decode::slope`] make them; results unsigned, and what
/// does not fit `T` is cut off.
/// Twin: [`super::twin::row_values`].
#[inline]
pub fn row_values<L: Lane + AsPrimitive<T>, T: Copy + 'static>(
    processor: Processor,
    decode: Decode<L>,
    start: L,
    slope: L,
    out: &mut [T],
) {
    dispatch!(processor.level(), _simd => row_values_body(decode, start, slope, out));
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn row_values_body<L: Lane + AsPrimitive<T>, T: Copy + 'static>(
    decode: Decode<L>,
    start: L,
    slope: L,
    out: &mut [T],
) {
    if out.len() < BLOCK {
        let mut value = start;
        for slot in out {
            *slot = decode.read(value).as_();
            value = value.wrapping_add(&slope);
        }
        return;
    }
    let offsets = ramp(slope);
    let stride = offsets[BLOCK - 1].wrapping_add(&slope);
    let mut base = start;
    for block in out.chunks_mut(BLOCK) {
        for (slot, offset) in block.iter_mut().zip(&offsets) {
            *slot = decode.read(base.wrapping_add(offset)).as_();
        }
        base = base.wrapping_add(&stride);
    }
}

/// Walks a whole window of a plane and folds every read-out into a checksum: the sum of
/// (read-out XOR column) mod 2^64. It is the speed measurement's stand-in for a consumer.
pub fn walk_checksum<L: Lane>(
    processor: Processor,
    decode: Decode<L>,
    plane: [L; 3],
    size: (u32, u32),
    mut row: impl FnMut(u32),
) -> u64 {
    let [mut start, dx, dy] = plane;
    let mut sum = 0u64;
    for y in 0..size.1 {
        row(y);
        sum = sum.wrapping_add(
            dispatch!(processor.level(), _simd => row_checksum(decode, start, dx, size.0)),
        );
        start = start.wrapping_add(&dy);
    }
    sum
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn row_checksum<L: Lane>(decode: Decode<L>, start: L, slope: L, width: u32) -> u64 {
    let offsets = ramp(slope);
    let stride = offsets[BLOCK - 1].wrapping_add(&slope);
    let mut sums = [0u64; BLOCK];
    let mut columns: [u64; BLOCK] = std::array::from_fn(|n| n as u64);
    let mut base = start;
    for _ in 0..width as usize / BLOCK {
        for n in 0..BLOCK {
            let value: u64 = decode.read(base.wrapping_add(&offsets[n])).as_();
            sums[n] = sums[n].wrapping_add(value ^ columns[n]);
            columns[n] += BLOCK as u64;
        }
        base = base.wrapping_add(&stride);
    }
    let mut sum = sums.iter().fold(0, |a: u64, b| a.wrapping_add(*b));
    for n in 0..width as usize % BLOCK {
        let value: u64 = decode.read(base.wrapping_add(&offsets[n])).as_();
        sum = sum.wrapping_add(value ^ columns[n]);
    }
    sum
}

/// Three edge words at a sample and their steps, left-justified.
#[derive(Clone, Copy, Debug)]
pub struct Edges<L> {
    /// Edge words at the first sample.
    pub value: [L; 3],
    /// Change per pixel to the right.
    pub step_x: [L; 3],
    /// Change per row downward.
    pub step_y: [L; 3],
}

impl<L: Lane> Edges<L> {
    /// The edges `n` rows down.
    #[inline]
    #[must_use]
    pub fn rows_down(mut self, n: L) -> Self {
        for k in 0..3 {
            self.value[k] = self.value[k].wrapping_add(&self.step_y[k].wrapping_mul(&n));
        }
        self
    }
}

/// One bit a sample, 64 a word, least significant first: whether the sign bits of all three edge
/// words are clear. Twin: [`super::twin::row_inside`].
#[inline]
pub fn row_inside<L: Lane>(processor: Processor, edges: Edges<L>, count: u32, out: &mut Vec<u64>) {
    out.clear();
    if count <= 16 {
        out.push(short_mask(edges, count));
    } else {
        dispatch!(processor.level(), _simd => row_inside_body(edges, count, out));
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn short_mask<L: Lane>(edges: Edges<L>, count: u32) -> u64 {
    let mut value = edges.value;
    let mut mask = 0;
    for n in 0..count {
        let any = value[0] | value[1] | value[2];
        mask |= u64::from(any >= L::zero()) << n;
        for k in 0..3 {
            value[k] = value[k].wrapping_add(&edges.step_x[k]);
        }
    }
    mask
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn row_inside_body<L: Lane>(edges: Edges<L>, count: u32, out: &mut Vec<u64>) {
    let offsets = edges.step_x.map(ramp);
    let strides: [L; 3] =
        std::array::from_fn(|k| offsets[k][BLOCK - 1].wrapping_add(&edges.step_x[k]));
    let mut base = edges.value;
    let mut left = count;
    while left > 0 {
        let mut word = 0u64;
        for half in 0..64 / BLOCK {
            let mut inside = [0u8; BLOCK];
            for n in 0..BLOCK {
                let any = base[0].wrapping_add(&offsets[0][n])
                    | base[1].wrapping_add(&offsets[1][n])
                    | base[2].wrapping_add(&offsets[2][n]);
                inside[n] = u8::from(any >= L::zero());
            }
            for (n, bytes) in inside.chunks_exact(8).enumerate() {
                // Eight 0/1 bytes to eight bits by one multiplication.
                let bytes = bytes.iter().rev().fold(0u64, |a, b| a << 8 | u64::from(*b));
                let bits = bytes.wrapping_mul(0x0102_0408_1020_4080) >> 56;
                word |= bits << (half * BLOCK + n * 8);
            }
            for k in 0..3 {
                base[k] = base[k].wrapping_add(&strides[k]);
            }
        }
        if left < 64 {
            word &= (1 << left) - 1;
        }
        out.push(word);
        left = left.saturating_sub(64);
    }
}

/// How many samples of a `size.0` by `size.1` block have all three sign bits clear.
pub fn count_inside<L: Lane>(processor: Processor, edges: Edges<L>, size: (u32, u32)) -> u64 {
    dispatch!(processor.level(), _simd => block_count(edges, size))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn block_count<L: Lane>(edges: Edges<L>, (width, height): (u32, u32)) -> u64 {
    let offsets = edges.step_x.map(ramp);
    let strides: [L; 3] =
        std::array::from_fn(|k| offsets[k][BLOCK - 1].wrapping_add(&edges.step_x[k]));
    let mut outside = [0u64; BLOCK];
    let mut row = edges.value;
    for _ in 0..height {
        let mut base = row;
        for _ in 0..width as usize / BLOCK {
            for n in 0..BLOCK {
                outside[n] += outside_bit(base, &offsets, n);
            }
            for k in 0..3 {
                base[k] = base[k].wrapping_add(&strides[k]);
            }
        }
        for n in 0..width as usize % BLOCK {
            outside[n] += outside_bit(base, &offsets, n);
        }
        for k in 0..3 {
            row[k] = row[k].wrapping_add(&edges.step_y[k]);
        }
    }
    u64::from(width) * u64::from(height) - outside.iter().sum::<u64>()
}

/// 1 when any edge word at offset `n` is negative.
#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn outside_bit<L: Lane>(base: [L; 3], offsets: &[[L; BLOCK]; 3], n: usize) -> u64 {
    let any = base[0].wrapping_add(&offsets[0][n])
        | base[1].wrapping_add(&offsets[1][n])
        | base[2].wrapping_add(&offsets[2][n]);
    any.unsigned_shr(L::BITS - 1).as_()
}
