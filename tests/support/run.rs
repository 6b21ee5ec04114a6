//! The command, run to its end.
#![allow(dead_code, reason = "each test file takes what it needs")]

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// The command, to be completed.
pub(crate) fn guardbit() -> Command {
    Command::new(env!("CARGO_BIN_EXE_guardbit"))
}

/// What a run gave.
pub(crate) struct Ran {
    pub(crate) status: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
    pub(crate) bytes: Vec<u8>,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        Self {
            status: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
            bytes: output.stdout,
        }
    }
}

impl Ran {
    /// Fails unless it ended with this status.
    #[track_caller]
    pub(crate) fn ends(self, status: i32) -> Self {
        assert_eq!(self.status, Some(status), "\nout: {}\nerr: {}", self.out, self.err);
        self
    }

    /// Fails unless standard error is one `error:` line, with at most one hint, saying all this.
    #[track_caller]
    pub(crate) fn complains(self, status: i32, about: &[&str]) -> Self {
        let ran = self.ends(status);
        let errors = ran.err.lines().filter(|line| line.starts_with("error: ")).count();
        assert_eq!(errors, 1, "{}", ran.err);
        assert!(!ran.err.contains("panicked"), "{}", ran.err);
        for part in about {
            assert!(ran.err.contains(part), "{part:?} is not in {:?}", ran.err);
        }
        ran
    }
}

/// Runs in a folder, arguments split at blanks.
pub(crate) fn run_in(folder: &Path, arguments: &str) -> Ran {
    let mut command = guardbit();
    command.current_dir(folder).args(arguments.split_whitespace());
    command.output().unwrap().into()
}

/// The same where no file can have more than so many blocks of 1024 bytes, which stands for a full disk. The signal
/// of the limit is ignored, so that it is an error of the write.
pub(crate) fn run_on_full_disk(folder: &Path, blocks: usize, arguments: &str) -> Ran {
    let program = env!("CARGO_BIN_EXE_guardbit");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} {arguments}");
    let mut shell = Command::new("bash");
    shell.current_dir(folder).args(["-c", &script]).output().unwrap().into()
}

/// The same with a text on standard input.
pub(crate) fn pipe_in(folder: &Path, arguments: &str, input: &str) -> Ran {
    let mut command = guardbit();
    command.current_dir(folder).args(arguments.split_whitespace());
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = pipes.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap().into()
}
