//! `manifest.json`: what a set is, written last. Spec clauses `N-8` to `N-10`.

use super::bench::{Cell, Unreachable};
use super::formal::FOLDER;
use crate::format::Column;
use crate::profile::{Profile, read_at_most};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;

/// File name of the manifest.
pub const NAME: &str = "manifest.json";

/// The schema version of manifests: 3 since cells are hit, unreachable or open.
pub const SCHEMA: u32 = 3;

/// Everything about a set; no time, host or path.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Schema version.
    pub schema: u32,
    /// Model version that made the set.
    pub model_version: u32,
    /// Name of the set.
    pub set: String,
    /// The whole profile, window in force.
    pub profile: Profile,
    /// The scene.
    pub scene: SceneEntry,
    /// Seed of the random classes.
    pub seed: u64,
    /// Rows asked for in each walk file.
    pub count: u64,
    /// Row format.
    pub format: String,
    /// Which part of the set this is.
    pub shard: ShardEntry,
    /// Every other file of the set.
    pub files: Vec<FileEntry>,
    /// Tests by bench and class, in file order.
    pub groups: Vec<GroupEntry>,
    /// What the rows hit, and what they did not.
    pub coverage: Vec<CoverageEntry>,
    /// Benches that the testbenches of the set do not drive.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unchecked: Vec<UncheckedEntry>,
    /// SHA-256 of this file with an empty digest.
    pub digest: String,
}

/// The scene of a set; `scene.jsonl` holds its triangles on the profile's grid.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneEntry {
    /// Built-in name, or the stem of the file it came from.
    pub name: String,
    /// Triangles taken.
    pub triangles: u64,
    /// Triangles left out: vertices outside the profile's field or behind the camera.
    pub refused: u64,
    /// SHA-256 of `scene.jsonl`.
    pub sha256: String,
}

/// A part of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShardEntry {
    /// Which, from 0.
    pub index: u64,
    /// Of how many.
    pub parts: u64,
}

/// One file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FileEntry {
    /// Name in the folder.
    pub name: String,
    /// Rows of a vector file, lines of any other.
    pub rows: u64,
    /// Bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal.
    pub sha256: String,
    /// Columns of a vector file, else none.
    pub columns: Vec<Column>,
}

/// Tests of one class in one bench.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupEntry {
    /// Bench.
    pub bench: String,
    /// Class tag.
    pub tag: String,
    /// The kind of defect it catches.
    pub catches: String,
    /// Tests.
    pub tests: u64,
    /// Rows in the bench's first expectation file.
    pub rows: u64,
}

/// What a bench's rows hit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoverageEntry {
    /// Bench.
    pub bench: String,
    /// Cells with rows: `octant.zone.remainder`, and the goals of the bench.
    pub cells: Vec<Cell>,
    /// Cells that nothing can hit, each with the bound that shows it.
    pub unreachable: Vec<Unreachable>,
    /// Cells that something could hit and nothing did.
    pub open: Vec<String>,
}

/// A bench of the set that a testbench does not drive.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UncheckedEntry {
    /// `tb.sv`, which has the same devices as `tb_cocotb.py`, or `tb.vhd`.
    pub testbench: String,
    /// Bench.
    pub bench: String,
    /// Why.
    pub reason: String,
}

impl Manifest {
    /// The canonical text: indented JSON and a newline, digest filled in.
    pub fn to_text(&self) -> String {
        let text = |digest: String| {
            let manifest = Self { digest, ..self.clone() };
            pretty(&manifest)
        };
        text(sha256(text(String::new()).as_bytes()))
    }
}

/// Indented JSON and a newline of a struct of strings and integers.
pub(super) fn pretty(value: &impl Serialize) -> String {
    let text = serde_json::to_string_pretty(value)
        .unwrap_or_else(|error| unreachable!("strings and integers have a JSON form: {error}"));
    text + "\n"
}

/// The most bytes of a manifest or an index that are read: those of the default sets have a hundredth.
const LARGEST: u64 = 1 << 24;

/// The bytes of a manifest or an index.
pub(super) fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    read_at_most(path, LARGEST)
}

/// Whether a name that a file gives can only mean something in the file's own folder.
pub(super) fn is_plain(name: &str) -> bool {
    !name.contains(['/', '\\', ':', '\0']) && !["", ".", ".."].contains(&name)
}

/// Whether a manifest may list a file of this name.
pub(super) fn is_file_name(name: &str) -> bool {
    let inner = name.strip_prefix(FOLDER).and_then(|rest| rest.strip_prefix('/'));
    is_plain(inner.unwrap_or(name))
}

/// SHA-256 in lower-case hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    hex_digest(Sha256::new().chain_update(bytes))
}

/// The finished digest of a running hash.
pub fn hex_digest(hash: Sha256) -> String {
    let mut text = Vec::with_capacity(64);
    for byte in hash.finalize() {
        crate::bits::push_hex_narrow(&mut text, u64::from(byte), 2);
    }
    String::from_utf8(text)
        .unwrap_or_else(|error| unreachable!("hexadecimal digits are ASCII: {error}"))
}
