//! The kernels, and whole drawings, at every processor level of this machine.
//!
//! `cargo bench -p guardbit-benches`; `-- --quick` for a first look, `-- row_values` for one group.
//! For ratios to plain loops, which travel between machines better than times, see
//! `guardbit speed`. The times named below are from November 2026, one core of a shared Xeon with
//! AVX-512.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use guardbit::bits::{EventLog, Events as _, Lane, Place};
use guardbit::dda::{Edges, Line, Processor, row_inside, row_values, walk_checksum};
use guardbit::format::{Clamp, Decode, ReadOut};
use guardbit::machine::{Input, Sink};
use guardbit::model::{Model, View};
use guardbit::profile::load;
use guardbit::scene;
use guardbit::setup::{Snapped, Triangle};
use std::hint::black_box;

/// The 39-bit depth accumulator of the lectures.
fn depth() -> ReadOut {
    ReadOut::new(2, 24, 13, Clamp::Guard).expect("39 bits are a word")
}

/// Start and slopes of a plane that crosses both ends of the range inside a 1024-pixel row.
const PLANE: [i128; 3] = [-(1 << 33), 536_870_912 / 2 + 4_099, -1_237];

fn words<L: Lane>(read: ReadOut) -> (Decode<L>, [L; 3]) {
    let decode: Decode<L> = read.decode().expect("the lane holds 39 bits");
    (decode, [decode.load(PLANE[0]), decode.slope(PLANE[1]), decode.slope(PLANE[2])])
}

/// A row of depth values into a slice: per sample one addition, two comparisons, one addition, one
/// shift, one store. A block of 32 samples shares its base, so nothing waits for the sample before
/// it; what limits a row is the vector unit, and the store once the row leaves the first cache.
/// At 1024 samples: 10.05 ns a sample with AVX-512, 0.38 with AVX2, 0.51 with SSE4.2, 1.6 with SSE2,
/// which compares 64-bit words in scalar registers. Rows below a block of 32 take a plain loop, so
/// 8 samples cost 7 ns at every level. The 128-bit lane has no vector form: 1.7 ns a sample is what
/// a word beyond 64 bits costs.
fn rows(c: &mut Criterion) {
    let mut group = c.benchmark_group("row_values");
    for count in [8usize, 64, 1024] {
        group.throughput(Throughput::Elements(count as u64));
        let mut out = vec![0; count];
        let (decode, [start, dx, _]) = words::<i64>(depth());
        for processor in Processor::available() {
            group.bench_function(BenchmarkId::new(processor.name(), count), |b| {
                b.iter(|| row_values(processor, decode, black_box(start), dx, black_box(&mut out)));
            });
        }
        let (decode, [start, dx, _]) = words::<i128>(depth());
        group.bench_function(BenchmarkId::new("i128", count), |b| {
            b.iter(|| {
                row_values(Processor::best(), decode, black_box(start), dx, black_box(&mut out));
            });
        });
    }
    group.finish();
}

/// The same without the store: 64 rows folded into a checksum. The difference to `row_values` is
/// what writing costs, and at 10.09 ns a sample with AVX-512 it is no cheaper: exclusive or and sum
/// weigh as much as the store that stays in the first cache.
fn checksum(c: &mut Criterion) {
    let mut group = c.benchmark_group("walk_checksum");
    let size = (1024, 64);
    group.throughput(Throughput::Elements(u64::from(size.0) * u64::from(size.1)));
    let (decode, plane) = words::<i64>(depth());
    for processor in Processor::available() {
        group.bench_function(processor.name(), |b| {
            b.iter(|| walk_checksum(processor, decode, black_box(plane), size, |_| ()));
        });
    }
    group.finish();
}

