//! What `vectors` writes, held to its spec by readers and oracles of its own.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::device;
#[cfg(feature = "cli")]
use crate::run;
use crate::set;

use device::{Reader, Stepper, walks};
use guardbit::cover::{DepthAt, EdgeStorage, FillRule, MultisampleConfig};
use guardbit::exact::{self, Point, Rule};
use guardbit::format::{Clamp, Role};
use guardbit::machine::triangle_machines;
use guardbit::profile::{Form, Profile, WindowConfig};
use guardbit::setup::{Division, Triangle};
use guardbit::vector::bench::{TestAt, TriangleBench, locate};
use guardbit::vector::manifest::Manifest;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{self, Monitor, Options};
use set::{Set, options, profile, request, signed, source, tree, write_set};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{ErrorKind, Read};
use std::sync::atomic::Ordering;

/// Built-in profiles and changed ones: every clamp mode, form, rule and width of lane.
fn zoo() -> Vec<Profile> {
    let changed = |name: &str, of: &str, change: &dyn Fn(&mut Profile)| {
        let mut changed = profile(of);
        name.clone_into(&mut changed.name);
        change(&mut changed);
        changed.validate().unwrap();
        changed
    };
    let mut list: Vec<Profile> =
        ["tiny", "sgi-4k", "sgi-4k-walk", "d3d11"].into_iter().map(profile).collect();
    for clamp in Clamp::ALL {
        for guard in [0, 1, 3] {
            let name = format!("{}-{guard}", clamp.name());
            list.push(changed(&name, "tiny", &|p| {
                p.depth.iter_mut().for_each(|d| (d.clamp, d.guard) = (clamp, guard));
            }));
        }
    }
    list.push(changed("shadow-full", "sgi-4k", &|p| {
        if let Form::EdgeFunction(edges) = &mut p.form {
            (edges.rule, edges.storage, edges.width) = (FillRule::Shadow, EdgeStorage::Full, 45);
        }
    }));
    list.push(changed("reciprocal", "sgi-4k", &|p| {
        let division = Division::Reciprocal { bits: 18 };
        p.depth.iter_mut().for_each(|d| d.division = division);
    }));
    // Beyond a 64-bit lane, for both steppers.
    list.push(changed("wide", "sgi-4k", &|p| {
        p.depth.iter_mut().for_each(|d| (d.guard, d.integer, d.interpolation) = (5, 32, 30));
        if let Form::EdgeFunction(edges) = &mut p.form {
            edges.width = 70;
        }
    }));
    list.push(changed("no-fraction", "tiny", &|p| {
        p.depth.iter_mut().for_each(|d| d.interpolation = 0);
    }));
    list
}

fn names(set: &Set) -> Vec<&str> {
    let vectors = set.manifest.files.iter().filter(|file| !file.columns.is_empty());
    vectors.map(|file| file.name.as_str()).collect()
}

// Clause N-11
#[test]
fn the_bytes_do_not_depend_on_the_number_of_threads() {
    let requests = ["tiny", "sgi-4k", "d3d11"].map(|name| request(&profile(name), "triangle"));
    let write = |threads| {
        let keep = tempfile::tempdir().unwrap();
        let out = keep.path().join("sets");
        let options = Options { threads, ..options(3000) };
        write::write(&requests, &out, true, &options, &Monitor::default()).unwrap();
        tree(&out)
    };
    let one = write(1);
    // Ten vector files, eleven companions and a manifest each; two files each for d3d11's lines and
    // points; and the index.
    assert_eq!(one.len(), 3 * 22 + 4 + 1);
    for threads in [2, 7] {
        assert!(write(threads) == one, "{threads} threads");
    }
}

// Clause N-6
#[test]
fn the_count_is_the_number_of_rows_of_the_walk_files() {
    for name in ["tiny", "sgi-4k", "d3d11"] {
        for count in [1, 2, 63, 1000, 4321] {
            let set = write_set(&profile(name), "fan", &options(count));
            for file in ["dda.exp.tv", "edge.exp.tv"] {
                assert_eq!(set.rows(file).len() as u64, count, "{name} {file}");
            }
            assert!(set.rows("setup.exp.tv").len() as u64 <= count, "{name} {count}");
            for stem in ["dda", "edge"] {
                let exp = set.rows(&format!("{stem}.exp.tv"));
                let cfg = set.rows(&format!("{stem}.cfg.tv"));
                assert_eq!(walks(&exp).len(), cfg.len(), "{name} {count} {stem}");
            }
        }
    }
    // A machine without edge words has no edge bench.
    let set = write_set(&profile("sgi-4k-walk"), "triangle", &options(100));
    assert_eq!(set.rows("dda.exp.tv").len(), 100);
    assert!(!names(&set).iter().any(|name| name.starts_with("edge")));
}

// Clause N-6
#[test]
fn parts_joined_are_the_whole() {
    let formats = [
        (RowFormat::Tv, false),
        (RowFormat::Bin, false),
        (RowFormat::Csv, false),
        (RowFormat::Jsonl, false),
        (RowFormat::TestFloat, false),
        (RowFormat::Tv, true),
    ];
    for (parts, count) in [(3, 2500), (7, 4000), (5, 3)] {
        for (format, zstd) in formats {
            let options = Options { format, zstd, ..options(count) };
            let whole = write_set(&profile("tiny"), "fan", &options);
            let shards: Vec<Set> = (0..parts)
                .map(|index| {
                    let shard = Shard { index, parts };
                    write_set(&profile("tiny"), "fan", &Options { shard, ..options })
                })
                .collect();
            for name in names(&whole) {
                let plain = |set: &Set| {
                    if zstd { unzstd(&set.bytes(name)) } else { set.bytes(name) }
                };
                let joined: Vec<u8> = shards.iter().flat_map(plain).collect();
                assert!(joined == plain(&whole), "{name}: {parts} parts of {count}");
            }
            let mut tests: BTreeMap<(String, String), (u64, u64)> = BTreeMap::new();
            let mut add = |manifest: &Manifest, sign: bool| {
                for group in &manifest.groups {
                    let key = (group.bench.clone(), group.tag.clone());
                    let sum = tests.entry(key).or_default();
                    let by = |a: u64, b: u64| if sign { a + b } else { a - b };
                    *sum = (by(sum.0, group.tests), by(sum.1, group.rows));
                }
            };
            for shard in &shards {
                add(&shard.manifest, true);
            }
            add(&whole.manifest, false);
            assert!(tests.values().all(|left| *left == (0, 0)), "{tests:?}");
        }
    }
}

