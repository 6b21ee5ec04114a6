//! Toy formats, every case of them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::oracle;

use guardbit::bits::{Bits, Event, Lane, Rounding, Width, Word};
use guardbit::cover::{FillRule, SampleGrid};
use guardbit::dda::Linear;
use guardbit::exact::divide;
use guardbit::format::{Clamp, ReadOut};
use guardbit::machine::EdgeWalkConfig;
use guardbit::model::{Drawing, Model};
use guardbit::profile::load;
use guardbit::setup::{Divider, Division, Triangle};

// Clauses W-1, W-2, D-1, D-2
#[test]
fn all_words_of_up_to_8_bits_add_like_integers() {
    fn all<const BITS: u32>() {
        let (width, bits) = (Bits::<BITS>, BITS);
        let half = 1i128 << (bits - 1);
        let values = -half..half;
        for a in values.clone() {
            let x = Word::wrapping(width, a);
            let pattern = u128::try_from(if a < 0 { a + 2 * half } else { a }).unwrap();
            assert_eq!((x.to_i128(), x.to_bits()), (a, pattern));
            assert_eq!(Word::from_bits(width, pattern), x);
            for b in values.clone() {
                let y = Word::wrapping(width, b);
                let sum = a + b;
                // A sum of two words misses the range by less than one turn.
                let wrapped = match sum {
                    _ if sum >= half => sum - 2 * half,
                    _ if sum < -half => sum + 2 * half,
                    _ => sum,
                };
                let fits = wrapped == sum;
                let (over, status) = x.overflowing_add(y);
                assert_eq!((over.to_i128(), status.has(Event::Wrap)), (wrapped, !fits));
                assert_eq!((x.wrapping_add(y), x + y), (over, over));
                assert_eq!((over.wrapping_sub(y), over - y), (x, x));
                assert_eq!(x + -y, x - y);
                assert_eq!(x < y, a < b);
                assert_eq!(x.checked_add(y).is_some(), fits);
                let end = if sum < 0 { -half } else { half - 1 };
                assert_eq!(x.saturating_add(y).to_i128(), if fits { sum } else { end });
                assert_eq!(Linear::new(x, y).at(3).wrapping_sub(y.wrapping_mul(3)), x);
                // The lane's own addition does the same.
                let lane = i32::justify(a, bits).wrapping_add(i32::justify(b, bits));
                assert_eq!(lane.value(bits), wrapped);
            }
        }
        for beyond in [-half - 1, half, 2 * half + 3] {
            assert_eq!(Word::checked(width, beyond), None);
            let end = if beyond < 0 { -half } else { half - 1 };
            assert_eq!(Word::saturating(width, beyond).to_i128(), end);
        }
    }
    all::<1>();
    all::<2>();
    all::<3>();
    all::<4>();
    all::<5>();
    all::<6>();
    all::<7>();
    all::<8>();
    assert_eq!(Bits::<8>.bits(), 8);
}

// Clauses
#[test]
fn all_roundings_of_all_small_quotients() {
    for mode in Rounding::ALL {
        for n in -70..=70 {
            for d in (-17..=17).filter(|d| *d != 0) {
                let inexact = (-200..200).all(|q| q * d != n);
                assert_eq!(
                    mode.divide(n, d),
                    Some((divide(n, d, mode).unwrap(), inexact)),
                    "{mode} {n}/{d}"
                );
            }
            for shift in 0..=8 {
                let d = 1 << shift;
                let inexact = (-200..200).all(|q| q * d != n);
                let expected = (divide(n, d, mode).unwrap(), inexact);
                assert_eq!(mode.shift_right(n, shift), expected, "{mode} {n} >> {shift}");
            }
            assert_eq!(mode.divide(n, 0), None);
        }
    }
}

