//! What of a folder belongs to the set that it holds, by name and digest.

use super::{OLD, PARTIAL, is_folder, rank};
use crate::vector::manifest::{self, is_file_name, is_plain, sha256};
use crate::vector::write::{INDEX, Monitor};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::SystemTime;

/// What a manifest of any version lists.
#[derive(Deserialize)]
struct Listed {
    files: Vec<ListedFile>,
}

#[derive(Deserialize)]
struct ListedFile {
    name: String,
    sha256: String,
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

/// What a file of a set has to be.
enum Expected {
    /// A file with this digest.
    Digest(String),
    /// A manifest or an index, which holds its own digest.
    Sealed,
    /// What a bench dumped beside the file that it answers.
    Dump,
}

/// A file of the set as it was seen.
pub(super) struct Own {
    /// Below the folder.
    pub(super) path: PathBuf,
    length: u64,
    modified: Option<SystemTime>,
}

impl Own {
    /// Whether the file of this path is still as it was seen.
    pub(super) fn is_same(&self, path: &Path) -> bool {
        fs::symlink_metadata(path).is_ok_and(|now| {
            now.is_file() && now.len() == self.length && now.modified().ok() == self.modified
        })
    }
}

/// Why something in a folder is not the set's.
pub(super) enum Why {
    /// No manifest lists it.
    Foreign,
    /// It is listed, but its contents are not those of the digest.
    Edited,
    /// It is listed, but is a link, or no file.
    NoFile,
}

/// What a folder holds.
#[derive(Default)]
pub(super) struct Inventory {
    /// The files of the set as they were written, and dumps of its benches; its manifests first.
    pub(super) own: Vec<Own>,
    /// The set's folders below this one, outer ones first.
    pub(super) folders: BTreeSet<PathBuf>,
    /// Everything else.
    pub(super) strange: Vec<(PathBuf, Why)>,
}

impl Inventory {
    /// Looks at everything in a folder but what runs of this program build and keep there. Follows no link.
    ///
    /// # Errors
    /// Whatever reading runs into; `Interrupted` when the monitor cancelled.
    pub(super) fn of(folder: &Path, monitor: &Monitor) -> Result<Self> {
        let expected = expected(folder);
        let mut found = Self::default();
        found.look(folder, Path::new(""), &expected, monitor)?;
        found.own.sort_by_key(|own| std::cmp::Reverse(rank(&own.path)));
        Ok(found)
    }

    /// Whether there is a set.
    pub(super) fn has_set(&self) -> bool {
        self.own.iter().any(|own| rank(&own.path) == 2)
            || self.strange.iter().any(|(path, _)| rank(path) == 2)
    }

    fn look(
        &mut self,
        root: &Path,
        inner: &Path,
        expected: &BTreeMap<PathBuf, Expected>,
        monitor: &Monitor,
    ) -> Result<()> {
        for path in entries(root, inner)? {
            let full = root.join(&path);
            let there = fs::symlink_metadata(&full)?;
            let listed = expected.get(&path);
            let holds = expected.keys().any(|file| file != &path && file.starts_with(&path));
            if there.is_dir() && holds {
                self.folders.insert(path.clone());
                self.look(root, &path, expected, monitor)?;
                continue;
            }
            let why = match listed {
                None => Why::Foreign,
                Some(_) if !there.is_file() => Why::NoFile,
                Some(expected) if !expected.is(&full, monitor)? => Why::Edited,
                Some(_) => {
                    let (length, modified) = (there.len(), there.modified().ok());
                    self.own.push(Own { path, length, modified });
                    continue;
                }
            };
            self.strange.push((path, why));
        }
        Ok(())
    }

