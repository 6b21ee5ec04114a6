//! Both ends of every field, and one step beyond.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::{Bits, Event, Rounding, RunTime, WidthError, Word};
use guardbit::cover::{Bitmask, EdgeWordError, Rect, RectError, SampleConfig, SampleGrid};
use guardbit::format::{Clamp, QFormat, QFormatError, ReadOut, ReadOutError};
use guardbit::machine::DrawError;
use guardbit::model::{Drawing, Model, Raster, View};
use guardbit::profile::{FormError, InvalidProfile, Profile, WindowConfig, load};
use guardbit::scene;
use guardbit::setup::{
    Coordinate, Division, DivisionError, Triangle, VertexError, VertexField, snap_f64,
};

fn draw(profile: &Profile, view: View, triangle: Triangle) -> Drawing {
    let mut drawing = Drawing::default();
    let model = Model::with_view(profile, view).unwrap();
    model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
    drawing
}

fn row(y: u32) -> View {
    View { scissor: Some(Rect { x0: 0, y0: y, x1: u32::MAX, y1: y + 1 }), ..View::default() }
}

/// The profile with edge words of another width.
fn edge_width(name: &str, width: u32) -> Profile {
    let mut profile = load(name).unwrap();
    if let Some(edges) = profile.form.edge_mut() {
        edges.width = width;
    }
    profile
}

// Clause W-1
#[test]
fn the_narrowest_and_the_widest_word() {
    let one = |v| Word::wrapping(Bits::<1>, v);
    assert_eq!([one(0), one(1), one(2)].map(Word::to_i128), [0, -1, 0]);
    assert_eq!(one(-1).overflowing_add(one(-1)).0.to_i128(), 0);
    assert!(one(-1).overflowing_add(one(-1)).1.has(Event::Wrap));
    assert_eq!(one(-1).saturating_add(one(-1)).to_i128(), -1);
    let all = |v| Word::wrapping(Bits::<128>, v);
    assert_eq!(all(i128::MAX).wrapping_add(all(1)).to_i128(), i128::MIN);
    assert_eq!(all(i128::MAX).checked_add(all(1)), None);
    assert_eq!(all(i128::MIN).saturating_add(all(-1)).to_i128(), i128::MIN);
    assert_eq!(all(-1).to_bits(), u128::MAX);
    assert_eq!(format!("{:x}", all(i128::MIN)), "80000000000000000000000000000000");
    assert_eq!(
        [0, 129, u32::MAX].map(RunTime::new),
        [0, 129, u32::MAX].map(|n| Err(WidthError(n)))
    );
    assert!(QFormat::new(0, 128).is_ok() && QFormat::new(128, 0).is_ok());
    assert_eq!(QFormat::new(0, 0), Err(QFormatError::Width(WidthError(0))));
    assert!(QFormat::new(u32::MAX, 1).is_err());
}

// Clauses
#[test]
fn shifts_about_the_width_of_the_lane() {
    use Rounding::{AwayFromZero, NearestAway, NearestDown, NearestEven, NearestUp, Odd};
    let lowest = |mode: Rounding, shift| mode.shift_right(i128::MIN, shift).0;
    // -2^127 / 2^128 is -1/2, a tie; one bit more is -1/4, one bit less is -1.
    let modes = [NearestEven, NearestUp, NearestDown, NearestAway, AwayFromZero, Odd];
    assert_eq!(modes.map(|mode| lowest(mode, 127)), [-1; 6]);
    assert_eq!(modes.map(|mode| lowest(mode, 128)), [0, 0, -1, -1, -1, -1]);
    assert_eq!(modes.map(|mode| lowest(mode, 129)), [0, 0, 0, 0, -1, -1]);
    // The largest value stays below a half.
    let largest = |mode: Rounding| mode.shift_right(i128::MAX, 128);
    assert_eq!(modes.map(largest), [0, 0, 0, 0, 1, 1].map(|value| (value, true)));
    assert_eq!(Rounding::Floor.shift_right(0, u32::MAX), (0, false));
}

