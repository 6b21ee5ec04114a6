//! A device written from the spec in plain `i128`, with at most one defect. It shares no code with
//! the model, reads what a device would read, and answers what a device would answer: by hand, or as a
//! `Device` at a bench.
#![allow(dead_code, reason = "each test file takes what it needs")]

use guardbit::bits::Rounding;
use guardbit::cover::{EdgeStorage, FillRule};
use guardbit::format::Clamp;
use guardbit::profile::{Form, Profile};
use guardbit::setup::{Division, Triangle};
use guardbit::value::StartBias;
use guardbit::vector::bench::{
    Coverage, SetupTest, Single, TriangleAnswers, TriangleTest, WalkTest,
};
use guardbit::vector::device::Device;
use guardbit::vector::table::Table;

/// The signed value of the low bits of `word`.
pub(crate) fn extend(word: i128, width: u32) -> i128 {
    let low = word & ((1 << width) - 1);
    if low >> (width - 1) == 1 { low - (1 << width) } else { low }
}

/// `n / d` for positive d, rounded.
pub(crate) fn divide(n: i128, d: i128, rounding: Rounding) -> i128 {
    guardbit::exact::divide(n, d, rounding).unwrap()
}

/// Guard bits over integer bits over fraction bits, and the clamp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reader {
    pub(crate) guard: u32,
    pub(crate) integer: u32,
    pub(crate) fraction: u32,
    pub(crate) clamp: Clamp,
}

impl Reader {
    pub(crate) fn of(profile: &Profile) -> Self {
        let depth = profile.depth.unwrap();
        Self {
            guard: depth.guard,
            integer: depth.integer,
            fraction: depth.interpolation,
            clamp: depth.clamp,
        }
    }

    pub(crate) fn width(&self) -> u32 {
        self.guard + self.integer + self.fraction
    }

    fn maximum(&self) -> i128 {
        (1 << self.integer) - 1
    }

    /// Above the range, below it, or inside; from the pattern of the accumulator.
    fn zone(&self, accumulator: i128) -> i128 {
        let top = (accumulator & ((1 << self.width()) - 1)) >> self.fraction;
        match self.clamp {
            Clamp::Wrap | Clamp::Saturate => 0,
            // Lecture A: what the guard bits give beyond the range is shared out equally.
            Clamp::Guard | Clamp::Error => {
                let inside = 1 << self.integer;
                let beyond = ((1 << (self.guard + self.integer)) - inside) / 2;
                i128::from(top >= inside) - 2 * i128::from(top >= inside + beyond)
            }
            Clamp::Sign => {
                let value = extend(top, self.guard + self.integer);
                i128::from(value > self.maximum()) - i128::from(value < 0)
            }
        }
    }

    pub(crate) fn read(&self, accumulator: i128) -> i128 {
        match self.zone(accumulator) {
            0 => accumulator >> self.fraction & self.maximum(),
            1 => self.maximum(),
            _ => 0,
        }
    }

    /// What a register holds after it was to take this value.
    fn held(&self, value: i128) -> i128 {
        if self.clamp == Clamp::Saturate {
            value.clamp(0, (1 << (self.integer + self.fraction)) - 1)
        } else {
            value
        }
    }
}

/// A slip in a stepper's control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slip {
    None,
    Late,
    LateOut,
    Swapped,
    HoldSteps,
    Negated,
    OnlyX,
    RoundsOut,
    WrongEnd,
    Inverted,
    ZeroOutside,
}

/// A stepper as a device builds it: `width` bits of state, words of `port` bits coming in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stepper {
    pub(crate) port: u32,
    pub(crate) width: u32,
    /// `None` for an edge stepper.
    pub(crate) reader: Option<Reader>,
    pub(crate) slip: Slip,
}

impl Stepper {
    pub(crate) fn depth(reader: Reader) -> Self {
        let width = reader.width();
        Self { port: width, width, reader: Some(reader), slip: Slip::None }
    }

    pub(crate) fn edge(width: u32) -> Self {
        Self { port: width, width, reader: None, slip: Slip::None }
    }

