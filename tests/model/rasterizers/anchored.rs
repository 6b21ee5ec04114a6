//! Exact spans and anchored planes.

use super::{model, records, word, wrap};
use guardbit::bits::Rounding;
use guardbit::exact::{Rule, covers};

/// Vertices of 4 bits with one channel of 6 bits that wraps, and an engine with these fields.
fn registers(engine: &str) -> String {
    format!(
        "radix = 10
input = [\"x0:4\", \"y0:4\", \"c0:4\", \"x1:4\", \"y1:4\", \"c1:4\", \"x2:4\", \"y2:4\", \"c2:4\",
    \"left\", \"top\", \"right\", \"bottom\"]
records = [{{ letter = \"P\", words = [\"x\", \"y\", \"c\"] }}]
channels = [{{ names = [\"c\"], guard = 0, integer = 4, interpolation = 2, clamp = \"wrap\" }}]
[form.registers.engine.anchored]
rounding = \"toward-zero\"
{engine}"
    )
}

/// Clause RG-9: v0 = (4, 0) and v1 = (0, 0) have the same y. A stable sort keeps v0 v1 v2, and the leftmost of these
/// is v2 = (0, 3). The first order of the table that fits is v1 v0 v2, and the leftmost of these is v1. The slope of
/// c is a third, cut to a quarter, so that a row's value depends on the vertex that it is counted from: from v1 it is
/// (2 + y) / 4, and from v2 it is (6 + y - 3) / 4, both floored.
#[test]
fn the_sort_decides_the_anchor() {
    for (sort, rows) in
        [("stable", [(2, 1), (1, 1), (0, 0)]), ("first-match", [(0, 0), (1, 0), (2, 1)])]
    {
        let engine =
            format!("anchor = \"leftmost-sorted\"\nhalves = \"upper-first\"\nsort = \"{sort}\"\n");
        let model = model(4, 0, [0, 0], &registers(&engine));
        let words = [4, 0, 0, 0, 0, 0, 0, 3, 1, 0, 0, 7, 7].map(word);
        let got: Vec<Vec<i64>> = records(&model, &words).into_iter().map(|r| r.1).collect();
        // Ceilings of 4 - 4 y / 3.
        let widths = [4, 3, 2];
        let expected: Vec<Vec<i64>> = rows
            .iter()
            .flat_map(|&(y, c)| (0..widths[y]).map(move |x| vec![x, i64::try_from(y).unwrap(), c]))
            .collect();
        assert_eq!(got, expected, "{sort}");
    }
}

/// Clauses RG-8, RG-9 and RG-10: all triangles on a lattice of 5 x 5, one channel of 6 bits that wraps, both
/// anchors, both orders of the halves and both sorts.
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn every_small_triangle() {
    for (anchor, sort, halves) in [
        ("leftmost-given", "stable", "from-anchor"),
        ("leftmost-sorted", "stable", "upper-first"),
        ("leftmost-sorted", "first-match", "upper-first"),
        ("leftmost-given", "first-match", "upper-first"),
    ] {
        let text = registers(&format!(
            "anchor = \"{anchor}\"
sort = \"{sort}\"
halves = \"{halves}\"
largest = {{ x = 3, y = 9 }}
"
        ));
        let model = model(4, 0, [0, 0], &text);
        let mut drawn = 0;
        for n in 0..25usize.pow(3) {
            let at = |n: usize| [i128::try_from(n % 5).unwrap(), i128::try_from(n / 5).unwrap()];
            let v = [at(n % 25), at(n / 25 % 25), at(n / 625)];
            let values = [1, 15, i128::try_from(n % 16).unwrap()];
            let words: Vec<u32> = (0..3)
                .flat_map(|k| [word(v[k][0]), word(v[k][1]), word(values[k])])
                .chain([0, 0, 7, 7])
                .collect();
            let got: Vec<Vec<i64>> = records(&model, &words).into_iter().map(|r| r.1).collect();
            let expected = twin(
                v,
                values,
                anchor == "leftmost-sorted",
                sort == "first-match",
                halves == "from-anchor",
            );
            assert_eq!(got, expected, "{v:?} {values:?} {anchor} {sort} {halves}");
            drawn += got.len();
        }
        assert!(drawn > 10_000, "{drawn}");
    }
}

/// Pixels by the exact truth, in the order and with the values of the clauses.
fn twin(
    v: [[i128; 2]; 3],
    a: [i128; 3],
    sorted: bool,
    first_match: bool,
    from_anchor: bool,
) -> Vec<Vec<i64>> {
    let far = |p: [i128; 2], q: [i128; 2]| (p[0] - q[0]).abs() > 3;
    if far(v[0], v[1]) || far(v[1], v[2]) || far(v[2], v[0]) {
        return Vec::new();
    }
    // From top to bottom, those of one height as they came.
    let mut order = [0, 1, 2];
    order.sort_by_key(|n: &usize| (v[*n][1], *n));
    if first_match {
        // The order of the table of RG-9; the first that does not fall.
        for candidate in [[0, 1, 2], [2, 1, 0], [2, 0, 1], [1, 2, 0], [1, 0, 2], [0, 2, 1]] {
            let y = candidate.map(|n| v[n][1]);
            if y[0] <= y[1] && y[1] <= y[2] {
                order = candidate;
            }
        }
    }
    let leftmost = |list: [usize; 3]| {
        let x = list.map(|n| v[n][0]);
        let place = if x[2] <= x[1] && x[1] <= x[0] {
            2
        } else if x[1] <= x[0] {
            1
        } else if x[2] < x[0] {
            2
        } else {
            0
        };
        list[place]
    };
    let anchor = leftmost(if sorted { order } else { [0, 1, 2] });
    let place = order.iter().position(|n| *n == anchor).unwrap();
    let area =
        (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
    if area == 0 {
        return Vec::new();
    }
    // Cramer's rule on the vertices as they came: quotients do not know the order.
    let slope = |numerator: i128| Rounding::TowardZero.divide(numerator << 2, area).unwrap().0;
    let (da, db) = (a[1] - a[0], a[2] - a[0]);
    let dx = slope(da * (v[2][1] - v[0][1]) - db * (v[1][1] - v[0][1]));
    let dy = slope((v[1][0] - v[0][0]) * db - (v[2][0] - v[0][0]) * da);
    let middle = v[order[1]][1];
    let row = |y: i128| {
        (0..8).filter(move |x| covers(v, [*x, y], Rule::TopLeft)).map(move |x| {
            let held = (a[anchor] << 2) + 2 + dx * (x - v[anchor][0]) + dy * (y - v[anchor][1]);
            let value = wrap(held, 6).rem_euclid(64) >> 2;
            [x, y, value].map(|number| i64::try_from(number).unwrap()).to_vec()
        })
    };
    let mut upper: Vec<i128> = (0..middle.min(8)).collect();
    let mut lower: Vec<i128> = (middle.max(0)..8).collect();
    if place > 0 {
        upper.reverse();
    }
    if place > 1 {
        lower.reverse();
    }
    let rows = if from_anchor && place > 0 { [lower, upper] } else { [upper, lower] };
    rows.concat().into_iter().flat_map(row).collect()
}
