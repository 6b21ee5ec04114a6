//! Opening sets: manifests and indexes, held to their canonical form.

use super::file::{is_of_a_run, open_regular, strange_in};
use super::{CheckError, Finding, OpenSet, io};
use crate::format::Column;
use crate::model::MODEL_VERSION;
use crate::vector::formal::FOLDER;
use crate::vector::manifest::{self, Manifest, ShardEntry, is_file_name, is_plain};
use crate::vector::write::{INDEX, SetEntry, SetIndex};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;
use std::path::Path;

/// The most rows asked for in a set for each row that it has, with a good margin: spec clause `N-6`.
const COUNT_PER_ROW: u64 = 1 << 12;

/// Opens the set in a folder, or all sets of a folder of sets.
///
/// # Errors
/// [`CheckError`] if there is none, or its manifest is no manifest of this model.
pub fn open(dir: &Path) -> Result<(Vec<OpenSet>, Vec<Finding>), CheckError> {
    open_pinned(dir, None)
}

/// The same, if the digest of the set or of the index is the one that the caller knows.
pub(super) fn open_pinned(
    dir: &Path,
    digest: Option<&str>,
) -> Result<(Vec<OpenSet>, Vec<Finding>), CheckError> {
    let mut findings = Vec::new();
    let pin = |path: &Path, found: &str, findings: &mut Vec<Finding>| {
        if let Some(known) = digest.filter(|known| !known.eq_ignore_ascii_case(found)) {
            let message = format!("the digest is {found}, but --digest says {known}");
            findings.push(Finding { file: path.to_owned(), line: None, message });
        }
    };
    let index_path = dir.join(INDEX);
    let folders = match read_text(&index_path)? {
        Some(text) => {
            let index: SetIndex = parse_json(&text, &index_path)?;
            check_index(dir, &index)?;
            canonical(&index_path, &text, &index.to_text(), &mut findings);
            pin(&index_path, &index.digest, &mut findings);
            strangers(dir, &index, &mut findings)?;
            index.sets.into_iter().map(|set| (dir.join(&set.folder), Some(set.digest))).collect()
        }
        None => vec![(dir.to_owned(), None)],
    };
    let mut sets = Vec::new();
    for (folder, digest) in folders {
        let path = folder.join(manifest::NAME);
        let Some(text) = read_text(&path)? else { return Err(CheckError::Unfinished(folder)) };
        let manifest: Manifest = parse_json(&text, &path)?;
        if manifest.model_version != MODEL_VERSION {
            let path = path.display().to_string();
            return Err(CheckError::OtherModel { path, found: manifest.model_version });
        }
        canonical(&path, &text, &manifest.to_text(), &mut findings);
        if digest.is_none() {
            pin(&path, &manifest.digest, &mut findings);
        }
        if folder != *dir && folder.file_name().is_none_or(|name| *name != *manifest.set) {
            let message = format!("set: {:?} is not the name of its folder", manifest.set);
            findings.push(Finding { file: path.clone(), line: None, message });
        }
        if digest.is_some_and(|digest| digest != manifest.digest) {
            let message = format!("its digest differs from the digest in {INDEX}");
            findings.push(Finding { file: path.clone(), line: None, message });
        }
        let set = OpenSet { folder, manifest };
        check_manifest(&set)?;
        sets.push(set);
    }
    Ok((sets, findings))
}

/// Refuses an index whose sets are none, doubled, or elsewhere.
fn check_index(dir: &Path, index: &SetIndex) -> Result<(), CheckError> {
    let bad = |message: String| CheckError::Malformed {
        path: dir.join(INDEX).display().to_string(),
        line: 1,
        message,
    };
    if index.sets.is_empty() {
        return Err(bad("sets: the list is empty, so there is nothing to check".to_owned()));
    }
    for (n, SetEntry { folder, .. }) in index.sets.iter().enumerate() {
        if !is_plain(folder) {
            return Err(bad(format!("sets: {folder:?} is no plain folder name")));
        }
        if index.sets[..n].iter().any(|set| set.folder == *folder) {
            return Err(bad(format!("sets: {folder:?} is listed twice")));
        }
        if std::fs::symlink_metadata(dir.join(folder)).is_ok_and(|there| !there.is_dir()) {
            return Err(bad(format!("sets: {folder:?} is a link or no folder, and is not read")));
        }
    }
    Ok(())
}

