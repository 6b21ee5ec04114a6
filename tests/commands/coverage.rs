//! The cells of a set: hit, unreachable with a bound, or open.

#[cfg(feature = "cli")]
use crate::run;
use crate::set;
use guardbit::model::{Model, Records};
use guardbit::profile::{Profile, WindowConfig};
use guardbit::vector::manifest::CoverageEntry;
use set::{options, profile, write_set};
use std::collections::BTreeSet;

fn coverage<'m>(made: &'m set::Set, bench: &str) -> &'m CoverageEntry {
    made.manifest.coverage.iter().find(|entry| entry.bench == bench).unwrap()
}

// Clause N-5
#[test]
fn the_default_sets_leave_no_cell_open() {
    for guard in 1..=4 {
        let mut profile = profile("sgi-4k");
        profile.depth.iter_mut().for_each(|depth| depth.guard = guard);
        let made = write_set(&profile, "knot", &options(100_000));
        for entry in &made.manifest.coverage {
            assert_eq!(entry.open, [""; 0], "{guard} guard bits, {}", entry.bench);
        }
        let hit = |cell: &str| {
            let entry = coverage(&made, "triangle");
            entry.cells.iter().any(|hit| hit.cell == cell && hit.rows > 0)
        };
        // What vertices cannot reach, and words do.
        assert!(hit("run.x.4096") && hit("run.y.4096") && hit("cut.left") && hit("E-SE.above.tie"));
        let top = "1".repeat(guard as usize);
        assert!(hit(&format!("N-NE.guard-{top}")));
        let clamped: u128 = made.rows("triangle.exp.tv").iter().map(|row| row[4]).sum();
        assert!(clamped > 40, "{clamped} samples above the range");
    }
}

// Clause X-2
#[test]
fn a_core_of_a_thousand_rows_comes_first_and_no_seed_decides_it() {
    let of = |seed: u64| {
        let options = guardbit::vector::write::Options { seed, ..options(20_000) };
        write_set(&profile("sgi-4k"), "knot", &options)
    };
    let (one, other) = (of(1), of(2));
    for (bench, file) in [("dda", "dda.exp.tv"), ("edge", "edge.exp.tv"), ("setup", "setup.exp.tv")]
    {
        let core = one.manifest.groups.iter().find(|group| group.bench == bench).unwrap();
        assert_eq!(core.tag, "core");
        assert!((400..=1000).contains(&core.rows), "{bench}: {} rows", core.rows);
        let head = |made: &set::Set| {
            made.text(file).lines().take(1000).map(str::to_owned).collect::<Vec<_>>()
        };
        let rows = usize::try_from(core.rows).unwrap();
        assert_eq!(head(&one)[..rows], head(&other)[..rows]);
        // A first record with all bits in use.
        let cfg = one.rows(&file.replace("exp", "cfg")).remove(0);
        assert!(cfg.iter().all(|word| word.count_ones() > 4), "{bench}: {cfg:x?}");
    }
}

/// A toy whose every triangle can be drawn: vertices of 5 x 5, depths of 2 bits.
fn toy(interpolation: u32) -> Profile {
    let mut toy = profile("tiny");
    toy.window = WindowConfig { width: 2, height: 2 };
    toy.vertex.integer = 1;
    toy.depth
        .iter_mut()
        .for_each(|depth| (depth.integer, depth.interpolation) = (2, interpolation));
    toy.validate().unwrap();
    toy
}

/// Ties of the quotients of every triangle, by the names of their cells.
fn every_tie(interpolation: u32) -> BTreeSet<String> {
    let (fraction, sub_pixel, centre) = (interpolation, 1, 1i128);
    let points: Vec<[i128; 2]> = (0..=4).flat_map(|y| (0..=4).map(move |x| [x, y])).collect();
    let mut ties = BTreeSet::new();
    for a in &points {
        for b in &points {
            for c in &points {
                let (bx, by) = (b[0] - a[0], b[1] - a[1]);
                let (cx, cy) = (c[0] - a[0], c[1] - a[1]);
                let area = bx * cy - cx * by;
                if area == 0 {
                    continue;
                }
                for depths in 0..64i128 {
                    let z = [depths & 3, depths >> 2 & 3, depths >> 4];
                    let (zb, zc) = (z[1] - z[0], z[2] - z[0]);
                    let (right, down) = (zb * cy - zc * by, bx * zc - cx * zb);
                    let start = z[0] * area + right * (centre - a[0]) + down * (centre - a[1]);
                    for (name, numerator, scale) in [
                        ("depth_init", start, fraction),
                        ("depth_dx", right, fraction + sub_pixel),
                        ("depth_dy", down, fraction + sub_pixel),
                    ] {
                        let numerator = (numerator * area.signum()) << scale;
                        let (n, d) = (numerator.abs(), area.abs());
                        if 2 * (n % d) == d {
                            let sign = if numerator < 0 { "negative" } else { "positive" };
                            ties.insert(format!("tie.{name}.{sign}.q{}", n / d % 4));
                        }
                    }
                }
            }
        }
    }
    ties
}