/// Every frame of a stream, one after another.
fn unzstd(mut bytes: &[u8]) -> Vec<u8> {
    let mut plain = Vec::new();
    while !bytes.is_empty() {
        let mut decoder = ruzstd::decoding::StreamingDecoder::new(&mut bytes).unwrap();
        decoder.read_to_end(&mut plain).unwrap();
    }
    plain
}

/// A record of a JSON Lines row, by the form alone: names and words.
fn json_row(line: &str) -> Vec<(String, u128)> {
    let inner = line.strip_prefix('{').unwrap().strip_suffix('}').unwrap();
    let pairs = inner.split(", ").map(|pair| pair.split_once(": ").unwrap());
    pairs
        .map(|(name, word)| {
            let bare =
                |text: &str| text.strip_prefix('"').unwrap().strip_suffix('"').unwrap().to_owned();
            (bare(name), u128::from_str_radix(&bare(word), 16).unwrap())
        })
        .collect()
}

// Clause N-1 and Clause N-7
#[test]
fn every_format_holds_the_same_words() {
    for name in ["tiny", "sgi-4k", "sgi-4k-walk"] {
        let golden = write_set(&profile(name), "triangle", &options(3000));
        for (format, zstd) in [
            (RowFormat::Bin, false),
            (RowFormat::Csv, false),
            (RowFormat::Jsonl, false),
            (RowFormat::Tv, true),
            (RowFormat::Bin, true),
        ] {
            let other =
                write_set(&profile(name), "triangle", &Options { format, zstd, ..options(3000) });
            assert_eq!(other.manifest.coverage, golden.manifest.coverage);
            assert_eq!(other.manifest.groups, golden.manifest.groups);
            let pairs = golden.manifest.files.iter().filter(|file| !file.columns.is_empty());
            for file in pairs {
                let stem = file.name.strip_suffix(".tv").unwrap();
                let end = if zstd { ".zst" } else { "" };
                let other_name = format!("{stem}.{}{end}", format.extension());
                let entry =
                    other.manifest.files.iter().find(|entry| entry.name == other_name).unwrap();
                assert_eq!((entry.rows, &entry.columns), (file.rows, &file.columns));
                let raw = other.bytes(&other_name);
                let bytes = if zstd { unzstd(&raw) } else { raw };
                let rows = golden.rows(&file.name);
                let found: Vec<Vec<u128>> = match format {
                    RowFormat::Tv => set::tv_rows(std::str::from_utf8(&bytes).unwrap()),
                    RowFormat::Bin => {
                        let widths: Vec<usize> =
                            file.columns.iter().map(|c| c.width.div_ceil(8) as usize).collect();
                        let record: usize = widths.iter().sum();
                        assert_eq!(bytes.len(), record * rows.len());
                        let big_endian = |bytes: &[u8]| {
                            bytes.iter().fold(0u128, |word, byte| word << 8 | u128::from(*byte))
                        };
                        let row = |mut row: &[u8]| {
                            let mut take = |width: &usize| {
                                let (word, rest) = row.split_at(*width);
                                row = rest;
                                big_endian(word)
                            };
                            widths.iter().map(&mut take).collect()
                        };
                        bytes.chunks(record).map(row).collect()
                    }
                    RowFormat::Csv => {
                        let text = std::str::from_utf8(&bytes).unwrap();
                        let (header, rest) = text.split_once('\n').unwrap();
                        let names: Vec<&str> =
                            file.columns.iter().map(|column| column.name.as_str()).collect();
                        assert_eq!(header, names.join(","));
                        set::tv_rows(&rest.replace(',', "_"))
                    }
                    _ => {
                        let text = std::str::from_utf8(&bytes).unwrap();
                        let row = |line| {
                            let pairs = json_row(line);
                            for ((found, _), column) in pairs.iter().zip(&file.columns) {
                                assert_eq!(*found, column.name);
                            }
                            pairs.into_iter().map(|(_, word)| word).collect()
                        };
                        text.lines().map(row).collect()
                    }
                };
                assert!(found == rows, "{name} {other_name}");
            }
        }
    }
}

// Clause N-7
#[test]
fn the_operand_form_states_each_addition_and_its_flags() {
    for profile in zoo() {
        let golden = write_set(&profile, "triangle", &options(2500));
        let format = RowFormat::TestFloat;
        let operands = write_set(&profile, "triangle", &Options { format, ..options(2500) });
        let read = |name: &str| set::tv_rows(&operands.text(name).replace(' ', "_"));
        for stem in ["dda", "edge"] {
            if stem == "edge" && !names(&golden).contains(&"edge.exp.tv") {
                continue;
            }
            let (cfg, exp) =
                (golden.rows(&format!("{stem}.cfg.tv")), golden.rows(&format!("{stem}.exp.tv")));
            let mut found = read(&format!("{stem}.testfloat")).into_iter();
            for (words, walk) in cfg.iter().zip(walks(&exp)) {
                let mut before = 0;
                for row in walk {
                    let addend = match row[0] {
                        0 => words[0],
                        1 => words[1],
                        2 => words[2],
                        _ => 0,
                    };
                    let line = found.next().unwrap();
                    assert_eq!(line[..4], [before, addend, row[1], row[2]], "{}", profile.name);
                    let flags = if stem == "dda" { flags(Reader::of(&profile), row[1]) } else { 0 };
                    assert_eq!(line[4], flags, "{} {row:x?}", profile.name);
                    before = row[1];
                }
            }
            assert_eq!(found.next(), None);
        }
        let joined: Vec<Vec<u128>> = golden
            .rows("setup.cfg.tv")
            .into_iter()
            .zip(golden.rows("setup.exp.tv"))
            .map(|(cfg, exp)| [cfg, exp].concat())
            .collect();
        assert!(read("setup.testfloat") == joined, "{}", profile.name);
    }
}

