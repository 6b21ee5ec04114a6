//! A sweep that was stopped goes on from its file, and parts are joined: whatever happened to the
//! files meanwhile, the answer is that of one run, or the file is refused and left as it is.
//! Clause Q-6.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![cfg(feature = "cli")]

use crate::run;

use guardbit::model::MODEL_VERSION;
use run::{Ran, guardbit, run_in, run_on_full_disk};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Eight budgets.
const TOY: &str = "explore tiny --scene triangle --vary guard=0..1 --vary interpolation=1..4 \
                   --no-speed --csv";
/// The same number of budgets, another request.
const OTHER: &str = "explore tiny --scene triangle --vary guard=0..1 --vary interpolation=0..3 \
                     --no-speed --csv";

/// A folder, and the answer of one run to [`TOY`].
fn toy() -> (tempfile::TempDir, String) {
    let home = tempfile::tempdir().unwrap();
    let whole = run_in(home.path(), TOY).ends(0).out;
    assert_eq!(whole.lines().count(), 1 + 8, "{whole}");
    (home, whole)
}

/// Measures into `name`, and gives what it holds.
fn save(home: &Path, request: &str, name: &str) -> Vec<u8> {
    run_in(home, &format!("{request} --save {name}")).ends(0);
    fs::read(home.join(name)).unwrap()
}

/// The file of all parts of three, `part-0` to `part-2`.
fn parts(home: &Path) {
    for part in 0..3 {
        save(home, &format!("{TOY} --shard {part}/3"), &format!("part-{part}"));
    }
}

#[test]
fn a_file_goes_on_wherever_it_was_cut() {
    let (home, whole) = toy();
    let home = home.path();
    let full = save(home, TOY, "full");
    let mut reused = 0;
    let ends = full.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(at, _)| at + 1);
    let ends: Vec<usize> = ends.collect();
    // Inside the header, at each end of a line, and on either side of it.
    let cuts =
        [0, 1, 5, 40].into_iter().chain(ends.iter().flat_map(|end| [end - 1, *end, end + 9]));
    for cut in cuts.filter(|cut| *cut <= full.len()) {
        fs::write(home.join("cut"), &full[..cut]).unwrap();
        let ran = run_in(home, &format!("{TOY} --save cut")).ends(0);
        assert_eq!(ran.out, whole, "cut at {cut}");
        let after = fs::read(home.join("cut")).unwrap();
        let kept = ends.iter().copied().filter(|end| *end <= cut).max().unwrap_or(0);
        assert_eq!(after[..kept], full[..kept], "cut at {cut}: what was known is kept");
        assert_eq!(after.split(|byte| *byte == b'\n').count(), ends.len() + 1, "cut at {cut}");
        reused += usize::from(kept > ends[0]);
        run_in(home, &format!("{TOY} --merge cut")).ends(0);
    }
    assert!(reused >= 8 * 2, "{reused} cuts left results to go on from");
}

#[test]
fn rubbish_behind_the_last_line_is_no_loss() {
    let (home, whole) = toy();
    let home = home.path();
    let full = save(home, TOY, "full");
    // As a full disk, a crash of the machine, or half a character leaves it.
    for tail in [&b"{\"index\":3,\"accu"[..], &[0; 300], b"\xc3", b"\xff\xfe"] {
        fs::write(home.join("file"), [&full, tail].concat()).unwrap();
        assert_eq!(run_in(home, &format!("{TOY} --save file")).ends(0).out, whole, "{tail:?}");
        assert_eq!(fs::read(home.join("file")).unwrap(), full, "{tail:?}");
    }
}

/// A line with the check that it has to have: the first 16 digits of the SHA-256 of the request's digest, as the
/// first line gives it, and of the line without its check.
fn sealed(header: &str, line: &str) -> String {
    let request = header.split_once("\"request\":\"").unwrap().1.split_once('"').unwrap().0;
    let (before, _) = line.rsplit_once(",\"check\":\"").unwrap();
    let digest = guardbit::vector::manifest::sha256(format!("{request}{before}}}").as_bytes());
    format!("{before},\"check\":\"{}\"}}", &digest[..16])
}

