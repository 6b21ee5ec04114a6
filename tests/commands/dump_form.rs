//! `verify --dut`: what may be a dump, and what is said of one that is none.

use crate::device;
use crate::set;
use crate::verify::Golden;
use device::{Reader, Slip, Stepper};
use guardbit::format::Clamp;
use guardbit::vector::check;
use guardbit::vector::dump;
use guardbit::vector::write::{self, Monitor};
use set::{options, profile, request};

// Clause N-13
#[test]
fn a_simulators_latitude_is_accepted() {
    let golden = Golden::named("tiny", 1000);
    for name in ["dda.exp.tv", "setup.exp.tv", "span.exp.tv", "depth.exp.tv", "triangle.exp.tv"] {
        let text = golden.set.text(name);
        let changed = [
            text.replace('\n', "\r\n"),
            text.trim_end().to_owned(),
            format!("// a header\n\n{}", text.replace('\n', "  // at 10 ns\n\n  // more\n")),
            text.to_uppercase(),
            text.replace('\n', "\n\n \t\n"),
        ];
        for text in &changed {
            assert_eq!(golden.compare(name, text).unwrap().total, 0, "{name}: {text:.80}");
        }
    }
}

// Clause N-13
#[test]
fn keyed_rows_come_in_any_order_and_others_do_not() {
    let golden = Golden::named("tiny", 200);
    for name in ["span.exp.tv", "depth.exp.tv", "triangle.exp.tv"] {
        let text = golden.set.text(name);
        let mut lines: Vec<&str> = text.lines().collect();
        lines.reverse();
        let middle = lines.len() / 3;
        lines.rotate_left(middle);
        let report = golden.compare(name, &lines.join("\n")).unwrap();
        assert_eq!((report.total, report.rows), (0, lines.len() as u64), "{name}");
        // A row twice is a row too much.
        lines.insert(5, lines[0]);
        let report = golden.compare(name, &lines.join("\n")).unwrap();
        assert_eq!(report.total, 1, "{name}");
        assert!(report.mismatches[0].text.contains("extra row"), "{:?}", report.mismatches);
        assert_eq!(report.mismatches[0].row, None);
        assert!(!report.lost, "{name}: nothing is missing");
        // Two rows gone from the middle.
        lines.drain(4..7);
        let report = golden.compare(name, &lines.join("\n")).unwrap();
        assert_eq!(report.total, 2, "{name}");
        assert!(!report.short, "{name}");
        assert!(report.lost && report.causes.is_empty(), "{name}: rows are missing, no more");
        for mismatch in &report.mismatches {
            assert!(mismatch.text.contains("missing: test "), "{mismatch:?}");
            assert!(mismatch.line.is_none() && mismatch.row.is_some());
        }
        // A row of a test that the set does not have.
        let stranger = format!("{}\nffff{}\n", text.trim_end(), &lines[0][4..]);
        let report = golden.compare(name, &stranger).unwrap();
        assert_eq!(report.total, 1, "{name}");
        assert!(report.mismatches[0].text.contains("the set has no test"));
    }
    let text = golden.set.text("dda.exp.tv");
    let mut lines: Vec<&str> = text.lines().collect();
    lines.swap(100, 101);
    assert_ne!(lines[100], lines[101]);
    assert_eq!(golden.compare("dda.exp.tv", &lines.join("\n")).unwrap().total, 2);
}

