//! Conservative coverage against squares and the triangles before the snap. Spec chapter 27.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::Rounding;
use guardbit::cover::{
    ConservativeConfig, ConservativeDepth, ConservativeMode, Degenerate, EdgeStorage, Order, Stamp,
    TraversalConfig,
};
use guardbit::exact::Square;
use guardbit::machine::{Input, Sink};
use guardbit::model::{Drawing, Model, View};
use guardbit::profile::{Profile, WindowConfig, load, parse};
use guardbit::scene;
use guardbit::setup::Triangle;
use guardbit::value::{Correction, InverseWConfig};
use std::collections::BTreeSet;

/// Outer and inner coverage, culled where nothing else is said.
fn config(mode: ConservativeMode, grow: u32) -> ConservativeConfig {
    let (degenerate, depth) = (Degenerate::Cull, ConservativeDepth::Centre);
    ConservativeConfig { mode, grow, degenerate, depth }
}

/// A profile with these squares and words that hold every value.
fn conservative(name: &str, config: ConservativeConfig, storage: EdgeStorage) -> Profile {
    let mut profile = load(name).unwrap();
    profile.depth = None;
    let edge = profile.form.edge_mut().unwrap();
    (edge.conservative, edge.storage) = (Some(config), storage);
    let width = profile.exact_edge_width().unwrap();
    profile.form.edge_mut().unwrap().width = width;
    profile
}

fn drawn(model: &Model, xy: [[i128; 2]; 3]) -> BTreeSet<[u32; 2]> {
    let mut drawing = Drawing::default();
    model.draw(&model.place(Triangle { xy, z: None }).unwrap(), &mut drawing).unwrap();
    let runs = drawing.spans.iter().flat_map(|span| (span.x0..span.x1).map(|x| [x, span.y]));
    let pixels: BTreeSet<[u32; 2]> = runs.collect();
    assert_eq!(pixels.len() as u64, drawing.samples(), "no pixel twice");
    pixels
}

/// The square of a pixel in halves of a sub-pixel, larger by `grow` of them on each side.
fn square([x, y]: [u32; 2], s: u32, grow: i128) -> Square {
    let middle = [x, y].map(|at| (2 * i128::from(at) + 1) << s);
    Square { middle, half_side: (1 << s) + grow }
}

/// What the clause says of a pixel.
fn covers(config: ConservativeConfig, s: u32, xy: [[i128; 2]; 3], pixel: [u32; 2]) -> bool {
    let halves = xy.map(|v| v.map(|at| 2 * at));
    let square = square(pixel, s, config.grow.into());
    let [a, b, c] = xy;
    let flat = (b[0] - a[0]) * (c[1] - a[1]) == (c[0] - a[0]) * (b[1] - a[1]);
    match config.mode {
        _ if flat && config.degenerate == Degenerate::Cull => false,
        ConservativeMode::Outer => square.touches(halves),
        ConservativeMode::Inner => square.lies_in(halves),
    }
}

/// Triangles of the toy in which each set of vertices comes once, in one of two windings.
fn tiny_triangles() -> impl Iterator<Item = [[i128; 2]; 3]> {
    let point = |n: i128| [n % 9, n / 9];
    (0..81).flat_map(move |i| {
        (i..81).flat_map(move |j| {
            (j..81).map(move |k| {
                let [a, b, c] = [i, j, k].map(point);
                if (i + j + k) % 2 == 0 { [a, b, c] } else { [c, b, a] }
            })
        })
    })
}

/// The 16 pixels of the toy as a mask.
#[derive(Default)]
struct Mask(u16);

impl Sink for Mask {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        for bit in (x0..x1).map(|x| 1 << (4 * y + x)) {
            assert_eq!(self.0 & bit, 0, "no pixel twice");
            self.0 |= bit;
        }
    }
}