/// Read-outs of all patterns of guard and integer bits, in order, as the split writes them down.
fn table(g: u32, i: u32, clamp: Clamp) -> Vec<u64> {
    let (pass, all) = (1usize << i, 1usize << (g + i));
    let top = pass as u64 - 1;
    let passing = 0..pass as u64;
    match clamp {
        Clamp::Guard | Clamp::Error => {
            let clamped = (all - pass) / 2;
            let above = std::iter::repeat_n(top, clamped);
            passing.chain(above).chain(std::iter::repeat_n(0, clamped)).collect()
        }
        // The lower half of the patterns is positive, the upper half negative.
        Clamp::Sign => (0..all)
            .map(|pattern| if pattern >= all / 2 { 0 } else { (pattern as u64).min(top) })
            .collect(),
        _ => (0..all).map(|pattern| pattern as u64 % pass as u64).collect(),
    }
}

// Clauses G-1, G-2, G-3, G-4, G-6
#[test]
fn all_guard_patterns_read_as_the_table_says() {
    assert_eq!(table(1, 2, Clamp::Guard), [0, 1, 2, 3, 3, 3, 0, 0], "lecture A, corrected");
    assert_eq!(table(2, 1, Clamp::Guard), [0, 1, 1, 1, 1, 0, 0, 0]);
    for (g, i, f) in
        (0..=4).flat_map(|g| (1..=3).flat_map(move |i| (0..=2).map(move |f| (g, i, f))))
    {
        for clamp in [Clamp::Wrap, Clamp::Guard, Clamp::Sign, Clamp::Error] {
            let read = ReadOut::new(g, i, f, clamp).unwrap();
            let lane = read.decode::<i32>().unwrap();
            let wide = read.decode::<i128>().unwrap();
            for (top, expected) in (0i128..).zip(table(g, i, clamp)) {
                for fraction in 0..1i128 << f {
                    let pattern = (top << f) + fraction;
                    // Any representative of the pattern reads the same.
                    for turn in -2..=2 {
                        let value = pattern + (turn << (g + i + f));
                        let place = format!("{read:?} {value}");
                        assert_eq!(read.read(value), expected, "{place}");
                        assert_eq!(
                            lane.read(lane.load(value)).unsigned_abs(),
                            u32::try_from(expected).unwrap()
                        );
                        assert_eq!(
                            wide.read(wide.load(value)).unsigned_abs(),
                            u128::from(expected)
                        );
                    }
                }
            }
            // Within the range the read-out is the clamp of the value itself.
            let (low, end) = read.range();
            if clamp != Clamp::Wrap {
                for value in low..end {
                    let floor = value.div_euclid(1 << f);
                    let held = floor.clamp(0, (1 << i) - 1);
                    assert_eq!(i128::from(read.read(value)), held, "{read:?} {value}");
                    assert!(!read.status(value).has(Event::Wrap));
                }
                assert_eq!(end - low, 1 << (g + i + f), "the range is one turn");
            }
            assert!(read.status(low - 1).has(Event::Wrap) && read.status(end).has(Event::Wrap));
        }
    }
}

// Clause G-5
#[test]
fn all_sticky_steps_hold() {
    let read = ReadOut::new(1, 2, 1, Clamp::Saturate).unwrap();
    assert!(read.decode::<i64>().is_none());
    for accumulator in 0..8i128 {
        for step in -8..8i128 {
            let sum = accumulator + step;
            let held = [0, 7][usize::from(sum > 7)];
            let held = if (0..8).contains(&sum) { sum } else { held };
            assert_eq!(read.saturating_step(accumulator, step), held);
        }
    }
}

/// Vertices of the toy: 9 by 9 half pixels.
const SIDE: usize = 9;
const VERTICES: usize = SIDE * SIDE;

fn at(vertex: usize) -> [i128; 2] {
    [vertex % SIDE, vertex / SIDE].map(|v| i128::try_from(v).unwrap())
}