    /// Refuses a folder with anything in it that is not of the set as it was written.
    ///
    /// # Errors
    /// `DirectoryNotEmpty`, naming what it is.
    pub(super) fn refuse_strangers(&self, out: &Path) -> Result<()> {
        /// The most that one line can name.
        const MOST: usize = 8;
        let said: Vec<String> = self
            .strange
            .iter()
            .take(MOST)
            .map(|(path, why)| {
                let path = out.join(path);
                let path = path.display();
                match why {
                    Why::Foreign => format!("{path} does not belong to a vector set"),
                    Why::Edited => format!("{path} was edited: its digest is not that of the set"),
                    Why::NoFile => {
                        format!("{path} is not a regular file, but the set lists a file")
                    }
                }
            })
            .collect();
        if said.is_empty() {
            return Ok(());
        }
        let more = self.strange.len().saturating_sub(MOST);
        let more = if more == 0 { String::new() } else { format!("; and {more} more") };
        Err(Error::new(ErrorKind::DirectoryNotEmpty, said.join("; ") + &more))
    }
}

impl Expected {
    fn is(&self, path: &Path, monitor: &Monitor) -> Result<bool> {
        match self {
            Self::Digest(digest) => Ok(*digest == digest_of(path, monitor)?),
            Self::Sealed => Ok(manifest::read(path).is_ok_and(|bytes| is_sealed(&bytes))),
            Self::Dump => Ok(true),
        }
    }
}

/// The files that the manifests in a folder list; none if there is no set to be read.
fn expected(folder: &Path) -> BTreeMap<PathBuf, Expected> {
    let mut list = BTreeMap::new();
    if let Some(index) = listed::<ListedSets>(&folder.join(INDEX)) {
        list.insert(PathBuf::from(INDEX), Expected::Sealed);
        // A name with more than a name in it leads elsewhere.
        for set in index.sets.iter().filter(|set| is_plain(&set.folder)) {
            if is_folder(&folder.join(&set.folder)) {
                expected_set(folder, Path::new(&set.folder), &mut list);
            }
        }
    } else {
        expected_set(folder, Path::new(""), &mut list);
    }
    list
}

/// The files of the set in one folder, and what a bench of it dumps beside the files that it compares.
fn expected_set(root: &Path, set: &Path, list: &mut BTreeMap<PathBuf, Expected>) {
    let own = set.join(manifest::NAME);
    let Some(Listed { files }) = listed(&root.join(&own)) else { return };
    list.insert(own, Expected::Sealed);
    for file in files.into_iter().filter(|file| is_file_name(&file.name)) {
        if let Some(stem) = file.name.strip_suffix(".exp.tv") {
            list.insert(set.join(format!("{stem}.exp.dut.tv")), Expected::Dump);
        }
        list.insert(set.join(&file.name), Expected::Digest(file.sha256));
    }
}

/// What a file says, if it is there, is no link, and says it.
fn listed<T: DeserializeOwned>(path: &Path) -> Option<T> {
    fs::symlink_metadata(path).ok().filter(fs::Metadata::is_file)?;
    serde_json::from_slice(&manifest::read(path).ok()?).ok()
}

/// Whether a manifest or an index of any version ends with its own digest.
fn is_sealed(bytes: &[u8]) -> bool {
    const KEY: &str = "\"digest\": \"";
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Some(at) = text.rfind(KEY).map(|at| at + KEY.len()) else { return false };
    let (before, rest) = text.split_at(at);
    let Some((digest, after)) = rest.split_once('"') else { return false };
    sha256(format!("{before}\"{after}").as_bytes()) == digest
}

/// SHA-256 of a file.
pub(super) fn digest_of(path: &Path, monitor: &Monitor) -> Result<String> {
    let (mut file, mut hash) = (File::open(path)?, Sha256::new());
    let mut buffer = vec![0; 1 << 18];
    loop {
        if monitor.cancel.load(Ordering::Relaxed) {
            return Err(Error::from(ErrorKind::Interrupted));
        }
        match file.read(&mut buffer)? {
            0 => return Ok(manifest::hex_digest(hash)),
            read => hash.update(&buffer[..read]),
        }
    }
}

/// What is in a folder below `root`, in order of name; at the top without the folders of runs.
fn entries(root: &Path, inner: &Path) -> Result<Vec<PathBuf>> {
    let mut list = Vec::new();
    for entry in fs::read_dir(root.join(inner))? {
        let name = entry?.file_name();
        let text = name.to_string_lossy();
        let ours = text.starts_with(PARTIAL) || text.starts_with(OLD);
        if !(ours && inner.as_os_str().is_empty() && is_folder(&root.join(&name))) {
            list.push(inner.join(name));
        }
    }
    list.sort();
    Ok(list)
}

/// What is in a folder itself but the folders of runs.
pub(super) fn top(root: &Path) -> Result<Vec<PathBuf>> {
    entries(root, Path::new(""))
}

/// All folders below a folder, by their paths in it.
pub(super) fn folders(root: &Path) -> Result<BTreeSet<PathBuf>> {
    fn walk(root: &Path, inner: &Path, list: &mut BTreeSet<PathBuf>) -> Result<()> {
        for path in entries(root, inner)? {
            if is_folder(&root.join(&path)) {
                walk(root, &path, list)?;
                list.insert(path);
            }
        }
        Ok(())
    }
    let mut list = BTreeSet::new();
    walk(root, Path::new(""), &mut list)?;
    Ok(list)
}

/// All files below a folder, by their paths in it; what makes it a set last.
pub(super) fn files(root: &Path) -> Result<Vec<PathBuf>> {
    fn walk(root: &Path, inner: &Path, list: &mut Vec<PathBuf>) -> Result<()> {
        for path in entries(root, inner)? {
            if is_folder(&root.join(&path)) {
                walk(root, &path, list)?;
            } else {
                list.push(path);
            }
        }
        Ok(())
    }
    let mut list = Vec::new();
    walk(root, Path::new(""), &mut list)?;
    list.sort_by_key(|path| rank(path));
    Ok(list)
}
