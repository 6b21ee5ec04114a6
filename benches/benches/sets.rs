//! Writing and checking a vector set against hashing and writing (or reading) the same bytes.
//!
//! The bar: at most twice the time of the bytes alone, on two threads. Per row a set costs one
//! addition, one decode, three words to hexadecimal and a count of its coverage cell; per byte it
//! costs SHA-256 and a copy into the page cache, as the baseline does. Run with
//! `cargo bench -p guardbit-benches --bench sets`.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use guardbit::model::Model;
use guardbit::profile;
use guardbit::scene;
use guardbit::vector::check::{CheckOptions, check};
use guardbit::vector::manifest::sha256;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{Monitor, Options, SetRequest, write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const COUNT: u64 = 2_000_000;

fn request() -> SetRequest {
    let profile = profile::load("sgi-4k").expect("a built-in profile");
    let model = Model::new(&profile).expect("a valid profile");
    let scene = scene::load("knot", &model.viewport()).expect("a built-in scene");
    let triangles = scene.triangles.iter().filter_map(|t| model.snap(t).ok().map(|t| *t)).collect();
    let (name, scene_name) = (profile.name.clone(), scene.name);
    SetRequest {
        name,
        profile,
        scene_name,
        scene: Arc::new(triangles),
        values: Arc::default(),
        refused: 0,
    }
}

fn options() -> Options {
    Options {
        count: COUNT,
        seed: 1,
        shard: Shard::WHOLE,
        format: RowFormat::Tv,
        zstd: false,
        threads: 2,
        force: true,
    }
}

/// The files of a folder in two halves of about the same size.
fn halves(folder: &Path) -> [Vec<(PathBuf, Vec<u8>)>; 2] {
    let mut files: Vec<(PathBuf, Vec<u8>)> = std::fs::read_dir(folder)
        .expect("the set is there")
        .map(|entry| entry.expect("an entry").path())
        .map(|path| (path.clone(), std::fs::read(&path).expect("a file")))
        .collect();
    files.sort_by_key(|(_, bytes)| std::cmp::Reverse(bytes.len()));
    let (mut left, mut right) = (Vec::new(), Vec::new());
    let size = |half: &Vec<(PathBuf, Vec<u8>)>| half.iter().map(|(_, b)| b.len()).sum::<usize>();
    for file in files {
        if size(&left) <= size(&right) { left.push(file) } else { right.push(file) }
    }
    [left, right]
}

fn bytes_alone(halves: &[Vec<(PathBuf, Vec<u8>)>; 2], to: Option<&Path>) {
    std::thread::scope(|scope| {
        for half in halves {
            scope.spawn(move || {
                for (path, bytes) in half {
                    match to {
                        Some(to) => {
                            std::hint::black_box(sha256(bytes));
                            std::fs::write(to.join(path.file_name().expect("a name")), bytes)
                                .expect("writable");
                        }
                        None => {
                            let bytes = std::fs::read(path).expect("readable");
                            std::hint::black_box(sha256(&bytes));
                        }
                    }
                }
            });
        }
    });
}

fn sets(c: &mut Criterion) {
    let folder = std::env::temp_dir().join(format!("guardbit-bench-{}", std::process::id()));
    let (set, copy) = (folder.join("set"), folder.join("copy"));
    std::fs::create_dir_all(&copy).expect("a temporary folder");
    let (request, options, monitor) = (request(), options(), Monitor::default());
    let made = write(std::slice::from_ref(&request), &set, false, &options, &monitor);
    let rows: u64 = made.expect("a set")[0]
        .files
        .iter()
        .filter(|f| !f.columns.is_empty())
        .map(|f| f.rows)
        .sum();
    let halves = halves(&set);
    let mut group = c.benchmark_group("set");
    group.sample_size(10).throughput(Throughput::Elements(rows));
    group.bench_function(BenchmarkId::new("write", "set"), |b| {
        b.iter(|| {
            write(std::slice::from_ref(&request), &set, false, &options, &monitor).expect("a set")
        });
    });
    group.bench_function(BenchmarkId::new("write", "bytes alone"), |b| {
        b.iter(|| bytes_alone(&halves, Some(&copy)));
    });
    let checks = CheckOptions { threads: 2, ..CheckOptions::default() };
    group.bench_function(BenchmarkId::new("verify", "set"), |b| {
        b.iter(|| check(&set, checks, &monitor).expect("a set"));
    });
    group.bench_function(BenchmarkId::new("verify", "bytes alone"), |b| {
        b.iter(|| bytes_alone(&halves, None));
    });
    group.finish();
    let _ = std::fs::remove_dir_all(&folder);
}

criterion_group!(benches, sets);
criterion_main!(benches);
