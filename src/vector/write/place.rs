//! Putting a finished set where it belongs: aside, then in place, old sets kept until it is.

use super::INDEX;
use crate::vector::manifest;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::io::{Error, ErrorKind, Result};
use std::path::{Component, Path, PathBuf};

/// Where a set is built, and what it will replace.
pub(super) struct Place {
    out: PathBuf,
    /// Whether `out` is there: then the set is moved in, and the folder itself stays what it was
    /// (a mount point, the target of a link, somebody's working directory).
    exists: bool,
    aside: PathBuf,
}

impl Place {
    /// Checks the destination before any work is done.
    ///
    /// # Errors
    /// `AlreadyExists` for an occupied folder without `force`, `DirectoryNotEmpty` with it when
    /// anything in the folder is not part of a set, `NotADirectory` for a file in the way.
    pub(super) fn new(out: &Path, force: bool) -> Result<Self> {
        let tag = std::process::id();
        let entries = match fs::read_dir(out) {
            Ok(entries) => entries.collect::<Result<Vec<_>>>()?,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                let name = out.file_name().unwrap_or_default().to_string_lossy();
                let aside = out.with_file_name(format!(".{name}.partial-{tag}"));
                return Ok(Self { out: out.to_owned(), exists: false, aside });
            }
            Err(error) => return Err(error),
        };
        if !entries.is_empty() {
            if !force {
                return Err(Error::from(ErrorKind::AlreadyExists));
            }
            let (ours, inner) = made_by_us(out);
            if let Some(entry) = entries.iter().find(|entry| !ours.contains(&entry.file_name())) {
                // In the folder of a set, what stands between its files is meant, not the set.
                let strange = inner.unwrap_or_else(|| entry.path());
                let message = format!("{} does not belong to a vector set", strange.display());
                return Err(Error::new(ErrorKind::DirectoryNotEmpty, message));
            }
        }
        let aside = out.join(format!(".partial-{tag}"));
        Ok(Self { out: out.to_owned(), exists: true, aside })
    }

    /// The folder to build in.
    pub(super) fn aside(&self) -> &Path {
        &self.aside
    }

    /// Moves the finished set in; whatever was there stays until it is.
    pub(super) fn settle(&self) -> Result<()> {
        if !self.exists {
            return fs::rename(&self.aside, &self.out);
        }
        let old = self.out.join(format!(".old-{}", std::process::id()));
        fs::create_dir(&old)?;
        let mut moved = Vec::new();
        let result = self.exchange(&old, &mut moved);
        if result.is_err() {
            // Back to where it was, last move first.
            for (from, to) in moved.iter().rev() {
                let _ = fs::rename(to, from);
            }
            let _ = fs::remove_dir(&old);
            return result;
        }
        let _ = fs::remove_dir(&self.aside);
        fs::remove_dir_all(&old)
    }

    /// The manifest leaves first and arrives last: in between the folder is an unfinished set.
    fn exchange(&self, old: &Path, moved: &mut Vec<(PathBuf, PathBuf)>) -> Result<()> {
        let mut shift = |from: PathBuf, to: PathBuf| {
            fs::rename(&from, &to)?;
            moved.push((from, to));
            Ok::<(), Error>(())
        };
        let skipped = [self.aside.clone(), old.to_owned()];
        for name in names(&self.out)? {
            let from = self.out.join(&name);
            if !skipped.contains(&from) {
                shift(from, old.join(&name))?;
            }
        }
        for name in names(&self.aside)?.into_iter().rev() {
            shift(self.aside.join(&name), self.out.join(&name))?;
        }
        Ok(())
    }

    /// Removes what was built.
    pub(super) fn clear(&self) {
        let _ = fs::remove_dir_all(&self.aside);
    }
}

/// Entries of a folder, what makes it a set before the rest.
fn names(folder: &Path) -> Result<Vec<OsString>> {
    let mut names = fs::read_dir(folder)?
        .map(|entry| Ok(entry?.file_name()))
        .collect::<Result<Vec<OsString>>>()?;
    let rest = |name: &OsString| name != INDEX && name != manifest::NAME;
    names.sort_by_key(|name| (rest(name), name.clone()));
    Ok(names)
}

/// What a manifest of any version lists.
#[derive(Deserialize)]
struct Listed {
    files: Vec<ListedFile>,
}

#[derive(Deserialize)]
struct ListedFile {
    name: String,
}

/// What an index of any version lists.
#[derive(Deserialize)]
struct ListedSets {
    sets: Vec<ListedSet>,
}

#[derive(Deserialize)]
struct ListedSet {
    folder: String,
}

/// What a file says, if it is there and says it.
fn listed<T: DeserializeOwned>(path: &Path) -> Option<T> {
    serde_json::from_slice(&fs::read(path).ok()?).ok()
}

/// What a run of this program, of any version, left in a folder, which is nothing if there is no set to
/// be read; and what it did not leave in a folder of its own inside.
fn made_by_us(out: &Path) -> (BTreeSet<OsString>, Option<PathBuf>) {
    let (mut ours, mut inner) = (BTreeSet::new(), None);
    let mut take = |name: OsString, strange: Option<PathBuf>| match strange {
        None => _ = ours.insert(name),
        Some(path) => inner = inner.take().or(Some(path)),
    };
    if let Some(index) = listed::<ListedSets>(&out.join(INDEX)) {
        take(OsString::from(INDEX), None);
        for set in index.sets {
            let folder = out.join(&set.folder);
            let strange = match left(&folder) {
                Some(files) => stranger(&folder, &folder, &files),
                // Nobody knows what is in a folder without a manifest.
                None => Some(folder),
            };
            take(OsString::from(set.folder), strange);
        }
    } else {
        let files = left(out).unwrap_or_default();
        for file in &files {
            let Some(Component::Normal(name)) = file.components().next() else { continue };
            let path = out.join(name);
            let strange = if path.is_dir() { stranger(out, &path, &files) } else { None };
            take(name.to_owned(), strange);
        }
    }
    (ours, inner)
}

/// The files of the set in a folder, and what a bench of it dumps beside the files that it compares.
fn left(folder: &Path) -> Option<BTreeSet<PathBuf>> {
    let listed: Listed = listed(&folder.join(manifest::NAME))?;
    let names = listed.files.into_iter().flat_map(|file| {
        let dump = file.name.strip_suffix(".exp.tv").map(|stem| format!("{stem}.exp.dut.tv"));
        dump.into_iter().chain([file.name])
    });
    Some(names.chain([manifest::NAME.to_owned()]).map(PathBuf::from).collect())
}

/// What stands in a folder of a set, and in the folders there, and is none of the set's files.
fn stranger(set: &Path, folder: &Path, files: &BTreeSet<PathBuf>) -> Option<PathBuf> {
    // What cannot be listed may hold anything.
    let Ok(names) = names(folder) else { return Some(folder.to_owned()) };
    names.into_iter().map(|name| folder.join(name)).find_map(|path| {
        let own = path.strip_prefix(set).unwrap_or(&path);
        if files.contains(own) && !path.is_dir() {
            None
        } else if files.iter().any(|file| file.parent() == Some(own)) && path.is_dir() {
            stranger(set, &path, files)
        } else {
            Some(path)
        }
    })
}
