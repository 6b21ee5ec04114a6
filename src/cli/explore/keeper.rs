//! The file that results go to as they come, and that a later run goes on from.

use super::session::LARGEST;
use super::{Failure, Write};
use guardbit::explore::store::{self, Header, Results};
use guardbit::explore::sweep::{Found, Sweep};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// The file, open and locked: of whole lines always.
pub(super) struct Keeper {
    file: File,
    path: PathBuf,
    header: Header,
    /// Bytes that are whole lines.
    whole: u64,
}

impl Keeper {
    /// Opens a file, and reads what it holds.
    pub(super) fn open(path: &Path, sweep: &Sweep, results: &mut Results) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let failed = |error: &std::io::Error| Failure::io(&name, error);
        let unfit = |what: &str| {
            Failure::input(format!("{name}: {what}")).hint("name another file with --save")
        };
        // A device or a pipe can be written to, but never be gone on from; some have no end.
        if std::fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir()) {
            return Err(unfit("not a regular file; a sweep can continue only from a regular file"));
        }
        let mut options = OpenOptions::new();
        options.create(true).truncate(false).read(true).write(true);
        let mut file = options.open(path).map_err(|error| failed(&error))?;
        // Lines of two runs would end up inside each other. Where a file system has no locks the
        // user has to see to it.
        if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return Err(unfit("another run is writing to it"));
        }
        let mut bytes = Vec::new();
        let most = (&mut file).take(LARGEST + 1).read_to_end(&mut bytes);
        if most.map_err(|error| failed(&error))? as u64 > LARGEST {
            return Err(unfit("larger than any file of results"));
        }
        let header = Header::new(sweep);
        let first = header.line();
        // Whatever is behind the last newline was cut short and is written again.
        let whole = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        if whole > 0 {
            let text = std::str::from_utf8(&bytes[..whole])
                .map_err(|_| unfit("not a text file with results of `explore --save`"))?;
            store::read(sweep, &name, text, results)
                .map_err(|error| Failure::input(error).hint("name another file with --save"))?;
        } else if !first.as_bytes().starts_with(&bytes) {
            return Err(unfit("not a file with results of `explore --save`"));
        }
        let whole = whole as u64;
        file.set_len(whole).map_err(|error| failed(&error))?;
        file.seek(SeekFrom::Start(whole)).map_err(|error| failed(&error))?;
        let mut keeper = Self { file, path: path.to_owned(), header, whole };
        if whole == 0 {
            keeper.write(&first)?;
        }
        Ok(keeper)
    }

    /// Adds a result.
    pub(super) fn add(&mut self, found: &Found) -> Result<(), Failure> {
        let line = store::line(&self.header, found);
        self.write(&line)
    }

    /// Adds a line. After a failure nothing of it is left, and nothing may be added.
    fn write(&mut self, line: &str) -> Result<(), Failure> {
        self.file.write_all(line.as_bytes()).map_err(|error| {
            let _ = self.file.set_len(self.whole);
            Failure::io(&self.path.display().to_string(), &error)
        })?;
        self.whole += line.len() as u64;
        Ok(())
    }
}