// Clause G-1
#[test]
fn the_smallest_and_the_largest_read_out() {
    let bit = ReadOut::new(0, 1, 0, Clamp::Guard).unwrap();
    assert_eq!([0, 1, 2, 3].map(|v| bit.read(v)), [0, 1, 0, 1]);
    let wide = ReadOut::new(8, 64, 48, Clamp::Guard).unwrap();
    assert_eq!(wide.width(), 120);
    assert_eq!(wide.maximum(), u64::MAX);
    assert_eq!(
        [wide.read(wide.top() - 1), wide.read(wide.top()), wide.read(-1)],
        [u64::MAX, u64::MAX, 0]
    );
    let (guard, fraction) = (8, 49);
    let too_wide = Err(ReadOutError::Width { guard, integer: 64, fraction });
    assert_eq!(ReadOut::new(guard, 64, fraction, Clamp::Wrap), too_wide);
    assert!(ReadOut::new(u32::MAX, 64, u32::MAX, Clamp::Wrap).is_err());
    for integer in [0, 65] {
        let refused = Err(ReadOutError::Integer { integer });
        assert_eq!(ReadOut::new(1, integer, 1, Clamp::Guard), refused);
    }
    // All 32 bits of a result need a lane of more than 32.
    let full = ReadOut::new(0, 32, 0, Clamp::Guard).unwrap();
    assert!(full.decode::<i32>().is_none() && full.decode::<i64>().is_some());
}

// Clauses P-4, C-5, C-6, S-1
#[test]
fn sizes_at_and_beyond_their_bounds() {
    for (bits, good) in [(1, false), (2, true), (40, true), (41, false)] {
        let verdict = Division::Reciprocal { bits }.validate();
        assert_eq!(verdict, if good { Ok(()) } else { Err(DivisionError(bits)) });
    }
    for (width, good) in [(1, false), (2, true), (120, true), (121, false)] {
        let verdict = edge_width("tiny", width).validate();
        let field = vec!["form", "edge-function", "width"];
        let message = EdgeWordError(width).to_string();
        let refused = Err(InvalidProfile::Form(FormError { field, message }));
        assert_eq!(verdict, if good { Ok(()) } else { refused });
    }
    for (width, height, good) in
        [(1, 1, true), (65536, 65536, true), (0, 1, false), (1, 65537, false)]
    {
        let window = Rect::window(width, height);
        assert_eq!(window.is_ok(), good);
        if !good {
            assert_eq!(window, Err(RectError { width, height }));
        }
    }
    let mut profile = load("tiny").unwrap();
    for (integer, sub_pixel, good) in [
        (0, 1, true),
        (1, 31, true),
        (31, 1, true),
        (0, 0, false),
        (16, 17, false),
        (u32::MAX, 1, false),
    ] {
        (profile.vertex.integer, profile.vertex.sub_pixel) = (integer, sub_pixel);
        assert_eq!(profile.vertex.validate().is_ok(), good, "{integer} + {sub_pixel}");
    }
    (profile.vertex.integer, profile.vertex.sub_pixel, profile.vertex.signed) = (0, 8, true);
    assert_eq!(profile.vertex.validate(), Err(VertexError::NoSign));
    (profile.vertex.integer, profile.vertex.closed) = (1, false);
    assert_eq!(profile.vertex.range(), (-128 << 1, (128 << 1) - 1));
    for (x, good) in [(0, true), (255, true), (256, false)] {
        assert_eq!(SampleGrid::new(Some(SampleConfig::sub_pixels(x, 0)), 8).is_ok(), good);
    }
}

