//! Sets and files that lie: each ends with a line that says so, soon and without much memory.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run::{guardbit, pipe_in, run_in, run_on_full_disk};
use crate::set::{Set, copy, options, profile, request, write_set};
use guardbit::profile::{read_at_most, read_text_at_most};
use guardbit::vector::check::{self, CheckError, CheckOptions, CheckReport};
use guardbit::vector::manifest::{Manifest, sha256};
use guardbit::vector::write::{self, Monitor, SetIndex};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// A check ends within this, whatever the set says.
const SOON: Duration = Duration::from_secs(20);

fn checked(dir: &Path, recompute: bool) -> Result<CheckReport, CheckError> {
    let options = CheckOptions { recompute, threads: 1, ..CheckOptions::default() };
    let begun = Instant::now();
    let report = check::check(dir, options, &Monitor::default());
    assert!(begun.elapsed() < SOON);
    report
}

/// What a check says first, whether it refuses the set or finds something in it.
fn said(dir: &Path, recompute: bool) -> String {
    match checked(dir, recompute) {
        Ok(report) => report.findings.first().map(ToString::to_string).unwrap_or_default(),
        Err(error) => error.to_string(),
    }
}

/// Writes a manifest with a digest that fits it.
fn forge(set: &Set, change: impl Fn(&mut Manifest)) {
    let mut manifest = set.manifest.clone();
    change(&mut manifest);
    fs::write(set.file("manifest.json"), manifest.to_text()).unwrap();
}

/// Clause N-12: widths and counts that no set has, with one damaged file, so that `verify` computes.
#[test]
fn numbers_of_a_manifest_do_no_harm() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    let good = golden.bytes("pkg.sv");
    fs::write(golden.file("pkg.sv"), [&good[..], b"// more\n"].concat()).unwrap();
    for width in [0, 129, 1_000_000_000, u32::MAX] {
        forge(&golden, |manifest| manifest.files[0].columns[0].width = width);
        for recompute in [false, true] {
            let said = said(&golden.folder(), recompute);
            assert!(
                said.contains(&format!("width = {width}, but a column has 1 to 128 bits")),
                "{said}"
            );
        }
    }
    for count in [u64::MAX, u64::MAX - 7, 1 << 40] {
        forge(&golden, |manifest| manifest.count = count);
        for recompute in [false, true] {
            let said = said(&golden.folder(), recompute);
            assert!(
                said.contains(&format!("count = {count}, but the vector files have")),
                "{said}"
            );
        }
    }
    // A part of so many that the count could be one: the part's own rows are compared, and they end.
    forge(&golden, |manifest| {
        manifest.count = u64::MAX;
        manifest.shard.parts = u64::MAX;
    });
    assert!(!said(&golden.folder(), true).is_empty());
    // A count that could just be: rows end with the files, and so does the check.
    forge(&golden, |manifest| manifest.count = 1 << 24);
    assert!(said(&golden.folder(), true).contains("dda."));
    // A width that a column can have, and this one has not.
    fs::write(golden.file("pkg.sv"), good).unwrap();
    for width in [1, 128] {
        forge(&golden, |manifest| manifest.files[0].columns[0].width = width);
        assert!(said(&golden.folder(), true).contains("width"));
    }
    // A terabyte that is not there.
    forge(&golden, |manifest| {
        for file in &mut manifest.files {
            (file.bytes, file.rows) = (1 << 40, 1 << 40);
        }
    });
    assert!(!said(&golden.folder(), true).is_empty());
}

/// What a forger does to a manifest.
type Change = fn(&mut Manifest);

/// Clause N-12: what a forger can say with digests that fit.
#[test]
fn every_field_of_a_manifest_is_computed_again() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    let changes: [(&str, Change); 9] = [
        ("schema", |m| m.schema += 1),
        ("format", |m| m.format = "zzz".to_owned()),
        ("scene.jsonl", |m| m.scene.name = "knot".to_owned()),
        ("refused = 7", |m| m.scene.refused = 7),
        ("sha256", |m| m.scene.sha256 = sha256(b"")),
        ("triangles", |m| m.scene.triangles += 1),
        ("listed twice", |m| m.files.push(m.files[0].clone())),
        ("\"../x.tv\" is neither", |m| m.files[0].name = "../x.tv".to_owned()),
        ("\"/etc/hostname\" is neither", |m| m.files[0].name = "/etc/hostname".to_owned()),
    ];
    for (about, change) in changes {
        forge(&golden, change);
        let said = said(&golden.folder(), true);
        assert!(said.contains(about), "{about}: {said}");
    }
    // A plain check reads the format, too.
    forge(&golden, |manifest| manifest.format = "zzz".to_owned());
    assert!(said(&golden.folder(), false).contains("format: \"zzz\" is unknown"));
    // The name of a scene that came from a file is a label: nothing computes it, and verify says so.
    forge(&golden, |manifest| manifest.scene.name = "mine".to_owned());
    let report = checked(&golden.folder(), true).unwrap();
    assert_eq!(report.findings, []);
    assert!(report.notes[0].contains("\"mine\" came from a file"), "{:?}", report.notes);
    // But the digest is another, and can be pinned.
    let pinned = |digest: &str| {
        let options = CheckOptions { digest: Some(digest), ..CheckOptions::default() };
        check::check(&golden.folder(), options, &Monitor::default()).unwrap().findings
    };
    assert!(pinned(&golden.manifest.digest)[0].message.contains("but --digest says"));
    forge(&golden, |_| {});
    assert_eq!(pinned(&golden.manifest.digest), []);
    assert_eq!(pinned(&golden.manifest.digest.to_uppercase()), []);
}

