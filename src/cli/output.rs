//! Standard output through one locked, buffered writer.

use super::failure::Failure;
use std::fs::File;
use std::io::{BufWriter, StdoutLock, Write};
use std::path::{Path, PathBuf};

/// The locked writer of a command.
pub(crate) struct Output(BufWriter<StdoutLock<'static>>);

impl Output {
    pub(crate) fn new() -> Self {
        Self(BufWriter::new(std::io::stdout().lock()))
    }

    /// One line.
    pub(crate) fn line(&mut self, text: impl AsRef<str>) -> Result<(), Failure> {
        self.text(text)?;
        self.text("\n")
    }

    /// Text as it is.
    pub(crate) fn text(&mut self, text: impl AsRef<str>) -> Result<(), Failure> {
        self.0.write_all(text.as_ref().as_bytes()).map_err(|e| Failure::io("standard output", &e))
    }

    /// A value as indented JSON and a newline.
    pub(crate) fn json(&mut self, value: &impl serde::Serialize) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(value).map_err(Failure::input)?;
        self.line(text)?;
        self.flush()
    }

    /// Everything written so far leaves the process.
    pub(crate) fn flush(&mut self) -> Result<(), Failure> {
        self.0.flush().map_err(|e| Failure::io("standard output", &e))
    }
}

/// A new file in which another is written until it is whole. Two processes can have one id, each in its
/// container, and a killed one leaves its file: neither may be in the way.
fn aside(path: &Path) -> std::io::Result<(File, PathBuf)> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut tag = std::process::id().to_string();
    for n in 2.. {
        let aside = path.with_file_name(format!(".{name}.partial-{tag}"));
        match File::create_new(&aside) {
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists && n < 10_000 => {
                tag = format!("{}-{n}", std::process::id());
            }
            made => return made.map(|file| (file, aside)),
        }
    }
    unreachable!("the loop ends only by returning")
}

/// Whether [`write_whole`] will have a place to write to, found out by trying; nothing is left.
pub(crate) fn check_place(path: &Path) -> Result<(), Failure> {
    let failed = |error: &std::io::Error| Failure::io(&path.display().to_string(), error);
    match std::fs::metadata(path) {
        Ok(there) if there.is_dir() => Err(failed(&std::io::ErrorKind::IsADirectory.into())),
        Ok(there) if !there.is_file() => Ok(()),
        _ => aside(path)
            .and_then(|(_, aside)| std::fs::remove_file(&aside))
            .map_err(|error| failed(&error)),
    }
}

/// Writes a file aside and renames it when it is whole: nothing is left half-written.
pub(crate) fn write_whole(
    path: &Path,
    write: impl FnOnce(BufWriter<File>) -> std::io::Result<()>,
) -> Result<(), Failure> {
    // A device or a pipe is written to as it is: a rename would put a file in its place.
    if std::fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return File::create(path)
            .and_then(|file| write(BufWriter::new(file)))
            .map_err(|error| Failure::io(&path.display().to_string(), &error));
    }
    let failed = |error: &std::io::Error| Failure::io(&path.display().to_string(), error);
    let (file, aside) = aside(path).map_err(|error| failed(&error))?;
    let result = write(BufWriter::new(file)).and_then(|()| std::fs::rename(&aside, path));
    result.map_err(|error| {
        let _ = std::fs::remove_file(&aside);
        failed(&error)
    })
}

/// Writes a text file, whole or not at all.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    write_bytes(path, text.as_bytes())
}

/// Writes a file, whole or not at all.
pub(crate) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    write_whole(path, |mut file| {
        file.write_all(bytes)?;
        file.flush()
    })
}
