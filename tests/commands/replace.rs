//! `vectors --force`: what is replaced, what stays, and what a killed run leaves.

use crate::run::{guardbit, run_in, run_on_full_disk};
use crate::set::{copy, options, profile, request, tree, write_set};
use guardbit::vector::check::{self, CheckOptions};
use guardbit::vector::manifest::Manifest;
use guardbit::vector::write::{self, Monitor, Options, SetIndex};
use std::fs;
use std::io::{ErrorKind, Result};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

fn force(count: u64) -> Options {
    Options { force: true, ..options(count) }
}

/// Writes a set of the profile tiny, and the notes that came of it.
fn write_tiny(out: &Path, options: &Options) -> (Result<Vec<Manifest>>, Vec<String>) {
    let monitor = Monitor::default();
    let requests = [request(&profile("tiny"), "triangle")];
    let written = write::write(&requests, out, false, options, &monitor);
    (written, monitor.notes.into_inner().unwrap())
}

/// The number of rows that the set in a folder was asked for; it has to be a whole set, alone in its folder.
fn count_of(folder: &Path) -> u64 {
    let monitor = Monitor::default();
    let report =
        check::check(folder, CheckOptions { threads: 1, ..CheckOptions::default() }, &monitor);
    let report = report.unwrap();
    assert_eq!(report.findings, []);
    let manifest = &report.sets[0].manifest;
    assert_eq!(tree(folder).len(), manifest.files.len() + 1, "nothing but the set");
    manifest.count
}

// Clause N-17
#[test]
fn what_is_not_as_written_is_no_set_to_replace() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    let out = golden.folder();
    let refused = |about: &str| {
        let before = tree(&out);
        let (written, _) = write_tiny(&out, &force(60));
        let error = written.unwrap_err();
        assert_eq!(error.kind(), ErrorKind::DirectoryNotEmpty);
        assert!(error.to_string().contains(about), "{error}");
        assert!(tree(&out) == before, "{about}");
    };
    // A device that somebody has written in the place of the empty one.
    let device = golden.text("dut.sv");
    fs::write(golden.file("dut.sv"), device.clone() + "// mine\n").unwrap();
    refused("dut.sv was edited: its digest is not that of the set");
    // A folder in its place.
    fs::remove_file(golden.file("dut.sv")).unwrap();
    fs::create_dir(golden.file("dut.sv")).unwrap();
    fs::write(golden.file("dut.sv/top.sv"), "module top; endmodule\n").unwrap();
    refused("dut.sv is not a regular file");
    fs::remove_dir_all(golden.file("dut.sv")).unwrap();
    // A link in its place.
    #[cfg(unix)]
    {
        fs::write(golden.folder().parent().unwrap().join("real.sv"), &device).unwrap();
        std::os::unix::fs::symlink("../real.sv", golden.file("dut.sv")).unwrap();
        let (written, _) = write_tiny(&out, &force(60));
        assert!(written.unwrap_err().to_string().contains("dut.sv is not a regular file"));
        fs::remove_file(golden.file("dut.sv")).unwrap();
        assert_eq!(fs::read_to_string(out.parent().unwrap().join("real.sv")).unwrap(), device);
        fs::remove_file(out.parent().unwrap().join("real.sv")).unwrap();
    }
    // A manifest that somebody edited can list anything.
    let text = golden.text("manifest.json");
    fs::write(golden.file("manifest.json"), text.replacen("\"seed\": 1", "\"seed\": 2", 1))
        .unwrap();
    refused("manifest.json was edited");
    fs::write(golden.file("manifest.json"), text).unwrap();
    // A file that is missing, and what a bench dumped, are in nobody's way.
    fs::write(golden.file("dda.exp.dut.tv"), "0_0_0\n").unwrap();
    write_tiny(&out, &force(60)).0.unwrap();
    assert_eq!(count_of(&out), 60);
}

