//! Every machine and every order of visits against the exact truth, and against each other.
#![allow(
    clippy::unwrap_used,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    reason = "a test may panic, and its numbers are small"
)]

mod orders;
mod shapes;

use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::{DepthAt, FillRule, MultisampleConfig, Order, Stamp, TraversalConfig};
use guardbit::exact::{Outline, PlaneNumerator, Rule};
use guardbit::machine::{SetupError, Sink, serial_plane};
use guardbit::measure::error::{SampleError, triangle_error};
use guardbit::model::{Drawing, Model, Span};
use guardbit::profile::{Form, Profile, load, triangle_machines};
use guardbit::scene;
use guardbit::setup::Triangle;

/// A profile of toy size: 4 x 4 pixels, two sub-pixel bits, three bits of depth.
fn toy(rule: FillRule) -> Profile {
    let mut profile = load("tiny").unwrap();
    if let Some(edge) = profile.form.edge_mut() {
        edge.rule = rule;
        edge.width = 40;
    }
    profile
}

/// The machines whose coverage is exact, and edge functions in every order.
fn exact_machines(base: &Profile) -> Vec<(String, Profile)> {
    let mut list: Vec<(String, Profile)> = triangle_machines()
        .map(|kind| (kind.name.to_owned(), base.with_machine(kind.name).unwrap()))
        .filter(|(_, profile)| profile.covers_exactly())
        .collect();
    for name in ["edge-function", "engine-per-pixel", "tiles", "homogeneous", "scanline"] {
        assert!(list.iter().any(|(exact, _)| exact == name), "{name} is exact");
    }
    for order in Order::ALL {
        for stamp in Stamp::ALL {
            let traversal = Some(TraversalConfig { order, stamp });
            let profile = Profile { traversal, ..base.clone() };
            list.push((format!("{} {}", order.name(), stamp.name()), profile));
        }
    }
    list
}

/// The exact spans of a triangle in a profile's window.
fn exact_spans(profile: &Profile, triangle: &Triangle) -> Vec<Span> {
    let (grid, window) = (profile.grid().unwrap(), profile.window().unwrap());
    let rule = match profile.form.rule() {
        FillRule::TopLeft => Rule::TopLeft,
        FillRule::Shadow => Rule::Shadow,
    };
    let outline = Outline::new(triangle.xy);
    let [x, _] = grid.position(0, 0);
    let mut spans = Vec::new();
    if triangle.area2() == 0 {
        return spans;
    }
    for y in window.y0..window.y1 {
        let at = grid.position(0, i128::from(y))[1];
        if let Some(cut) = outline.row(at, (x, 1 << grid.sub_pixel), rule) {
            let (x0, x1) = window.clip(0, cut);
            if x0 < x1 {
                spans.push(Span { y, x0, x1 });
            }
        }
    }
    spans
}

fn draw(model: &Model, triangle: &Triangle) -> Drawing {
    let mut drawing = Drawing::default();
    model.draw(&model.place(*triangle).unwrap(), &mut drawing).unwrap();
    drawing
}

/// Triangles of the toy grid: every pair of points as an edge, and every 29th third vertex, so that
/// each edge meets apexes on both sides, on samples and beside them.
fn toy_triangles(profile: &Profile) -> Vec<Triangle> {
    let (low, high) = profile.vertex.range();
    let points: Vec<[i128; 2]> =
        (low..=high).flat_map(|y| (low..=high).map(move |x| [x, y])).collect();
    let mut list = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate() {
            for c in points.iter().skip((i * 7 + j * 3) % 29).step_by(29) {
                let z = [(i % 8) as i128, (j % 8) as i128, ((i + j) % 8) as i128];
                list.push(Triangle { xy: [*a, *b, *c], z: Some(z) });
            }
        }
    }
    list
}

