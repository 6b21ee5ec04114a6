//! Putting a finished set where it belongs: built aside, then moved in file by file. Only files that a
//! manifest lists, with the digests that it lists, make room. Spec clauses `N-11` and `N-17`.

mod inventory;
mod leftover;
mod swap;

use super::{INDEX, Monitor};
use crate::vector::manifest;
use inventory::Inventory;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How a folder begins in which a set is built.
pub(in crate::vector) const PARTIAL: &str = ".partial-";

/// How a folder begins that keeps the old set until the new one is in place.
pub(in crate::vector) const OLD: &str = ".old-";

/// The longest wait for another run that moves its set in. A lock on the folder that somebody else holds
/// for another reason must not stop the work.
const PATIENCE: Duration = Duration::from_secs(10);

/// Where a set is built, and what it will replace.
pub(super) struct Place {
    out: PathBuf,
    force: bool,
    /// Whether `out` is there: then the set is moved in, and the folder itself stays what it was
    /// (a mount point, the target of a link, somebody's working directory).
    inside: bool,
    aside: PathBuf,
    /// What makes the names of this run's folders its own.
    tag: String,
    /// Locked while this run lives, so that a later run can tell that this one was killed.
    _alive: Option<File>,
}

impl Place {
    /// Checks the destination before any work is done, and puts a set back that a killed run has moved.
    ///
    /// # Errors
    /// `AlreadyExists` for an occupied folder without `force`, `DirectoryNotEmpty` with it when
    /// anything in the folder is not part of a set as it was written, `NotADirectory` for a file in the way.
    pub(super) fn new(out: &Path, force: bool, monitor: &Monitor) -> Result<Self> {
        let inside = match fs::read_dir(out) {
            Ok(_) => true,
            // A link to nowhere is there, but no folder can take its place.
            Err(error) if error.kind() == ErrorKind::NotFound && !is_there(out) => false,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Err(Error::from(ErrorKind::NotADirectory));
            }
            Err(error) => return Err(error),
        };
        if inside {
            let _turn = turn(out);
            if force {
                leftover::recover(out, monitor)?;
                Inventory::of(out, monitor)?.refuse_strangers(out)?;
            } else if let Some(old) = leftover::occupied(out)? {
                if let Some(old) = old {
                    monitor.note(format!(
                        "{} holds the set that a killed run was replacing; --force puts it back before it \
                         writes the new set",
                        old.display()
                    ));
                }
                return Err(Error::from(ErrorKind::AlreadyExists));
            }
        } else if let Some(parent) = out.parent() {
            fs::create_dir_all(parent)?;
        }
        let (aside, tag) = claim(&stem(out, inside))?;
        let alive = File::open(&aside).ok().filter(|folder| folder.try_lock().is_ok());
        Ok(Self { out: out.to_owned(), force, inside, aside, tag, _alive: alive })
    }

    /// The folder to build in.
    pub(super) fn aside(&self) -> &Path {
        &self.aside
    }

    /// Moves the finished set in; whatever was there stays until it is. Looks again first: what has come
    /// since the first look is nobody's to remove.
    ///
    /// # Errors
    /// Whatever the file system answers; `AlreadyExists` if a set has come and `force` is not given.
    pub(super) fn settle(&self, monitor: &Monitor) -> Result<()> {
        let built = inventory::files(&self.aside)?;
        if !self.inside {
            match fs::rename(&self.aside, &self.out) {
                Ok(()) => {
                    leftover::sweep(&self.out, false, &built, monitor)?;
                    return Ok(());
                }
                // Another run was quicker: its set is a set like any other.
                Err(error) if !self.out.is_dir() => return Err(error),
                Err(_) => {}
            }
        }
        let _turn = turn(&self.out);
        let there = Inventory::of(&self.out, monitor)?;
        if !self.force && there.has_set() {
            return Err(Error::from(ErrorKind::AlreadyExists));
        }
        swap::exchange(&self.out, &self.aside, &self.tag, &there, &built, monitor)?;
        leftover::sweep(&self.out, true, &built, monitor)?;
        if !self.inside {
            leftover::sweep(&self.out, false, &built, monitor)?;
        }
        Ok(())
    }

    /// Removes what was built.
    pub(super) fn clear(&self) {
        let _ = fs::remove_dir_all(&self.aside);
    }
}

/// Whether a folder keeps an old set for which no new one has arrived.
pub(super) fn is_half_replaced(out: &Path) -> bool {
    leftover::occupied(out).is_ok_and(|old| old.flatten().is_some())
}

/// Whether there is anything of this name, links to nowhere included.
fn is_there(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}

/// Whether this is a folder itself, and no link to one.
fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|there| there.is_dir())
}

/// How the folders begin in which sets for `out` are built: in it, or beside it as long as it is not there.
fn stem(out: &Path, inside: bool) -> PathBuf {
    if inside {
        out.join(PARTIAL)
    } else {
        let name = out.file_name().unwrap_or_default().to_string_lossy();
        out.with_file_name(format!(".{name}{PARTIAL}"))
    }
}

/// Makes a folder that nobody else has: two runs can have one process id, each in its container.
fn claim(stem: &Path) -> Result<(PathBuf, String)> {
    let id = std::process::id();
    let mut tag = id.to_string();
    for n in 2.. {
        let mut path = OsString::from(stem);
        path.push(&tag);
        match fs::create_dir(&path) {
            Ok(()) => return Ok((path.into(), tag)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && n < 10_000 => {
                tag = format!("{id}-{n}");
            }
            Err(error) => return Err(error),
        }
    }
    unreachable!("the loop ends only by returning")
}

/// Waits until no other run moves files in a folder. `None` where there are no such locks, or somebody
/// else holds this one for long.
fn turn(out: &Path) -> Option<File> {
    let folder = File::open(out).ok()?;
    let begun = Instant::now();
    loop {
        match folder.try_lock() {
            Ok(()) => return Some(folder),
            Err(fs::TryLockError::WouldBlock) if begun.elapsed() < PATIENCE => {
                std::thread::sleep(Duration::from_millis(20));
            }
            Err(_) => return None,
        }
    }
}

/// What makes a folder a set comes last when a set is moved in, and leaves first: in between, the
/// folder is an unfinished set.
fn rank(path: &Path) -> u8 {
    let seal = path.file_name().is_some_and(|name| name == INDEX || name == manifest::NAME);
    u8::from(seal) + u8::from(seal && path.components().count() == 1)
}
