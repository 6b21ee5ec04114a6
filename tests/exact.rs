//! Set-up against the exact truth, which shares no code with it.

use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::exact;
use guardbit::setup::{Division, EdgeCoefficients, Gradient, Plane, Triangle};

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
    for index in 0..1000 {
        let (xy, z, sample) = case(index);
        let triangle = Triangle { xy, z: Some(z) }.normalised();
        let (Some(z), true) = (triangle.z, triangle.area2() > 0) else {
            continue;
        };
        let gradient = Gradient::new(&triangle, z);
        for rounding in Rounding::ALL {
            let plane = Plane::round(&gradient, sample, 10, 13, rounding, Division::Quotient);
            // The original order of vertices: the plane does not depend on the winding.
            let start = exact::plane_word(triangle.xy, z, sample, 13, rounding);
            assert_eq!(start, Some(plane.start), "case {index} {rounding}");
            let slopes = exact::plane_slopes(xy, case(index).1).unwrap();
            let rounded =
                slopes.map(|slope| exact::round(&(slope * exact::integer(1 << 23)), rounding));
            assert_eq!(rounded, [plane.dx.into(), plane.dy.into()], "case {index} {rounding}");
        }
    }
}

#[test]
fn quotients_of_long_words_round_as_defined() {
    for index in 0..2000 {
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