// Clauses C-2, C-6, E-5, S-1
#[test]
fn the_whole_window_and_its_closed_corner() {
    let profile = load("sgi-4k").unwrap();
    let end = 4096 << 10;
    let upper = Triangle { xy: [[0, 0], [end, 0], [0, end]], z: None };
    let lower = Triangle { xy: [[end, end], [0, end], [end, 0]], z: None };
    // The diagonal passes through 4096 samples; it bounds the lower triangle on its left.
    let off_diagonal = 4096 * 4095 / 2;
    assert_eq!(draw(&profile, View::default(), upper).samples(), off_diagonal);
    assert_eq!(draw(&profile, View::default(), lower).samples(), off_diagonal + 4096);
    // 34 bits lose the far corner: at pixel (0, 0) E >> 10 of the diagonal is almost 2^34.
    let at_corner = View { scissor: Some(Rect { x0: 0, y0: 0, x1: 1, y1: 1 }), ..View::default() };
    assert_eq!(draw(&profile, at_corner, upper).samples(), 1);
    assert_eq!(draw(&edge_width("sgi-4k", 34), at_corner, upper).samples(), 0);
    // The edge that takes the last value: from x = 4096 down the right side, seen from x = 0.
    let right = Triangle { xy: [[end, 0], [end, end], [0, end]], z: None };
    assert_eq!(draw(&profile, row(4095), right).samples(), 4096);
    assert_eq!(draw(&profile, row(0), right).samples(), 1);
}

// Clauses C-1, C-7, T-3
#[test]
fn one_pixel_and_less() {
    let profile = load("sgi-4k").unwrap();
    let samples = |xy| draw(&profile, View::default(), Triangle { xy, z: None }).spans;
    let (p, h) = (1024, 512);
    // A triangle of one pixel's size in the last corner of the window.
    let [x, y] = [4095 * p + h, 4095 * p + h];
    let last = samples([[x, y], [x + h, y], [x, y + h]]);
    assert_eq!(last.iter().map(|s| (s.y, s.x0, s.x1)).collect::<Vec<_>>(), [(4095, 4095, 4096)]);
    // The smallest area, 1/2 of a square sub-pixel, hits exactly when its owned corner is a sample.
    assert_eq!(samples([[h, h], [h + 1, h], [h, h + 1]]).len(), 1);
    assert_eq!(samples([[h, h], [h - 1, h], [h, h - 1]]).len(), 0);
    assert_eq!(samples([[h + 1, h], [h + 2, h], [h + 1, h + 1]]).len(), 0);
    assert_eq!(samples([[h, h], [h, h], [h, h]]).len(), 0);
}

// Clauses P-1, P-2, P-5
#[test]
fn area_one_has_the_steepest_slopes() {
    // (1,1) (2,1) (1,2) at s = 1 has A2 = 1, and covers the sample (1,1).
    let tiny = load("tiny").unwrap();
    let t = Triangle { xy: [[1, 1], [2, 1], [1, 2]], z: Some([0, 7, 0]) };
    assert_eq!(t.area2(), 1);
    let drawing = draw(&tiny, View::default(), t);
    assert_eq!((drawing.samples(), &drawing.depth[..]), (1, &[0][..]));
    // 7 codes a sub-pixel, 14 a pixel, 8 units a code.
    assert_eq!(drawing.raw_setup()[9..], [0, 112, 0]);
    // The steepest of all at 24/12/10: (2^24 - 1) 2^12 4^10 codes a pixel, in units of 2^-13.
    let end = 1 << 22;
    let t = Triangle { xy: [[0, 0], [1, end - 1], [1, end]], z: Some([0, (1 << 24) - 1, 0]) };
    assert_eq!(t.area2(), 1);
    let drawing = draw(&load("sgi-4k").unwrap(), row(0), t);
    assert_eq!(drawing.raw_setup()[10], ((1 << 24) - 1) << (12 + 20 + 13));
    // The other way it runs down: gy = -(x2 - x0) (z1 - z0) = -(2^24 - 1), times 2^(10 + 13).
    assert_eq!(drawing.raw_setup()[11], -(((1 << 24) - 1) << 23));
}

