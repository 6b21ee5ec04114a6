//! Edge functions over quads.

use super::{model, records, word, wrap};
use guardbit::model::Model;

const VERTICES: &str = "radix = 10
input = [\"x0:4\", \"y0:4\", \"x1:4\", \"y1:4\", \"x2:4\", \"y2:4\", \"left:5\", \"top:5\", \"right:5\", \"bottom:5\"]
records = [{ letter = \"P\", words = [\"x\", \"y\", \"e0\", \"e1\", \"e2\"] }]
[form.registers.engine.quads]
edges = \"vertices\"
emit = \"pixels\"
";

/// Clauses RG-5 and RG-6: all triangles on a lattice of 5 x 5, with words that hold every value and with
/// words that wrap, by both rules.
#[test]
fn vertices_by_both_rules() {
    for (width, rule) in [(5, "both"), (5, "truncated-side"), (9, "both"), (9, "truncated-side")] {
        let text = format!("{VERTICES}width = {width}\nrule = \"{rule}\"\n");
        let model = model(4, 1, [1, 0], &text);
        let places: Vec<[i128; 2]> = (0..25).map(|n| [n % 5 - 1, n / 5]).collect();
        let mut drawn = 0;
        for n in 0..25usize.pow(3) {
            let v = [places[n % 25], places[n / 25 % 25], places[n / 625]];
            let mut expected = Vec::new();
            // The range [0, 5] in halves holds pixels 0 to 2 at x = 1, 3, 5 and y = 0, 2, 4.
            for y in 0..3 {
                for x in columns(v, y - y % 2, width) {
                    let at = [2 * x + 1, 2 * y];
                    let edge = |p: [i128; 2], q: [i128; 2]| {
                        wrap((q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]), width)
                    };
                    let sides = [(v[1], v[2], v[0]), (v[2], v[0], v[1]), (v[0], v[1], v[2])];
                    let inside = sides.iter().all(|(p, q, t)| {
                        let right = if p[1] == q[1] {
                            t[1] < p[1]
                        } else {
                            // Truncating, and wrapping as the words do.
                            let product = wrap((q[0] - p[0]) * (t[1] - p[1]), width);
                            t[0] < wrap(p[0] + product / wrap(q[1] - p[1], width), width)
                        };
                        let bias = i128::from(rule == "truncated-side" && right);
                        wrap(edge(*p, *q) - bias, width) >= 0
                    });
                    if inside {
                        let e = sides.map(|(p, q, _)| i64::try_from(edge(p, q)).unwrap());
                        expected.push(vec![
                            i64::try_from(x).unwrap(),
                            i64::try_from(y).unwrap(),
                            e[0],
                            e[1],
                            e[2],
                        ]);
                    }
                }
            }
            let mut words: Vec<u32> = v.iter().flatten().map(|value| word(*value)).collect();
            words.extend([0, 0, 5, 5]);
            let got: Vec<Vec<i64>> = records(&model, &words).into_iter().map(|r| r.1).collect();
            assert_eq!(got, expected, "{v:?} {width} {rule}");
            drawn += got.len();
        }
        assert!(drawn > 5000, "{drawn}");
    }
}

/// The columns of 0 to 2 that clause RG-5 leaves of the row of quads at pixel row `y`: samples at x = 1, 3, 5 and 7
/// halves, and quads of 4 halves.
fn columns(v: [[i128; 2]; 3], y: i128, width: u32) -> std::ops::Range<i128> {
    let (mut low, mut high) = (0, 5);
    for (p, q) in [(v[1], v[2]), (v[2], v[0]), (v[0], v[1])] {
        let edge =
            |x: i128, y: i128| wrap((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]), width);
        let (x, y) = (1, 2 * y);
        let most = [edge(x, y), edge(x + 2, y), edge(x, y + 2), edge(x + 2, y + 2)];
        let most = most.into_iter().max().unwrap();
        let step = wrap(4 * (p[1] - q[1]), width);
        if most < 0 && step <= 0 {
            return 0..0;
        } else if most < 0 {
            low = low.max(wrap(4 * (-most / step), width));
        } else if step < 0 {
            high = high.min(wrap(4 * (-most / step + 1), width));
        }
    }
    // A quad begins at a multiple of 4 halves within the closed range, and its columns end with the range.
    let first = low / 2;
    let end = if high < 0 { 0 } else { 3.min((high / 4 + 1) * 2) };
    first..end
}

/// Clause RG-5: a case of the oracle. The true triangle covers samples of the range, and the edge words wrap: every row
/// of quads is found empty.
#[test]
fn rows_whose_edge_words_wrap_are_left_out() {
    let model = Model::new(&guardbit::profile::load("psp").unwrap()).unwrap();
    let words = [30364, 35516, 9930, 337, 41801, 45086, 60832, 4832, 61151, 5151].map(word);
    assert_eq!(records(&model, &words), []);
}

/// Clause RG-5: `left`, `top`, `right` and `bottom` have 17 bits, one more than a vertex. Pixel 4095 of row 0 has its
/// sample at (65527, 7), left of the vertical edge at 65535; the range ends at 65551.
#[test]
fn a_range_reaches_beyond_the_last_vertex() {
    let model = Model::new(&guardbit::profile::load("psp").unwrap()).unwrap();
    let words = [65000, 0, 65535, 0, 65535, 1000, 65520, 0, 65551, 15].map(word);
    let got: Vec<Vec<i64>> = records(&model, &words).into_iter().map(|r| r.1).collect();
    // Edge values at the sample: v1 v2, v2 v0, v0 v1.
    assert_eq!(got, [[4095, 0, 8000, 535 * 993 - 8000, 535 * 7]]);
}

/// Clause RG-7: every pair of steps of one edge that fits four bits, from every start that fits seven, over
/// a tile of 8 halved to blocks of 2: a quad is drawn if a pixel of it is inside and none of the nodes that
/// hold it was left out.
#[test]
fn descent_of_one_edge() {
    let text = "radix = 16
input = [\"tile_x\", \"tile_y\", \"x_min\", \"x_max\", \"y_min\", \"y_max\",
    \"a0:7\", \"b0:7\", \"c0:7\", \"a1:7\", \"b1:7\", \"c1:7\", \"a2:7\", \"b2:7\", \"c2:7\"]
records = [{ letter = \"Q\", words = [\"x\", \"y\", \"mask\", \"e0_0\"] }]
[form.registers.engine.quads]
edges = { given = { fraction = 0 } }
width = 7
rule = \"both\"
emit = \"quads\"
descent = { tile = 8, block = 2 }
";
    let model = model(4, 1, [1, 0], text);
    let (mut drawn, mut lost) = (0, 0);
    for n in 0..16 * 16 * 128 {
        let (a, b, c) = (n % 16 - 8, n / 16 % 16 - 8, n / 256 - 64);
        let value = |x: i128, y: i128| wrap(c + a * x + b * y, 7);
        let extent = wrap((a.max(0) + b.max(0)) * 8, 7).rem_euclid(128);
        let mut expected = Vec::new();
        for y in 0..4 {
            for x in 0..4 {
                let pixels = [(0, 0), (1, 0), (0, 1), (1, 1)];
                let mask = pixels.iter().enumerate().fold(0, |mask, (bit, (dx, dy))| {
                    mask | i64::from(value(2 * x + dx, 2 * y + dy) >= 0) << bit
                });
                let kept = (0..3).all(|level| {
                    let size = 8 >> level;
                    let (cx, cy) = (2 * x / size * size, 2 * y / size * size);
                    wrap(value(cx, cy) + (extent >> level), 7) >= 0
                });
                lost += u32::from(mask != 0 && !kept);
                if mask != 0 && kept {
                    let number = |value: i128| i64::try_from(value).unwrap();
                    expected.push(vec![number(x), number(y), mask, number(value(2 * x, 2 * y))]);
                }
            }
        }
        let mut words = vec![0, 0, 0, 8, 0, 8];
        for edge in [[a, b, c], [0, 0, 0], [0, 0, 0]] {
            words.extend(edge.map(word));
        }
        let got: Vec<Vec<i64>> =
            records(&model, &words).into_iter().map(|record| record.1[..4].to_vec()).collect();
        assert_eq!(got, expected, "{a} {b} {c}");
        drawn += got.len();
    }
    // The extent wraps often in 7 bits: what that loses is part of the clause.
    assert!(drawn > 100_000 && lost > 1000, "{drawn} {lost}");
}

/// Clauses RG-5 and RG-7: with words that hold every value, halving tiles and writing quads change nothing in what
/// is drawn: all triangles on a lattice of 5 x 5 once more.
#[test]
fn descent_and_quads_draw_the_same_pixels() {
    let rest = "width = 12\nrule = \"truncated-side\"\n";
    let plain = model(4, 1, [1, 0], &format!("{VERTICES}{rest}"));
    let quads = VERTICES
        .replace("emit = \"pixels\"", "emit = \"quads\"")
        .replace("\"e0\", \"e1\", \"e2\"", "\"mask\"");
    let descent = "descent = { tile = 4, block = 2 }\n";
    let others = [
        model(4, 1, [1, 0], &format!("{quads}{rest}")),
        model(4, 1, [1, 0], &format!("{quads}{rest}{descent}")),
        model(4, 1, [1, 0], &format!("{VERTICES}{rest}{descent}")),
    ];
    let pixels = |model: &guardbit::model::Model, words: &[u32]| {
        let record = &model.registers().unwrap().records[0];
        let drawn = records(model, words);
        let mut pixels: Vec<[i64; 2]> =
            drawn.iter().flat_map(|(_, values)| record.pixels(values)).collect();
        pixels.sort_unstable();
        pixels
    };
    let mut drawn = 0;
    for n in 0..25u32.pow(3) {
        let v = [n % 25, n / 25 % 25, n / 625].map(|n| [n % 5, n / 5]);
        let mut words: Vec<u32> = v.into_iter().flatten().collect();
        words.extend([0, 0, 5, 5]);
        let expected = pixels(&plain, &words);
        for (kind, other) in others.iter().enumerate() {
            assert_eq!(pixels(other, &words), expected, "{v:?}, kind {kind}");
        }
        drawn += expected.len();
    }
    assert!(drawn > 5000, "{drawn}");
}
