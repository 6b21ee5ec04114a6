//! Figures that specifications state: Direct3D, Vulkan, Larrabee.

use super::statement::Statement;
use crate::bits::Rounding;
use crate::exact::{integer, ratio};
use crate::setup::{EdgeCoefficients, snap_f64};

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "d3d.snap",
            "binary32 0xC5FFFD0C = -8191.630859375 in 1/256 pixel is a tie, -2097057.5; to even",
            "-2097058",
            || {
                let x = f64::from(f32::from_bits(0xC5FF_FD0C));
                snap_f64(x, 8, Rounding::NearestEven).map_or("none".to_owned(), |n| n.to_string())
            },
        ),
        Statement::exact(
            "d3d.snap-away",
            "the same tie rounded away from zero on the positive side and up on the negative",
            "2097058, -2097057",
            || {
                let x = f64::from(f32::from_bits(0xC5FF_FD0C));
                [(-x, Rounding::NearestAway), (x, Rounding::NearestUp)]
                    .map(|(x, r)| snap_f64(x, 8, r).map_or("none".to_owned(), |n| n.to_string()))
                    .join(", ")
            },
        ),
        Statement::exact(
            "larrabee.edge",
            "edge (12,8) to (4,24) is 2x + y - 32 = -E/8: its coefficients, and its value at \
             (12,16) and (8,16)",
            "2 1 -32; 8, 0",
            || {
                let edge = EdgeCoefficients::between([12, 8], [4, 24]);
                let [a, b, c] = [edge.a, edge.b, edge.c].map(|n| -n / 8);
                format!("{a} {b} {c}; {}, {}", -edge.at(12, 16) / 8, -edge.at(8, 16) / 8)
            },
        ),
        Statement::exact(
            "vulkan.perspective",
            "line ends with w = 1 and 3, attribute 0 and 1: perspective-correct value at the \
             midpoint on the screen",
            "1/4",
            || {
                let interpolated = || {
                    let [w0, w1] = [ratio(1, 1)?, ratio(1, 3)?];
                    let half = ratio(1, 2)?;
                    let over_w = &half * integer(0) * &w0 + &half * integer(1) * &w1;
                    Some(over_w / (&half * w0 + &half * w1))
                };
                interpolated().map_or("none".to_owned(), |value| value.to_string())
            },
        ),
    ]
}