// Clause N-13
#[test]
fn unknown_digits_disagree_and_masked_ones_do_not() {
    let golden = Golden::named("sgi-4k", 1000);
    let text = golden.set.text("dda.exp.tv");
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let with = |n: usize, line: String| {
        let mut lines = lines.clone();
        lines[n] = line;
        golden.compare("dda.exp.tv", &lines.join("\n")).unwrap()
    };
    for unknown in ["x", "X", "z", "Z"] {
        let line = lines[7].clone();
        let report = with(7, line[..line.len() - 1].to_owned() + unknown);
        assert_eq!(report.total, 1);
        let mismatch = &report.mismatches[0];
        assert_eq!((mismatch.row, mismatch.line), (Some(8), Some(8)));
        assert!(mismatch.text.contains("out: expected") && mismatch.text.contains("unknown"));
        assert!(!mismatch.text.contains("acc:"), "{}", mismatch.text);
        assert_eq!(report.causes, [""; 0]);
    }
    // op 1 digit, acc 10, out 6.
    let (op, acc, out) = (&lines[7][..1], &lines[7][2..12], &lines[7][13..]);
    let masked = |row: &str, mask: &str| with(7, format!("{row}_{mask}")).total;
    assert_eq!(masked(&lines[7], "00000000000000000"), 0);
    assert_eq!(masked(&format!("{op}_{acc}_xxxxxx"), "00000000000ffffff"), 0);
    assert_eq!(masked(&format!("{op}_{acc}_xxxxxx"), "00000000000fffffe"), 1);
    assert_eq!(masked(&format!("{op}_{}x_{out}", &acc[..9]), "0000000000f000000"), 0);
    let other = if acc.ends_with('1') { "0" } else { "1" };
    assert_eq!(masked(&format!("{op}_{}{other}_{out}", &acc[..9]), "00000000000000000"), 1);
    assert_eq!(masked(&format!("{op}_{}{other}_{out}", &acc[..9]), "0000000000f000000"), 0);
    assert_eq!(masked(&format!("3_{acc}_{out}"), "f0000000000000000"), 0);
    // A whole dump with its masks: what is looked at still tells the defect.
    let sign = Stepper::depth(Reader { clamp: Clamp::Sign, ..Reader::of(&golden.profile) });
    let text = golden.walked("dda", sign).replace('\n', "_0ffffffffff000000\n");
    let report = golden.compare("dda.exp.tv", &text).unwrap();
    assert!(report.total > 0);
    assert!(report.causes.iter().any(|cause| cause.contains("depth.clamp is sign")));
}

// Clause J-5
#[test]
fn rows_lost_from_an_ordered_file_are_told_from_wrong_ones() {
    let golden = Golden::named("tiny", 1000);
    let text = golden.set.text("setup.exp.tv");
    let mut lines: Vec<&str> = text.lines().collect();
    // The first row that has words is lost; some rows later another.
    let first = lines.iter().position(|line| line.ends_with("_0")).unwrap();
    lines.remove(first + 20);
    lines.remove(first);
    let report = golden.compare("setup.exp.tv", &lines.join("\n")).unwrap();
    assert!(report.lost && report.causes.is_empty(), "{:?}", report.causes);
    // One row is of another triangle: not lost, but wrong.
    lines[first] = "00_00_00_00_00_00_00_00_00_00_00_00_0";
    let report = golden.compare("setup.exp.tv", &lines.join("\n")).unwrap();
    assert!(!report.lost && report.causes.is_empty(), "{:?}", report.causes);
}

#[test]
fn a_dump_that_stops_early_is_said_to() {
    let golden = Golden::named("tiny", 300);
    for name in [
        "dda.exp.tv",
        "edge.exp.tv",
        "setup.exp.tv",
        "span.exp.tv",
        "depth.exp.tv",
        "triangle.exp.tv",
    ] {
        let text = golden.set.text(name);
        let lines: Vec<&str> = text.lines().collect();
        for kept in [1, lines.len() - 1] {
            let report = golden.compare(name, &lines[..kept].join("\n")).unwrap();
            assert!(report.short, "{name}: {kept} rows of {}", lines.len());
            assert_eq!(report.rows, kept as u64);
            assert_eq!(report.expected_rows, lines.len() as u64);
            assert!(report.total > 0);
        }
        // Cut in the middle of a row: no row, and said where.
        let cut = text[..text.len() / 2].trim_end();
        let last = cut.lines().last().unwrap();
        if last.len() < lines[0].len() {
            let count = cut.lines().count() as u64;
            let report = golden.compare(name, cut).unwrap();
            assert_eq!((report.cut, report.rows, report.short), (Some(count), count - 1, true));
            assert!(!report.disagrees, "{name}");
            // The same in the middle of a dump is no row.
            let error = golden.compare(name, &format!("{cut}\n{}\n", lines[0])).unwrap_err();
            assert!(error.to_string().contains(&format!("{name}:{count}:")), "{error}");
        }
        // The beginning of a row after the last.
        let report = golden.compare(name, &format!("{text}0")).unwrap();
        assert_eq!((report.total, report.short, report.disagrees), (1, false, true), "{name}");
    }
    // A defect is known from a short dump, too.
    let stepper = Stepper { slip: Slip::HoldSteps, ..Stepper::depth(Reader::of(&golden.profile)) };
    let text = golden.walked("dda", stepper);
    let lines: Vec<&str> = text.lines().collect();
    let report = golden.compare("dda.exp.tv", &lines[..lines.len() - 1].join("\n")).unwrap();
    assert!(
        report.short
            && report.causes.iter().any(|cause| cause.contains("a hold acts as a step right"))
    );
    // Rows after the last.
    let text = golden.set.text("edge.exp.tv");
    let report = golden.compare("edge.exp.tv", &format!("{text}0_00_0\n0_00_0\n")).unwrap();
    assert_eq!((report.total, report.short), (2, false));
    assert_eq!(report.mismatches[0].line, Some(301));
}