// Clause N-5
#[test]
fn of_a_toy_every_triangle_says_the_same() {
    for interpolation in [0, 1, 4] {
        let made = write_set(&toy(interpolation), "triangle", &options(20_000));
        let entry = coverage(&made, "setup");
        let ties: BTreeSet<String> = every_tie(interpolation);
        let mine = |cells: &mut dyn Iterator<Item = &String>| -> BTreeSet<String> {
            cells.filter(|cell| cell.starts_with("tie.")).cloned().collect()
        };
        let hit = mine(&mut entry.cells.iter().map(|cell| &cell.cell));
        let unreachable = mine(&mut entry.unreachable.iter().map(|cell| &cell.cell));
        let open = mine(&mut entry.open.iter());
        assert_eq!(hit, ties, "{interpolation}: what can be hit is hit");
        assert!(open.union(&unreachable).all(|cell| !ties.contains(cell)), "{interpolation}");
        assert_eq!(hit.len() + open.len() + unreachable.len(), 24, "{interpolation}");
        if interpolation == 4 {
            // 2^6 divides no area of at most 16.
            assert!(unreachable.contains("tie.depth_dx.positive.q0"), "{unreachable:?}");
        }
    }
}

// Clause N-14
#[cfg(feature = "cli")]
#[test]
fn a_trace_shows_the_words_behind_each_depth() {
    let home = tempfile::tempdir().unwrap();
    let mut rows = 0;
    for test in ["guard-splits/0", "guard-patterns/9", "box-cuts/3", "slivers/0"] {
        let ran = run::run_in(home.path(), &format!("trace sgi-4k --test triangle/{test}")).ends(0);
        let lines: Vec<&str> = ran.out.lines().collect();
        for pair in lines.windows(2).filter(|pair| pair[1].contains("accumulator guard ")) {
            let depth: u64 = pair[0].rsplit_once("depth=").unwrap().1.parse().unwrap();
            let field = |name: &str| {
                let rest = pair[1].split_once(name).unwrap().1;
                rest.split_whitespace().next().unwrap().trim_end_matches(';')
            };
            // A covered sample: no edge word has its sign bit, and inside the range the integer bits are
            // the depth.
            let edges = pair[1].split_once("edge words ").unwrap().1;
            for edge in edges.split(' ') {
                assert!(u64::from_str_radix(edge, 16).unwrap() >> 34 == 0, "{test}: {edges}");
            }
            let integer = u64::from_str_radix(field("integer "), 2).unwrap();
            match field("guard ") {
                "00" => assert_eq!(integer, depth, "{test}: {pair:?}"),
                "01" => assert_eq!(depth, (1 << 24) - 1, "{test}: {pair:?}"),
                // The split lies in the middle of the pattern 10.
                "10" => assert_eq!(depth == 0, integer >> 23 == 1, "{test}: {pair:?}"),
                _ => assert_eq!(depth, 0, "{test}: {pair:?}"),
            }
            rows += 1;
        }
    }
    assert!(rows > 50, "{rows}");
}

/// An engine that reads set-up words another way: its answers to the words of a set.
fn answers(
    made: &set::Set,
    covers: &dyn Fn([i128; 3]) -> bool,
    reads: &dyn Fn(i128) -> i128,
) -> Vec<Vec<u128>> {
    let signed = |word: u128, width: u32| (word << (128 - width)).cast_signed() >> (128 - width);
    let mut rows = Vec::new();
    for cfg in made.rows("triangle.cfg.tv") {
        let [y0, y1, x0, x1] = [14, 15, 16, 17].map(|k: usize| cfg[k].cast_signed());
        if cfg[13] == 1 {
            continue;
        }
        for y in y0..y1 {
            for x in x0..x1 {
                let at = |first: usize, width: u32| {
                    let [init, dx, dy] = [0, 1, 2].map(|k| signed(cfg[first + k], width));
                    let value = init + dx * x + dy * y;
                    value << (128 - width) >> (128 - width)
                };
                if covers([1, 4, 7].map(|first| at(first, 35))) {
                    let depth = reads(at(10, 39) & ((1 << 39) - 1));
                    rows.push(
                        [cfg[0], y.cast_unsigned(), x.cast_unsigned(), depth.cast_unsigned()]
                            .to_vec(),
                    );
                }
            }
        }
    }
    rows
}

type Covers = fn([i128; 3]) -> bool;