/// One digit changed makes another answer, so it is no answer at all.
#[test]
fn an_edited_digit_is_refused() {
    let (home, whole) = toy();
    let home = home.path();
    let full = String::from_utf8(save(home, TOY, "full")).unwrap();
    let header = full.lines().next().unwrap();
    for line in full.lines().skip(1) {
        assert_eq!(sealed(header, line), line);
    }
    let digits: Vec<usize> = full
        .bytes()
        .enumerate()
        .filter(|(_, byte)| byte.is_ascii_digit())
        .map(|(at, _)| at)
        .collect();
    assert!(digits.len() > 300, "{full}");
    for at in digits.into_iter().step_by(41) {
        let mut edited = full.clone().into_bytes();
        edited[at] = if edited[at] == b'9' { b'8' } else { edited[at] + 1 };
        fs::write(home.join("edited"), &edited).unwrap();
        run_in(home, &format!("{TOY} --merge edited")).complains(2, &["edited:"]);
        if at % 3 == 0 {
            run_in(home, &format!("{TOY} --save edited")).complains(2, &["edited:"]);
            assert_eq!(fs::read(home.join("edited")).unwrap(), edited, "left as it is");
        }
    }
    // Files of older versions have no check.
    let old = |line: &str| match line.rsplit_once(",\"check\":\"") {
        Some((before, _)) => format!("{before}}}\n"),
        None => format!("{line}\n"),
    };
    fs::write(home.join("old"), full.lines().map(old).collect::<String>()).unwrap();
    run_in(home, &format!("{TOY} --merge old"))
        .complains(2, &["old:2: the line has no check", "measure again"]);
    run_in(home, &format!("{TOY} --merge full")).ends(0);
    assert_eq!(run_in(home, &format!("{TOY} --merge full")).ends(0).out, whole);
}

#[test]
fn known_results_are_used_and_not_made_again() {
    let (home, whole) = toy();
    let home = home.path();
    let full = String::from_utf8(save(home, TOY, "full")).unwrap();
    // A number that no measurement gives, to see where it comes from.
    let lines: Vec<&str> = full.lines().collect();
    let marked = sealed(lines[0], &lines[1].replacen("\"operations\":", "\"operations\":777", 1));
    fs::write(home.join("marked"), format!("{}\n{marked}\n", lines[0])).unwrap();
    let out = run_in(home, &format!("{TOY} --save marked")).ends(0).out;
    assert_ne!(out, whole);
    assert_eq!(out.matches(",777").count(), 1, "{out}");
    // Of two lines for one number the later counts.
    fs::write(home.join("twice"), format!("{}\n{marked}\n{}\n", lines[0], lines[1])).unwrap();
    assert_eq!(run_in(home, &format!("{TOY} --save twice")).ends(0).out, whole);
}

#[test]
fn parts_are_joined_in_any_order_number_and_line_ending() {
    let (home, whole) = toy();
    let home = home.path();
    parts(home);
    let merge = |files: &str| run_in(home, &format!("{TOY} --merge {files}"));
    assert_eq!(merge("part-0 part-1 part-2").ends(0).out, whole);
    assert_eq!(merge("part-2 part-0 part-1").ends(0).out, whole, "swapped");
    assert_eq!(merge("part-0 part-1 part-1 part-2 part-0").ends(0).out, whole, "twice");
    let text = fs::read_to_string(home.join("part-1")).unwrap();
    fs::write(home.join("crlf"), text.replace('\n', "\r\n")).unwrap();
    assert_eq!(merge("part-0 crlf part-2").ends(0).out, whole, "CRLF");
    let (header, rest) = text.split_once('\n').unwrap();
    fs::write(home.join("doubled"), format!("{header}\n{rest}{rest}")).unwrap();
    assert_eq!(merge("part-0 doubled part-2").ends(0).out, whole, "doubled lines");
    merge("part-0 part-2").complains(2, &["3 of 8 budgets", "number 2"]);
    // The last line of a part that was cut short does not count, and is missed.
    fs::write(home.join("short"), &text[..text.len() - 9]).unwrap();
    // Threads write in the order in which they are done.
    let (last, _) = rest.trim_end().rsplit_once('\n').unwrap().1.split_once(',').unwrap();
    let number = last.strip_prefix("{\"index\":").unwrap();
    let missed = format!("number {number}");
    merge("part-0 short part-2").complains(2, &["1 of 8 budgets", &missed]);
}

