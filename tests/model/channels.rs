//! Channels against their clauses, read as plainly as they are written, and against the exact truth.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod bounds;
mod proved;
mod quads;
mod reciprocal;
mod refused;
mod runs;
mod words;

use crate::toy::TOY;
use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::{DepthAt, MultisampleConfig, SampleConfig, SampleGrid};
use guardbit::exact::{Rational, edge_value, integer, ratio, round};
use guardbit::machine::Input;
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Profile, parse};
use guardbit::setup::Triangle;
use guardbit::value::{Correction, Corrector, EvaluatedAt, Provoking, ReciprocalConfig, Refine};

const NEAREST: Rounding = Rounding::NearestEven;

/// 8 x 8 pixels with four sub-pixel bits, codes of 4 bits, q of 5 bits.
fn toy() -> Profile {
    let text = TOY.to_owned()
        + r#"[depth]
guard = 1
integer = 4
interpolation = 6
rounding = "nearest-even"
division = "quotient"
clamp = "guard"
[w]
guard = 1
integer = 5
interpolation = 9
rounding = "nearest-even"
clamp = "guard"
[[channel]]
name = "c"
components = ["a", "b"]
guard = 1
integer = 4
interpolation = 9
rounding = "nearest-even"
clamp = "guard"
correction = { quotient = { rounding = "nearest-even" } }
"#;
    parse(&text, "toy.toml").unwrap()
}

fn with(correction: Correction, signed: bool) -> Profile {
    let mut profile = toy();
    if !correction.needs_w() {
        profile.w = None;
    }
    let channel = &mut profile.channel[0];
    (channel.correction, channel.signed) = (correction, signed);
    profile.validate().unwrap();
    profile
}

fn unit() -> ReciprocalConfig {
    let refine = Refine::Newton { bits: vec![12] };
    ReciprocalConfig { operand: 10, index: 4, entry: 7, refine, table: None }
}

fn corrections() -> [Correction; 7] {
    [
        Correction::Affine,
        Correction::Flat { provoking: Provoking::First },
        Correction::Flat { provoking: Provoking::Last },
        Correction::Quotient { rounding: NEAREST },
        Correction::Reciprocal { unit: unit(), rounding: Rounding::Floor },
        Correction::Barycentric { bits: 10, rounding: NEAREST },
        Correction::ConstantW { rounding: Rounding::Floor },
    ]
}

/// A triangle, its codes by component, its codes of 1/w.
struct Case {
    triangle: Triangle,
    codes: [[i128; 3]; 2],
    q: [i128; 3],
}

fn case(index: u64, signed: bool) -> Case {
    let mut words = Words::new(24, 1, index);
    let mut below = |limit: u64| i128::from(words.below(limit));
    let xy = [0; 3].map(|_| [below(129), below(129)]);
    let low = if signed { 8 } else { 0 };
    let codes = [[0; 3]; 2].map(|row| row.map(|_: i128| below(16) - low));
    let q = [0; 3].map(|_| below(31) + 1);
    Case { triangle: Triangle { xy, z: Some([1, 2, 3]) }, codes, q }
}

fn draw(model: &Model, case: &Case) -> Drawing {
    let mut drawing = Drawing::default();
    let values = model.values(&[("c".to_owned(), case.codes.to_vec())], Some(case.q)).unwrap();
    let placed = model.place(case.triangle).unwrap();
    model.draw(Input::Shaded(&placed, &values), &mut drawing).unwrap();
    drawing
}

/// The exact plane of values at a point: the edge functions opposite the vertices weigh them.
fn plane(xy: [[i128; 2]; 3], values: [Rational; 3], at: [i128; 2]) -> Rational {
    let [u0, u1, u2] = values;
    let weights = weights(xy, at);
    let whole = &weights[0] + &weights[1] + &weights[2];
    (u0 * &weights[0] + u1 * &weights[1] + u2 * &weights[2]) / whole
}

fn weights(xy: [[i128; 2]; 3], at: [i128; 2]) -> [Rational; 3] {
    [edge_value(xy[1], xy[2], at), edge_value(xy[2], xy[0], at), edge_value(xy[0], xy[1], at)]
}

