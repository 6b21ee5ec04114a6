//! The estimate against hand-worked figures, and the operations against formulas that count
//! themselves.

use super::*;
use crate::model::{Drawing, Model};
use crate::profile::load;
use crate::setup::Division;
use std::cell::Cell;

fn profile(name: &str) -> Profile {
    load(name).unwrap()
}

/// A depth plane alone is not a profile: its unit within one.
fn depth_unit(guard: u32, integer: u32, interpolation: u32) -> (Profile, Vec<Unit>) {
    let mut profile = profile("sgi-4k");
    let depth = profile.depth.as_mut().unwrap();
    (depth.guard, depth.integer, depth.interpolation) = (guard, integer, interpolation);
    let units =
        datapath(&profile).unwrap().units.into_iter().filter(|unit| unit.name == "depth").collect();
    (profile, units)
}

#[test]
fn whole_ddas_come_out_as_measured() {
    for (budget, measured_ps) in [((2, 8, 16), 394.0), ((4, 24, 16), 434.0)] {
        let (profile, units) = depth_unit(budget.0, budget.1, budget.2);
        let estimate = area_and_clock(&profile, &units, &[], adder::prefix);
        let off = estimate.delay_ps / measured_ps - 1.0;
        assert!(off.abs() < 0.01, "{budget:?}: {} ps", estimate.delay_ps);
        let per_bit = estimate.area_um2 / f64::from(units[0].width);
        assert!((per_bit / 29.0 - 1.0).abs() < 0.04, "{budget:?}: {per_bit} um2 a bit");
        assert!((estimate.clock_mhz * estimate.delay_ps - 1e6).abs() < 1.0);
    }
}

#[test]
fn the_assumed_clamp_lies_within_what_was_measured() {
    for bits in [8.0, 24.0] {
        assert!((23.0..=111.0).contains(&(CLAMP_UM2 * bits)), "{bits}");
    }
    assert!((81.0..=141.0).contains(&CLAMP_PS));
}

#[test]
fn units_by_form() {
    let walk = estimate(&profile("sgi-4k-walk")).unwrap();
    let [edge, depth] = walk.units[..] else { panic!("{:?}", walk.units) };
    // Two x words of 35 bits with a slope each; the depth plane has four registers of 39.
    assert_eq!((edge.copies, edge.width, edge.register_bits, edge.adder_bits), (2, 35, 140, 70));
    assert_eq!(
        (depth.copies, depth.width, depth.register_bits, depth.adder_bits),
        (1, 39, 156, 39)
    );
    assert_eq!((walk.register_bits, walk.adder_bits), (296, 109));
    assert!(!edge.clamp && depth.clamp);
    let mut coverage = profile("tiny");
    coverage.depth = None;
    let cost = estimate(&coverage).unwrap();
    assert_eq!((cost.units.len(), cost.register_bits, cost.adder_bits), (1, 72, 18));
}

#[test]
fn a_bit_more_costs_more() {
    let cost = |guard, interpolation| {
        let (profile, _) = depth_unit(guard, 24, interpolation);
        estimate(&profile).unwrap()
    };
    for interpolation in 0..20 {
        let (less, more) = (cost(2, interpolation), cost(2, interpolation + 1));
        assert_eq!(more.register_bits, less.register_bits + 4);
        assert_eq!(more.setup_bits, less.setup_bits + 1, "{interpolation}");
        for [less, more] in [[less.ripple, more.ripple], [less.prefix, more.prefix]] {
            assert!(more.area_um2 > less.area_um2);
            assert!(more.delay_ps >= less.delay_ps && more.clock_mhz <= less.clock_mhz);
        }
    }
    let clamped = |clamp| {
        let mut profile = profile("sgi-4k");
        profile.depth.as_mut().unwrap().clamp = clamp;
        estimate(&profile).unwrap().prefix
    };
    assert!(clamped(Clamp::Wrap).area_um2 < clamped(Clamp::Guard).area_um2);
    assert!(clamped(Clamp::Saturate).delay_ps > clamped(Clamp::Guard).delay_ps + 80.0);
}

