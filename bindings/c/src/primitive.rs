//! One door for every primitive: a kind, and its numbers.

use crate::{Failure, GUARDBIT_ARGUMENT};
use guardbit::scene::{Primitive, Triangle};
use guardbit::setup::{ClipTriangle, Polygon};

/// A triangle: x, y of three vertices, or x, y, z of three.
pub const GUARDBIT_TRIANGLE: u32 = 0;
/// A line: x, y of both ends.
pub const GUARDBIT_LINE: u32 = 1;
/// A point: x, y.
pub const GUARDBIT_POINT: u32 = 2;
/// A polygon: x, y of three or more vertices.
pub const GUARDBIT_POLYGON: u32 = 3;
/// A polygon with depth: x, y, z of three or more vertices.
pub const GUARDBIT_POLYGON_DEPTH: u32 = 4;
/// A triangle that is neither projected nor clipped: X, Y, W of three vertices, or X, Y, Z, W.
pub const GUARDBIT_CLIP: u32 = 5;
/// The register words of a machine that begins there, each 0 to 2^32 - 1.
pub const GUARDBIT_WORDS: u32 = 6;

/// What is to be drawn.
pub(crate) enum Given {
    Primitive(Primitive),
    Words(Vec<u32>),
}

/// The primitive of a kind with these numbers.
pub(crate) fn given(kind: u32, numbers: &[i64]) -> Result<Given, Failure> {
    let count = numbers.len();
    let wrong = |need: &str| {
        Failure::new(GUARDBIT_ARGUMENT, format!("count = {count}: kind {kind} takes {need}"))
    };
    let wide: Vec<i128> = numbers.iter().map(|number| i128::from(*number)).collect();
    let pairs = |stride: usize| wide.chunks_exact(stride).map(|v| [v[0], v[1]]).collect::<Vec<_>>();
    let three = |list: Vec<[i128; 2]>| <[[i128; 2]; 3]>::try_from(list);
    let third = |stride: usize| wide.chunks_exact(stride).map(|v| v[2]).collect::<Vec<_>>();
    Ok(Given::Primitive(match kind {
        GUARDBIT_TRIANGLE => {
            let stride = if count == 6 { 2 } else { 3 };
            let xy = three(pairs(stride)).map_err(|_| wrong("6 or 9 numbers"))?;
            let z = if stride == 3 { <[i128; 3]>::try_from(third(3)).ok() } else { None };
            Primitive::Triangle(Triangle::Lattice { xy, z })
        }
        GUARDBIT_LINE => {
            let ends = <[[i128; 2]; 2]>::try_from(pairs(2));
            Primitive::Line(ends.map_err(|_| wrong("4 numbers"))?)
        }
        GUARDBIT_POINT => {
            Primitive::Point(<[i128; 2]>::try_from(wide).map_err(|_| wrong("2 numbers"))?)
        }
        GUARDBIT_POLYGON | GUARDBIT_POLYGON_DEPTH => {
            let stride = if kind == GUARDBIT_POLYGON { 2 } else { 3 };
            if !count.is_multiple_of(stride) || count < 3 * stride {
                return Err(wrong(&format!("{stride} numbers for each of three or more vertices")));
            }
            let z = (stride == 3).then(|| third(3));
            Primitive::Polygon(Polygon { xy: pairs(stride), z })
        }
        GUARDBIT_CLIP if count == 9 || count == 12 => {
            let stride = count / 3;
            let vertex = |n: usize| &wide[n * stride..][..stride];
            let xyw = [0, 1, 2].map(|n| [vertex(n)[0], vertex(n)[1], vertex(n)[stride - 1]]);
            let z = (stride == 4).then(|| [0, 1, 2].map(|n| vertex(n)[2]));
            Primitive::Clip(ClipTriangle { xyw, z })
        }
        GUARDBIT_CLIP => return Err(wrong("9 or 12 numbers")),
        GUARDBIT_WORDS => {
            let word = |(n, number): (usize, &i64)| {
                u32::try_from(*number).map_err(|_| {
                    let text = format!("numbers[{n}] = {number}: a word is 0 to 4294967295");
                    Failure::new(GUARDBIT_ARGUMENT, text)
                })
            };
            let words = numbers.iter().enumerate().map(word).collect::<Result<_, _>>()?;
            return Ok(Given::Words(words));
        }
        _ => {
            let text = format!("kind = {kind}: kinds are 0 to {GUARDBIT_WORDS}");
            return Err(Failure::new(GUARDBIT_ARGUMENT, text));
        }
    }))
}
