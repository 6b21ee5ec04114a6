//! The files of a set as they lie there, and those that no manifest lists. No link is followed.

use super::{BUFFER, CheckError, Finding, OpenSet, io};
use crate::vector::manifest::{FileEntry, hex_digest};
use crate::vector::write::{Monitor, OLD, PARTIAL};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// How a file compares with its entry in the manifest.
pub(super) enum State {
    /// Digest, length and rows are those listed.
    Same,
    /// They are not, or the file is missing.
    Differs,
    /// A link, a folder, a pipe or a device, which is not opened.
    NoFile,
}

/// Whether a path is a file itself; `None` if there is nothing.
pub(super) fn is_regular(path: &Path) -> Result<Option<bool>, CheckError> {
    match fs::symlink_metadata(path) {
        Ok(there) => Ok(Some(there.is_file())),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(io(path)(error)),
    }
}

/// Opens a file of a set, if it is there.
pub(super) fn open_regular(path: &Path) -> Result<Option<File>, CheckError> {
    match is_regular(path)? {
        None => Ok(None),
        Some(true) => File::open(path).map(Some).map_err(io(path)),
        Some(false) => {
            let message = "it is a link or no file at all, and is not read";
            Err(io(path)(Error::new(ErrorKind::InvalidInput, message)))
        }
    }
}

/// Compares a file with its entry, and reads no further than it can be the same.
pub(super) fn state(
    path: &Path,
    entry: &FileEntry,
    monitor: &Monitor,
) -> Result<State, CheckError> {
    if is_regular(path)? == Some(false) {
        return Ok(State::NoFile);
    }
    let Some(mut file) = open_regular(path)? else { return Ok(State::Differs) };
    let (mut hash, mut bytes, mut lines) = (Sha256::new(), 0u64, 0u64);
    let mut buffer = vec![0; BUFFER];
    while bytes <= entry.bytes {
        if monitor.cancel.load(Ordering::Relaxed) {
            return Err(io(path)(Error::from(ErrorKind::Interrupted)));
        }
        let read = file.read(&mut buffer).map_err(io(path))?;
        if read == 0 {
            break;
        }
        let chunk = &buffer[..read];
        hash.update(chunk);
        bytes += read as u64;
        lines += chunk.iter().map(|byte| u64::from(*byte == b'\n')).sum::<u64>();
        monitor.bytes.fetch_add(read as u64, Ordering::Relaxed);
    }
    let plain = Path::new(&entry.name).extension().is_some_and(|extension| extension == "tv");
    let rows_match = !plain || lines == entry.rows;
    let same = bytes == entry.bytes && rows_match && hex_digest(hash) == entry.sha256;
    Ok(if same { State::Same } else { State::Differs })
}

/// Vector files in the folder of a set, and in the folders there, that the manifest does not list.
pub(super) fn strange_vectors(set: &OpenSet) -> Result<Vec<Finding>, CheckError> {
    let listed: BTreeSet<PathBuf> =
        set.manifest.files.iter().map(|file| set.folder.join(&file.name)).collect();
    let mut folders = vec![set.folder.clone()];
    let mut findings = Vec::new();
    while let Some(folder) = folders.pop() {
        for path in strange_in(&folder, folder == set.folder, |path| folders.push(path))? {
            if !listed.contains(&path) {
                let message = "the manifest does not list this vector file".to_owned();
                findings.push(Finding { file: path, line: None, message });
            }
        }
    }
    findings.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(findings)
}

/// Whether a folder of this name is one in which a run builds or keeps a set.
pub(super) fn is_of_a_run(name: &str) -> bool {
    name.starts_with(PARTIAL) || name.starts_with(OLD)
}

/// The folders of runs that were killed or are at work.
pub(super) fn folders_of_runs(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let found = entries.filter(|entry| is_of_a_run(&entry.file_name().to_string_lossy()));
    let mut list: Vec<PathBuf> = found.map(|entry| entry.path()).collect();
    list.sort();
    list
}

/// Files of a folder with names of vector files; its folders go to `inner`. What a bench dumps beside them,
/// `*.dut.tv`, is none, and neither is a link in a folder in which a bench runs.
pub(super) fn strange_in(
    folder: &Path,
    with_links: bool,
    mut inner: impl FnMut(PathBuf),
) -> Result<Vec<PathBuf>, CheckError> {
    let mut list = Vec::new();
    for entry in fs::read_dir(folder).map_err(io(folder))?.filter_map(Result::ok) {
        let name = entry.file_name().to_string_lossy().into_owned();
        let vectors = [".exp.", ".cfg.", ".testfloat"].iter().any(|part| name.contains(part));
        let kind = entry.file_type().map_err(io(folder))?;
        if kind.is_dir() {
            if !is_of_a_run(&name) {
                inner(entry.path());
            }
        } else if vectors && !name.ends_with(".dut.tv") && (with_links || !kind.is_symlink()) {
            list.push(entry.path());
        }
    }
    list.sort();
    Ok(list)
}
