//! Writing sets: built aside, streamed, renamed when whole. Spec clauses `N-6` to `N-11`.

mod finish;
mod interface;
mod place;

pub use finish::{account, companions, scene_text, unchecked};
pub(super) use interface::{Devices, devices};
pub(super) use place::{OLD, PARTIAL};

use super::bench::{Bench, Source};
use super::emit::{Emitted, Output, emit, files};
use super::manifest::{self, FileEntry, Manifest, hex_digest, sha256};
use super::plan::Shard;
use super::table::RowFormat;
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::value::VertexValues;
use finish::finish;
use place::Place;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{Error, ErrorKind, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// File name of the index of a folder of sets.
pub const INDEX: &str = "sets.json";

/// One set to write.
#[derive(Clone, Debug)]
pub struct SetRequest {
    /// Its folder's name.
    pub name: String,
    /// The profile.
    pub profile: Profile,
    /// Name of the scene.
    pub scene_name: String,
    /// Triangles on the profile's grid.
    pub scene: Arc<Vec<Triangle>>,
    /// What they bring for channels, parallel to them; empty where the scene brings nothing.
    pub values: Arc<Vec<VertexValues>>,
    /// Triangles that did not make it there.
    pub refused: u64,
}

/// How sets are written.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Rows in each walk file.
    pub count: u64,
    /// Seed of the random classes.
    pub seed: u64,
    /// Which part.
    pub shard: Shard,
    /// Row format.
    pub format: RowFormat,
    /// Compress vector files with zstd.
    pub zstd: bool,
    /// Worker threads.
    pub threads: usize,
    /// Replace what is there.
    pub force: bool,
}

/// What long work reports and obeys.
#[derive(Debug, Default)]
pub struct Monitor {
    /// Bytes handled so far.
    pub bytes: AtomicU64,
    /// Set to stop at the next buffer.
    pub cancel: AtomicBool,
    /// What the work found that somebody should know, whether it succeeded or not.
    pub notes: Mutex<Vec<String>>,
}

impl Monitor {
    /// Keeps a line for whoever asked for the work.
    fn note(&self, line: String) {
        self.notes.lock().unwrap_or_else(PoisonError::into_inner).push(line);
    }
}

/// The index of a folder of sets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetIndex {
    /// Schema version.
    pub schema: u32,
    /// The sets, by folder.
    pub sets: Vec<SetEntry>,
    /// SHA-256 of this file with an empty digest.
    pub digest: String,
}

/// One set of a folder.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetEntry {
    /// Folder.
    pub folder: String,
    /// Digest of its manifest.
    pub digest: String,
}

impl SetIndex {
    /// The canonical text, digest filled in.
    pub fn to_text(&self) -> String {
        let text = |digest: String| {
            let index = Self { digest, ..self.clone() };
            manifest::pretty(&index)
        };
        text(sha256(text(String::new()).as_bytes()))
    }
}

/// Writes one set into `out` itself, or several, each a folder below it with an index beside them.
///
/// # Errors
/// Whatever the file system answers; `AlreadyExists` when `out` is occupied and `force` is not
/// given; `DirectoryNotEmpty` when it is, but something there is no part of a set as it was written;
/// `Interrupted` when the monitor cancelled. Nothing is left behind, and what was there before stays.
/// The monitor's notes name what killed runs had left, and what came into the folder meanwhile.
pub fn write(
    requests: &[SetRequest],
    out: &Path,
    nested: bool,
    options: &Options,
    monitor: &Monitor,
) -> Result<Vec<Manifest>> {
    let place = Place::new(out, options.force, monitor)?;
    let result = build(requests, place.aside(), nested, options, monitor)
        .and_then(|manifests| place.settle(monitor).map(|()| manifests));
    if result.is_err() {
        place.clear();
    }
    result
}

/// Whether a killed run has left a folder between an old set and a new one.
pub fn is_half_replaced(out: &Path) -> bool {
    place::is_half_replaced(out)
}

/// Numbers of a set and of a bench in it.
type Job = (usize, usize);

/// What one bench of one set became.
type Part = (Vec<FileEntry>, Emitted);