    fn out(&self, state: i128) -> i128 {
        let Some(reader) = self.reader else {
            let inside = extend(state, self.width) >= 0;
            return i128::from(match self.slip {
                Slip::Inverted => !inside,
                Slip::ZeroOutside => inside && extend(state, self.width) != 0,
                _ => inside,
            });
        };
        match self.slip {
            Slip::RoundsOut => reader.read(state + (1 << reader.fraction >> 1)),
            Slip::WrongEnd if reader.zone(state) != 0 => reader.maximum() - reader.read(state),
            _ => reader.read(state),
        }
    }

    /// Rows of one walk after a reset: op, state and output as patterns.
    pub(crate) fn walk(&self, cfg: &[u128], ops: &[u128]) -> Vec<[u128; 3]> {
        self.walk_on(&mut self.reset(), cfg, ops)
    }

    /// State and output after a reset.
    pub(crate) fn reset(&self) -> [i128; 2] {
        [0, self.out(0)]
    }

    /// Rows of a walk; what the device shows before it is loaded is what the last walk left.
    pub(crate) fn walk_on(
        &self,
        before: &mut [i128; 2],
        cfg: &[u128],
        ops: &[u128],
    ) -> Vec<[u128; 3]> {
        let [init, dx, dy] = [0, 1, 2].map(|n| extend(cfg[n].cast_signed(), self.port));
        let (dx, dy) = match self.slip {
            Slip::Swapped => (dy, dx),
            Slip::Negated => (-dx, -dy),
            Slip::OnlyX => (dx, dx),
            _ => (dx, dy),
        };
        let held = |value| self.reader.map_or(value, |reader| reader.held(value));
        let unsigned = self.reader.is_some_and(|r| r.clamp == Clamp::Saturate && r.guard == 0);
        let start = if unsigned { init & ((1 << self.port) - 1) } else { init };
        let (mut state, mut rows) = (0, Vec::new());
        for op in ops {
            state = match op {
                0 => held(start),
                1 => held(state + dx),
                2 => held(state + dy),
                _ if self.slip == Slip::HoldSteps => held(state + dx),
                _ => state,
            };
            let word = state & ((1 << self.width) - 1) & ((1 << self.port) - 1);
            let now = [word, self.out(state)];
            let [word, out] = match self.slip {
                Slip::Late => *before,
                Slip::LateOut => [now[0], before[1]],
                _ => now,
            };
            *before = now;
            rows.push([*op, word.cast_unsigned(), out.cast_unsigned()]);
        }
        rows
    }
}

/// Rows of an exp file, walk by walk: each begins with its load.
pub(crate) fn walks(exp: &[Vec<u128>]) -> Vec<&[Vec<u128>]> {
    let starts: Vec<usize> = (0..exp.len()).filter(|n| exp[*n][0] == 0).collect();
    let ends = starts.iter().skip(1).copied().chain([exp.len()]);
    starts.iter().zip(ends).map(|(start, end)| &exp[*start..end]).collect()
}

/// Everything a device of edge functions and a depth plane decides.
#[allow(clippy::struct_excessive_bools, reason = "each is one wire that may be wrong")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawer {
    pub(crate) shadow: bool,
    pub(crate) shifted: bool,
    pub(crate) width: u32,
    pub(crate) sample: [i128; 2],
    pub(crate) sub_pixel: u32,
    pub(crate) window: [i128; 2],
    pub(crate) rounding: Rounding,
    pub(crate) reciprocal: Option<u32>,
    pub(crate) half: bool,
    pub(crate) reader: Reader,
    pub(crate) turns_round: bool,
    pub(crate) right_included: bool,
    pub(crate) left_excluded: bool,
    pub(crate) rows_late: bool,
}

/// What one triangle gave.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Drawn {
    /// Set-up words, zeros for a triangle without area.
    pub(crate) setup: Vec<i128>,
    pub(crate) zero_area: bool,
    /// y, x0, x1.
    pub(crate) spans: Vec<[i128; 3]>,
    /// x, y, depth.
    pub(crate) depths: Vec<[i128; 3]>,
}

