//! Random registers of the engine `slopes`.

use super::Registers;
use crate::vector::reference::stimulus::rich::Cases;

/// Sides and channels, and a clip rectangle that no large shape fills.
pub(in crate::vector::reference) struct Slopes<'a> {
    /// Fraction bits of x.
    pub(in crate::vector::reference) fraction: u32,
    /// Added to x for its pixel.
    pub(in crate::vector::reference) bias: i128,
    /// Of given edges: 1 where rows go down, -1 where they go up. `None`: vertices.
    pub(in crate::vector::reference) down: Option<i128>,
    /// The register of the direction, and what it holds for rows to the left.
    pub(in crate::vector::reference) direction: (&'static str, bool),
    pub(in crate::vector::reference) channels: Vec<&'a str>,
}

impl Slopes<'_> {
    /// Sides that start at a pixel: near it in kind 0, anywhere in kind 3, at the end of x in kind 7, and in the
    /// others at three vertices. Whether the rows run to the left.
    fn given(
        &self,
        given: &mut Cases<'_>,
        (kind, down): (u64, i128),
        (xy, [x, y]): ([[i128; 2]; 3], [i128; 2]),
        put: &mut dyn FnMut(&str, i128),
    ) -> bool {
        let (s, one) = (given.profile().vertex.sub_pixel, 1i128 << self.fraction);
        let mut starts = [0; 3];
        for (start, [at, _]) in starts.iter_mut().zip(xy) {
            let part = given.random().below(one);
            *start = match kind {
                0 => (x - 8) * one + given.random().below(16 * one),
                2 => ((at << self.fraction) >> s) + given.random().below(3) - 1,
                7 => (1 << 31) - 1 - given.random().below(8 * one),
                _ => ((at << self.fraction) >> s) + part,
            };
        }
        let (mut steps, mut rows) = ([0; 3], [0; 2]);
        for step in &mut steps {
            *step = match kind {
                0 => (given.random().below(one) - (one >> 1)) >> 6,
                2 => (given.random().below(9) - 4) * (one >> 1),
                _ => given.random().below(4 * one) - 2 * one,
            };
        }
        for count in &mut rows {
            *count = given.random().below(if kind == 0 { 2048 } else { 8 });
        }
        let top = if matches!(kind, 0 | 3 | 7) {
            y - down * given.random().below(if kind == 0 { 4096 } else { 8 })
        } else {
            xy[0][1] >> s
        };
        put("y", top);
        for (name, count) in ["rows01", "rows12"].into_iter().zip(rows) {
            put(name, count);
        }
        if kind != 3 {
            for ((name, start), step) in ["x", "end01", "end12"].into_iter().zip(starts).zip(steps)
            {
                put(name, start);
                put(&format!("{name}_step"), step);
            }
        }
        starts[0] > starts[1]
    }
}

impl Registers for Slopes<'_> {
    fn put(&self, given: &mut Cases<'_>, kind: u64, put: &mut dyn FnMut(&str, i128)) {
        let is_large = matches!(kind, 0 | 3 | 7);
        let mut triangle = given.triangle(kind);
        let s = given.profile().vertex.sub_pixel;
        if kind == 3 {
            // In the window.
            let size = given.size();
            triangle.xy =
                triangle.xy.map(|xy| [0, 1].map(|axis| xy[axis].rem_euclid(size[axis] << s)));
        }
        if kind == 2 && self.down.is_none() {
            // Sides that cross from pixel to pixel at the centre of a row.
            let by = (1 << s) - (self.bias >> (self.fraction - s));
            triangle.xy = triangle.xy.map(|[x, y]| [x + by, y]);
        }
        if kind == 6 {
            // A flat side.
            let [x, y] = triangle.xy[1];
            triangle.xy[2] = [x + given.random().below(16 << s) - (8 << s), y];
        }
        if matches!(kind, 4 | 5) && given.random().below(2) == 0 {
            // Around pixel (0, 0).
            let first = triangle.xy[0];
            triangle.xy = triangle.xy.map(|xy| [0, 1].map(|axis| xy[axis] - first[axis]));
        }
        if given.random().below(8) != 0 {
            triangle.xy.sort_by_key(|at| at[1]);
        }
        let [a, b, c] = triangle.xy;
        let mut pixel = given.pixel(2, &triangle).map(i128::from);
        let mut leftward = (b[0] - a[0]) * (c[1] - a[1]) < (c[0] - a[0]) * (b[1] - a[1]);
        if let Some(down) = self.down {
            if kind == 7 {
                let last = (1i128 << (31 - self.fraction)) - 1;
                pixel[0] = (last - given.random().below(8)).clamp(0, given.size()[0] - 1);
            }
            leftward = self.given(given, (kind, down), (triangle.xy, pixel), put);
        } else {
            for (n, [x, y]) in [("a", a), ("b", b), ("c", c)] {
                put(&format!("x{n}"), x);
                put(&format!("y{n}"), y);
            }
        }
        let leftward = leftward != (given.random().below(8) == 0);
        put(self.direction.0, i128::from(leftward == self.direction.1));
        if kind & 1 == 1 {
            for channel in &self.channels {
                // One bit alone, which no slope changes, or anything.
                let alone = matches!(kind, 1 | 5) && given.random().below(2) == 0;
                let start = if alone { 1 << given.random().below(24) } else { given.scaled() };
                put(channel, start);
                for slope in ["_dx", "_dy"] {
                    put(&format!("{channel}{slope}"), if alone { 0 } else { given.scaled() });
                }
            }
        }
        put("adjust", given.random().below(2));
        let clips = is_large || given.random().below(2) == 0;
        put("clip", clips.into());
        if clips {
            let [width, height] = given.size();
            let [x, y] = pixel;
            let left = (x - given.random().below(8)).clamp(0, x);
            let top = (y - given.random().below(8)).clamp(0, y);
            let right = (left + given.random().below(24)).clamp(0, width - 1);
            let bottom = (top + given.random().below(24)).clamp(0, height - 1);
            // Ends without a sign, far outside.
            let open = !is_large && given.random().below(2) == 0;
            put("clip_left", left);
            put("clip_top", top);
            put("clip_right", if open { -1 } else { right });
            put("clip_bottom", if open { -1 } else { bottom });
        }
    }
}