// Clause N-17
#[test]
fn an_index_that_points_elsewhere_removes_nothing_there() {
    let home = tempfile::tempdir().unwrap();
    let (out, outside) = (home.path().join("sets"), home.path().join("outside"));
    let requests = ["tiny", "d3d11"].map(|name| request(&profile(name), "triangle"));
    write::write(&requests, &out, true, &options(50), &Monitor::default()).unwrap();
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    copy(&golden.folder(), &outside);
    let before = tree(&outside);
    let text = fs::read_to_string(out.join("sets.json")).unwrap();
    let index: SetIndex = serde_json::from_str(&text).unwrap();
    let absolute = outside.display().to_string();
    for folder in ["../outside", "./../outside", absolute.as_str(), "..", "."] {
        let mut forged = index.clone();
        forged.sets[0].folder = folder.to_owned();
        fs::write(out.join("sets.json"), forged.to_text()).unwrap();
        let written = write::write(&requests, &out, true, &force(60), &Monitor::default());
        let error = written.unwrap_err().to_string();
        assert!(error.contains("does not belong to a vector set"), "{folder}: {error}");
        assert!(tree(&outside) == before, "{folder}");
        // Nor is anything read there.
        let checked = check::check(&out, CheckOptions::default(), &Monitor::default());
        let error = checked.unwrap_err().to_string();
        assert!(error.contains("is no plain folder name"), "{folder}: {error}");
    }
    fs::write(out.join("sets.json"), text).unwrap();
    // A folder that is a link leads elsewhere, too.
    #[cfg(unix)]
    {
        fs::remove_dir_all(out.join("tiny")).unwrap();
        std::os::unix::fs::symlink(&outside, out.join("tiny")).unwrap();
        let written = write::write(&requests, &out, true, &force(60), &Monitor::default());
        let error = written.unwrap_err().to_string();
        assert!(error.contains("tiny does not belong to a vector set"), "{error}");
        assert!(tree(&outside) == before);
        fs::remove_file(out.join("tiny")).unwrap();
    }
    write::write(&requests, &out, true, &force(60), &Monitor::default()).unwrap();
    assert_eq!(fs::read_dir(&out).unwrap().count(), 3);
}

// Clause N-17
#[test]
fn what_comes_while_a_set_is_written_stays() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    let out = golden.folder();
    let seen = |notes: &[String], about: &str| notes.iter().any(|note| note.contains(about));
    // The files have to come in time: a longer run is tried where they did not.
    for count in (0..).map(|n| 20_000 << n) {
        let _ = fs::remove_file(out.join("results.log"));
        let _ = fs::remove_dir_all(out.join("mydesign"));
        let _ = fs::remove_file(out.join("dut.sv.kept"));
        let monitor = Monitor::default();
        let requests = [request(&profile("tiny"), "triangle")];
        std::thread::scope(|scope| {
            let writer =
                scope.spawn(|| write::write(&requests, &out, false, &force(count), &monitor));
            while monitor.bytes.load(Ordering::Relaxed) == 0 {
                std::thread::yield_now();
            }
            fs::write(out.join("results.log"), "all tests pass\n").unwrap();
            fs::create_dir_all(out.join("mydesign")).unwrap();
            fs::write(out.join("mydesign/top.sv"), "module top; endmodule\n").unwrap();
            fs::write(out.join("dut.sv"), "// mine\n").unwrap();
            writer.join().unwrap().unwrap();
        });
        let notes = monitor.notes.into_inner().unwrap();
        if !seen(&notes, "results.log has come while the set was written") {
            fs::write(out.join("dut.sv"), golden.bytes("dut.sv")).unwrap();
            continue;
        }
        assert!(seen(&notes, "dut.sv is not of the old set; it is kept as"), "{notes:?}");
        break;
    }
    assert_eq!(fs::read_to_string(out.join("results.log")).unwrap(), "all tests pass\n");
    assert_eq!(fs::read_to_string(out.join("mydesign/top.sv")).unwrap(), "module top; endmodule\n");
    assert_eq!(fs::read_to_string(out.join("dut.sv.kept")).unwrap(), "// mine\n");
    let report = check::check(&out, CheckOptions::default(), &Monitor::default()).unwrap();
    assert_eq!(report.findings, []);
}

