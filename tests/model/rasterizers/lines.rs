//! Lines by steppers of parts, fills between them, and fans of them.

use super::profiles::refused;
use super::{model, records, word};
use guardbit::cover::{Stepper, Tie, bresenham, midpoint};
use guardbit::model::Model;
use guardbit::profile::{load, neighbours};

type Pixel = [i128; 2];

/// The pixels of records, in their order, and the values `line` and `filler`.
fn drawn(model: &Model, corners: &[Pixel]) -> Vec<[i64; 4]> {
    let words: Vec<u32> = corners.iter().flatten().map(|at| word(*at)).collect();
    let list = records(model, &words).into_iter();
    list.map(|(_, values)| values.try_into().unwrap()).collect()
}

fn pixels(model: &Model, corners: &[Pixel]) -> Vec<Pixel> {
    drawn(model, corners).into_iter().map(|r| [r[0], r[1]].map(i128::from)).collect()
}

/// A toy profile of so many vertices of 6 bits, and an engine with these fields.
fn toy(corners: usize, more: &str, engine: &str) -> Model {
    let input: Vec<String> = (0..corners).map(|n| format!("\"x{n}:6\", \"y{n}:6\"")).collect();
    let input = input.join(", ");
    let registers = format!(
        "radix = 10\ninput = [{input}{more}]\n\
         records = [{{ letter = \"P\", words = [\"x %d\", \"y %d\", \"line\", \"filler\"] }}]\n\
         [form.registers.engine.lines]\n{engine}"
    );
    model(5, 0, [0, 0], &registers)
}

fn stepper(text: &str) -> Stepper {
    #[derive(serde::Deserialize)]
    struct Table {
        stepper: Stepper,
    }
    toml::from_str::<Table>(text).unwrap_or_else(|error| panic!("{error}\n{text}")).stepper
}

fn walked(stepper: &Stepper, ends: [Pixel; 2]) -> Vec<Pixel> {
    let mut found = Vec::new();
    stepper.walk(ends, &mut |at| found.push(at));
    found
}

const MAJOR: &str =
    "{ major = { start = \"-n\", gain = \"2m\", when = \"e > 0\", loss = \"2n\" } }";
const SHARED: &str = "{ shared = { start = \"w - h\", looks = \"together\", \
                      x = { when = \"2e >= -h\", gain = \"-h\" }, y = { when = \"2e <= w\", gain = \"w\" } } }";

/// All ends of a small window, from one point and from another one.
fn all_ends() -> impl Iterator<Item = [Pixel; 2]> {
    let points = (0..13 * 13).map(|n| [n % 13 - 6, n / 13 - 6]);
    points.flat_map(|to| [[[0, 0], to], [to, [1, -2]]])
}

/// Pixel i of a line that rounds its minor coordinate: ties to the larger number of steps, or the smaller.
fn rounded([a, b]: [Pixel; 2], up: bool) -> Vec<Pixel> {
    let d = [b[0] - a[0], b[1] - a[1]];
    let steep = d[1].abs() > d[0].abs();
    let (n, m) = if steep { (d[1].abs(), d[0].abs()) } else { (d[0].abs(), d[1].abs()) };
    let at = |i: i128| {
        // m i / n to nearest.
        let doubled = 2 * m * i;
        let minor = if n == 0 {
            0
        } else if up {
            (doubled + n) / (2 * n)
        } else {
            (doubled + n - 1) / (2 * n)
        };
        let [x, y] = if steep { [minor, i] } else { [i, minor] };
        [a[0] + d[0].signum() * x, a[1] + d[1].signum() * y]
    };
    (0..=n).map(at).collect()
}

