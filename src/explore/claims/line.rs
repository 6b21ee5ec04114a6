//! Lines: the midpoint walk, diamonds, and integer edge coherence.

use super::statement::Statement;
use crate::bits::Rounding;
use crate::exact::{edge_x, ratio, round};
use std::cmp::Ordering;

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "line.midpoint",
            "lecture S, line (10,10) to (20,17): values of d0, dE, dNE",
            "4, 14, -6",
            || {
                let [d0, east, north_east] = midpoint_steps(10, 7);
                format!("{d0}, {east}, {north_east}")
            },
        ),
        Statement::exact(
            "line.decisions",
            "decision variable of the line of line.midpoint, with a step NE on zero (as in the code \
             of the lecture; its figure steps E at (14,13)), and the pixel after (14,13)",
            "4 -2 12 6 0 -6 8 2 -4 10, (15,14)",
            decisions,
        ),
        Statement::exact(
            "line.tie",
            "exact y of the line of line.midpoint at x = 15",
            "27/2",
            || exact_y(15, 0).map_or("none".to_owned(), |y| y.to_string()),
        ),
        Statement::exact(
            "line.diamond-d3d",
            "line (10,10) to (20,17) between pixel centres with the diamond of Direct3D (its two \
             lower edges and its bottom corner belong to it): rows of columns 10 to 19",
            "10 11 11 12 13 13 14 15 16 16",
            || diamonds(0, true),
        ),
        Statement::exact(
            "line.diamond-vulkan",
            "the line of line.diamond-d3d moved by -(e, e^2), e = 2^-20, which is the perturbation \
             of Vulkan and GL",
            "10 11 11 12 13 14 14 15 16 16",
            || diamonds(20, false),
        ),
        Statement::exact(
            "line.integer-offset",
            "lecture S's integer line, which starts at floor(dx/2), against the midpoint algorithm \
             with ties to NE, for every line of slope 0 to 1 with dx <= 40; number of different \
             pixels",
            "0",
            || {
                (1..=40)
                    .flat_map(|dx| (0..=dx).map(move |dy| (dx, dy)))
                    .map(offset_differs)
                    .sum::<usize>()
            },
        ),
        Statement::exact(
            "line.circle",
            "lecture M's circle with the threshold y - 1 instead of a constant, R = 10, second \
             octant",
            "(0,10)(1,10)(2,10)(3,10)(4,9)(5,9)(6,8)(7,7)",
            || circle(10),
        ),
        Statement::exact(
            "line.edge-coherence",
            "lecture S's integer edge walk with dX/dY = 5/2 over three rows: its rule (one step at \
             most, and only if sum > dY) against a loop with >=",
            "3, 7",
            || format!("{}, {}", coherence(5, 2, 3, false), coherence(5, 2, 3, true)),
        ),
    ]
}

/// Start value and both increments for a line of slope dy/dx between 0 and 1.
const fn midpoint_steps(dx: i128, dy: i128) -> [i128; 3] {
    [2 * dy - dx, 2 * dy, 2 * (dy - dx)]
}

/// Rows that the midpoint walk with tie to NE visits, and its decisions.
fn midpoint(dx: i128, dy: i128) -> (Vec<i128>, Vec<i128>) {
    let [mut d, east, north_east] = midpoint_steps(dx, dy);
    let (mut rows, mut seen, mut y) = (vec![0], Vec::new(), 0);
    for _ in 0..dx {
        seen.push(d);
        if d >= 0 {
            y += 1;
            d += north_east;
        } else {
            d += east;
        }
        rows.push(y);
    }
    (rows, seen)
}

fn decisions() -> String {
    let (rows, seen) = midpoint(10, 7);
    let texts: Vec<String> = seen.iter().map(ToString::to_string).collect();
    format!("{}, (15,{})", texts.join(" "), 10 + rows[5])
}

/// y of the line (10,10) to (20,17) at column x, moved by -(e, e^2) with e = 2^-`epsilon`
/// (0 for no move).
fn exact_y(x: i128, epsilon: u32) -> Option<crate::exact::Rational> {
    // Units of e^2, so that the moved ends are integers; x and y change places.
    let unit = 1_i128 << (2 * epsilon);
    let [e, e2] = if epsilon == 0 { [0, 0] } else { [1 << epsilon, 1] };
    let end = |x: i128, y: i128| [y * unit - e2, x * unit - e];
    Some(edge_x(end(10, 10), end(20, 17), x * unit)? / ratio(unit, 1)?)
}

/// The row lit in each column by the diamonds around pixel centres.
///
/// Up to 45 degrees a line inside a column's diamond is inside it at the column's centre, within
/// half a pixel of the row's centre; at exactly half it touches a corner.
fn diamonds(epsilon: u32, bottom_corner: bool) -> String {
    let lit = |x| {
        let y = exact_y(x, epsilon)?;
        let row = round(&y, Rounding::Floor);
        let above = y - num_rational::Ratio::from_integer(row.clone());
        let next = match above.cmp(&ratio(1, 2)?) {
            Ordering::Less => false,
            Ordering::Greater => true,
            // The bottom corner of the upper pixel is the top corner of the lower one.
            Ordering::Equal => !bottom_corner,
        };
        Some((row + i32::from(next)).to_string())
    };
    (10..20).map(|x| lit(x).unwrap_or_default()).collect::<Vec<_>>().join(" ")
}

fn offset_differs((dx, dy): (i128, i128)) -> usize {
    let (rows, _) = midpoint(dx, dy);
    let (mut sum, mut y) = (dx / 2, 0);
    let mut differing = 0;
    for row in rows {
        differing += usize::from(row != y);
        sum += dy;
        if sum >= dx {
            sum -= dx;
            y += 1;
        }
    }
    differing
}

/// Pixels of a circle's second octant, down to the diagonal.
fn circle(radius: i128) -> String {
    let (mut x, mut y, mut e) = (0, radius, 0);
    let mut pixels = Vec::new();
    while x <= y {
        pixels.push(format!("({x},{y})"));
        e += 2 * x + 1;
        x += 1;
        if e > y - 1 {
            e -= 2 * y - 1;
            y -= 1;
        }
    }
    pixels.concat()
}

fn coherence(dx: i128, dy: i128, rows: u32, corrected: bool) -> i128 {
    let (mut x, mut sum) = (0, 0);
    for _ in 0..rows {
        sum += dx;
        if corrected {
            while sum >= dy {
                x += 1;
                sum -= dy;
            }
        } else if sum > dy {
            x += 1;
            sum -= dy;
        }
    }
    x
}