/// Flags of reading a pattern: it cannot have wrapped, what it stands for is in range.
fn flags(reader: Reader, pattern: u128) -> u128 {
    let pattern = pattern.cast_signed();
    let integer = pattern >> reader.fraction;
    let (all, inside) = (1 << (reader.guard + reader.integer), 1 << reader.integer);
    let (above, below) = match reader.clamp {
        Clamp::Wrap | Clamp::Saturate => (false, false),
        Clamp::Sign => (integer >= inside && integer < all / 2, integer >= all / 2),
        Clamp::Guard | Clamp::Error => {
            let split = inside + (all - inside) / 2;
            (integer >= inside && integer < split, integer >= split)
        }
    };
    let inexact = pattern & ((1 << reader.fraction) - 1) != 0;
    u128::from(above) << 1 | u128::from(below) << 2 | u128::from(inexact) << 3
}

// Clause N-2
#[test]
fn walks_are_what_a_plain_stepper_gives() {
    for profile in zoo() {
        // Enough for every class of every profile.
        let set = write_set(&profile, "triangle", &options(6000));
        let mut steppers = vec![("dda", Stepper::depth(Reader::of(&profile)))];
        if let Form::EdgeFunction(edges) = profile.form {
            steppers.push(("edge", Stepper::edge(edges.width)));
        }
        for (stem, stepper) in steppers {
            let (cfg, exp) =
                (set.rows(&format!("{stem}.cfg.tv")), set.rows(&format!("{stem}.exp.tv")));
            let walks = walks(&exp);
            assert_eq!(walks.len(), cfg.len(), "{} {stem}", profile.name);
            let mut zones = [0; 2];
            for (n, (words, walk)) in cfg.iter().zip(walks).enumerate() {
                let ops: Vec<u128> = walk.iter().map(|row| row[0]).collect();
                let rows = stepper.walk(words, &ops);
                assert!(
                    rows.iter().zip(walk).all(|(a, b)| a[..] == b[..]),
                    "{} {stem} walk {n}: {walk:x?} is {rows:x?}",
                    profile.name
                );
                for row in &rows {
                    zones[0] += u64::from(row[2] == 0);
                    zones[1] += u64::from(row[2] != 0);
                }
            }
            assert!(zones.iter().all(|rows| *rows > 100), "{} {stem}: {zones:?}", profile.name);
        }
    }
}

/// The rule of a machine of edge functions, as the exact truth names it.
fn rule(profile: &Profile) -> Option<Rule> {
    match profile.form {
        Form::EdgeFunction(edges) if edges.rule == FillRule::Shadow => Some(Rule::Shadow),
        Form::EdgeFunction(_) => Some(Rule::TopLeft),
        _ => None,
    }
}

/// The depth plane of a triangle from the exact truth: start and slopes, unreduced.
fn exact_plane(profile: &Profile, xy: [[i128; 2]; 3], z: [i128; 3]) -> [i128; 3] {
    let (depth, grid) = (profile.depth.unwrap(), profile.grid().unwrap());
    let f = depth.interpolation;
    let start = exact::plane_word(xy, z, grid.offset, f, depth.rounding).unwrap();
    let half = i128::from(profile.name == "d3d11") << f >> 1;
    let slopes = exact::plane_slopes(xy, z).unwrap().map(|slope| {
        let scaled = slope * exact::integer(1 << (grid.sub_pixel + f));
        i128::try_from(exact::round(&scaled, depth.rounding)).unwrap()
    });
    [start + half, slopes[0], slopes[1]]
}