/// Coverage of all triangles of the toy as masks of 16 samples, by the model.
fn masks(model: &Model) -> Vec<u16> {
    let mut masks = vec![0; VERTICES * VERTICES * VERTICES];
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let chunk = VERTICES.div_ceil(threads) * VERTICES * VERTICES;
    std::thread::scope(|scope| {
        for (n, part) in masks.chunks_mut(chunk).enumerate() {
            scope.spawn(move || {
                let mut drawing = Drawing::default();
                for (index, mask) in (n * chunk..).zip(part) {
                    let (a, rest) = (index / VERTICES / VERTICES, index % (VERTICES * VERTICES));
                    let xy = [at(a), at(rest / VERTICES), at(rest % VERTICES)];
                    drawing.clear();
                    model
                        .draw(&model.place(Triangle { xy, z: None }).unwrap(), &mut drawing)
                        .unwrap();
                    for span in &drawing.spans {
                        for x in span.x0..span.x1 {
                            *mask |= 1 << (span.y * 4 + x);
                        }
                    }
                }
            });
        }
    });
    masks
}

/// The same by the oracle, from one table of half planes.
fn expected(rule: FillRule) -> Vec<u16> {
    // Bit n of half[a][b]: nudged sample n is left of a to b, as a thin triangle would see it.
    let side = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    };
    let mut masks = vec![0; VERTICES * VERTICES * VERTICES];
    for a in 0..VERTICES {
        for b in a + 1..VERTICES {
            for c in b + 1..VERTICES {
                let xy = [at(a), at(b), at(c)];
                if side(xy[0], xy[1], xy[2]) == 0 {
                    continue;
                }
                let mut mask = 0;
                for n in 0..16 {
                    let sample = [n % 4, n / 4].map(|v: i128| 2 * v + 1);
                    mask |= u16::from(oracle::covers(xy, sample, rule)) << n;
                }
                for [p, q, r] in [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]]
                {
                    masks[(p * VERTICES + q) * VERTICES + r] = mask;
                }
            }
        }
    }
    masks
}

fn toy(rule: FillRule, width: u32) -> Model {
    let mut profile = load("tiny").unwrap();
    if let Some(edges) = profile.form.edge_mut() {
        (edges.rule, edges.width) = (rule, width);
    }
    Model::new(&profile).unwrap()
}

// Clauses C-1, C-2, C-3, C-4, C-5, T-1, T-2, T-3, E-5
#[test]
fn all_toy_triangles_are_exact_and_partition_the_plane() {
    for rule in FillRule::ALL {
        let expected = expected(rule);
        let got = masks(&toy(rule, 6));
        let wrong = (0..got.len()).find(|n| got[*n] != expected[*n]);
        assert_eq!(wrong, None, "{rule:?}");
        let mask = |a: usize, b: usize, c: usize| got[(a * VERTICES + b) * VERTICES + c];
        let side = |a: usize, b: usize, c: usize| {
            let [a, b, c] = [at(a), at(b), at(c)];
            ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).signum()
        };
        let sides: Vec<i128> = (0..got.len())
            .map(|n| side(n / VERTICES / VERTICES, n / VERTICES % VERTICES, n % VERTICES))
            .collect();
        let side = |a: usize, b: usize, c: usize| sides[(a * VERTICES + b) * VERTICES + c];
        for (a, b) in (0..VERTICES).flat_map(|a| (a + 1..VERTICES).map(move |b| (a, b))) {
            for c in (0..VERTICES).filter(|c| side(a, b, *c) > 0) {
                for d in (0..VERTICES).filter(|d| side(a, b, *d) < 0) {
                    let [left, right] = [mask(a, b, c), mask(a, b, d)];
                    assert_eq!(left & right, 0, "{a} {b} {c} {d}: a sample twice");
                    // A convex quad, whose other diagonal is c to d.
                    if side(c, d, a) * side(c, d, b) < 0 {
                        let other = mask(c, d, a) | mask(c, d, b);
                        assert_eq!(left | right, other, "{a} {b} {c} {d}: a hole");
                    }
                }
            }
        }
    }
}

// Clauses C-5, E-5
#[test]
fn one_bit_less_loses_toy_triangles() {
    let expected = expected(FillRule::TopLeft);
    let got = masks(&toy(FillRule::TopLeft, 5));
    let wrong = (0..got.len()).filter(|n| got[*n] != expected[*n]).count();
    assert!(wrong > 0, "5 bits would be enough after all");
}