fn rounded(value: &Rational, rounding: Rounding) -> i128 {
    round(value, rounding).try_into().unwrap()
}

/// Start and slopes of a plane, rounded once to `fraction` bits, and the accumulator at a pixel: P-2.
fn walked(
    grid: SampleGrid,
    xy: [[i128; 2]; 3],
    values: &[Rational; 3],
    (fraction, [x, y]): (u32, [i128; 2]),
) -> i128 {
    let at = |px, py| plane(xy, values.clone(), grid.position(px, py));
    let scale = integer(1 << fraction);
    let origin = at(0, 0);
    let slope = |next: Rational| rounded(&((next - &origin) * &scale), NEAREST);
    rounded(&(&origin * &scale), NEAREST) + x * slope(at(1, 0)) + y * slope(at(0, 1))
}

/// Wrapped to g = 1 guard bit over i integer bits, then clamped to the codes with their fraction: CH-2.
fn held(accumulator: i128, i: u32, fraction: u32, signed: bool) -> i128 {
    let (all, period) = (1i128 << (i + fraction), 1i128 << (1 + i + fraction));
    let low = if signed { -all / 2 } else { 0 };
    // The range that can be told apart has half of the guard's excess on each side.
    let start = low - all / 2;
    let value = (accumulator - start).rem_euclid(period) + start;
    value.clamp(low, low + all - 1)
}

fn normalised(case: &Case) -> (Triangle, [[i128; 3]; 2], [i128; 3]) {
    let turn = |v: [i128; 3]| if case.triangle.area2() < 0 { [v[0], v[2], v[1]] } else { v };
    (case.triangle.normalised(), case.codes.map(turn), turn(case.q))
}

/// What a channel of a machine of planes reads at pixel (x, y), by the clauses.
fn clause(
    profile: &Profile,
    case: &Case,
    component: usize,
    pixel: [i128; 2],
    run: [i128; 2],
) -> i128 {
    let channel = &profile.channel[0];
    let grid = profile.grid().unwrap();
    let (triangle, codes, q) = normalised(case);
    let (xy, u) = (triangle.xy, codes[component]);
    let [low, high] = if channel.signed { [-8, 7] } else { [0, 15] };
    let (fraction, w_fraction) = (9, 9);
    let real = |values: [i128; 3]| values.map(integer);
    let over = || {
        let values = [0, 1, 2].map(|n| ratio(u[n] * q[n], 32).unwrap());
        held(walked(grid, xy, &values, (fraction, pixel)), 4, fraction, channel.signed)
    };
    let inverse =
        |x: i128| held(walked(grid, xy, &real(q), (w_fraction, [x, pixel[1]])), 5, 9, false);
    let far = |value: i128| if value < 0 { low } else { high };
    match &channel.correction {
        Correction::Affine => {
            let accumulator = walked(grid, xy, &real(u), (fraction, pixel));
            held(accumulator, 4, fraction, channel.signed) >> fraction
        }
        Correction::Flat { provoking: Provoking::First } => case.codes[component][0],
        Correction::Flat { provoking: Provoking::Last } => case.codes[component][2],
        Correction::Quotient { rounding } | Correction::ConstantW { rounding } => {
            let constant = matches!(channel.correction, Correction::ConstantW { .. });
            let x = if constant { run[0] + (run[1] - run[0] - 1) / 2 } else { pixel[0] };
            let (p, w) = (over(), inverse(x));
            let quotient = ratio(p << (5 + 9), w << 9);
            quotient.map_or(far(p), |exact| rounded(&exact, *rounding).clamp(low, high))
        }
        Correction::Reciprocal { unit, rounding } => {
            let (p, w) = (over(), inverse(pixel[0]));
            if w == 0 {
                return far(p);
            }
            let length = i128::BITS - w.leading_zeros();
            let x = rounded(&(integer(w) * ratio(1 << 10, 1 << length).unwrap()), Rounding::Floor);
            let m = newton(unit, x);
            // m 2^-(12 + L - 1) for 1/w; P has 9 bits below the point, w has 5 + 9.
            let exact = integer(p * m) * ratio(1 << (5 + 9), 1 << (9 + 12 + length - 1)).unwrap();
            rounded(&exact, *rounding).clamp(low, high)
        }
        Correction::Barycentric { bits, rounding } => {
            let e = weights(xy, grid.position(pixel[0], pixel[1]));
            let e = [0, 1, 2].map(|n| &e[n] * integer(q[n]));
            let whole = &e[0] + &e[1] + &e[2];
            if whole <= integer(0) {
                return far(u[0]);
            }
            let b = |n: usize| rounded(&(&e[n] * integer(1 << bits) / &whole), *rounding);
            let sum = (u[0] << bits) + b(1) * (u[1] - u[0]) + b(2) * (u[2] - u[0]);
            (sum >> bits).clamp(low, high)
        }
    }
}