/// Clauses, O-1 and O-2: all exact machines and all orders cover what the
/// outline's rational cuts say, and those that walk a plane read the same depth and events.
#[test]
fn exact_machines_and_orders_agree_on_every_toy_triangle() {
    for rule in FillRule::ALL {
        let base = toy(rule);
        let reference = Model::new(&base).unwrap();
        let triangles = toy_triangles(&base);
        assert!(triangles.len() > 10_000, "{}", triangles.len());
        let wanted: Vec<(Vec<Span>, Drawing)> = triangles
            .iter()
            .map(|triangle| (exact_spans(&base, triangle), draw(&reference, triangle)))
            .collect();
        for (name, profile) in exact_machines(&base) {
            let model = Model::new(&profile).unwrap();
            let planar = profile.form.walks_a_plane();
            for (triangle, (spans, drawn)) in triangles.iter().zip(&wanted) {
                let got = draw(&model, triangle);
                assert_eq!(&got.spans, spans, "{name} {rule:?} {triangle:?}");
                if planar {
                    assert_eq!(got.depth, drawn.depth, "{name} {triangle:?}");
                    assert_eq!(got.events, drawn.events, "{name} {triangle:?}");
                }
            }
        }
    }
}

/// The same on the built-in scenes, in a window that no tile divides.
#[test]
fn exact_machines_and_orders_agree_on_the_built_in_scenes() {
    let mut base = load("sgi-4k").unwrap();
    base.window = guardbit::profile::WindowConfig { width: 203, height: 157 };
    let machines: Vec<(String, Model)> = exact_machines(&base)
        .into_iter()
        .map(|(name, profile)| (name, Model::new(&profile).unwrap()))
        .collect();
    for (scene, _) in scene::builtin_names() {
        let viewport = machines[0].1.viewport();
        let scene = scene::load(scene, &viewport).unwrap();
        let mut covered = 0;
        for triangle in scene.triangles.iter().step_by(1 + scene.triangles.len() / 400) {
            let Ok(triangle) = machines[0].1.snap(triangle) else { continue };
            let spans = exact_spans(&base, &triangle);
            covered += spans.len();
            let depth = draw(&machines[0].1, &triangle).depth;
            for (name, model) in &machines {
                let got = draw(model, &triangle);
                assert_eq!(got.spans, spans, "{name} on {} {triangle:?}", scene.name);
                if model.profile().form.walks_a_plane() {
                    assert_eq!(got.depth, depth, "{name} on {} {triangle:?}", scene.name);
                }
            }
        }
        assert!(covered > 20, "{}", scene.name);
    }
}

/// How far depth may be off: clauses, in ULP, with exact slopes of the plane.
fn bound(profile: &Profile, triangle: &Triangle) -> f64 {
    let real = |value: i128| value as f64;
    let depth = profile.depth.unwrap();
    let (z, grid) = (triangle.z.unwrap(), profile.grid().unwrap());
    let unit = |rounding: Rounding| if rounding.is_nearest() { 0.5 } else { 1.0 };
    let ulp = (-f64::from(depth.interpolation)).exp2();
    let window = [profile.window.width, profile.window.height].map(f64::from);
    match profile.form {
        Form::Gouraud(walk) => {
            let plane = PlaneNumerator::new(triangle.xy, z).unwrap();
            let pixel = real(1 << grid.sub_pixel);
            let slope = (real(plane.slope[0]) * pixel / real(plane.whole)).abs();
            let (low, high) = triangle.extent(1);
            let rows = (real(high - low) / pixel).min(window[1]) + 2.0;
            let (low, high) = triangle.extent(0);
            let columns = (real(high - low) / pixel).min(window[0]) + 2.0;
            let x_off = unit(walk.rounding) * (-f64::from(walk.fraction)).exp2();
            rows * (unit(depth.rounding) * ulp + slope * x_off)
                + columns * unit(depth.rounding) * ulp
        }
        Form::Barycentric(machine) => {
            let steps = 1.0 + window[0] + window[1];
            let share = unit(machine.rounding) * (-f64::from(machine.coordinate)).exp2() * steps;
            let rise = real((z[1] - z[0]).abs() + (z[2] - z[0]).abs());
            rise * share + ulp
        }
        _ => (1.0 + window[0] + window[1]) * unit(depth.rounding) * ulp,
    }
}