impl Drawer {
    pub(crate) fn of(profile: &Profile) -> Self {
        let Form::EdgeFunction(edges) = profile.form else { panic!("a machine of edge functions") };
        let depth = profile.depth.unwrap();
        let sub_pixel = profile.vertex.sub_pixel;
        Self {
            shadow: edges.rule == FillRule::Shadow,
            shifted: edges.storage == EdgeStorage::Shifted,
            width: edges.width,
            sample: profile
                .sample
                .map_or([1 << (sub_pixel - 1); 2], |s| [s.x, s.y].map(Into::into)),
            sub_pixel,
            window: [profile.window.width, profile.window.height].map(Into::into),
            rounding: depth.rounding,
            reciprocal: match depth.division {
                Division::Quotient => None,
                Division::Reciprocal { bits } => Some(bits),
            },
            half: depth.start_bias == StartBias::Half,
            reader: Reader::of(profile),
            turns_round: true,
            right_included: false,
            left_excluded: false,
            rows_late: false,
        }
    }

    pub(crate) fn draw(&self, triangle: &Triangle) -> Drawn {
        let mut drawn = self.set_up(triangle);
        if drawn.setup.iter().any(|word| *word != 0) {
            self.fill(triangle.xy, &mut drawn);
        }
        drawn
    }

    /// Set-up words only.
    pub(crate) fn set_up(&self, triangle: &Triangle) -> Drawn {
        let mut v = triangle.xy;
        let mut z = triangle.z.unwrap_or_default();
        let cross = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        };
        let mut area = cross(v[0], v[1], v[2]);
        if area == 0 {
            return Drawn { setup: vec![0; 12], zero_area: true, ..Drawn::default() };
        }
        if area < 0 {
            area = -area;
            if self.turns_round {
                v.swap(1, 2);
                z.swap(1, 2);
            }
        }
        let mut words = Vec::new();
        for k in 0..3 {
            let (p, q) = (v[k], v[(k + 1) % 3]);
            let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
            let owns = (dy == 0 && dx > 0) || if self.shadow { dy > 0 } else { dy < 0 };
            let first = cross(p, q, self.sample) - i128::from(!owns);
            if self.shifted {
                words.extend([first >> self.sub_pixel, -dy, dx]);
            } else {
                words.extend([first, -dy << self.sub_pixel, dx << self.sub_pixel]);
            }
        }
        if triangle.z.is_some() {
            words.extend(self.plane(v, z, area));
        } else {
            words.extend([0; 3]);
        }
        Drawn { setup: words, ..Drawn::default() }
    }

    /// Start and slopes of the plane, unreduced.
    fn plane(&self, v: [[i128; 2]; 3], z: [i128; 3], area: i128) -> [i128; 3] {
        let (f, s) = (self.reader.fraction, self.sub_pixel);
        // Cramer's rule over the sides from v0.
        let ([ax, ay], [bx, by]) =
            ([v[1][0] - v[0][0], v[1][1] - v[0][1]], [v[2][0] - v[0][0], v[2][1] - v[0][1]]);
        let (za, zb) = (z[1] - z[0], z[2] - z[0]);
        let sign = if ax * by - bx * ay < 0 { -1 } else { 1 };
        let right = sign * (za * by - zb * ay);
        let down = sign * (zb * ax - za * bx);
        let offset = right * (self.sample[0] - v[0][0]) + down * (self.sample[1] - v[0][1]);
        let quotient = |n: i128, shift: u32| match self.reciprocal {
            None => divide(n << shift, area, self.rounding),
            Some(bits) => {
                let mut scale = 0;
                let mut mantissa = 0;
                // The largest scale at which the rounded reciprocal still has `bits` bits.
                while mantissa < 1 << bits {
                    scale += 1;
                    mantissa = divide(1 << scale, area, Rounding::NearestEven);
                }
                let mantissa = divide(1 << (scale - 1), area, Rounding::NearestEven);
                divide((n * mantissa) << shift, 1 << (scale - 1), self.rounding)
            }
        };
        let start = match self.reciprocal {
            None => quotient(z[0] * area + offset, f),
            Some(_) => (z[0] << f) + quotient(offset, f),
        };
        let half = if self.half { 1 << f >> 1 } else { 0 };
        [start + half, quotient(right, s + f), quotient(down, s + f)]
    }

    /// Set-up words of their own, with the flag of no area, over a box: x0 y0 x1 y1.
    pub(crate) fn draw_words(&self, setup: &[i128], [x0, y0, x1, y1]: [u32; 4]) -> Drawn {
        let (words, flag) = setup.split_at(setup.len() - 1);
        let zero_area = flag[0] != 0;
        let mut drawn = Drawn { setup: words.to_vec(), zero_area, ..Drawn::default() };
        if !zero_area {
            self.fill_box([x0.into()..x1.into(), y0.into()..y1.into()], &mut drawn);
        }
        drawn
    }

    fn fill(&self, v: [[i128; 2]; 3], drawn: &mut Drawn) {
        // Pixels of the window whose sample lies in the bounding box.
        let pixels = |axis: usize| {
            let at = v.map(|vertex| vertex[axis]);
            let (low, high) = (at.into_iter().min().unwrap(), at.into_iter().max().unwrap());
            let pixel = 1 << self.sub_pixel;
            let first = (low - self.sample[axis] + pixel - 1).div_euclid(pixel).max(0);
            first..(high - self.sample[axis]).div_euclid(pixel).min(self.window[axis] - 1) + 1
        };
        self.fill_box([pixels(0), pixels(1)], drawn);
    }

    fn fill_box(&self, [columns, rows]: [std::ops::Range<i128>; 2], drawn: &mut Drawn) {
        let words = drawn.setup.clone();
        let at = |n: usize, x: i128, y: i128| words[n] + words[n + 1] * x + words[n + 2] * y;
        for y in rows {
            let mut run: Option<[i128; 2]> = None;
            let mut runs = Vec::new();
            for x in columns.clone() {
                let inside = [0, 3, 6].into_iter().all(|n| extend(at(n, x, y), self.width) >= 0);
                if inside {
                    run = Some([run.map_or(x, |[x0, _]| x0), x + 1]);
                } else {
                    runs.extend(run.take());
                }
            }
            runs.extend(run);
            for [x0, x1] in runs {
                let row = y + i128::from(self.rows_late);
                let (x0, x1) =
                    (x0 + i128::from(self.left_excluded), x1 + i128::from(self.right_included));
                if x0 == x1 {
                    continue;
                }
                drawn.spans.push([row, x0, x1]);
                let depths = (x0..x1).map(|x| [x, row, self.reader.read(at(9, x, y))]);
                drawn.depths.extend(depths);
            }
        }
    }
}