/// What set-up makes of a triangle with area, by the exact truth where there is one.
fn exact_setup(profile: &Profile, xy: [[i128; 2]; 3], z: [i128; 3]) -> Vec<i128> {
    let grid = profile.grid().unwrap();
    let area = exact::edge_value(xy[0], xy[1], xy[2]);
    let (v, w) = if area > exact::integer(0) {
        (xy, z)
    } else {
        ([xy[0], xy[2], xy[1]], [z[0], z[2], z[1]])
    };
    let mut words = Vec::new();
    for k in 0..3 {
        let (p, q) = (v[k], v[(k + 1) % 3]);
        match &profile.form {
            Form::EdgeFunction(edges) => {
                // Values at three samples give the start and both steps.
                let at = |x, y| {
                    let value = exact::edge_value(p, q, grid.position(x, y));
                    i128::try_from(value.to_integer()).unwrap()
                };
                let level = q[1] == p[1];
                let owns = match edges.rule {
                    FillRule::TopLeft => q[1] < p[1] || (level && q[0] > p[0]),
                    FillRule::Shadow => q[1] > p[1] || (level && q[0] > p[0]),
                };
                let first = at(0, 0) - i128::from(!owns);
                let s = if edges.storage == EdgeStorage::Shifted { grid.sub_pixel } else { 0 };
                let steps = [at(1, 0) - at(0, 0), at(0, 1) - at(0, 0)].map(|step| step >> s);
                words.extend([first >> s, steps[0], steps[1]]);
            }
            Form::EdgeWalk(walk) => {
                let (top, bottom) = if q[1] < p[1] { (q, p) } else { (p, q) };
                let pixel = 1 << grid.sub_pixel;
                let reached = |y: i128| (y - grid.offset[1] + pixel - 1).div_euclid(pixel);
                let (first, end) = (reached(top[1]), reached(bottom[1]));
                if first >= end {
                    words.extend([0; 4]);
                    continue;
                }
                let unit = exact::dyadic(1 << walk.fraction, grid.sub_pixel);
                let x = |row: i128| {
                    let y = grid.position(0, row)[1];
                    exact::edge_x(top, bottom, y).unwrap() * &unit
                };
                let word = |value| i128::try_from(exact::round(&value, walk.rounding)).unwrap();
                words.extend([word(x(first)), word(x(first + 1) - x(first)), first, end]);
            }
            other => panic!("no exact set-up of {} here", other.name()),
        }
    }
    if let Some(Division::Reciprocal { .. }) = profile.depth.map(|depth| depth.division) {
        // The exact truth has no reciprocal: the plain device stands in.
        let triangle = Triangle { xy, z: Some(z) };
        words.extend(&device::Drawer::of(profile).set_up(&triangle).setup[9..]);
    } else {
        words.extend(exact_plane(profile, v, w));
    }
    words
}

// Clause N-2
#[test]
fn set_up_words_are_the_exact_ones_rounded_once() {
    // Set-up knows no clamp, and one number of guard bits is as good as another.
    let has_own_clamp = |p: &Profile| Clamp::ALL.iter().any(|c| p.name.starts_with(c.name()));
    for profile in zoo().into_iter().filter(|profile| !has_own_clamp(profile)) {
        let set = write_set(&profile, "knot", &options(1600));
        let columns = |name: &str| {
            let entry = set.manifest.files.iter().find(|file| file.name == name).unwrap();
            entry.columns.clone()
        };
        let (input, output) = (columns("setup.cfg.tv"), columns("setup.exp.tv"));
        let plain = rule(&profile).map(|_| device::Drawer::of(&profile));
        let mut flat = 0;
        let rows = set.rows("setup.cfg.tv").into_iter().zip(set.rows("setup.exp.tv"));
        for (n, (cfg, exp)) in rows.enumerate() {
            let value = |n: usize| {
                if input[n].signed { signed(cfg[n], input[n].width) } else { cfg[n].cast_signed() }
            };
            let xy: [[i128; 2]; 3] = [0, 1, 2].map(|n| [value(3 * n), value(3 * n + 1)]);
            let z = [value(2), value(5), value(8)];
            let degenerate = exact::edge_value(xy[0], xy[1], xy[2]) == exact::integer(0);
            // Rationals are slow: where a plain device can say it too, they judge each third row.
            let mut words = match &plain {
                Some(plain) if n % 3 > 0 => plain.set_up(&Triangle { xy, z: Some(z) }).setup,
                _ if degenerate => vec![0; output.len() - 1],
                _ => exact_setup(&profile, xy, z),
            };
            words.push(i128::from(degenerate));
            flat += u64::from(degenerate);
            let patterns: Vec<u128> = words
                .iter()
                .zip(&output)
                .map(|(word, column)| word.cast_unsigned() & (u128::MAX >> (128 - column.width)))
                .collect();
            assert_eq!(exp, patterns, "{} {xy:?} {z:?}", profile.name);
        }
        assert!(flat >= 6, "{}: triangles without area are tested", profile.name);
    }
}