/// Returns how many triangles draw something.
fn hold_against_the_clauses(config: ConservativeConfig, storage: EdgeStorage) -> usize {
    let model = Model::new(&conservative("tiny", config, storage)).unwrap();
    let mut drawn = 0;
    for xy in tiny_triangles() {
        let mut mask = Mask::default();
        model.draw(&model.place(Triangle { xy, z: None }).unwrap(), &mut mask).unwrap();
        let pixels = (0..16).filter(|n| covers(config, 1, xy, [n % 4, n / 4]));
        let truth = pixels.fold(0, |mask, n| mask | 1 << n);
        assert_eq!(mask.0, truth, "{config:?} {storage:?} {xy:?}");
        drawn += usize::from(truth != 0);
    }
    drawn
}

fn drawing_degenerates(grow: u32) -> ConservativeConfig {
    ConservativeConfig { degenerate: Degenerate::Draw, ..config(ConservativeMode::Outer, grow) }
}

// Clauses CR-1, CR-2, CR-3, CR-4
#[test]
fn every_tiny_triangle_covers_the_squares_that_the_clauses_name() {
    // Each triangle of the field lies in the window, so each one touches a pixel.
    let all = hold_against_the_clauses(drawing_degenerates(1), EdgeStorage::Shifted);
    assert_eq!(all, 81 * 82 * 83 / 6);
    let some = hold_against_the_clauses(config(ConservativeMode::Inner, 1), EdgeStorage::Full);
    assert!(some > 100, "{some}");
}

// Clauses CR-1, CR-2, CR-3, CR-4
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn long_every_tiny_triangle_under_every_growth() {
    for storage in [EdgeStorage::Shifted, EdgeStorage::Full] {
        // One pixel is four halves of the toy's sub-pixel.
        for grow in 0..=4 {
            let all = hold_against_the_clauses(drawing_degenerates(grow), storage);
            let with_area =
                hold_against_the_clauses(config(ConservativeMode::Outer, grow), storage);
            let inner = hold_against_the_clauses(config(ConservativeMode::Inner, grow), storage);
            assert!(inner < with_area && with_area < all, "{inner} {with_area} {all}");
        }
    }
}

/// Numbers of a stream, each below a bound.
struct Stream(u64);

impl Stream {
    fn below(&mut self, bound: i128) -> i128 {
        // SplitMix64.
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        i128::from(z ^ z >> 31).rem_euclid(bound)
    }
}

/// Bits of a real vertex below the sub-pixel grid.
const FINER: u32 = 5;
/// Pixels of the window on each side.
const SIDE: u32 = 8;

/// Real vertices in units of 2^-(s + 5) pixels: some in and around the window, some within few sub-pixels of each
/// other, and some on one line or beside it, so that the snap leaves slivers, segments and points.
fn real_triangle(stream: &mut Stream, s: u32) -> [[i128; 2]; 3] {
    let pixel = 1i128 << (s + FINER);
    let window = pixel * i128::from(SIDE);
    let kind = usize::try_from(stream.below(4)).unwrap();
    let spread = [2 * window, 3 * pixel, pixel >> s << 2, 2 * window][kind];
    let from: [i128; 2] = std::array::from_fn(|_| stream.below(window));
    let mut xy: [[i128; 2]; 3] = std::array::from_fn(|_| {
        std::array::from_fn(|axis: usize| from[axis] + stream.below(spread + 1) - spread / 2)
    });
    if kind == 3 {
        let along = stream.below(65);
        let beside = pixel >> s;
        xy[2] = std::array::from_fn(|axis: usize| {
            let on_line = xy[0][axis] + (xy[1][axis] - xy[0][axis]) * along / 64;
            on_line + stream.below(beside + 1) - beside / 2
        });
    }
    xy
}

/// A coordinate of at most 32 bits.
fn real(at: i128) -> f64 {
    f64::from(i32::try_from(at).unwrap())
}

