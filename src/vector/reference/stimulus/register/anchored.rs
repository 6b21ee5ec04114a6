//! Random registers of the engine `anchored`.

use super::Registers;
use crate::value::Channel;
use crate::vector::reference::stimulus::rich::Cases;

/// Vertices, values of the channels, and a rectangle that no large triangle fills.
pub(in crate::vector::reference) struct Anchored<'a> {
    pub(in crate::vector::reference) channels: &'a [Channel],
    /// The longest edge that is drawn.
    pub(in crate::vector::reference) largest: [i128; 2],
}

impl Registers for Anchored<'_> {
    fn put(&self, given: &mut Cases<'_>, kind: u64, put: &mut dyn FnMut(&str, i128)) {
        let mut triangle = given.triangle(kind);
        if matches!(kind, 0 | 3) {
            triangle.xy = triangle.xy.map(|[x, y]| [x >> 1, y >> 2]);
        }
        if kind == 3 {
            // An edge as long as one may be, or longer by one.
            let (low, high) = given.profile().vertex.range();
            let xy = &mut triangle.xy;
            let side = if xy[0][0] < 0 { 1 } else { -1 };
            let more = given.random().below(2);
            let axis = usize::from(given.random().below(2) == 1);
            xy[1][axis] = (xy[0][axis] + side * (self.largest[axis] + more)).clamp(low, high);
            xy[2][axis] = (xy[0][axis] + xy[1][axis]) >> 1;
        }
        super::vertices(&triangle, put);
        if kind & 3 == 3 {
            for channel in self.channels {
                for n in 0..3 {
                    let end = if given.random().next() & 1 == 1 { -1 } else { 0 };
                    put(&format!("{}{n}", channel.name), end);
                }
            }
        }
        let [width, height] = given.size();
        let mut ends = [0, 0, width - 1, height - 1];
        if matches!(kind, 0 | 3 | 7) || given.random().below(2) == 0 {
            let [x, y] = given.pixel(2, &triangle).map(i128::from);
            let left = (x - given.random().below(8)).clamp(0, x);
            let top = (y - given.random().below(8)).clamp(0, y);
            let right = (left + given.random().below(24)).clamp(0, width - 1);
            let bottom = (top + given.random().below(24)).clamp(0, height - 1);
            ends = [left, top, right, bottom];
        }
        for (name, end) in ["left", "top", "right", "bottom"].into_iter().zip(ends) {
            put(name, end);
        }
    }
}