/// Three edge words a sample to one bit: three additions, two ors, one comparison, and eight bytes
/// to a byte by one multiplication. Most of a drawing's samples are outside, so this is what a
/// large triangle's bounding box costs. A row pays 40 to 50 ns before its first sample, for three
/// tables of 32 multiples: that is why rows of up to 16 samples take a scalar path (15 ns for 8),
/// and why 64 samples cost 75 to 100 ns where 1024 cost 500 to 1000. The bytes-to-bits step bounds
/// the long rows: AVX-512 is not twice as quick as SSE2.
fn edges(c: &mut Criterion) {
    let mut group = c.benchmark_group("row_inside");
    let word = |value| i64::justify(value, 35);
    let edges = Edges {
        value: [word(400_000), word(-3_000), word(90_000)],
        step_x: [word(-700), word(900), word(13)],
        step_y: [word(5), word(-9), word(1)],
    };
    for count in [8u32, 64, 1024] {
        group.throughput(Throughput::Elements(count.into()));
        let mut mask = Vec::new();
        for processor in Processor::available() {
            group.bench_function(BenchmarkId::new(processor.name(), count), |b| {
                b.iter(|| row_inside(processor, black_box(edges), count, black_box(&mut mask)));
            });
        }
    }
    group.finish();
}

/// The events of a row in closed form: a few 128-bit divisions whatever its length, 50 to 60 ns for
/// 8 samples and for 1024. Beside a row of 1024 values that is a third more at AVX-512 and less
/// elsewhere; short spans feel it most.
fn events(c: &mut Criterion) {
    let mut group = c.benchmark_group("line_events");
    let read = depth();
    for count in [8u64, 1024] {
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            let line = Line { start: PLANE[0], slope: PLANE[1], count };
            b.iter(|| {
                let mut log = EventLog::default();
                log.span(&black_box(line).events(read, Place { y: 0, x: 0 }));
                log
            });
        });
    }
    group.finish();
}

/// A sink that keeps a sum, so that nothing is optimised away and nothing is allocated.
#[derive(Default)]
struct Sum {
    samples: u64,
    depth: u64,
}

impl Sink for Sum {
    fn span(&mut self, _y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.samples += u64::from(x1 - x0);
        self.depth = depth.iter().fold(self.depth, |sum, z| sum.wrapping_add(*z));
    }
}

/// Whole scenes at 1024 x 1024. `fan` has 96 large triangles: the kernels. `knot` has thousands of
/// a few hundred samples: set-up with its 128-bit divisions, and short rows. Elements are covered
/// samples, so the two rates say how much a small triangle costs: about twice as much a sample.
/// `sgi-4k` and `sgi-4k-walk` share the depth plane; their difference is three edge words over a
/// bounding box against two ends a row. On the fan, whose slices fill little of their boxes, the
/// walk is over four times as quick, on the knot twice: what a tile or span traversal could win.
fn drawings(c: &mut Criterion) {
    let mut group = c.benchmark_group("draw");
    group.sample_size(20);
    for scene in ["fan", "knot"] {
        for name in ["sgi-4k", "sgi-4k-walk"] {
            let view = View { window: Some((1024, 1024)), ..View::default() };
            let profile = load(name).expect("a built-in profile");
            let model = Model::with_view(&profile, view).expect("a valid profile");
            let triangles: Vec<Snapped<Triangle>> = scene::load(scene, &model.viewport())
                .expect("a built-in scene")
                .triangles
                .iter()
                .filter_map(|triangle| model.snap(triangle).ok())
                .collect();
            let draw = || {
                let mut sum = Sum::default();
                for triangle in &triangles {
                    model.draw(black_box(triangle), &mut sum).expect("the clamp is guard");
                }
                sum
            };
            group.throughput(Throughput::Elements(draw().samples));
            group.bench_function(BenchmarkId::new(name, scene), |b| b.iter(|| draw().depth));
        }
    }
    group.finish();
}

/// Depth and codes written to memory: depth in four bytes, codes in two.
struct Memory {
    depth: Vec<u32>,
    codes: Vec<Vec<u16>>,
}

#[expect(clippy::cast_possible_truncation, reason = "codes have 24, 8 and 12 bits")]
#[expect(clippy::cast_sign_loss, reason = "codes are unsigned")]
impl Sink for Memory {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        let row = &mut self.depth[(y << 10 | x0) as usize..(y << 10 | x1) as usize];
        row.iter_mut().zip(depth).for_each(|(slot, z)| *slot = *z as u32);
    }

    fn channel(&mut self, channel: usize, y: u32, x0: u32, components: &[Vec<i64>]) {
        let place = (y << 10 | x0) as usize;
        for (n, codes) in components.iter().enumerate() {
            let row = &mut self.codes[4 * channel + n][place..][..codes.len()];
            row.iter_mut().zip(codes).for_each(|(slot, code)| *slot = *code as u16);
        }
    }
}

