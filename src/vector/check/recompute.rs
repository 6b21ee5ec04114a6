//! Deriving a set's files again, and naming the first difference of each.

use super::file::open_regular;
use super::open::{canonical, first_difference, shown};
use super::scene::{check_builtin, lines_until_odd, read_scene};
use super::{BUFFER, CheckError, Finding, OpenSet, io};
use crate::setup::Triangle;
use crate::value::VertexValues;
use crate::vector::bench::Source;
use crate::vector::emit::{Output, emit, files};
use crate::vector::manifest::{self, FileEntry, Manifest, sha256};
use crate::vector::plan::Shard;
use crate::vector::table::RowFormat;
use crate::vector::write::{self, account, companions, compress, file_name, unchecked};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::PathBuf;
use std::sync::Arc;

/// What the set's benches are made from, its scene as given.
pub fn source(set: &OpenSet, (scene, values): (Vec<Triangle>, Vec<VertexValues>)) -> Source {
    Source {
        profile: set.manifest.profile.clone(),
        scene: Arc::new(scene),
        values: Arc::new(values),
        seed: set.manifest.seed,
        count: set.manifest.count,
    }
}

/// The row format of a set, and whether it is compressed.
///
/// # Errors
/// [`CheckError::Malformed`] if this version writes no such form.
pub fn format(set: &OpenSet) -> Result<(RowFormat, bool), CheckError> {
    let found = &set.manifest.format;
    let (plain, zstd) = match found.strip_suffix(".zst") {
        Some(plain) => (plain, true),
        None => (found.as_str(), false),
    };
    let format = RowFormat::ALL.into_iter().find(|format| format.extension() == plain);
    format.map(|format| (format, zstd)).ok_or_else(|| {
        let known = RowFormat::ALL.map(RowFormat::extension).join(", ");
        CheckError::Malformed {
            path: set.folder.join(manifest::NAME).display().to_string(),
            line: 1,
            message: format!(
                "format: {found:?} is unknown; the formats are {known}, each also with .zst"
            ),
        }
    })
}

/// Derives files again and names the first difference of each: the suspects, or every file.
pub(super) fn recompute(
    set: &OpenSet,
    suspects: &[&str],
    everything: bool,
) -> Result<Vec<Finding>, CheckError> {
    let mut findings: Vec<Finding> = Vec::new();
    let wanted = |name: &str| everything || suspects.contains(&name);
    let (format, zstd) = format(set)?;
    let scene_path = set.folder.join("scene.jsonl");
    if suspects.contains(&"scene.jsonl") {
        // Nothing can be derived from a damaged scene: say so, and name the other suspects too.
        let line = lines_until_odd(&scene_path, &set.manifest);
        for name in suspects {
            let (line, message) = if *name == "scene.jsonl" {
                (line, "the scene does not have the digest in the manifest".to_owned())
            } else {
                (None, "the file does not have the digest in the manifest".to_owned())
            };
            findings.push(Finding { file: set.folder.join(name), line, message });
        }
        return Ok(findings);
    }
    let scene = read_scene(set)?;
    let source = source(set, scene);
    let shard = Shard { index: set.manifest.shard.index, parts: set.manifest.shard.parts };
    let mut made = Manifest { files: Vec::new(), groups: Vec::new(), ..set.manifest.clone() };
    made.coverage.clear();
    // The columns are those of the model, whatever the manifest says of them.
    let mut vector_files: Vec<FileEntry> = Vec::new();
    for bench in source.benches() {
        let specs = files(&*bench, format);
        let names: Vec<String> =
            specs.iter().map(|spec| file_name(&spec.stem, format, zstd)).collect();
        // A bench without files in this format has its coverage in the manifest all the same.
        let concerned =
            if names.is_empty() { everything } else { names.iter().any(|name| wanted(name)) };
        if !concerned {
            let listed = specs.into_iter().zip(names).map(|(spec, name)| {
                let rows = listed_rows(set, &name);
                FileEntry { columns: spec.columns, ..as_listed(set, name, rows) }
            });
            vector_files.extend(listed);
            continue;
        }
        let mut output = CompareOutput { zstd, files: Vec::new(), stopped: false };
        for name in &names {
            let compared =
                if wanted(name) { Some(Compared::open(set.folder.join(name))?) } else { None };
            output.files.push(compared);
        }
        let emitted = emit(&*bench, shard, set.manifest.count, format, &mut output)
            .map_err(io(&set.folder))?;
        for ((spec, name), rows) in specs.into_iter().zip(names).zip(&emitted.rows) {
            let rows = if output.stopped { listed_rows(set, &name) } else { *rows };
            vector_files.push(FileEntry { columns: spec.columns, ..as_listed(set, name, rows) });
        }
        let (groups, coverage) = account(&*bench, &emitted);
        made.groups.extend(groups);
        made.coverage.push(coverage);
        for compared in output.files.into_iter().flatten() {
            findings.extend(compared.finish().map_err(io(&set.folder))?);
        }
    }
    made.files.clone_from(&vector_files);
    let (set_name, profile) = (&set.manifest.set, &set.manifest.profile);
    made.unchecked = unchecked(set_name, profile, &vector_files, format, zstd);
    let scene = (&source.scene[..], &source.values[..]);
    for (name, text) in companions(set_name, profile, scene, &vector_files, format, zstd) {
        made.files.push(as_listed(set, name.clone(), text.lines().count() as u64));
        if wanted(&name) {
            let path = set.folder.join(&name);
            let mut found = Vec::new();
            if let Some(file) = open_regular(&path)? {
                // A little more than expected shows that it differs.
                let most = text.len() as u64 + 256;
                file.take(most).read_to_end(&mut found).map_err(io(&path))?;
            }
            if found != text.as_bytes() {
                findings.push(first_difference(&path, &found, text.as_bytes()));
            }
        }
    }
    if everything && findings.is_empty() {
        made.scene.triangles = source.scene.len() as u64;
        made.scene.sha256 =
            sha256(write::scene_text(&source.scene, &source.values, profile).as_bytes());
        findings.extend(check_builtin(set, (&source.scene, &source.values)));
        let path = set.folder.join(manifest::NAME);
        canonical(&path, &set.manifest.to_text(), &made.to_text(), &mut findings);
    }
    // A suspect that nothing explains: listed with a digest that is not that of what belongs there.
    for name in suspects {
        let path = set.folder.join(name);
        if !findings.iter().any(|finding| finding.file == path) {
            let message =
                "the digest, the length or the number of rows differs from the manifest".to_owned();
            findings.push(Finding { file: path, line: None, message });
        }
    }
    Ok(findings)
}

