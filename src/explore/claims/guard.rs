//! Guard bits: the lecture's table and its generalisation, and how many are needed.

use super::edge_word::inside;
use super::plane::{depths, toy_triangles};
use super::statement::Statement;
use crate::bits::{Event, Rounding};
use crate::format::{Clamp, ReadOut};
use crate::setup::{Division, Gradient, Plane, Triangle};

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "guard.table-1",
            "lecture A's table: one guard bit above two integer bits, values -2 to 5 (patterns 110, \
             111, 000 to 101); the row labels of the lecture are swapped, its pseudo-code is right",
            "0 0 0 1 2 3 3 3",
            || table(1, 2, -2..=5),
        ),
        Statement::exact(
            "guard.table-2",
            "two guard bits above two integer bits, decoded from the top three bits: 000 and 001 \
             pass, 010 011 100 give the maximum, 101 110 111 give 0; patterns 0000 to 1111",
            "0 1 2 3 3 3 3 3 3 3 0 0 0 0 0 0",
            || table(2, 2, 0..=15),
        ),
        Statement::exact(
            "guard.smallest-case",
            "vertices A (5.5,.5) z 0, B (8.5,.5) z 1, C (5.5,3.5) z 0, floor, F = 13: accumulator \
             at A, its read-out with one guard bit, its read-out without guard bits",
            format!("-4, 0, {}", (1 << 24) - 1),
            smallest_case,
        ),
        Statement::exact(
            "guard.one-suffices",
            "number of read-outs at covered centres that differ from an unlimited clamp with 1 \
             guard bit, floor / nearest, and whether any read-out differs without guard bits; over \
             every triangle and depth for (k,s,d) = (2,1,1), F = 3",
            "0 / 0, some / some",
            || {
                let [floor, nearest] = wrong_reads([Rounding::Floor, Rounding::NearestEven]);
                let some = |n: u32| if n > 0 { "some" } else { "none" };
                let without = [floor[0], nearest[0]].map(some);
                format!("{} / {}, {} / {}", floor[1], nearest[1], without[0], without[1])
            },
        )
        .slow(),
        Statement::exact(
            "guard.multisample",
            "depth at the pixel centre of a multisampled thin triangle with the whole depth range, \
             where the centre is 1/2 pixel beyond its edge along the gradient: width in 1/1024 \
             pixel of the widest triangle that wraps, for g = 1 to 4 guard bits; it is below \
             2t/(2^g - 1) = 1024/1, 1024/3, 1024/7, 1024/15",
            "1023, 341, 146, 68",
            || (1..=4).map(widest_wrap).collect::<Vec<_>>().join(", "),
        ),
    ]
}

fn table(guard: u32, integer: u32, values: std::ops::RangeInclusive<i128>) -> String {
    ReadOut::new(guard, integer, 0, Clamp::Guard).map_or_else(
        |error| error.to_string(),
        |read| values.map(|v| read.read(v).to_string()).collect::<Vec<_>>().join(" "),
    )
}

fn smallest_case() -> String {
    let triangle = Triangle { xy: [[11, 1], [17, 1], [11, 7]], z: None };
    let gradient = Gradient::new(&triangle, [0, 1, 0]);
    let plane = Plane::round(&gradient, [1, 1], 1, 13, Rounding::Floor, Division::Quotient);
    let accumulator = plane.at(5, 0).raw();
    let reads = [1, 0].map(|guard| {
        ReadOut::new(guard, 24, 13, Clamp::Guard)
            .map_or_else(|error| error.to_string(), |read| read.read(accumulator).to_string())
    });
    format!("{accumulator}, {}, {}", reads[0], reads[1])
}

/// For each rounding, covered centres read wrongly with no and with one guard bit.
fn wrong_reads(roundings: [Rounding; 2]) -> [[u32; 2]; 2] {
    let mut wrong = [[0; 2]; 2];
    let [Ok(none), Ok(one), Ok(endless)] = [0, 1, 60].map(|g| ReadOut::new(g, 1, 3, Clamp::Guard))
    else {
        return [[u32::MAX; 2]; 2];
    };
    for triangle in toy_triangles(2, 1) {
        let covered: Vec<[i128; 2]> = (0..16)
            .map(|n| [n % 4, n / 4])
            .filter(|[x, y]| inside(&triangle, [2 * x + 1, 2 * y + 1]))
            .collect();
        if covered.is_empty() {
            continue;
        }
        for z in depths(1) {
            let gradient = Gradient::new(&triangle, z);
            for (rounding, wrong) in roundings.into_iter().zip(&mut wrong) {
                let plane = Plane::round(&gradient, [1, 1], 1, 3, rounding, Division::Quotient);
                for [x, y] in &covered {
                    let value = plane.at(*x, *y).raw();
                    let right = endless.read(value);
                    wrong[0] += u32::from(none.read(value) != right);
                    wrong[1] += u32::from(one.read(value) != right);
                }
            }
        }
    }
    wrong
}

/// The widest sliver, in sub-pixels of 1/1024, whose centre half a pixel beyond it wraps.
fn widest_wrap(guard: u32) -> String {
    let Ok(read) = ReadOut::new(guard, 24, 13, Clamp::Guard) else {
        return "no such read-out".to_owned();
    };
    let wraps = |width: &i128| {
        // z rises from 0 to the maximum over `width`; the pixel's centre is 512 further on.
        let right = 512;
        let triangle =
            Triangle { xy: [[right - width, 0], [right, 0], [right - width, 4096]], z: None };
        let gradient = Gradient::new(&triangle, [0, (1 << 24) - 1, 0]);
        let sample = [right + 512, 512];
        let plane =
            Plane::round(&gradient, sample, 10, 13, Rounding::NearestEven, Division::Quotient);
        read.status(plane.start().raw()).has(Event::Wrap)
    };
    (1..=2048).filter(wraps).max().map_or("none".to_owned(), |width| width.to_string())
}