/// Clauses N-10 and N-12: an index, and what lies around the sets.
#[test]
fn an_index_lists_each_set_once_and_nothing_else() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("sets");
    let requests = ["tiny", "d3d11"].map(|name| request(&profile(name), "triangle"));
    write::write(&requests, &out, true, &options(50), &Monitor::default()).unwrap();
    assert_eq!(checked(&out, false).unwrap().findings, []);
    let text = fs::read_to_string(out.join("sets.json")).unwrap();
    let index: SetIndex = serde_json::from_str(&text).unwrap();
    let forged = |change: &dyn Fn(&mut SetIndex)| {
        let mut index = index.clone();
        change(&mut index);
        fs::write(out.join("sets.json"), index.to_text()).unwrap();
        let said = said(&out, true);
        fs::write(out.join("sets.json"), &text).unwrap();
        said
    };
    assert!(forged(&|index| index.sets.clear()).contains("the list is empty"));
    assert!(forged(&|index| index.sets.push(index.sets[0].clone())).contains("listed twice"));
    assert!(forged(&|index| _ = index.sets.remove(1)).contains("sets.json does not list this set"));
    assert!(forged(&|index| index.schema += 1).contains("schema"));
    // A set under another name.
    fs::rename(out.join("tiny"), out.join("other")).unwrap();
    let renamed = forged(&|index| index.sets[0].folder = "other".to_owned());
    assert!(renamed.contains("\"tiny\" is not the name of its folder"), "{renamed}");
    fs::rename(out.join("other"), out.join("tiny")).unwrap();
    // Vector files beside the index, and in a folder of a set.
    for stray in ["dda.exp.tv", "tiny/formal/dda.exp.tv", "tiny/work/edge.cfg.tv.zst"] {
        let path = out.join(stray);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "0_0_0\n").unwrap();
        let said = said(&out, false);
        assert!(said.contains(stray) && said.contains("does not list this vector file"), "{said}");
        fs::remove_file(&path).unwrap();
    }
    assert_eq!(checked(&out, false).unwrap().findings, []);
    // The digest of the index pins all of its sets.
    let hex = |digest: &str| format!("verify sets --digest {digest}");
    run_in(home.path(), &hex(&index.digest)).ends(0);
    let ran = run_in(home.path(), &hex(&index.sets[0].digest)).ends(1);
    assert!(ran.out.contains("but --digest says"), "{}", ran.out);
    run_in(home.path(), &hex("12")).complains(2, &["64 hexadecimal digits"]);
}

/// Clause N-12: nothing outside the folder is opened, and nothing that has no end.
#[cfg(unix)]
#[test]
fn links_are_not_followed() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("set");
    copy(&golden.folder(), &folder);
    for (name, target) in [
        ("dda.exp.tv", "/dev/zero"),
        ("scene.jsonl", "/dev/zero"),
        ("pkg.sv", "/dev/zero"),
        ("manifest.json", "/dev/zero"),
        ("dut.sv", "/etc/hostname"),
    ] {
        fs::remove_file(folder.join(name)).unwrap();
        std::os::unix::fs::symlink(target, folder.join(name)).unwrap();
        for recompute in [false, true] {
            let said = said(&folder, recompute);
            assert!(said.contains(name) && said.contains("a link or no file at all"), "{said}");
        }
        fs::remove_file(folder.join(name)).unwrap();
        fs::write(folder.join(name), golden.bytes(name)).unwrap();
    }
    assert_eq!(checked(&folder, true).unwrap().findings, []);
}

