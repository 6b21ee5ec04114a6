//! Four sub-scanlines a row.

use super::{model, records, word, wrap};
use guardbit::model::Model;

fn toy(product: &str, distance: bool, sign: &str) -> Model {
    let text = format!(
        "radix = 16
input = [\"yl:14\", \"ym:14\", \"yh:14\", \"xl:28\", \"xl_step:30\", \"xh:28\", \"{sign}\", \"xm:28\",
    \"xm_step:30\", \"rightward\", \"scissor_xh:12\", \"scissor_yh:12\", \"scissor_xl:12\", \"scissor_yl:12\",
    \"r\", \"r_dx\", \"r_de\", \"r_dy\", \"z\", \"z_dx\", \"z_de\", \"z_dy\"]
records = [
    {{ letter = \"S\", words = [\"y\"] }}, {{ letter = \"P\", words = [\"x\"] }},
]
channels = [
    {{ names = [\"r\"], guard = 1, integer = 8, interpolation = 16, clamp = \"guard\", width = 32, drop = 5, \
         correction = 2 }},
    {{ names = [\"z\"], guard = 1, integer = 18, interpolation = 13, clamp = \"guard\", correction = 3 }},
]
[form.registers.engine.sub-scanlines]
product = \"{product}\"
signed-distance = {distance}
depth = \"z\"
"
    );
    model(11, 2, [2, 2], &text)
}

/// Words of upright sides: x of the long and the short one in 2^-16 pixels, the sub-scanlines, channels.
fn upright(
    long: i128,
    short: i128,
    [from, to]: [i128; 2],
    rightward: bool,
    r: [i128; 4],
) -> Vec<u32> {
    let mut words: Vec<u32> = [to, to, from, short, 0, long, 0, short, 0].map(word).to_vec();
    words.extend([u32::from(rightward), 0, 0, 40, 40]);
    words.extend(r.map(word));
    words.extend([5 << 13, 0, 0, 0].map(word));
    words
}

/// Clauses RG-15, RG-16 and RG-17: all pairs of sides in eighths of a pixel over three pixels, moved by less than an
/// eighth, by every first and last sub-scanline of a row. A sample is covered where it lies between them.
#[test]
fn coverage_is_that_of_eight_points() {
    let model = toy("wrap", false, "xh_step:30");
    let mut drawn = 0;
    for n in 0..24 * 24 * 10 * 2 * 2 {
        let [left, right] = [n % 24, n / 24 % 24].map(|side| i128::try_from(side).unwrap());
        let rows: Vec<[i128; 2]> =
            (0..4).flat_map(|from| (from + 1..=4).map(move |to| [from, to])).collect();
        let [from, to] = rows[n / 576 % 10];
        let (rightward, below) = (n / 5760 % 2 == 0, n / 11520 == 1);
        // A little more than eighths: the sticky bit says so.
        let more = if below { 0x40 } else { 0 };
        let (a, b) = ((left << 13) + more, (right << 13) + more);
        let (long, short) = if rightward { (a, b) } else { (b, a) };
        let words = upright(long, short, [from, to], rightward, [0; 4]);
        let got: Vec<(i64, i64, i64)> = records(&model, &words)
            .into_iter()
            .filter(|(kind, _)| *kind == 1)
            .map(|(_, values)| {
                assert_eq!(values[8], values[7] >> 7 & 1, "the first sample");
                (values[0], values[2], values[7])
            })
            .collect();
        // Sides in sixteenths of a pixel; samples at quarters.
        let sixteenths = |eighths: i128| 2 * eighths + i128::from(below);
        // Sticky: an x above an even eighth counts as the odd one, and an odd one has its bit set.
        let seen = |eighths: i128| if below { eighths | 1 } else { eighths };
        let mut expected = Vec::new();
        let (first, last) = (seen(left) >> 3, seen(right) >> 3);
        if left >> 1 <= right >> 1 {
            for x in first..=last {
                let (mut count, mut mask) = (0, 0);
                for sub in from..to {
                    for column in (0..4).filter(|column| (column + sub) % 2 == 0) {
                        let at = 16 * x + 4 * column;
                        let covered = i64::from(sixteenths(left) <= at && at < sixteenths(right));
                        count += covered;
                        // Bits 7 and 5, 6 and 4, 3 and 1, 2 and 0.
                        mask |= covered << (3 - column + if sub < 2 { 4 } else { 0 });
                    }
                }
                expected.push((i64::try_from(x).unwrap(), count, mask));
            }
        }
        if !rightward {
            expected.reverse();
        }
        // Where sides cross nothing is drawn; within a quarter of a pixel the order is not told.
        assert_eq!(got, expected, "{left} {right} {from} {to} {rightward} {below}");
        drawn += got.len();
    }
    assert!(drawn > 10_000, "{drawn}");
}

/// Clause RG-18: a product keeps its low bits, or its sign and the low 31; the distance to the scissor has a
/// sign or not; the sign of the slope is its own or a register.
#[test]
fn values_by_both_datapaths() {
    let own = toy("wrap", false, "xh_step:30 long_sign:1@31");
    let resized = toy("resize", true, "xh_step:30");
    let mut differ = 0;
    for n in 0..4096i128 {
        // A long side far left of the scissor, or right of it where rows run left.
        let rightward = n % 2 == 0;
        let pixel = n / 2 % 64 * 33 - 1000;
        let slope = (n / 128 - 16) * 0x0761_4321;
        let (long, short) = if rightward { (pixel, 4) } else { (pixel, 2) };
        let words = upright(
            wrap(long << 16 | 0x5500, 28),
            short << 16,
            [0, 4],
            rightward,
            [77 << 16, slope, 0, 0],
        );
        for (model, resize) in [(&own, false), (&resized, true)] {
            let along = slope.div_euclid(32) * 32;
            // The slope of the side is 0: its sign is clear, and an offset is taken where rows run left.
            let cut = |product: i128| {
                if !resize {
                    return product;
                }
                let kept = product.rem_euclid(1 << 31);
                if product < 0 { kept - (1 << 31) } else { kept }
            };
            let back = cut((along >> 8 & !1) * 0x55);
            let start = wrap(((77 << 16) - back) & !0x3ff, 32);
            let drawn = records(model, &words);
            let Some((_, line)) = drawn.iter().find(|(kind, _)| *kind == 0) else { continue };
            assert_eq!(i128::from(line[4]), start, "{n} {resize}");
            let first = i128::from(line[2]);
            let distance = if rightward { first - pixel } else { pixel - first };
            let seen = if resize { wrap(distance, 12) } else { distance.rem_euclid(4096) };
            let run = if rightward { along } else { -along };
            let value = wrap(start + cut(run * seen), 32);
            let (_, whole) = &drawn[1];
            if whole[2] == 8 {
                let read = value.rem_euclid(1 << 25) >> 16;
                let read = if read < 256 {
                    read
                } else if read < 384 {
                    255
                } else {
                    0
                };
                assert_eq!(i128::from(whole[5]), read, "{n} {resize}");
                differ += i32::from(resize);
            }
        }
    }
    assert!(differ > 500, "{differ}");
}

/// Clause RG-18: at every first covered sample, a value moves there by the slopes of column and sub-scanline.
#[test]
fn values_at_the_first_covered_sample() {
    let model = toy("wrap", false, "xh_step:30");
    let (mut partly, mut seen) = (0, std::collections::BTreeSet::new());
    for left in 0..8i128 {
        for from in 0..4 {
            let [r, dx, dy] = [100 << 16, 9 << 16, -(13 << 16)];
            let words = upright(left << 13, 4 << 16, [from, 4], true, [r, dx, 0, dy]);
            let drawn = records(&model, &words);
            let (_, pixel) = &drawn[1];
            // The first covered sample of pixel 0, row by row.
            let first = (from..4)
                .flat_map(|sub| (0..4).map(move |column| (column, sub)))
                .find(|(column, sub)| (column + sub) % 2 == 0 && 2 * column >= left);
            let Some((column, sub)) = first.filter(|_| pixel[2] < 8) else { continue };
            // The row starts where the side is: sign clear, row to the right, so without an offset.
            let back = (dx >> 8 & !1) * (left << 5);
            let start = (r - back) & !0x3ff;
            let quarter = |value: i128| value.div_euclid(1 << 14);
            let held =
                (quarter(start) * 4 + column * quarter(dx) + sub * quarter(dy)).div_euclid(16);
            assert_eq!(i128::from(pixel[5]), held, "{left} {from}");
            partly += 1;
            seen.insert((column, sub));
        }
    }
    assert!(partly > 25 && seen.len() >= 6, "{partly} {seen:?}");
}

/// Clause RG-18: a row to the left turns the sign of a slope in the 32 bits of the slope, so -2^31 stays -2^31. The
/// product with a distance of 2 then keeps a negative sign above 31 bits of 0, and moves z = 5 to -2^31 + 5 codes,
/// which the guard clamp reads as the largest depth. Each further pixel adds 2^31 mod 2^32.
#[test]
fn the_lowest_slope_keeps_its_sign_to_the_left() {
    for product in ["resize", "wrap"] {
        let model = toy(product, true, "xh_step:30");
        // The long side at pixel 5, cut by a scissor that ends at pixel 3: the distance is 2.
        let mut words = upright(5 << 16, 1 << 16, [0, 4], false, [0; 4]);
        words[12] = 3 << 2;
        let z_dx = words.len() - 3;
        words[z_dx] = 1 << 31;
        let got: Vec<(i64, i64)> = records(&model, &words)
            .into_iter()
            .filter(|(kind, _)| *kind == 1)
            .map(|(_, values)| (values[0], values[6]))
            .collect();
        let far = (1 << 18) - 1;
        // A product that wraps is -2^32, which is 0: z begins at 5 there.
        let expected = if product == "resize" { [far, 5, far] } else { [5, far, 5] };
        assert_eq!(got, [3, 2, 1].into_iter().zip(expected).collect::<Vec<_>>(), "{product}");
    }
}

/// Clause RG-17: what hardware without antialiasing does not write. The sides of this fill triangle are x = 225 and
/// x = 225 - (row - 50); at row 99 the left one is 176 less a quarter for each sub-scanline. So of pixel 175 the sample
/// at the corner is outside, and four are inside.
#[test]
fn a_pixel_whose_first_sample_is_outside() {
    let text = guardbit::profile::BUILTIN.iter().find(|(name, _)| *name == "n64").unwrap().1;
    let text = text.replace(
        "\"coverage:8 slope_code:24@8\"",
        "\"coverage:8 coverage_mask:8@8 first_sample:1@16\"",
    );
    let model = Model::new(&guardbit::profile::parse(&text, "n64").unwrap()).unwrap();
    let input = &model.registers().unwrap().input;
    let mut words = vec![0; input.len()];
    for (name, value) in [
        ("yl", 400),
        ("ym", 400),
        ("yh", 200),
        ("xl", 175 << 16),
        ("xh", 225 << 16),
        ("xm", 225 << 16),
        ("xm_step", -1 << 16),
        ("scissor_xl", 4092),
        ("scissor_yl", 4092),
    ] {
        input.find(name).unwrap().scatter(value, &mut words);
    }
    let drawn = records(&model, &words);
    let (_, pixel) =
        drawn.iter().find(|(kind, values)| *kind == 1 && values[..2] == [175, 99]).unwrap();
    let [mask, first] = [pixel.len() - 2, pixel.len() - 1].map(|at| pixel[at]);
    // Columns of a quarter from 175.75, 175.5 and 175.25 on; every second one counts.
    assert_eq!((pixel[2], mask, first), (4, 0b0001_0111, 0));
}