/// Draws so many real triangles, and holds each pixel of the window against the triangle before the snap. Returns
/// how many pixels were covered, and how many of them the real triangle does not touch (or hold, for inner).
fn against_the_unsnapped(profile: &Profile, count: u32, seed: u64) -> [u64; 2] {
    let (s, config) = (profile.vertex.sub_pixel, profile.conservative().unwrap());
    let model = Model::with_view(profile, View { window: Some((SIDE, SIDE)), ..View::default() });
    let model = model.unwrap();
    // In halves of a sub-pixel of the real grid.
    let nearest = !matches!(profile.vertex.snap, Rounding::Floor);
    let [grow, snap] = [i128::from(config.grow), if nearest { 1 } else { 2 }].map(|n| n << FINER);
    let mut stream = Stream(seed);
    let mut found = [0; 2];
    for _ in 0..count {
        let xy = real_triangle(&mut stream, s);
        let scale = f64::from(1u32 << (s + FINER));
        let xy_real = xy.map(|v| v.map(|at| real(at) / scale));
        let snapped = model.snap(&scene::Triangle::Real { xy: xy_real, z: None }).unwrap();
        let mut drawing = Drawing::default();
        model.draw(&snapped, &mut drawing).unwrap();
        let halves = xy.map(|v| v.map(|at| 2 * at));
        for pixel in (0..SIDE * SIDE).map(|n| [n % SIDE, n / SIDE]) {
            let covered = drawing
                .spans
                .iter()
                .any(|span| span.y == pixel[1] && (span.x0..span.x1).contains(&pixel[0]));
            let plain = square(pixel, s + FINER, 0);
            let wider = square(pixel, s + FINER, grow + snap);
            // Exactly touched or held; and the bound of what else is drawn, or not drawn.
            let (exact, bound) = match config.mode {
                ConservativeMode::Outer => (plain.touches(halves), wider.touches(halves)),
                ConservativeMode::Inner => (wider.lies_in(halves), plain.lies_in(halves)),
            };
            assert!(!exact || covered, "missed: {xy:?} {pixel:?} {config:?}");
            assert!(!covered || bound, "beyond the bound: {xy:?} {pixel:?} {config:?}");
            found[0] += u64::from(covered);
            found[1] += u64::from(covered && !exact);
        }
    }
    found
}

/// Outer coverage that misses nothing, and inner coverage that claims nothing, for a snap to nearest and by floor.
fn sound_profiles() -> Vec<Profile> {
    let mut profiles = Vec::new();
    for (snap, grow) in [(Rounding::NearestEven, 1), (Rounding::Floor, 2)] {
        for mode in [ConservativeMode::Outer, ConservativeMode::Inner] {
            let degenerate = match mode {
                ConservativeMode::Outer => Degenerate::Draw,
                ConservativeMode::Inner => Degenerate::Cull,
            };
            let config = ConservativeConfig { degenerate, ..config(mode, grow) };
            let mut profile = conservative("d3d11", config, EdgeStorage::Shifted);
            profile.vertex.snap = snap;
            profiles.push(profile);
        }
    }
    profiles
}

// Clause CR-5
#[test]
fn no_pixel_of_the_unsnapped_triangle_is_missed() {
    for profile in sound_profiles() {
        let [covered, beyond] = against_the_unsnapped(&profile, 1500, 7);
        assert!(covered > 1000 && beyond > 0 && 10 * beyond < covered, "{covered} {beyond}");
    }
}

