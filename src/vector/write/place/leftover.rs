//! What runs left that were killed: sets moved half, and folders in which a set was built.

use super::inventory::{self, Inventory, digest_of};
use super::swap::{JOURNAL, discard, remove_folders};
use super::{INDEX, OLD, PARTIAL, is_folder, is_there, stem};
use crate::vector::manifest;
use crate::vector::write::Monitor;
use std::fs::{self, File, TryLockError};
use std::io::Result;
use std::path::{Path, PathBuf};

/// Whether a folder holds anything but what killed or running runs build there, and then the old set that
/// one of them has moved, if there is one.
#[allow(clippy::option_option, reason = "empty, occupied, or occupied by an old set")]
pub(super) fn occupied(out: &Path) -> Result<Option<Option<PathBuf>>> {
    let old = begun_with(out, OLD)?.into_iter().next();
    let other = !inventory::top(out)?.is_empty();
    Ok((other || old.is_some()).then_some(old))
}

/// Folders in one whose names begin so.
fn begun_with(folder: &Path, start: &str) -> Result<Vec<PathBuf>> {
    let mut list = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_name().to_string_lossy().starts_with(start) && is_folder(&entry.path()) {
            list.push(entry.path());
        }
    }
    list.sort();
    Ok(list)
}

/// Puts back what a killed run has moved, which nothing interrupts. The caller has the turn, so nobody is
/// moving.
///
/// # Errors
/// Whatever the file system answers; a later call goes on from there.
pub(super) fn recover(out: &Path, monitor: &Monitor) -> Result<()> {
    for old in begun_with(out, OLD)? {
        if [INDEX, manifest::NAME].iter().any(|name| is_there(&out.join(name))) {
            // What makes the new set one has arrived: only the old files were left to remove.
            discard(&old, &Inventory::of(&old, &Monitor::default())?, monitor);
            continue;
        }
        take_out(out, &old)?;
        let mut stuck = 0;
        for path in inventory::files(&old)?.into_iter().filter(|path| path != Path::new(JOURNAL)) {
            let target = out.join(&path);
            let folders = path.ancestors().skip(1).map(|folder| out.join(folder));
            let blocked = folders
                .into_iter()
                .any(|folder| folder != *out && is_there(&folder) && !is_folder(&folder));
            if blocked || is_there(&target) {
                stuck += 1;
                continue;
            }
            target.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::rename(old.join(&path), target)?;
        }
        let _ = fs::remove_file(old.join(JOURNAL));
        let folders = inventory::folders(&old)?;
        remove_folders(&old, &folders);
        let out = out.display();
        monitor.note(if stuck == 0 {
            format!("{out}: a run was killed while it replaced the set; the old set is back in its place")
        } else {
            format!(
                "{out}: a run was killed while it replaced the set; {stuck} files of the old set are still in {}, \
                 because others have their names",
                old.display()
            )
        });
    }
    Ok(())
}

/// Moves the files of the new set, which the journal lists, back to where they were built.
fn take_out(out: &Path, old: &Path) -> Result<()> {
    // Older versions of this program had no journal.
    let Ok(text) = manifest::read(&old.join(JOURNAL)) else { return Ok(()) };
    let tag = old.file_name().unwrap_or_default().to_string_lossy().replacen(OLD, "", 1);
    let inside = out.join(format!("{PARTIAL}{tag}"));
    let beside = PathBuf::from(format!("{}{tag}", stem(out, false).display()));
    let aside = if is_folder(&beside) { beside } else { inside };
    for line in String::from_utf8_lossy(&text).lines() {
        let Some((digest, path)) = line.split_once("  ") else { continue };
        if !path.split(['/', '\\']).all(manifest::is_plain) {
            continue;
        }
        let (from, to) = (out.join(path), aside.join(path));
        let moved = fs::symlink_metadata(&from).is_ok_and(|there| there.is_file())
            && !is_there(&to)
            && in_folders(out, path)
            && digest_of(&from, &Monitor::default())? == digest;
        if moved {
            to.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::rename(from, to)?;
        }
    }
    Ok(())
}

/// Whether the folders on the way to a file are folders, and no links to some.
fn in_folders(out: &Path, path: &str) -> bool {
    let folders = Path::new(path).ancestors().skip(1);
    folders
        .filter(|folder| !folder.as_os_str().is_empty())
        .all(|folder| is_folder(&out.join(folder)))
}

/// Removes what killed runs have built in or beside a folder: files of the new set's names, and those of a whole
/// set that are as its manifest says. What else there is stays, and is named.
///
/// # Errors
/// Whatever the file system answers.
pub(super) fn sweep(out: &Path, inside: bool, built: &[PathBuf], monitor: &Monitor) -> Result<()> {
    let stem = stem(out, inside);
    let folder =
        stem.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let start = stem.file_name().unwrap_or_default().to_string_lossy().into_owned();
    for partial in begun_with(folder, &start)? {
        let said = partial.display();
        let lock = File::open(&partial).map(|folder| folder.try_lock().map(|()| folder));
        let _dead = match lock {
            Ok(Ok(folder)) => folder,
            // Another run is building there.
            Ok(Err(TryLockError::WouldBlock)) => continue,
            _ => {
                monitor.note(format!(
                    "{said} is left from another run; if none is running, it can be deleted"
                ));
                continue;
            }
        };
        let whole = Inventory::of(&partial, monitor)?;
        for path in built.iter().chain(whole.own.iter().map(|own| &own.path)) {
            let file = partial.join(path);
            let inner = path.to_string_lossy();
            if in_folders(&partial, &inner)
                && fs::symlink_metadata(&file).is_ok_and(|f| f.is_file())
            {
                let _ = fs::remove_file(file);
            }
        }
        remove_folders(&partial, &inventory::folders(&partial)?);
        if is_there(&partial) {
            monitor.note(format!("{said} is left from a run that was killed; it can be deleted"));
        } else {
            monitor.note(format!("{said}, which a killed run had left, was removed"));
        }
    }
    Ok(())
}