// Clause N-2 and Clause N-5
#[test]
fn drawings_are_the_exact_coverage_under_the_rounded_plane() {
    for profile in zoo() {
        let (Some(rule), true) = (rule(&profile), profile.name != "reciprocal") else { continue };
        // A sticky accumulator has a path, and a refused triangle no rows: the spec's own matter.
        if matches!(profile.depth.unwrap().clamp, Clamp::Saturate | Clamp::Error) {
            continue;
        }
        let count = 3000;
        let set = write_set(&profile, "fan", &options(count));
        let bench = TriangleBench::new(&source(&profile, "fan", count));
        let (reader, grid) = (Reader::of(&profile), profile.grid().unwrap());
        let window = [profile.window.width, profile.window.height].map(i128::from);
        let (setups, exp) = (set.rows("triangle.cfg.tv"), set.rows("triangle.exp.tv"));
        let (mut spans, mut depths) =
            (set.rows("span.exp.tv").into_iter(), { set.rows("depth.exp.tv").into_iter() });
        let groups = guardbit::vector::bench::Bench::groups(&bench).to_vec();
        let (mut covered, mut worded) = (0, 0);
        for (test, (cfg, exp)) in setups.iter().zip(&exp).enumerate() {
            let triangle = bench.triangle_at(locate(&groups, test as u64).unwrap());
            let place = format!("{} test {test} {triangle:?}", profile.name);
            // Words of their own: what the row of the set says they are, sign by sign.
            let words = |first: usize, width: u32| {
                let word =
                    |k: usize| (cfg[first + k] << (128 - width)).cast_signed() >> (128 - width);
                [0, 1, 2].map(word)
            };
            let (zero_area, plane) = if let Some(Triangle { xy, z }) = &triangle {
                let zero_area = exact::edge_value(xy[0], xy[1], xy[2]) == exact::integer(0);
                let plane = || exact_plane(&profile, *xy, z.unwrap());
                (zero_area, if zero_area { [0; 3] } else { plane() })
            } else {
                worded += 1;
                let depth = profile.depth.unwrap();
                (cfg[13] == 1, words(10, depth.guard + depth.integer + depth.interpolation))
            };
            let inside = |x: i128, y: i128| match &triangle {
                Some(triangle) => {
                    exact::covers(triangle.xy, Point::from(grid.position(x, y)), rule)
                }
                None => (0..3).all(|k| {
                    let width = profile.form.edge().unwrap().width;
                    let [e, a, b] = words(1 + 3 * k, width);
                    cfg[13] == 0 && (e + a * x + b * y) >> (width - 1) & 1 == 0
                }),
            };
            // wrap, clamp_above, clamp_below, inexact.
            let (mut counts, mut runs, mut samples) = ([0u128; 4], 0, 0);
            let range = |axis: usize| {
                let Some(triangle) = &triangle else {
                    let [.., y0, y1, x0, x1] = cfg[..] else { unreachable!() };
                    let sides = if axis == 0 { [x0, x1] } else { [y0, y1] };
                    return sides.map(u128::cast_signed);
                };
                let (low, high) = grid.pixels(axis, triangle.extent(axis));
                [low.max(0), high.min(window[axis])]
            };
            let ([x0, x1], [y0, y1]) = (range(0), range(1));
            let bounds = [y0, y1.max(y0), x0, x1.max(x0)].map(i128::cast_unsigned);
            if x0 < x1 && y0 < y1 {
                assert_eq!(cfg[cfg.len() - 4..], bounds, "{place}");
            }
            let line = |rows: &mut dyn Iterator<Item = Vec<u128>>, words: &[i128]| {
                let words: Vec<u128> =
                    [test as i128].iter().chain(words).map(|word| word.cast_unsigned()).collect();
                assert_eq!(rows.next(), Some(words), "{place}");
            };
            for y in y0..y1 {
                let mut start = None;
                for x in x0..=x1 {
                    let inside = x < x1 && inside(x, y);
                    match (inside, start) {
                        (true, None) => start = Some(x),
                        (false, Some(from)) => {
                            line(&mut spans, &[y, from, x]);
                            runs += 1;
                            start = None;
                        }
                        _ => {}
                    }
                    if inside {
                        samples += 1;
                        let value = plane[0] + plane[1] * x + plane[2] * y;
                        line(&mut depths, &[y, x, reader.read(value)]);
                        for (count, hit) in counts.iter_mut().zip(events(reader, value)) {
                            *count += u128::from(hit);
                        }
                    }
                }
            }
            let [wrap, above, below, inexact] = counts;
            let zero = u128::from(zero_area);
            let expected = [test as u128, runs, samples, wrap, above, below, inexact, zero];
            assert_eq!(exp[..], expected, "{place}");
            covered += samples;
        }
        assert_eq!((spans.next(), depths.next()), (None, None), "{}", profile.name);
        assert!(covered > 80, "{}: {covered} samples", profile.name);
        assert_eq!(worded > 300, profile.plain_edges().is_some(), "{}: {worded}", profile.name);
    }
}

/// Events of the unwrapped value: wrap, clamped above, clamped below, inexact.
fn events(reader: Reader, value: i128) -> [bool; 4] {
    let (one, top) = (1i128 << reader.fraction, 1i128 << (reader.integer + reader.fraction));
    let half = 1i128 << (reader.width() - 1);
    let up = top / 2;
    let (low, high) = match reader.clamp {
        Clamp::Guard | Clamp::Error => (up - half, up + half),
        Clamp::Sign => (-half, half),
        Clamp::Wrap => (0, top),
        Clamp::Saturate => (i128::MIN, i128::MAX),
    };
    let clamps = reader.clamp != Clamp::Wrap;
    let wrapped = value < low || value >= high;
    [wrapped, clamps && value >= top, clamps && value < 0, value.rem_euclid(one) != 0]
}