// Clauses P-2, G-2
#[test]
fn depth_stays_at_zero_and_at_its_maximum() {
    for (name, top) in [("sgi-4k", (1u64 << 24) - 1), ("d3d11", (1 << 24) - 1), ("tiny", 7)] {
        let profile = load(name).unwrap();
        let side = i128::from(profile.window.width) << profile.vertex.sub_pixel;
        for z in [0, top] {
            let t = Triangle { xy: [[0, 0], [side, 0], [0, side]], z: Some([z.into(); 3]) };
            let drawing = draw(&profile, row(1), t);
            assert!(drawing.depth.iter().all(|value| *value == z), "{name} {z}");
            assert_eq!(drawing.depth.len(), profile.window.width as usize - 2, "{name} {z}");
            assert_eq!(drawing.events.total.count(Event::ClampAbove), 0);
            assert_eq!(drawing.events.total.count(Event::ClampBelow), 0);
        }
    }
    // 64 depth bits, the most there are.
    let mut profile = load("tiny").unwrap();
    if let Some(depth) = &mut profile.depth {
        depth.integer = 64;
    }
    assert_eq!(profile.depth_max(), u64::MAX);
    let z = [u64::MAX.into(), 0, u64::MAX.into()];
    // The left edge passes through the sample (1, 1), at the maximum.
    let drawing = draw(&profile, row(0), Triangle { xy: [[1, 0], [8, 0], [1, 8]], z: Some(z) });
    assert_eq!(drawing.depth[0], u64::MAX);
}

// Clauses G-2, G-3, P-2
#[test]
fn the_smallest_case_that_needs_a_guard_bit() {
    // A(5 1/2, 1/2) z 0, B(8 1/2, 1/2) z 1, C(5 1/2, 3 1/2) z 0: a third of a code a pixel. Floored
    // in 13 bits, start -5/3 and slope 1/3 miss 0 at A by 4/8192.
    let mut profile = load("sgi-4k").unwrap();
    let half = |pixels: i128| pixels * 1024 + 512;
    let t = Triangle {
        xy: [[half(5), half(0)], [half(8), half(0)], [half(5), half(3)]],
        z: Some([0, 1, 0]),
    };
    let mut first = |clamp| {
        let depth = profile.depth.as_mut().unwrap();
        (depth.rounding, depth.clamp) = (Rounding::Floor, clamp);
        let drawing = draw(&profile, View::default(), t);
        let [start, dx, _] = drawing.raw_setup()[9..] else { unreachable!() };
        assert_eq!((start, dx, start + 5 * dx), (-13654, 2730, -4));
        drawing.depth[0]
    };
    assert_eq!(first(Clamp::Guard), 0);
    assert_eq!(first(Clamp::Sign), 0);
    assert_eq!(first(Clamp::Wrap), (1 << 24) - 1, "unguarded: the farthest depth there is");
    // With two guard bits nothing left the range; without one the primitive is refused at A.
    assert_eq!(first(Clamp::Error), 0);
    profile.depth.as_mut().unwrap().guard = 0;
    let model = Model::new(&profile).unwrap();
    let drawn = model.draw(&model.place(t).unwrap(), &mut Drawing::default());
    assert_eq!(drawn, Err(DrawError::GuardRange { x: 5, y: 0 }));
}

fn at(key: &'static str, vertex: usize, axis: usize) -> Coordinate {
    Coordinate { key, vertex: Some(vertex), axis }
}

fn lattice(xy: [[i128; 2]; 3], z: Option<[i128; 3]>) -> scene::Triangle {
    scene::Triangle::Lattice { xy, z }
}

