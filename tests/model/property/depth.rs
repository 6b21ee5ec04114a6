//! Setup words and depth values against exact rationals.

use crate::property::cases;
use crate::property::events::{by_definition, by_pattern, clamps};
use crate::property::rounding::{round, roundings};
use guardbit::bits::Rounding;
use guardbit::cover::{EdgeStorage, FillRule, Rect};
use guardbit::format::Clamp;
use guardbit::machine::DrawError;
use guardbit::model::{Drawing, Model, View};
use guardbit::profile::{Form, load};
use guardbit::setup::{Division, Triangle};
use guardbit::value::{DepthConfig, StartBias};
use num_bigint::BigInt;
use proptest::prelude::*;

/// The exact plane at a sub-pixel position as a fraction: numerator over |A2|.
/// By barycentric weights, each the area of the triangle that a vertex is replaced in.
fn exact(t: &Triangle, [x, y]: [i128; 2]) -> (BigInt, BigInt) {
    let [a, b, c] = t.xy.map(|v| v.map(BigInt::from));
    let p = [BigInt::from(x), BigInt::from(y)];
    let area = |a: &[BigInt; 2], b: &[BigInt; 2], c: &[BigInt; 2]| {
        &a[0] * (&b[1] - &c[1]) + &b[0] * (&c[1] - &a[1]) + &c[0] * (&a[1] - &b[1])
    };
    let [z0, z1, z2] = t.z.unwrap();
    let sum = area(&p, &b, &c) * z0 + area(&a, &p, &c) * z1 + area(&a, &b, &p) * z2;
    let whole = area(&a, &b, &c);
    if whole < BigInt::ZERO { (-sum, -whole) } else { (sum, whole) }
}

/// The reciprocal by its definition: the power of two over A2 with b bits, nearest even.
fn reciprocal(area: &BigInt, bits: u32) -> (BigInt, u64) {
    let exponent = area.bits() + u64::from(bits) - 1;
    let mantissa = round(Rounding::NearestEven, &(BigInt::from(1) << exponent), area);
    if mantissa.bits() > u64::from(bits) {
        (mantissa / 2, exponent - 1)
    } else {
        (mantissa, exponent)
    }
}

fn positions(low: i128, high: i128) -> impl Strategy<Value = [[i128; 2]; 3]> {
    let axis = move || {
        (0..=high - low, 0..22u32, any::<bool>()).prop_map(move |(v, shift, from_top)| {
            if from_top { high - (v >> shift) } else { low + (v >> shift) }
        })
    };
    let vertex = move || [axis(), axis()];
    // Near one another as often as far apart.
    ([vertex(), vertex(), vertex()], 0..22u32).prop_map(move |(v, near)| {
        let [a, b, c] = v;
        let pull = |v: [i128; 2]| [0, 1].map(|k| a[k] + ((v[k] - a[k]) >> near));
        [a, pull(b), pull(c)]
    })
}

fn depths(bits: u32) -> impl Strategy<Value = [i128; 3]> {
    let top = (1i128 << bits) - 1;
    let z = move || prop_oneof![Just(0), Just(top), 0..=top];
    [z(), z(), z()]
}

fn divisions() -> impl Strategy<Value = Division> {
    prop_oneof![
        Just(Division::Quotient),
        (2..=22u32).prop_map(|bits| Division::Reciprocal { bits }),
    ]
}