// Clause CR-9
#[test]
fn the_built_in_profiles_keep_to_their_tiers() {
    for (name, mode) in
        [("d3d12-outer", ConservativeMode::Outer), ("d3d12-inner", ConservativeMode::Inner)]
    {
        let profile = load(name).unwrap();
        let config = profile.conservative().unwrap();
        // 1/256 pixel in halves of 1/256 pixel.
        assert_eq!((config.mode, config.grow, profile.vertex.sub_pixel), (mode, 2, 8));
        assert_eq!(config.degenerate == Degenerate::Draw, mode == ConservativeMode::Outer);
        let [covered, beyond] = against_the_unsnapped(&profile, 400, 5);
        assert!(covered > 200 && beyond > 0, "{covered} {beyond}");
    }
    // The half pixel of tier 1, and the pixel of the largest Vulkan size, are sizes as well.
    for grow in [256, 512] {
        let config = config(ConservativeMode::Outer, grow);
        let model = Model::new(&conservative("d3d11", config, EdgeStorage::Shifted)).unwrap();
        let pixels = drawn(&model, [[1000, 1000], [1200, 1000], [1000, 1300]]);
        let truth = (0..100).map(|n| [n % 10, n / 10]);
        let touched =
            truth.filter(|at| covers(config, 8, [[1000, 1000], [1200, 1000], [1000, 1300]], *at));
        assert_eq!(pixels, touched.collect());
    }
}

// Clause CR-5
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn long_a_million_unsnapped_triangles() {
    for profile in sound_profiles() {
        let [covered, beyond] = against_the_unsnapped(&profile, 250_000, 11);
        assert!(covered > 200_000 && beyond > 0);
    }
}

// Clause CR-5
#[test]
fn a_snap_that_no_growth_pays_for_loses_pixels() {
    // The snap takes 7/16 of a sub-pixel from every coordinate. Before it, the corner of pixel (1, 1) at (256, 256)
    // is inside: (256 - 7/16) (1 / 384 + 1 / 767) < 1. After it, it is outside: 256 (1 / 384 + 1 / 767) > 1.
    let xy = [[0, 0], [384, 0], [0, 767]];
    let real = xy.map(|v: [i32; 2]| v.map(|at| (f64::from(at) + 7.0 / 16.0) / 256.0));
    for snap in [Rounding::NearestEven, Rounding::Floor] {
        for (grow, kept) in [(0, false), (1, true), (2, true)] {
            let outer = config(ConservativeMode::Outer, grow);
            let mut profile = conservative("d3d11", outer, EdgeStorage::Full);
            profile.vertex.snap = snap;
            let model = Model::new(&profile).unwrap();
            let snapped = model.snap(&scene::Triangle::Real { xy: real, z: None }).unwrap();
            assert_eq!(snapped.xy, xy.map(|v| v.map(i128::from)));
            assert_eq!(drawn(&model, snapped.xy).contains(&[1, 1]), kept, "{snap} {grow}");
        }
    }
}

// Clauses CR-3, CR-7
#[test]
fn every_order_of_visits_and_tiles_cover_the_same_squares() {
    let mut stream = Stream(3);
    for config in [config(ConservativeMode::Outer, 1), config(ConservativeMode::Inner, 1)] {
        let mut base = conservative("d3d11", config, EdgeStorage::Shifted);
        base.window = WindowConfig { width: 48, height: 48 };
        let mut others = Vec::new();
        for order in Order::ALL {
            for stamp in Stamp::ALL {
                let traversal = Some(TraversalConfig { order, stamp });
                others.push(Model::new(&Profile { traversal, ..base.clone() }).unwrap());
            }
        }
        let mut tiles = base.with_machine("tiles").unwrap();
        tiles.form.edge_mut().unwrap().width += 8;
        others.push(Model::new(&tiles).unwrap());
        let model = Model::new(&base).unwrap();
        for _ in 0..40 {
            let xy = std::array::from_fn(|_| std::array::from_fn(|_| stream.below(48 << 8)));
            let pixels = drawn(&model, xy);
            let truth =
                (0..48 * 48).map(|n| [n % 48, n / 48]).filter(|at| covers(config, 8, xy, *at));
            assert_eq!(pixels, truth.collect(), "{xy:?}");
            for other in &others {
                assert_eq!(drawn(other, xy), pixels, "{:?} {xy:?}", other.profile().traversal);
            }
        }
    }
}