/// CH-10 and CH-12 for one step, by rationals.
fn newton(unit: &ReciprocalConfig, x: i128) -> i128 {
    let (p, k, m, b) = (unit.operand, unit.index, unit.entry, 12);
    let j = (x >> (p - 1 - k)) & ((1 << k) - 1);
    let place = integer(1) + ratio(2 * j + 1, 2 << k).unwrap();
    let y = rounded(&(integer(1 << m) / place), NEAREST).min((1 << m) - 1);
    let r = rounded(&ratio((x * y) << b, 1 << (p - 1 + m)).unwrap(), Rounding::Floor);
    let t = (2 << b) - r;
    ((y * t) >> m).min((1 << b) - 1)
}

/// Clauses CH-1, CH-2, CH-3, CH-5, CH-6 and CH-13: on machines of planes every code of every correction is that of
/// the clauses, signed and unsigned.
#[test]
fn codes_are_those_of_the_clauses() {
    let planes = ["edge-function", "edge-walk", "engine-per-pixel", "tiles", "homogeneous"];
    for (correction, signed) in
        corrections().into_iter().flat_map(|c| [(c.clone(), false), (c, true)])
    {
        let base = with(correction, signed);
        let models = planes.map(|name| Model::new(&base.with_machine(name).unwrap()).unwrap());
        let mut seen = 0;
        for index in 0..12 {
            let case = case(index, signed);
            for model in &models {
                let drawing = draw(model, &case);
                let mut values = drawing.channels.first().into_iter().flatten();
                for span in &drawing.spans {
                    for x in span.x0..span.x1 {
                        for component in 0..2 {
                            let run = [span.x0, span.x1].map(i128::from);
                            let pixel = [x, span.y].map(i128::from);
                            let want = clause(&base, &case, component, pixel, run);
                            let got = *values.next().unwrap();
                            assert_eq!(
                                i128::from(got),
                                want,
                                "{:?} {} case {index} {pixel:?}",
                                base.channel[0].correction,
                                model.profile().form.name()
                            );
                            seen += 1;
                        }
                    }
                }
                assert!(values.next().is_none());
            }
        }
        assert!(seen > 500, "{seen}");
    }
}

/// Clause CH-13: a span of the scanline starts at the exact plane, whatever the run before it.
#[test]
fn a_span_starts_anew() {
    let base = with(Correction::Affine, false);
    let model = Model::new(&base.with_machine("scanline").unwrap()).unwrap();
    for index in 0..40 {
        let case = case(2000 + index, false);
        let (triangle, codes, _) = normalised(&case);
        let drawing = draw(&model, &case);
        let grid = base.grid().unwrap();
        let mut values = drawing.channels.first().into_iter().flatten();
        for span in &drawing.spans {
            for x in span.x0..span.x1 {
                for u in codes {
                    let at = |x: i128| {
                        plane(triangle.xy, u.map(integer), grid.position(x, span.y.into()))
                    };
                    let scale = integer(512);
                    let slope = rounded(&((at(1) - at(0)) * &scale), NEAREST);
                    let start = rounded(&(at(span.x0.into()) * &scale), NEAREST);
                    let value = start + i128::from(x - span.x0) * slope;
                    let want = held(value, 4, 9, false) >> 9;
                    assert_eq!(i128::from(*values.next().unwrap()), want, "case {index}");
                }
            }
        }
    }
}

