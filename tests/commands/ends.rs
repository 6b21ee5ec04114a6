//! How a command ends that is not left to finish: closed pipes, full devices, signals.
#![cfg(feature = "cli")]

use crate::command::home;
use crate::run::{Ran, guardbit, run_in};
use crate::set::tree;
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

/// Starts a command with its standard output piped.
fn spawn(folder: &Path, arguments: &str) -> std::process::Child {
    let mut command = guardbit();
    command.current_dir(folder).args(arguments.split_whitespace());
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn a_closed_pipe_is_a_quiet_end() {
    let home = home();
    for arguments in [
        "vectors tiny --scene fan --count 100000000 --out -",
        "vectors tiny --scene fan --count 100000000 --out - --zstd",
        "trace sgi-4k --scene fan --test triangle/range-ends/4",
        "budget --json",
        "profile schema",
    ] {
        let mut child = spawn(home.path(), arguments);
        let mut pipe = child.stdout.take().unwrap();
        let mut some = [0; 16];
        if arguments.starts_with("vectors") {
            pipe.read_exact(&mut some).unwrap();
        }
        drop(pipe);
        let ran = Ran::from(child.wait_with_output().unwrap()).ends(0);
        assert_eq!(ran.err, "", "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_a_failure_of_output() {
    let home = home();
    run_in(home.path(), "vectors tiny --scene fan --count 50 --out set").ends(0);
    for arguments in [
        "vectors tiny --scene fan --count 50 --out -",
        "vectors tiny --scene fan --only dda/wrap/0",
        "vectors tiny --scene fan --count 50 --out other",
        "verify set",
        "budget",
        "budget --json",
        "diff tiny sgi-4k",
        "trace tiny --scene fan",
        "profile list",
        "profile show tiny",
        "profile schema",
        "claims --only edge.width.d3d",
        "claims --only edge.width.d3d --json",
        "render tiny --scene fan",
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let mut command = guardbit();
        command.current_dir(home.path()).args(arguments.split_whitespace()).stdout(full);
        let ran = Ran::from(command.stderr(Stdio::piped()).output().unwrap());
        ran.complains(3, &["standard output: "]);
    }
}

/// Ctrl-C.
#[cfg(unix)]
fn interrupt(child: &std::process::Child) {
    signal(child, "-INT");
}

#[cfg(unix)]
fn signal(child: &std::process::Child, which: &str) {
    let mut kill = std::process::Command::new("kill");
    assert!(kill.args([which, &child.id().to_string()]).status().unwrap().success());
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() {
    let home = home();
    run_in(home.path(), "vectors tiny --scene triangle --count 20 --out old").ends(0);
    let before = tree(home.path());
    for (n, arguments) in [
        "vectors sgi-4k --scene triangle --count 400000000 --out new",
        "vectors --scene triangle --count 400000000 --out new",
        "vectors sgi-4k --scene triangle --count 400000000 --out old --force",
    ]
    .iter()
    .enumerate()
    {
        let child = spawn(home.path(), arguments);
        // Wait until it is well under way: bytes in the folder beside.
        let begun = Instant::now();
        let rows = || {
            let places = [home.path().to_owned(), home.path().join("old")];
            let folders = places.iter().flat_map(|place| std::fs::read_dir(place).unwrap());
            let mut partial = folders
                .flatten()
                .filter(|entry| entry.file_name().to_string_lossy().contains("partial"));
            partial.next().is_some_and(|folder| {
                // Metadata only: the files grow while they are looked at.
                let written = |folder: &Path| {
                    std::fs::read_dir(folder).into_iter().flatten().flatten().any(|entry| {
                        let name = entry.file_name().to_string_lossy().into_owned();
                        name.contains(".tv") && entry.metadata().is_ok_and(|file| file.len() > 0)
                    })
                };
                let below = std::fs::read_dir(folder.path()).into_iter().flatten().flatten();
                written(&folder.path()) || below.into_iter().any(|entry| written(&entry.path()))
            })
        };
        while !rows() {
            assert!(begun.elapsed() < Duration::from_secs(20), "{arguments}: does not begin");
            std::thread::sleep(Duration::from_millis(5));
        }
        interrupt(&child);
        let ran = Ran::from(child.wait_with_output().unwrap());
        ran.complains(130, &["interrupted"]);
        assert!(tree(home.path()) == before, "run {n}: what was there stays, and nothing else");
        let entries = std::fs::read_dir(home.path()).unwrap().count();
        assert_eq!(entries, 1, "no empty folder either");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_ends_a_check_at_once() {
    let home = home();
    run_in(home.path(), "vectors sgi-4k --scene triangle --count 1500000 --out set").ends(0);
    let mut child = spawn(home.path(), "verify set --recompute");
    std::thread::sleep(Duration::from_millis(150));
    // A machine quick enough to be done by now has nothing to show.
    if child.try_wait().unwrap().is_none() {
        // Nothing is caught here, and a job in the background inherits that INT is ignored.
        signal(&child, "-TERM");
        let output = child.wait_with_output().unwrap();
        assert!(
            output.status.success() != output.stdout.is_empty(),
            "a verdict or none: {output:?}"
        );
    }
}
