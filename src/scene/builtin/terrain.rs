//! `terrain`: a height field of hashed value noise, computed in integers.

use crate::scene::mesh::Point;

use super::quad;

/// Cells along each side.
const SIDE: u16 = 32;

/// log2 of the noise's cell sizes, coarse to fine, each half as high as the one before.
const OCTAVES: [u32; 3] = [3, 2, 1];

/// 2 * 32 * 32 = 2048 triangles over -1..=1 in x and z, y up.
pub(super) fn mesh() -> Vec<[Point; 3]> {
    let at = |x: u16, z: u16| {
        let side = f64::from(SIDE);
        let height = f64::from(height(x.into(), z.into())) / f64::from(1 << 22);
        [2.0 * f64::from(x) / side - 1.0, height, 2.0 * f64::from(z) / side - 1.0]
    };
    (0..SIDE)
        .flat_map(|z| (0..SIDE).map(move |x| (x, z)))
        .flat_map(|(x, z)| quad([at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)]))
        .collect()
}

/// Sum of octaves of a 16-bit lattice noise, bilinear between lattice points.
///
/// Growth: 16 bits, times 2^6 for the two blends, made up to 2^6 in every octave: below
/// 2^22 * (1/2 + 1/4 + 1/8) < 2^22.
fn height(x: u32, z: u32) -> u32 {
    (1..)
        .zip(OCTAVES)
        .map(|(octave, log)| {
            let cell = 1 << log;
            let (column, right) = (x >> log, x & (cell - 1));
            let (row, down) = (z >> log, z & (cell - 1));
            let corner = |i, j| noise(octave, column + i, row + j);
            let blend = |a, b, part| a * (cell - part) + b * part;
            let upper = blend(corner(0, 0), corner(1, 0), right);
            let lower = blend(corner(0, 1), corner(1, 1), right);
            (blend(upper, lower, down) << (6 - 2 * log)) >> octave
        })
        .sum()
}

/// Sixteen hashed bits of a lattice point.
fn noise(octave: u32, x: u32, z: u32) -> u32 {
    let mut word = x.wrapping_mul(0x9e37_79b1)
        ^ z.wrapping_mul(0x85eb_ca77)
        ^ octave.wrapping_mul(0xc2b2_ae3d);
    for _ in 0..2 {
        word = (word ^ word >> 15).wrapping_mul(0x2c1b_3c6d);
    }
    word >> 16
}
