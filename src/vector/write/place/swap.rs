//! A new set takes the place of an old one, file by file, and can be taken back at any moment.

use super::inventory::{self, Inventory, Why, digest_of};
use super::{OLD, is_folder, is_there};
use crate::vector::write::Monitor;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

/// The file, beside the old set, that says what is moved in its place: a digest and a path a line. If the run
/// is killed, the next one takes these files out again.
pub(super) const JOURNAL: &str = ".journal";

/// Files moved, from where to where.
#[derive(Default)]
struct Moves(Vec<(PathBuf, PathBuf)>);

impl Moves {
    /// Never onto something that is there.
    fn shift(&mut self, from: PathBuf, to: PathBuf) -> Result<()> {
        if is_there(&to) {
            return Err(Error::new(
                ErrorKind::AlreadyExists,
                format!("{} is in the way", to.display()),
            ));
        }
        fs::rename(&from, &to)?;
        self.0.push((from, to));
        Ok(())
    }

    /// Back to where they were, the last move first.
    fn undo(&self) {
        for (from, to) in self.0.iter().rev() {
            if !is_there(from) {
                let _ = fs::rename(to, from);
            }
        }
    }
}

/// Moves the old set out and the new one in, then removes the old files one by one. What is not the old set's
/// stays where it is, or, where a file of the new set has its name, is kept beside it under another name.
///
/// # Errors
/// Whatever the file system answers; then everything is where it was.
pub(super) fn exchange(
    out: &Path,
    aside: &Path,
    tag: &str,
    there: &Inventory,
    built: &[PathBuf],
    monitor: &Monitor,
) -> Result<()> {
    let old = out.join(format!("{OLD}{tag}"));
    fs::create_dir(&old)?;
    let mut moves = Moves::default();
    let result = journal(&old, aside, built, monitor)
        .and_then(|()| move_all(out, aside, &old, there, built, &mut moves));
    let kept = match result {
        Ok(kept) => kept,
        Err(error) => {
            moves.undo();
            let _ = fs::remove_file(old.join(JOURNAL));
            remove_folders(&old, &there.folders);
            return Err(error);
        }
    };
    for (path, why) in &there.strange {
        let path = out.join(path);
        if is_there(&path) && !kept.iter().any(|(from, _)| *from == path) {
            let how = match why {
                Why::Foreign => "has come while the set was written and does not belong to it",
                Why::Edited | Why::NoFile => "is not as the old set had it",
            };
            monitor.note(format!("{} {how}; it stays", path.display()));
        }
    }
    for (path, name) in kept {
        monitor.note(format!(
            "{} is not of the old set; it is kept as {}",
            path.display(),
            name.display()
        ));
    }
    discard(&old, there, monitor);
    remove_inner(out, &there.folders);
    let folders =
        built.iter().flat_map(|path| path.ancestors().skip(1)).map(Path::to_owned).collect();
    remove_folders(aside, &folders);
    Ok(())
}

/// Says what is going to be moved in, before anything moves.
fn journal(old: &Path, aside: &Path, built: &[PathBuf], monitor: &Monitor) -> Result<()> {
    let mut text = String::new();
    for path in built {
        let digest = digest_of(&aside.join(path), monitor)?;
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{digest}  {}", path.display());
    }
    fs::write(old.join(JOURNAL), text)
}

/// What had to make room, and under which name it is kept.
type Kept = Vec<(PathBuf, PathBuf)>;

fn move_all(
    out: &Path,
    aside: &Path,
    old: &Path,
    there: &Inventory,
    built: &[PathBuf],
    moves: &mut Moves,
) -> Result<Kept> {
    for folder in &there.folders {
        fs::create_dir(old.join(folder))?;
    }
    for own in &there.own {
        moves.shift(out.join(&own.path), old.join(&own.path))?;
    }
    let mut kept = Vec::new();
    for path in built {
        let mut folders: Vec<&Path> = path.ancestors().skip(1).collect();
        folders.retain(|folder| !folder.as_os_str().is_empty());
        for folder in folders.into_iter().rev() {
            let folder = out.join(folder);
            if !is_folder(&folder) {
                keep(&folder, moves, &mut kept)?;
                fs::create_dir(&folder)?;
            }
        }
        let target = out.join(path);
        keep(&target, moves, &mut kept)?;
        moves.shift(aside.join(path), target)?;
    }
    Ok(kept)
}

/// Renames what has the name of something of the new set.
fn keep(path: &Path, moves: &mut Moves, kept: &mut Kept) -> Result<()> {
    if !is_there(path) {
        return Ok(());
    }
    for n in 1u64.. {
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(if n == 1 { ".kept".to_owned() } else { format!(".kept-{n}") });
        let free = path.with_file_name(name);
        if !is_there(&free) {
            moves.shift(path.to_owned(), free.clone())?;
            kept.push((path.to_owned(), free));
            break;
        }
    }
    Ok(())
}

/// Removes an old set from the folder that keeps it, each file only if it still is what it was. Manifests go last:
/// a later run needs them if this one is killed.
pub(super) fn discard(old: &Path, set: &Inventory, monitor: &Monitor) {
    for own in set.own.iter().rev() {
        let path = old.join(&own.path);
        if own.is_same(&path) {
            let _ = fs::remove_file(path);
        }
    }
    let _ = fs::remove_file(old.join(JOURNAL));
    // All of them: a run that is killed early leaves folders for a set of which nothing has moved yet.
    remove_folders(old, &inventory::folders(old).unwrap_or_default());
    if is_there(old) {
        monitor.note(format!(
            "{} keeps what changed while the old set was replaced; move it away or delete it",
            old.display()
        ));
    }
}

/// Removes folders below one that are empty, innermost first.
fn remove_inner(root: &Path, folders: &BTreeSet<PathBuf>) {
    for folder in folders.iter().rev().filter(|folder| !folder.as_os_str().is_empty()) {
        let _ = fs::remove_dir(root.join(folder));
    }
}

/// The same, and then that one.
pub(super) fn remove_folders(root: &Path, folders: &BTreeSet<PathBuf>) {
    remove_inner(root, folders);
    let _ = fs::remove_dir(root);
}
