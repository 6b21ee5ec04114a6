//! Opening sets: manifests and indexes, held to their canonical form.

use super::{CheckError, Finding, OpenSet, io};
use crate::model::MODEL_VERSION;
use crate::vector::formal::FOLDER;
use crate::vector::manifest::{self, Manifest};
use crate::vector::write::{INDEX, SetIndex};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::io::ErrorKind;
use std::path::Path;

/// Opens the set in a folder, or all sets of a folder of sets.
///
/// # Errors
/// [`CheckError`] if there is none, or its manifest is no manifest of this model.
pub fn open(dir: &Path) -> Result<(Vec<OpenSet>, Vec<Finding>), CheckError> {
    let mut findings = Vec::new();
    let index_path = dir.join(INDEX);
    let folders = match read_text(&index_path)? {
        Some(text) => {
            let index: SetIndex = parse_json(&text, &index_path)?;
            canonical(&index_path, &text, &index.to_text(), &mut findings);
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
        if digest.is_some_and(|digest| digest != manifest.digest) {
            let message = format!("its digest differs from the digest in {INDEX}");
            findings.push(Finding { file: path.clone(), line: None, message });
        }
        let bad = |message: String| CheckError::Malformed {
            path: path.display().to_string(),
            line: 1,
            message,
        };
        manifest.profile.validate().map_err(|error| bad(format!("profile: {error}")))?;
        if manifest.shard.index >= manifest.shard.parts {
            return Err(bad("shard: 0 <= index < parts is needed".to_owned()));
        }
        if let Some(file) = manifest.files.iter().find(|file| !is_name(&file.name)) {
            return Err(bad(format!(
                "files: {:?} is neither a plain file name nor one in the folder {FOLDER}",
                file.name
            )));
        }
        sets.push(OpenSet { folder, manifest });
    }
    Ok((sets, findings))
}

/// Whether a manifest may list a file of this name.
fn is_name(name: &str) -> bool {
    let inner = name.strip_prefix(FOLDER).and_then(|rest| rest.strip_prefix('/'));
    let name = inner.unwrap_or(name);
    !name.contains(['/', '\\']) && !["", ".", ".."].contains(&name)
}

/// The text of a file, if it is there.
fn read_text(path: &Path) -> Result<Option<String>, CheckError> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(io(path)(error)),
    };
    String::from_utf8(bytes).map(Some).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        CheckError::Malformed {
            path: path.display().to_string(),
            line: good.split(|byte| *byte == b'\n').count(),
            message: "not UTF-8".to_owned(),
        }
    })
}

/// Subfolders that the index does not name: a set copied in, or left from another run.
fn strangers(dir: &Path, index: &SetIndex, findings: &mut Vec<Finding>) -> Result<(), CheckError> {
    let mut names: Vec<_> = std::fs::read_dir(dir)
        .map_err(io(dir))?
        .filter_map(Result::ok)
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    for name in names {
        if !index.sets.iter().any(|set| set.folder == name) {
            let message = format!("{INDEX} does not list this set");
            findings.push(Finding { file: dir.join(name), line: None, message });
        }
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