proptest! {
    #![proptest_config(cases(1000))]

    // Clauses P-1, P-2, P-3, P-4, P-5, E-1, E-3, C-4, R-4
    #[test]
    fn setup_words_are_rounded_once_from_the_exact_plane(
        xy in positions(0, 1 << 22), z in depths(24), division in divisions(),
        rounding in roundings(), interpolation in 0..=20u32, half in any::<bool>(),
    ) {
        let mut profile = load("sgi-4k").unwrap();
        let start_bias = if half { StartBias::Half } else { StartBias::None };
        let clamp = Clamp::Guard;
        profile.depth = Some(DepthConfig {
            guard: 2, integer: 24, interpolation, rounding, division, clamp, start_bias,
            format: None,
            bias: None,
        });
        let triangle = Triangle { xy, z: Some(z) };
        let [a, b, c] = xy;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        prop_assume!(area != 0);
        let view = View { scissor: Some(Rect { x0: 0, y0: 0, x1: 0, y1: 0 }), ..View::default() };
        let mut drawing = Drawing::default();
        let model = Model::with_view(&profile, view).unwrap();
        model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
        let v = if area < 0 { [a, c, b] } else { xy };
        for k in 0..3 {
            let (p, q) = (v[k], v[(k + 1) % 3]);
            let e = (q[0] - p[0]) * (512 - p[1]) - (q[1] - p[1]) * (512 - p[0]);
            let owner = q[1] < p[1] || q[1] == p[1] && q[0] > p[0];
            let stored = (e - i128::from(!owner)).div_euclid(1024);
            prop_assert_eq!(&drawing.raw_setup()[3 * k..3 * k + 3], &[stored, p[1] - q[1], q[0] - p[0]]);
        }
        // Slopes per pixel are differences of the exact plane one pixel apart.
        let (at, den) = exact(&triangle, [512, 512]);
        let right = exact(&triangle, [512 + 1024, 512]).0 - &at;
        let down = exact(&triangle, [512, 512 + 1024]).0 - &at;
        let f = interpolation;
        let expected = match division {
            Division::Quotient => [&at, &right, &down].map(|n| round(rounding, &(n << f), &den)),
            Division::Reciprocal { bits } => {
                let (mantissa, exponent) = reciprocal(&den, bits);
                let by = BigInt::from(1) << exponent;
                let times = |n: &BigInt| round(rounding, &((n * &mantissa) << f), &by);
                let offset = &at - &den * z[0];
                [(BigInt::from(z[0]) << f) + times(&offset), times(&right), times(&down)]
            }
        };
        let bias = if half && f > 0 { 1i128 << (f - 1) } else { 0 };
        let got = [drawing.raw_setup()[9] - bias, drawing.raw_setup()[10], drawing.raw_setup()[11]];
        prop_assert_eq!(got.map(BigInt::from), expected);
    }

    // Clauses P-2, G-1, V-2, V-3
    #[test]
    fn values_and_events_are_those_of_the_unwrapped_plane(
        xy in positions(0, 12 << 3), z in depths(5), clamp in clamps(),
        rounding in roundings(), guard in 0..=2u32, interpolation in 0..=6u32,
    ) {
        let mut profile = load("tiny").unwrap();
        profile.window = guardbit::profile::WindowConfig { width: 12, height: 12 };
        (profile.vertex.integer, profile.vertex.sub_pixel) = (4, 3);
        if let Form::EdgeFunction(edges) = &mut profile.form {
            (edges.width, edges.rule, edges.storage) = (20, FillRule::TopLeft, EdgeStorage::Shifted);
        }
        let division = Division::Quotient;
        profile.depth = Some(DepthConfig {
            guard, integer: 5, interpolation, rounding, division, clamp, start_bias: StartBias::None,
            format: None,
            bias: None,
        });
        let model = Model::new(&profile).unwrap();
        let mut drawing = Drawing::default();
        let drawn = model.draw(&model.place(Triangle { xy, z: Some(z) }).unwrap(), &mut drawing);
        let read = model.depth().unwrap().read_out();
        if drawing.zero_area {
            return Ok(());
        }
        let [start, dx, dy] = drawing.raw_setup()[9..] else { unreachable!() };
        let value = |y: u32, x: u32| start + dx * i128::from(x) + dy * i128::from(y);
        let mut counts = [0; 4];
        let mut values = drawing.depth.iter();
        for span in &drawing.spans {
            for x in span.x0..span.x1 {
                let events = by_definition(read, value(span.y, x));
                for (count, happened) in counts.iter_mut().zip(events) {
                    *count += u64::from(happened);
                }
                let z = *values.next().unwrap();
                if clamp != Clamp::Saturate {
                    prop_assert_eq!(BigInt::from(z), by_pattern(read, value(span.y, x)));
                }
            }
        }
        prop_assert_eq!(drawing.events.total.counts, counts);
        if let Err(DrawError::GuardRange { x, y }) = drawn {
            prop_assert_eq!(clamp, Clamp::Error);
            let (x, y) = (u32::try_from(x).unwrap(), u32::try_from(y).unwrap());
            prop_assert!(by_definition(read, value(y, x))[0]);
        } else {
            prop_assert!(clamp != Clamp::Error || counts[0] == 0);
        }
    }
}

proptest! {
    #![proptest_config(cases(200))]

    // Clauses P-2, P-3
    #[test]
    fn the_39_bit_budget_stays_under_half_an_ulp(
        xy in positions(0, 1 << 22), z in depths(24), row in 0..4096u32,
    ) {
        let profile = load("sgi-4k").unwrap();
        let triangle = Triangle { xy, z: Some(z) };
        // Two rows in the middle of the triangle and two anywhere: huge ones have 4096.
        let middle = u32::try_from((xy[0][1] + xy[1][1] + xy[2][1]) / 3072).unwrap().min(4095);
        for y0 in [middle, row] {
            let scissor = Some(Rect { x0: 0, y0, x1: 4096, y1: y0 + 2 });
            let model = Model::with_view(&profile, View { scissor, ..View::default() }).unwrap();
            let mut drawing = Drawing::default();
            model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
            if drawing.zero_area {
                return Ok(());
            }
            let [start, dx, dy] = drawing.raw_setup()[9..] else { unreachable!() };
            let mut offset = 0;
            for span in &drawing.spans {
                // The error is linear along a row, so its extremes are at the ends.
                for x in [span.x0, span.x1 - 1] {
                    let unwrapped = start + dx * i128::from(x) + dy * i128::from(span.y);
                    let at = |pixel: u32| i128::from(pixel) * 1024 + 512;
                    let (n, d) = exact(&triangle, [at(x), at(span.y)]);
                    // |unwrapped / 2^13 - n / d| < 1/2
                    let error: BigInt = BigInt::from(unwrapped) * &d - (n.clone() << 13);
                    let half: BigInt = &d << 12;
let below_half = error.magnitude() < half.magnitude();
                    prop_assert!(below_half, "row {} column {}: {} / {}", span.y, x, error, d);
                    // A covered sample needs no more than the guard clamp: its depth is in range.
                    let floor = (unwrapped >> 13).clamp(0, (1 << 24) - 1);
                    let z = drawing.depth[offset + (x - span.x0) as usize];
                    prop_assert_eq!(i128::from(z), floor);
                }
                offset += (span.x1 - span.x0) as usize;
            }
        }
    }
}