/// Clauses RL-2, RL-3 and RL-4: an error word rounds to nearest; its comparison decides the tie. A shared error
/// word draws the same line as the midpoint algorithm with its tie to the north-east.
#[test]
fn steppers_round_the_minor_coordinate() {
    let east = stepper(&format!("stepper = {MAJOR}"));
    let north = stepper(&format!("stepper = {}", MAJOR.replace("e > 0", "e >= 0")));
    // One more than 0 is at least 1; the test may come before the gain, as in the midpoint algorithm.
    let as_one = stepper(&format!("stepper = {}", MAJOR.replace("e > 0", "e >= 1")));
    let halves =
        "{ major = { start = \"n/2 - n\", gain = \"m\", when = \"e >= 0\", loss = \"n\" } }";
    let halves = stepper(&format!("stepper = {halves}"));
    let shared = stepper(&format!("stepper = {SHARED}"));
    let narrow = stepper(&format!("stepper = {}", MAJOR.replace("\"2n\" }", "\"2n\", bits = 6 }")));
    let mut ties = 0;
    for ends in all_ends() {
        let [down, up] = [false, true].map(|up| rounded(ends, up));
        assert_eq!(walked(&east, ends), down, "{ends:?}");
        assert_eq!(walked(&as_one, ends), down, "{ends:?}");
        assert_eq!(walked(&north, ends), up, "{ends:?}");
        assert_eq!(walked(&halves, ends), up, "{ends:?}");
        assert_eq!(walked(&shared, ends), up, "{ends:?}");
        // |e| <= 2n <= 16: six bits hold it.
        assert_eq!(walked(&narrow, ends), down, "{ends:?}");
        let (mut b, mut m) = (Vec::new(), Vec::new());
        bresenham(ends, &mut |p| b.push(p));
        midpoint(ends, Tie::NorthEast, &mut |_| (), &mut |p| m.push(p));
        assert_eq!((b, m), (down.clone(), up.clone()), "{ends:?}");
        ties += i32::from(down != up);
    }
    assert!(ties > 40, "{ties}");
    // -n = -6 and 2m = 10 in four bits: 4, then 4 - 12 = -8, 2, 2 - 12 = -10, which is 6 in four bits.
    let four = stepper(&format!("stepper = {}", MAJOR.replace("\"2n\" }", "\"2n\", bits = 4 }")));
    assert_eq!(walked(&four, [[0, 0], [6, 5]])[..3], [[0, 0], [1, 1], [2, 2]]);
    // The third step: 6 + 10 = 16 is 0 in four bits, which is not above 0.
    assert_eq!(walked(&four, [[0, 0], [6, 5]])[3], [3, 2]);
}

/// Clause RL-4: the second test sees what the first coordinate has left, or it does not; a line that moves nothing,
/// or misses its end, ends.
#[test]
fn tests_of_a_shared_error_word_look_together_or_in_turn() {
    for looks in ["together", "x-first", "y-first"] {
        let walker = stepper(&format!("stepper = {}", SHARED.replace("together", looks)));
        for ends in all_ends() {
            let [[mut x, mut y], b] = ends;
            let (w, h) = ((b[0] - x).abs(), (b[1] - y).abs());
            let (sx, sy) = ((b[0] - x).signum(), (b[1] - y).signum());
            let (mut e, mut expected) = (w - h, vec![[x, y]]);
            while [x, y] != b && i128::try_from(expected.len()).unwrap() <= w + h {
                let (move_x, move_y) = match looks {
                    "together" => (2 * e >= -h, 2 * e <= w),
                    "x-first" => {
                        let x = 2 * e >= -h;
                        (x, 2 * (e - if x { h } else { 0 }) <= w)
                    }
                    _ => {
                        let y = 2 * e <= w;
                        (2 * (e + if y { w } else { 0 }) >= -h, y)
                    }
                };
                if move_x {
                    (x, e) = (x + sx, e - h);
                }
                if move_y {
                    (y, e) = (y + sy, e + w);
                }
                expected.push([x, y]);
            }
            assert_eq!(walked(&walker, ends), expected, "{looks} {ends:?}");
        }
    }
    let still = SHARED.replace("2e >= -h", "e > w").replace("2e <= w", "e < -h");
    assert_eq!(walked(&stepper(&format!("stepper = {still}")), [[0, 0], [3, 2]]), [[0, 0]]);
    let past = SHARED.replace("2e >= -h", "0 >= 0").replace("2e <= w", "0 > 0");
    // Three and two: at most five steps, and x is at its end after the third.
    let line = walked(&stepper(&format!("stepper = {past}")), [[0, 0], [3, 2]]);
    assert_eq!(line, [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]]);
}