#[test]
fn what_is_no_dump_is_refused_with_its_line() {
    let golden = Golden::named("sgi-4k", 300);
    let good = golden.set.text("dda.exp.tv");
    let line = good.lines().next().unwrap();
    let cases: [(&str, &str); 14] = [
        ("0_8000000000_000000", "acc"), // a bit more than 39
        ("4_0000000000_000000", "op"),
        ("0_00000000000_000000", "acc"),
        ("0_000000000_000000", "acc"),
        ("0_0000000000", "the row has 2 columns, but 3 are needed"),
        ("0", "the row has 1 columns, but 3 are needed"),
        ("0_0000000000_000000_0", "don't-care mask of 17 digits"),
        ("0_0000000000_000000_00000000000000000_0", "don't-care mask"),
        ("0_0000000000_00000g", "'g'"),
        ("0_0000000000_-00001", "'-'"),
        ("0 0000000000 000000", "column"),
        ("op_acc_out", "op"),
        ("0_0000000000_0000\u{e9}", "'\u{e9}'"),
        ("__", "op"),
    ];
    for (bad, about) in cases {
        let text = format!("{line}\n\n// fine so far\n{bad}\n{line}\n");
        let error = golden.compare("dda.exp.tv", &text).unwrap_err().to_string();
        assert!(error.contains("dda.exp.tv:4: ") && error.contains(about), "{bad}: {error}");
    }
    for empty in ["", "\n", "// nothing\n", "\r\n\r\n"] {
        let error = golden.compare("dda.exp.tv", empty).unwrap_err().to_string();
        assert!(error.contains("dda.exp.tv: the dump has no rows"), "{error}");
    }
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    let path = golden.keep.path().join("dda.exp.tv");
    for garbage in [b"\xff\xfe\x00".to_vec(), vec![b'0'; 1 << 17], vec![0; 64]] {
        std::fs::write(&path, garbage).unwrap();
        let error = dump::compare(&sets[0], &path, None, 20).unwrap_err().to_string();
        assert!(error.contains("dda.exp.tv:1: "), "{error}");
    }
    // A dump of another name must say what it is.
    let path = golden.dump("simulated.txt", &good);
    let error = dump::compare(&sets[0], &path, None, 20).unwrap_err().to_string();
    assert!(error.contains("simulated.txt") && error.contains("dda.exp, edge.exp"), "{error}");
    assert_eq!(dump::compare(&sets[0], &path, Some("dda.exp"), 20).unwrap().total, 0);
    assert_eq!(dump::compare(&sets[0], &path, Some("dda.exp.tv"), 20).unwrap().total, 0);
    assert!(dump::compare(&sets[0], &path, Some("dda.cfg"), 20).is_err());
    assert!(dump::compare(&sets[0], &path, Some("edge.exp"), 20).is_err());
}

/// The name, the width and the word of each column.
type Row = Vec<(String, usize, u128)>;

/// The rows of a file, with the manifest's widths.
fn bits(golden: &Golden, name: &str) -> Vec<Row> {
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    let file = sets[0].manifest.files.iter().find(|file| file.name == name).unwrap();
    let words = |line: &str| {
        let fields = line.split('_').zip(&file.columns);
        let word = |(field, column): (&str, &guardbit::format::Column)| {
            let width = usize::try_from(column.width).unwrap();
            (column.name.clone(), width, u128::from_str_radix(field, 16).unwrap())
        };
        fields.map(word).collect()
    };
    golden.set.text(name).lines().map(words).collect()
}