// Clauses K-2, K-3, K-4
#[test]
fn all_toy_edges_need_2k_plus_2s_floored_bits() {
    let grid = SampleGrid::new(None, 1).unwrap();
    let wrong = |rounding, fraction| {
        let walk = EdgeWalkConfig { guard: 1, integer: 3, fraction, rounding, clamp: Clamp::Guard };
        let mut wrong = 0;
        for (from, to) in (0..VERTICES).flat_map(|a| (0..VERTICES).map(move |b| (at(a), at(b)))) {
            let Some(edge) = walk.edge(from, to, &grid) else { continue };
            for row in edge.first_row..edge.end_row {
                // The first pixel with a sample at or right of the edge, by looking.
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let right_of = |pixel: i128| {
                    let e = dx * (2 * row + 1 - from[1]) - dy * (2 * pixel + 1 - from[0]);
                    if dy < 0 { e >= 0 } else { e <= 0 }
                };
                let exact = (-1..9).find(|pixel| right_of(*pixel)).unwrap();
                let x = edge.start + edge.slope * (row - edge.first_row);
                wrong += usize::from(walk.pixel(x, &grid) != exact);
            }
        }
        wrong
    };
    // k = 2, s = 1.
    assert_eq!(wrong(Rounding::Floor, 6), 0);
    assert_ne!(wrong(Rounding::Floor, 5), 0);
    // No toy edge is high enough for the ties below, so here nearest happens to be enough.
    assert_eq!(wrong(Rounding::NearestEven, 6), 0);
}

// Clauses K-3, K-4
#[test]
fn ties_defeat_nearest_and_truncation_at_every_fraction() {
    let grid = SampleGrid::new(None, 1).unwrap();
    // x = 1/2 on row 3 of both: from (0, 1/2) to (1, 6 1/2), and from (1, 1/2) to (0, 6 1/2).
    let pixels = |rounding, fraction| {
        let walk = EdgeWalkConfig { guard: 1, integer: 3, fraction, rounding, clamp: Clamp::Guard };
        [[[0, 1], [2, 13]], [[2, 1], [0, 13]]].map(|[from, to]| {
            let edge = walk.edge(from, to, &grid).unwrap();
            assert_eq!((edge.first_row, edge.end_row), (0, 6));
            walk.pixel(edge.start + 3 * edge.slope, &grid)
        })
    };
    for fraction in 4..=40 {
        assert_eq!(pixels(Rounding::Floor, fraction), [0, 0], "floor at {fraction}");
        assert_eq!(pixels(Rounding::TowardZero, fraction), [0, 1], "truncation at {fraction}");
        // 2^f / 6 lies 1/3 above an integer for odd f and below one for even f.
        let nearest = if fraction % 2 == 0 { [1, 0] } else { [0, 1] };
        assert_eq!(pixels(Rounding::NearestEven, fraction), nearest, "nearest at {fraction}");
    }
}

// Clause P-4
#[test]
fn all_reciprocals_are_normalised_and_nearest() {
    for bits in 2..=16u32 {
        for divisor in 1..1i128 << 12 {
            let Divider::Product { mantissa, exponent } =
                (Division::Reciprocal { bits }).by(divisor)
            else {
                panic!("a reciprocal is a product")
            };
            let place = format!("{bits} bits of 1/{divisor}: {mantissa} 2^-{exponent}");
            assert!(1 << (bits - 1) <= mantissa && mantissa < 1 << bits, "{place}");
            // At the scale of the definition no other integer is nearer.
            let mut length = 0;
            while 1 << length <= divisor {
                length += 1;
            }
            let scale = length + bits - 1;
            assert!(exponent == scale || exponent == scale - 1, "{place}");
            let error = |m: i128| (m * divisor - (1i128 << scale)).abs();
            let m = mantissa << (scale - exponent);
            assert!(error(m) <= error(m + 1) && error(m) <= error(m - 1), "{place}");
            if error(m) == error(m + 1) || error(m) == error(m - 1) {
                assert_eq!(m % 2, 0, "{place}: a tie goes to even");
            }
        }
    }
}