/// Clause RL-6: coordinates that gain a rounded slope, against the same in exact sixteenths.
#[test]
fn slopes_are_rounded_once_and_added() {
    let text = "stepper = { slope = { fraction = 4, rounding = \"away-from-zero\", x-bias = 7, y-bias = 8 } }";
    let slope = stepper(text);
    for ends in all_ends() {
        let [a, b] = ends;
        let n = (b[0] - a[0]).abs().max((b[1] - a[1]).abs());
        let away = |d: i128| if n == 0 { 0 } else { d.signum() * ((d.abs() * 16 + n - 1) / n) };
        let at = |i: i128, axis: usize, bias: i128| {
            (a[axis] * 16 + bias + i * away(b[axis] - a[axis])).div_euclid(16)
        };
        let expected: Vec<Pixel> = (0..=n).map(|i| [at(i, 0, 7), at(i, 1, 8)]).collect();
        assert_eq!(walked(&slope, ends), expected, "{ends:?}");
    }
}

/// Clause RL-12: the three probes of the hardware, and what the other tie would have drawn.
#[test]
fn playstation_lines_pass_through_the_probes() {
    let model = Model::new(&load("ps1-line").unwrap()).unwrap();
    for (ends, hit, missed) in [
        ([[0, 0], [10, 3]], [5, 2], [5, 1]),
        ([[0, 3], [10, 0]], [5, 1], [5, 2]),
        ([[0, 0], [3, 10]], [1, 5], [2, 5]),
    ] {
        // From either end.
        for ends in [ends, [ends[1], ends[0]]] {
            let line = pixels(&model, &ends);
            assert_eq!((line.contains(&hit), line.contains(&missed)), (true, false), "{ends:?}");
            assert_eq!(line.len(), 11, "{ends:?}");
        }
    }
    // The longest line keeps its ends: 1023 roundings stay below the bias of x.
    let line = pixels(&model, &[[-300, -512], [211, 511]]);
    assert_eq!((line[0], line[1023]), ([-300, -512], [211, 511]));
}

/// Clauses RL-1 and RL-7: which end comes first, which pixel comes last, and the pixel between two that touch at a
/// corner.
#[test]
fn ends_last_pixels_and_fillers() {
    let filler = "filler = { alike = \"x\", unlike = \"y\", place = \"after\" }";
    // (2, 1) and (4, 2) are reached by a diagonal step.
    let plain = [[0, 0], [1, 0], [2, 1], [3, 1], [4, 2]];
    let line = |fields: &str, corners: &[Pixel]| {
        drawn(&toy(2, "", &format!("draws = \"line\"\n{fields}\nstepper = {MAJOR}\n")), corners)
    };
    let places = |list: Vec<[i64; 4]>| list.iter().map(|r| [r[0], r[1]]).collect::<Vec<_>>();
    let ends = [[0, 0], [4, 2]];
    assert_eq!(places(line("", &ends)), plain);
    assert_eq!(places(line("last = \"left-out\"", &ends)), plain[..4]);
    // Both rise: x has moved and y has not.
    let with = [[0, 0, 0], [1, 0, 0], [2, 1, 0], [2, 0, 1], [3, 1, 0], [4, 2, 0], [4, 1, 1]];
    let flagged = |list: Vec<[i64; 4]>| list.iter().map(|r| [r[0], r[1], r[3]]).collect::<Vec<_>>();
    assert_eq!(flagged(line(filler, &ends)), with);
    // The last pixel goes with its filler after it; a filler before it stays.
    assert_eq!(flagged(line(&format!("{filler}\nlast = \"left-out\""), &ends)), with[..5]);
    let before = filler.replace("after", "before");
    let early = [[0, 0, 0], [1, 0, 0], [2, 0, 1], [2, 1, 0], [3, 1, 0], [4, 1, 1], [4, 2, 0]];
    assert_eq!(flagged(line(&before, &ends)), early);
    assert_eq!(flagged(line(&format!("{before}\nlast = \"left-out\""), &ends)), early[..6]);
    // One falls: y has moved and x has not.
    let mirrored =
        [[0, 0, 0], [1, 0, 0], [2, -1, 0], [1, -1, 1], [3, -1, 0], [4, -2, 0], [3, -2, 1]];
    assert_eq!(flagged(line(filler, &[[0, 0], [4, -2]])), mirrored);
    // From the other end a tie goes the other way, unless the ends are sorted.
    let back = [[4, 2], [3, 2], [2, 1], [1, 1], [0, 0]];
    assert_eq!(places(line("", &[[4, 2], [0, 0]])), back);
    assert_eq!(places(line("ends = \"by-x\"", &[[4, 2], [0, 0]])), plain);
    assert_eq!(places(line("ends = \"by-y\"", &[[4, 2], [0, 0]])), plain);
    assert_eq!(
        places(line("ends = \"by-x\"", &[[0, 2], [4, 0]])),
        [[0, 2], [1, 2], [2, 1], [3, 1], [4, 0]]
    );
    assert_eq!(
        places(line("ends = \"by-y\"", &[[0, 2], [4, 0]])),
        [[4, 0], [3, 0], [2, 1], [1, 1], [0, 2]]
    );
}