// Clause N-3 and Clause N-8 and Clause N-9
#[test]
fn the_manifest_says_what_is_there() {
    for profile in zoo() {
        let set = write_set(&profile, "fan", &options(2600));
        let name = &profile.name;
        let text = set.text("manifest.json");
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["schema"], 3);
        assert_eq!(json["seed"], 1);
        assert_eq!(json["count"], 2600);
        let depth = profile.depth.unwrap();
        for (key, bits) in [
            ("guard", depth.guard),
            ("integer", depth.integer),
            ("interpolation", depth.interpolation),
        ] {
            assert_eq!(json["profile"]["depth"][key], bits, "{name}");
        }
        // Every file but the manifest itself, with its digest, length and rows.
        let files = json["files"].as_array().unwrap();
        let mut listed: Vec<String> =
            files.iter().map(|file| file["name"].as_str().unwrap().to_owned()).collect();
        listed.sort();
        let present: Vec<String> = tree(&set.folder()).into_iter().map(|(name, _)| name).collect();
        let present: Vec<String> =
            present.into_iter().filter(|name| name != "manifest.json").collect();
        assert_eq!(listed, present);
        for file in files {
            let file_name = file["name"].as_str().unwrap();
            let bytes = set.bytes(file_name);
            assert_eq!(file["bytes"], bytes.len(), "{file_name}");
            let lines = bytes.split(|byte| *byte == b'\n').count() - 1;
            assert_eq!(file["rows"], lines, "{file_name}");
            assert_eq!(file["sha256"], sha256(&bytes), "{file_name}");
            let columns = file["columns"].as_array().unwrap();
            assert_eq!(columns.is_empty(), file_name.strip_suffix(".tv").is_none(), "{file_name}");
            for column in columns {
                let meaning = column["meaning"].as_str().unwrap();
                assert!(meaning.ends_with('.') && meaning.len() > 3, "{file_name}: {meaning}");
            }
        }
        // Its own digest: with the digest emptied, the bytes hash to it.
        let digest = json["digest"].as_str().unwrap();
        let empty = text.replace(digest, "");
        assert_eq!(sha256(empty.as_bytes()), digest);
        assert!(text.ends_with(&format!("\"digest\": \"{digest}\"\n}}\n")));
        // Groups sum to the rows of the first expectation file, and to the configuration's tests.
        for (bench, cfg, exp) in [
            ("dda", "dda.cfg.tv", "dda.exp.tv"),
            ("edge", "edge.cfg.tv", "edge.exp.tv"),
            ("setup", "setup.cfg.tv", "setup.exp.tv"),
            ("triangle", "triangle.cfg.tv", "triangle.exp.tv"),
        ] {
            if !listed.iter().any(|name| name == exp) {
                continue;
            }
            let sum = |key: &str| -> u64 {
                let groups = json["groups"].as_array().unwrap().iter();
                groups.filter(|g| g["bench"] == bench).map(|g| g[key].as_u64().unwrap()).sum()
            };
            assert_eq!(sum("tests"), set.rows(cfg).len() as u64, "{name} {bench}");
            assert_eq!(sum("rows"), set.rows(exp).len() as u64, "{name} {bench}");
        }
        for group in json["groups"].as_array().unwrap() {
            assert!(group["catches"].as_str().unwrap().len() > 10, "{group}");
        }
        // Coverage counts each row once.
        let covered = |bench: &str| -> u64 {
            let entries = json["coverage"].as_array().unwrap();
            let entry = entries.iter().find(|entry| entry["bench"] == bench).unwrap();
            let cells = entry["cells"].as_array().unwrap().iter();
            // Octant, zone and remainder; the other cells are goals of the bench.
            let zones = [".inside.", ".above.", ".below."];
            let of_rows =
                cells.filter(|c| zones.iter().any(|z| c["cell"].as_str().unwrap().contains(z)));
            of_rows.map(|c| c["rows"].as_u64().unwrap()).sum()
        };
        assert_eq!(covered("dda"), 2600, "{name}");
        assert_eq!(covered("triangle"), set.rows("depth.exp.tv").len() as u64, "{name}");
    }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |text, byte| format!("{text}{byte:02x}"))
}

#[test]
fn nothing_tells_where_or_when_a_set_was_made() {
    let [a, b] = [(); 2].map(|()| write_set(&profile("tiny"), "fan", &options(300)));
    assert_ne!(a.folder(), b.folder());
    assert!(tree(&a.folder()) == tree(&b.folder()));
    let folder = a.folder();
    let home = folder.parent().unwrap().to_str().unwrap();
    for (name, bytes) in tree(&folder) {
        let text = String::from_utf8(bytes).unwrap();
        assert!(!text.contains(home) && !text.contains(env!("CARGO_MANIFEST_DIR")), "{name}");
        if name == "manifest.json" {
            for key in ["time", "date", "host", "path", "user"] {
                assert!(!text.contains(&format!("\"{key}\"")), "{name}: {key}");
            }
        }
    }
}

// Clause N-2
#[test]
fn columns_are_named_and_wide_as_the_conventions_fix() {
    let fixed = [
        ("dda.cfg.tv", vec!["init", "dx", "dy"]),
        ("dda.exp.tv", vec!["op", "acc", "out"]),
        ("edge.cfg.tv", vec!["e0", "ea", "eb"]),
        ("edge.exp.tv", vec!["op", "e", "in"]),
        ("span.exp.tv", vec!["test", "y", "x_begin", "x_end"]),
        ("depth.exp.tv", vec!["test", "y", "x", "depth"]),
    ];
    for profile in zoo() {
        let set = write_set(&profile, "triangle", &options(300));
        let columns = |name: &str| {
            set.manifest.files.iter().find(|file| file.name == name).map(|file| &file.columns)
        };
        let width = |file: &str, name: &str| {
            let found = columns(file).unwrap().iter().find(|column| column.name == name);
            found.unwrap().width
        };
        for (file, names) in &fixed {
            let Some(columns) = columns(file) else {
                assert!(file.starts_with("edge") && rule(&profile).is_none(), "{file}");
                continue;
            };
            let found: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            assert_eq!(found, *names, "{file}");
        }
        let reader = Reader::of(&profile);
        for (file, name) in [("dda.cfg.tv", "init"), ("dda.cfg.tv", "dx"), ("dda.exp.tv", "acc")] {
            assert_eq!(width(file, name), reader.width(), "{} {name}", profile.name);
        }
        assert_eq!(width("dda.exp.tv", "out"), reader.integer);
        assert_eq!(width("dda.exp.tv", "op"), 2);
        if let Form::EdgeFunction(edges) = profile.form {
            for (file, name) in [("edge.cfg.tv", "e0"), ("edge.cfg.tv", "eb"), ("edge.exp.tv", "e")]
            {
                assert_eq!(width(file, name), edges.width);
            }
            assert_eq!(width("edge.exp.tv", "in"), 1);
        }
        // Golden rows: lower-case hexadecimal, padded to whole nibbles, within their widths.
        for file in set.manifest.files.iter().filter(|file| !file.columns.is_empty()) {
            let text = set.text(&file.name);
            assert!(text.is_empty() || text.ends_with('\n'), "{}", file.name);
            let rows = set.rows(&file.name);
            let widths: Vec<u32> = file.columns.iter().map(|column| column.width).collect();
            for (line, words) in text.lines().zip(&rows) {
                // Written again from its words, a row is the same: digits, case, padding, mask.
                assert_eq!(line, set::tv_line(words, &widths), "{} {}", profile.name, file.name);
            }
        }
    }
}

