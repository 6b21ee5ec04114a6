//! Random registers of the engine `sub-scanlines`.

use super::Registers;
use crate::vector::reference::stimulus::rich::Cases;

/// Sides and channels, and a scissor that no large shape fills.
pub(in crate::vector::reference) struct SubScanlines<'a> {
    pub(in crate::vector::reference) channels: Vec<&'a str>,
}

impl Registers for SubScanlines<'_> {
    fn put(&self, given: &mut Cases<'_>, kind: u64, put: &mut dyn FnMut(&str, i128)) {
        let is_large = matches!(kind, 0 | 3 | 7);
        let mut triangle = given.triangle(kind);
        if matches!(kind, 4 | 5) && given.random().below(2) == 0 {
            // Around pixel (0, 0).
            let first = triangle.xy[0];
            triangle.xy = triangle.xy.map(|xy| [0, 1].map(|axis| xy[axis] - first[axis]));
        }
        triangle.xy.sort_by_key(|at| at[1]);
        let mut pixel = given.pixel(2, &triangle).map(i128::from);
        if kind == 7 {
            pixel[0] = given.size()[0] - 1 - given.random().below(16);
        }
        let [x, y] = pixel;
        let (mut starts, mut steps) = ([0; 3], [0; 3]);
        for ((start, step), [at, _]) in starts.iter_mut().zip(&mut steps).zip(triangle.xy) {
            let part = given.random().below(1 << 19);
            *start = match kind {
                0 => ((x - 4) << 16) + part,
                2 => at << 14,
                7 => (given.random().below(4) << 26) + part - (1 << 18),
                _ => (at << 14) + (part >> 4),
            };
            *step = match kind {
                2 => (given.random().below(9) - 4) * (1 << 15) + (part & 7),
                _ => given.random().below(1 << 19) - (1 << 18),
            };
        }
        let mut rows = triangle.xy.map(|at| at[1]);
        if is_large {
            rows[0] = 4 * y - given.random().below(64);
            rows[1] = rows[0] + given.random().below(64);
            rows[2] = rows[1] + given.random().below(64);
        }
        for (name, at) in ["yh", "ym", "yl"].into_iter().zip(rows) {
            put(name, at);
        }
        if kind != 3 {
            for ((name, start), step) in ["xh", "xm", "xl"].into_iter().zip(starts).zip(steps) {
                put(name, start);
                put(&format!("{name}_step"), step);
            }
        }
        let rightward = (starts[1] > starts[0]) != (given.random().below(8) == 0);
        put("rightward", rightward.into());
        if kind & 1 == 1 {
            for channel in &self.channels {
                // One bit alone, which no slope changes, or anything.
                let alone = matches!(kind, 1 | 5) && given.random().below(2) == 0;
                let start = if alone { 1 << given.random().below(32) } else { given.scaled() };
                // The lowest slope: its negative is itself.
                let lowest = matches!(kind, 3 | 7) && given.random().below(8) == 0;
                put(channel, start);
                for slope in ["_dx", "_de", "_dy"] {
                    put(&format!("{channel}{slope}"), if alone { 0 } else { given.scaled() });
                }
                if lowest {
                    put(&format!("{channel}_dx"), 1 << 31);
                }
            }
        }
        let mut ends = [0, 0, 4095, 4095];
        if is_large || given.random().below(2) == 0 {
            ends[0] = (4 * x - given.random().below(32)).clamp(0, 4095);
            ends[1] = (4 * y - given.random().below(32)).clamp(0, 4095);
            ends[2] = (ends[0] + given.random().below(96)).clamp(0, 4095);
            ends[3] = (ends[1] + given.random().below(96)).clamp(0, 4095);
        }
        for (name, end) in ["xh", "yh", "xl", "yl"].into_iter().zip(ends) {
            put(&format!("scissor_{name}"), end);
        }
    }
}