/// Clause RL-11: pixels outside a clip rectangle are left out and counted in no way; its right and lower ends are
/// inside or not.
#[test]
fn a_clip_rectangle_is_closed_or_half_open() {
    for (clip, last) in [("closed", 3), ("half-open", 2)] {
        let more = ", \"left\", \"top\", \"right\", \"bottom\"";
        let model =
            toy(2, more, &format!("draws = \"line\"\nclip = \"{clip}\"\nstepper = {MAJOR}\n"));
        let words = [0, 1, 6, 1, 1, 0, 3, 5].map(word);
        let x: Vec<i64> = records(&model, &words).iter().map(|(_, values)| values[0]).collect();
        assert_eq!(x, (1..=last).collect::<Vec<i64>>(), "{clip}");
        let above = [0, 1, 6, 1, 1, 2, 3, 5].map(word);
        assert!(records(&model, &above).is_empty(), "{clip}");
    }
}

/// Clauses RL-8 and RL-9: every triangle of a lattice of 5 x 5, all ends of spans and all middle rows.
#[test]
fn fills_between_lines() {
    for (end, middle) in [
        ("first", "both-ahead"),
        ("first", "both"),
        ("last", "upper"),
        ("outermost", "lower"),
        ("outermost", "both"),
    ] {
        let engine = format!(
            "draws = {{ fill = {{ sort = [[0, 2], [0, 1], [1, 2]], span-end = \"{end}\", middle = \"{middle}\" }} }}
ends = \"by-y\"
stepper = {SHARED}
"
        );
        let model = toy(3, "", &engine);
        let mut total = 0;
        for n in 0..25usize.pow(3) {
            let at = |n: usize| [i128::try_from(n % 5).unwrap(), i128::try_from(n / 5).unwrap()];
            let v = [at(n % 25), at(n / 25 % 25), at(n / 625)];
            let got = pixels(&model, &v);
            assert_eq!(got, filled(v, end, middle), "{v:?} {end} {middle}");
            total += got.len();
        }
        assert!(total > 50_000, "{total}");
    }
}

fn filled(mut v: [Pixel; 3], end: &str, middle: &str) -> Vec<Pixel> {
    for (i, j) in [(0, 2), (0, 1), (1, 2)] {
        if v[i][1] > v[j][1] {
            v.swap(i, j);
        }
    }
    let [top, mid, bottom] = v;
    // What a line has in a row, in its order.
    let row = |a: Pixel, b: Pixel, y: i128| -> Vec<i128> {
        let line = rounded([a, b], true).into_iter();
        line.filter(|p| p[1] == y).map(|p| p[0]).collect()
    };
    let mut found = Vec::new();
    for y in top[1]..=bottom[1] {
        let long = row(top, bottom, y);
        let upper = if y <= mid[1] { row(top, mid, y) } else { Vec::new() };
        let lower = if y >= mid[1] { row(mid, bottom, y) } else { Vec::new() };
        let at_middle = y == mid[1];
        let mut shorts = Vec::new();
        if !(at_middle && middle == "lower") {
            shorts.push(upper);
        }
        if !at_middle || matches!(middle, "lower" | "both") {
            shorts.push(lower);
        }
        for short in shorts.into_iter().filter(|short| !short.is_empty()) {
            let ends = match end {
                "first" => vec![long[0], short[0]],
                "last" => vec![long[long.len() - 1], short[short.len() - 1]],
                _ => [long.clone(), short].concat(),
            };
            let (a, b) = (*ends.iter().min().unwrap(), *ends.iter().max().unwrap());
            found.extend((a..=b).map(|x| [x, y]));
        }
        if at_middle && middle == "both-ahead" && y < bottom[1] {
            let (a, b) = (row(top, bottom, y + 1)[0], mid[0]);
            found.extend((a.min(b)..=a.max(b)).map(|x| [x, y]));
        }
    }
    found
}

