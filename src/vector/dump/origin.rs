//! Where a dump comes from, when it is not from here: another unit of the set, or another set beside it.

use super::read::{Dump, DumpError};
use super::{CompareError, Subject};
use crate::vector::bench::FileSpec;
use crate::vector::check::OpenSet;
use crate::vector::manifest::{self, Manifest};
use std::path::Path;

/// Rows that are looked at.
const ROWS: usize = 20_000;

/// The error of a dump whose rows do not have the columns of its file: it says whose columns they are.
pub(super) fn of_error(
    error: DumpError,
    dump: &Path,
    subject: &Subject,
    all: &[FileSpec],
) -> CompareError {
    let DumpError::Line { path, line, message } = error else { return error.into() };
    let fits = |spec: &&FileSpec| {
        let rows = Dump::read_up_to(dump, &spec.columns, 16);
        spec.columns != subject.spec.columns && rows.is_ok_and(|rows| rows.rows() > 0)
    };
    let fitting: Vec<String> =
        all.iter().filter(fits).map(|spec| format!("{}.tv", spec.stem)).collect();
    let hint = match &fitting[..] {
        [] => String::new(),
        names => format!(
            "; the rows have the columns of {}, not of {}.tv: name the file that they answer with --file",
            names.join(" or "),
            subject.spec.stem
        ),
    };
    DumpError::Line { path, line, message: message + &hint }.into()
}

/// Whose rows a dump has that disagrees with its own file: those of another file of the set, or of a set
/// beside it.
pub(super) fn of_rows(set: &OpenSet, dump: &Path, subject: &Subject) -> Option<String> {
    let own = Dump::read_up_to(dump, &subject.spec.columns, ROWS).ok()?;
    let ours = format!("{}.tv", subject.spec.stem);
    let expected = Dump::read_up_to(&set.folder.join(&ours), &subject.spec.columns, ROWS).ok()?;
    if own.starts_alike(&expected) {
        return None;
    }
    // A file of a set, if the dump begins with its rows.
    let same = |folder: &Path, manifest: &Manifest, name: &str| {
        let file = manifest.files.iter().find(|file| file.name == name)?;
        let theirs = Dump::read_up_to(&folder.join(name), &file.columns, ROWS).ok()?;
        let read = Dump::read_up_to(dump, &file.columns, ROWS).ok()?;
        read.starts_alike(&theirs).then(|| read.rows())
    };
    let answers = set.manifest.files.iter().filter(|file| file.name.contains(".exp."));
    for file in answers.filter(|file| file.name != ours) {
        if let Some(rows) = same(&set.folder, &set.manifest, &file.name) {
            let name = &file.name;
            return Some(format!(
                "its first {rows} rows are those of {name} of this set: name it with --file"
            ));
        }
    }
    let mut folders: Vec<_> = std::fs::read_dir(set.folder.canonicalize().ok()?.parent()?)
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    folders.sort();
    for folder in folders {
        let text = manifest::read(&folder.join(manifest::NAME)).ok();
        let other: Option<Manifest> = text.and_then(|text| serde_json::from_slice(&text).ok());
        let Some(other) = other.filter(|other| other.digest != set.manifest.digest) else {
            continue;
        };
        if let Some(rows) = same(&folder, &other, &ours) {
            let (name, ours) = (folder.display(), &set.manifest.set);
            return Some(format!(
                "its first {rows} rows are those of the set {} in {name}: compare it with that set, not with {ours}",
                other.set
            ));
        }
    }
    None
}