#[test]
fn set_up_words_by_hand() {
    // Vertices 0 to 8 on both axes, first sample at (1, 1), codes 0 to 7.
    let tiny = profile("tiny");
    let grid = tiny.grid().unwrap();
    // c = dy ax - dx ay: at most 64, from (8, 0) to (0, 8) for one; 7 bits and a sign.
    assert_eq!(datapath(&tiny).unwrap().setup_bits, 8);
    let mut depth = tiny.depth.unwrap();
    // The start's dividend is z0 E12 + z1 E20 + z2 E01 at the sample; the three E sum to A2. On a
    // triangle of area 64 with the sample inside it is at most 7 x 64 = 448; with the sample
    // outside, from (8, 8) (0, 8) (8, 0): E are 64 - 2 x 8 x 7, 56, 56 with 7, 7, 0: more is 7 x 112
    // = 784 with the first at 0. 10 bits, a sign, 3 interpolation bits.
    assert_eq!(depth_setup_bits(&depth, &tiny.vertex, &grid), 14);
    // Without the anchor's part, times a 5-bit reciprocal.
    depth.division = Division::Reciprocal { bits: 5 };
    assert_eq!(depth_setup_bits(&depth, &tiny.vertex, &grid), 16);
    // A sub-pixel bit more: every product of two coordinates grows by two.
    let mut finer = profile("sgi-4k");
    let coarse = estimate(&finer).unwrap().setup_bits;
    finer.vertex.sub_pixel += 1;
    assert_eq!(estimate(&finer).unwrap().setup_bits, coarse + 2);
    // And the bound of clause P-5 holds it, with little slack.
    let depth = finer.depth.unwrap();
    let bound = depth.integer + 2 * finer.vertex.difference_bits() + 4 + depth.interpolation;
    assert!((bound - 8..=bound).contains(&(coarse + 2)), "{coarse} {bound}");
}

thread_local! {
    static DONE: Cell<Count> = const { Cell::new(Count { add: 0, multiply: 0, divide: 0, compare: 0 }) };
}

fn did(add: u64, multiply: u64, divide: u64, compare: u64) {
    DONE.set(DONE.get() + Count { add, multiply, divide, compare });
}

/// An integer whose arithmetic is counted.
#[derive(Clone, Copy)]
struct Counted(i128);

impl std::ops::Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        did(1, 0, 0, 0);
        Self(self.0 + other.0)
    }
}

impl std::ops::Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        did(1, 0, 0, 0);
        Self(self.0 - other.0)
    }
}

impl std::ops::Mul for Counted {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        did(0, 1, 0, 0);
        Self(self.0 * other.0)
    }
}

impl Counted {
    /// The nearest integer to a quotient, ties to even.
    fn over(self, divisor: Self) -> Self {
        did(0, 0, 1, 0);
        let twice = 2 * self.0 + divisor.0;
        let floor = twice.div_euclid(2 * divisor.0);
        let tie = twice.rem_euclid(2 * divisor.0) == 0;
        Self(if tie { floor - floor.rem_euclid(2) } else { floor })
    }

    fn below(self, other: Self) -> bool {
        did(0, 0, 0, 1);
        self.0 < other.0
    }

    fn is(self, other: i128) -> bool {
        did(0, 0, 0, 1);
        self.0 == other
    }

    fn lower(self, other: Self) -> Self {
        if self.below(other) { self } else { other }
    }

    fn higher(self, other: Self) -> Self {
        if self.below(other) { other } else { self }
    }

    /// Wires.
    fn up(self, bits: u32) -> Self {
        Self(self.0 << bits)
    }
}

const ZERO: Counted = Counted(0);
const ONE: Counted = Counted(1);

/// What a counted walk found: set-up words in the order of the ports, samples with depth, and how
/// often each thing was done.
#[derive(Default)]
struct Walked {
    words: Vec<i128>,
    samples: Vec<(i128, i128, u64)>,
    rows: u64,
    runs: u64,
    visits: u64,
}

struct Walk {
    v: [[Counted; 2]; 3],
    z: [Counted; 3],
    sub_pixel: u32,
    /// Of a sample in its pixel, both axes.
    offset: Counted,
    size: i128,
    depth: DepthConfig,
}

impl Walk {
    /// A triangle that is normalised already, in a square window.
    fn new(profile: &Profile, xy: [[i128; 2]; 3], z: [i128; 3]) -> Self {
        let sub_pixel = profile.vertex.sub_pixel;
        Self {
            v: xy.map(|p| p.map(Counted)),
            z: z.map(Counted),
            sub_pixel,
            offset: Counted(1 << (sub_pixel - 1)),
            size: i128::from(profile.window.width),
            depth: profile.depth.unwrap(),
        }
    }

    /// Clause T-3.
    fn area(&self) -> Counted {
        let [[x0, y0], [x1, y1], [x2, y2]] = self.v;
        let area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
        assert!(!area.below(ZERO) && !area.is(0));
        area
    }

    /// The pixels of a coordinate interval, within the window.
    fn pixels(&self, low: Counted, high: Counted) -> (Counted, Counted) {
        let first = Counted(-((self.offset - low).0 >> self.sub_pixel));
        let last = Counted((high - self.offset).0 >> self.sub_pixel);
        (first, last + ONE)
    }

    fn clip(&self, (first, end): (Counted, Counted)) -> (Counted, Counted) {
        let within = |value: Counted| value.higher(ZERO).lower(Counted(self.size));
        let first = within(first);
        (first, within(end).higher(first))
    }