/// Machines, primitives and numbers of samples of every kind.
fn profiles_of_every_column() -> Vec<Profile> {
    let mut list: Vec<Profile> =
        guardbit::profile::BUILTIN.iter().map(|(n, _)| profile(n)).collect();
    let small = |name: &str| {
        let mut made = profile(name);
        made.window = WindowConfig { width: 64, height: 64 };
        made
    };
    for kind in triangle_machines() {
        list.push(small("sgi-4k").with_machine(kind.name).unwrap());
    }
    for depth in [DepthAt::Centre, DepthAt::Sample] {
        let multisample = Some(MultisampleConfig { samples: 4, depth });
        list.push(Profile { multisample, ..small("sgi-4k") });
    }
    list
}

// Clause N-16
#[test]
fn every_column_has_a_role_and_comes_in_the_order_of_roles() {
    let mut used = BTreeSet::new();
    for profile in profiles_of_every_column() {
        let source = source(&profile, "triangle", 300);
        for bench in source.benches() {
            // Registers and records carry the names of the hardware's own manual.
            let words = bench.name() == "words";
            for spec in bench.files().into_iter().chain(bench.operand_file()) {
                let place = format!("{} {}", profile.name, spec.stem);
                let columns = spec.columns.iter().map(|column| column.name.as_str());
                let mut before = None;
                for name in columns.take(if words { 1 } else { usize::MAX }) {
                    let found = Role::find(name).unwrap_or_else(|| panic!("{place}: {name}"));
                    used.insert(found.rank);
                    // Those of a vertex, edge, side or share stand together.
                    let family = found.role.pattern.split_once("{k}").map(|(family, _)| family);
                    let first = Role::ALL.iter().position(|role| {
                        family.map_or(role.pattern == found.role.pattern, |family| {
                            role.pattern.starts_with(&format!("{family}{{k}}"))
                        })
                    });
                    let sample = found.sample.unwrap_or(usize::MAX);
                    let order = Some((first, sample, found.k, found.rank));
                    assert!(order > before, "{place}: {name} comes too late");
                    before = order;
                }
            }
        }
    }
    let unused: Vec<_> =
        (0..Role::ALL.len()).filter(|rank| !used.contains(rank)).map(|r| Role::ALL[r]).collect();
    assert_eq!(unused, [], "no column has this role");
}

// Clause N-16
#[test]
fn the_specification_lists_every_role() {
    let spec = include_str!("../../spec/09-vectors.md");
    let (_, clause) = spec.split_once("### N-16 ").unwrap();
    let clause = clause.split("\n### ").next().unwrap();
    let rows: Vec<&str> = clause.lines().filter(|line| line.starts_with("| `")).collect();
    let expected: Vec<String> = Role::ALL
        .iter()
        .map(|role| {
            let [name, meaning] = [role.pattern, role.meaning].map(|t| t.replace("{k}", "K"));
            format!("| `{name}` | {meaning} |")
        })
        .collect();
    assert_eq!(rows, expected);
}

#[test]
fn packages_count_the_rows_of_the_manifest() {
    let set = write_set(&profile("tiny"), "fan", &options(700));
    let mut found = 0;
    for file in set.manifest.files.iter().filter(|file| !file.columns.is_empty()) {
        let stem = file.name.strip_suffix(".tv").unwrap();
        let upper = format!("{}_ROWS", stem.replace('.', "_").to_uppercase());
        let rows = file.rows;
        for (package, line) in [
            ("pkg.sv", format!("localparam logic [63:0] {upper} = 64'd{rows};")),
            ("pkg.vh", format!("`define GUARDBIT_{upper} 64'd{rows}\n")),
            ("pkg.vhd", format!("constant {upper} : unsigned(63 downto 0) := x\"{rows:016x}\";")),
            ("pkg.h", format!("{upper} UINT64_C({rows})\n")),
        ] {
            let text = set.text(package);
            assert!(text.contains(&line), "{package} lacks {line:?}");
            found += 1;
        }
    }
    assert_eq!(found, 4 * 10);
}

// Clause N-11
#[test]
fn a_folder_in_the_way_is_kept_unless_forced() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let write = |force, count| {
        let options = Options { force, ..options(count) };
        let requests = [request(&profile("tiny"), "triangle")];
        write::write(&requests, &out, false, &options, &Monitor::default())
    };
    // An empty folder is as good as none.
    std::fs::create_dir(&out).unwrap();
    write(false, 50).unwrap();
    let first = tree(&out);
    assert_eq!(write(false, 60).unwrap_err().kind(), ErrorKind::AlreadyExists);
    assert!(tree(&out) == first, "a refused run changes nothing");
    write(true, 60).unwrap();
    assert_eq!(set::tv_rows(&read(&out.join("dda.exp.tv"))).len(), 60);
    assert_eq!(tree(home.path()).len(), first.len(), "nothing beside the set");
    // A file in the way is never a set.
    let file = home.path().join("file");
    std::fs::write(&file, "mine").unwrap();
    for force in [false, true] {
        let options = Options { force, ..options(10) };
        let requests = [request(&profile("tiny"), "triangle")];
        write::write(&requests, &file, false, &options, &Monitor::default()).unwrap_err();
        assert_eq!(read(&file), "mine");
    }
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 2);
}

fn read(path: &std::path::Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn force_replaces_sets_and_nothing_else() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("thesis.txt"), "years of work").unwrap();
    let options = Options { force: true, ..options(10) };
    let requests = [request(&profile("tiny"), "triangle")];
    write::write(&requests, &out, false, &options, &Monitor::default()).unwrap_err();
    assert_eq!(read(&out.join("thesis.txt")), "years of work");
    assert_eq!(tree(home.path()).len(), 1);
}

