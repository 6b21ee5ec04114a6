//! Edges by their slopes, one row at a time.

use super::{model, records, word, wrap};

/// A pixel and the values of a record.
fn numbers(list: &[i128]) -> Vec<i64> {
    list.iter().map(|number| i64::try_from(*number).unwrap()).collect()
}

/// Clauses RG-11, RG-13 and RG-14: every triangle of 12 places, both directions, clipped and not, with a
/// channel at the first vertex, moved to its pixel or not.
#[test]
fn divided_edges() {
    let text = "radix = 16
input = [\"xa:6\", \"ya:6\", \"xb:6\", \"yb:6\", \"xc:6\", \"yc:6\", \"leftward\", \"adjust\", \"clip\",
    \"clip_left\", \"clip_right\", \"clip_top\", \"clip_bottom\", \"z\", \"z_dx\", \"z_dy\", \"w\", \"w_dx\", \"w_dy\",
    \"w_buffer\", \"depth_biased\", \"depth_bias:8\", \"flip\", \"height\"]
records = [{ letter = \"P\", words = [\"x\", \"y\", \"z\", \"depth\", \"w_float\"] }]
channels = [
    { names = [\"z\"], guard = 2, integer = 4, interpolation = 3, clamp = \"sign\" },
    { names = [\"w\"], guard = 0, integer = 64, interpolation = 0, clamp = \"wrap\", shift = 2 },
]
[form.registers.engine.slopes]
edges = { divided = { fraction = 4, row-bias = 1 } }
pixel-bias = 7
plane = { at-vertex = {} }
clip = \"half-open\"
depth = { integer = \"z\", w-float = \"w\" }
";
    let model = model(4, 2, [2, 2], text);
    let places: Vec<[i128; 2]> =
        (0..12).map(|n| [[-3, 0, 6, 9][n % 4], [-2, 3, 9][n / 4]]).collect();
    let mut drawn = 0;
    for n in 0..12usize.pow(3) * 8 {
        let v = [places[n % 12], places[n / 12 % 12], places[n / 144 % 12]];
        let flags = n / 1728;
        let [leftward, adjust, clip] = [0, 1, 2].map(|bit| flags >> bit & 1 == 1);
        let [start, dx, dy] = [21, 5, -9];
        let mut words: Vec<u32> = v.iter().flatten().map(|at| word(*at)).collect();
        words.extend([leftward, adjust, clip].map(u32::from));
        words.extend([0, 2, 0, 2].map(word));
        words.extend([start, dx, dy, 0, 0, 0].map(word));
        // A depth of z less 3, upside down in a window of 5 rows.
        words.extend([0, 1, word(-3) & 0xff, 1, 5]);
        let got: Vec<Vec<i64>> = records(&model, &words).into_iter().map(|r| r.1).collect();
        let expected = twin(v, leftward, adjust, clip, [start, dx, dy]);
        // Record values: x, y, z, w, w_float, depth.
        let got: Vec<Vec<i64>> = got.iter().map(|r| vec![r[0], r[1], r[2], r[5]]).collect();
        assert_eq!(got, expected, "{v:?} {leftward} {adjust} {clip}");
        drawn += got.len();
    }
    assert!(drawn > 2000, "{drawn}");
}

fn twin(
    [a, b, c]: [[i128; 2]; 3],
    leftward: bool,
    adjust: bool,
    clip: bool,
    [start, dx, dy]: [i128; 3],
) -> Vec<Vec<i64>> {
    let slope = |p: [i128; 2], q: [i128; 2]| {
        let (along, height) = (q[0] - p[0], q[1] - p[1]);
        if height == 0 { 0 } else { along * 16 / height }
    };
    // Two sub-pixel bits, four of x: x moves up by two and products down by two.
    let x_at = |p: [i128; 2], slope: i128, centre: i128| {
        p[0] * 4 + (slope * (centre - p[1])).div_euclid(4)
    };
    let pixel = |x: i128| (x + 7).div_euclid(16);
    let first_row = (a[1] + 1).div_euclid(4);
    let part = |at: i128| {
        let fraction = at.rem_euclid(4);
        2 - fraction + if fraction > 2 { 4 } else { 0 }
    };
    let moved = if adjust { wrap(part(a[0]) * dx + part(a[1]) * dy, 9).div_euclid(4) } else { 0 };
    let mut found = Vec::new();
    for y in first_row..(c[1] + 1).div_euclid(4) {
        let centre = 4 * y + 2;
        let long = pixel(x_at(a, slope(a, c), centre));
        let short = pixel(if centre < b[1] {
            x_at(a, slope(a, b), centre)
        } else {
            x_at(b, slope(b, c), centre)
        });
        let (left, right) = if leftward { (short, long) } else { (long, short) };
        let mut row: Vec<i128> = (left..right).filter(|x| !clip || (0..2).contains(x)).collect();
        if leftward {
            row.reverse();
        }
        for x in row.into_iter().filter(|_| !clip || (0..2).contains(&y)) {
            let held = start + moved + (x - pixel(a[0] * 4)) * dx + (y - first_row) * dy;
            let z = wrap(held, 9).clamp(0, 127).div_euclid(8);
            found.push(numbers(&[x, 4 - y, z, (z - 3).clamp(0, 15)]));
        }
    }
    found
}

/// Clauses RG-12 and RG-13: every start, end and slope of a few bits, both directions, up and down, a channel
/// that starts on the side.
#[test]
fn given_edges() {
    for rows in ["up", "down"] {
        let text = format!(
            "radix = 16
input = [\"x:6\", \"y:6\", \"x_step:6\", \"end01:6\", \"end01_step:6\", \"end12:6\", \"end12_step:6\",
    \"rightward\", \"rows01\", \"rows12\", \"clip_left\", \"clip_right\", \"clip_top\", \"clip_bottom\",
    \"c:6\", \"c_dx:6\", \"c_dy:6\"]
records = [{{ letter = \"P\", words = [\"x\", \"y\", \"c\"] }}]
channels = [{{ names = [\"c\"], guard = 2, integer = 3, interpolation = 2, clamp = \"sign\" }}]
[form.registers.engine.slopes]
edges = {{ given = {{ fraction = 3, rows = \"{rows}\" }} }}
pixel-bias = 7
plane = {{ at-edge = {{ fraction = 2 }} }}
clip = \"closed\"
"
        );
        let model = model(4, 3, [0, 0], &text);
        let down = if rows == "down" { 1 } else { -1 };
        let mut drawn = 0;
        for n in 0..24 * 24 * 4 * 4 * 2 {
            let (x, end) = (n % 24 - 4, n / 24 % 24 - 4);
            let (step, end_step) =
                ([-5, 0, 3, 8][n_of(n / 576 % 4)], [-2, 0, 1, 7][n_of(n / 2304 % 4)]);
            let rightward = n / 9216 == 1;
            let [start, dx, dy] = [9, -7, 4];
            let mut words: Vec<u32> =
                [x, 1, step, end, end_step, 4, -end_step].into_iter().map(word).collect();
            words.extend([u32::from(rightward), 2, 1, 0, 2, 0, 6]);
            words.extend([start, dx, dy].map(word));
            let mut expected = Vec::new();
            for row in 0..3 {
                let (long, y) = (x + step * row, 1 + down * row);
                let short = if row < 2 { end + end_step * row } else { 4 };
                let ceiling = |x: i128| (x + 7).div_euclid(8);
                // How far the first pixel is, in quarters, an edge on a pixel one eighth away.
                let fraction = (long - 1).rem_euclid(8) / 2;
                let part = if rightward { 4 - fraction } else { fraction };
                let (left, right) = if rightward { (long, short) } else { (short, long) };
                let mut pixels: Vec<i128> = (ceiling(left)..ceiling(right)).collect();
                if !rightward {
                    pixels.reverse();
                }
                for (count, x) in (0..).zip(pixels) {
                    if (0..=2).contains(&x) && (0..=6).contains(&y) {
                        let moved = (dx * part).div_euclid(4) + dx * count;
                        let held = wrap(start + dy * row + moved, 7);
                        expected.push(numbers(&[x, y, held.clamp(0, 31).div_euclid(4)]));
                    }
                }
            }
            let got: Vec<Vec<i64>> = records(&model, &words).into_iter().map(|r| r.1).collect();
            assert_eq!(got, expected, "{rows} {x} {end} {step} {end_step} {rightward}");
            drawn += got.len();
        }
        assert!(drawn > 4000, "{drawn}");
    }
}

fn n_of(number: i128) -> usize {
    usize::try_from(number).unwrap()
}

/// Clauses RG-24 and RG-25: counters of 5 bits that wrap, rows counted from the first one, and a channel at the exact
/// distance from a point, against plain numbers. 64 pixels are 0 pixels more than 32, and 32 more than -32.
#[test]
fn counters_wrap_and_channels_have_a_point() {
    let text = "radix = 16
input = [\"x:8\", \"y:5\", \"x_step:8\", \"end01:8\", \"end01_step:8\", \"end12:8\", \"end12_step:8\",
    \"rightward\", \"rows01:3\", \"rows:3\", \"anchor_x:8\", \"anchor_y:8\", \"c:5\", \"c_dx:5\", \"c_dy:5\"]
records = [{ letter = \"P\", words = [\"x\", \"y\", \"c\"] }]
channels = [{ names = [\"c\"], guard = 2, integer = 3, interpolation = 5, clamp = \"sign\" }]
[form.registers.engine.slopes]
edges = { given = { fraction = 3, rows = \"down\", counts = \"all\" } }
pixel-bias = 7
pixel-bits = 5
plane = { at-point = {} }
";
    let model = model(4, 3, [0, 0], text);
    let without = super::model(4, 3, [0, 0], &text.replace(" \"anchor_y:8\",", ""));
    let (mut wrapped, mut drawn) = (0, 0);
    for n in 0..6 * 6 * 3 * 4 * 5 * 2 {
        let places = [-128, -37, -8, 0, 44, 121];
        let (x, end) = (places[n_of(n % 6)], places[n_of(n / 6 % 6)]);
        let (step, end_step) = ([-9, 0, 14][n_of(n / 36 % 3)], -3);
        // The first short edge has none, some or all of the rows.
        let (rows01, rows) = ([0, 2, 3, 7][n_of(n / 108 % 4)], [1, 2, 3, 5, 0][n_of(n / 432 % 5)]);
        let rightward = n / 2160 == 1;
        let (anchor, top) = ([11, -26], 13);
        let [start, dx, dy] = [-7, 9, -13];
        let list = |anchor: &[i128]| -> Vec<u32> {
            let head = [x, top, step, end, end_step, 16, 5, i128::from(rightward), rows01, rows];
            let all = head.into_iter().chain(anchor.iter().copied()).chain([start, dx, dy]);
            all.map(word).collect()
        };
        let mut twin = |anchor: [i128; 2]| {
            let mut found = Vec::new();
            let all = if rows == 0 { 8 } else { rows };
            for row in 0..all {
                let long = x + step * row;
                let short =
                    if row < rows01 { end + end_step * row } else { 16 + 5 * (row - rows01) };
                let (left, right) = if rightward { (long, short) } else { (short, long) };
                // x has 32 bits here, so only the numbers of pixels wrap.
                let [left, right] = [left, right].map(|x| (x + 7).div_euclid(8));
                let count = (right - left).rem_euclid(32);
                for k in 0..count {
                    let x = wrap(if rightward { left + k } else { right - 1 - k }, 5);
                    let y = wrap(top + row, 5);
                    let held = start * 8 + (8 * x - anchor[0]) * dx + (8 * y - anchor[1]) * dy;
                    let c = match held.rem_euclid(1024) {
                        held if held >= 512 => 0,
                        held if held >= 256 => 7,
                        held => held / 32,
                    };
                    found.push(numbers(&[x, y, c]));
                }
                wrapped += i32::from(left > right && count > 0);
            }
            found
        };
        let expected = twin(anchor);
        let got = |model: &_, words: &[u32]| -> Vec<Vec<i64>> {
            records(model, words).into_iter().map(|r| r.1).collect()
        };
        assert_eq!(got(&model, &list(&anchor)), expected, "{n}");
        drawn += expected.len();
        // Without a register, the point is in the first row.
        let expected = twin([anchor[0], top * 8]);
        assert_eq!(got(&without, &list(&anchor[..1])), expected, "{n}");
    }
    assert!(drawn > 100_000 && wrapped > 1000, "{drawn} {wrapped}");
}
