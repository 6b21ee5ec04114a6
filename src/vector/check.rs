//! Checking a set against itself, and against the model. Spec clauses `N-10` to `N-12`.

use super::bench::Source;
use super::emit::{Output, emit, files};
use super::manifest::{self, FileEntry, Manifest, hex_digest};
use super::plan::Shard;
use super::table::RowFormat;
use super::write::{INDEX, Monitor, SetIndex, account, companions, compress, file_name};
use crate::model::{MODEL_VERSION, Model};
use crate::profile::Profile;
use crate::scene::{self, lines};
use crate::setup::Triangle;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

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
        "{0}: no {name} or {index}: an empty or unfinished set, or no set at all",
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
    /// Made by another model.
    #[error(
        "{path}: made by model version {found}, this is model version {MODEL_VERSION}: write the set again"
    )]
    OtherModel {
        /// The manifest.
        path: String,
        /// Its model version.
        found: u32,
    },
    /// Made by another profile than the caller believes in.
    #[error("{path}: the set is of another profile: {difference}")]
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
}

fn io(path: &Path) -> impl Fn(std::io::Error) -> CheckError {
    let path = path.display().to_string();
    move |source| CheckError::Io { path: path.clone(), source }
}

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
            let message = format!("is not the manifest that {INDEX} names: the digests differ");
            findings.push(Finding { file: path.clone(), line: None, message });
        }
        let bad = |message: String| CheckError::Malformed {
            path: path.display().to_string(),
            line: 1,
            message,
        };
        manifest.profile.validate().map_err(|error| bad(format!("profile: {error}")))?;
        if manifest.shard.index >= manifest.shard.parts {
            return Err(bad("shard: 0 <= index < parts is violated".to_owned()));
        }
        if let Some(file) = manifest.files.iter().find(|file| file.name.contains(['/', '\\'])) {
            return Err(bad(format!("files: {:?} is not a plain file name", file.name)));
        }
        sets.push(OpenSet { folder, manifest });
    }
    Ok((sets, findings))
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
            let message = format!("a set that {INDEX} does not name");
            findings.push(Finding { file: dir.join(name), line: None, message });
        }
    }
    Ok(())
}

fn parse_json<T: serde::de::DeserializeOwned>(text: &str, path: &Path) -> Result<T, CheckError> {
    serde_json::from_str(text).map_err(|error| CheckError::Malformed {
        path: path.display().to_string(),
        line: error.line(),
        message: error.to_string(),
    })
}

/// A file that must be the canonical form of what it says, digest included.
fn canonical(path: &Path, text: &str, expected: &str, findings: &mut Vec<Finding>) {
    if text != expected {
        findings.push(first_difference(path, text.as_bytes(), expected.as_bytes()));
    }
}

/// The first line in which two texts differ.
fn first_difference(path: &Path, found: &[u8], expected: &[u8]) -> Finding {
    let mut theirs = found.split_inclusive(|byte| *byte == b'\n');
    let mut ours = expected.split_inclusive(|byte| *byte == b'\n');
    let mut line = 1;
    let message = loop {
        match (theirs.next(), ours.next()) {
            (Some(a), Some(b)) if a == b => line += 1,
            (Some(a), Some(b)) => break format!("is {} where {} belongs", shown(a), shown(b)),
            (Some(a), None) => break format!("{} is too much", shown(a)),
            (None, Some(b)) => break format!("ends where {} belongs", shown(b)),
            (None, None) => break "differs".to_owned(),
        }
    };
    Finding { file: path.to_owned(), line: Some(line), message }
}

