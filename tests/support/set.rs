//! Sets in temporary folders, and reading them by the spec alone: no reader of the library is used.
#![allow(dead_code, reason = "each test file takes what it needs")]

use guardbit::model::{Model, View};
use guardbit::profile::{self, Profile};
use guardbit::scene;
use guardbit::setup::Triangle;
use guardbit::vector::bench::Source;
use guardbit::vector::manifest::Manifest;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{self, Monitor, Options, SetRequest};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// A set in a folder that goes when this does.
pub(crate) struct Set {
    keep: TempDir,
    pub(crate) manifest: Manifest,
}

impl Set {
    pub(crate) fn folder(&self) -> PathBuf {
        self.keep.path().join("set")
    }

    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.file(name)).unwrap()
    }

    pub(crate) fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    /// Rows of a file in the golden form.
    pub(crate) fn rows(&self, name: &str) -> Vec<Vec<u128>> {
        tv_rows(&self.text(name))
    }
}

/// One record a line, columns joined by `_`, hexadecimal.
pub(crate) fn tv_rows(text: &str) -> Vec<Vec<u128>> {
    let word = |digits| u128::from_str_radix(digits, 16).unwrap();
    text.lines().map(|line| line.split('_').map(word).collect()).collect()
}

/// Words as a record of these widths.
pub(crate) fn tv_line(words: &[u128], widths: &[u32]) -> String {
    let column = |(word, width): (&u128, &u32)| {
        let mask = u128::MAX >> (128 - width);
        format!("{:0digits$x}", word & mask, digits = width.div_ceil(4) as usize)
    };
    words.iter().zip(widths).map(column).collect::<Vec<_>>().join("_")
}

/// The signed value of a pattern.
pub(crate) fn signed(word: u128, width: u32) -> i128 {
    let value = word.cast_signed();
    if word >> (width - 1) & 1 == 1 { value - (1 << width) } else { value }
}

pub(crate) fn profile(name: &str) -> Profile {
    profile::load(name).unwrap()
}

pub(crate) fn options(count: u64) -> Options {
    Options {
        count,
        seed: 1,
        shard: Shard::WHOLE,
        format: RowFormat::Tv,
        zstd: false,
        threads: 2,
        force: false,
    }
}

/// A built-in scene on a profile's grid.
pub(crate) fn snapped(profile: &Profile, name: &str) -> Vec<Triangle> {
    let model = Model::with_view(profile, View::default()).unwrap();
    let scene = scene::load(name, &model.viewport()).unwrap();
    scene.triangles.iter().map(|triangle| *model.snap(triangle).unwrap()).collect()
}

pub(crate) fn request(profile: &Profile, scene: &str) -> SetRequest {
    SetRequest {
        name: profile.name.clone(),
        profile: profile.clone(),
        scene_name: scene.to_owned(),
        scene: Arc::new(snapped(profile, scene)),
        values: Arc::default(),
        refused: 0,
    }
}

pub(crate) fn source(profile: &Profile, scene: &str, count: u64) -> Source {
    let (profile, scene) = (profile.clone(), Arc::new(snapped(profile, scene)));
    Source { profile, scene, values: Arc::default(), seed: 1, count }
}

/// Writes the set of a profile and a built-in scene.
pub(crate) fn write_set(profile: &Profile, scene: &str, options: &Options) -> Set {
    write_request(request(profile, scene), options)
}

/// Writes the set that is asked for.
pub(crate) fn write_request(request: SetRequest, options: &Options) -> Set {
    let keep = tempfile::tempdir().unwrap();
    let out = keep.path().join("set");
    let requests = [request];
    let manifests = write::write(&requests, &out, false, options, &Monitor::default()).unwrap();
    Set { keep, manifest: manifests.into_iter().next().unwrap() }
}

/// Names and contents of every file below a folder, in order of name.
pub(crate) fn tree(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut list = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            list.extend(tree(&path).into_iter().map(|(inner, b)| (format!("{name}/{inner}"), b)));
        } else {
            list.push((name, std::fs::read(&path).unwrap()));
        }
    }
    list.sort();
    list
}

/// Copies a flat folder.
pub(crate) fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for (name, bytes) in tree(from) {
        let path = to.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
}