/// Clauses: depth stays within each machine's stated bound, and a walked edge
/// is wrong only at samples nearer to an edge than its x can be off.
#[test]
fn inexact_machines_stay_within_their_bounds() {
    let mut worst = vec![0.0f64; triangle_machines().count()];
    for index in 0..400 {
        let mut words = Words::new(21, 9, index);
        let mut base = load("sgi-4k").unwrap();
        base.window = guardbit::profile::WindowConfig { width: 64, height: 48 };
        let reach = [40, 200, 4000, 60_000][index as usize % 4];
        let centre = [words.between(0, 60_000), words.between(0, 45_000)];
        let mut point =
            || [0, 1].map(|axis| (centre[axis] + words.between(-reach, reach)).clamp(0, 65_536));
        let xy = [point(), point(), point()];
        let z = [(); 3].map(|()| words.between(0, (1 << 24) - 1));
        let triangle = Triangle { xy, z: Some(z) }.normalised();
        if triangle.area2() == 0 {
            continue;
        }
        for (n, name) in triangle_machines().map(|kind| kind.name).enumerate() {
            let profile = base.with_machine(name).unwrap();
            let model = Model::new(&profile).unwrap();
            let limit = bound(&profile, &triangle);
            // What would leave the depth range is clamped, and only nearer to the truth for it.
            triangle_error(&model, &model.place(triangle).unwrap(), |x, y, error| match error {
                SampleError::Depth(ulp) => {
                    assert!(ulp.abs() <= limit, "{name}: {ulp} > {limit} at {x} {y} {triangle:?}");
                    worst[n] = worst[n].max(ulp.abs() / limit);
                }
                SampleError::Missing | SampleError::Extra => {
                    assert!(!profile.covers_exactly(), "{name} at {x} {y} {triangle:?}");
                    assert!(near_an_edge(&profile, &triangle, x, y), "{name} at {x} {y}");
                }
            });
        }
    }
    // The bounds are no wider than the errors call for.
    assert!(worst.iter().all(|part| *part > 0.02), "{worst:?}");
}

