//! The clauses of chapter 28 on plain numbers: every word by its formula, every pixel on its own.

use crate::rasterizers::wrap;
use guardbit::case::Words;
use std::fmt::Write as _;

#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    Given { at: &'static str },
    Vertices { sense: &'static str, product_cut: u32, cut: u32 },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Limit {
    None,
    Size([i128; 2]),
    Registers,
    Exponents,
    Rectangle(&'static str),
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Given(&'static str),
    Vertices { bits: Option<u32>, limit: Limit, hold_both: bool, try_first: bool },
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Divide {
    Quotient(&'static str),
    Reciprocal { numerator: u32, drop: u32, zero: i128 },
    Table { index: u32, between: u32, seed: u32 },
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Values {
    Given { at: &'static str },
    Planes { divide: Divide, at_vertex: bool, extra: u32, width: u32, product: u32, half: bool },
    Weights { divide: Divide, fraction: u32, product_cut: u32, product: u32 },
}

/// A machine by its parts, with channels c and d.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    pub(super) sub: u32,
    pub(super) sample: [u32; 2],
    pub(super) width: u32,
    pub(super) winding: &'static str,
    pub(super) rule: &'static str,
    pub(super) skip: bool,
    pub(super) source: Source,
    pub(super) shape: Shape,
    pub(super) order: &'static str,
    pub(super) values: Values,
    pub(super) zero_extended: bool,
    pub(super) slope_width: bool,
}

/// Interpolation bits of both channels, and the places their registers move.
const F: u32 = 4;
const SHIFT: u32 = 2;
/// Bits of their accumulators and slopes.
const HELD: u32 = 12;
const SLOPE: u32 = 6;

/// A triangle as it is set up.
#[derive(Clone, Copy)]
struct Corners {
    xy: [[i128; 2]; 3],
    from: [usize; 3],
    area: i128,
}

fn divide_text(divide: Divide) -> String {
    match divide {
        Divide::Quotient(rounding) => format!("{{ quotient = \"{rounding}\" }}"),
        Divide::Reciprocal { numerator, drop, zero } => {
            format!(
                "{{ reciprocal = {{ numerator = {numerator}, drop = {drop}, zero = {zero} }} }}"
            )
        }
        Divide::Table { index, between, seed } => {
            format!("{{ table = {{ index = {index}, between = {between}, seed = {seed} }} }}")
        }
    }
}

/// A number moved by so many places, to the left or to the right.
fn moved(value: i128, left: i128) -> i128 {
    let places = u32::try_from(left.unsigned_abs()).unwrap();
    if left >= 0 { value << places } else { value >> places.min(127) }
}

fn quotient(n: i128, d: i128, rounding: &str) -> i128 {
    if d == 0 {
        return 0;
    }
    let (n, d) = (n * d.signum(), d.abs());
    let (floor, rest) = (n.div_euclid(d), n.rem_euclid(d));
    let up = match rounding {
        "floor" => false,
        "ceiling" => rest > 0,
        "toward-zero" => n < 0 && rest > 0,
        "nearest-even" => 2 * rest > d || 2 * rest == d && floor % 2 != 0,
        other => panic!("{other}"),
    };
    floor + i128::from(up)
}

/// A reciprocal and its places, of an area that is not negative.
fn reciprocal(divide: Divide, area: i128) -> (i128, i128) {
    match divide {
        Divide::Quotient(_) => panic!("no reciprocal"),
        Divide::Reciprocal { numerator, drop, zero } => {
            let divisor = area >> drop;
            let factor = if divisor == 0 { zero } else { (1 << numerator) / divisor };
            (factor, i128::from(numerator + drop))
        }
        Divide::Table { index, between, seed } => {
            if area == 0 {
                return (0, 0);
            }
            let leading = 127 - area.leading_zeros();
            // The bits below the leading one, as many as the table looks at.
            let below = area - (1 << leading);
            let wanted = index + between;
            let seen = if leading >= wanted {
                below >> (leading - wanted)
            } else {
                below << (wanted - leading)
            };
            let (i, f) = (seen >> between, seen % (1 << between));
            let entry = |i: i128| {
                let (n, d) = (1i128 << (seed + index), (1 << index) + i);
                (2 * n + d) / (2 * d)
            };
            let last = i == (1 << index) - 1;
            let delta = if last { 0 } else { entry(i) - entry(i + 1) };
            (entry(i) - ((delta * f) >> between), i128::from(seed + leading))
        }
    }
}

impl Parts {
    /// What is under `[form.registers]`.
    pub(super) fn toml(&self) -> String {
        let names = self.names();
        let list: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        let (start, slope) = (
            if self.zero_extended { "zero" } else { "sign" },
            if self.slope_width { format!(", slope-width = {SLOPE}") } else { String::new() },
        );
        let shape = match self.shape {
            Shape::Given(ends) => format!("{{ given = \"{ends}\" }}"),
            Shape::Vertices { bits, limit, hold_both, try_first } => {
                let mut text = format!("hold-both = {hold_both}, try-first = {try_first}");
                if let Some(bits) = bits {
                    write!(text, ", bits = {bits}").unwrap();
                }
                let limit = match limit {
                    Limit::None => String::new(),
                    Limit::Size([w, h]) => format!(", limit = {{ size = [{w}, {h}] }}"),
                    Limit::Registers => ", limit = \"size-registers\"".to_owned(),
                    Limit::Exponents => ", limit = \"exponent-registers\"".to_owned(),
                    Limit::Rectangle(ends) => format!(", limit = {{ rectangle = \"{ends}\" }}"),
                };
                format!("{{ vertices = {{ {text}{limit} }} }}")
            }
        };
        let edges = match self.source {
            Source::Given { at } => format!("{{ given = {{ at = \"{at}\" }} }}"),
            Source::Vertices { sense, product_cut, cut } => format!(
                "{{ vertices = {{ sense = \"{sense}\", product-cut = {product_cut}, cut = {cut} }} }}"
            ),
        };
        let values = match self.values {
            Values::Given { at } => format!("{{ given = {{ at = \"{at}\" }} }}"),
            Values::Planes { divide, at_vertex, extra, width, product, half } => format!(
                "{{ planes = {{ divide = {}, start = \"{}\", fraction = {}, width = {width}, \
                 product = {product}, half = {half} }} }}",
                divide_text(divide),
                if at_vertex { "vertex" } else { "box" },
                F + extra
            ),
            Values::Weights { divide, fraction, product_cut, product } => format!(
                "{{ weights = {{ divide = {}, fraction = {fraction}, product-cut = {product_cut}, \
                 product = {product} }} }}",
                divide_text(divide)
            ),
        };
        let skip = if self.skip { "skip" } else { "draw" };
        format!(
            "radix = 16
input = [{}]
records = [{{ letter = \"P\", words = [\"x\", \"y\", \"e0\", \"e1\", \"e2\", \"c\", \"d\"] }}]
channels = [
    {{ names = [\"c\"], guard = 2, integer = 5, interpolation = {F}, clamp = \"sign\", width = {HELD}, \
             start = \"{start}\", shift = {SHIFT}{slope} }},
    {{ names = [\"d\"], guard = 0, integer = 8, interpolation = {F}, clamp = \"wrap\", width = {HELD}, \
             start = \"{start}\", shift = {SHIFT}, scale = 3, replicate = 12{slope} }},
]
[form.registers.engine.edge-functions]
width = {}
winding = \"{}\"
rule = \"{}\"
without-area = \"{skip}\"
edges = {edges}
box = {shape}
order = {}
values = {values}
",
            list.join(", "),
            self.width,
            self.winding,
            self.rule,
            self.order
        )
    }

    /// The registers of edges, of the box, and of channels.
    fn parts(&self) -> [&'static [&'static str]; 3] {
        let edges: &[&str] = match self.source {
            Source::Given { .. } => {
                &["e0", "e0_dx", "e0_dy", "e1", "e1_dx", "e1_dy", "e2", "e2_dx", "e2_dy"]
            }
            Source::Vertices { .. } => &["x0:8", "y0:8", "x1:8", "y1:8", "x2:8", "y2:8"],
        };
        let limit: &[&str] = match self.shape {
            Shape::Given(_) | Shape::Vertices { limit: Limit::Rectangle(_), .. } => {
                &["left:4", "top:4", "right:4", "bottom:4"]
            }
            Shape::Vertices { limit: Limit::Registers, .. } => &["width:3", "height:3"],
            Shape::Vertices { limit: Limit::Exponents, .. } => &["width_log2:2", "height_log2:2"],
            Shape::Vertices { .. } => &[],
        };
        let values: &[&str] = match self.values {
            Values::Given { .. } => &["c:8", "c_dx:8", "c_dy:8", "d:8", "d_dx:8", "d_dy:8"],
            _ => &["c0:8", "c1:8", "c2:8", "d0:8", "d1:8", "d2:8"],
        };
        [edges, limit, values]
    }

    fn names(&self) -> Vec<&'static str> {
        self.parts().concat()
    }

    /// Values of all registers, small enough that something is drawn.
    pub(super) fn registers(&self, words: &mut Words) -> Vec<i128> {
        let [edges, limit, values] = self.parts().map(<[_]>::len);
        let given = matches!(self.source, Source::Given { .. });
        let most = 6 << self.sub;
        let mut list: Vec<i128> = (0..edges)
            .map(|n| match (given, n % 3) {
                (false, _) => words.between(-2 << self.sub, most),
                (true, 0) => words.between(-4, 30),
                (true, _) => words.between(-9, 9),
            })
            .collect();
        if !given && words.below(6) == 0 {
            // Without area.
            let first = [list[0], list[1]];
            list[2..4].copy_from_slice(&first);
        }
        list.extend(
            (0..limit).map(|n| if n < 2 { words.between(0, 3) } else { words.between(2, 7) }),
        );
        list.extend((0..values).map(|_| words.between(0, 255)));
        list
    }

    fn at(&self, x: i128, y: i128) -> [i128; 2] {
        [(x << self.sub) + i128::from(self.sample[0]), (y << self.sub) + i128::from(self.sample[1])]
    }

    /// Clause `RE-1`.
    fn edge(&self, p: [i128; 2], q: [i128; 2], at: [i128; 2]) -> i128 {
        let Source::Vertices { sense, product_cut, cut } = self.source else { panic!("given") };
        let sign = if sense == "positive" { 1 } else { -1 };
        let down = ((q[0] - p[0]) * (at[1] - p[1])) >> product_cut;
        let right = ((q[1] - p[1]) * (at[0] - p[0])) >> product_cut;
        wrap((sign * (down - right)) >> cut, self.width)
    }

    /// Records in the engine's order.
    pub(super) fn draw(&self, list: &[i128]) -> Vec<Vec<i64>> {
        let [edges, limit, _] = self.parts().map(<[_]>::len);
        let (limits, values) = (&list[edges..edges + limit], &list[edges + limit..]);
        let corners = match self.source {
            Source::Given { .. } => None,
            Source::Vertices { .. } => {
                let v = [0, 1, 2].map(|n| [wrap(list[2 * n], 8), wrap(list[2 * n + 1], 8)]);
                let of = |from: [usize; 3]| {
                    let xy = from.map(|n| v[n]);
                    Corners { xy, from, area: self.edge(xy[0], xy[1], xy[2]) }
                };
                let corners = of([0, 1, 2]);
                if corners.area == 0 && self.skip {
                    return Vec::new();
                }
                let swaps = self.winding == "swap" && corners.area < 0;
                Some(if swaps { of([0, 2, 1]) } else { corners })
            }
        };
        let [x0, y0, x1, y1] = self.bounds(corners, limits);
        let words = |x: i128, y: i128| -> [i128; 3] {
            [0, 1, 2].map(|k| match self.source {
                Source::Given { at } => {
                    let [ox, oy] = if at == "box" { [x0, y0] } else { [0, 0] };
                    let value =
                        list[3 * k] + list[3 * k + 1] * (x - ox) + list[3 * k + 2] * (y - oy);
                    wrap(value, self.width)
                }
                Source::Vertices { .. } => {
                    let it = corners.unwrap();
                    let word = self.edge(it.xy[(k + 1) % 3], it.xy[(k + 2) % 3], self.at(x, y));
                    let negates = self.winding == "negate" && it.area < 0;
                    if negates { wrap(-word, self.width) } else { word }
                }
            })
        };
        let inside = |x: i128, y: i128| {
            let below = corners.is_some_and(|it| it.area < 0);
            let passes = |turned: bool| {
                (0..3).all(|k| self.passes(k, words(x, y)[k], turned, corners, list))
            };
            passes(self.winding == "both" && below) || self.winding == "either" && passes(true)
        };
        let fails = |k: usize, x: i128, y: i128| {
            let turned = self.winding == "both" && corners.is_some_and(|it| it.area < 0);
            let fails = |turned| !self.passes(k, words(x, y)[k], turned, corners, list);
            (fails(turned), fails(!turned))
        };
        let mut found = Vec::new();
        for [x, y] in self.visits([x0, y0, x1, y1], &inside, &fails) {
            let e = words(x, y);
            let mut record = vec![x, y, e[0], e[1], e[2]];
            for (n, scale) in [(0, 1), (3, 3)] {
                let held = self.value(&values[n..n + 3], corners, [x, y], [x0, y0], e);
                let held = wrap(held, HELD) * scale;
                record.push(if n == 0 {
                    // Two guard bits, five integer bits, four below: read by their sign.
                    wrap(held, 11).clamp(0, (1 << 9) - 1) >> F
                } else {
                    let code = held.rem_euclid(1 << 12) >> F;
                    code << 4 | code >> 4
                });
            }
            found.push(record.into_iter().map(|value| i64::try_from(value).unwrap()).collect());
        }
        found
    }

    /// Clause `RE-5`, half-open.
    fn bounds(&self, corners: Option<Corners>, list: &[i128]) -> [i128; 4] {
        let rectangle = |ends: &str| {
            let past = i128::from(ends == "half-open");
            [[list[0], list[2] - past], [list[1], list[3] - past]]
        };
        let ends = match self.shape {
            Shape::Given(ends) => rectangle(ends),
            Shape::Vertices { bits, limit, hold_both, try_first } => {
                let limit = match limit {
                    Limit::None => None,
                    Limit::Size(size) => Some(size.map(|size| [0, size - 1])),
                    Limit::Registers => Some([[0, list[0] - 1], [0, list[1] - 1]]),
                    Limit::Exponents => Some([[0, (1 << list[0]) - 1], [0, (1 << list[1]) - 1]]),
                    Limit::Rectangle(ends) => Some(rectangle(ends)),
                };
                let v = corners.unwrap().xy;
                [0, 1].map(|axis| {
                    let all = v.map(|at| at[axis]);
                    let ends = [*all.iter().min().unwrap(), *all.iter().max().unwrap()];
                    let [mut low, mut high] = ends.map(|end| end >> self.sub);
                    if let Some(bits) = bits {
                        (low, high) = (wrap(low, bits), wrap(high, bits));
                    }
                    if let Some([least, most]) = limit.map(|limit| limit[axis]) {
                        let hold = |end: i128| end.min(most).max(least);
                        (low, high) = if hold_both {
                            (hold(low), hold(high))
                        } else {
                            (low.max(least), high.min(most))
                        };
                    }
                    [low, if try_first && high < low { low } else { high }]
                })
            }
        };
        [ends[0][0], ends[1][0], ends[0][1] + 1, ends[1][1] + 1]
    }

    /// Clauses `RE-3` and `RE-4`.
    fn passes(
        &self,
        k: usize,
        e: i128,
        turned: bool,
        corners: Option<Corners>,
        list: &[i128],
    ) -> bool {
        let negated = self.winding == "negate" && corners.is_some_and(|it| it.area < 0);
        let turn = if turned { -1 } else { 1 } * if negated { -1 } else { 1 };
        let [a, b] = match (self.source, corners) {
            (Source::Vertices { sense, .. }, Some(Corners { xy, .. })) => {
                let (p, q) = (xy[(k + 1) % 3], xy[(k + 2) % 3]);
                let sign = if sense == "positive" { 1 } else { -1 };
                [sign * (p[1] - q[1]), sign * (q[0] - p[0])]
            }
            _ => [wrap(list[3 * k + 1], self.width), wrap(list[3 * k + 2], self.width)],
        };
        let (a, b) = (a * turn, b * turn);
        let owns = match self.rule {
            "both" => true,
            "strict" => return if turned { e < 0 } else { e > 0 },
            "top-left" => a > 0 || a == 0 && b > 0,
            "top-right" => a < 0 || a == 0 && b > 0,
            "bottom-left" => a > 0 || a == 0 && b < 0,
            "bottom-right" => a < 0 || a == 0 && b < 0,
            "truncated-side" => {
                let xy = corners.unwrap().xy;
                let (p, q, t) = (xy[(k + 1) % 3], xy[(k + 2) % 3], xy[k]);
                let height = wrap(q[1] - p[1], self.width);
                let side = if height == 0 {
                    t[1] < p[1]
                } else {
                    let product = wrap((q[0] - p[0]) * (t[1] - p[1]), self.width);
                    t[0] < wrap(p[0] + product / height, self.width)
                };
                !side
            }
            other => panic!("{other}"),
        };
        let bias = i128::from(!owns);
        if turned { wrap(e + bias, self.width) <= 0 } else { wrap(e - bias, self.width) >= 0 }
    }

    /// Clause `RE-6`: the pixels that are drawn, in order.
    fn visits(
        &self,
        [x0, y0, x1, y1]: [i128; 4],
        inside: &dyn Fn(i128, i128) -> bool,
        fails: &dyn Fn(usize, i128, i128) -> (bool, bool),
    ) -> Vec<[i128; 2]> {
        let mut found = Vec::new();
        let (mut at, mut step) = (x0, 1);
        if let Some(size) = self.order.split("width = ").nth(1) {
            let number = |text: &str| text[..1].parse::<i128>().unwrap();
            let (w, h) = (number(size), number(self.order.split("height = ").nth(1).unwrap()));
            let tiles = |low: i128, high: i128, size: i128| -> Vec<i128> {
                let grid = (high - 1).div_euclid(size) - low.div_euclid(size) + 1;
                let (first, count) = if self.order.contains("\"box\"") {
                    (low, (high - low + size - 1).div_euclid(size))
                } else if self.order.contains("counted") {
                    (low, grid)
                } else {
                    (low.div_euclid(size) * size, grid)
                };
                (0..count).map(|n| first + n * size).collect()
            };
            for ty in tiles(y0, y1, h) {
                for tx in tiles(x0, x1, w) {
                    let corners =
                        [[tx, ty], [tx + w - 1, ty], [tx, ty + h - 1], [tx + w - 1, ty + h - 1]];
                    let all = |k: usize, turned: bool| {
                        corners.iter().all(|[x, y]| {
                            let (plain, other) = fails(k, *x, *y);
                            if turned { other } else { plain }
                        })
                    };
                    let beyond = |turned: bool| (0..3).any(|k| all(k, turned));
                    let out = beyond(false) && (self.winding != "either" || beyond(true));
                    if self.order.contains("reject") && out {
                        continue;
                    }
                    for y in ty..ty + h {
                        for x in tx..tx + w {
                            let within = (x0..x1).contains(&x) && (y0..y1).contains(&y);
                            if (within || self.order.contains("beyond")) && inside(x, y) {
                                found.push([x, y]);
                            }
                        }
                    }
                }
            }
            return found;
        }
        for y in y0..y1 {
            let mut row: Vec<i128> = (x0..x1).filter(|x| inside(*x, y)).collect();
            match self.order {
                "\"serpentine\"" if (y - y0) % 2 == 1 => row.reverse(),
                "\"zigzag\"" => {
                    if row.is_empty() {
                        (at, step) = if y == y0 {
                            (x0, -1)
                        } else if at <= x0 {
                            (x1, 1)
                        } else if at >= x1 || step < 0 {
                            (x0, -1)
                        } else {
                            (x1, 1)
                        };
                        continue;
                    }
                    if y > y0 {
                        step = -step;
                        if !row.contains(&at) && row.iter().all(|x| (x - at) * step < 0) {
                            step = -step;
                        }
                    }
                    if step < 0 {
                        row.reverse();
                    }
                    at = row.last().unwrap() + step;
                }
                _ => {}
            }
            found.extend(row.into_iter().map(|x| [x, y]));
        }
        found
    }

    /// Clauses `RE-7`, `RE-8` and `RE-9`: the accumulator before it is cut to its bits.
    fn value(
        &self,
        list: &[i128],
        corners: Option<Corners>,
        [x, y]: [i128; 2],
        first: [i128; 2],
        e: [i128; 3],
    ) -> i128 {
        let extended = |value: i128| if self.zero_extended { value } else { wrap(value, 8) };
        let slope = |value: i128| wrap(value, if self.slope_width { SLOPE } else { HELD });
        match (self.values, corners) {
            (Values::Given { at }, _) => {
                let [ox, oy] = if at == "box" { first } else { [0, 0] };
                let [dx, dy] = [1, 2].map(|n| slope(wrap(list[n], 8) << SHIFT));
                (extended(list[0]) << SHIFT) + dx * (x - ox) + dy * (y - oy)
            }
            (Values::Planes { divide, at_vertex, extra, width, product, half }, Some(it)) => {
                let v = it.from.map(|n| extended(list[n]));
                let (s, cuts, sign) = match self.source {
                    Source::Vertices { sense, product_cut, cut } => {
                        (self.sub, product_cut + cut, if sense == "positive" { 1 } else { -1 })
                    }
                    Source::Given { .. } => panic!("given"),
                };
                let places = SHIFT + extra;
                let left = i128::from(places + s) - i128::from(cuts);
                let p = it.xy;
                let right = |p: [i128; 2], q: [i128; 2]| sign * (p[1] - q[1]);
                let down = |p: [i128; 2], q: [i128; 2]| sign * (q[0] - p[0]);
                let (d1, d2) = (v[1] - v[0], v[2] - v[0]);
                let numbers = [
                    d1 * right(p[2], p[0]) + d2 * right(p[0], p[1]),
                    d1 * down(p[2], p[0]) + d2 * down(p[0], p[1]),
                ];
                let slopes = numbers.map(|n| {
                    let quotient = if let Divide::Quotient(rounding) = divide {
                        let (n, d) = (n << left.max(0), it.area << (-left).max(0));
                        quotient(n, d, rounding)
                    } else {
                        let one = self.winding == "one";
                        let area =
                            if one { it.area.rem_euclid(1 << self.width) } else { it.area.abs() };
                        let (m, q) = reciprocal(divide, area);
                        let held = if product == 128 { n * m } else { wrap(n * m, product) };
                        let result = moved(held, left - q);
                        if !one && it.area < 0 { -result } else { result }
                    };
                    wrap(quotient, width)
                });
                let plane = |x: i128, y: i128| {
                    let at = self.at(x, y);
                    let term = |axis: usize| (slopes[axis] * (at[axis] - p[0][axis])) >> s;
                    let half = if half { 1 << (F + extra - 1) } else { 0 };
                    wrap((v[0] << places) + half + term(0) + term(1), width) >> extra
                };
                if at_vertex {
                    return plane(x, y);
                }
                let [dx, dy] = slopes.map(|value| slope(value >> extra));
                plane(first[0], first[1]) + dx * (x - first[0]) + dy * (y - first[1])
            }
            (Values::Weights { divide, fraction, product_cut, product }, Some(it)) => {
                let one = self.winding == "one";
                let turned = it.area < 0 && ["both", "either"].contains(&self.winding);
                (0..3)
                    .map(|k| {
                        let e = if turned { -e[k] } else { e[k] };
                        let area = if one { it.area } else { it.area.abs() };
                        let weight = if let Divide::Quotient(rounding) = divide {
                            quotient(e << fraction, area, rounding)
                        } else {
                            let (m, q) = reciprocal(divide, area.rem_euclid(1 << self.width));
                            let held = ((e * m) >> product_cut).rem_euclid(1 << product);
                            moved(held, i128::from(fraction + product_cut) - q)
                        };
                        (weight * (extended(list[it.from[k]]) << SHIFT)) >> fraction
                    })
                    .sum()
            }
            _ => panic!("vertices"),
        }
    }
}