fn utf16(text: &str, low_first: bool) -> Vec<u8> {
    let bytes =
        text.encode_utf16().map(|c| if low_first { c.to_le_bytes() } else { c.to_be_bytes() });
    bytes.flatten().collect()
}

/// Clause N-13: what simulators and scripts write is read, and what was assumed is said.
#[test]
fn a_dump_may_have_the_forms_of_simulators() {
    let golden = Golden::named("tiny", 150);
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    for name in ["dda.exp.tv", "setup.exp.tv", "depth.exp.tv"] {
        let text = golden.set.text(name);
        let rows = bits(&golden, name);
        let lines = |line: &dyn Fn(&Row) -> String| {
            rows.iter().map(|row| line(row) + "\n").collect::<String>()
        };
        let joined = |separator: &str, digits: &dyn Fn(usize, u128) -> String| {
            lines(&|row| {
                let words = row.iter().map(|(_, width, word)| digits(*width, *word));
                words.collect::<Vec<_>>().join(separator)
            })
        };
        let padded =
            |width: usize, word: u128| format!("{word:0digits$x}", digits = width.div_ceil(4));
        let packed = lines(&|row| {
            // From the last digit to the first.
            let mut all: Vec<u8> = Vec::new();
            for (_, width, word) in row.iter().rev() {
                all.extend((0..*width).map(|bit| u8::try_from(word >> bit & 1).unwrap()));
            }
            let digit =
                |bits: &[u8]| bits.iter().rev().fold(0, |digit, bit| digit << 1 | u32::from(*bit));
            let digits = all.chunks(4).rev().map(|bits| char::from_digit(digit(bits), 16).unwrap());
            digits.collect()
        });
        // A column more in front, and the others from the last to the first.
        let names: Vec<&str> = rows[0].iter().map(|(name, ..)| name.as_str()).rev().collect();
        let csv = format!("\"time\",{}\n", names.join(","))
            + &lines(&|row| {
                let words = row.iter().rev().map(|(_, width, word)| padded(*width, *word));
                format!("1.5ns,{}", words.collect::<Vec<_>>().join(","))
            });
        let memory = text.replace('_', "");
        let plain = |text: String| text.into_bytes();
        let cases: Vec<(&str, Vec<u8>, &[&str])> = vec![
            ("golden", plain(text.clone()), &[]),
            ("CRLF", plain(text.replace('\n', "\r\n")), &[]),
            ("capitals", plain(text.to_uppercase()), &[]),
            ("memory image", plain(format!("// 0x00000000\n@0\n{memory}")), &["$writememh"]),
            ("packed", plain(packed), &["side by side"]),
            ("blanks", plain(joined(" ", &padded)), &["$fdisplay"]),
            ("short", plain(joined("\t", &|_, word| format!("{word:x}"))), &["$fdisplay"]),
            ("CSV with a header", plain(csv), &["names of the first line", "hexadecimal", "time"]),
            (
                "CSV",
                plain(joined(";", &|_, word| format!("0x{word:x}"))),
                &["CSV without a header"],
            ),
            ("mark", [b"\xef\xbb\xbf", text.as_bytes()].concat(), &["byte order mark"]),
            ("UTF-16", utf16(&format!("\u{feff}{text}"), true), &["low byte first"]),
            ("UTF-16", utf16(&format!("\u{feff}{text}"), false), &["high byte first"]),
            ("UTF-16 without a mark", utf16(&text, true), &["low byte first"]),
            ("UTF-16 without a mark", utf16(&text, false), &["high byte first"]),
        ];
        for (what, bytes, says) in cases {
            // Columns that fill whole digits are packed as they are padded, and one column is golden.
            let whole = rows[0].iter().all(|(_, width, _)| width % 4 == 0);
            let path = golden.keep.path().join(name);
            std::fs::write(&path, &bytes).unwrap();
            let report = dump::compare(&sets[0], &path, None, 20)
                .unwrap_or_else(|error| panic!("{name} {what}: {error}"));
            assert_eq!((report.total, report.rows), (0, rows.len() as u64), "{name} {what}");
            let said = report.assumed.join("\n");
            for say in says.iter().filter(|say| !(whole && **say == "side by side")) {
                assert!(said.contains(say), "{name} {what}: {said:?}");
            }
            assert_eq!(said.is_empty(), says.is_empty(), "{name} {what}: {said:?}");
            // The last digit of the last row is another one, in whatever form.
            let at = bytes.iter().rposition(u8::is_ascii_hexdigit).unwrap();
            let mut spoilt = bytes.clone();
            spoilt[at] = if bytes[at] == b'0' { b'1' } else { b'0' };
            std::fs::write(&path, &spoilt).unwrap();
            let report = dump::compare(&sets[0], &path, None, 20);
            // A key that is another one leaves a row over and one missing.
            let wrong = report.unwrap_or_else(|error| panic!("{name} {what}: {error}"));
            assert!((1..=2).contains(&wrong.total), "{name} {what}: {}", wrong.total);
            let lines = String::from_utf8_lossy(&bytes).matches('\n').count() as u64;
            assert_eq!(
                wrong.mismatches[wrong.mismatches.len() - 1].line.unwrap_or(lines),
                lines,
                "{name} {what}"
            );
        }
        // An image that leaves rows out, and a header that lacks a column.
        for (bad, says) in [
            (format!("@1\n{memory}"), "goes on at row 1, but 0 rows are before it"),
            (format!("{}@ff\n{memory}", memory.split_inclusive('\n').next().unwrap()), "1 rows"),
            (format!("{},time\n0,0\n", names[0]), "the header has no column"),
            (format!("{0},{0}\n", names.join(",")), "times"),
        ] {
            let error = golden.compare(name, &bad).unwrap_err().to_string();
            assert!(error.contains(says), "{name}: {error}");
        }
    }
}

