//! Checking a set against itself, and against the model. Spec clauses `N-10` to `N-12`.

mod file;
mod open;
mod recompute;
mod scene;

pub use open::open;
pub use recompute::{format, source};
pub use scene::read_scene;

use super::manifest::{self, FileEntry, Manifest};
use super::write::{INDEX, Monitor};
use crate::model::MODEL_VERSION;
use crate::profile::Profile;
use file::{State, folders_of_runs, state, strange_vectors};
use open::open_pinned;
use recompute::recompute;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Bytes read at a time.
const BUFFER: usize = 1 << 18;

/// One thing that is not as it was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// File, with its folder.
    pub file: PathBuf,
    /// Line from 1, where there is one to name.
    pub line: Option<u64>,
    /// What is wrong.
    pub message: String,
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file.display(), self.message),
            None => write!(f, "{}: {}", self.file.display(), self.message),
        }
    }
}

/// Why a set cannot be checked at all.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// No manifest.
    #[error(
        "{0}: there is no {name} or {index}, so this is not a complete set; write the set with `guardbit vectors`",
        name = manifest::NAME, index = INDEX
    )]
    Unfinished(PathBuf),
    /// A manifest or index that cannot be read as one.
    #[error("{path}:{line}: {message}")]
    Malformed {
        /// The file.
        path: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// Of another schema.
    #[error(
        "{path}: the set has schema {found}, but this version of guardbit reads schema {schema}: {advice}",
        schema = manifest::SCHEMA, advice = advice(*found)
    )]
    OtherSchema {
        /// The manifest or index.
        path: String,
        /// Its schema version.
        found: u32,
    },
    /// Made by another model.
    #[error(
        "{path}: the set was made by model version {found}, but this is model version {MODEL_VERSION}: write the set again"
    )]
    OtherModel {
        /// The manifest.
        path: String,
        /// Its model version.
        found: u32,
    },
    /// Made by another profile than the caller believes in.
    #[error("{path}: the set was made with another profile: {difference}")]
    OtherProfile {
        /// The manifest.
        path: String,
        /// The first difference.
        difference: String,
    },
    /// Reading failed.
    #[error("{path}: {source}")]
    Io {
        /// What was read.
        path: String,
        /// Why it failed.
        source: std::io::Error,
    },
}

/// What to check beside digests and counts.
#[derive(Clone, Copy, Debug, Default)]
pub struct CheckOptions<'a> {
    /// Derive every expectation again.
    pub recompute: bool,
    /// The profile the caller believes in.
    pub profile: Option<&'a Profile>,
    /// The digest of the set, or of the index of several, that the caller knows.
    pub digest: Option<&'a str>,
    /// Worker threads.
    pub threads: usize,
}

/// A set on disk, its manifest read and found consistent.
#[derive(Clone, Debug)]
pub struct OpenSet {
    /// Its folder.
    pub folder: PathBuf,
    /// Its manifest.
    pub manifest: Manifest,
}

/// What a check found.
#[derive(Clone, Debug, Default)]
pub struct CheckReport {
    /// The sets checked.
    pub sets: Vec<OpenSet>,
    /// Everything that is not as it was made.
    pub findings: Vec<Finding>,
    /// Rows checked.
    pub rows: u64,
    /// What was not checked.
    pub notes: Vec<String>,
}

/// What to do with a set of another schema.
fn advice(found: u32) -> &'static str {
    if found < manifest::SCHEMA {
        "the names and the order of columns have changed; write the set again with `guardbit vectors`"
    } else {
        "check the set with the version of guardbit that wrote it"
    }
}

fn io(path: &Path) -> impl Fn(std::io::Error) -> CheckError {
    let path = path.display().to_string();
    move |source| CheckError::Io { path: path.clone(), source }
}

/// Checks every set below `dir`.
///
/// # Errors
/// [`CheckError`] if there is no set, or it cannot be read.
pub fn check(
    dir: &Path,
    options: CheckOptions<'_>,
    monitor: &Monitor,
) -> Result<CheckReport, CheckError> {
    let (sets, findings) = open_pinned(dir, options.digest)?;
    let mut report = CheckReport { sets, findings, ..CheckReport::default() };
    report.notes.extend(folders_of_runs(dir).into_iter().map(|folder| {
        format!(
            "{} is of a run that was killed or is still writing; it is not checked",
            folder.display()
        )
    }));
    if let Some(believed) = options.profile {
        // Of several sets one must be of the believed profile; the rest are its variants.
        if !report.sets.iter().any(|set| set.manifest.profile == *believed)
            && let Some(set) = report.sets.first()
        {
            let path = set.folder.join(manifest::NAME).display().to_string();
            let difference = difference(&set.manifest.profile, believed);
            return Err(CheckError::OtherProfile { path, difference });
        }
    }
    let jobs: Vec<(&OpenSet, &FileEntry)> = report
        .sets
        .iter()
        .flat_map(|set| set.manifest.files.iter().map(move |file| (set, file)))
        .collect();
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<(usize, Result<State, CheckError>)>> = Mutex::default();
    std::thread::scope(|scope| {
        for _ in 0..options.threads.clamp(1, jobs.len().max(1)) {
            scope.spawn(|| {
                loop {
                    let job = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&(set, file)) = jobs.get(job) else { break };
                    let found = state(&set.folder.join(&file.name), file, monitor);
                    results.lock().unwrap_or_else(PoisonError::into_inner).push((job, found));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    if results.len() != jobs.len() {
        unreachable!("the scope has joined every worker: {} of {}", results.len(), jobs.len());
    }
    results.sort_by_key(|(job, _)| *job);
    let mut suspects: Vec<(PathBuf, String)> = Vec::new();
    let (mut found, mut unread) = (Vec::new(), Vec::new());
    for (job, state) in results {
        let (set, file) = jobs[job];
        match state? {
            State::Same => {}
            State::Differs => suspects.push((set.folder.clone(), file.name.clone())),
            State::NoFile => {
                let message = "it is a link or no file at all, and is not read".to_owned();
                found.push(Finding { file: set.folder.join(&file.name), line: None, message });
                unread.push(set.folder.clone());
            }
        }
    }
    for set in &report.sets {
        let mine: Vec<&str> = suspects
            .iter()
            .filter(|(folder, _)| *folder == set.folder)
            .map(|(_, name)| name.as_str())
            .collect();
        found.extend(strange_vectors(set)?);
        if unread.contains(&set.folder) {
            continue;
        }
        if !mine.is_empty() || options.recompute {
            found.extend(recompute(set, &mine, options.recompute)?);
        }
        if options.recompute && !scene::is_builtin(&set.manifest) {
            let name = &set.manifest.scene.name;
            report.notes.push(format!(
                "{}: the scene {name:?} came from a file, so its name and its count of refused triangles cannot be \
                 computed again; --digest checks them",
                set.folder.display()
            ));
        }
    }
    report.findings.extend(found);
    report.rows = report
        .sets
        .iter()
        .flat_map(|set| &set.manifest.files)
        .filter(|file| !file.columns.is_empty())
        .map(|file| file.rows)
        .sum();
    Ok(report)
}

/// The first field in which two profiles differ, as TOML lines.
pub fn difference(found: &Profile, believed: &Profile) -> String {
    let (found, believed) = (found.to_toml(), believed.to_toml());
    let mut pairs = found.lines().zip(believed.lines());
    match pairs.find(|(a, b)| a != b) {
        Some((a, b)) => format!("the set has {a}, but the profile of --profile has {b}"),
        None => "the two profiles have different fields".to_owned(),
    }
}