/// Clauses RL-5 and RL-10: every quadrilateral of a lattice of 3 x 3, and larger ones at random.
#[test]
fn quads_are_lines_between_two_edges() {
    let model = Model::new(&load("saturn-quad").unwrap()).unwrap();
    let mut total = 0;
    for n in 0..9i128.pow(4) {
        let at = |n: i128| [n % 9 % 3 * 2, n % 9 / 3];
        let v = [at(n), at(n / 9), at(n / 81), at(n / 729)];
        let got = drawn(&model, &v);
        assert_eq!(got, fan(v), "{v:?}");
        total += got.len();
    }
    for n in 0..400 {
        let mut words = guardbit::case::Words::new(7, 0, n);
        let v: [Pixel; 4] =
            std::array::from_fn(|_| std::array::from_fn(|_| words.between(-20, 20)));
        assert_eq!(drawn(&model, &v), fan(v), "{v:?}");
    }
    assert!(total > 50_000, "{total}");
}

/// x, y, number of the line, and whether the pixel is a filler.
fn fan([a, b, c, d]: [Pixel; 4]) -> Vec<[i64; 4]> {
    let longest = |p: Pixel, q: Pixel| (q[0] - p[0]).abs().max((q[1] - p[1]).abs());
    let greatest = longest(a, d).max(longest(b, c));
    let edge = |p: Pixel, q: Pixel| {
        let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
        let (w, h, n) = (dx.abs(), dy.abs(), longest(p, q));
        let back = if h > w { dy < 0 } else { dx < 0 };
        let (mut pace, mut ex, mut ey) = (-greatest - 1, -n - 1, -n - 1);
        let (mut at, mut list) = (p, vec![p]);
        for _ in 0..greatest {
            pace += 2 * n;
            if pace >= -i128::from(back) {
                pace -= 2 * greatest;
                (ex, ey) = (ex + 2 * w, ey + 2 * h);
                if ex >= -i128::from(dy < 0) {
                    (at[0], ex) = (at[0] + dx.signum(), ex - 2 * n);
                }
                if ey >= -i128::from(dx < 0) {
                    (at[1], ey) = (at[1] + dy.signum(), ey - 2 * n);
                }
            }
            list.push(at);
        }
        list
    };
    let mut found = Vec::new();
    for (number, (left, right)) in (0..).zip(edge(a, d).into_iter().zip(edge(b, c))) {
        let mut before: Option<Pixel> = None;
        for at in rounded([left, right], false) {
            let record = |p: Pixel, filler: i64| {
                let [x, y] = p.map(|p| i64::try_from(p).unwrap());
                [x, y, number, filler]
            };
            found.push(record(at, 0));
            if let Some(before) = before.filter(|p| p[0] != at[0] && p[1] != at[1]) {
                let alike = (at[0] > before[0]) == (at[1] > before[1]);
                found.push(record(if alike { [at[0], before[1]] } else { [before[0], at[1]] }, 1));
            }
            before = Some(at);
        }
    }
    found
}

/// Clause RL-11: a host gives a line the three edges of a triangle, and a fan its third vertex twice.
#[test]
fn what_a_host_writes() {
    let lists = |name: &str| {
        let model = Model::new(&load(name).unwrap()).unwrap();
        let xy = [[1, 2], [30, 4], [5, 60]];
        let triangle = guardbit::scene::Triangle::Lattice { xy, z: None };
        model.host(&model.snap(&triangle).unwrap())
    };
    assert_eq!(lists("projf-line"), [[1, 2, 30, 4], [30, 4, 5, 60], [5, 60, 1, 2]]);
    assert_eq!(lists("projf-fill"), [[1, 2, 30, 4, 5, 60]]);
    assert_eq!(lists("saturn-quad"), [[1, 2, 30, 4, 5, 60, 5, 60]]);
}