/// Clause N-13: a dump of another unit or of another set says whose it is, and one file of several that a device
/// answers says which are left.
#[test]
fn a_dump_of_another_origin_says_so() {
    let home = tempfile::tempdir().unwrap();
    let requests = ["tiny", "d3d11", "sgi-4k"].map(|name| request(&profile(name), "triangle"));
    write::write(&requests, home.path(), true, &options(300), &Monitor::default()).unwrap();
    let open = |name: &str| check::open(&home.path().join(name)).unwrap().0.remove(0);
    let (tiny, sgi) = (open("tiny"), open("sgi-4k"));
    let compare = |set, folder: &str, name: &str, file: Option<&str>| {
        dump::compare(set, &home.path().join(folder).join(name), file, 20)
    };
    // Another unit.
    let error = compare(&sgi, "sgi-4k", "edge.exp.tv", Some("dda.exp")).unwrap_err().to_string();
    assert!(
        error.contains("edge.exp.tv:1: ")
            && error.contains("the columns of edge.exp.tv, not of dda.exp.tv"),
        "{error}"
    );
    // Another set: of other widths, and of the same.
    let error = compare(&tiny, "sgi-4k", "dda.exp.tv", None).unwrap_err().to_string();
    assert!(error.contains("dda.exp.tv:1: "), "{error}");
    let report = compare(&sgi, "d3d11", "triangle.exp.tv", None).unwrap();
    let origin = report.origin.unwrap();
    assert!(
        origin.contains("rows are those of the set d3d11 in ")
            && origin.contains("not with sgi-4k"),
        "{origin}"
    );
    // Half of what the engine answers.
    let report = compare(&tiny, "tiny", "span.exp.tv", None).unwrap();
    assert_eq!((report.total, report.origin), (0, None));
    assert_eq!(report.others, ["triangle.exp.tv", "depth.exp.tv"]);
    assert!(compare(&tiny, "tiny", "dda.exp.tv", None).unwrap().others.is_empty());
}

#[test]
fn mismatches_are_counted_beyond_those_kept() {
    let golden = Golden::named("tiny", 1000);
    let stepper = Stepper { slip: Slip::Negated, ..Stepper::depth(Reader::of(&golden.profile)) };
    let path = golden.dump("dda.exp.tv", &golden.walked("dda", stepper));
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    let totals: Vec<(usize, u64)> = [1, 5, 100_000]
        .into_iter()
        .map(|most| {
            let report = dump::compare(&sets[0], &path, None, most).unwrap();
            (report.mismatches.len(), report.total)
        })
        .collect();
    let total = totals[2].1;
    assert!(total > 100);
    assert_eq!(totals, [(1, total), (5, total), (usize::try_from(total).unwrap(), total)]);
}