    fn extent(&self, axis: usize) -> (Counted, Counted) {
        let [a, b, c] = self.v.map(|p| p[axis]);
        (a.lower(b).lower(c), a.higher(b).higher(c))
    }

    /// Clauses P-1 and P-2, by quotients.
    fn plane(&self, area: Counted) -> [Counted; 3] {
        let [[x0, y0], [x1, y1], [x2, y2]] = self.v;
        let (z1, z2) = (self.z[1] - self.z[0], self.z[2] - self.z[0]);
        let gx = z1 * (y2 - y0) - z2 * (y1 - y0);
        let gy = (x1 - x0) * z2 - (x2 - x0) * z1;
        let offset = gx * (self.offset - x0) + gy * (self.offset - y0);
        let f = self.depth.interpolation;
        let start = (self.z[0] * area + offset).up(f).over(area);
        [start, gx.up(self.sub_pixel + f).over(area), gy.up(self.sub_pixel + f).over(area)]
    }

    /// A run of depth values, by clause G-6 for the mode guard.
    fn run(&self, plane: [Counted; 3], (x0, x1, y): (Counted, Counted, Counted), to: &mut Walked) {
        let [start, dx, dy] = plane;
        let mut value = start + x0 * dx + y * dy;
        to.runs += 1;
        let DepthConfig { guard, integer, interpolation, .. } = self.depth;
        let half = 1i128 << (guard + integer + interpolation - 1);
        let bias = Counted(1 << (integer + interpolation - 1));
        for x in x0.0..x1.0 {
            // The word less the bias, which the start carries along.
            let seen = Counted((value.0 - bias.0 + half).rem_euclid(2 * half) - half);
            let top = Counted((1 << (integer + interpolation)) - 1 - bias.0);
            let held = seen.higher(Counted(-bias.0)).lower(top) + bias;
            to.samples.push((y.0, x, u64::try_from(held.0 >> interpolation).unwrap()));
            value = value + dx;
        }
    }

    /// Clauses E-1 to E-3 and C-2 to C-4.
    fn edge_function(&self) -> Walked {
        let mut walked = Walked::default();
        let area = self.area();
        let (xs, ys) = (self.extent(0), self.extent(1));
        let (x0, x1) = self.clip(self.pixels(xs.0, xs.1));
        let (y0, y1) = self.clip(self.pixels(ys.0, ys.1));
        assert!(!x0.is(x1.0));
        let edges: [[Counted; 3]; 3] = std::array::from_fn(|k| {
            let ([ax, ay], [bx, by]) = (self.v[k], self.v[(k + 1) % 3]);
            let (dx, dy) = (bx - ax, by - ay);
            let step = Counted(-dy.0);
            let c = dy * ax - dx * ay;
            let e = step * self.offset + dx * self.offset + c;
            let (left, level, rightward) = (dy.below(ZERO), dy.is(0), ZERO.below(dx));
            let bias = if left || (level && rightward) { ZERO } else { Counted(-1) };
            [Counted((e + bias).0 >> self.sub_pixel), step, dx]
        });
        walked.words.extend(edges.as_flattened().iter().map(|word| word.0));
        let plane = self.plane(area);
        walked.words.extend(plane.map(|word| word.0));
        let mut row = edges.map(|[e, a, b]| e + x0 * a + y0 * b);
        for y in y0.0..y1.0 {
            walked.rows += 1;
            let (mut here, mut open) = (row, None);
            for x in x0.0..x1.0 {
                walked.visits += 1;
                let inside = here.map(|e| !e.below(ZERO)) == [true; 3];
                for k in 0..3 {
                    here[k] = here[k] + edges[k][1];
                }
                match (inside, open) {
                    (true, None) => open = Some(x),
                    (false, Some(begin)) => {
                        self.run(plane, (Counted(begin), Counted(x), Counted(y)), &mut walked);
                        open = None;
                    }
                    _ => {}
                }
            }
            if let Some(begin) = open {
                self.run(plane, (Counted(begin), x1, Counted(y)), &mut walked);
            }
            for k in 0..3 {
                row[k] = row[k] + edges[k][2];
            }
        }
        walked
    }