#[test]
fn a_part_goes_on_in_another_parts_file() {
    let (home, whole) = toy();
    let home = home.path();
    parts(home);
    let size = |name: &str| fs::metadata(home.join(name)).unwrap().len();
    let before = size("part-0");
    let own = run_in(home, &format!("{TOY} --shard 1/3 --save part-0")).ends(0).out;
    assert_eq!(own.lines().count(), 1 + 3, "a part prints its own budgets: {own}");
    assert!(size("part-0") > before);
    assert_eq!(run_in(home, &format!("{TOY} --merge part-0 part-2")).ends(0).out, whole);
}

#[test]
fn a_part_without_a_budget_is_no_failure() {
    let (home, whole) = toy();
    let home = home.path();
    let mut files = String::new();
    let (mut empty, mut shared) = (0, 0);
    for part in 0..20 {
        let ran = run_in(home, &format!("{TOY} --shard {part}/20 --save part-{part}")).ends(0);
        if ran.err.contains("note: this part of the space contains no valid budget") {
            assert_eq!(ran.out, "");
            empty += 1;
        } else {
            assert_eq!((ran.out.lines().count(), &*ran.err), (2, ""));
            shared += 1;
        }
        files.push_str(" part-");
        files.push_str(&part.to_string());
    }
    assert_eq!((empty, shared), (12, 8));
    assert_eq!(run_in(home, &format!("{TOY} --merge{files}")).ends(0).out, whole);
    let none = "explore tiny --scene triangle --vary guard=0..1 --no-speed --shard 0/9";
    assert_eq!(run_in(home, &format!("{none} --json")).ends(0).out, "[\n]\n");
    let ran = run_in(home, &format!("{none} --html page.html --svg chart.svg")).ends(0);
    assert_eq!(ran.out, "");
    assert!(ran.err.contains("page.html is not written"), "{}", ran.err);
    assert!(!home.join("page.html").exists() && !home.join("chart.svg").exists());
}

#[test]
fn a_file_of_something_else_is_refused_and_left() {
    let (home, _) = toy();
    let home = home.path();
    save(home, OTHER, "other");
    let full = String::from_utf8(save(home, TOY, "full")).unwrap();
    let files = [
        ("notes", "my notes, one line".to_owned()),
        ("lines", "my notes\ntwo lines\n".to_owned()),
        ("json", "{\"guardbit\":\"report\"}".to_owned()),
        ("version", full.replacen("\"model\":", "\"model\":9", 1)),
        ("middle", full.replacen("\"accuracy\":{", "\"accu\n", 1)),
        ("beyond", full.replacen("{\"index\":7,", "{\"index\":8,", 1)),
        ("other", fs::read_to_string(home.join("other")).unwrap()),
    ];
    for (name, text) in files {
        fs::write(home.join(name), &text).unwrap();
        run_in(home, &format!("{TOY} --save {name}")).complains(2, &[name]);
        assert_eq!(fs::read_to_string(home.join(name)).unwrap(), text, "{name} is left");
        run_in(home, &format!("{TOY} --merge full {name}")).complains(2, &[name]);
    }
    fs::write(home.join("empty"), "").unwrap();
    run_in(home, &format!("{TOY} --merge full empty"))
        .complains(2, &["empty:1", "describe the request"]);
    run_in(home, &format!("{TOY} --merge full none")).complains(3, &["none"]);
    run_in(home, &format!("{TOY} --save none/part")).complains(3, &["none/part"]);
    run_in(home, &format!("{TOY} --save .")).complains(3, &["."]);
    assert!(!home.join("none").exists());
}

#[test]
fn a_fit_of_another_model_is_not_joined() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let request = "fit tiny --scene triangle --vary guard=0..1 --within wraps=0";
    for part in 0..2 {
        run_in(home, &format!("{request} --shard {part}/2 --save part-{part}")).ends(0);
    }
    run_in(home, &format!("{request} --merge part-0 part-1")).ends(0);
    let text = fs::read_to_string(home.join("part-1")).unwrap();
    let model = |version: u32| format!(" model {version} ");
    let later = text.replacen(&model(MODEL_VERSION), &model(MODEL_VERSION + 1), 1);
    assert_ne!(later, text, "the file names the model's version");
    fs::write(home.join("part-1"), later).unwrap();
    run_in(home, &format!("{request} --merge part-0 part-1")).complains(2, &["part-1", "another"]);
}

