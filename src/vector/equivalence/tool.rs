//! Programs from outside, with a limit.

use std::fs::File;
use std::io::Result;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// What a tool printed, and whether it ended well.
pub(super) struct Ran {
    text: String,
    status: ExitStatus,
}

impl Ran {
    pub(super) fn says(&self, words: &str) -> bool {
        self.text.lines().any(|line| line.contains(words))
    }

    pub(super) fn good(&self) -> bool {
        self.status.success()
    }

    /// Its last line, or how it ended if it said nothing.
    pub(super) fn last(&self) -> String {
        let line = self.text.lines().rev().find(|line| !line.trim().is_empty());
        line.map_or_else(|| self.status.to_string(), |line| line.trim().to_owned())
    }

    /// The line that says what is wrong, or the last one.
    pub(super) fn error(&self) -> String {
        let line = self.text.lines().find(|line| line.to_lowercase().contains("error"));
        line.map_or_else(|| self.last(), str::to_owned)
    }
}

/// Runs a tool in a folder; all that it prints goes to a file, its output to another one if that is given.
/// `None` after killing it at the limit.
pub(super) fn run(
    folder: &Path,
    (tool, arguments): (&str, &[&str]),
    (log, output): (&Path, Option<&Path>),
    limit: Duration,
) -> Result<Option<Ran>> {
    // To a file: a pipe that nobody empties would stop the tool.
    let file = File::create(log)?;
    let out = output.map_or_else(|| file.try_clone(), File::create)?;
    let mut child = Command::new(tool)
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(out)
        .stderr(file)
        .spawn()?;
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if begun.elapsed() >= limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    let text = String::from_utf8_lossy(&std::fs::read(log)?).into_owned();
    Ok(Some(Ran { text, status }))
}