/// What is read has an end, even if the file has none.
#[test]
fn files_are_read_up_to_a_limit() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("file");
    fs::write(&path, "12345").unwrap();
    assert_eq!(read_at_most(&path, 5).unwrap(), b"12345");
    assert!(read_at_most(&path, 4).unwrap_err().to_string().contains("more than 4 bytes"));
    fs::write(&path, b"1\xff").unwrap();
    assert!(read_text_at_most(&path, 9).unwrap_err().to_string().contains("byte 1 is not UTF-8"));
    if cfg!(unix) {
        run_in(home.path(), "profile show /dev/zero").complains(3, &["more than 1048576 bytes"]);
        run_in(home.path(), "fit tiny --scene triangle --merge /dev/zero")
            .complains(3, &["more than 67108864 bytes"]);
    }
}

/// A short line has a short answer, or one that was asked for.
#[test]
fn an_answer_has_a_ceiling() {
    let home = tempfile::tempdir().unwrap();
    // x + y < 3 pixels: 3 runs and 6 samples with depth, 15 numbers.
    let line = "{\"id\": 1, \"v\": [[0,0,1],[8,0,1],[0,8,1]]}\n";
    let whole = pipe_in(home.path(), "eval tiny", line).ends(0).out;
    assert!(
        whole.starts_with("{\"id\": 1, \"rows\": [[0, 0, 3], [1, 0, 2], [2, 0, 1]]"),
        "{whole}"
    );
    assert_eq!(pipe_in(home.path(), "eval tiny --limit 15", line).ends(0).out, whole);
    let refused = pipe_in(home.path(), "eval tiny --limit 14", line).ends(2).out;
    let says = "line 1: field `v`: the answer has 15 numbers, but at most 14 are allowed; --limit N allows more";
    assert_eq!(refused, format!("{{\"id\": 1, \"error\": \"{says}\"}}\n"));
    // 6144 x 6144 / 2 samples are over the limit that nobody has to give.
    let line = "{\"v\": [[0,0,1],[1572864,0,1],[0,1572864,1]]}\n";
    let ran = pipe_in(home.path(), "eval d3d11 --window 6144x6144", line);
    assert_eq!(ran.status, Some(2));
    assert!(ran.out.len() < 200 && ran.out.contains("at most 16777216 are allowed"));
    // Records of registers.
    let line =
        "{\"words\": [\"64\",\"64\",\"96\",\"64\",\"64\",\"96\",\"48\",\"48\",\"127\",\"127\"]}\n";
    let records = pipe_in(home.path(), "eval psp", line);
    if records.status == Some(0) {
        let ran = pipe_in(home.path(), "eval psp --limit 0", line).ends(2);
        assert!(
            ran.out.contains("but an answer has at most 0; --limit N allows more"),
            "{}",
            ran.out
        );
    }
}

/// A wave file is whole or what it was before.
#[cfg(target_os = "linux")]
#[test]
fn a_wave_is_written_whole_or_not_at_all() {
    let home = tempfile::tempdir().unwrap();
    let path = |name: &str| home.path().join(name);
    run_in(home.path(), "trace tiny --scene fan --vcd w.vcd --fst w.fst").ends(0);
    let before = ["w.vcd", "w.fst"].map(|name| fs::read(path(name)).unwrap());
    assert!(before.iter().all(|bytes| bytes.len() > 100));
    for format in ["vcd", "fst"] {
        let line = format!("trace tiny --scene fan --{format} w.{format}");
        run_on_full_disk(home.path(), 0, &line).ends(3);
    }
    let after = ["w.vcd", "w.fst"].map(|name| fs::read(path(name)).unwrap());
    assert!(after == before);
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2, "nothing beside them");
    // A device is written to as it is.
    let mut full = guardbit();
    full.current_dir(home.path()).args("trace tiny --scene fan --fst /dev/full".split(' '));
    assert_eq!(full.output().unwrap().status.code(), Some(3));
}

#[cfg(target_os = "linux")]
#[test]
fn help_on_a_full_device_is_a_failure() {
    for arguments in [&["--help"][..], &["vectors", "--help"], &["--version"]] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output =
            guardbit().args(arguments).stdout(full).stderr(Stdio::piped()).output().unwrap();
        crate::run::Ran::from(output).complains(3, &["standard output: "]);
    }
    assert_eq!(guardbit().arg("--help").output().unwrap().status.code(), Some(0));
}

/// A search over a large window makes one picture for a long time, and can be stopped all the same.
#[cfg(unix)]
#[test]
fn a_search_ends_when_it_is_told() {
    let home = tempfile::tempdir().unwrap();
    let mut command = guardbit();
    command.current_dir(home.path()).args("fit d3d11 --window 16384x16384".split(' '));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(700));
    let mut kill = std::process::Command::new("kill");
    assert!(kill.args(["-TERM", &child.id().to_string()]).status().unwrap().success());
    let told = Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(told.elapsed() < Duration::from_secs(1), "{:?}", told.elapsed());
    // By its own hand, or, before the search began, by the signal's.
    assert!([Some(130), None].contains(&output.status.code()), "{output:?}");
    assert_eq!(output.stdout, b"");
}