/// Depth alone, and with four components of a colour and two of a texture: what a channel costs.
/// As ratios to `depth`, with AVX-512: an affine component adds 0.4 to 0.6, six quotients come to 7,
/// six products by a reciprocal unit to 30, six by coordinates to 80.
fn channels(c: &mut Criterion) {
    let mut group = c.benchmark_group("channels");
    let depth = load("d3d11").expect("a built-in profile").to_toml();
    let w = "[w]\nguard = 1\ninteger = 16\ninterpolation = 12\nrounding = \"nearest-even\"\nclamp = \"guard\"\n";
    let channel = |name: &str, components: &str, integer: u32, correction: &str| {
        format!(
            "[[channel]]\nname = {name:?}\ncomponents = [{components}]\nguard = 1\ninteger = {integer}\n\
             interpolation = 14\nrounding = \"nearest-even\"\nclamp = \"guard\"\n\
             correction = {correction}\n"
        )
    };
    let six = |correction: &str| {
        channel("color", r#""r", "g", "b", "a""#, 8, correction)
            + &channel("map", r#""u", "v""#, 12, correction)
    };
    let affine = |names: &str| channel("c", names, 8, "\"affine\"");
    let unit = r#"{ reciprocal = { rounding = "floor", unit = { operand = 20, index = 7, entry = 10, refine = { newton = { bits = [18] } } } } }"#;
    let weights = r#"{ barycentric = { bits = 16, rounding = "nearest-even" } }"#;
    let cases = [
        ("depth", String::new()),
        ("affine-1", affine(r#""r""#)),
        ("affine-4", affine(r#""r", "g", "b", "a""#)),
        ("quotient-6", w.to_owned() + &six(r#"{ quotient = { rounding = "nearest-even" } }"#)),
        ("constant-w-6", w.to_owned() + &six(r#"{ constant-w = { rounding = "floor" } }"#)),
        ("reciprocal-6", w.to_owned() + &six(unit)),
        ("barycentric-6", w.to_owned() + &six(weights)),
    ];
    for (name, channels) in cases {
        let text = depth.clone() + &channels;
        let profile = guardbit::profile::parse(&text, name).expect("a valid profile");
        let view = View { window: Some((1024, 1024)), ..View::default() };
        let model = Model::with_view(&profile, view).expect("a valid profile");
        let at = |x: f64, y: f64, z: f64| [x, y, z];
        let triangle = scene::Triangle::real([
            at(3.0, 5.0, 10.0),
            at(1020.0, 20.0, 4e6),
            at(40.0, 1019.0, 9e6),
        ]);
        let triangle = model.snap(&triangle).expect("inside the window");
        let values: Vec<_> = profile
            .channel
            .iter()
            .map(|channel| {
                let codes =
                    channel.components.iter().enumerate().map(|(n, _)| [3 + n as i128, 200, 90]);
                (channel.name.clone(), codes.collect())
            })
            .collect();
        let q = profile.w.map(|_| [65535, 20000, 7000]);
        let values =
            (!values.is_empty()).then(|| model.values(&values, q).expect("codes in range"));
        let mut memory = Memory { depth: vec![0; 1 << 20], codes: vec![vec![0; 1 << 20]; 6] };
        group.throughput(Throughput::Elements(512 * 1024));
        group.bench_function(name, |b| {
            b.iter(|| {
                let input = match &values {
                    Some(values) => Input::Shaded(black_box(&triangle), values),
                    None => Input::Triangle(black_box(&triangle)),
                };
                model.draw(input, &mut memory).expect("the clamp is guard");
            });
        });
    }
    group.finish();
}

criterion_group!(kernels, rows, checksum, edges, events, drawings, channels);
criterion_main!(kernels);
