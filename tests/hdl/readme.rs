//! What the README shows of RTL.

use crate::run::run_in;
use std::path::Path;
use std::process::Command;

fn block<'a>(readme: &'a str, kind: &str) -> &'a str {
    let (_, rest) = readme.split_once(&format!("```{kind}\n")).expect("the block is there");
    rest.split_once("```").expect("it ends").0
}

pub(crate) fn buggy_adder(_: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = std::fs::read_to_string(path).unwrap();
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), "vectors").ends(0);
    let program = Path::new(env!("CARGO_BIN_EXE_guardbit")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("bash");
    shell.args(["-e", "-c", block(&readme, "bash")]).current_dir(home.path()).env("PATH", path);
    let ran = shell.output().unwrap();
    let said = String::from_utf8_lossy(&ran.stdout);
    assert_eq!(ran.status.code(), Some(1), "{said} {}", String::from_utf8_lossy(&ran.stderr));
    assert_eq!(said, block(&readme, "output"));
    // The set is as it was but for the dumps.
    run_in(home.path(), "verify guardbit-vectors").ends(0);
}