/// Clause CH-5: where 1/w comes to 0 or below, the code is the farthest on the value's side.
#[test]
fn nothing_is_divided_by_zero() {
    let quotient = Correction::Quotient { rounding: NEAREST };
    let reciprocal = Correction::Reciprocal { unit: unit(), rounding: NEAREST };
    for correction in [quotient, reciprocal] {
        for (signed, want) in [(false, [15, 15, 15]), (true, [-8, 7, 7])] {
            let profile = with(correction.clone(), signed);
            let (channel, w) = (&profile.channel[0], profile.w.as_ref());
            let corrector = Corrector::new(channel, w, &profile.vertex).unwrap();
            for inverse in [0, -1, -512] {
                let codes = [-512, 0, 512].map(|over| corrector.divided(over, inverse));
                assert_eq!(codes, want, "{:?} {inverse}", channel.correction);
            }
            // One step of 1/w later there is a quotient again: 0 over anything is 0.
            assert_eq!(corrector.divided(0, 1), 0);
        }
    }
}

/// Clause CH-7: each place is the machine's own sample moved there.
#[test]
fn places_are_grids() {
    let case = Case {
        triangle: Triangle { xy: [[3, 5], [120, 30], [40, 110]], z: None },
        codes: [[0, 15, 4], [15, 0, 9]],
        q: [31, 9, 17],
    };
    let correction = Correction::Quotient { rounding: NEAREST };
    let at = |at: EvaluatedAt, multisample| {
        let mut profile = with(correction.clone(), false);
        profile.channel[0].at = at;
        profile.multisample = multisample;
        draw(&Model::new(&profile).unwrap(), &case)
    };
    let moved = |x: u32, y: u32, pixel: [u32; 2]| {
        let mut profile = with(correction.clone(), false);
        profile.sample = Some(SampleConfig::sub_pixels(x, y));
        let run = [0, 8];
        let pixel = pixel.map(i128::from);
        [0, 1]
            .map(|component| i64::try_from(clause(&profile, &case, component, pixel, run)).unwrap())
    };
    let one = at(EvaluatedAt::Corner, None);
    let mut places = one.channels[0].chunks(2);
    for span in &one.spans {
        for x in span.x0..span.x1 {
            assert_eq!(places.next().unwrap(), moved(0, 0, [x, span.y]));
        }
    }
    let four = MultisampleConfig::standard(4, DepthAt::Centre);
    let positions = [[6, 2], [14, 6], [2, 10], [10, 14]];
    let (centroid, sample) =
        (at(EvaluatedAt::Centroid, Some(four)), at(EvaluatedAt::Sample, Some(four)));
    let centre = at(EvaluatedAt::Centre, Some(four));
    let mut masks = centroid.masks.iter();
    let mut by_pixel = centroid.channels[0].chunks(2).zip(centre.channels[0].chunks(2));
    let mut by_sample = sample.channels[0].chunks(2);
    let mut partly = 0;
    for span in &centroid.spans {
        for x in span.x0..span.x1 {
            let (mask, (own, middle)) = (*masks.next().unwrap(), by_pixel.next().unwrap());
            assert_eq!(middle, moved(8, 8, [x, span.y]));
            let covered: Vec<usize> = (0..4).filter(|n| mask >> n & 1 == 1).collect();
            for n in &covered {
                let [dx, dy] = positions[*n];
                assert_eq!(by_sample.next().unwrap(), moved(dx, dy, [x, span.y]));
            }
            // All four lie at the same distance from the centre: the lowest number counts.
            let [dx, dy] = if covered.len() == 4 { [8, 8] } else { positions[covered[0]] };
            partly += usize::from(covered.len() < 4);
            assert_eq!(own, moved(dx, dy, [x, span.y]));
        }
    }
    assert!(partly > 5 && by_sample.next().is_none());
}
