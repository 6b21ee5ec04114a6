//! What changed between two profiles, or two sets. Spec clause `N-15`.

use super::check::OpenSet;
use crate::profile::Profile;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// One thing that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Change {
    /// What: a dotted field of the profile, or a file of the set.
    pub what: String,
    /// On the left.
    pub left: String,
    /// On the right.
    pub right: String,
}

/// The dotted fields of a profile and their values.
fn fields(profile: &Profile) -> BTreeMap<String, String> {
    fn walk(value: &serde_json::Value, name: &str, into: &mut BTreeMap<String, String>) {
        if let serde_json::Value::Object(map) = value {
            for (key, value) in map {
                let dotted = if name.is_empty() { key.clone() } else { format!("{name}.{key}") };
                walk(value, &dotted, into);
            }
        } else {
            into.insert(name.to_owned(), value.to_string());
        }
    }
    let mut map = BTreeMap::new();
    // Profiles hold small integers and strings only, so JSON values carry them exactly.
    let value = serde_json::to_value(profile)
        .unwrap_or_else(|error| unreachable!("integers and strings have a JSON form: {error}"));
    walk(&value, "", &mut map);
    map
}

/// The fields in which two profiles differ.
pub fn profiles(left: &Profile, right: &Profile) -> Vec<Change> {
    let (mine, theirs) = (fields(left), fields(right));
    let names: std::collections::BTreeSet<&String> = mine.keys().chain(theirs.keys()).collect();
    let show = |map: &BTreeMap<String, String>, name: &String| {
        map.get(name).cloned().unwrap_or_else(|| "absent".to_owned())
    };
    names
        .into_iter()
        .map(|name| Change {
            what: name.clone(),
            left: show(&mine, name),
            right: show(&theirs, name),
        })
        .filter(|change| change.left != change.right)
        .collect()
}

/// What differs between two sets: profile, stimulus, and each file with its first differing row.
///
/// # Errors
/// Whatever reading runs into.
pub fn sets(left: &OpenSet, right: &OpenSet) -> std::io::Result<Vec<Change>> {
    let (a, b) = (&left.manifest, &right.manifest);
    let mut changes: Vec<Change> = profiles(&a.profile, &b.profile)
        .into_iter()
        .map(|change| Change { what: format!("profile.{}", change.what), ..change })
        .collect();
    let mut plain = |what: &str, left: String, right: String| {
        if left != right {
            changes.push(Change { what: what.to_owned(), left, right });
        }
    };
    plain("model_version", a.model_version.to_string(), b.model_version.to_string());
    plain("seed", a.seed.to_string(), b.seed.to_string());
    plain("count", a.count.to_string(), b.count.to_string());
    plain("format", a.format.clone(), b.format.clone());
    plain("scene", a.scene.name.clone(), b.scene.name.clone());
    let names: std::collections::BTreeSet<&String> =
        a.files.iter().chain(&b.files).map(|file| &file.name).collect();
    for name in names {
        let find = |manifest: &super::manifest::Manifest| {
            manifest.files.iter().find(|file| file.name == *name).cloned()
        };
        match (find(a), find(b)) {
            // The bytes decide: what a manifest lists is what the file once was.
            (Some(_), Some(_)) => {
                changes.extend(files(name, &left.folder.join(name), &right.folder.join(name))?);
            }
            (mine, theirs) => {
                let show = |file: Option<super::manifest::FileEntry>| {
                    file.map_or_else(|| "absent".to_owned(), |file| format!("{} rows", file.rows))
                };
                changes.push(Change { what: name.clone(), left: show(mine), right: show(theirs) });
            }
        }
    }
    Ok(changes)
}

/// How many lines of two files differ, and the first; `None` if all are the same.
fn files(name: &str, left: &Path, right: &Path) -> std::io::Result<Option<Change>> {
    let mut sides = [BufReader::new(File::open(left)?), BufReader::new(File::open(right)?)];
    let (mut line, mut differing, mut first) = (0u64, 0u64, None);
    loop {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        sides[0].read_until(b'\n', &mut a)?;
        sides[1].read_until(b'\n', &mut b)?;
        if a.is_empty() && b.is_empty() {
            break;
        }
        line += 1;
        if a != b {
            differing += 1;
            first.get_or_insert((line, a, b));
        }
    }
    let show = |text: Vec<u8>| match text.strip_suffix(b"\n") {
        _ if text.is_empty() => "nothing".to_owned(),
        Some(whole) => String::from_utf8_lossy(whole).into_owned(),
        None => format!("{} without a newline at the end", String::from_utf8_lossy(&text)),
    };
    Ok(first.map(|(first, a, b)| Change {
        what: format!("{name} ({differing} of {line} lines, first {first})"),
        left: show(a),
        right: show(b),
    }))
}