/// A line for a message: escaped, and not too long.
fn shown(line: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(line).chars().take(100).collect();
    format!("{text:?}")
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
    let (sets, findings) = open(dir)?;
    let mut report = CheckReport { sets, findings, rows: 0 };
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
    let results: Mutex<Vec<(usize, Result<bool, CheckError>)>> = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..options.threads.clamp(1, jobs.len().max(1)) {
            scope.spawn(|| {
                loop {
                    let job = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&(set, file)) = jobs.get(job) else { break };
                    let same = is_as_listed(&set.folder.join(&file.name), file, monitor);
                    if let Ok(mut results) = results.lock() {
                        results.push((job, same));
                    }
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap_or_default();
    results.sort_by_key(|(job, _)| *job);
    let mut suspects: Vec<(PathBuf, String)> = Vec::new();
    for (job, same) in results {
        let (set, file) = jobs[job];
        if !same? {
            suspects.push((set.folder.clone(), file.name.clone()));
        }
    }
    let mut found = Vec::new();
    for set in &report.sets {
        let mine: Vec<&str> = suspects
            .iter()
            .filter(|(folder, _)| *folder == set.folder)
            .map(|(_, name)| name.as_str())
            .collect();
        found.extend(strange_vectors(set)?);
        if !mine.is_empty() || options.recompute {
            found.extend(recompute(set, &mine, options.recompute)?);
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
        Some((a, b)) => format!("the set has {a}, the profile named {b}"),
        None => "one has fields that the other lacks".to_owned(),
    }
}

/// Vector files in the folder that the manifest does not list.
fn strange_vectors(set: &OpenSet) -> Result<Vec<Finding>, CheckError> {
    let mut findings = Vec::new();
    for entry in std::fs::read_dir(&set.folder).map_err(io(&set.folder))?.filter_map(Result::ok) {
        let name = entry.file_name().to_string_lossy().into_owned();
        let vectors = name.contains(".exp.") || name.contains(".cfg.");
        if vectors && !set.manifest.files.iter().any(|file| file.name == name) {
            let message = "a vector file that the manifest does not list".to_owned();
            findings.push(Finding { file: entry.path(), line: None, message });
        }
    }
    findings.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(findings)
}

/// Whether a file has the digest, length and rows that its entry says; a missing one has not.
fn is_as_listed(path: &Path, entry: &FileEntry, monitor: &Monitor) -> Result<bool, CheckError> {
    let mut file = match File::open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(io(path)(error)),
    };
    let (mut hash, mut bytes, mut lines) = (Sha256::new(), 0u64, 0u64);
    let mut buffer = vec![0; BUFFER];
    loop {
        if monitor.cancel.load(Ordering::Relaxed) {
            return Err(io(path)(std::io::Error::from(ErrorKind::Interrupted)));
        }
        let read = file.read(&mut buffer).map_err(io(path))?;
        if read == 0 {
            break;
        }
        let chunk = &buffer[..read];
        hash.update(chunk);
        bytes += read as u64;
        lines += chunk.iter().map(|byte| u64::from(*byte == b'\n')).sum::<u64>();
        monitor.bytes.fetch_add(read as u64, Ordering::Relaxed);
    }
    let plain = Path::new(&entry.name).extension().is_some_and(|extension| extension == "tv");
    let rows_match = !plain || lines == entry.rows;
    Ok(bytes == entry.bytes && rows_match && hex_digest(hash) == entry.sha256)
}

/// The triangles of a set's scene file.
///
/// # Errors
/// [`CheckError`] with file and line.
pub fn read_scene(set: &OpenSet) -> Result<Vec<Triangle>, CheckError> {
    let path = set.folder.join("scene.jsonl");
    let text = std::fs::read_to_string(&path).map_err(io(&path))?;
    let bad = |line: usize, message: String| CheckError::Malformed {
        path: path.display().to_string(),
        line,
        message,
    };
    let triangles =
        lines::parse_scene(&text).map_err(|(line, error)| bad(line, error.to_string()))?;
    let model = Model::new(&set.manifest.profile).map_err(|error| bad(1, error.to_string()))?;
    let snap = |(n, triangle): (usize, &scene::Triangle)| {
        model.snap(triangle).map_err(|error| bad(n + 1, error.to_string()))
    };
    triangles.iter().enumerate().map(snap).collect()
}

/// What the set's benches are made from, its scene as given.
pub fn source(set: &OpenSet, scene: Vec<Triangle>) -> Source {
    Source {
        profile: set.manifest.profile.clone(),
        scene: Arc::new(scene),
        seed: set.manifest.seed,
        count: set.manifest.count,
    }
}

/// The row format and compression of a set.
pub fn format(manifest: &Manifest) -> (RowFormat, bool) {
    let all =
        [RowFormat::Tv, RowFormat::Bin, RowFormat::Csv, RowFormat::Jsonl, RowFormat::TestFloat];
    let name = manifest.format.strip_suffix(".zst");
    let plain = name.unwrap_or(&manifest.format);
    let format = all.into_iter().find(|format| format.extension() == plain).unwrap_or_default();
    (format, name.is_some())
}

/// Derives files again and names the first difference of each: the suspects, or every file.
fn recompute(
    set: &OpenSet,
    suspects: &[&str],
    everything: bool,
) -> Result<Vec<Finding>, CheckError> {
    let mut findings: Vec<Finding> = Vec::new();
    let wanted = |name: &str| everything || suspects.contains(&name);
    let (format, zstd) = format(&set.manifest);
    let scene_path = set.folder.join("scene.jsonl");
    if suspects.contains(&"scene.jsonl") {
        // Nothing can be derived from a damaged scene: say so, and name the other suspects too.
        let line = lines_until_odd(&scene_path, &set.manifest);
        for name in suspects {
            let (line, message) = if *name == "scene.jsonl" {
                (line, "is not the scene that the manifest's digest names".to_owned())
            } else {
                (None, "is not the file that the manifest's digest names".to_owned())
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
        if !names.iter().any(|name| wanted(name)) {
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
    for (name, text) in companions(set_name, profile, &source.scene, &vector_files, format, zstd) {
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
            let message = "the manifest lists another digest, length or row count".to_owned();
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
            made.triangles.iter().filter_map(|triangle| model.snap(triangle).ok()).collect();
        let expected = super::write::scene_text(&snapped);
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
            let message = "is missing".to_owned();
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
                let message = format!("{} is too much: the file should end here", shown(line));
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
