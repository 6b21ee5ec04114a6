//! Limits at their boundaries: the last value that is taken and the first that is not.

use guardbit::bits::{Bits, Event, Overflow, RunTime, Word};
use guardbit::cover::{EdgeStorage, FillRule, Rect};
use guardbit::format::{Clamp, QFormat, ReadOut};
use guardbit::profile;
use guardbit::setup::{Coordinate, Division, EdgeCoefficients, Endless};

/// Clause W-2: a saturated sum says on which side it was held, for every pair of 4-bit words.
#[test]
fn a_saturated_sum_names_its_end() {
    let word = |value| Word::wrapping(Bits::<4>, value);
    let mut held = [0; 2];
    for left in -8..8 {
        for right in -8..8 {
            let (sum, status) = word(left).add_with(word(right), Overflow::Saturate).unwrap();
            let exact = left + right;
            assert_eq!(sum.to_i128(), exact.clamp(-8, 7), "{left} + {right}");
            let events = [Event::ClampAbove, Event::ClampBelow, Event::Wrap].map(|e| status.has(e));
            assert_eq!(events, [exact > 7, exact < -8, false], "{left} + {right}");
            held[0] += usize::from(exact > 7);
            held[1] += usize::from(exact < -8);
        }
    }
    // Pairs of 1 to 7 with a sum of 8 or more, 7 * 8 / 2; pairs of 1 to 8 with a sum of 9 or more, 8 * 9 / 2.
    assert_eq!(held, [28, 36]);
}

// Clauses W-1, F-1 and G-1: the widths of words, of formats, and of read-outs.
#[test]
fn widths_end_where_they_say() {
    for (bits, good) in [(0, false), (1, true), (128, true), (129, false), (u32::MAX, false)] {
        assert_eq!(RunTime::new(bits).is_ok(), good, "{bits}");
        assert_eq!(QFormat::of_width(bits, 3).is_ok(), good, "{bits}");
    }
    for (integer, fraction, good) in
        [(0, 0, false), (0, 1, true), (64, 64, true), (64, 65, false), (1, u32::MAX, false)]
    {
        assert_eq!(QFormat::new(integer, fraction).is_ok(), good, "{integer} {fraction}");
    }
    for (guard, integer, fraction, good) in [
        (0, 0, 8, false),
        (0, 1, 0, true),
        (0, 64, 56, true),
        (1, 64, 56, false),
        (0, 64, 57, false),
        (0, 65, 0, false),
        (119, 1, 0, true),
        (120, 1, 0, false),
        (u32::MAX, 1, u32::MAX, false),
    ] {
        let read = ReadOut::new(guard, integer, fraction, Clamp::Guard);
        assert_eq!(read.is_ok(), good, "{guard} {integer} {fraction}");
    }
}

// Clauses F-4, P-4 and C-5: the fields of a profile.
#[test]
fn fields_of_a_profile_end_where_they_say() {
    let tiny = profile::load("tiny").unwrap();
    for (bits, good) in [(1, false), (2, true), (40, true), (41, false)] {
        assert_eq!(Division::Reciprocal { bits }.validate().is_ok(), good, "{bits}");
    }
    for (width, good) in [(0, false), (1, false), (2, true), (120, true), (121, false)] {
        let mut edge = *tiny.form.edge().unwrap();
        edge.width = width;
        assert_eq!(edge.validate().is_ok(), good, "{width}");
    }
    for (side, good) in [(0, false), (1, true), (65_536, true), (65_537, false)] {
        assert_eq!(Rect::window(side, 1).is_ok(), good, "{side}");
        assert_eq!(Rect::window(1, side).is_ok(), good, "{side}");
    }
    for (signed, integer, sub_pixel, good) in [
        (false, 0, 0, false),
        (false, 1, 0, true),
        (false, 0, 1, true),
        (false, 16, 16, true),
        (false, 16, 17, false),
        (true, 0, 8, false),
        (true, 1, 0, true),
        (true, 32, 0, true),
        (true, 33, 0, false),
        (true, u32::MAX, 1, false),
    ] {
        let mut vertex = tiny.vertex;
        (vertex.signed, vertex.integer, vertex.sub_pixel) = (signed, integer, sub_pixel);
        assert_eq!(vertex.validate().is_ok(), good, "{signed} {integer} {sub_pixel}");
    }
    for (lattice, good) in [(1, false), (2, true), (24, true), (25, false)] {
        let mut vertex = tiny.vertex;
        vertex.lattice = Some(lattice);
        assert_eq!(vertex.validate().is_ok(), good, "lattice {lattice}, sub-pixel 1");
    }
}