/// The rows that the manifest says a file has.
fn listed_rows(set: &OpenSet, name: &str) -> u64 {
    set.manifest.files.iter().find(|file| file.name == name).map_or(0, |file| file.rows)
}

/// A file as the manifest must list it, its length and digest as it does list them.
fn as_listed(set: &OpenSet, name: String, rows: u64) -> FileEntry {
    let listed = set.manifest.files.iter().find(|file| file.name == name);
    let (bytes, sha256) = listed.map_or((0, ""), |file| (file.bytes, file.sha256.as_str()));
    FileEntry { name, rows, bytes, sha256: sha256.to_owned(), columns: Vec::new() }
}

/// Compares what is emitted with files on disk.
struct CompareOutput {
    zstd: bool,
    files: Vec<Option<Compared>>,
    /// Whether the rest was left out, because every file differs already: a count that nobody's rows come up to
    /// has no end.
    stopped: bool,
}

struct Compared {
    path: PathBuf,
    file: Option<BufReader<File>>,
    line: u64,
    finding: Option<Finding>,
}

impl Compared {
    fn open(path: PathBuf) -> Result<Self, CheckError> {
        let file = open_regular(&path)?.map(|file| BufReader::with_capacity(BUFFER, file));
        Ok(Self { path, file, line: 1, finding: None })
    }

    fn bytes(&mut self, expected: &[u8]) -> std::io::Result<()> {
        if self.finding.is_some() {
            return Ok(());
        }
        let Some(file) = &mut self.file else {
            let message = "the file is missing".to_owned();
            self.finding = Some(Finding { file: self.path.clone(), line: None, message });
            return Ok(());
        };
        // A little more than expected, so that the differing line can be shown whole.
        let mut found = Vec::with_capacity(expected.len());
        file.by_ref().take(expected.len() as u64).read_to_end(&mut found)?;
        if found != expected {
            let mut tail = Vec::new();
            file.by_ref().take(256).read_to_end(&mut tail)?;
            found.extend(tail);
            let mut finding = first_difference(&self.path, &found, expected);
            finding.line = finding.line.map(|line| line + self.line - 1);
            self.finding = Some(finding);
        }
        self.line += expected.iter().map(|byte| u64::from(*byte == b'\n')).sum::<u64>();
        Ok(())
    }

    fn finish(mut self) -> std::io::Result<Option<Finding>> {
        if let (None, Some(file)) = (&self.finding, &mut self.file) {
            let mut more = Vec::new();
            file.by_ref().take(256).read_to_end(&mut more)?;
            if let Some(line) = more.split_inclusive(|byte| *byte == b'\n').next() {
                let message = format!("extra row {}: the file must end here", shown(line));
                self.finding = Some(Finding { file: self.path, line: Some(self.line), message });
            }
        }
        Ok(self.finding)
    }
}

impl Output for CompareOutput {
    fn bytes(&mut self, file: usize, bytes: &[u8]) -> std::io::Result<bool> {
        if let Some(compared) = &mut self.files[file] {
            if self.zstd {
                compared.bytes(&compress(bytes))?;
            } else {
                compared.bytes(bytes)?;
            }
        }
        let mut compared = self.files.iter().flatten();
        self.stopped = compared.all(|compared| compared.finding.is_some());
        Ok(!self.stopped)
    }
}