/// Clause RL-2: a text that is no sum, and a part that has no meaning, are refused with what to write instead.
#[test]
fn what_has_no_meaning_is_refused() {
    refused(&[
        ("saturn-line", "\"2m\"", "\"2q\"", "\"2q\" is not a sum"),
        ("saturn-line", "\"2m\"", "\"\"", "\"\" is not a sum"),
        ("saturn-line", "\"2m\"", "\"n m\"", "is not a sum"),
        ("saturn-line", "\"2m\"", "\"n - - m\"", "is not a sum"),
        ("saturn-line", "\"2m\"", "\"m/0\"", "is not a sum"),
        ("saturn-line", "\"2m\"", "\"65537m\"", "both 1 to 65536"),
        ("saturn-line", "\"2m\"", "\"e\"", "the name \"e\" has no meaning here"),
        ("saturn-line", "\"2m\"", "\"max\"", "the name \"max\" has no meaning here"),
        ("saturn-line", "\"e >= 1\"", "\"e\"", "\"e\" is not a test"),
        (
            "saturn-line",
            "loss = \"2n\"",
            "loss = \"2n\"\nbits = 65",
            "bits = 65: an error word has 2 to 64",
        ),
        ("saturn-line", "sub-pixel = 0", "sub-pixel = 2", "between whole pixels, 0 is needed"),
        (
            "saturn-line",
            "draws = \"line\"",
            "draws = \"line\"\nclip = \"closed\"",
            "needs a register \"left\"",
        ),
        ("saturn-line", "\"x1:13\"", "\"x1:13 z:4@16\"", "has no register \"z\""),
        (
            "saturn-quad",
            "[[0, 3], [1, 2]]",
            "[[0, 3], [1, 1]]",
            "each of the vertices 0 to 3 is needed once",
        ),
        (
            "projf-fill",
            "[[0, 2], [0, 1], [1, 2]]",
            "[[0, 2], [0, 1]]",
            "are left in the order [0, 1, 0]",
        ),
        ("projf-fill", "[[0, 2], ", "[[0, 3], ", "vertices 0 to 2 are needed"),
        ("projf-fill", "ends = \"by-y\"", "last = \"left-out\"", "has no effect"),
        (
            "ps1-line",
            "x-bias = ",
            "x-bias = 0x100000000 # ",
            "x-bias = 4294967296: 0 <= x-bias < 2^fraction",
        ),
        ("ps1-line", "fraction = 32", "fraction = 41", "1 <= fraction <= 40"),
    ]);
}

/// Clause RL-11: the decisions that a diagnosis tries, each one a profile that is valid and draws something else.
#[test]
fn neighbours_of_lines_are_profiles() {
    for (name, wanted) in [
        (
            "projf-line",
            vec!["stepper.shared.looks", "stepper.shared.x.when", "ends", "last", "filler"],
        ),
        ("projf-fill", vec!["draws.fill.middle", "draws.fill.span-end", "draws.fill.sort"]),
        ("saturn-line", vec!["filler.alike", "filler.place", "stepper.major.when"]),
        ("saturn-quad", vec!["draws.fan.pace.when", "draws.fan.edge.own.x.start", "filler.unlike"]),
        ("ps1-line", vec!["stepper.slope.rounding", "stepper.slope.x-bias"]),
    ] {
        let profile = load(name).unwrap();
        let all = neighbours(&profile);
        for part in wanted {
            let field = format!("engine.lines.{part} is ");
            let found = all.iter().filter(|other| other.change.contains(&field));
            let changed = found.filter(|other| other.profile.form != profile.form);
            let valid = changed.map(|other| Model::new(&other.profile).map(|_| ()));
            let valid = valid.collect::<Result<Vec<()>, _>>().unwrap();
            assert!(!valid.is_empty(), "{name}: {field}");
        }
    }
}

/// Clause RG-23: words that take longer than the caller allows are refused at once, with the numbers.
#[test]
fn endless_words_are_refused() {
    let model = Model::new(&load("projf-fill").unwrap()).unwrap();
    let words = [-32768, -32768, 32767, 32767, -32768, 32767].map(word);
    let mut few = guardbit::model::Records::up_to(1024);
    let error = model.draw(words.as_slice(), &mut few).unwrap_err().to_string();
    // 65537 rows of 65536 pixels: the middle row may be drawn twice.
    assert_eq!(error, "the words take up to 4295032832 steps, but at most 67108864 are allowed");
}
