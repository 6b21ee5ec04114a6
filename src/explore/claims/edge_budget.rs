//! Lecture A's 35 bits: exactly enough for an exact edge function, and not by one more.

use super::edge_width::window;
use super::statement::Statement;
use crate::bits::{Bits, Rounding, Word};
use crate::explore::corner::{at_corners, top_left_bias};
use crate::format::Budget;
use crate::setup::EdgeCoefficients;

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "edge.budget-35",
            "lecture A's edge budget, 1 guard + 12 integer + 10 sub-pixel + 12 interpolation bits, \
             is equal to the stored width for a 4096 window and s = 10; the second number is the \
             width with a guard band of one pixel",
            "35 = 35; 36",
            || {
                let [none, one] = [0, 1].map(|guard| window(4096, guard, 10).bits().1);
                format!("{} = {none}; {one}", Budget::EDGE_35.width())
            },
        ),
        Statement::exact(
            "edge.34-fails",
            "number of stored words at the 64 box corners of a 4096 window, s = 10, whose sign is \
             wrong in 35 bits, and whether any sign is wrong in 34 bits",
            "35: 0, 34: some",
            || {
                let wrong = [wrong_signs::<35>(), wrong_signs::<34>()];
                format!("35: {}, 34: {}", wrong[0], if wrong[1] > 0 { "some" } else { "none" })
            },
        ),
        Statement::exact(
            "edge.34-witness",
            "edge (4096, 0) to (4096, 4096) at the centre of pixel (0, 0), which is inside: the \
             value 2^34 - 2^21 - 1 as stored in 35 bits, and as read from 34 bits",
            "17177772031, -2097153",
            || {
                let edge = EdgeCoefficients::between([4096 << 10, 0], [4096 << 10, 4096 << 10]);
                let biased = edge.at(512, 512) + top_left_bias(&edge);
                let stored = Rounding::Floor.shift_right(biased, 10).0;
                let wide = Word::wrapping(Bits::<35>, stored).to_i128();
                format!("{wide}, {}", Word::wrapping(Bits::<34>, stored).to_i128())
            },
        ),
        Statement::exact(
            "edge.largest-32",
            "largest s for which the stored word fits 32 bits, for a window of 2048 / of 8192",
            "9 / 5",
            || {
                [2048, 8192]
                    .map(|w| (1..=20).filter(|s| window(w, 0, *s).bits().1 <= 32).max())
                    .map(|s| s.map_or("none".to_owned(), |s| s.to_string()))
                    .join(" / ")
            },
        ),
        Statement::exact(
            "edge.bias-order",
            "edge (4096, 0) to (4096, 4096) at x = 0, s = 10: E >> s without the fill bias, E >> s \
             with the bias added before the shift, and whether each value fits 35 bits",
            "2^34 no, 2^34-1 yes",
            bias_order,
        ),
    ]
}

fn wrong_signs<const N: u32>() -> usize {
    let case = window(4096, 0, 10);
    at_corners(case.vertices(), case.centres())
        .filter(|(edge, e)| {
            let biased = e + top_left_bias(edge);
            let stored = Rounding::Floor.shift_right(biased, case.s).0;
            (Word::wrapping(Bits::<N>, stored).to_i128() >= 0) != (biased >= 0)
        })
        .count()
}

fn bias_order() -> String {
    let edge = EdgeCoefficients::between([4096 << 10, 0], [4096 << 10, 4096 << 10]);
    let e = edge.at(0, 0);
    let [plain, biased] =
        [e, e + top_left_bias(&edge)].map(|value| Rounding::Floor.shift_right(value, 10).0);
    let fits = |value| if Word::checked(Bits::<35>, value).is_some() { "yes" } else { "no" };
    let name = |value: i128| match value - (1 << 34) {
        0 => "2^34".to_owned(),
        -1 => "2^34-1".to_owned(),
        _ => value.to_string(),
    };
    format!("{} {}, {} {}", name(plain), fits(plain), name(biased), fits(biased))
}