/// The steps that a run takes once its set is built, as `N-17` has them: out with the old, its manifest first; in
/// with the new, its manifest last; then the old files go.
fn steps(old: &[String], new: &[String]) -> Vec<(char, String)> {
    let seal = |name: &&String| *name == "manifest.json";
    let out = old.iter().filter(seal).chain(old.iter().filter(|name| !seal(name)));
    let inward = new.iter().filter(|name| !seal(name)).chain(new.iter().filter(seal));
    let gone = old.iter().filter(|name| !seal(name)).chain(old.iter().filter(seal));
    let step = |what: char| move |name: &String| (what, name.clone());
    out.map(step('o')).chain(inward.map(step('i'))).chain(gone.map(step('d'))).collect()
}

// Clause N-17
#[test]
fn a_run_that_is_killed_between_two_files_is_made_good() {
    let [old, new] = [50, 60].map(|count| write_set(&profile("tiny"), "triangle", &options(count)));
    let names = |set: &crate::set::Set| -> Vec<String> {
        tree(&set.folder()).into_iter().map(|(name, _)| name).collect()
    };
    let steps = steps(&names(&old), &names(&new));
    let home = tempfile::tempdir().unwrap();
    let arrived = steps.iter().position(|step| *step == ('i', "manifest.json".to_owned())).unwrap();
    for done in (0..=steps.len()).step_by(6).chain([1, 29, 30, arrived, arrived + 1]) {
        let out = home.path().join(format!("after-{done}"));
        copy(&old.folder(), &out);
        let [aside, kept] = [".partial-77", ".old-77"].map(|name| out.join(name));
        copy(&new.folder(), &aside);
        fs::create_dir_all(kept.join("formal")).unwrap();
        let line = |name: &String| {
            let digest = guardbit::vector::manifest::sha256(&new.bytes(name));
            format!("{digest}  {name}\n")
        };
        fs::write(kept.join(".journal"), names(&new).iter().map(line).collect::<String>()).unwrap();
        let shift = |from: &Path, to: &Path, name: &str| {
            fs::create_dir_all(to.join(name).parent().unwrap()).unwrap();
            fs::rename(from.join(name), to.join(name)).unwrap();
        };
        for (what, name) in &steps[..done] {
            match what {
                'o' => shift(&out, &kept, name),
                'i' => shift(&aside, &out, name),
                _ => fs::remove_file(kept.join(name)).unwrap(),
            }
        }
        // The next run is stopped before it writes a row: there is a whole set all the same.
        let monitor = Monitor { cancel: AtomicBool::new(true), ..Monitor::default() };
        let requests = [request(&profile("tiny"), "triangle")];
        let written = write::write(&requests, &out, false, &force(70), &monitor);
        assert_eq!(written.unwrap_err().kind(), ErrorKind::Interrupted);
        let notes = monitor.notes.into_inner().unwrap();
        let manifest = fs::read_to_string(out.join("manifest.json")).unwrap();
        let manifest: Manifest = serde_json::from_str(&manifest).unwrap();
        let (expected, said) = if done > arrived { (60, "") } else { (50, "back in its place") };
        assert_eq!(manifest.count, expected, "{done} steps done");
        assert!(
            done == 0 || done > arrived || notes.iter().any(|note| note.contains(said)),
            "{done}: {notes:?}"
        );
        // And the same command does what it was asked for, and leaves nothing of the killed run.
        write_tiny(&out, &force(70)).0.unwrap();
        assert_eq!(count_of(&out), 70, "{done} steps done");
        fs::remove_dir_all(&out).unwrap();
    }
}

