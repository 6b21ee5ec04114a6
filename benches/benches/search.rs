//! Measuring and searching budgets against the plain way of doing either.
//!
//! `measure` sums errors run by run, `naive` looks at every sample through exact rationals: the twin
//! that the tests hold it to. `fit` proves most budgets out of the way, `exhaustive` measures them all
//! on two threads, sharing whatever a sweep shares. What bounds `measure` is the set-up of two planes
//! a triangle in 128-bit integers and three divisions a run; what bounds `fit` is the same for the
//! handful of triangles that refute a budget. Run with
//! `cargo bench -p guardbit-benches --bench search`.

use criterion::{Criterion, criterion_group, criterion_main};
use guardbit::explore::fit::{Request, exhaustive, fit};
use guardbit::explore::metric::Metric;
use guardbit::explore::space::{Axis, Space};
use guardbit::explore::sweep::Sweep;
use guardbit::explore::tolerance::Tolerance;
use guardbit::measure::accuracy::{Drawn, Reference, measure};
use guardbit::measure::error::triangle_error;
use guardbit::model::Model;
use guardbit::profile::{self, WindowConfig};
use guardbit::scene;
use std::hint::black_box;

/// 3000 triangles in a window of 512 x 512, and a space of 4 fields and 4096 budgets.
fn sweep() -> Sweep {
    let mut base = profile::load("sgi-4k").expect("a built-in profile");
    base.window = WindowConfig { width: 512, height: 512 };
    let model = Model::new(&base).expect("a valid profile");
    let scene = scene::load("knot", &model.viewport()).expect("a built-in scene");
    let axes = [
        "edge-width=16..31",
        "interpolation=0..15",
        "guard=0..3",
        "rounding=floor,toward-zero,nearest-even,nearest-up",
    ];
    let axes = axes.map(|text| Axis::parse(text).expect("an axis")).to_vec();
    let scenes = vec![Reference::new(scene, &base)];
    Sweep { space: Space::new(base, axes).expect("a space"), scenes }
}

fn measured(criterion: &mut Criterion) {
    let sweep = sweep();
    let profile = sweep.space.base();
    let stage = &sweep.stages(profile).expect("a stage")[0];
    let drawn = Drawn::new(stage, profile).expect("a coverage");
    let model = Model::new(profile).expect("a valid profile");
    let mut group = criterion.benchmark_group("errors of a scene");
    group.sample_size(10);
    group.bench_function("measure", |b| b.iter(|| black_box(measure(stage, &drawn, profile))));
    group.bench_function("naive", |b| {
        b.iter(|| {
            for face in &stage.faces {
                black_box(triangle_error(&model, &face.triangle, |_, _, _| {}));
            }
        });
    });
    group.finish();
}

fn searched(criterion: &mut Criterion) {
    let sweep = sweep();
    let limits = [("misclassified", 0.0), ("wraps", 0.0), ("depth-worst", 0.5)];
    let tolerance = |(name, limit)| Tolerance { metric: Metric::find(name).expect(name), limit };
    let request = Request {
        sweep: &sweep,
        tolerances: limits.map(tolerance).to_vec(),
        cost: Metric::find("area").expect("area"),
        robust: false,
        numbers: 0..sweep.space.len(),
    };
    let mut group = criterion.benchmark_group("4096 budgets");
    group.sample_size(10);
    group.bench_function("fit", |b| b.iter(|| black_box(fit(&request, &|| true))));
    group.bench_function("exhaustive", |b| b.iter(|| black_box(exhaustive(&request, 2))));
    group.finish();
}

criterion_group!(benches, measured, searched);
criterion_main!(benches);