// Clause N-11
#[test]
fn a_failing_run_leaves_nothing_behind() {
    let home = tempfile::tempdir().unwrap();
    let requests = [request(&profile("tiny"), "triangle")];
    // Cancelled from the start: the first buffer stops it.
    let monitor = Monitor::default();
    monitor.cancel.store(true, Ordering::Relaxed);
    let out = home.path().join("out");
    let error = write::write(&requests, &out, false, &options(5000), &monitor).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Interrupted);
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
    // A place where no folder can be.
    let file = home.path().join("file");
    std::fs::write(&file, "mine").unwrap();
    let out = file.join("out");
    write::write(&requests, &out, false, &options(50), &Monitor::default()).unwrap_err();
    assert_eq!(tree(home.path()), [("file".to_owned(), b"mine".to_vec())]);
    // With force, what was there stays until the new set is whole.
    let out = home.path().join("old");
    write::write(&requests, &out, false, &options(50), &Monitor::default()).unwrap();
    let before = tree(home.path());
    let force = Options { force: true, ..options(5000) };
    write::write(&requests, &out, false, &force, &monitor).unwrap_err();
    assert!(tree(home.path()) == before);
}

// Clause N-4
#[test]
fn tests_keep_their_rows_in_a_set_of_any_size() {
    let profile = profile("tiny");
    let rows = |count: u64, bench: &str, tag: &str, index: u64| {
        let benches = source(&profile, "fan", count).benches();
        let bench = benches.iter().find(|other| other.name() == bench).unwrap();
        let id = format!("{}/{tag}/{index}", bench.name());
        let at: TestAt = guardbit::vector::plan::find_test(&**bench, &id).unwrap();
        assert_eq!(guardbit::vector::plan::test_id(&**bench, at), id);
        let rows = guardbit::vector::emit::test_rows(&**bench, at);
        // The number of the test depends on the size of the set; its rows do not.
        rows.into_iter()
            .map(|(spec, rows)| {
                let skip = usize::from(spec.columns[0].name == "test");
                rows.into_iter().map(|row| row[skip..].to_vec()).collect::<Vec<_>>()
            })
            .collect::<Vec<_>>()
    };
    for (bench, tag, index) in [
        ("dda", "guard-boundary", 17),
        ("dda", "scene", 3),
        ("dda", "random", 5),
        ("dda", "random", u64::MAX),
        ("edge", "random", 5),
        ("edge", "scene", 3),
        ("setup", "random", 7),
        ("setup", "scene", 9),
        ("triangle", "random", 1),
        ("triangle", "scene", 2),
    ] {
        let small = rows(4000, bench, tag, index);
        assert!(small.iter().flatten().count() > 0, "{bench}/{tag}/{index}");
        assert_eq!(small, rows(50_000, bench, tag, index), "{bench}/{tag}/{index}");
    }
}

#[cfg(feature = "cli")]
mod command {
    use super::*;
    use run::run_in;

    /// Rows of each file that belong to test `number` of a bench, from the files alone.
    fn of_test(set: &Set, bench: &str, number: usize) -> Vec<String> {
        let mut lines = Vec::new();
        let mut take = |name: &str, wanted: &dyn Fn(usize, &str) -> bool| {
            let text = set.text(name);
            let mine = text.lines().enumerate().filter(|(n, line)| wanted(*n, line));
            lines.extend(mine.map(|(_, line)| format!("{name}: {line}")));
        };
        match bench {
            "dda" | "edge" => {
                let exp = set.rows(&format!("{bench}.exp.tv"));
                let before: usize = walks(&exp)[..number].iter().map(|walk| walk.len()).sum();
                let mine = before..before + walks(&exp)[number].len();
                take(&format!("{bench}.cfg.tv"), &|n, _| n == number);
                take(&format!("{bench}.exp.tv"), &|n, _| mine.contains(&n));
            }
            "setup" => {
                take("setup.cfg.tv", &|n, _| n == number);
                take("setup.exp.tv", &|n, _| n == number);
            }
            _ => {
                let key = format!("{number:08x}_");
                let mine = |_: usize, line: &str| line.starts_with(&key);
                for name in ["triangle.cfg.tv", "triangle.exp.tv", "span.exp.tv", "depth.exp.tv"] {
                    take(name, &mine);
                }
            }
        }
        lines
    }

    #[test]
    fn only_prints_the_rows_that_the_set_has_for_a_test() {
        let home = tempfile::tempdir().unwrap();
        for profile in ["tiny", "sgi-4k"] {
            let set = write_set(&set::profile(profile), "fan", &options(6000));
            for bench in ["dda", "edge", "setup", "triangle"] {
                let mut first = 0;
                for group in set.manifest.groups.iter().filter(|group| group.bench == bench) {
                    // The last walk of a set is cut; alone it is whole.
                    let last =
                        group.tests - 1 - u64::from(group.tag == "random" && group.tests > 1);
                    for index in [0, last / 2, last] {
                        let id = format!("{bench}/{}/{index}", group.tag);
                        let arguments =
                            format!("vectors {profile} --scene fan --count 6000 --only {id}");
                        let ran = run_in(home.path(), &arguments).ends(0);
                        let lines: Vec<&str> = ran.out.lines().collect();
                        let number = usize::try_from(first + index).unwrap();
                        assert_eq!(lines, of_test(&set, bench, number), "{profile} {id}");
                    }
                    first += group.tests;
                }
            }
        }
    }

    #[test]
    fn an_unknown_test_is_an_input_error_that_lists_the_classes() {
        let home = tempfile::tempdir().unwrap();
        for id in [
            "?",
            "dda",
            "dda/random",
            "dda/random/x",
            "dda/none/0",
            "dda/wrap/45",
            "dda/wrap/0/0",
            "dda/random/-1",
            "dda/random/18446744073709551616",
        ] {
            let arguments = format!("vectors tiny --count 100 --only {id}");
            let ran = run_in(home.path(), &arguments);
            ran.complains(2, &[id, "dda/guard-boundary/0..70"]);
        }
    }
}