// Clause X-5
#[test]
fn an_engine_shows_what_vertices_hide() {
    let made = write_set(&profile("sgi-4k"), "knot", &options(100_000));
    let golden = made.rows("depth.exp.tv");
    let inside = |edges: [i128; 3]| edges.iter().all(|edge| *edge >= 0);
    let (whole, middle) = (1i128 << 24, (1i128 << 25) + (1 << 23));
    let read = |u: i128, whole: i128, middle: i128| match u {
        _ if u < whole => u,
        _ if u < middle => (1 << 24) - 1,
        _ => 0,
    };
    let right = |acc: i128| read(acc >> 13, whole, middle);
    assert_eq!(answers(&made, &inside, &right), golden);
    // Engines of their own copies of the clamp, which no bench of a DDA sees.
    let wrong: [(&str, &dyn Fn(i128) -> i128); 5] = [
        ("no upper clamp", &|acc| if acc >> 13 < middle { acc >> 13 & ((1 << 24) - 1) } else { 0 }),
        ("a sign decode", &|acc| if acc >> 38 == 1 { 0 } else { (acc >> 13).min((1 << 24) - 1) }),
        ("a split one late", &|acc| read(acc >> 13, whole, middle + 1)),
        ("a split one early", &|acc| read(acc >> 13, whole, middle - 1)),
        ("a clamp one late", &|acc| if acc >> 13 == whole { 0 } else { right(acc) }),
    ];
    for (what, reads) in wrong {
        assert_ne!(answers(&made, &inside, reads), golden, "{what}");
    }
    let edges: [(&str, Covers); 3] = [
        ("edge 1 unseen", |e| e[0] >= 0 && e[2] >= 0),
        ("edge 2 tested above zero", |e| e[0] >= 0 && e[1] >= 0 && e[2] > 0),
        ("edge 0 by the bit below", |e| e[0] >> 33 & 1 == 0 && e[1] >= 0 && e[2] >= 0),
    ];
    for (what, covers) in edges {
        assert_ne!(answers(&made, &covers, &right), golden, "{what}");
    }
    // Numbers in too few bits, and a column or row too many or too few at each side.
    let spans = made.rows("span.exp.tv");
    let boxes: std::collections::BTreeMap<u128, Vec<u128>> =
        made.rows("triangle.cfg.tv").into_iter().map(|cfg| (cfg[0], cfg[14..].to_vec())).collect();
    for bits in 1..=12 {
        let cut = spans.iter().filter(|span| span[3] - span[2] >= 1 << bits).count();
        assert!(cut > 0, "a run length in {bits} bits");
    }
    for side in ["left", "right", "top", "bottom"] {
        let touches = spans.iter().filter(|span| {
            let sides = &boxes[&span[0]];
            match side {
                "left" => span[2] == sides[2],
                "right" => span[3] == sides[3],
                "top" => span[1] == sides[0],
                _ => span[1] + 1 == sides[1],
            }
        });
        assert!(touches.count() > 10, "{side}");
    }
}

// Clause X-6
#[test]
fn registers_have_words_that_no_host_writes() {
    for name in ["ps1", "psp", "voodoo", "virge", "n64", "vortex"] {
        let made = write_set(&profile(name), "knot", &options(20_000));
        let cfg = made.rows("words.cfg.tv");
        let class = |tag: &str| {
            let mut first = 0;
            for group in &made.manifest.groups {
                if group.tag == tag {
                    return &cfg[first..first + usize::try_from(group.tests).unwrap()];
                }
                first += usize::try_from(group.tests).unwrap();
            }
            panic!("{name}: no class {tag}")
        };
        let model = Model::new(&profile(name)).unwrap();
        let input = &model.registers().unwrap().input;
        let fields = (0..input.len()).flat_map(|word| {
            input.fields(word).iter().map(move |field| (word + 1, field.at, field.width))
        });
        let (mut ends, mut bits, mut all_bits) = (0, 0, 0);
        for (word, at, width) in fields.clone() {
            let has = |tag: &str, value: u128| {
                let mask = (1u128 << width) - 1;
                usize::from(class(tag).iter().any(|row| row[word] >> at & mask == value))
            };
            ends += has("register-ends", 0) + has("register-ends", (1 << width) - 1);
            bits += (0..width).map(|bit| has("register-bits", 1 << bit)).sum::<usize>();
            all_bits += usize::try_from(width).unwrap();
        }
        // A test that would draw more than 1024 records has the host's words in its place.
        let count = fields.clone().count();
        assert!(10 * ends >= 2 * 9 * count, "{name}: {ends} of {} ends", 2 * count);
        assert!(10 * bits >= 9 * all_bits, "{name}: {bits} of {all_bits} bits");
        for tag in ["register-window", "register-pairs", "register-words", "random"] {
            assert!(class(tag).len() >= count.min(70), "{name} {tag}: {}", class(tag).len());
        }
        // Places in sub-pixels: the corner of a pixel and its sample, at 7/16.
        if name == "psp" {
            for end in ["left", "top", "right", "bottom"] {
                let word = 1 + input.word_names().iter().position(|word| word == end).unwrap();
                let at = |place: u128| {
                    let mut values = class("register-window").iter().map(|row| row[word]);
                    values.any(|value| value & 15 == place && (16..1 << 16).contains(&value))
                };
                assert!(at(0) && at(7), "{end}");
            }
        }
        // A clip rectangle inside of what is drawn: some tests of a host's words lose pixels by it.
        let clipped = class("register-window").iter().filter(|row| {
            let words: Vec<u32> =
                row[1..].iter().map(|word| u32::try_from(*word).unwrap()).collect();
            let mut records = Records::up_to(2000);
            model.draw(&words[..], &mut records).unwrap();
            assert!(records.total <= 1024, "{name}");
            records.total > 0
        });
        assert!(clipped.count() > count, "{name}");
    }
}