// Clause N-17
#[cfg(unix)]
#[test]
fn a_run_that_is_killed_while_it_builds_does_not_stop_the_next() {
    let home = tempfile::tempdir().unwrap();
    let partial = || {
        let folders = [home.path().to_owned(), home.path().join("set")];
        let entries = folders.iter().filter_map(|folder| fs::read_dir(folder).ok()).flatten();
        entries.flatten().any(|entry| entry.file_name().to_string_lossy().contains(".partial-"))
    };
    // Beside a folder that is not there yet, in an empty one, and in one with a set.
    for before in ["nothing", "empty", "set"] {
        let _ = fs::remove_dir_all(home.path().join("set"));
        match before {
            "empty" => fs::create_dir(home.path().join("set")).unwrap(),
            "set" => _ = write_tiny(&home.path().join("set"), &options(50)).0.unwrap(),
            _ => {}
        }
        let forced = if before == "set" { " --force" } else { "" };
        let arguments = |count: u64| {
            format!("vectors tiny --scene triangle --out set --threads 1 --count {count}{forced}")
        };
        let mut command = guardbit();
        command.current_dir(home.path()).args(arguments(100_000_000).split_whitespace());
        let mut child = command.stderr(std::process::Stdio::null()).spawn().unwrap();
        while !partial() {
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(partial());
        if before == "set" {
            // What is left is named.
            let ran = run_in(home.path(), "verify set").ends(0);
            assert!(ran.err.contains("is of a run that was killed"), "{}", ran.err);
        }
        let ran = run_in(home.path(), &arguments(60)).ends(0);
        assert!(ran.err.contains("which a killed run had left, was removed"), "{}", ran.err);
        assert!(!partial(), "{before}");
        assert_eq!(count_of(&home.path().join("set")), 60);
    }
}

// Clause N-17
#[test]
fn two_writers_of_one_process_id_both_end_well() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("set");
    for round in 0..3 {
        let results = std::thread::scope(|scope| {
            let writers = [40, 41].map(|count| {
                let out = &out;
                scope.spawn(move || write_tiny(out, &force(count)).0.map(|_| ()))
            });
            writers.map(|writer| writer.join().unwrap())
        });
        for result in results {
            result.unwrap_or_else(|error| panic!("round {round}: {error}"));
        }
        assert!([40, 41].contains(&count_of(&out)));
    }
    // Without --force the second finds the first's set, and nothing of its own is left.
    fs::remove_dir_all(&out).unwrap();
    let results = std::thread::scope(|scope| {
        let writers = [40, 41].map(|count| {
            let out = &out;
            scope.spawn(move || write_tiny(out, &options(count)).0.map(|_| ()))
        });
        writers.map(|writer| writer.join().unwrap())
    });
    assert_eq!(results.iter().filter(|result| result.is_ok()).count(), 1, "{results:?}");
    let refused = results.into_iter().find_map(Result::err).unwrap();
    assert_eq!(refused.kind(), ErrorKind::AlreadyExists);
    assert!([40, 41].contains(&count_of(&out)));
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
}

// Clause N-17
#[test]
fn a_set_that_is_half_replaced_is_named() {
    let home = tempfile::tempdir().unwrap();
    let set = home.path().join("set");
    write_tiny(&set, &options(50)).0.unwrap();
    let kept = set.join(".old-77");
    fs::create_dir(&kept).unwrap();
    fs::rename(set.join("manifest.json"), kept.join("manifest.json")).unwrap();
    run_in(home.path(), "verify set")
        .complains(2, &["this is not a complete set", "hint: a run was killed", "--force"]);
    let ran = run_in(home.path(), "vectors tiny --scene triangle --out set --count 60");
    let ran = ran.complains(2, &["exists and is not empty"]);
    assert!(
        ran.err.contains(".old-77 holds the set that a killed run was replacing"),
        "{}",
        ran.err
    );
    let ran =
        run_in(home.path(), "vectors tiny --scene triangle --out set --count 60 --force").ends(0);
    assert!(ran.err.contains("the old set is back in its place"), "{}", ran.err);
    assert_eq!(count_of(&set), 60);
}

// Clause N-11
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_old_set() {
    let home = tempfile::tempdir().unwrap();
    write_tiny(&home.path().join("set"), &options(50)).0.unwrap();
    let before = tree(home.path());
    for (out, force) in [("new", ""), ("set", "--force")] {
        let line = format!("vectors tiny --scene triangle --count 5000 --out {out} {force}");
        run_on_full_disk(home.path(), 8, &line).ends(3);
        assert!(tree(home.path()) == before, "{out}");
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }
}
