//! Deriving a set's files again, and naming the first difference of each.

use super::open::{canonical, first_difference, shown};
use super::{BUFFER, CheckError, Finding, OpenSet, io};
use crate::model::Model;
use crate::scene::{
    self,
    lines::{self, SceneLine},
};
use crate::setup::Triangle;
use crate::value::VertexValues;
use crate::vector::bench::Source;
use crate::vector::emit::{Output, emit, files};
use crate::vector::manifest::{self, FileEntry, Manifest};
use crate::vector::plan::Shard;
use crate::vector::table::RowFormat;
use crate::vector::write::{account, companions, compress, file_name, scene_text, unchecked};
use std::fs::File;
use std::io::{BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The triangles of a set's scene file, and what they bring for channels.
///
/// # Errors
/// [`CheckError`] with file and line.
pub fn read_scene(set: &OpenSet) -> Result<(Vec<Triangle>, Vec<VertexValues>), CheckError> {
    let path = set.folder.join("scene.jsonl");
    let text = std::fs::read_to_string(&path).map_err(io(&path))?;
    let bad = |line: usize, message: String| CheckError::Malformed {
        path: path.display().to_string(),
        line,
        message,
    };
    let read = lines::parse_scene(&text).map_err(|(line, error)| bad(line, error.to_string()))?;
    let model = Model::new(&set.manifest.profile).map_err(|error| bad(1, error.to_string()))?;
    let (mut triangles, mut values) = (Vec::new(), Vec::new());
    for SceneLine { line, triangle, shading } in &read {
        let triangle = model.snap(triangle).map_err(|error| bad(*line, error.to_string()))?;
        triangles.push(*triangle);
        if let Some(shading) = shading {
            let found = model.shading(shading).map_err(|error| bad(*line, error.to_string()))?;
            values.push(found);
        }
    }
    if ![0, triangles.len()].contains(&values.len()) {
        let without = read.iter().find(|line| line.shading.is_none()).map_or(1, |line| line.line);
        return Err(bad(without, "the triangle has no `channels`, but others have".to_owned()));
    }
    Ok((triangles, values))
}

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
    for bench in source.benches() {
        let specs = files(&*bench, format);
        let names: Vec<String> =
            specs.iter().map(|spec| file_name(&spec.stem, format, zstd)).collect();
        // A bench without files in this format has its coverage in the manifest all the same.
        let concerned =
            if names.is_empty() { everything } else { names.iter().any(|name| wanted(name)) };
        if !concerned {
            continue;
        }
        let mut output = CompareOutput { zstd, files: Vec::new() };
        for name in &names {
            let compared = if wanted(name) {
                Some(Compared::open(set.folder.join(name)).map_err(io(&set.folder.join(name)))?)
            } else {
                None
            };
            output.files.push(compared);
        }
        let emitted = emit(&*bench, shard, set.manifest.count, format, &mut output)
            .map_err(io(&set.folder))?;
        for ((spec, name), rows) in specs.into_iter().zip(names).zip(&emitted.rows) {
            made.files.push(FileEntry { columns: spec.columns, ..as_listed(set, name, *rows) });
        }
        let (groups, coverage) = account(&*bench, &emitted);
        made.groups.extend(groups);
        made.coverage.push(coverage);
        for compared in output.files.into_iter().flatten() {
            findings.extend(compared.finish().map_err(io(&set.folder))?);
        }
    }
    let vector_files: Vec<FileEntry> =
        set.manifest.files.iter().filter(|file| !file.columns.is_empty()).cloned().collect();
    let (set_name, profile) = (&set.manifest.set, &set.manifest.profile);
    made.unchecked = unchecked(set_name, profile, &vector_files, format, zstd);
    let scene = (&source.scene[..], &source.values[..]);
    for (name, text) in companions(set_name, profile, scene, &vector_files, format, zstd) {
        made.files.push(as_listed(set, name.clone(), text.lines().count() as u64));
        if wanted(&name) {
            let path = set.folder.join(&name);
            let found = match std::fs::read(&path) {
                Ok(found) => found,
                Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
                Err(error) => return Err(io(&path)(error)),
            };
            if found != text.as_bytes() {
                findings.push(first_difference(&path, &found, text.as_bytes()));
            }
        }
    }
    if everything && findings.is_empty() {
        made.scene.triangles = source.scene.len() as u64;
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

/// A file as the manifest must list it, its length and digest as it does list them.
fn as_listed(set: &OpenSet, name: String, rows: u64) -> FileEntry {
    let listed = set.manifest.files.iter().find(|file| file.name == name);
    let (bytes, sha256) = listed.map_or((0, ""), |file| (file.bytes, file.sha256.as_str()));
    FileEntry { name, rows, bytes, sha256: sha256.to_owned(), columns: Vec::new() }
}

/// The first line of a damaged scene that is not as made, where that can be told: from the
/// built-in scene of that name, or because the line is no triangle.
fn lines_until_odd(path: &Path, manifest: &Manifest) -> Option<u64> {
    let bytes = std::fs::read(path).ok()?;
    let name = manifest.scene.name.as_str();
    if scene::builtin_names().iter().any(|(known, _)| *known == name) {
        let model = Model::new(&manifest.profile).ok()?;
        let made = scene::load(name, &model.viewport()).ok()?;
        let snapped: Vec<Triangle> =
            made.triangles.iter().filter_map(|given| model.snap(given).ok().map(|t| *t)).collect();
        let expected = scene_text(&snapped, &[], &manifest.profile);
        if manifest::sha256(expected.as_bytes()) == manifest.scene.sha256 {
            return first_difference(path, &bytes, expected.as_bytes()).line;
        }
    }
    match lines::parse_scene(&String::from_utf8_lossy(&bytes)) {
        Err((line, _)) => Some(line as u64),
        Ok(triangles) => {
            ((triangles.len() as u64) != manifest.scene.triangles).then_some(triangles.len() as u64)
        }
    }
}

/// Compares what is emitted with files on disk.
struct CompareOutput {
    zstd: bool,
    files: Vec<Option<Compared>>,
}

struct Compared {
    path: PathBuf,
    file: Option<BufReader<File>>,
    line: u64,
    finding: Option<Finding>,
}

impl Compared {
    fn open(path: PathBuf) -> std::io::Result<Self> {
        let file = match File::open(&path) {
            Ok(file) => Some(BufReader::with_capacity(BUFFER, file)),
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
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
        Ok(true)
    }
}