/// A stepper from its reset on, walk after walk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clocked {
    stepper: Stepper,
    before: [i128; 2],
}

impl Clocked {
    pub(crate) fn new(stepper: Stepper) -> Self {
        Self { stepper, before: stepper.reset() }
    }
}

impl Device<WalkTest> for Clocked {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let port = (1i128 << self.stepper.port) - 1;
        let words =
            [test.walk.init, test.walk.dx, test.walk.dy].map(|w| (w & port).cast_unsigned());
        let ops: Vec<u128> = (0..test.rows).map(|n| test.walk.op(n) as u128).collect();
        for row in self.stepper.walk_on(&mut self.before, &words, &ops) {
            rows.exp.push(&row.map(u128::cast_signed));
        }
    }
}

impl Device<SetupTest> for Drawer {
    fn answer(&mut self, test: &SetupTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let drawn = self.set_up(&test.triangle);
        rows.exp.push(&[&drawn.setup[..], &[i128::from(drawn.zero_area)]].concat());
    }
}

impl Device<TriangleTest> for Drawer {
    /// Runs and depths; it counts nothing.
    fn answer(&mut self, test: &TriangleTest, rows: &mut TriangleAnswers<Table>, _: &mut Coverage) {
        let drawn = match &test.triangle {
            Some(triangle) => self.draw(triangle),
            None => self.draw_words(&test.setup, test.bounds),
        };
        let number = i128::from(test.test);
        for [y, x0, x1] in drawn.spans {
            rows.spans.push(&[number, y, x0, x1]);
        }
        let depths = rows.depths.as_mut().expect("a set with depth");
        for [x, y, z] in drawn.depths {
            depths.push(&[number, y, x, z]);
        }
    }
}
