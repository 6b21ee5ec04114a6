//! Set-up against the exact truth, which shares no code with it.

use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::FillRule;
use guardbit::exact::{self, Rule};
use guardbit::setup::{Division, EdgeCoefficients, Gradient, Plane, Triangle, edges};

const SEED: u64 = 2;

/// Vertices, depths and sample of case `index`: from a 4-pixel toy up to 4096 pixels at s = 10.
fn case(index: u64) -> ([[i128; 2]; 3], [i128; 3], [i128; 2]) {
    let mut words = Words::new(SEED, 0, index);
    let side = 8 << (index % 20);
    let mut point = || [words.between(0, side), words.between(0, side)];
    let (xy, sample) = ([point(), point(), point()], point());
    (xy, [(); 3].map(|()| words.between(0, (1 << 24) - 1)), sample)
}

#[test]
fn edge_functions_are_twice_signed_areas() {
    for index in 0..2000 {
        let ([from, to, _], _, sample) = case(index);
        let edge = EdgeCoefficients::between(from, to);
        let truth = exact::edge_value(from, to, sample);
        assert_eq!(exact::integer(edge.at(sample[0], sample[1])), truth, "case {index}");
    }
}

#[test]
fn planes_are_the_exact_ones_rounded_once() {
    for index in 0..120 {
        let (xy, original, sample) = case(index);
        let triangle = Triangle { xy, z: Some(original) }.normalised();
        let (Some(z), true) = (triangle.z, triangle.area2() > 0) else {
            continue;
        };
        let gradient = Gradient::new(&triangle, z);
        // The original order of vertices: the plane does not depend on the winding.
        let slopes = exact::plane_slopes(xy, original).unwrap();
        for rounding in Rounding::ALL {
            let plane = Plane::round(&gradient, sample, 10, 13, rounding, Division::Quotient);
            let start = exact::plane_word(triangle.xy, z, sample, 13, rounding);
            assert_eq!(start, Some(plane.start().raw()), "case {index} {rounding}");
            let rounded = slopes
                .clone()
                .map(|slope| exact::round(&(slope * exact::integer(1 << 23)), rounding));
            assert_eq!(
                rounded,
                [plane.dx().raw().into(), plane.dy().raw().into()],
                "case {index} {rounding}"
            );
        }
    }
}

#[test]
fn quotients_of_long_words_round_as_defined() {
    for index in 0..256 {
        let mut words = Words::new(SEED, 1, index);
        let mut long =
            |bits: u32| (i128::from(words.draw()) << 63 | i128::from(words.draw())) >> (126 - bits);
        let (numerator, denominator) = (long(120) - (1 << 119), long(60) + 1);
        for rounding in Rounding::ALL {
            let word = rounding.divide(numerator, denominator).map(|(value, _)| value);
            assert_eq!(word, exact::divide(numerator, denominator, rounding), "case {index}");
            let shift = u32::try_from(index % 128).unwrap();
            let shifted = rounding.shift_right(numerator, shift).0;
            assert_eq!(shifted, exact::round_dyadic(numerator, shift, rounding), "case {index}");
        }
    }
}

/// Coverage by edge functions and ownership of edges.
fn covered(rule: FillRule, triangle: Triangle, [x, y]: [i128; 2]) -> bool {
    let triangle = triangle.normalised();
    let inside = edges(&triangle).iter().all(|edge| {
        let e = edge.at(x, y);
        e > 0 || (e == 0 && rule.owns(edge.direction()))
    });
    triangle.area2() > 0 && inside
}

#[test]
fn fill_rules_own_what_row_crossings_own() {
    let rules = [(FillRule::TopLeft, Rule::TopLeft), (FillRule::Shadow, Rule::Shadow)];
    let check = |xy: [[i128; 2]; 3], sample| {
        for (rule, truth) in rules {
            let got = covered(rule, Triangle { xy, z: None }, sample);
            assert_eq!(got, exact::covers(xy, sample, truth), "{xy:?} {sample:?} {rule:?}");
        }
    };
    // Every triangle of a 3 x 3 lattice, both windings and without area, at every lattice point.
    let point = |n: i128| [n % 3, n / 3];
    for n in 0..729 {
        for p in 0..9 {
            check([point(n % 9), point(n / 9 % 9), point(n / 81)], point(p));
        }
    }
    // Large ones, at a sample, a vertex and the middle of an edge.
    for index in 0..300 {
        let (xy, _, sample) = case(index);
        let doubled = xy.map(|v| v.map(|n| 2 * n));
        let middle = [xy[0][0] + xy[1][0], xy[0][1] + xy[1][1]];
        for p in [sample, doubled[2], middle] {
            check(doubled, p);
        }
    }
}
