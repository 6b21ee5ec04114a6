//! The pixels that are looked at. Spec clause `RE-5`.

use super::order::Bounds;
use super::part::{BoxEnds, EdgeBox};
use super::wire::LimitWires;
use crate::format::Gather;

/// The low bits of a pixel number; copies of the highest one above them if it is `signed`.
const fn low_bits(value: i64, bits: u32, signed: bool) -> i64 {
    let above = 64 - bits;
    let cut = value << above;
    if signed { cut >> above } else { (cut.cast_unsigned() >> above).cast_signed() }
}

impl LimitWires {
    /// First and last pixel that there may be, of both axes; `None` without a limit.
    fn ends(&self, words: &[u32]) -> Option<[[i64; 2]; 2]> {
        let read = |gather: &Gather| gather.unsigned(words).cast_signed();
        match self {
            Self::None => None,
            Self::Size(size) => Some(size.map(|size| [0, i64::from(size) - 1])),
            Self::Size2 { size, exponents: false } => {
                Some(size.each_ref().map(|size| [0, read(size) - 1]))
            }
            Self::Size2 { size, exponents: true } => {
                // Beyond every pixel number it limits nothing.
                Some(size.each_ref().map(|size| [0, (1i64 << read(size).clamp(0, 40)) - 1]))
            }
            Self::Rectangle(ends, kind) => {
                let [left, top, right, bottom] = ends.each_ref().map(read);
                let past = i64::from(*kind == BoxEnds::HalfOpen);
                Some([[left, right - past], [top, bottom - past]])
            }
        }
    }

    /// The pixels that are looked at; `vertices` are in sub-pixels.
    pub(super) fn bounds(
        &self,
        words: &[u32],
        r#box: EdgeBox,
        (vertices, sub_pixel, signed): (Option<[[i64; 2]; 3]>, u32, bool),
    ) -> Bounds {
        let limit = self.ends(words);
        let axis = |axis: usize| {
            let (EdgeBox::Vertices { bits, hold_both, try_first, .. }, Some(vertices)) =
                (r#box, vertices)
            else {
                let [low, high] = limit.map_or([0, -1], |limit| limit[axis]);
                return [low, high + 1];
            };
            let pixels = vertices.map(|at| at[axis] >> sub_pixel);
            let ends = [
                pixels.into_iter().fold(i64::MAX, i64::min),
                pixels.into_iter().fold(i64::MIN, i64::max),
            ];
            let mut ends = bits.map_or(ends, |bits| ends.map(|end| low_bits(end, bits, signed)));
            if let Some([least, most]) = limit.map(|limit| limit[axis]) {
                ends = if hold_both {
                    ends.map(|end| end.min(most).max(least))
                } else {
                    [ends[0].max(least), ends[1].min(most)]
                };
            }
            let [low, high] = ends;
            [low, if try_first { high.max(low) } else { high } + 1]
        };
        let [[x0, x1], [y0, y1]] = [axis(0), axis(1)];
        [x0, y0, x1, y1]
    }
}