    /// Clauses K-2 to K-5. Edges here cross some row, and x never leaves its word.
    fn edge_walk(&self, fraction: u32) -> Walked {
        let mut walked = Walked::default();
        let area = self.area();
        let ys = self.extent(1);
        let (y0, y1) = self.clip(self.pixels(ys.0, ys.1));
        let mut edges: [_; 3] = std::array::from_fn(|k| {
            let (from, to) = (self.v[k], self.v[(k + 1) % 3]);
            let left = to[1].below(from[1]);
            let (top, bottom) = if left { (to, from) } else { (from, to) };
            let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
            let (first, end) = self.pixels(top[1], bottom[1] - ONE);
            assert!(first.below(end));
            let below = first.up(self.sub_pixel) + self.offset - top[1];
            let start = (top[0] * dy + below * dx).up(fraction).over(dy.up(self.sub_pixel));
            let slope = dx.up(fraction).over(dy);
            walked.words.extend([start.0, slope.0, first.0, end.0]);
            (left, start, slope, first, end)
        });
        let plane = self.plane(area);
        walked.words.extend(plane.map(|word| word.0));
        for y in y0.0..y1.0 {
            walked.rows += 1;
            let mut ends = [None; 2];
            for (side, end) in ends.iter_mut().enumerate() {
                // Which of three is active is known from the last row; that it still is, is asked.
                let crossing = |e: &&mut (bool, Counted, Counted, Counted, Counted)| {
                    e.0 == (side == 0) && (e.3.0..e.4.0).contains(&y)
                };
                let Some(edge) = edges.iter_mut().find(crossing) else { continue };
                assert!(!Counted(y).below(edge.3) && Counted(y).below(edge.4));
                let unit = fraction + self.sub_pixel;
                let off = edge.1.up(self.sub_pixel) - self.offset.up(fraction);
                *end = Some(Counted(-(-off.0 >> unit)));
                edge.1 = edge.1 + edge.2;
            }
            let [Some(left), Some(right)] = ends else { panic!("row {y} has two ends") };
            let (x0, x1) = self.clip((left, right));
            if x0.below(x1) {
                self.run(plane, (x0, x1, Counted(y)), &mut walked);
            }
        }
        walked
    }
}

/// Holds a counted walk against the model's words and samples, and its counts against the estimate.
#[track_caller]
fn agree(profile: &Profile, triangle: Triangle, walk: impl Fn(&Walk) -> Walked) {
    let mut drawing = Drawing::default();
    let model = Model::new(profile).unwrap();
    model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
    let plan = Walk::new(profile, triangle.xy, triangle.z.unwrap());
    DONE.set(Count::default());
    let walked = walk(&plan);
    let done = DONE.get();
    assert_eq!(walked.words, drawing.raw_setup());
    let drawn: Vec<_> = drawing
        .spans
        .iter()
        .flat_map(|span| (span.x0..span.x1).map(move |x| (i128::from(span.y), i128::from(x))))
        .zip(&drawing.depth)
        .map(|((y, x), z)| (y, x, *z))
        .collect();
    assert_eq!(walked.samples, drawn);
    let Operations { triangle, row, run, visit, fragment, tile: _ } =
        estimate(profile).unwrap().operations;
    let fragments = u64::try_from(walked.samples.len()).unwrap();
    let sum = triangle
        + row.times(walked.rows)
        + run.times(walked.runs)
        + visit.times(walked.visits)
        + fragment.times(fragments);
    assert_eq!(sum, done);
    assert!(walked.rows > 5 && walked.runs > 5 && fragments > 20, "enough to tell them apart");
}

#[test]
fn counted_formulas_agree_with_the_model_and_the_estimate() {
    // Positive area, every edge over some row, no row that only one edge crosses.
    let small = Triangle {
        xy: [[3_000, 700], [12_000, 5_100], [900, 11_000]],
        z: Some([1_000, 77_777, 16_000_000]),
    };
    let large = Triangle { xy: [[300, 700], [30_000, 5_100], [900, 11_000]], z: small.z };
    for triangle in [small, large] {
        agree(&profile("sgi-4k"), triangle, Walk::edge_function);
        agree(&profile("sgi-4k-walk"), triangle, |walk| walk.edge_walk(22));
    }
}

#[test]
fn a_shared_reciprocal_trades_divisions_for_products() {
    let mut profile = profile("sgi-4k");
    let quotient = estimate(&profile).unwrap().operations;
    profile.depth.as_mut().unwrap().division = Division::Reciprocal { bits: 20 };
    let reciprocal = estimate(&profile).unwrap().operations;
    assert_eq!((quotient.triangle.divide, reciprocal.triangle.divide), (3, 1));
    // Three products in the place of z0 A2.
    assert_eq!(reciprocal.triangle.multiply, quotient.triangle.multiply + 2);
    assert_eq!(reciprocal.triangle.add, quotient.triangle.add);
    // Without depth nothing is divided, and a covered sample costs nothing more.
    profile.depth = None;
    let none = estimate(&profile).unwrap().operations;
    assert_eq!(
        (none.triangle.divide, none.fragment, none.run),
        (0, Count::default(), Count::default())
    );
    assert_eq!(none.visit, quotient.visit);
}