// Clause CR-6
#[test]
fn depth_is_that_of_the_centre_or_of_the_nearest_corner() {
    let outer = config(ConservativeMode::Outer, 1);
    let mut profile = conservative("d3d11", outer, EdgeStorage::Shifted);
    // No start bias, and slopes that are whole numbers of codes a pixel, so that nothing is rounded.
    profile.depth = load("sgi-4k").unwrap().depth;
    let (pixel, z0) = (256, 1000);
    for [gx, gy] in [[64, 32], [-64, 32], [64, -32], [-64, -32], [0, 32], [64, 0], [0, 0]] {
        let z = [z0, z0 + 4 * gx, z0 + 4 * gy];
        let xy = [[pixel, pixel], [5 * pixel, pixel], [pixel, 5 * pixel]];
        for (at, half) in [(ConservativeDepth::Centre, 0), (ConservativeDepth::Nearest, 1)] {
            profile.form.edge_mut().unwrap().conservative =
                Some(ConservativeConfig { depth: at, ..outer });
            let model = Model::new(&profile).unwrap();
            let mut drawing = Drawing::default();
            model.draw(&model.place(Triangle { xy, z: Some(z) }).unwrap(), &mut drawing).unwrap();
            let mut depths = drawing.depth.iter();
            for span in &drawing.spans {
                for x in span.x0..span.x1 {
                    // From vertex 0 to the middle of the pixel, and half a pixel back along each slope.
                    let [dx, dy] = [x, span.y].map(|at| 2 * i128::from(at) - 1);
                    let twice = gx * dx + gy * dy - half * (gx.abs() + gy.abs());
                    let expected = u64::try_from(z0 + twice / 2).unwrap();
                    assert_eq!(depths.next(), Some(&expected), "{gx} {gy} {at:?} {x} {}", span.y);
                }
            }
            assert_eq!(depths.next(), None);
        }
    }
}

// Clause CR-4
#[test]
fn a_triangle_without_area_has_the_values_of_its_first_vertex() {
    let mut profile = load("d3d11").unwrap();
    let outer = config(ConservativeMode::Outer, 1);
    let set = |profile: &mut Profile, degenerate| {
        profile.form.edge_mut().unwrap().conservative =
            Some(ConservativeConfig { degenerate, ..outer });
    };
    let triangle = Triangle { xy: [[128, 128], [640, 128], [384, 128]], z: Some([70, 90, 80]) };
    for (degenerate, pixels) in [(Degenerate::Draw, 3), (Degenerate::Cull, 0)] {
        set(&mut profile, degenerate);
        let model = Model::new(&profile).unwrap();
        let mut drawing = Drawing::default();
        model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
        assert_eq!((drawing.depth.len(), drawing.zero_area), (pixels, pixels == 0));
        assert!(drawing.depth.iter().all(|depth| *depth == 70));
    }
    // And so do channels, but for coordinates, which no such triangle has.
    let mut shaded = parse(&(load("d3d11").unwrap().to_toml() + CHANNEL), "shaded.toml").unwrap();
    set(&mut shaded, Degenerate::Draw);
    let model = Model::new(&shaded).unwrap();
    let values = model.values(&[("grey".to_owned(), vec![[20, 90, 50]])], None).unwrap();
    let mut drawing = Drawing::default();
    let placed = model.place(triangle).unwrap();
    model.draw(Input::Shaded(&placed, &values), &mut drawing).unwrap();
    assert_eq!(drawing.channels, [[20, 20, 20]]);
    shaded.channel[0].correction =
        Correction::Barycentric { bits: 12, rounding: Rounding::NearestEven };
    shaded.w =
        Some(InverseWConfig { integer: 8, ..load("examples/textured.toml").unwrap().w.unwrap() });
    let refused = shaded.validate().unwrap_err().to_string();
    assert!(refused.contains("divides by the area"), "{refused}");
}

const CHANNEL: &str = r#"
[[channel]]
name = "grey"
components = ["y"]
guard = 1
integer = 8
interpolation = 14
rounding = "nearest-even"
clamp = "guard"
correction = "affine"
"#;