/// Clause E-5: the smallest N with -2^(N-1) <= v <= 2^(N-1) - 1 over every vertex of the field and every pixel of
/// the window, not only the corners; -2^(N-1) itself fits.
#[test]
fn an_edge_word_holds_its_lowest_value() {
    let mut at_the_end = 0;
    for (signed, closed) in [(false, false), (false, true), (true, false), (true, true)] {
        for (rule, storage) in [
            (FillRule::TopLeft, EdgeStorage::Full),
            (FillRule::TopLeft, EdgeStorage::Shifted),
            (FillRule::Shadow, EdgeStorage::Full),
            (FillRule::Shadow, EdgeStorage::Shifted),
        ] {
            let mut profile = profile::load("tiny").unwrap();
            (profile.vertex.signed, profile.vertex.closed) = (signed, closed);
            (profile.vertex.integer, profile.vertex.sub_pixel) = (1, 1);
            let grid = profile.grid().unwrap();
            let mut word = *profile.form.edge().unwrap();
            (word.rule, word.storage) = (rule, storage);
            for window in [(1, 1), (2, 2), (3, 3), (4, 4)] {
                let (low, high) = profile.vertex.range();
                let (mut least, mut most) = (0, 0);
                let places = || (low..=high).flat_map(|x| (low..=high).map(move |y| [x, y]));
                for from in places() {
                    for to in places() {
                        let edge = EdgeCoefficients::between(from, to);
                        let bias = i128::from(!rule.owns([to[0] - from[0], to[1] - from[1]]));
                        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                            let corner = |n: u32, last: u32| i128::from(n * (last - 1));
                            let [px, py] = grid.position(corner(x, window.0), corner(y, window.1));
                            let exact = edge.at(px, py) - bias;
                            // Half-pixels: one fraction bit is dropped.
                            let value =
                                if storage == EdgeStorage::Full { exact } else { exact >> 1 };
                            (least, most) = (least.min(value), most.max(value));
                        }
                    }
                }
                let width =
                    (1..40).find(|n| least >= -(1 << (n - 1)) && most < 1 << (n - 1)).unwrap();
                let place = format!("{signed} {closed} {rule:?} {storage:?} {window:?}");
                assert_eq!(word.exact_width(&profile.vertex, &grid, window), width, "{place}");
                at_the_end += usize::from(least == -(1 << (width - 1)));
            }
        }
    }
    assert!(at_the_end > 0, "no field meets the end of its word");
}

/// Clause S-3: what has no place on a lattice goes to an end of the field, and a NaN to zero or the end nearest to it.
#[test]
fn what_has_no_place_is_clamped() {
    let mut vertex = profile::load("tiny").unwrap().vertex;
    vertex.endless = Endless::Clamp;
    let place = Coordinate { key: "f", vertex: Some(0), axis: 0 };
    for (ends, nan) in [((-4, 4), 0), ((0, 8), 0), ((3, 9), 3), ((-9, -2), -2)] {
        let snap = |value: f64| vertex.snap(place, value, 1, ends).unwrap();
        assert_eq!(snap(f64::NAN), nan, "{ends:?}");
        assert_eq!(snap(-f64::NAN), nan, "{ends:?}");
        assert_eq!([snap(f64::INFINITY), snap(1e300)], [ends.1; 2], "{ends:?}");
        assert_eq!([snap(f64::NEG_INFINITY), snap(-1e300)], [ends.0; 2], "{ends:?}");
    }
    vertex.endless = Endless::Refuse;
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        vertex.snap(place, value, 1, (-4, 4)).unwrap_err();
    }
}