// Clause S-2
#[test]
fn vertices_outside_name_their_field() {
    let model = |name| Model::new(&load(name).unwrap()).unwrap();
    let (sgi, d3d) = (model("sgi-4k"), model("d3d11"));
    let end = 4096 << 10;
    let xy = [[0, 0], [end, 0], [0, end]];
    assert!(sgi.snap(&lattice(xy, Some([0, (1 << 24) - 1, 0]))).is_ok());
    for (vertex, axis, value) in [(0, 0, -1), (1, 0, end + 1), (2, 1, i128::MAX), (1, 1, i128::MIN)]
    {
        let mut xy = xy;
        xy[vertex][axis] = value;
        let error = sgi.snap(&lattice(xy, None)).unwrap_err();
        let expected =
            VertexError::Outside { coordinate: at("v", vertex, axis), value, low: 0, high: end };
        assert_eq!(error, expected);
        assert_eq!(
            error.to_string(),
            format!(
                "v[{vertex}][{axis}] = {value} is outside the vertex field: 0 <= {} <= {end}",
                ["x", "y"][axis]
            )
        );
    }
    for (vertex, value) in [(0, -1), (2, 1 << 24)] {
        let mut z = [0; 3];
        z[vertex] = value;
        let (low, high) = (0, (1 << 24) - 1);
        let expected = VertexError::Outside { coordinate: at("v", vertex, 2), value, low, high };
        assert_eq!(sgi.snap(&lattice(xy, Some(z))), Err(expected));
    }
    // A half-open field: its upper end is outside.
    let (low, high) = (-32768 * 256, 32768 * 256 - 1);
    assert!(d3d.snap(&lattice([[low, low], [high, low], [low, high]], None)).is_ok());
    assert!(d3d.snap(&lattice([[low, low], [high + 1, low], [low, high]], None)).is_err());
    assert!(d3d.snap(&lattice([[low, low - 1], [high, low], [low, high]], None)).is_err());
    let mut flat = load("tiny").unwrap();
    flat.depth = None;
    let no_depth = Model::new(&flat).unwrap().snap(&lattice([[0, 0]; 3], Some([0; 3])));
    // A scene serves profiles with and without depth: it is dropped.
    assert_eq!(no_depth.map(|triangle| triangle.z), Ok(None));
}

// Clause S-3
#[test]
fn reals_beyond_every_word() {
    let model = |name| Model::new(&load(name).unwrap()).unwrap();
    let (sgi, d3d) = (model("sgi-4k"), model("d3d11"));
    let real = |x: f64, z: f64| {
        let xy = [[0.0, 0.0], [x, 1.0], [0.0, 1.0]];
        scene::Triangle::Real { xy, z: Some([0.0, z, 0.0]) }
    };
    let (low, high, top) = (-32768 * 256, 32768 * 256 - 1, (1 << 24) - 1);
    for (value, x, z) in [
        (f64::NAN, 0, 0),
        (f64::INFINITY, high, top),
        (f64::NEG_INFINITY, low, 0),
        (1e300, high, top),
        (-1e300, low, 0),
        (-0.0, 0, 0),
        (f64::from_bits(1), 0, 0),
    ] {
        assert_eq!(d3d.snap(&real(value, 0.0)).unwrap().xy[1][0], x, "{value}");
        assert_eq!(d3d.snap(&real(0.0, value)).unwrap().z.unwrap()[1], z, "{value}");
        let refused = !(value.is_finite() && (0.0..=4096.0).contains(&value));
        assert_eq!(sgi.snap(&real(value, 0.0)).is_err(), refused, "{value}");
    }
    // Finite numbers outside are refused whatever becomes of endless ones.
    assert_eq!(d3d.snap(&real(-32768.0, 32768.0)).unwrap().xy[1][0], low);
    for (x, z) in [(32768.0, 0.0), (-32769.0, 0.0), (0.0, -1.0), (0.0, 16_777_216.0)] {
        assert!(d3d.snap(&real(x, z)).is_err(), "{x} {z}");
    }
    for (value, what) in
        [(f64::NAN, "NaN"), (f64::INFINITY, "infinite"), (1e300, "too large for any word")]
    {
        let (vertex, axis) = (1, 0);
        let expected = VertexError::NotFinite { coordinate: at("f", vertex, axis), what };
        assert_eq!(sgi.snap(&real(value, 0.0)), Err(expected));
    }
    // The smallest subnormal and the smallest normal number are what they are.
    let exact = |bits, fraction| snap_f64(f64::from_bits(bits), fraction, Rounding::Floor);
    assert_eq!([exact(1, 1074), exact(3, 1073), exact(1 << 52, 1022)], [Some(1), Some(1), Some(1)]);
    // The closed end is a position; half a sub-pixel beyond it rounds to even, back onto it.
    let end = 4096 << 10;
    assert_eq!(sgi.snap(&real(4096.0, 0.0)).unwrap().xy[1][0], end);
    assert_eq!(sgi.snap(&real(4096.0 + 0.5 / 1024.0, 0.0)).unwrap().xy[1][0], end);
    assert!(sgi.snap(&real(4096.0 + 1.0 / 1024.0, 0.0)).is_err());
}