/// Refuses a manifest that no set can have.
fn check_manifest(set: &OpenSet) -> Result<(), CheckError> {
    let OpenSet { folder, manifest } = set;
    let bad = |message: String| CheckError::Malformed {
        path: folder.join(manifest::NAME).display().to_string(),
        line: 1,
        message,
    };
    manifest.profile.validate().map_err(|error| bad(format!("profile: {error}")))?;
    let ShardEntry { index, parts } = manifest.shard;
    if index >= parts {
        return Err(bad("shard: 0 <= index < parts is needed".to_owned()));
    }
    super::format(set)?;
    let mut names = BTreeSet::new();
    for file in &manifest.files {
        let name = &file.name;
        if !is_file_name(name) {
            return Err(bad(format!(
                "files: {name:?} is neither a plain file name nor one in the folder {FOLDER}"
            )));
        }
        if !names.insert(name) {
            return Err(bad(format!("files: {name:?} is listed twice")));
        }
        for Column { name: column, width, .. } in &file.columns {
            if !(1..=128).contains(width) {
                return Err(bad(format!(
                    "files: {name}: column {column}: width = {width}, but a column has 1 to 128 bits"
                )));
            }
        }
    }
    // Every 512 rows asked for give a row or more; a count that is far above the rows has no end.
    let vectors = manifest.files.iter().filter(|file| !file.columns.is_empty());
    let (files, rows) = vectors
        .fold((0u64, 0u64), |(files, rows), file| (files + 1, rows.saturating_add(file.rows)));
    // A part of many can be empty.
    let most = rows.saturating_add(COUNT_PER_ROW).saturating_mul(parts);
    if files > 0 && manifest.count / COUNT_PER_ROW > most {
        return Err(bad(format!(
            "count = {}, but the vector files have {rows} rows in all: no set is so short",
            manifest.count
        )));
    }
    Ok(())
}

/// The text of a file, if it is there.
fn read_text(path: &Path) -> Result<Option<String>, CheckError> {
    // A link is not followed: the set has to be whole in its own folder.
    if open_regular(path)?.is_none() {
        return Ok(None);
    }
    let bytes = manifest::read(path).map_err(io(path))?;
    String::from_utf8(bytes).map(Some).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        CheckError::Malformed {
            path: path.display().to_string(),
            line: good.split(|byte| *byte == b'\n').count(),
            message: "not UTF-8".to_owned(),
        }
    })
}

/// Subfolders that the index does not name, a set copied in or left from another run; and vector files, which
/// belong into the folders of sets.
fn strangers(dir: &Path, index: &SetIndex, findings: &mut Vec<Finding>) -> Result<(), CheckError> {
    let mut names: Vec<_> = std::fs::read_dir(dir)
        .map_err(io(dir))?
        .filter_map(Result::ok)
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    for name in names {
        if !index.sets.iter().any(|set| set.folder == name) && !is_of_a_run(&name) {
            let message = format!("{INDEX} does not list this set");
            findings.push(Finding { file: dir.join(name), line: None, message });
        }
    }
    for file in strange_in(dir, true, |_| {})? {
        let message = format!("{INDEX} does not list this vector file");
        findings.push(Finding { file, line: None, message });
    }
    Ok(())
}

fn parse_json<T: DeserializeOwned>(text: &str, path: &Path) -> Result<T, CheckError> {
    let path = path.display().to_string();
    // The schema first: it says what the rest looks like.
    if let Ok(Schema { schema: found }) = serde_json::from_str(text)
        && found != manifest::SCHEMA
    {
        return Err(CheckError::OtherSchema { path, found });
    }
    serde_json::from_str(text).map_err(|error| CheckError::Malformed {
        path,
        line: error.line(),
        message: error.to_string(),
    })
}

/// What files of every schema have.
#[derive(Deserialize)]
struct Schema {
    schema: u32,
}

/// A file that must be the canonical form of what it says, digest included.
pub(super) fn canonical(path: &Path, text: &str, expected: &str, findings: &mut Vec<Finding>) {
    if text != expected {
        findings.push(first_difference(path, text.as_bytes(), expected.as_bytes()));
    }
}

/// The first line in which two texts differ.
pub(super) fn first_difference(path: &Path, found: &[u8], expected: &[u8]) -> Finding {
    let mut theirs = found.split_inclusive(|byte| *byte == b'\n');
    let mut ours = expected.split_inclusive(|byte| *byte == b'\n');
    let mut line = 1;
    let message = loop {
        match (theirs.next(), ours.next()) {
            (Some(a), Some(b)) if a == b => line += 1,
            (Some(a), Some(b)) => break format!("is {} where {} belongs", shown(a), shown(b)),
            (Some(a), None) => break format!("extra row {}", shown(a)),
            (None, Some(b)) => break format!("the file ends, but {} is expected", shown(b)),
            (None, None) => break "differs".to_owned(),
        }
    };
    Finding { file: path.to_owned(), line: Some(line), message }
}

/// A line for a message: escaped, and not too long.
pub(super) fn shown(line: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(line).chars().take(100).collect();
    format!("{text:?}")
}