fn build(
    requests: &[SetRequest],
    aside: &Path,
    nested: bool,
    options: &Options,
    monitor: &Monitor,
) -> Result<Vec<Manifest>> {
    let folders: Vec<PathBuf> = requests
        .iter()
        .map(|request| if nested { aside.join(&request.name) } else { aside.to_owned() })
        .collect();
    for folder in &folders {
        std::fs::create_dir_all(folder)?;
    }
    let benches: Vec<Vec<Box<dyn Bench>>> =
        requests.iter().map(|request| source(request, options).benches()).collect();
    // Long streams first; each is one job, so the bytes do not depend on the number of threads.
    let longest = benches.iter().map(Vec::len).max().unwrap_or(0);
    let jobs: Vec<Job> = (0..longest)
        .flat_map(|bench| (0..benches.len()).map(move |set| (set, bench)))
        .filter(|&(set, bench)| bench < benches[set].len())
        .collect();
    let next = AtomicUsize::new(0);
    let made: Mutex<Vec<(Job, Result<Part>)>> = Mutex::default();
    std::thread::scope(|scope| {
        for _ in 0..options.threads.clamp(1, jobs.len().max(1)) {
            scope.spawn(|| {
                while let Some(&(set, bench)) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let part = write_bench(&*benches[set][bench], &folders[set], options, monitor);
                    made.lock().unwrap_or_else(PoisonError::into_inner).push(((set, bench), part));
                }
            });
        }
    });
    // The scope has joined every worker: each job has its part, in whatever order they came.
    let mut made = made.into_inner().unwrap_or_else(PoisonError::into_inner);
    made.sort_by_key(|(job, _)| *job);
    let mut parts = made.into_iter().map(|(_, part)| part);
    let mut manifests = Vec::new();
    for ((request, folder), list) in requests.iter().zip(&folders).zip(&benches) {
        let mine: Vec<Part> = parts.by_ref().take(list.len()).collect::<Result<_>>()?;
        if mine.len() != list.len() {
            unreachable!("the scope has joined every worker: {} of {}", mine.len(), list.len());
        }
        manifests.push(finish(request, folder, list, mine, options)?);
    }
    if nested {
        let sets = manifests
            .iter()
            .map(|made| SetEntry { folder: made.set.clone(), digest: made.digest.clone() })
            .collect();
        let index = SetIndex { schema: manifest::SCHEMA, sets, digest: String::new() };
        std::fs::write(aside.join(INDEX), index.to_text())?;
    }
    Ok(manifests)
}

/// What the benches of a request are made from.
fn source(request: &SetRequest, options: &Options) -> Source {
    Source {
        profile: request.profile.clone(),
        scene: Arc::clone(&request.scene),
        values: Arc::clone(&request.values),
        seed: options.seed,
        count: options.count,
    }
}

/// Name of a vector file.
pub fn file_name(stem: &str, format: RowFormat, zstd: bool) -> String {
    format!("{stem}.{}{}", format.extension(), if zstd { ".zst" } else { "" })
}

fn write_bench(
    bench: &dyn Bench,
    folder: &Path,
    options: &Options,
    monitor: &Monitor,
) -> Result<Part> {
    let specs = files(bench, options.format);
    let names: Vec<String> =
        specs.iter().map(|spec| file_name(&spec.stem, options.format, options.zstd)).collect();
    let mut output = FileOutput { monitor, zstd: options.zstd, files: Vec::new() };
    for name in &names {
        let file = File::create_new(folder.join(name))?;
        output.files.push((file, Sha256::new(), 0));
    }
    let emitted = emit(bench, options.shard, options.count, options.format, &mut output)?;
    let entries = specs
        .into_iter()
        .zip(names)
        .zip(output.files)
        .zip(&emitted.rows)
        .map(|(((spec, name), (_, hash, bytes)), &rows)| FileEntry {
            name,
            rows,
            bytes,
            sha256: hex_digest(hash),
            columns: spec.columns,
        })
        .collect();
    Ok((entries, emitted))
}

/// Hashes and writes, and stops when cancelled.
struct FileOutput<'a> {
    monitor: &'a Monitor,
    zstd: bool,
    files: Vec<(File, Sha256, u64)>,
}

impl Output for FileOutput<'_> {
    fn bytes(&mut self, file: usize, bytes: &[u8]) -> Result<bool> {
        if self.monitor.cancel.load(Ordering::Relaxed) {
            return Err(Error::from(ErrorKind::Interrupted));
        }
        self.monitor.bytes.fetch_add(bytes.len() as u64, Ordering::Relaxed);
        let compressed;
        let bytes = if self.zstd {
            compressed = compress(bytes);
            &compressed
        } else {
            bytes
        };
        let (file, hash, length) = &mut self.files[file];
        hash.update(bytes);
        *length += bytes.len() as u64;
        file.write_all(bytes)?;
        Ok(true)
    }
}

/// One zstd frame; frames one after another are a valid stream.
pub fn compress(bytes: &[u8]) -> Vec<u8> {
    ruzstd::encoding::compress_to_vec(bytes, ruzstd::encoding::CompressionLevel::Fastest)
}
