//! The last of a set: scene, profile, packages, benches, and the manifest.

use super::interface::interface;
use super::{Options, Part, SetRequest, file_name};
use crate::model::MODEL_VERSION;
use crate::profile::Profile;
use crate::scene::{self, Shading, lines};
use crate::setup::Triangle;
use crate::value::{AttributeConfig, VertexValues};
use crate::vector::bench::{Bench, Cells};
use crate::vector::emit::Emitted;
use crate::vector::formal;
use crate::vector::manifest::{
    self, CoverageEntry, FileEntry, GroupEntry, Manifest, SceneEntry, ShardEntry, UncheckedEntry,
    sha256,
};
use crate::vector::package;
use crate::vector::table::RowFormat;
use std::fs::File;
use std::io::{Error, Result, Write};
use std::path::Path;

/// The scene file: triangles on the profile's grid and their codes, if they bring any, in `eval`'s form.
pub fn scene_text(scene: &[Triangle], values: &[VertexValues], profile: &Profile) -> String {
    let mut text = String::new();
    for (id, triangle) in scene.iter().enumerate() {
        let xy = profile.vertex.to_input(triangle.xy);
        let lattice = scene::Triangle::Lattice { xy, z: triangle.z };
        let shading = values.get(id).map(|values| shading(values, profile));
        text.push_str(&lines::to_line(id as u64, &lattice, shading.as_ref()));
        text.push('\n');
    }
    text
}

/// Codes by the names of their channels.
fn shading(values: &VertexValues, profile: &Profile) -> Shading {
    let mut components = values.components().iter().copied();
    let channel = |config: &AttributeConfig| {
        let codes = components.by_ref().take(config.components.len()).collect();
        (config.name.clone(), codes)
    };
    let channels = profile.channel.iter().map(channel).collect();
    Shading::Codes { channels, inverse_w: values.inverse_w() }
}

/// The files of a set that are not vectors, in order.
pub fn companions(
    set: &str,
    profile: &Profile,
    (scene, values): (&[Triangle], &[VertexValues]),
    vector_files: &[FileEntry],
    format: RowFormat,
    zstd: bool,
) -> Vec<(String, String)> {
    let mut list = vec![
        ("profile.toml".to_owned(), profile.to_toml()),
        ("scene.jsonl".to_owned(), scene_text(scene, values, profile)),
    ];
    // The benches read the golden form only.
    if format == RowFormat::Tv && !zstd {
        list.extend(package::files(&interface(set, profile, vector_files)));
        list.extend(formal::files(set, profile));
    }
    list
}

/// The benches that the testbenches of a set do not drive; none of a form that has no testbenches.
pub fn unchecked(
    set: &str,
    profile: &Profile,
    vector_files: &[FileEntry],
    format: RowFormat,
    zstd: bool,
) -> Vec<UncheckedEntry> {
    if format != RowFormat::Tv || zstd {
        return Vec::new();
    }
    let list = package::unchecked(&interface(set, profile, vector_files));
    let entry = |left: package::Unchecked| UncheckedEntry {
        testbench: left.testbench.to_owned(),
        bench: left.bench,
        reason: left.reason,
    };
    list.into_iter().map(entry).collect()
}

/// What the manifest says of a bench: its groups that have tests, and what their rows hit.
pub fn account(bench: &dyn Bench, emitted: &Emitted) -> (Vec<GroupEntry>, CoverageEntry) {
    let name = bench.name().to_owned();
    let counted = bench.groups().iter().zip(&emitted.groups).filter(|(_, (tests, _))| *tests > 0);
    let groups = counted
        .map(|(group, &(tests, rows))| GroupEntry {
            bench: name.clone(),
            tag: group.class.tag.to_owned(),
            catches: group.class.catches.to_owned(),
            tests,
            rows,
        })
        .collect();
    let Cells { hit, unreachable, open } = emitted.coverage.report(bench.shape(), &bench.goals());
    (groups, CoverageEntry { bench: name, cells: hit, unreachable, open })
}

pub(super) fn finish(
    request: &SetRequest,
    folder: &Path,
    benches: &[Box<dyn Bench>],
    parts: Vec<Part>,
    options: &Options,
) -> Result<Manifest> {
    let (mut entries, mut groups, mut coverage) = (Vec::new(), Vec::new(), Vec::new());
    for (bench, (files, emitted)) in benches.iter().zip(parts) {
        entries.extend(files);
        let (mine, covered) = account(&**bench, &emitted);
        groups.extend(mine);
        coverage.push(covered);
    }
    let companions = companions(
        &request.name,
        &request.profile,
        (&request.scene, &request.values),
        &entries,
        options.format,
        options.zstd,
    );
    let unchecked =
        unchecked(&request.name, &request.profile, &entries, options.format, options.zstd);
    let mut scene_digest = String::new();
    for (name, text) in companions {
        let entry = FileEntry {
            rows: text.lines().count() as u64,
            bytes: text.len() as u64,
            sha256: sha256(text.as_bytes()),
            columns: Vec::new(),
            name,
        };
        if entry.name == "scene.jsonl" {
            scene_digest.clone_from(&entry.sha256);
        }
        let path = folder.join(&entry.name);
        path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
        std::fs::write(path, text)?;
        entries.push(entry);
    }
    let manifest = Manifest {
        schema: manifest::SCHEMA,
        model_version: MODEL_VERSION,
        set: request.name.clone(),
        profile: request.profile.clone(),
        scene: SceneEntry {
            name: request.scene_name.clone(),
            triangles: request.scene.len() as u64,
            refused: request.refused,
            sha256: scene_digest,
        },
        seed: options.seed,
        count: options.count,
        format: file_name("", options.format, options.zstd).trim_start_matches('.').to_owned(),
        shard: ShardEntry { index: options.shard.index, parts: options.shard.parts },
        files: entries,
        groups,
        coverage,
        unchecked,
        digest: String::new(),
    };
    let text = manifest.to_text();
    // Written last: a folder without it is an unfinished set.
    let mut file = File::create_new(folder.join(manifest::NAME))?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    serde_json::from_str(&text).map_err(Error::other)
}