/// Devices that are files of this system alone.
#[cfg(target_os = "linux")]
#[test]
fn a_device_is_nothing_to_go_on_from() {
    let (home, _) = toy();
    for device in ["/dev/full", "/dev/null", "/dev/zero"] {
        let ran = run_in(home.path(), &format!("{TOY} --save {device}"));
        ran.complains(2, &[device, "not a regular file"]);
    }
}

/// A file-size limit stands for a full disk: a write takes what fits, and the next one fails.
#[cfg(unix)]
#[test]
fn a_file_that_can_grow_no_more_holds_whole_lines_and_goes_on() {
    let (home, whole) = toy();
    let home = home.path();
    let full = save(home, TOY, "full");
    let line = format!("{TOY} --threads 4 --save file");
    run_on_full_disk(home, full.len() / 2 / 1024, &line).complains(3, &["file: "]);
    let text = fs::read_to_string(home.join("file")).unwrap();
    assert!(text.ends_with("}\n") && text.lines().count() >= 2, "{text}");
    assert!(text.len() < full.len());
    assert_eq!(run_in(home, &format!("{TOY} --save file")).ends(0).out, whole);
}

/// Some tens of budgets that take a while each.
#[cfg(unix)]
const LONG: &str = "explore sgi-4k --scene knot --window 384x384 --vary sub-pixel=3..10 \
                    --vary interpolation=4..13 --no-speed --csv";

/// Starts [`LONG`] on its file, and waits until that has grown by some lines.
#[cfg(unix)]
fn started(home: &Path, threads: u16) -> std::process::Child {
    let lines = || fs::read_to_string(home.join("file")).unwrap_or_default().lines().count();
    let (before, begin) = (lines(), Instant::now());
    let mut command = guardbit();
    let more = format!("{LONG} --threads {threads} --save file");
    command.current_dir(home).args(more.split_whitespace());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while lines() < before + 4 {
        assert!(begin.elapsed() < Duration::from_mins(1), "nothing was saved");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_goes_on() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let whole = run_in(home, LONG).ends(0).out;
    let mut known: Vec<u8> = Vec::new();
    // A first time, and a second time in the middle of going on.
    for (signal, threads) in [("INT", 1), ("TERM", 2)] {
        let child = started(home, threads);
        let mut kill = std::process::Command::new("kill");
        assert!(
            kill.args([format!("-{signal}"), child.id().to_string()]).status().unwrap().success()
        );
        let ran = Ran::from(child.wait_with_output().unwrap());
        let ran = ran.complains(130, &["interrupted after ", "continue from file"]);
        assert_eq!(ran.out, "");
        let file = fs::read(home.join("file")).unwrap();
        assert!(file.ends_with(b"}\n"), "whole lines");
        assert!(file.len() > known.len() && file.starts_with(&known), "what was known is kept");
        known = file;
    }
    let ran = run_in(home, &format!("{LONG} --save file")).ends(0);
    assert_eq!(ran.out, whole);
    let file = fs::read(home.join("file")).unwrap();
    assert!(file.starts_with(&known));
    let lines = file.split(|byte| *byte == b'\n').count() - 1;
    assert_eq!(lines, whole.lines().count());
    // Now everything is known.
    run_in(home, &format!("{LONG} --save file")).ends(0);
    assert_eq!(fs::read(home.join("file")).unwrap(), file);
}

#[cfg(unix)]
#[test]
fn two_runs_do_not_write_into_one_file() {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let first = started(home, 1);
    let second = run_in(home, &format!("{LONG} --save file"));
    second.complains(2, &["file: another run is writing to it"]);
    let first = Ran::from(first.wait_with_output().unwrap()).ends(0);
    assert_eq!(run_in(home, &format!("{LONG} --merge file")).ends(0).out, first.out);
}