/// Whether a sample lies within the walk's error of an edge that its row crosses: (rows + 1) units
/// of its last place, on the pixel scale.
fn near_an_edge(profile: &Profile, triangle: &Triangle, x: u32, y: u32) -> bool {
    let walk = profile.form.walk().unwrap();
    let at = profile.grid().unwrap().position(x.into(), y.into());
    (0..3).any(|k| {
        let (a, b) = (triangle.xy[k], triangle.xy[(k + 1) % 3]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        // Horizontal distance to the edge times |dy|, exactly.
        let off = ((at[0] - a[0]) * dy - (at[1] - a[1]) * dx).abs();
        let rows = dy.abs() / (1 << profile.vertex.sub_pixel) + 2;
        let slack = rows * dy.abs();
        off << walk.fraction <= slack << profile.vertex.sub_pixel
    })
}

/// Clause A-4: the tree of serial adders is multiplication, for every pixel of a toy screen.
#[test]
fn the_serial_tree_multiplies() {
    for width in [1, 3, 5, 8] {
        for a in -9..9 {
            for b in [-17, -3, 0, 1, 6, 100] {
                for (x, y) in (0..12u32).flat_map(|x| (0..7u32).map(move |y| (x, y))) {
                    let c = a * 5 - b;
                    let wanted = (c + a * i128::from(x) + b * i128::from(y)) & ((1 << width) - 1);
                    assert_eq!(serial_plane([a, b, c], [x, y], width), wanted.cast_unsigned());
                }
            }
        }
    }
    let wide = serial_plane([-(1 << 90), 3, 1 << 100], [65_535, 65_535], 128);
    assert_eq!(wide.cast_signed(), (1 << 100) - (65_535 << 90) + 3 * 65_535);
}

/// Counts nothing and wants nothing.
struct Nothing(u64);

impl Sink for Nothing {
    fn span(&mut self, _: u32, x0: u32, x1: u32, _: &[u64]) {
        self.0 += u64::from(x1 - x0);
    }
}

/// Keeps what a drawing took.
struct Worked(guardbit::machine::Work);

impl Sink for Worked {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn work(&mut self, work: &guardbit::machine::Work) {
        self.0.add(work);
    }
}

/// Clause A-10: the work of a machine grows with what it covers, not with the window.
#[test]
fn a_small_triangle_costs_the_same_in_any_window() {
    let triangle = Triangle {
        xy: [[40 << 10, 40 << 10], [44 << 10, 41 << 10], [41 << 10, 44 << 10]],
        z: Some([0, 5, 9]),
    };
    for name in triangle_machines().map(|kind| kind.name).filter(|name| *name != "engine-per-pixel")
    {
        let mut works = Vec::new();
        for side in [64, 4096] {
            let mut profile = load("sgi-4k").unwrap();
            profile.window = guardbit::profile::WindowConfig { width: side, height: side };
            let model = Model::new(&profile.with_machine(name).unwrap()).unwrap();
            let mut worked = Worked(guardbit::machine::Work::default());
            model.draw(&model.place(triangle).unwrap(), &mut worked).unwrap();
            let mut covered = Nothing(0);
            model.draw(&model.place(triangle).unwrap(), &mut covered).unwrap();
            assert!(covered.0 > 5);
            works.push(worked.0);
        }
        // A descent has one more level each time the window doubles, and looks at up to
        // eight blocks there.
        let levels = if name == "homogeneous" { 8 * 6 } else { 0 };
        assert_eq!(works[0].visits, works[1].visits, "{name}");
        assert!(works[1].tiles <= works[0].tiles + levels, "{name} {works:?}");
    }
}

/// Clause A-14: what the quickest path writes to memory is what every machine draws.
#[test]
fn the_quickest_path_writes_what_is_drawn() {
    use guardbit::model::Raster;
    for name in ["sgi-4k", "d3d11", "tiny"] {
        let mut base = load(name).unwrap();
        base.window.width = base.window.width.min(90);
        base.window.height = base.window.height.min(70);
        for machine in triangle_machines().map(|kind| kind.name) {
            let model = Model::new(&base.with_machine(machine).unwrap()).unwrap();
            let scenes =
                ["fan", "triangle"].map(|name| scene::load(name, &model.viewport()).unwrap());
            let window = base.window().unwrap();
            let (mut raster, mut mask) =
                (Raster::new(window), guardbit::cover::Bitmask::new(window));
            let (mut covered, mut depths) = (vec![false; 90 * 70], vec![0; 90 * 70]);
            for triangle in
                scenes.iter().flat_map(|scene| &scene.triangles).filter_map(|t| model.snap(t).ok())
            {
                model.fill(&triangle, &mut raster).unwrap();
                model.cover(&triangle, &mut mask).unwrap();
                let drawing = draw(&model, &triangle);
                let mut values = drawing.depth.iter();
                for span in &drawing.spans {
                    for x in span.x0..span.x1 {
                        let at = (span.y * 90 + x) as usize;
                        covered[at] = true;
                        depths[at] = values.next().copied().unwrap_or(0);
                    }
                }
            }
            assert!(covered.iter().filter(|covered| **covered).count() >= 2, "{name} {machine}");
            for y in 0..window.y1 {
                for x in 0..window.x1 {
                    let at = (y * 90 + x) as usize;
                    assert_eq!(mask.get(x, y), covered[at], "{name} {machine} {x} {y}");
                    assert_eq!(raster.mask.get(x, y), covered[at], "{name} {machine} {x} {y}");
                    assert_eq!(raster.depth(y)[x as usize], depths[at], "{name} {machine}");
                }
            }
        }
    }
}

/// Clauses: the set-up words of the machines are exact values, rounded once.
#[test]
fn set_up_words_are_exact_values_rounded_once() {
    use guardbit::exact::{
        dyadic, edge_value, edge_x, integer, plane_slopes, plane_word, ratio, round,
    };
    let mut base = load("sgi-4k").unwrap();
    base.window = guardbit::profile::WindowConfig { width: 64, height: 64 };
    let (grid, depth) = (base.grid().unwrap(), base.depth.unwrap());
    let number = |value| i128::try_from(value).unwrap();
    for index in 0..300 {
        let mut words = Words::new(51, 2, index);
        let mut at = || [words.between(0, 65_536), words.between(0, 65_536)];
        let xy = [at(), at(), at()];
        let z = [(); 3].map(|()| words.between(0, (1 << 24) - 1));
        let triangle = Triangle { xy, z: Some(z) }.normalised();
        if triangle.area2() == 0 {
            continue;
        }
        let (v, z) = (triangle.xy, triangle.z.unwrap());
        for name in ["gouraud", "barycentric", "homogeneous", "scanline"] {
            let profile = base.with_machine(name).unwrap();
            let model = Model::new(&profile).unwrap();
            let got = draw(&model, &triangle).raw_setup();
            assert_eq!(got.len(), model.ports().setup.len());
            let mut wanted = Vec::new();
            for k in 0..3 {
                let (a, b) = (v[k], v[(k + 1) % 3]);
                let (za, zb) = (z[k], z[(k + 1) % 3]);
                let ((top, zt), (bottom, zl)) =
                    if a[1] <= b[1] { ((a, za), (b, zb)) } else { ((b, zb), (a, za)) };
                let dy = bottom[1] - top[1];
                match profile.form {
                    Form::Gouraud(walk) => {
                        let reached = |y: i128| (y - 512 + 1023).div_euclid(1024);
                        let (first, end) = (reached(top[1]), reached(bottom[1]));
                        if first >= end {
                            wanted.extend([0; 6]);
                            continue;
                        }
                        let row = grid.position(0, first)[1];
                        let x = edge_x(top, bottom, row).unwrap();
                        let unit = dyadic(1 << walk.fraction, 10);
                        let slope = ratio(bottom[0] - top[0], dy).unwrap();
                        let along = ratio(row - top[1], dy).unwrap();
                        let depth_unit = integer(1 << depth.interpolation);
                        let start = integer(zt) + along * integer(zl - zt);
                        let fall = ratio((zl - zt) * 1024, dy).unwrap();
                        wanted.extend([
                            number(round(&(x * unit), walk.rounding)),
                            number(round(&(slope * integer(1 << walk.fraction)), walk.rounding)),
                            first,
                            end,
                            number(round(&(start * &depth_unit), depth.rounding)),
                            number(round(&(fall * &depth_unit), depth.rounding)),
                        ]);
                    }
                    Form::Scanline(_) => {
                        wanted.extend([top[0], top[1], bottom[0] - top[0], dy]);
                    }
                    Form::Homogeneous(_) => {
                        let e = |p: [i128; 2]| number(edge_value(a, b, p).to_integer());
                        let c = e([0, 0]);
                        wanted.extend([c, e([1, 0]) - c, e([0, 1]) - c]);
                    }
                    Form::Barycentric(_) => {
                        let owns = b[1] < a[1] || (b[1] == a[1] && b[0] > a[0]);
                        let e = |x, y| number(edge_value(a, b, grid.position(x, y)).to_integer());
                        let first = e(0, 0) - i128::from(!owns);
                        let steps = [e(1, 0) - e(0, 0), e(0, 1) - e(0, 0)].map(|step| step >> 10);
                        wanted.extend([first >> 10, steps[0], steps[1]]);
                    }
                    other => panic!("{}", other.name()),
                }
            }
            let mut plane = |weights: [i128; 3], bits: u32, rounding: Rounding| {
                let start = plane_word(v, weights, grid.offset, bits, rounding).unwrap();
                let slopes = plane_slopes(v, weights).unwrap();
                let unit = integer(1 << (bits + 10));
                let slopes = slopes.map(|slope| number(round(&(slope * &unit), rounding)));
                wanted.extend([start, slopes[0], slopes[1]]);
            };
            match profile.form {
                Form::Barycentric(machine) => {
                    plane([0, 1, 0], machine.coordinate, machine.rounding);
                    plane([0, 0, 1], machine.coordinate, machine.rounding);
                    wanted.extend([z[0], z[1] - z[0], z[2] - z[0]]);
                }
                Form::Gouraud(_) => {}
                _ => plane(z, depth.interpolation, depth.rounding),
            }
            assert_eq!(got, wanted, "{name} {triangle:?}");
        }
    }
}

/// Clause F-6: what a machine announces counts the units of its columns, with and without depth.
#[test]
fn set_up_values_count_the_units_of_their_columns() {
    let triangle = |z| Triangle { xy: [[1, 2], [9001, 700], [2500, 8003]], z };
    let depth_at = [DepthAt::Centre, DepthAt::Sample].map(Some);
    for kind in triangle_machines() {
        for depth in depth_at.into_iter().chain([None]) {
            let mut profile = load("sgi-4k").unwrap().with_machine(kind.name).unwrap();
            profile.multisample = depth.map(|depth| MultisampleConfig::standard(4, depth));
            if profile.validate().is_err() {
                continue;
            }
            let model = Model::new(&profile).unwrap();
            for z in [Some([5, 70_000, 900]), None] {
                let mut drawing = Drawing::default();
                model.draw(&model.place(triangle(z)).unwrap(), &mut drawing).unwrap();
                let words = model.ports().words(&drawing.setup);
                let count = words.unwrap_or_else(|error| panic!("{}: {error}", kind.name)).len();
                assert_eq!(count, model.ports().setup.len(), "{}", kind.name);
                assert!(count >= 9, "{}", kind.name);
            }
            assert!(matches!(model.ports().words(&[]), Err(SetupError::Count { got: 0, .. })));
        }
    }
}
