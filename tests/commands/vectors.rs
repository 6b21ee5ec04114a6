//! What `vectors` writes, held to its spec by readers and oracles of its own.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod manifest;
mod words;

use crate::device::{Reader, walks};
#[cfg(feature = "cli")]
use crate::run;
use crate::set::{self, Set, options, profile, request, source, tree, write_set};
use guardbit::cover::{EdgeStorage, FillRule};
use guardbit::exact::Rule;
use guardbit::format::Clamp;
use guardbit::profile::{Form, Profile};
use guardbit::setup::Division;
use guardbit::vector::bench::TestAt;
use guardbit::vector::manifest::Manifest;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{self, Monitor, Options};
use std::collections::BTreeMap;
use std::io::{ErrorKind, Read as _};
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

/// The rule of a machine of edge functions, as the exact truth names it.
fn rule(profile: &Profile) -> Option<Rule> {
    match profile.form {
        Form::EdgeFunction(edges) if edges.rule == FillRule::Shadow => Some(Rule::Shadow),
        Form::EdgeFunction(_) => Some(Rule::TopLeft),
        _ => None,
    }
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
    // Ten vector files, eleven companions, seven files of `formal` and a manifest each; two files each for d3d11's lines and
    // points; and the index.
    assert_eq!(one.len(), 3 * 29 + 4 + 1);
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

/// A profile without a reference has no folder `formal`, and neither has a set without benches. What stands in such a
/// folder beside the files of the set is kept.
// Clause J-13
#[cfg(feature = "cli")]
#[test]
fn assertions_and_scripts_have_a_folder() {
    let home = tempfile::tempdir().unwrap();
    let vectors = |line: &str| run::run_in(home.path(), &format!("vectors {line}"));
    for (profile, has) in [("tiny", true), ("d3d11", true), ("larrabee", false), ("n64", false)] {
        vectors(&format!("{profile} --size smoke --out {profile}")).ends(0);
        assert_eq!(home.path().join(profile).join("formal").exists(), has, "{profile}");
    }
    vectors("tiny --size smoke --format bin --out rows").ends(0);
    assert!(!home.path().join("rows/formal").exists());
    // Twice in its place, then with something else in the folder, alone and in a folder of sets.
    vectors("tiny --size smoke --out tiny --force").ends(0);
    std::fs::create_dir(home.path().join("tiny/formal/dda")).unwrap();
    let kept = ["tiny/formal/dda does not belong to a vector set"];
    vectors("tiny --size smoke --out tiny --force").complains(2, &kept);
    std::fs::remove_dir(home.path().join("tiny/formal/dda")).unwrap();
    vectors("tiny --size smoke --out tiny --force").ends(0);
    vectors("--size smoke --out both").ends(0);
    std::fs::write(home.path().join("both/sgi-4k/formal/notes"), "mine").unwrap();
    let kept = ["both/sgi-4k/formal/notes does not belong to a vector set"];
    vectors("--size smoke --out both --force").complains(2, &kept);
    assert_eq!(read(&home.path().join("both/sgi-4k/formal/notes")), "mine");
    // A file that is not as made, one that is missing, and a manifest that points elsewhere.
    let path = home.path().join("d3d11/formal/bind.sv");
    std::fs::write(&path, read(&path).replace(".clk(clk)", ".clk(rst)")).unwrap();
    let verify = |set: &str| run::run_in(home.path(), &format!("verify {set}"));
    assert!(verify("d3d11").ends(1).out.contains("formal/bind.sv"));
    std::fs::remove_file(&path).unwrap();
    assert!(verify("d3d11").ends(1).out.contains("formal/bind.sv"));
    let path = home.path().join("d3d11/manifest.json");
    std::fs::write(&path, read(&path).replace("formal/bind.sv", "formal/../dut.sv")).unwrap();
    verify("d3d11").complains(2, &["formal/../dut.sv", "neither a plain file name"]);
}
