//! What the fuzzer calls: every reader of text from outside, and what must hold of all it takes.
//!
//! Nothing may panic, whatever the bytes are. What is read can be written again and read back the same.
//! The tests of the crate call the same functions on spoiled seeds: `cargo test fuzz`.
#![allow(clippy::unwrap_used, reason = "a failure is what the fuzzer looks for")]

use guardbit::cover::Rect;
use guardbit::explore::space::Axis;
use guardbit::format::{Column, Layout};
use guardbit::model::{Drawing, Model, Records, View};
use guardbit::profile;
use guardbit::scene::{lines, mesh};
use guardbit::setup::Triangle;
use guardbit::vector::check::{self, CheckOptions};
use guardbit::vector::dump::Dump;
use guardbit::vector::manifest::Manifest;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{self, Monitor, Options, SetIndex, SetRequest};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A target by name.
pub type Target = fn(&[u8]);

/// Every target, by the name of its binary.
pub const TARGETS: [(&str, Target); 9] = [
    ("profile", profile),
    ("eval", eval),
    ("scene", scene),
    ("mesh", mesh),
    ("layout", layout),
    ("words", words),
    ("axis", axis),
    ("dump", dump),
    ("set", set),
];

/// Profiles: TOML in, the same TOML out, and a model of every profile that is taken.
pub fn profile(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let Ok(read) = profile::parse(text, "fuzz.toml") else { return };
    assert_eq!(profile::parse(&read.to_toml(), "again.toml").unwrap(), read);
    Model::new(&read).unwrap();
}

/// Lines of `eval`, drawn by a small machine of triangles and by one of registers.
pub fn eval(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let Ok(request) = lines::parse_line(text) else { return };
    for name in ["tiny", "psp"] {
        let view = View { scissor: Some(Rect { x0: 0, y0: 0, x1: 64, y1: 64 }), ..View::default() };
        let model = Model::with_view(&profile::load(name).unwrap(), view).unwrap();
        let Ok(primitive) = model.prepare(&request.primitive) else { continue };
        if let Some(words) = primitive.words() {
            // Any registers may be given; how many records they draw is bounded here.
            let mut records = Records::up_to(1 << 10);
            let _ = model.draw(words, &mut records);
        } else {
            let mut drawing = Drawing::default();
            if model.draw(&primitive, &mut drawing).is_ok() {
                assert!(drawing.spans.iter().all(|span| span.x0 < span.x1 && span.x1 <= 64));
            }
        }
    }
}

/// Scenes: what is read is written as lines that read back the same.
pub fn scene(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let Ok(triangles) = lines::parse_scene(text) else { return };
    let write = |list: &[lines::SceneLine]| -> String {
        let line = |one: &lines::SceneLine| lines::to_line(7, &one.triangle, one.shading.as_ref());
        list.iter().map(|one| line(one) + "\n").collect()
    };
    let written = write(&triangles);
    // As text: a NaN is not equal to itself.
    assert_eq!(write(&lines::parse_scene(&written).unwrap()), written);
}

/// Meshes of every format: every corner that is taken is finite, and brings its values.
pub fn mesh(data: &[u8]) {
    let read = [
        mesh::obj::parse(&String::from_utf8_lossy(data)).ok(),
        mesh::ply::parse(data).ok(),
        mesh::stl::parse(data).ok(),
        mesh::gltf::parse(data, std::path::Path::new("no-such-folder")).ok(),
    ];
    for mesh in read.into_iter().flatten() {
        assert!(mesh.triangles.iter().flatten().flatten().all(|value| value.is_finite()));
        assert_eq!(mesh.places.len(), mesh.triangles.len());
        let fits = |set: &guardbit::scene::AttributeSet| {
            set.values.len() == 3 * set.components * mesh.triangles.len()
        };
        assert!(mesh.sets.iter().all(fits));
    }
}

/// Bit fields of register words.
pub fn layout(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let words: Vec<&str> = text.lines().collect();
    if let Ok(layout) = Layout::parse(&words) {
        assert_eq!(layout.len(), words.len());
        layout.dropped(&vec![u32::MAX; words.len()]);
    }
}

/// Register words as text, in the radix of a profile.
pub fn words(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    for name in ["psp", "virge"] {
        let model = Model::new(&profile::load(name).unwrap()).unwrap();
        let registers = model.registers().unwrap();
        let list: Vec<&str> = text.split_whitespace().collect();
        if let Ok(words) = registers.parse(&list) {
            assert_eq!(words.len(), list.len());
        }
    }
}

/// `--vary` of `explore`.
pub fn axis(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let _ = Axis::parse(text);
}

/// Dumps of a device.
pub fn dump(data: &[u8]) {
    let columns = [
        Column::new("test", 32, false, 0, "Number of the test, from 0."),
        Column::new("acc", 39, true, 13, "Accumulator."),
        Column::new("out", 24, false, 0, "Read-out."),
    ];
    let file = std::env::temp_dir().join(format!("guardbit-fuzz-{}.tv", std::process::id()));
    std::fs::write(&file, data).unwrap();
    let read = Dump::read(&file, &columns);
    std::fs::remove_file(&file).unwrap();
    if let Ok(dump) = read {
        assert!(dump.rows() <= data.len());
    }
}

/// A small set in a folder below this one.
pub fn write_set(folder: &Path) -> Manifest {
    let profile = profile::load("tiny").unwrap();
    let triangle = Triangle { xy: [[0, 0], [8, 0], [0, 8]], z: Some([1, 5, 7]) };
    let request = SetRequest {
        name: "tiny".to_owned(),
        profile,
        scene_name: "mine".to_owned(),
        scene: Arc::new(vec![triangle]),
        values: Arc::default(),
        refused: 0,
    };
    let options = Options {
        count: 12,
        seed: 1,
        shard: Shard::WHOLE,
        format: RowFormat::Tv,
        zstd: false,
        threads: 1,
        force: false,
    };
    write::write(&[request], folder, true, &options, &Monitor::default()).unwrap().remove(0)
}

/// Manifests and indexes: a check of the set, plain and with every file computed again, ends. What can be read as a
/// manifest also comes with a digest that fits, so that the check goes on behind it.
pub fn set(data: &[u8]) {
    // Tests run side by side in one process.
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    let name = format!(
        "guardbit-fuzz-set-{}-{}",
        std::process::id(),
        NUMBER.fetch_add(1, Ordering::Relaxed)
    );
    let folder = std::env::temp_dir().join(name);
    let manifest: Option<Manifest> = serde_json::from_slice(data).ok();
    let index: Option<SetIndex> = serde_json::from_slice(data).ok();
    let checked = |dir: &Path, text: &[u8], name: &str| {
        std::fs::write(dir.join(name), text).unwrap();
        for recompute in [false, true] {
            let options = CheckOptions { recompute, threads: 1, ..CheckOptions::default() };
            let _ = check::check(dir, options, &Monitor::default());
        }
    };
    if manifest.is_none() && index.is_none() {
        std::fs::create_dir_all(&folder).unwrap();
        checked(&folder, data, "manifest.json");
        checked(&folder, data, "sets.json");
    } else {
        write_set(&folder);
    }
    if let Some(manifest) = manifest {
        checked(&folder.join("tiny"), data, "manifest.json");
        checked(&folder.join("tiny"), manifest.to_text().as_bytes(), "manifest.json");
    }
    if let Some(index) = index {
        checked(&folder, data, "sets.json");
        checked(&folder, index.to_text().as_bytes(), "sets.json");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