// Clause C-6
#[test]
fn the_smallest_and_the_longest_windows() {
    let mut profile = load("d3d11").unwrap();
    let t = Triangle { xy: [[-256, -256], [1 << 22, -256], [-256, 1 << 22]], z: None };
    for (width, height) in [(1, 1), (65536, 1), (1, 65536)] {
        profile.window = WindowConfig { width, height };
        // The hypotenuse is x + y = 16383 pixels: along either axis x + 1 < 16383 is covered.
        let expected = u64::from(width.max(height)).min(16382);
        let samples = draw(&profile, View::default(), t).samples();
        assert_eq!(samples, expected, "{width} x {height}");
    }
    // A scissor that misses the window, and an empty one.
    for (x0, y0, x1, y1) in [(5, 0, 9, 4), (2, 2, 2, 4), (0, 4, 4, 9)] {
        let view = View { scissor: Some(Rect { x0, y0, x1, y1 }), ..View::default() };
        let t = Triangle { xy: [[0, 0], [8, 0], [0, 8]], z: Some([0, 7, 7]) };
        let drawing = draw(&load("tiny").unwrap(), view, t);
        assert_eq!((drawing.samples(), drawing.depth.len()), (0, 0));
    }
}

/// What lies outside the vertex field is no triangle of a model: not in `draw`, not in `cover`, and
/// not by way of another model.
#[test]
fn nothing_outside_the_vertex_field_reaches_a_machine() {
    let sgi = Model::new(&load("sgi-4k").unwrap()).unwrap();
    let corner = |b: i128| Triangle { xy: [[0, 0], [b, 0], [0, b]], z: None };
    for bits in [23, 40, 63, 64, 100, 126] {
        for b in [1 << bits, -(1 << bits)] {
            let outside =
                VertexError::Outside { coordinate: at("v", 1, 0), value: b, low: 0, high: 1 << 22 };
            assert_eq!(sgi.place(corner(b)).unwrap_err(), outside);
        }
    }
    let whole = sgi.place(corner(1 << 22)).unwrap();
    let (mut drawing, mut mask) = (Drawing::default(), Bitmask::new(sgi.clip()));
    sgi.draw(&whole, &mut drawing).unwrap();
    sgi.cover(&whole, &mut mask).unwrap();
    // Samples strictly inside: row y has those with x + y < 4095, and those on the long edge.
    assert_eq!((drawing.samples(), mask.count()), (4096 * 4095 / 2, 4096 * 4095 / 2));

    let d3d = Model::new(&load("d3d11").unwrap()).unwrap();
    let foreign = d3d.place(corner(256)).unwrap();
    let refused = DrawError::Foreign { need: *sgi.field(), got: *d3d.field() };
    assert_eq!(sgi.draw(&foreign, &mut drawing), Err(refused));
    assert_eq!(sgi.cover(&foreign, &mut mask), Err(refused));
    assert_eq!(sgi.fill(&foreign, &mut Raster::new(sgi.clip())), Err(refused));
    assert_eq!(
        refused.to_string(),
        "the primitive was made for a different vertex field: -8388608 <= x, y <= 8388607 at 8 sub-pixel \
         bits and z <= 16777215; this profile has 0 <= x, y <= 4194304 at 10 sub-pixel bits and z <= \
         16777215; snap the primitive with the model that draws it"
    );
    let mut malformed = sgi.profile().vertex;
    malformed.integer = 100;
    assert!(VertexField::new(&malformed, 0).is_err());
}
